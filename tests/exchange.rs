//! `rocking fragility --export`, `risk`, `completions` and `man`, run as a
//! user runs them. `tests/exchange.py` reads the exported files with
//! OpenQuake and pelicun themselves.

use std::fs;
use std::path::PathBuf;
use std::process::Command;

use rocking_exchange::ExchangeFormat;
use serde_json::Value;

use super::compare::{committed, holds_table};
use super::support::{
    self, answer, close, json, refused_with as refused, run,
};

/// A sample as `rocking capacities` writes it.
const SAMPLE: &str = "# Sample of PGA/(g tan alpha) at EDP 1, median \
    crossing\n# alpha 0.1 rad, p 3 rad/s, eta 0.92, nonlinear, overturned at \
    alpha, record-scaling, g 9.80665 m/s2, processing: none, rocking \
    0.1.0\n1.4 # a\n1.8 # b\n2.2 # c\n2.9 # d\n3.7 # e\n5.5 # f\n";

const HAZARD: &str =
    "pga_g,annual_frequency\n0.05,0.1\n0.2,0.01\n0.6,0.0008\n2,0.00001\n";

/// A fresh folder with a sample and a hazard curve.
fn folder(name: &str) -> crate::support::Place {
    let files = [("capacities.txt", SAMPLE), ("hazard.csv", HAZARD)];
    support::folder(&format!("exchange-{name}"), &files)
}

/// The type of the formats in Python. `.ci/accept` renews it.
#[test]
fn python_has_the_names_of_all_formats() {
    const FILE: &str = "python/rocking/_choices.py";
    let names = ExchangeFormat::ALL.iter();
    let names = names.map(|format| format!("    {:?},\n", format.name));
    let expected = format!(
        "\"\"\"Names of choices, made of the rows of the program by its \
         tests.\"\"\"\n\nfrom typing import Literal\n\n\
         ExchangeFormat = Literal[\n{}]\n",
        names.collect::<String>()
    );
    if let Some(kept) = committed(FILE, &expected) {
        assert!(kept == expected, "{FILE}: expected\n{expected}");
    }
}

