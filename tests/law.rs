//! The law of average spectral acceleration beside what `fixtures/law/law.py`
//! found, and one of its cells analysed again.

use std::collections::BTreeMap;

use rocking::block::Restitution;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Grid, REFINEMENT, curve};
use rocking::{Block, accelerogram::Accelerogram};
use rocking_procedures::assess::{Assumption, Object};
use rocking_procedures::law::{
    DEMAND_RANGE, FREQUENCY_RANGE_RAD_S, SLENDERNESS_RANGE_RAD,
};
use rocking_procedures::{
    AssessOptions, Draws, LawFragility, ModelError, assess, law_fragility,
};
use rocking_records::intensity::{IntensityMeasure, Measures, Settings};
use rocking_statistics::Clusters;
use rocking_statistics::lognormal::fit_intervals;
use serde::Deserialize;

use super::support::suites;

/// What the script found.
#[derive(Deserialize)]
struct Found {
    ln_median: BTreeMap<String, f64>,
    ln_dispersion: BTreeMap<String, f64>,
    p_range: (f64, f64),
    error: f64,
    error_by_demand: BTreeMap<String, f64>,
    cells: BTreeMap<String, usize>,
}

#[derive(Deserialize)]
struct Cell {
    suite: String,
    alpha_rad: f64,
    p_rad_s: f64,
    eta: f64,
    demand: f64,
    median: f64,
    median_low: f64,
    median_high: f64,
    dispersion: f64,
    law_median: f64,
    law_dispersion: f64,
    judged: String,
    model: String,
    overturn: String,
}

fn found() -> Found {
    serde_json::from_str(include_str!("../fixtures/law/law.json")).unwrap()
}

fn cells() -> Vec<Cell> {
    let text = include_str!("../fixtures/law/cells.csv");
    let rows = csv::Reader::from_reader(text.as_bytes()).into_deserialize();
    rows.collect::<Result<_, _>>().unwrap()
}

fn law(alpha_rad: f64, p_rad_s: f64, eta: f64, edp: f64) -> LawFragility {
    let block = Block::try_new(alpha_rad, p_rad_s).unwrap();
    law_fragility(&block, eta, edp, ModelError::none()).unwrap()
}

/// Terms of the script by their names.
fn sum(of: &BTreeMap<String, f64>, p: f64, eta: f64, d: f64) -> f64 {
    let (l, e, below) = (libm::log(p / 6.0_f64.sqrt()), 0.92 - eta, 1.0 - d);
    let term = |name: &str| match name {
        "1" => 1.0,
        "0.92-eta" => e,
        "l(0.92-eta)" => l * e,
        "l" => l,
        "l^2" => l * l,
        "(1-d)^2" => below * below,
        "(1-d)^2 l" => below * below * l,
        other => panic!("{other}: the law has no such term"),
    };
    of.iter().map(|(name, c)| c * term(name)).sum()
}

#[test]
fn the_law_has_the_terms_the_range_and_the_errors_that_were_fitted() {
    let found = found();
    assert_eq!(found.p_range, FREQUENCY_RANGE_RAD_S);
    for (p, eta, edp) in [
        (0.7, 0.85, f64::INFINITY),
        (3.0, 0.92, 0.5),
        (8.0, 0.97, 0.2),
        (2.0, 0.9, 0.35),
    ] {
        let own = law(0.2, p, eta, edp);
        let d = edp.min(1.0);
        let ratio = libm::exp(sum(&found.ln_median, p, eta, d));
        assert!((own.median_ratio / ratio - 1.0).abs() < 1e-12);
        let dispersion = libm::exp(sum(&found.ln_dispersion, p, eta, d));
        assert!((own.record_dispersion / dispersion - 1.0).abs() < 1e-12);
    }
    // Rounded up, by less than 0.015.
    let rounded_up = |stated: f64, error: f64| {
        assert!((0.0..0.015).contains(&(stated - error)), "{stated} {error}");
    };
    rounded_up(law(0.2, 3.0, 0.92, f64::INFINITY).law_error, found.error);
    for (demand, error) in &found.error_by_demand {
        let edp: f64 = demand.parse().unwrap();
        if edp.is_finite() {
            assert!((DEMAND_RANGE.0..=DEMAND_RANGE.1).contains(&edp));
            rounded_up(law(0.2, 3.0, 0.92, edp).law_error, *error);
        }
    }
}

