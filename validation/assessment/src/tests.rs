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
use rocking_procedures::assess::{
    Answer, AssessOptions, Assessment, Assumption, IntervalPart,
    IntervalSource, Object, ObjectRemark, RemedyKind, TargetVerdict, assess,
};
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
    let block = Block::from_dimensions(width_m, 1.8, GRAVITY_M_S2).unwrap();
    Object::new(id, block, Restitution::constant(0.92).unwrap())
}

/// Two objects on the ground, under a hazard curve in cm/s.
fn assessed(friction: Option<f64>) -> Assessment {
    let hazard = "pgv_cm_s,annual_frequency\n5,0.1\n50,0.01\n100,1e-3\n\
                  300,1e-4\n1000,1e-6\n";
    let cabinet = Object { friction, ..object("cabinet", 0.5) };
    under(hazard, &[], None, &[cabinet, object("shelf", 0.6)])
}

fn under(
    hazard: &str,
    ratios: &[f64],
    target: Option<f64>,
    objects: &[Object],
) -> Assessment {
    of_records(&records(), hazard, ratios, target, objects)
}

fn of_records(
    records: &[Accelerogram],
    hazard: &str,
    ratios: &[f64],
    target: Option<f64>,
    objects: &[Object],
) -> Assessment {
    let hazard = Hazard::parse("h.csv", hazard, &HazardOptions::default());
    let options = AssessOptions {
        gravity_m_s2: GRAVITY_M_S2,
        hazard: Some(&hazard.unwrap()),
        years: 50.0,
        draws: Draws { replicates: 100, seed: 0 },
        certify: false,
        model_error: ModelError::default(),
        recorded_ratios: ratios,
        target_years: target,
        sliding_share: 0.2,
    };
    let clusters = Clusters::singletons(records.len());
    assess(objects, records, &clusters, &options).unwrap()
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
    let sentence = first.split_once(". ").unwrap().0;
    assert!(page.contains(sentence), "{sentence}");
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
    let one = found
        .objects
        .iter()
        .find(|one| one.facts.object.id == "cabinet")
        .unwrap();
    let own = &one.facts.object;
    let analysis = Analysis {
        refine: Some(REFINEMENT),
        ..Analysis::paper(own.block, own.restitution)
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
        let one = found
            .objects
            .iter()
            .find(|one| one.facts.object.id == id)
            .unwrap();
        one.slides_first
    };
    assert_eq!(of("shelf"), None);
    assert_eq!(of("cabinet"), Some(1.0 / 7.0));
}

/// Where H = k0 x^-2, a factor b on the capacity makes return periods b^2
/// times as long: that of recorded motions 0.9^2, with parts of 0.8^2 and
/// 1.1^2.
#[test]
fn recorded_motions_move_return_periods_by_the_power_of_the_hazard() {
    let hazard = "pga_g,annual_frequency\n1e-6,1e8\n1e6,1e-16\n";
    let own = [object("shelf", 0.6)];
    let years = |found: &Assessment| {
        let answer = &found.objects[0].answer;
        answer.return_period_years().unwrap().value()
    };
    let plain = years(&under(hazard, &[], None, &own));
    let found = under(hazard, &[0.9, 0.8, 1.1], None, &own);
    assert!((years(&found) / plain / 0.81 - 1.0).abs() < 1e-9);
    let is_motions =
        |part: &&IntervalPart| part.source == IntervalSource::Motions;
    let part = found.objects[0].parts.iter().find(is_motions).unwrap();
    assert!((part.low / plain / 0.64 - 1.0).abs() < 1e-9);
    assert!((part.high / plain / 1.21 - 1.0).abs() < 1e-9);
    let words = "PGA of overturning is 0.9 (0.8 to 1.1) times as large (3 \
                 blocks, ordinary suite)";
    assert!(text(&found).contains(words), "{}", text(&found));
    assert!(file(&found, "index.html").contains(words));
    // The row without the factor is the plain answer.
    let rows = found.objects[0].alternatives.iter();
    let mut rows = rows.filter(|a| a.assumption == Assumption::Uncorrected);
    let answer = rows.next().unwrap().answer.return_period_years().unwrap();
    assert!((answer.value() / plain - 1.0).abs() < 1e-9);
}