/// `.ci/accept` renews the table.
#[test]
fn the_page_of_exchange_has_a_row_for_each_format() {
    const HEAD: &str = "| format | for | intensity measures | shift |\n\
         |---|---|---|---|\n";
    let rows = ExchangeFormat::ALL
        .iter()
        .map(|format| format!("| `{}` | {} |\n", format.name, format.cells));
    holds_table("docs/exchange.md", HEAD, &rows.collect::<String>());
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
fn every_origin_and_measure_goes_out_by_the_same_door() {
    let place = folder("origins");
    let text = |name: &str| fs::read_to_string(place.join(name)).unwrap();
    let row = |flags: &str| -> Vec<Value> {
        let one = "--alpha 0.1 --p 3 --format csv --out out.csv --json";
        let out = answer(&place, &format!("fragility export {flags} {one}"));
        let out: Value = serde_json::from_str(&out).unwrap();
        out["blocks"].as_array().unwrap().clone()
    };
    let near = |found: &Value, expected: f64| {
        let found = found.as_f64().unwrap();
        assert!((found / expected - 1.0).abs() < 1e-5, "{found} {expected}");
    };
    // Two samples are two limit states.
    fs::write(place.join("first.txt"), SAMPLE.replace(".4 #", ".3 #"))
        .unwrap();
    let found = row("--sample first.txt --sample capacities.txt --shift 1 \
         --limit-state leans --limit-state falls");
    assert_eq!(found[0]["limit_state"], "leans");
    assert_eq!(found[1]["limit_state"], "falls");
    // The table has the origin of both.
    assert_eq!(text("out.csv").matches("6 capacities").count(), 2);
    // Spectral acceleration has a dimension already, and holds for a block
    // of the same slenderness alone.
    let sa = SAMPLE.replace("PGA/(g tan alpha)", "SA(1 s) (g)");
    fs::write(place.join("sa.txt"), sa).unwrap();
    let found = row("--sample sa.txt");
    assert_eq!(
        (&found[0]["im"], &found[0]["unit"]),
        (&"sa:1".into(), &"g".into())
    );
    // The geometric mean of 1.4, 1.8, 2.2, 2.9, 3.7 and 5.5.
    near(&found[0]["median"], 2.625_010);
    let other = "--alpha 0.12 --p 3 --format nrml --out x.xml";
    let other = format!("fragility export --sample sa.txt {other}");
    refused(&place, &other, "alpha 0.1 rad");
    let counts = "intensity,exceeded,n\n0.2,0,40\n0.3,0,40\n0.4,0,40\n0.6,4,40\n\
                  0.7,6,40\n0.8,13,40\n0.9,12,40\n1,16,40\n";
    fs::write(place.join("counts.csv"), counts).unwrap();
    let found = row("--counts counts.csv --im pga");
    // Baker's example (Earthquake Spectra 31 (2015) 579): 1.076.
    near(&found[0]["median"], 1.076_116 * libm::tan(0.1));
    // The law says what `fragility law` says, and where it is from.
    let found = row("--law 0.35,inf");
    let own = answer(&place, "fragility law --alpha 0.1 --p 3 --json");
    let own: Value = serde_json::from_str(&own).unwrap();
    assert_eq!(found[1]["im"], "avgsa:rocking:3");
    near(&found[1]["median"], own["fitted"]["median"].as_f64().unwrap());
    assert!(text("out.csv").contains("overturning by the law of AvgSA"));
    for (flags, names) in [
        ("--law --shift 1", "no flag of a fit"),
        ("--counts counts.csv", "--im"),
        ("--counts counts.csv --im pga --shift min", "counts: expected"),
        ("--counts counts.csv --im pga --method moment", "counts: expected"),
        ("--sample capacities.txt --limit-state a --limit-state b", "1 limit"),
        ("--sample capacities.txt --law", "cannot be used"),
    ] {
        let flags = format!("{flags} --alpha 0.1 --p 3 --format csv --out x");
        refused(&place, &format!("fragility export {flags}"), names);
    }
}

#[test]
fn an_export_that_would_be_wrong_is_refused_and_writes_nothing() {
    let place = folder("refused");
    let export = "--shift 1 --format nrml --out block.xml";
    let one = "fragility export --sample capacities.txt";
    for (name, table) in [
        ("column.csv", "alfa,p\n0.1,3\n"),
        ("half.csv", "alpha,p\n0.1,\n"),
        ("name.csv", "id,alpha,p\n=a,0.1,3\n"),
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
    assert!(text.contains("  PGA/(g tan alpha)\n"), "{text}");
    fs::write(place.join("bare.txt"), "1.4\n1.8\n2.5\n").unwrap();
    let bare = json(&place, "fragility fit --sample bare.txt --im pgv");
    assert_eq!(bare["unit"], "p PGV/(g tan alpha)");
    let other = SAMPLE.replace("PGA/(g tan alpha)", "SA(1 s), g");
    fs::write(place.join("other.txt"), other).unwrap();
    let text = answer(&place, "fragility fit --sample other.txt");
    assert!(text.contains("  SA(1 s), g\n"), "{text}");
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
    for name in ["\nshifted ", "\nnot shifted "] {
        assert!(text.contains(name), "{text}");
    }
    // Both ends in 10 years; -expm1(-10 lambda) by Python.
    let ten = format!("risk --hazard hazard.csv {flags} --years 10 --json");
    let ten: Value = serde_json::from_str(&answer(&place, &ten)).unwrap();
    for (key, expected) in [
        ("probability_truncation_lower", 0.01422773191139885),
        ("probability_truncation_upper", 0.014229231373069388),
    ] {
        let found = ten["fragilities"][0][key].as_f64().unwrap();
        assert!((found / expected - 1.0).abs() < 1e-12, "{key}: {found}");
    }
}

/// A curve of OpenQuake with two sites, as in its manual.
#[test]
fn risk_reads_a_site_of_openquake_and_says_what_it_sets_aside() {
    let place = folder("openquake");
    let text = "#,,,,,\"generated_by='OpenQuake engine 3.18.0', \
        kind='mean', investigation_time=1.0, imt='PGA'\"\n\
        lon,lat,depth,poe-0.1000000,poe-0.4000000,poe-0.6000000\n\
        -0.10000,0.00000,-0.10000,4.553860E-01,5.754042E-02,0.000000E+00\n\
        0.10000,0.00000,-0.10000,1.522632E-01,0.000000E+00,0.000000E+00\n";
    fs::write(place.join("oq.csv"), text).unwrap();
    let risk = "risk --hazard oq.csv --median 0.4 --dispersion 0.5 --json";
    refused(&place, risk, "oq.csv: found 2 sites, such as");
    let site = format!("{risk} --site -0.1,0");
    let (code, out, said) = run(&place, &site);
    assert!(code == 0 && said.contains("oq.csv: 1 points"), "{said}");
    let out: Value = serde_json::from_str(&out).unwrap();
    assert_eq!((&out["im"], &out["points"]), (&"pga".into(), &2.into()));
    let remark = out["remarks"][0].as_str().unwrap();
    assert!(remark.starts_with("1 points at the end"), "{remark}");
}

/// AvgSA and ids of sites, as OpenQuake 3.26 writes them.
#[test]
fn risk_under_average_accelerations_at_a_site_with_an_id() {
    let place = folder("openquake-ids");
    let text = "#,,,,,\"generated_by='OpenQuake engine 3.26.2', \
        kind='mean', investigation_time=50.0, imt='AvgSA'\"\n\
        custom_site_id,lon,lat,depth,poe-1.00000e-01,poe-4.00000e-01\n\
        S0,23.70000,37.90000,0.00000,4.0E-01,5.0E-02\n\
        S1,23.80000,37.90000,0.00000,3.0E-01,4.0E-02\n";
    fs::write(place.join("oq.csv"), text).unwrap();
    let sample = |im: &str| {
        let values = "1.2\n1.5\n1.9\n2.2\n";
        let text = format!("# Sample of {im} at EDP inf, median crossing\n");
        fs::write(place.join("s.txt"), text + values).unwrap();
    };
    sample("AvgSA(0.5, 1 s) (g)");
    let risk = "risk --hazard oq.csv --bootstrap 20 --sample s.txt --json";
    let at = |site| run(&place, &format!("{risk} --site {site}"));
    let (code, out, said) = at("S1");
    assert_eq!(code, 0, "{said}");
    assert!(said.contains("does not state its periods"), "{said}");
    assert_eq!(out, at("23.8,37.9").1);
    assert_ne!(out, at("S0").1);
    let out: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(out["im"], "avgsa");
    // A tenth of a degree of longitude at this latitude.
    let near = format!("{risk} --site 23.81,37.9");
    refused(
        &place,
        &near,
        "found no site 23.81,37.9 among 2: the nearest one is \
         23.80000,37.90000 (S1), 0.877 km away",
    );
    sample("PGA/(g tan alpha)");
    let other = format!("{risk} --site S1");
    refused(&place, &other, "a hazard curve of avgsa: expected the same");
}

#[test]
fn risk_by_the_law_under_curves_in_sa_needs_a_stated_correlation() {
    let place = folder("sa-curves");
    for (file, period, frequency) in
        [("short.csv", "0.2", 1e-2), ("long.csv", "2.5", 5e-4)]
    {
        let text = format!(
            "#,\"investigation_time=50.0, imt='SA({period})'\"\nlon,lat,\
             poe-0.1,poe-1.0\n0,0,{},{}\n",
            -libm::expm1(-50.0 * frequency),
            -libm::expm1(-50.0 * frequency / 100.0)
        );
        fs::write(place.join(file), text).unwrap();
    }
    let risk = "risk --hazard short.csv --hazard long.csv --law --alpha 0.1 \
                --p 3";
    let found = |correlation: &str| {
        let words = format!("{risk} --json --correlation {correlation}");
        let found: Value =
            serde_json::from_str(&answer(&place, &words)).unwrap();
        assert_eq!(found["im"], "avgsa:rocking:3");
        let own = &found["fragilities"][0];
        own["annual_frequency_truncation_lower"].as_f64().unwrap()
    };
    // Perfect correlation is the upper bound.
    assert!(found("1") > 1.1 * found("0.5,0.6"));
    assert!((found("1") / found("0.5,0") - 1.0).abs() < 1e-12);
    // The coefficient of restitution of each block enters.
    let table = "id,alpha,p,eta\nshelf,0.1,3,0.85\ncase,0.1,3,\n";
    fs::write(place.join("blocks.csv"), table).unwrap();
    let export = "fragility export --law --blocks blocks.csv --format csv \
                  --out law.csv --json";
    let found: Value = serde_json::from_str(&answer(&place, export)).unwrap();
    for (row, eta) in [(0, "0.85"), (1, "0.92")] {
        let own =
            format!("fragility law --alpha 0.1 --p 3 --eta {eta} --json");
        let own: Value = serde_json::from_str(&answer(&place, &own)).unwrap();
        let own = own["fitted"]["median"].as_f64().unwrap();
        let median = found["blocks"][row]["median"].as_f64().unwrap();
        assert!((median / own - 1.0).abs() < 1e-12, "{eta}");
    }
    refused(&place, risk, "--correlation");
    let short = risk.replace("--hazard long.csv", "--correlation 1");
    refused(&place, &short, "span 0.3142 to 2.094 s");
    let other = "--median 0.2 --dispersion 0.2 --correlation 1";
    let other = risk.replace("--law --alpha 0.1 --p 3", other);
    refused(&place, &other, "a fragility in AvgSA");
}

#[test]
fn a_hazard_curve_that_is_none_is_refused_with_its_line() {
    let place = folder("hazard");
    let risk = "risk --hazard bad.csv --median 1 --dispersion 0.5";
    for (text, names) in [
        ("pga_g,annual_frequency\n0.1,0.1\n0.2,0.2\n", "bad.csv:3"),
        ("pga,rate\n0.1,0.1\n0.2,0.05\n", "pgv_cm_s"),
        ("", "bad.csv:1"),
    ] {
        fs::write(place.join("bad.csv"), text).unwrap();
        refused(&place, risk, names);
    }
    let other = "pgv_m_s,annual_frequency\n0.1,0.1\n0.2,0.05\n";
    fs::write(place.join("pgv.csv"), other).unwrap();
    for flag in ["--sample capacities.txt", "--gravity 9.8", "--id a"] {
        refused(&place, &format!("{risk} {flag}"), "cannot be used");
    }
    let risk = "risk --hazard pgv.csv --sample capacities.txt";
    refused(
        &place,
        &format!("{risk} --alpha 0.1 --p 3"),
        "hazard curve of pgv",
    );
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

/// The fenced block after a mark in the tour.
fn of_tour(mark: &str) -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/tour.md");
    let page = fs::read_to_string(path).unwrap();
    let after = page.split(mark).nth(1).expect(mark);
    let block = after.split("```").nth(1).expect("a fenced block");
    block.split_once('\n').unwrap().1.to_owned()
}

/// The tour of the docs, as it stands there, on the three recorded pairs that
/// are shipped.
#[test]
fn the_tour_runs() {
    let place = folder("tour");
    let shipped = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../fixtures/records/ridgecrest.zip"
    );
    fs::copy(shipped, place.join("records.zip")).unwrap();
    for name in ["objects.csv", "hazard.csv"] {
        let text = of_tour(&format!("<!-- tour: {name} -->"));
        fs::write(place.join(name), text).unwrap();
    }
    let tour = of_tour("<!-- tour -->");
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
    for words in ["Friction  Analyses", "delta", "at least", "SA(1 s)"] {
        assert!(said.contains(words), "no `{words}` in {said}");
    }
    for (name, lines) in [("cabinet-band.csv", 26), ("fragility.csv", 4)] {
        let text = fs::read_to_string(place.join(name)).unwrap();
        assert_eq!(text.lines().count(), lines, "{name}");
    }
    let nrml = fs::read_to_string(place.join("objects.xml")).unwrap();
    assert_eq!(nrml.matches("<fragilityFunction ").count(), 3);
}
