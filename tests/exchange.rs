//! `rocking fragility --export`, `risk`, `completions` and `man`, run as a
//! user runs them. `tests/exchange.py` reads the exported files with
//! OpenQuake and pelicun themselves.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use serde_json::Value;

use super::support::{self, answer, close, json, refused_with as refused};

/// A sample as `rocking capacities` writes it.
const SAMPLE: &str = "# Sample of PGA/(g tan alpha) at EDP 1, median \
    crossing\n# alpha 0.1 rad, p 3 rad/s, eta 0.92, nonlinear, overturned at \
    alpha, record-scaling, g 9.80665 m/s2, processing: none, rocking \
    0.1.0\n1.4 # a\n1.8 # b\n2.2 # c\n2.9 # d\n3.7 # e\n5.5 # f\n";

const HAZARD: &str =
    "pga_g,annual_frequency\n0.05,0.1\n0.2,0.01\n0.6,0.0008\n2,0.00001\n";

/// A fresh folder with a sample and a hazard curve.
fn folder(name: &str) -> PathBuf {
    let files = [("capacities.txt", SAMPLE), ("hazard.csv", HAZARD)];
    support::folder(&format!("exchange-{name}"), &files)
}

#[test]
fn a_table_of_blocks_gives_each_its_own_intensities() {
    let place = folder("table");
    let blocks = "id,alpha,p,eta\nslender,0.1,3,0.92\nstocky,0.2,3,\n";
    fs::write(place.join("blocks.csv"), blocks).unwrap();
    let out = json(
        &place,
        "fragility export --blocks blocks.csv --sample capacities.txt --shift 1 \
         --format pelicun --out library.csv",
    );
    for (row, alpha) in [(0, 0.1), (1, 0.2)] {
        // The shift is the uplift threshold, tan alpha in g.
        let shift = out["blocks"][row]["shift"].as_f64().unwrap();
        assert!((shift / libm::tan(alpha) - 1.0).abs() < 1e-15);
        assert_eq!(out["blocks"][row]["unit"], "g");
    }
    let library = fs::read_to_string(place.join("library.json")).unwrap();
    let library: Value = serde_json::from_str(&library).unwrap();
    assert_eq!(library.as_object().unwrap().len(), 2);
    let csv = fs::read_to_string(place.join("library.csv")).unwrap();
    assert_eq!(csv.lines().count(), 3);
}

#[test]
fn an_export_that_would_be_wrong_is_refused_and_writes_nothing() {
    let place = folder("refused");
    let export = "--shift 1 --format nrml --out block.xml";
    let one = "fragility export --sample capacities.txt";
    for (name, table) in [
        ("twice.csv", "id,alpha,p\nA,0.1,3\nA,0.2,3\n"),
        ("column.csv", "alfa,p\n0.1,3\n"),
        ("half.csv", "alpha,p\n0.1,\n"),
        ("dot.csv", "id,alpha,p\na.b,0.1,3\n"),
        ("dash.csv", "id,alpha,p\na-b,0.1,3\n"),
        ("eta.csv", "alpha,p,eta\n0.1,3,0.9\n"),
        ("flat.csv", "alpha,p\n1.6,3\n"),
    ] {
        fs::write(place.join(name), table).unwrap();
        refused(&place, &format!("{one} --blocks {name} {export}"), name);
    }
    for (flags, names) in [
        ("--alpha 0.1 --p 4", "p 3 rad/s"),
        ("--alpha 0.1 --p 3 --im pgv", "PGA/(g tan alpha)"),
        ("--alpha 0.1 --p 3 --id a.b", "a.b"),
        ("--alpha 0.1 --p 3 --gravity 0", "--gravity"),
        ("", "--alpha and --p"),
    ] {
        refused(&place, &format!("{one} {flags} {export}"), names);
    }
    refused(
        &place,
        &format!("{one} --alpha 0.1 --p 3 --shift 1 --format pact --out x"),
        "no shifted lognormal",
    );
    refused(
        &place,
        &format!("{one} --alpha 0.1 --p 3 --format pelicun --out x.json"),
        "beside",
    );
    refused(&place, &format!("{one} --alpha 0.1 --p 3"), "--format");
    // A sample without a head does not say its measure.
    fs::write(place.join("bare.txt"), "1.4\n1.8\n2.5\n").unwrap();
    let bare = "fragility export --sample bare.txt --alpha 0.1 --p 3";
    refused(&place, &format!("{bare} {export}"), "--im");
    assert!(!place.join("block.xml").exists());
    assert!(!place.join("x.json").exists());
    answer(&place, &format!("{bare} --im pga {export}"));
    assert!(place.join("block.xml").exists());
}

#[test]
fn every_output_of_fragility_says_what_its_intensity_is() {
    let place = folder("unit");
    let one = "fragility fit --sample capacities.txt";
    let text = answer(&place, one);
    assert!(
        text.contains("unit                            PGA/(g tan alpha)\n")
    );
    fs::write(place.join("bare.txt"), "1.4\n1.8\n2.5\n").unwrap();
    let bare = json(&place, "fragility fit --sample bare.txt --im pgv");
    assert_eq!(bare["unit"], "p PGV/(g tan alpha)");
    let other = SAMPLE.replace("PGA/(g tan alpha)", "SA(1 s), g");
    fs::write(place.join("other.txt"), other).unwrap();
    let text = answer(&place, "fragility fit --sample other.txt");
    assert!(text.contains("unit                            SA(1 s), g\n"));
    refused(&place, "fragility fit --sample other.txt --im pga", "SA(1 s)");
}