/// An interval of several sources is at least as wide as each of its parts,
/// and the parts hold the answers under other coefficients of restitution.
#[test]
fn the_whole_interval_holds_each_part() {
    let hazard = "pga_g,annual_frequency\n1e-6,1e8\n1e6,1e-16\n";
    let suite = rocking_synthesis::pulse().unwrap();
    let suite = suite.iter().map(|pair| pair.components[0].clone());
    let suite: Vec<Accelerogram> = suite.take(12).collect();
    let own = [object("cabinet", 0.5), object("shelf", 0.6)];
    let found = of_records(&suite, hazard, &[], None, &own);
    for one in &found.objects {
        let whole = one.answer.return_period_years().unwrap();
        let (low, high) = whole.interval().unwrap().ends();
        let width = |part: &IntervalPart| libm::log(part.high / part.low);
        let widest = one.parts.iter().map(width).fold(0.0, f64::max);
        assert!(libm::log(high / low) > 0.9 * widest, "{one:?}");
        assert_eq!(width(one.largest_part().unwrap()), widest);
        let is_eta =
            |part: &&IntervalPart| part.source == IntervalSource::Restitution;
        let part = one.parts.iter().find(is_eta).unwrap();
        for other in &one.alternatives {
            if let Assumption::Restitution(eta) = other.assumption {
                let years = other.answer.return_period_years().unwrap();
                let held = part.low * 0.95..part.high * 1.05;
                assert!(held.contains(&years.value()), "{eta}: {years:?}");
            }
        }
    }
}

/// A tie that holds the share f of the weight makes an object like one with
/// a slenderness whose tangent is larger by 2 f. Where H = k0 x^-2, its return
/// period is the square of that ratio times as long. A tie against uplift
/// moves g tan(alpha) to the intensity of the target.
#[test]
fn ties_and_sizes_follow_from_the_statics() {
    let hazard = "pga_g,annual_frequency\n1e-6,1e8\n1e6,1e-16\n";
    let own = [object("shelf", 0.6)];
    let years =
        |answer: &Answer| answer.return_period_years().unwrap().value();
    let before = under(hazard, &[], None, &own);
    let before = years(&before.objects[0].answer);
    let target = 2.0 * before;
    let found = under(hazard, &[], Some(target), &own);
    let one = &found.objects[0];
    assert_ne!(one.target, Some(TargetVerdict::Meets));
    let slope: f64 = 0.6 / 1.8;
    for remedy in &one.remedies {
        let met = Some(TargetVerdict::Meets);
        match remedy.measure {
            RemedyKind::Tie => {
                let ratio =
                    remedy.return_period_years.unwrap().value() / before;
                let expected = 1.0 + 2.0 * remedy.size / slope;
                let off = ratio / (expected * expected) - 1.0;
                assert!(off.abs() < 1e-6, "{off}");
            }
            RemedyKind::NoUplift => {
                // H(x) = 1e-4 x^-2.
                let pga = (1e-4 * target).sqrt();
                let force = 0.5 * (pga - slope).max(0.0);
                let off = remedy.size - force;
                assert!((0.0..=0.01 + 1e-9).contains(&off), "{off}");
            }
            RemedyKind::WiderBase => {
                assert!(remedy.size > 0.6 && remedy.target == met);
                let wider = [object("shelf", remedy.size)];
                let wider = under(hazard, &[], None, &wider);
                let wider = years(&wider.objects[0].answer);
                let own = remedy.return_period_years.unwrap().value();
                assert!((own / wider - 1.0).abs() < 1e-9);
            }
            RemedyKind::LowerCentre => {
                let height = 1.8 - 2.0 * remedy.size;
                let block = Block::from_dimensions(0.6, height, GRAVITY_M_S2);
                let eta = Restitution::constant(0.92).unwrap();
                let lower = [Object::new("shelf", block.unwrap(), eta)];
                let lower = under(hazard, &[], None, &lower);
                let lower = years(&lower.objects[0].answer);
                let own = remedy.return_period_years.unwrap().value();
                assert!((own / lower - 1.0).abs() < 1e-9);
            }
            RemedyKind::Isolation => {
                assert!(remedy.return_period_years.is_some())
            }
        }
    }
}

/// A base is sought up to the width at which the object slides instead: its
/// height times the friction, and no wider than it is high.
#[test]
fn the_friction_of_the_floor_bounds_the_width_of_a_base() {
    let hazard = "pga_g,annual_frequency\n1e-6,1e8\n1e6,1e-16\n";
    for (friction, widest) in [(0.7, 0.7 * 1.8), (9.0, 1.8)] {
        let friction = Some(friction);
        let own = [Object { friction, ..object("shelf", 0.6) }];
        let found = under(hazard, &[], Some(1e15), &own);
        assert_eq!(found.objects[0].target, Some(TargetVerdict::Misses));
        let mut remedies = found.objects[0].remedies.iter();
        let wider = remedies.find(|r| r.measure == RemedyKind::WiderBase);
        let wider = wider.unwrap();
        assert!((wider.size - widest).abs() < 1e-9, "{}", wider.size);
        assert_eq!((wider.target, wider.return_period_years), (None, None));
    }
}

