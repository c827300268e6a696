//! A block whose first hop after rest grazes its base at 1.3e-8 rad/s, and
//! that is shaken for 12 s after: double precision does not resolve its peak,
//! and wider arithmetic does.

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
    assert!(summary.contains("\nResolved by double-double"), "{summary}");
}
