//! Tests of what is drawn from the kept timings.

use super::*;

#[test]
fn kept_timings_have_every_line() {
    let kept = Timings::kept().expect("tables");
    for (label, key, _) in LINES {
        let of: Vec<_> = kept.totals_of(key).collect();
        assert!(of.len() > 1, "{label}");
        for total in of {
            assert!(total.ratio > 0.0, "{label}");
        }
    }
    assert!(!kept.measured_on().contains("unknown"));
}

/// An integrator that shares nothing with ours agrees with the reference
/// to rounding: what was measured vouches for the reference, too.
#[test]
fn heyoka_agreed_with_the_reference() {
    let kept = Timings::kept().expect("tables");
    for total in kept.totals_of(["heyoka", HEYOKA]) {
        assert_eq!((total.wrong_fates, total.other_impacts), (0, 0));
        assert!(total.peak_error < 1e-12 && total.impact_error_s < 1e-11);
    }
}

/// Writes the figure where `ROCKING_FIGURES` says, to be looked at.
#[test]
fn draws_the_same_bytes_twice() {
    let draw = || {
        let figure = Timings::kept().expect("tables").figure();
        (figure.svg(), figure.csv())
    };
    let (svg, csv) = draw();
    assert_eq!((&svg, &csv), (&draw().0, &draw().1));
    assert!(!svg.contains("no data in this range"));
    if let Ok(folder) = std::env::var("ROCKING_FIGURES") {
        std::fs::write(format!("{folder}/speed.svg"), svg).expect("write");
    }
}

/// A ratio of times means little beside another error: ours is that of a
/// setting that is no worse than the peer's in any of them, and a peer that
/// errs less leaves fewer settings, in the end none.
#[test]
fn ratios_are_at_no_larger_error() {
    let mut kept = Timings::kept().expect("tables");
    let quick =
        |kept: &Timings| kept.fastest().map(|(setting, _)| setting.to_owned());
    let setting = quick(&kept).expect("a setting");
    assert!(kept.plain().contains(&format!("At {setting}, our fastest")));

    // Order 4 has the smaller medians, but a larger worst case.
    let is_low = |t: &&Total| t.key() == [BASE[0], BASE[1], "order 4"];
    let low = kept.singles.iter().find(is_low).expect("order 4");
    assert!(low.peak_error_worst > kept.theirs.peak_error_worst);
    assert_ne!(setting, "order 4");

    let moved = kept.in_lanes(&setting).expect("work").moved;
    kept.peer.moved = moved.map(|n| n - 1);
    assert_ne!(quick(&kept), Some(setting));
    kept.theirs.peak_error = 0.0;
    assert_eq!(quick(&kept), None);
}

#[test]
fn numbers_are_short() {
    let shown = [0.0, 2.84e-16, 0.0171, 1.0, 9703.4, f64::NAN];
    let words = shown.map(digits);
    assert_eq!(words, ["0", "2.8e-16", "0.017", "1", "9700", "none"]);
}

#[test]
fn a_tool_that_ran_fewer_cases_is_named() {
    let timings = Timings::kept().unwrap();
    let said = timings.reading();
    let all = timings.own.cases;
    for (Total { label, cases, .. }, _) in timings.most_accurate() {
        let named = said.contains(&format!("{} {cases} of them", label[0]));
        assert_eq!(named, *cases < all, "{}: {said}", label[0]);
    }
}
