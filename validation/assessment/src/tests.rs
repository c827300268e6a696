//! The files of an assessment, against what is computed here.
//!
//! The records are triangular lobes, and one so short that it damages
//! nothing. Few records leave intervals that are not symmetric, so no two of
//! their numbers can be taken for each other.

use std::collections::BTreeMap;

use rocking::accelerogram::Accelerogram;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, REFINEMENT, curve, forces_at};
use rocking::{Block, Restitution};
use rocking_procedures::assess::{AssessOptions, Assessment, Object, assess};
use rocking_procedures::fragility::hazard::{Hazard, HazardOptions};
use rocking_procedures::{Draws, ModelError};
use rocking_statistics::Clusters;
use serde_json::Value;

use crate::{About, files, text};

const GRAVITY_M_S2: f64 = 9.81;

/// Half the samples of each lobe.
const LOBES: [i32; 6] = [20, 26, 34, 45, 60, 85];

/// Interval of the lobes' samples.
const DT_S: f64 = 0.01;

/// The record that damages nothing.
const SHORT: &str = "short";

/// A lobe of 0.2 g.
fn lobe(name: &str, dt_s: f64, half: i32) -> Accelerogram {
    let rise = |k: i32| 0.2 - 0.2 / f64::from(half) * f64::from(k.abs());
    let samples = (-half..=half).map(rise).collect();
    Accelerogram::try_new(name, dt_s, samples).unwrap()
}

fn records() -> Vec<Accelerogram> {
    let lobes = LOBES.map(|half| lobe(&format!("lobe-{half}"), DT_S, half));
    lobes.into_iter().chain([lobe(SHORT, 0.001, 1)]).collect()
}

fn object(id: &str, width_m: f64) -> Object {
    Object {
        id: id.into(),
        block: Block::from_dimensions(width_m, 1.8, GRAVITY_M_S2).unwrap(),
        restitution: Restitution::constant(0.92).unwrap(),
        friction: None,
        limit_ratio: None,
        floor: None,
    }
}

/// Two objects on the ground, under a hazard curve in cm/s.
fn assessed(friction: Option<f64>) -> Assessment {
    let hazard = "pgv_cm_s,annual_frequency\n5,0.1\n50,0.01\n100,1e-3\n\
                  300,1e-4\n1000,1e-6\n";
    let cabinet = Object { friction, ..object("cabinet", 0.5) };
    under(hazard, &[], [cabinet, object("shelf", 0.6)])
}

fn under(hazard: &str, ratios: &[f64], objects: [Object; 2]) -> Assessment {
    let hazard = Hazard::parse("h.csv", hazard, &HazardOptions::default());
    let options = AssessOptions {
        gravity_m_s2: GRAVITY_M_S2,
        hazard: Some(&hazard.unwrap()),
        years: 50.0,
        draws: Draws { replicates: 100, seed: 0 },
        certify: false,
        model_error: ModelError::default(),
        recorded_ratios: ratios,
    };
    let records = records();
    let clusters = Clusters::singletons(records.len());
    assess(&objects, &records, &clusters, &options).unwrap()
}

fn file(found: &Assessment, name: &str) -> String {
    let mut all = files(found, &About::default()).unwrap();
    String::from_utf8(all.remove(name).unwrap()).unwrap()
}

/// Rows of a CSV by column.
fn rows(text: &str) -> Vec<BTreeMap<&str, &str>> {
    let mut lines = text.lines().map(|line| line.split(','));
    let heads: Vec<&str> = lines.next().unwrap().collect();
    lines.map(|cells| heads.iter().copied().zip(cells).collect()).collect()
}