/// Expected: fixtures/oracles/risk.csv, curve `four`, shift 0.15, mu -0.9,
/// beta 0.7.
#[test]
fn risk_is_that_of_the_fragility_and_tells_what_lies_beyond() {
    let place = folder("risk");
    // exp(-0.9) + 0.15, rounded once.
    let flags = "--median 0.5565696597405991 --dispersion 0.7 --shift 0.15";
    let out = json(&place, &format!("risk --hazard hazard.csv {flags}"));
    let row = &out["fragilities"][0];
    let covered = &row["annual_frequency_covered"];
    close(covered, 0.001_423_143_758_818_638_4, 1e-12);
    assert_eq!(row["probability_at_first_point"], 0.0);
    let text = answer(
        &place,
        "risk --hazard hazard.csv --sample capacities.txt --shift 1 \
         --alpha 0.1 --p 3",
    );
    assert!(text.contains("\nshifted ") && text.contains("\nnot shifted "));
    assert!(text.contains("weaker motions than the first point add to it"));
    // The two bounds are not what records or hazard leave open.
    assert!(text.contains("no confidence interval"), "{text}");
    for key in ["annual_frequency_low", "annual_frequency_high"] {
        assert!(row.get(key).is_none(), "{key}");
    }
}

#[test]
fn a_hazard_curve_that_is_none_is_refused_with_its_line() {
    let place = folder("hazard");
    let risk = "risk --hazard bad.csv --median 1 --dispersion 0.5";
    for (text, names) in [
        ("pga_g,annual_frequency\n0.1,0.1\n0.2,0.2\n", "bad.csv:3"),
        ("pga_g,annual_frequency\n0.1,0.1\n0.1,0.05\n", "bad.csv:3"),
        ("pga_g,annual_frequency\n0.1,0.1\n0.2,NaN\n", "bad.csv:3"),
        ("pga_g,annual_frequency\n0.1,x\n", "bad.csv:2"),
        ("pga_g,annual_frequency\n0.1,0.1\n", "at least two"),
        ("pga,rate\n0.1,0.1\n0.2,0.05\n", "pgv_cm_s"),
        ("", "bad.csv:1"),
    ] {
        fs::write(place.join("bad.csv"), text).unwrap();
        refused(&place, risk, names);
    }
    let other = "pgv_m_s,annual_frequency\n0.1,0.1\n0.2,0.05\n";
    fs::write(place.join("pgv.csv"), other).unwrap();
    let risk = "risk --hazard pgv.csv --sample capacities.txt";
    refused(&place, &format!("{risk} --alpha 0.1 --p 3"), "PGV");
    let risk = "risk --hazard hazard.csv --sample capacities.txt";
    refused(&place, &format!("{risk} --alpha 0.1 --p 4"), "p 3 rad/s");
}

#[test]
fn shells_and_manual_pages_know_every_command() {
    let place = folder("shells");
    let help = answer(&place, "--help");
    let shells = ["bash", "zsh", "fish"]
        .map(|shell| answer(&place, &format!("completions {shell}")));
    let page = answer(&place, "man");
    for command in ["respond", "ida", "fragility", "risk", "man"] {
        assert!(help.contains(&format!("\n  {command} ")), "{command}");
        for text in &shells {
            assert!(text.contains(command), "{command}");
        }
        assert!(page.contains(&format!("rocking\\-{command}")), "{command}");
    }
    assert!(answer(&place, "man risk").contains("\\-\\-hazard"));
    refused(&place, "man nothing", "nothing");
}

/// The fenced block after a mark in the README.
fn of_readme(mark: &str) -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../README.md");
    let readme = fs::read_to_string(path).unwrap();
    let after = readme.split(mark).nth(1).expect(mark);
    let block = after.split("```").nth(1).expect("a fenced block");
    block.split_once('\n').unwrap().1.to_owned()
}

/// The README's tour, as it stands there, on the three recorded pairs that
/// are shipped.
#[test]
fn the_tour_of_the_readme_runs() {
    let place = folder("tour");
    let shipped = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../fixtures/records/ridgecrest.zip"
    );
    fs::copy(shipped, place.join("records.zip")).unwrap();
    for name in ["objects.csv", "hazard.csv"] {
        let text = of_readme(&format!("<!-- tour: {name} -->"));
        fs::write(place.join(name), text).unwrap();
    }
    let tour = of_readme("<!-- tour -->");
    let commands = tour.matches("rocking ").count();
    assert!((6..=8).contains(&commands), "{commands} commands");
    let program = PathBuf::from(env!("CARGO_BIN_EXE_rocking"));
    let own = program.parent().unwrap().display().to_string();
    let path = std::env::var("PATH").unwrap_or_default();
    let mut shell = Command::new("bash");
    shell.args(["-e", "-c", &tour]).current_dir(&place);
    let output = shell.env("PATH", format!("{own}:{path}")).output().unwrap();
    let error = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{error}");
    let said = String::from_utf8_lossy(&output.stdout);
    for words in ["need friction > 0.5", "delta low", "at least", "SA(1 s)"] {
        assert!(said.contains(words), "no `{words}` in {said}");
    }
    for (name, lines) in [("cabinet-band.csv", 26), ("fragility.csv", 4)] {
        let text = fs::read_to_string(place.join(name)).unwrap();
        assert_eq!(text.lines().count(), lines, "{name}");
    }
    let nrml = fs::read_to_string(place.join("objects.xml")).unwrap();
    assert_eq!(nrml.matches("<fragilityFunction ").count(), 3);
}
