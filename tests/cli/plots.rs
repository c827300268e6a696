//! Drawings of results over a suite.

use std::fs;
use std::path::Path;

use super::support::{answer, at2, folder, motion, refused};

const HAZARD: &str =
    "pga_g,annual_frequency\n0.05,0.1\n0.2,0.01\n0.6,0.0008\n2,0.00001\n";

/// A folder with a sample of five values and a hazard curve.
fn prepared(name: &str) -> crate::support::Place {
    let sample = "1.4\n1.8\n2.2\n2.9\n3.7\n";
    let files = [("sample.txt", sample), ("hazard.csv", HAZARD)];
    folder(&format!("plots-{name}"), &files)
}

/// The drawing of a command, which standard output alone may have, too.
fn drawn(place: &Path, command: &str) -> String {
    answer(place, &format!("{command} --plot own.svg"));
    let own = fs::read_to_string(place.join("own.svg")).unwrap();
    assert_eq!(answer(place, &format!("{command} --plot -")), own);
    own
}

/// How many dots of a series, or of the ink `m`, are drawn.
fn dots(svg: &str, ink: &str) -> usize {
    let class = format!("class=\"l r {ink}\"");
    let paths = svg.lines().filter(|line| line.contains(&class));
    paths.map(|path| path.matches("h0").count()).sum()
}

#[test]
fn an_ida_and_its_stripes_are_drawn_with_all_records() {
    let place = prepared("ida");
    fs::create_dir(place.join("suite")).unwrap();
    for rhythm in [7.0, 9.0, 11.0] {
        let samples = motion(rhythm);
        let text = at2("0.02", samples.len(), &samples);
        let file = format!("suite/r{rhythm}_1.at2");
        fs::write(place.join(file), text).unwrap();
    }
    let ida = "ida --alpha 0.1 --p 3 --suite suite --out ida.csv";
    answer(&place, &format!("{ida} --plot ida.svg"));
    let svg = fs::read_to_string(place.join("ida.svg")).unwrap();
    let curves = svg.lines().filter(|l| l.contains("class=\"l m\""));
    // One path of three curves, each of which begins with a move.
    let moves = curves.map(|path| path.matches('M').count());
    assert_eq!(moves.sum::<usize>(), 3, "{svg}");
    assert!(svg.contains(", 3 records") && svg.contains("84 % quantile"));
    answer(&place, &format!("{ida} --plot two.svg --threads 2"));
    assert_eq!(fs::read_to_string(place.join("two.svg")).unwrap(), svg);
    // Every record stands at both; the legend has a dot, too.
    let svg = drawn(&place, "stripes --ida ida.csv --levels 1.01,1.02");
    assert_eq!(dots(&svg, "m"), 7);
}

#[test]
fn fragilities_are_drawn_with_what_they_are_fitted_to() {
    let place = prepared("fragility");
    let fit = "fragility fit --sample sample.txt --shift 1";
    let svg = drawn(&place, fit);
    assert_eq!(dots(&svg, "s1"), 5);
    assert!(!svg.contains("fit, 95 % band"));
    let svg = drawn(&place, &format!("{fit} --bootstrap 20"));
    assert!(svg.contains("fit, 95 % band"));
    let counts = "intensity,exceeded,n\n0.2,0,40\n0.4,9,40\n0.6,30,40\n";
    fs::write(place.join("counts.csv"), counts).unwrap();
    let svg = drawn(&place, "fragility counts --counts counts.csv");
    assert_eq!(dots(&svg, "s1"), 3);
}

#[test]
fn a_risk_is_drawn_by_the_intensity_that_brings_it() {
    let place = prepared("risk");
    let risk = "risk --hazard hazard.csv --median 0.5 --dispersion 0.6";
    let svg = drawn(&place, risk);
    // A bar for each pair of neighbouring points.
    let bars = svg.lines().filter(|line| line.contains("fill-opacity"));
    assert_eq!(bars.map(|bar| bar.matches('M').count()).sum::<usize>(), 3);
    assert!(svg.contains("PGA (g)") && svg.contains("damage, 1/year"));
    let said = refused(&place, &format!("{risk} --plot hazard.csv"));
    assert!(said.contains("is read: expected another file"), "{said}");
}
