//! Tests of what is drawn from the kept timings.

use super::*;

#[test]
fn kept_timings_have_every_line_and_a_base_for_ratios() {
    let kept = Timings::kept().expect("tables");
    for (label, tool, method, without) in LINES {
        let of = kept.of(tool, method, without);
        assert!(of.len() > 1, "{label}");
        for total in of {
            assert!(total.ratio > 0.0, "{label}");
        }
    }
    assert!(!kept.measured_on().contains("unknown"));
    let based = kept.many.iter().filter(|t| kept.base(t).is_some());
    assert!(based.count() > 8);
}

/// An integrator that shares nothing with ours agrees with the reference
/// to rounding: what was measured vouches for the reference, too.
#[test]
fn heyoka_agreed_with_the_reference() {
    let kept = Timings::kept().expect("tables");
    for total in kept.of("heyoka", "Taylor sample by sample", &[]) {
        assert_eq!((total.wrong_fates, total.other_impacts), (0, 0));
        assert!(total.peak_error < 1e-12 && total.impact_error_s < 1e-11);
    }
}

/// Writes the figure where `ROCKING_FIGURES` says, to be looked at.
#[test]
fn draws_the_same_bytes_twice() {
    let draw = || {
        let figure = Timings::kept().expect("tables").figure();
        (figure.drawing.svg().expect("drawn"), figure.drawing.csv())
    };
    let (svg, csv) = draw();
    assert_eq!((&svg, &csv), (&draw().0, &draw().1));
    assert!(!svg.contains("no data in this range"));
    if let Ok(folder) = std::env::var("ROCKING_FIGURES") {
        std::fs::write(format!("{folder}/speed.svg"), svg).expect("write");
    }
}

#[test]
fn numbers_are_short() {
    let shown = [0.0, 2.84e-16, 0.0171, 1.0, 9703.4, f64::NAN];
    let words = shown.map(digits);
    assert_eq!(words, ["0", "2.8e-16", "0.017", "1", "9700", "none"]);
}