/// Lower end, value and upper end of every interval in a JSON.
fn intervals(value: &Value, found: &mut Vec<[f64; 3]>) {
    if let Value::Object(fields) = value {
        let number = |name: &str| fields.get(name).and_then(Value::as_f64);
        let own = number("point").or(number("p"));
        if let (Some(low), Some(own), Some(high)) =
            (number("low"), own, number("high"))
        {
            found.push([low, own, high]);
        }
        fields.values().for_each(|value| intervals(value, found));
    } else if let Value::Array(values) = value {
        values.iter().for_each(|value| intervals(value, found));
    }
}

/// Every interval holds its value, and most of them with room on both sides.
#[track_caller]
fn hold(intervals: &[[f64; 3]], least: usize) {
    let holds = |[low, own, high]: &[f64; 3]| low <= own && own <= high;
    assert!(intervals.iter().all(holds), "{intervals:?}");
    let wide = |[low, own, high]: &&[f64; 3]| low < own && own < high;
    let wide = intervals.iter().filter(wide).count();
    assert!(wide >= least, "{wide} of {}", intervals.len());
}

#[test]
fn every_interval_holds_its_value() {
    let found = assessed(None);
    let json: Value =
        serde_json::from_str(&file(&found, "assess.json")).unwrap();
    let mut all = Vec::new();
    intervals(&json, &mut all);
    // Two objects and both together, four intervals each.
    hold(&all, 16);
    let mut damage = Vec::new();
    for object in json["objects"].as_array().unwrap() {
        intervals(&object["p_damage"], &mut damage);
    }
    hold(&damage, 4);
    let table = file(&found, "fragilities.csv");
    let row = |row: &BTreeMap<&str, &str>| {
        let ends = ["low", "probability", "high"];
        Some(ends.map(|name| row[name].parse().unwrap_or(f64::NAN)))
            .filter(|ends| !ends.contains(&f64::NAN))
    };
    let curve: Vec<[f64; 3]> = rows(&table).iter().filter_map(row).collect();
    hold(&curve, 20);
}

/// The sentence that comes first says the reciprocal of the frequency, whose
/// upper end is the shorter time.
#[test]
fn the_return_period_that_comes_first_has_its_ends_in_order() {
    let found = assessed(None);
    let first = text(&found);
    let (_, rest) = first.split_once("once in ").unwrap();
    let (own, rest) =
        rest.split_once(" years on average (95 % interval ").unwrap();
    let (low, rest) = rest.split_once(" to ").unwrap();
    let (high, _) = rest.split_once(')').unwrap();
    let number = |years: &str| years.replace(',', "").parse::<f64>();
    let shown = [low, own, high].map(|years| number(years).unwrap());
    let frequency = found.objects[0].answer.annual_frequency().unwrap();
    let ends = [frequency.high().unwrap(), frequency.value()];
    let [shortest, own] = ends.map(f64::recip);
    let longest = frequency.low().unwrap().recip();
    for (years, expected) in shown.iter().zip([shortest, own, longest]) {
        // Two digits are shown.
        assert!((years / expected - 1.0).abs() < 0.05, "{first}");
    }
    assert!(shown[0] < shown[1] && shown[1] < shown[2], "{first}");
    let page = file(&found, "index.html");
    assert!(page.contains(first.lines().next().unwrap()));
}

#[test]
fn records_without_damage_are_those_that_never_overturn() {
    let found = assessed(None);
    let json: Value =
        serde_json::from_str(&file(&found, "assess.json")).unwrap();
    let table = file(&found, "capacities.csv");
    let stand = rows(&table).into_iter().filter(|row| row["record"] == SHORT);
    assert!(stand.map(|row| row["damaged"]).eq(["false", "false"]));
    for object in json["objects"].as_array().unwrap() {
        assert_eq!(object["records_without_damage"], 1);
    }
}

