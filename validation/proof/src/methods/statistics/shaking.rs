//! Synthetic shaking-table tests: numbers of another package, and coverage of
//! intervals under a known truth.

use anyhow::{Result, ensure};
use libm::{exp, log, tan};
use rocking::integrator::Model;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking::{Block, Restitution};
use rocking_procedures::Draws;
use rocking_procedures::shaking::{
    ComputedTests, Slenderness, TestComparison, TestOptions, TestResult,
};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::Estimate;
use rocking_statistics::streams::{Streams, standard_normal};

use super::truths::{share, trials};
use crate::methods::cells::{Csv, CsvRow};
use crate::methods::method::{Context, Reply, WrongModel};

const VALUES: Csv = Csv::new("oracles/shaking.csv");

/// Slenderness of the block in rad; the onset of rocking is its tangent in g.
const ALPHA: f64 = 0.1;

fn compared(
    tests: Vec<TestResult>,
    measures: Vec<IntensityMeasure>,
    draws: Draws,
) -> Result<TestComparison> {
    let block = Block::try_new(ALPHA, 4.0)?;
    let options = TestOptions {
        slenderness: Slenderness::Given(block),
        restitution: Restitution::constant(0.92)?,
        model: Model::Nonlinear,
        gravity_m_s2: STANDARD_GRAVITY_M_S2,
        measures,
        draws,
    };
    let (unknown, fitted_slope, options) = (0, None, &options);
    let all = ComputedTests { tests, unknown, block, fitted_slope, options };
    Ok(all.compare()?)
}

/// A test whose block overturns at some level; PGA is its first measure.
fn result(
    [test, motion]: [String; 2],
    capacity_factor: f64,
    [overturns_at_level, overturned]: [bool; 2],
    intensities: Vec<f64>,
) -> TestResult {
    TestResult {
        test,
        motion,
        pga_g: intensities[0],
        capacity_factor,
        overturns: true,
        overturns_at_level,
        overturned,
        intensities,
        probability: f64::NAN,
    }
}

/// The numbers of statsmodels and SciPy.
pub fn other_packages(context: &Context, answer: &mut Reply) -> Result<()> {
    let alone = context.is(WrongModel::TestsAsUnit);
    for row in VALUES.rows("tests")? {
        let set = row.text(1);
        let names: Vec<&str> = row.text(2).split(' ').collect();
        let list = |column| row.list(column, ' ');
        let (pga, factors, cav) = (list(3)?, list(4)?, list(7)?);
        let (at_level, fates) = (list(5)?, list(6)?);
        let test = |i: usize| {
            let test = i.to_string();
            let motion = if alone { &test } else { names[i] }.to_owned();
            let overturns = [at_level[i], fates[i]].map(|x| x > 0.5);
            let measures = vec![pga[i], cav[i]];
            result([test, motion], factors[i], overturns, measures)
        };
        let measures = vec!["pga".parse()?, "cav".parse()?];
        let tests = (0..names.len()).map(test).collect();
        let draws = Draws { replicates: 2, seed: 0 };
        let found = compared(tests, measures, draws)?;
        let predictors = std::iter::once(&found.computed).chain(&found.rivals);
        for own in predictors {
            let row = VALUES.row(&["predictor", set, &own.predictor])?;
            let due = row.list(3, ' ')?;
            ensure!(due.len() == 6, "{}: expected six numbers", own.predictor);
            for (name, k, seen) in [
                ("fit", 1, own.median.value()),
                ("fit", 2, own.dispersion.value()),
                ("fit", 5, own.log_likelihood),
                ("right", 0, own.right.value()),
                ("auc", 3, own.auc.value()),
                ("log-score", 4, own.log_score.value()),
            ] {
                answer.put(name, [seen], [due[k]]);
            }
        }
        for own in &found.distributions {
            let seen = [
                own.measured_median,
                own.measured_dispersion,
                own.computed_median,
                own.computed_dispersion,
                own.median_ratio.value(),
                own.dispersion_difference.value(),
                own.missing_dispersion.value(),
            ];
            put(answer, &["distribution", set, &own.im], &seen)?;
        }
        for (k, own) in found.reliability.iter().enumerate() {
            let seen = [own.tests as f64, own.predicted, own.observed.value()];
            put(answer, &["reliability", set, &k.to_string()], &seen)?;
        }
        let own = &found.repeatability;
        let counts =
            [own.pairs, own.different, own.mixed_motions, own.not_monotone];
        let counts = counts.map(|count| count as f64);
        let row = put(answer, &["repeats", set], &counts)?;
        let or_nan = |x: Option<f64>| x.unwrap_or(f64::NAN);
        row.put(answer, 3, &[("within-motions", or_nan(own.dispersion))])?;
        let own = &found.resurrected;
        let counts = [own.tests, own.overturned].map(|count| count as f64);
        let shares = [or_nan(own.expected), own.right_at_level];
        let seen = [counts, shares].concat();
        put(answer, &["resurrected", set], &seen)?;
        let own = &found.onset;
        let counts = [own.tests, own.overturned_below, own.below];
        let scores = [own.whole, own.above, own.pga_unshifted].map(or_nan);
        let seen = [counts.map(|count| count as f64), scores].concat();
        let row = put(answer, &["onset", set], &seen)?;
        row.put(answer, 3, &[("shifted", or_nan(own.pga_shifted))])?;
    }
    Ok(())
}

