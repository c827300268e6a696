//! `rocking validate`: fates made of a block by a rule give the block back,
//! and every fault of a table is named with its line.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use libm::{exp, log, tan};
use rocking_common::files::is_whole;
use rocking_common::table::columns::COMPARED_TESTS;
use serde_json::Value;

use crate::compare::near;
use crate::support::{
    Place, answer, at2, folder, json, motion, refused, refused_with, run,
};

const ALPHA: f64 = 0.1;

/// Levels of the tests of a motion over the capacity of the specimen, as
/// logarithms: alike on both sides.
const LEVELS: [f64; 6] = [-0.8, -0.45, -0.15, 0.15, 0.45, 0.8];

/// Capacities of the specimen over those of the block, as logarithms: alike
/// on both sides, so that their median is 1.
const SCATTER: [f64; 9] =
    [-0.4, -0.28, -0.17, -0.08, 0.0, 0.08, 0.17, 0.28, 0.4];

/// Motions, and a table of tests of a specimen whose capacities are those of
/// the block, by another command, times `bias` and the scatter.
fn scene(name: &str, bias: f64) -> Place {
    let place = folder(name, &[]);
    fs::create_dir(place.join("m")).unwrap();
    let mut pga_g = Vec::new();
    for k in 0..SCATTER.len() {
        let samples = motion(3.0 + 1.3 * k as f64);
        pga_g.push(samples.iter().fold(0.0, |m: f64, a| m.max(a.abs())));
        let text = at2("0.02", samples.len(), &samples);
        fs::write(place.join(format!("m/r{k}.at2")), text).unwrap();
    }
    let block = format!("--alpha {ALPHA} --p 3");
    answer(
        &place,
        &format!(
            "ida {block} --suite m --step-im 0.1 --refine 1e-6 --out i.csv"
        ),
    );
    answer(&place, "capacities --ida i.csv --at inf --out c.txt");
    let capacities = fs::read_to_string(place.join("c.txt")).unwrap();
    let mut table = String::from("file,name,motion,scale,fell\n");
    let rows = capacities.lines().filter(|line| !line.starts_with('#'));
    let mut count = 0;
    for (line, scatter) in rows.zip(SCATTER) {
        let (im, record) = line.split_once(" # ").unwrap();
        let k: usize = record.trim_start_matches('r').parse().unwrap();
        let im: f64 = im.parse().unwrap();
        // The factor on the record at which the block overturns.
        let factor = im * tan(ALPHA) / pga_g[k];
        for (level, ratio) in LEVELS.iter().enumerate() {
            let scale = factor * bias * exp(scatter + ratio);
            let fell = u8::from(*ratio > 0.0);
            let file = format!("m/{record}.at2,{record}-{level},{record}");
            writeln!(table, "{file},{scale},{fell}").unwrap();
            count += 1;
        }
    }
    assert_eq!(count, LEVELS.len() * SCATTER.len());
    table += "m/r0.at2,lost,r0,1,\n";
    fs::write(place.join("tests.csv"), table).unwrap();
    place
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// Share of tests in which the block, whose capacity is 1/(bias exp(scatter))
/// of the specimen's, has the fate of the specimen.
fn right(bias: f64) -> f64 {
    let each = SCATTER.iter().flat_map(|s| LEVELS.map(|level| (s, level)));
    let is_right = |&(scatter, level): &(&f64, f64)| {
        (level + scatter + log(bias) >= 0.0) == (level > 0.0)
    };
    each.filter(is_right).count() as f64
        / (SCATTER.len() * LEVELS.len()) as f64
}

const VALIDATE: &str = "validate tests.csv --fate fell --bootstrap 50";

#[test]
fn fates_of_a_block_give_its_bias_and_its_slenderness() {
    for bias in [1.0, 1.35] {
        let place = scene("validate-known", bias);
        let words = format!("{VALIDATE} --alpha {ALPHA} --p 3");
        let found = json(&place, &words);
        let count = SCATTER.len() * LEVELS.len();
        assert_eq!(found["tests"], count);
        assert_eq!(found["motions"], SCATTER.len());
        assert_eq!(found["overturned"], count / 2);
        assert_eq!(found["unknown"], 1);
        // The likelihood has the symmetry of levels and scatter.
        let median = number(&found["computed"]["median"]["point"]);
        near("bias", median, bias, 1e-3);
        let share = number(&found["computed"]["right"]["point"]);
        near("right", share, right(bias), 1e-12);
        assert!(share < 1.0);
    }
    let place = scene("validate-fitted", 1.0);
    let found = json(&place, &format!("{VALIDATE} --p 3"));
    assert_eq!(found["alpha_is_fitted"], true);
    let alpha = number(&found["alpha_rad"]["point"]);
    near("alpha", alpha, ALPHA, 2e-3 * ALPHA);
}

#[test]
fn the_folder_holds_a_page_and_its_numbers() {
    let place = scene("validate-page", 1.35);
    let words = format!("{VALIDATE} --alpha {ALPHA} --p 3 --out page");
    let found = json(&place, &words);
    let folder = place.join("page");
    let read = |name: &str| fs::read_to_string(folder.join(name)).unwrap();
    assert!(is_whole(&folder).unwrap());
    let page = read("index.html");
    assert_eq!(page.matches("<svg").count(), 3);
    let share = 100.0 * number(&found["computed"]["right"]["point"]);
    assert!(page.contains(&format!("predicts {share:.1} % (")), "{page}");
    assert!(page.contains("on the safe side"), "{page}");
    let kept: Value = serde_json::from_str(&read("tests.json")).unwrap();
    assert_eq!(kept["computed"], found["computed"]);
    assert_eq!(kept["each"], found["each"]);
    let table = read("tests.csv");
    let head: Vec<&str> = COMPARED_TESTS.names().collect();
    assert_eq!(table.lines().next().unwrap(), head.join(","));
    assert_eq!(table.lines().count(), 1 + SCATTER.len() * LEVELS.len());
    // The folder is not empty now.
    let (status, _, error) = run(&place, &words);
    assert_eq!(status, 2, "{error}");
}

/// Refuses the table, and has these words in its message.
fn faults(place: &Path, table: &str, flags: &str, expected: &[&str]) {
    fs::write(place.join("faulty.csv"), table).unwrap();
    let words = format!("validate faulty.csv --alpha 0.1 --p 3 {flags}");
    let error = refused(place, &words);
    assert_eq!(error.lines().count(), expected.len(), "{error}");
    for words in expected {
        assert!(error.contains(words), "no {words} in {error}");
    }
}

#[test]
fn every_fault_of_a_table_is_named_with_its_line() {
    let text = at2("0.02", 150, &motion(5.0));
    let place = folder("validate-faults", &[("a.at2", &text)]);
    faults(
        &place,
        "file,name,event,scale,fate\n\
         a.at2,a,A,1,overturned\n\
         a.at2,b,A,1,fell\n\
         a.at2,c,A,-2,stood\n\
         b.at2,d,A,1,1\n\
         a.at2,a,A,1,0\n\
         a.at2,f,A,x,2\n",
        "",
        &[
            "faulty.csv:3: column fate: found \"fell\": expected overturned",
            "faulty.csv:4: column scale: found \"-2\": expected a positive",
            "b.at2",
            "faulty.csv:6: test \"a\" is also on line 2",
            "faulty.csv:7: column fate: found \"2\"",
            "faulty.csv:7: column scale: found \"x\"",
        ],
    );
    faults(
        &place,
        "file,fate\na.at2,1\n",
        "--fate fell",
        &["no column \"fell\"", "no column \"event\""],
    );
    faults(
        &place,
        "file,motion,fate\na.at2,,1\n",
        "",
        &["faulty.csv:2: column motion: found \"\""],
    );
    faults(
        &place,
        "file,motion,event,fate\na.at2,A,B,1\n",
        "",
        &["faulty.csv:2: column motion: found \"A\""],
    );
    let one = "file,motion,fate\na.at2,A,1\n";
    fs::write(place.join("one.csv"), one).unwrap();
    for (flags, words) in [
        ("", "expected --alpha and --p, or --width-m and --height-m"),
        ("--p 3 --eta housner", "--eta housner: alpha is fitted"),
        ("--alpha 0.1 --p 3", "1 motions of 1 tests"),
    ] {
        refused_with(&place, &format!("validate one.csv {flags}"), words);
    }
}

/// The table that the documentation shows lacks nothing but its motions.
#[test]
fn the_table_of_the_documentation_is_one() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let page = Path::new(root).join("docs/tests.md");
    let page = fs::read_to_string(page).unwrap();
    let (_, table) = page.split_once("```csv\n").unwrap();
    let (table, _) = table.split_once("```").unwrap();
    let samples: String =
        motion(5.0).iter().map(|a| format!("{a}\n")).collect();
    let place = folder("validate-docs", &[("t.csv", table)]);
    for k in 1..5 {
        fs::write(place.join(format!("run-0{k}.txt")), &samples).unwrap();
    }
    let words = "validate t.csv --alpha 0.1 --p 3";
    refused_with(&place, words, "2 motions of 4 tests: expected at least 3");
}
