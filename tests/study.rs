//! What `rocking study` refuses, that it then leaves nothing behind, and
//! what of the committed report can be held without a study.

use std::path::PathBuf;

use rocking_common::files::SUMS;
use rocking_common::suites::StudySuite;
use rocking_common::suites::inputs::sha256_hex;
use rocking_report::evidence::{Proof, charts};
use rocking_report::output;
use serde_json::Value;

use super::support;

fn folder(name: &str) -> PathBuf {
    let own = format!("rocking-study-{name}-{}", std::process::id());
    std::env::temp_dir().join(own)
}

#[track_caller]
fn refused(name: &str, args: &[&str], words: &[&str]) {
    let folder = folder(name);
    std::fs::create_dir_all(&folder).expect("folder");
    let command = format!("study {}", args.join(" "));
    let message = support::refused(&folder, &command);
    for word in words {
        assert!(message.contains(word), "{word:?} not in {message:?}");
    }
    std::fs::remove_dir_all(&folder).expect("clean");
}

#[test]
fn options_out_of_range() {
    refused("arms", &["--arms", "B"], &["A or C"]);
    refused("criterion", &["--overturn", "beta"], &["beta"]);
}

#[test]
fn one_suite_without_the_other() {
    refused("one", &["--ordinary", "x"], &["--pulse"]);
}

#[test]
fn suites_that_cannot_be_read() {
    let args = ["--ordinary", "absent", "--pulse", "absent"];
    refused("absent", &args, &["absent"]);
    let folder = folder("cut");
    let input = folder.join("input");
    std::fs::create_dir_all(&input).expect("folder");
    std::fs::write(
        input.join("cut.AT2"),
        "PEER\nEVENT\nACCELERATION IN UNITS OF G\nNPTS= 4, DT= .01 SEC\n \
         .1 .2 .3\n",
    )
    .expect("file");
    let args = ["--ordinary", "input", "--pulse", "input"];
    refused("cut", &args, &["cut.AT2", "4"]);
}

#[test]
fn a_file_in_the_way_of_the_report() {
    let args = ["--out", "input"];
    let folder = folder("way");
    std::fs::create_dir_all(&folder).expect("folder");
    std::fs::write(folder.join("input"), "mine").expect("file");
    refused("way", &args, &["input"]);
}

/// A page and findings that no study wrote are nobody's to replace.
#[test]
fn a_folder_that_no_study_wrote() {
    let args = ["--arms", "A", "--out", "input"];
    for (files, words) in [
        (&["index.html", "data/findings.json"][..], "data/findings.json"),
        (&["data/mine.csv", "data/verification.json"], "data/mine.csv"),
        (&["figures/mine.svg"], "figures"),
        (&["notes.txt"], "notes.txt"),
    ] {
        let folder = folder("stranger");
        let input = folder.join("input");
        for file in files {
            let path = input.join(file);
            std::fs::create_dir_all(path.parent().expect("parent"))
                .expect("folder");
            std::fs::write(path, "mine\n").expect("write");
        }
        let words =
            format!("cannot write input: it contains {words}, which no");
        refused("stranger", &args, &[&words]);
    }
}

/// That of an earlier study is replaced, and one with results of the declared
/// cases alone becomes a report; a page of somebody else stays one.
#[test]
fn a_folder_of_an_earlier_study_is_known() {
    let reports =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../reports");
    assert_eq!(output::foreign(&reports), None);
    let own = folder("earlier");
    assert_eq!(output::foreign(&own), None, "not there");
    std::fs::create_dir_all(own.join("data")).expect("folder");
    assert_eq!(output::foreign(&own), None, "empty");
    let copy = |name: &str| {
        std::fs::copy(reports.join(name), own.join(name)).expect("copy");
    };
    copy("data/verification.json");
    assert_eq!(output::foreign(&own), None, "declared cases alone");
    copy(output::FINDINGS);
    std::fs::write(own.join("notes.txt"), "mine").expect("write");
    assert_eq!(output::foreign(&own), None, "killed before the page");
    copy(output::PAGE);
    assert_eq!(output::foreign(&own), None);
    std::fs::write(own.join(output::PAGE), "<html>mine").expect("write");
    assert_eq!(output::foreign(&own).as_deref(), Some(output::PAGE));
    std::fs::remove_dir_all(&own).expect("clean");
}

/// Results of the declared cases in `input`, after a change of their text.
fn proof(name: &str, change: impl Fn(&str) -> String) {
    let input = folder(name).join("input");
    std::fs::create_dir_all(&input).expect("folder");
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reports/data");
    for file in ["verification.json", "precision.csv"] {
        let path = PathBuf::from(data).join(file);
        let text = std::fs::read_to_string(path).expect("read");
        std::fs::write(input.join(file), change(&text)).expect("write");
    }
}

#[test]
fn results_of_cases_that_are_missing_damaged_or_of_others() {
    let args = ["--proof", "absent"];
    refused("no-proof", &args, &["absent", "verification.json", "verify"]);
    let args = ["--proof", "input"];
    proof("cut-proof", |text| text[..text.len() / 2].into());
    refused("cut-proof", &args, &["verification.json"]);
    let renamed = |text: &str| {
        text.replace("\"hard-cases/hs-graze-0.001\"", "\"hard-cases/other\"")
    };
    proof("other-proof", renamed);
    let ids =
        ["Missing: hard-cases/hs-graze-0.001. Unknown: hard-cases/other"];
    refused("other-proof", &args, &ids);
}

/// What of the committed report costs no study: suites, declared cases and
/// the figures of closed forms. `.ci/run` holds every byte of the
/// report, by `rocking study --out reports --check` of the release build.
#[test]
fn the_committed_report_is_of_this_program_where_that_is_cheap() {
    let reports =
        PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../reports");
    let read = |name: &str| {
        std::fs::read_to_string(reports.join(name)).expect("read")
    };
    let findings: Value =
        serde_json::from_str(&read(output::FINDINGS)).expect("JSON");
    let suites = StudySuite::embedded().expect("suites");
    for (k, suite) in suites.iter().enumerate() {
        let found = &findings["suites"][k];
        assert_eq!(found["sha256"], suite.sha256(), "{}", suite.kind);
        assert_eq!(found["source"], suite.source.to_string());
    }
    // As many results as declared cases: or they are refused.
    let proof = Proof::read(&reports.join("data")).expect("proof");
    assert_eq!(proof.passed(), proof.results().len());
    let (page, manifest) = (read("index.html"), read(SUMS));
    assert!(page.contains(&proof.to_string()), "the page has other cases");
    for chart in charts().expect("charts") {
        let name = &chart.heading.name;
        let hash = sha256_hex(chart.svg().as_bytes());
        let line = format!("{hash}  figures/{name}.svg\n");
        assert!(manifest.contains(&line), "{name}");
        assert!(read(&format!("data/{name}.csv")) == chart.csv());
    }
}