/// Puts the observed numbers beside those of the row with these first fields.
fn put(answer: &mut Reply, first: &[&str], seen: &[f64]) -> Result<CsvRow> {
    let row = VALUES.row(first)?;
    let due = row.list(first.len(), ' ')?;
    answer.put(first[0], seen.iter().copied(), due);
    Ok(row)
}

/// Median of measured over computed capacity of the simulated tests.
const BIAS: f64 = 1.1;

/// Dispersion of the ratio between motions, and within.
const SHARED: f64 = 0.26;
const OWN: f64 = 0.15;

/// Median of the computed capacities in g, and their dispersion.
const MEDIAN_G: f64 = 0.4;
const DISPERSION: f64 = 0.3;

/// Levels of each motion in g.
const LEVELS_G: [f64; 5] = [0.22, 0.32, 0.44, 0.6, 0.85];

/// A name, an estimate over the truth, and whether its interval covers the
/// truth.
type Held = (&'static str, f64, bool);

/// Shares of simulated sets of tests whose 90 % intervals cover the truth, and
/// the means of the estimates; `fragilities` also compares the fragilities in
/// PGA.
///
/// ln of measured over computed capacity of a test is ln 1.1 + 0.26 u_g +
/// 0.15 e with standard normal u of the motion and e of the test.
pub fn coverage(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        motions: usize, trials: u64, replicates: usize, fragilities: bool,
    }
    let name = format!("cases/{}", context.case.id);
    let streams = Streams::new(&name, 0);
    let total = (SHARED * SHARED + OWN * OWN).sqrt();
    let measures = vec![IntensityMeasure::PGA; usize::from(fragilities)];
    let trial = |index: u64| -> Result<Vec<Held>> {
        let mut stream = streams.stream(index);
        let mut normal = || standard_normal(&mut stream);
        let mut tests = Vec::new();
        for motion in 0..motions {
            let capacity_g = MEDIAN_G * exp(DISPERSION * normal());
            let capacity_g = capacity_g.max(tan(ALPHA));
            let shared = log(BIAS) + SHARED * normal();
            for pga_g in LEVELS_G {
                let measured_g = capacity_g * exp(shared + OWN * normal());
                let test = tests.len().to_string();
                let motion = motion.to_string();
                let wrong = WrongModel::TestsAsUnit;
                let motion = context.or(wrong, test.clone(), motion);
                let factor = capacity_g / pga_g;
                let overturns = [capacity_g, measured_g].map(|x| x <= pga_g);
                let mut own =
                    result([test, motion], factor, overturns, vec![pga_g]);
                own.intensities.truncate(measures.len());
                tests.push(own);
            }
        }
        let draws = Draws { replicates, seed: index };
        let found = compared(tests, measures.clone(), draws)?;
        let of = |name, estimate: Estimate, truth: f64| {
            let held = estimate.interval().is_some_and(|i| i.holds(truth));
            (name, estimate.value() / truth, held)
        };
        let mut all = vec![
            of("bias", found.computed.median, BIAS),
            of("dispersion", found.computed.dispersion, total),
        ];
        for own in &found.distributions {
            all.push(of("median-ratio", own.median_ratio, BIAS));
            all.push(of("missing-dispersion", own.missing_dispersion, total));
        }
        Ok(all)
    };
    let found = self::trials(trials, trial)?;
    let quantities = if fragilities { 4 } else { 2 };
    for k in 0..quantities {
        let own = found.iter().filter_map(|one| one.get(k));
        let held: Vec<bool> = own.clone().map(|one| one.2).collect();
        let sum = own.clone().fold(0.0, |sum, one| sum + one.1);
        for (name, _, _) in own.take(1) {
            answer.put(name, [share(&held)], [0.9]);
            let name = format!("{name}-over-truth");
            answer.put(&name, [sum / trials as f64], [1.0]);
        }
    }
    Ok(())
}
