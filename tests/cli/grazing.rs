//! A block whose first hop after rest grazes its base at 1.3e-8 rad/s, and
//! that is shaken for 12 s after: library and command say that double
//! precision does not tell its peak, and tell it in wider arithmetic.

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, Batch, Grid, IdaPoint, curve, curves};
use rocking::integrator::{
    Arithmetic, Assessment, Observe, Scene, respond, uplift_threshold,
};
use rocking::record::Accelerogram;

use super::support::{answer, folder};

/// PGA in g, of which the graze is 16 units in the last place away.
const PGA_G: f64 = 0.218_496_395_002_941_5;

/// Peak |theta|/alpha by an integrator of its own in 113-bit arithmetic,
/// which shares no line with this one; double precision finds 0.646810.
const PEAK: f64 = 0.633_592_238_904_015_3;

/// A lobe that lifts the block, one that pulls it back, one that catches it,
/// then levels from a linear congruence, each held for four samples. The peak
/// is 1.
fn samples() -> Vec<f64> {
    let mut out = vec![1.0; 30];
    out.resize(50, -0.5);
    out.resize(90, 1.0);
    let mut state = 10_u64;
    for _ in 0..300 {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        let part = (state >> 11) as f64 / 9_007_199_254_740_992.0;
        out.resize(out.len() + 4, 1.7 * (part - 0.5));
    }
    out
}

fn record() -> NormalisedRecord {
    let record = Accelerogram::try_new("graze", 0.01, samples()).unwrap();
    NormalisedRecord::new(&record)
}

/// The analysis whose only level is the graze.
fn analysis(certify: bool) -> Analysis {
    let block = Block::try_new(0.15, 3.0).unwrap();
    let paper = Analysis::paper(block, Restitution::constant(0.92).unwrap());
    let highest_im = 1.5 * PGA_G / uplift_threshold(&block, paper.model);
    let grid = Grid::Pga { step_g: PGA_G };
    Analysis { grid, highest_im, certify, ..paper }
}

fn level(points: &[IdaPoint]) -> IdaPoint {
    *points.iter().find(|point| point.pga_g == PGA_G).unwrap()
}

#[test]
fn a_grazing_first_hop_is_flagged_alone_and_in_lanes() {
    let record = record();
    let alone = curve(&record, &analysis(false)).unwrap();
    let point = level(&alone.points);
    assert!(!point.resolution.resolved);
    // It is flagged for a reason.
    assert!((point.outcome.edp() - PEAK).abs() > 0.01);
    let all = [analysis(false), analysis(true)];
    let found = curves(std::slice::from_ref(&record), &all, &Batch::default())
        .unwrap();
    assert_eq!(found[0][0], alone);
    let certified = level(&found[1][0].points);
    assert_eq!(certified, level(&curve(&record, &all[1]).unwrap().points));
    assert_eq!(certified.resolution.by, Some(Arithmetic::DoubleDouble));
    assert!(certified.resolution.resolved);
    assert!((certified.outcome.edp() - PEAK).abs() < 1e-14, "{certified:?}");
}

#[test]
fn a_response_that_is_not_asked_for_its_accuracy_says_so_too() {
    let (record, analysis) = (record(), analysis(false));
    let scaled = ScaledRecord::to_pga(&record, PGA_G);
    let scene = Scene::new(
        analysis.block,
        analysis.restitution,
        Excitation::Record(scaled),
    );
    let response = respond(&scene, &Observe::default()).unwrap();
    assert_eq!(response.assessment(), Assessment::Unresolved);
}

#[test]
fn the_command_flags_a_grazing_first_hop_and_certifies_its_peak() {
    let text: Vec<String> = samples().iter().map(f64::to_string).collect();
    let place = folder("graze", &[("graze.txt", &text.join("\n"))]);
    let scene = format!(
        "--alpha 0.15 --p 3 --suite graze.txt --dt 0.01 --units g --step-g \
         {PGA_G} --refine none --out ida.csv"
    );
    let row = |flags: &str| {
        let summary = answer(&place, &format!("ida {scene} {flags}"));
        let mut table = csv::Reader::from_path(place.join("ida.csv")).unwrap();
        let rows: Vec<std::collections::BTreeMap<String, String>> =
            table.deserialize().map(Result::unwrap).collect();
        let level = rows
            .iter()
            .find(|row| row["pga_g"].parse::<f64>().unwrap() == PGA_G);
        let level = level.unwrap();
        let edp: f64 = level["edp"].parse().unwrap();
        (level["outcome"].clone(), edp, summary)
    };
    let (outcome, _, _) = row("");
    assert_eq!(outcome, "unresolved");
    let (outcome, edp, summary) = row("--certify");
    assert_eq!(outcome, "rocked");
    assert!((edp - PEAK).abs() < 1e-14, "{edp}");
    let by = "  double double                 1\n";
    assert!(summary.contains(by), "{summary}");
}