/// Each cell's verdict follows from its interval, and their counts are those
/// that the report prints.
#[test]
fn every_cell_is_judged_by_its_interval() {
    let found = found();
    let mut counts = BTreeMap::from(
        ["holds", "open", "fails"].map(|word| (word.to_owned(), 0)),
    );
    for cell in cells() {
        let low = cell.median_low / cell.law_median;
        let high = cell.median_high / cell.law_median;
        let word = match (low, high) {
            (low, high) if low >= 0.87 && high <= 1.15 => "holds",
            (low, high) if low > 1.15 || high < 0.87 => "fails",
            _ => "open",
        };
        // Cells have five digits.
        let near = |x: f64| (x / 0.87 - 1.0).abs().min((x / 1.15 - 1.0).abs());
        let is_edge = near(low).min(near(high)) < 1e-3;
        assert!(cell.judged == word || is_edge, "{low} {high}");
        let (low, high) = FREQUENCY_RANGE_RAD_S;
        if !(low..=high).contains(&cell.p_rad_s) {
            continue;
        }
        let (low, high) = SLENDERNESS_RANGE_RAD;
        assert!((low..=high).contains(&cell.alpha_rad));
        let own = law(cell.alpha_rad, cell.p_rad_s, cell.eta, cell.demand);
        assert!((own.median_ratio / cell.law_median - 1.0).abs() < 1e-4);
        let ratio = own.record_dispersion / cell.law_dispersion;
        assert!((ratio - 1.0).abs() < 1e-4);
        if cell.suite != "ordinary" && cell.demand.is_infinite() {
            *counts.get_mut(&cell.judged).unwrap() += 1;
        }
    }
    assert_eq!(counts, found.cells);
}

#[test]
fn a_cell_of_an_embedded_suite_is_found_again() {
    let (alpha_rad, p_rad_s, eta) = (0.15, 4.0, 0.92);
    let block = Block::try_new(alpha_rad, p_rad_s).unwrap();
    let restitution = Restitution::constant(eta).unwrap();
    let analysis = Analysis {
        grid: Grid::Im { step: 0.05 },
        refine: Some(REFINEMENT),
        highest_im: 2000.0,
        ..Analysis::paper(block, restitution)
    };
    let im = IntensityMeasure::RockingSa(None).of_block(p_rad_s);
    let settings = Settings::of(9.80665, [&im]).unwrap();
    let ratio = |pair: &rocking_synthesis::Pair| {
        let record = &pair.components[0];
        let found = curve(&NormalisedRecord::new(record), &analysis).unwrap();
        let first = found.overturning.and_then(|first| first.refined);
        let capacity = first.unwrap().im;
        let measures = Measures::of(record, &settings).unwrap();
        let average = im.value(&measures, settings.periods_s()).unwrap();
        let ratio = capacity * average / record.pga_g();
        (ratio, ratio)
    };
    let [suite, _] = suites();
    let ratios: Vec<(f64, f64)> = suite.iter().map(ratio).collect();
    let fitted = fit_intervals(&ratios, 0.0).unwrap().distribution;
    let is_own = |cell: &&Cell| {
        cell.suite == "embedded ordinary"
            && (cell.alpha_rad, cell.p_rad_s, cell.eta)
                == (alpha_rad, p_rad_s, eta)
            && cell.demand.is_infinite()
            && (cell.model.as_str(), cell.overturn.as_str())
                == ("nonlinear", "alpha")
    };
    let all = cells();
    let cell = all.iter().find(is_own).unwrap();
    assert!((fitted.median() / cell.median - 1.0).abs() < 1e-4);
    assert!((fitted.dispersion() / cell.dispersion - 1.0).abs() < 1e-3);
}

/// `assess` turns the law into PGA by the spectra of the records.
#[test]
fn an_assessment_has_the_law_beside_its_answer() {
    let [_, suite] = suites();
    let records: Vec<Accelerogram> =
        suite.iter().map(|pair| pair.components[0].clone()).collect();
    let object = |p_rad_s| {
        let block = Block::try_new(0.2, p_rad_s).unwrap();
        let eta = Restitution::constant(0.9).unwrap();
        Object::new(&format!("p{p_rad_s}"), block, eta)
    };
    let options = AssessOptions {
        gravity_m_s2: 9.81,
        hazard: None,
        years: 50.0,
        draws: Draws { replicates: 20, seed: 0 },
        certify: false,
        model_error: ModelError::none(),
        recorded_ratios: &[],
        target_years: None,
        sliding_share: 0.05,
    };
    let clusters = Clusters::singletons(records.len());
    let objects = [object(4.0), object(9.0)];
    let found = assess(&objects, &records, &clusters, &options).unwrap();
    let row = |k: usize| {
        let all =
            &found.objects.iter().find(|o| o.facts.object.id == objects[k].id);
        let all = all.unwrap().alternatives.iter();
        all.filter(|own| own.assumption == Assumption::Law).collect::<Vec<_>>()
    };
    // Beyond the range there is no such row.
    assert!(row(1).is_empty());
    let [own] = row(0)[..] else { panic!("one row of the law") };
    let law = law(0.2, 4.0, 0.9, f64::INFINITY);
    let settings = Settings::of(9.81, [&law.im]).unwrap();
    let ratio = |record: &Accelerogram| {
        let measures = Measures::of(record, &settings).unwrap();
        let average = law.im.value(&measures, settings.periods_s()).unwrap();
        libm::log(record.pga_g() / average)
    };
    let logs: Vec<f64> = records.iter().map(ratio).collect();
    let n = logs.len() as f64;
    let mean = logs.iter().sum::<f64>() / n;
    let squares = logs.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    let spread = (squares / (n - 1.0)).sqrt();
    let fitted = own.answer.fitted.records();
    let median = law.fitted.median() * libm::exp(mean);
    assert!((fitted.median() / median - 1.0).abs() < 1e-9);
    let both = libm::hypot(law.fitted.dispersion(), spread);
    assert!((fitted.dispersion() / both - 1.0).abs() < 1e-9);
}
