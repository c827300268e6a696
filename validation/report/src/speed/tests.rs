//! Tests of what is measured, never of how long it takes.

use std::fs;
use std::sync::LazyLock;

use rocking::block::Block;

use super::answers::ToolAnswer;
use super::cases;
use super::measured::{TimingRow, read_answers, row, text};
use super::parse;
use super::rest::{GroundRecord, chatter_s};

static CASES: LazyLock<Vec<cases::SpeedCase>> =
    LazyLock::new(|| cases::speed_cases().expect("cases"));

#[test]
fn cases_have_names_of_their_own_and_our_answers_are_right() {
    let cases = &*CASES;
    assert_eq!(cases.len(), 30);
    let mut names: Vec<&str> = cases.iter().map(|c| c.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 30);
    let mut overturned = 0;
    for case in cases.iter().step_by(4) {
        let reference = ToolAnswer::reference(case).expect("reference");
        let seen = rocking::integrator::Observe {
            events: true,
            ..rocking::integrator::Observe::default()
        };
        let own = rocking::integrator::respond(&case.scene(), &seen);
        let own = ToolAnswer::of(case, &own.expect("response"));
        let row = row([""; 4], (case, &reference), (1.0, 1), &own);
        assert!(row.right_fate, "{}", case.name);
        assert!(row.impact_error_s < 1e-9, "{row:?}");
        overturned += usize::from(own.peak_ratio == f64::INFINITY);
    }
    assert!(overturned > 0, "some cases overturn");
}

#[test]
fn hops_end_where_their_geometric_series_ends() {
    // Without ground motion: hops of 2 w/D each, falling by eta.
    let block = Block::try_new(0.2, 2.0).expect("block");
    let ground = GroundRecord { samples_g: &[0.0, 0.0], dt_s: 1.0 };
    let (eta, w) = (0.9, 1e-4);
    let down = 4.0 * libm::sin(0.2);
    let expected = 2.0 * w / down / (1.0 - eta);
    let found = chatter_s(&block, eta, &ground, 0.5, 1.0, w).expect("ends");
    assert!(f64::abs(found / expected - 1.0) < 1e-12, "{found} {expected}");
    // Not before the interval ends, or where the ground lifts the block.
    assert_eq!(chatter_s(&block, eta, &ground, 0.9999, 1.0, w), None);
    let strong = GroundRecord { samples_g: &[0.3, 0.3], dt_s: 1.0 };
    assert_eq!(chatter_s(&block, eta, &strong, 0.5, 1.0, w), None);
}

#[test]
fn uplift_is_at_the_crossing_and_points_away() {
    let ground = GroundRecord { samples_g: &[0.0, 0.1, -0.3, 0.0], dt_s: 0.5 };
    let (time_s, sign) = ground.exceedance(0.0, 0.2).expect("exceeds");
    assert!((time_s - 0.875).abs() < 1e-15, "{time_s}");
    assert_eq!(sign, -1.0);
    assert_eq!(ground.exceedance(0.0, 0.3), None);
    let (time_s, _) = ground.exceedance(1.0, 0.2).expect("exceeds at once");
    assert_eq!(time_s, 1.0);
}

#[test]
fn answers_of_other_tools_are_judged_or_refused() {
    let case = CASES[0].clone();
    let reference = ToolAnswer::reference(&case).expect("reference");
    let known = [(case, reference)];
    let (case, reference) = &known[0];
    let header = "tool,version,method,setting,case,cpu_s,work,peak_ratio,\
                  impacts,first_impacts_s\n";
    let path = std::env::temp_dir()
        .join(format!("rocking-answers-{}.csv", std::process::id()));
    let judge = |line: String| {
        fs::write(&path, format!("{header}{line}\n")).expect("written");
        read_answers(&path, &known)
    };
    let line = |name: &str, peak: f64, times: &str| {
        let impacts = reference.impacts;
        format!("T,1,M,s,{name},0.5,7,{peak},{impacts},{times}")
    };
    let times: Vec<String> =
        reference.first_impacts_s.iter().map(f64::to_string).collect();
    let (name, all) = (case.name.as_str(), times.join(" "));
    let peak = reference.peak_ratio;
    let rows = judge(line(name, peak + 0.25, &all)).expect("rows");
    assert_eq!(rows[0].impact_error_s, 0.0);
    assert!(rows[0].right_fate && rows[0].same_impacts);
    // Kept to three digits.
    let back: Vec<TimingRow> =
        parse(str(&text(&rows).expect("CSV"))).expect("rows");
    assert_eq!(back[0].peak_error, Some(0.25));
    assert_eq!((back.len(), &back[0].case), (1, &case.name));
    // One impact less, the other fate, no answer at all.
    let fewer = judge(line(name, peak, &times[1..].join(" "))).expect("rows");
    assert_eq!(fewer[0].impact_error_s, f64::INFINITY);
    for wrong in [f64::INFINITY, f64::NAN] {
        let rows = judge(line(name, wrong, &all)).expect("rows");
        assert!(!rows[0].right_fate);
        assert_eq!(rows[0].peak_error, None);
    }
    for (line, words) in [
        (line("other", peak, &all), "no such case: other"),
        (line(name, peak, "1.0 soon"), "\"1.0 soon\": expected numbers"),
    ] {
        let refused = judge(line).unwrap_err().to_string();
        assert!(refused.contains(words), "{refused}");
    }
    fs::remove_file(&path).expect("removed");
    let none = ToolAnswer { peak_ratio: f64::NAN, ..reference.clone() };
    let row = row(["T", "1", "M", "s"], (case, reference), (1.0, 1), &none);
    assert!(!row.right_fate);
}

fn str(bytes: &[u8]) -> &str {
    std::str::from_utf8(bytes).expect("text")
}