/// From g to cm/s: the velocity of a lobe is its area, g PGA half its length.
/// From cm/s to m/s: what pelicun reads.
#[test]
fn intensities_have_the_units_that_they_name() {
    let found = assessed(None);
    let one = found.objects.iter().find(|one| one.id == "cabinet").unwrap();
    let eta = Restitution::constant(one.eta).unwrap();
    let analysis = Analysis {
        refine: Some(REFINEMENT),
        ..Analysis::paper(one.block, eta)
    };
    for half in LOBES {
        let name = format!("lobe-{half}");
        let record = NormalisedRecord::new(&lobe(&name, DT_S, half));
        let alone = curve(&record, &analysis).unwrap();
        let pga_g = alone.overturning.unwrap().refined.unwrap().pga_g;
        let half_s = DT_S * f64::from(half);
        let pgv_cm_s = 100.0 * GRAVITY_M_S2 * pga_g * half_s;
        let own = one.by_record.iter().find(|row| row.record == name);
        let own = own.unwrap().im;
        assert!((own / pgv_cm_s - 1.0).abs() < 1e-12, "{own} {pgv_cm_s}");
    }
    let table = file(&found, "pelicun.csv");
    let row = rows(&table).into_iter().find(|row| row["ID"] == "cabinet");
    let row = row.unwrap();
    assert_eq!((found.unit, row["Demand-Unit"]), ("cm/s", "mps"));
    let median_m_s: f64 = row["LS1-Theta_0"].parse().unwrap();
    let median_cm_s = one.answer.median_im.value();
    assert!((100.0 * median_m_s / median_cm_s - 1.0).abs() < 1e-9);
}

/// A record that damages nothing counts with all its levels: here the
/// strongest alone asks for more friction than there is.
#[test]
fn a_record_without_damage_slides_at_any_of_its_levels() {
    let Object { block, restitution, .. } = object("cabinet", 0.5);
    let analysis = Analysis {
        refine: Some(REFINEMENT),
        ..Analysis::paper(block, restitution)
    };
    let short = NormalisedRecord::new(&lobe(SHORT, 0.001, 1));
    let alone = curve(&short, &analysis).unwrap();
    assert_eq!(alone.overturning, None);
    let mut levels =
        alone.points.iter().rev().map(|point| {
            forces_at(&short, &analysis, point.im).unwrap().friction
        });
    let (last, before) = (levels.next().unwrap(), levels.next().unwrap());
    assert!(last > before);
    let found = assessed(Some(0.5 * (last + before)));
    let of = |id: &str| {
        let one = found.objects.iter().find(|one| one.id == id).unwrap();
        one.slides_first
    };
    assert_eq!(of("shelf"), None);
    assert_eq!(of("cabinet"), Some(1.0 / 7.0));
}

/// Where H = k0 x^-2, a bias b of the capacity makes return periods b^2 times
/// as long: 0.8^2, 0.9^2 and 1.1^2. Nothing is said of an
/// object whose damage is a rotation.
#[test]
fn recorded_motions_move_return_periods_by_the_power_of_the_hazard() {
    let hazard = "pga_g,annual_frequency\n1e-6,1e8\n1e6,1e-16\n";
    let tilted = Object { limit_ratio: Some(0.5), ..object("tilted", 0.5) };
    let both = [tilted.clone(), object("shelf", 0.6)];
    let found = under(hazard, &[0.9, 0.8, 1.1], both);
    let own = found.recorded_motions.unwrap();
    let (low, high) = own.return_period_ratio.unwrap().ends();
    assert!((low / 0.64 - 1.0).abs() < 1e-9, "{low}");
    assert!((high / 1.21 - 1.0).abs() < 1e-9, "{high}");
    let words = "PGA of overturning is 0.9 (0.8 to 1.1) times as large (3 blocks, \
                 ordinary suite); with this hazard curve, return periods are \
                 0.81 (0.64 to 1.2) times as long.";
    assert!(text(&found).contains(words), "{}", text(&found));
    assert!(file(&found, "index.html").contains(words));
    let none = under(hazard, &[0.9], [tilted.clone(), tilted]);
    assert_eq!(none.recorded_motions, None);
}