/// An object meets a target if its whole interval does; here the value alone
/// would meet the second.
#[test]
fn a_target_within_the_interval_is_neither_met_nor_missed() {
    let hazard = "pga_g,annual_frequency\n1e-6,1e8\n1e6,1e-16\n";
    let own = [object("shelf", 0.6)];
    let found = under(hazard, &[], None, &own);
    let years = found.objects[0].answer.return_period_years().unwrap();
    let (low, value) = (years.ends().0, years.value());
    assert!(low < value);
    for (target, expected) in [
        (0.99 * low, TargetVerdict::Meets),
        (0.5 * (low + value), TargetVerdict::Undecided),
    ] {
        let found = under(hazard, &[], Some(target), &own);
        assert_eq!(found.objects[0].target, Some(expected), "{target}");
    }
}

/// Reach is half the width and the height from the centre; 1.8 + 0.25 m to
/// the edge of the other object.
#[test]
fn an_object_falls_on_what_is_within_its_height() {
    let at = |name: &str, x_m: f64| Object {
        position_m: Some((x_m, 0.0)),
        ..object(name, 0.5)
    };
    let hazard = "pga_g,annual_frequency\n0.01,1\n2,1e-4\n";
    let all = [at("a", 0.0), at("b", 2.29), at("c", 4.6), object("d", 0.5)];
    let found = under(hazard, &[], None, &all);
    let falls = |id: &str| {
        let mut all = found.objects.iter();
        let one = all.find(|one| one.facts.object.id == id).unwrap();
        one.facts.falls_on.clone()
    };
    assert_eq!(falls("a"), ["b"]);
    assert_eq!(falls("b"), ["a"]);
    assert!(falls("c").is_empty() && falls("d").is_empty());
    let lean = found.objects[0].facts.lean_m;
    let alpha = libm::atan2(0.5, 1.8);
    assert!((lean - 1.8 * libm::sin(alpha)).abs() < 1e-12);
    assert!(file(&found, "index.html").contains("Plan of the room"));
}

/// States and remarks are the same in the page, the JSON and the CSV.
#[test]
fn an_object_has_its_state_everywhere() {
    let hazard = "pga_g,annual_frequency\n0.01,0.1\n0.3,0.02\n0.4,0.01\n\
                  1,0.00101\n4.5,0.001\n";
    let block = |width_m, height_m| {
        Block::from_dimensions(width_m, height_m, GRAVITY_M_S2).unwrap()
    };
    let eta = Restitution::constant(0.92).unwrap();
    let plain = Object { friction: Some(9.0), ..object("plain", 0.5) };
    let centimetres = Object::new("in_cm", block(50.0, 180.0), eta);
    let squat = Object::new("squat", block(0.5, 0.6), eta);
    let slippery = Object { friction: Some(0.1), ..object("slippery", 0.5) };
    let all = [plain, centimetres, squat, slippery];
    let found = under(hazard, &[], None, &all);
    let json: Value =
        serde_json::from_str(&file(&found, "assess.json")).unwrap();
    let table = file(&found, "objects.csv");
    let page = file(&found, "index.html");
    for (id, state, words) in [
        ("plain", "ranked", ""),
        ("in_cm", "remarked", "a size of 50 m"),
        ("squat", "remarked", "Housner's formula gives"),
        ("slippery", "not rocking", ""),
    ] {
        let lists = ["objects", "not_rocking"].map(|k| json[k].as_array());
        let mut objects = lists.into_iter().flatten().flatten();
        let own = objects.find(|own| own["id"] == id).unwrap();
        assert_eq!(own["state"], state, "{id}");
        let remarks = own["remarks"].as_array().unwrap().iter();
        let remarks: Vec<&str> = remarks.flat_map(Value::as_str).collect();
        assert!(remarks.join(";").contains(words), "{id} {remarks:?}");
        for remark in remarks {
            let remark = remark.replace('\'', "&#39;");
            let escaped = page.contains(&remark);
            assert!(escaped || page.contains(&remark.replace("&#39;", "'")));
        }
        let rows = rows(&table);
        let row = rows.into_iter().find(|row| row["id"] == id).unwrap();
        assert_eq!(row["state"], state);
        let has_rank = state != "not rocking";
        assert_eq!(!row["rank"].is_empty(), has_rank);
        assert_eq!(own.get("return_period_years").is_some(), has_rank);
        let exported = file(&found, "pelicun.csv").contains(id);
        assert_eq!(exported, has_rank, "{id}");
    }
    let cm = found.objects.iter().find(|o| o.facts.object.id == "in_cm");
    let beyond = ObjectRemark::BeyondHazard(1000.0);
    let cm = cm.unwrap();
    assert!(cm.facts.remarks.contains(&beyond));
    assert!(page.contains("rarer than 1 in 1,000"));
    assert!(page.contains("the hazard curve reaches 4.5"));
}
