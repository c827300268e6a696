//! Tests of the study as a whole, on the first motions of the embedded
//! suites.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use indicatif::ProgressBar;
use rocking::block::Restitution;
use rocking::integrator::Overturning;
use rocking_records::{Processing, ReadOptions, SetAside};
use rocking_statistics::Clusters;
use rocking_statistics::resampling::FEWEST_DRAWS;

use crate::answers;
use crate::basis::{self, FindingSets};
use crate::credibility::assessment;
use crate::evidence::{NOT_RUN, Proof};
use crate::findings;
use crate::head::{self, Signatures};
use crate::ledger::requirements;
use crate::output::{self, FINDINGS, Files};
use crate::page::limits_of;
use crate::quantity::effect_text;
use crate::words::words;
use rocking_common::curves::Execution;
use rocking_common::files::SUMS;
use rocking_common::findings::{Findings, Kind, SuiteSet, Topic};
use rocking_common::paper::{Arm, SuiteKind};
use rocking_common::suites::inputs::{read_suite, sha256_hex};
use rocking_common::suites::{StudySuite, SuiteSource};
use rocking_proof::cases::load_all;
use rocking_study::Study;
use rocking_study::analyses::{Plan, SuiteResults};
use rocking_study::certainty::Certainty;
use rocking_study::findings::set_aside as findings_of;
use rocking_study::results::StudyResults;
use rocking_study::runs::{ChainWork, Setup};

/// The findings of the committed report.
pub fn committed() -> Findings {
    let path = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/../../reports/data/findings.json"
    );
    let text = std::fs::read_to_string(path).expect("findings");
    Findings::parse(&text).expect("form")
}

/// The plan whose settings kept results have.
fn plan() -> Plan {
    let setup = Setup {
        restitution: Restitution::constant(0.92).expect("restitution"),
        overturning: Overturning::Alpha,
        tolerance: 1e-4,
        way: Execution::default(),
    };
    let arms = vec![Arm::A, Arm::B, Arm::C];
    Plan { setup, arms, full: false, replicates: FEWEST_DRAWS }
}

/// Results of nothing on the embedded suites.
pub fn on_embedded_suites() -> StudyResults {
    empty(&SuiteSource::Embedded { streams: "x" })
}

/// Results of nothing, on two suites from there.
fn empty(source: &SuiteSource) -> StudyResults {
    let suite = |kind| SuiteResults {
        kind,
        source: source.clone(),
        component_rule: String::new(),
        remarks: None,
        set_aside: SetAside::default(),
        sha256: String::new(),
        work: ChainWork { analyses: 0, certainty: Certainty::default() },
        records: Vec::new(),
        clusters: Clusters::singletons(0),
        list: Vec::new(),
        chosen: [0; 3],
        arms: Vec::new(),
        distributions: Vec::new(),
        single: Vec::new(),
        stripes: Vec::new(),
        adjusted: Vec::new(),
    };
    StudyResults {
        plan: plan(),
        ordinary: suite(SuiteKind::Ordinary),
        pulse: suite(SuiteKind::PulseType),
        varied: Vec::new(),
    }
}

/// Where the page of a study comes from.
fn inputs(results: &StudyResults, proved: bool) -> Vec<(String, String)> {
    let found = basis::recorded();
    let basis = FindingSets::of(results.embedded(), &found).expect("basis");
    head::inputs(results, proved, &Signatures::default(), &basis)
}

/// The command that makes its page again.
fn command(results: &StudyResults, proved: bool) -> String {
    let mut rows = inputs(results, proved).into_iter();
    rows.find(|(name, _)| name == "Command").expect("a command").1
}

/// What is set aside in a folder of a record and a note.
fn set_aside() -> SetAside {
    let folder = tempfile::tempdir().expect("folder");
    let write = |name: &str, text: &str| {
        std::fs::write(folder.path().join(name), text).expect("write");
    };
    write("a.csv", "t_s,a_g\n0,0\n0.1,0.2\n0.2,0\n");
    write("<notes>.txt", "About these records.\n");
    let read = ReadOptions::default();
    let suite = read_suite(folder.path(), read).expect("suite");
    suite.set_aside().clone()
}

#[test]
fn what_a_suite_sets_aside_is_under_provenance_and_in_the_findings() {
    let mut results = on_embedded_suites();
    let shown = |results: &StudyResults| {
        let mut rows = inputs(results, false);
        rows.retain(|row| row.0.contains("aside"));
        rows
    };
    assert_eq!(shown(&results), []);
    results.pulse.set_aside = set_aside();
    let words = "1 in no known format (first: <notes>.txt)";
    assert_eq!(
        shown(&results),
        [("Set aside, pulse-type suite".to_owned(), words.to_owned())]
    );
    let found = findings_of(&results.pulse.set_aside);
    let expected = serde_json::json!([
        {"code": "format", "files": 1, "first": "<notes>.txt"}
    ]);
    assert_eq!(serde_json::to_value(&found).expect("JSON"), expected);
}

/// A name that a page must not take for its own.
const HOSTILE: &str = "</text><script>alert(1)</script><a onload='b()' \"&lt;";

/// Files of a study of a few records, and what the terminal answers.
fn small(plan: Plan, proof: Option<&Proof>) -> (Files, String) {
    static SUITES: LazyLock<[StudySuite; 2]> =
        LazyLock::new(|| StudySuite::embedded().expect("suites"));
    let [mut ordinary, mut pulse] = SUITES.clone();
    for (suite, records) in [(&mut ordinary, 10), (&mut pulse, 4)] {
        suite.motions.truncate(records);
        for motion in &mut suite.motions {
            let name = format!("{HOSTILE}{}", motion.study.name());
            motion.study = motion.study.clone().named(name).expect("a name");
        }
        suite.clusters = Clusters::singletons(records);
    }
    let progress = ProgressBar::hidden();
    let study = Study::run(plan, &[ordinary, pulse], &progress, &|_| ());
    let study = study.expect("study");
    let signatures = Signatures::default();
    let files = output::files(&study, proof, &signatures, false);
    let answers = output::answers_text(&study, proof);
    (files.expect("report"), answers.expect("answers"))
}

/// The text of a page: without tags, entities and joined words.
fn text(page: &str) -> String {
    let mut text = String::new();
    for part in page.split('<') {
        let (_, words) = part.split_once('>').unwrap_or_default();
        text += words;
        text += "\n";
    }
    let text = text.replace("&lt;", "<").replace("&gt;", ">");
    let text = text.replace("&quot;", "\"").replace("&amp;", "&");
    text.replace('\u{a0}', " ").replace('\u{2060}', "")
}

/// What the terminal answers stands on the page, line by line.
fn answer_alike(page: &str, terminal: &str) {
    let page = text(page);
    assert!(terminal.lines().count() > 20, "{terminal}");
    for line in terminal.lines() {
        let line = line.trim();
        let without = line.strip_suffix('.').unwrap_or(line);
        assert!(page.contains(without), "not on the page: {line}");
    }
}

/// Everything that is said of where the records come from.
fn said_of(source: &SuiteSource) -> String {
    let results = empty(source);
    let limits = limits_of(&results).concat();
    let words = words().expect("words");
    let mut found = basis::recorded();
    found.settings = results.plan.settings();
    let basis = FindingSets::of(results.embedded(), &found).expect("basis");
    let table = assessment(&results, None, &basis, &words).table();
    let cells: String = table.rows.into_iter().flatten().collect();
    limits + &answers::not_run(&basis) + &cells
}

#[test]
fn what_is_said_of_the_suites_follows_from_their_source_not_their_name() {
    let named = |name: &str| SuiteSource::Files {
        name: name.into(),
        processing: Processing::default(),
    };
    let own = said_of(&named("my-synthetic"));
    assert!(own.contains("Suites given by the user"), "{own}");
    assert!(!own.contains("ynthetic"), "{own}");
    // The words in which the embedded suites are named.
    assert_eq!(own, said_of(&named("embedded synthetic suite, streams x")));
    let embedded = said_of(&SuiteSource::Embedded { streams: "x" });
    assert!(
        embedded.contains("Synthetic suites from published"),
        "{embedded}"
    );
    assert!(embedded.contains("The embedded suites are synthetic"));
    assert!(embedded.contains("their results are stored"));
}

#[test]
fn verification_is_claimed_only_if_every_case_passes() {
    let results = on_embedded_suites();
    let words = words().expect("words");
    let found = basis::recorded();
    let basis = FindingSets::of(true, &found).expect("basis");
    let row = |proof: Option<&Proof>| {
        let rows = assessment(&results, proof, &basis, &words).table().rows;
        rows.into_iter().find(|row| row[0] == "Verification").expect("a row")
    };
    assert_eq!(row(None)[1], "0");
    assert_eq!(row(Some(&Proof::committed(0)))[1], "3");
    let red = row(Some(&Proof::committed(1)));
    assert_eq!(red[1], "0");
    assert!(red[2].starts_with("1 of "), "{red:?}");
}

#[test]
fn the_command_names_the_proof_only_where_one_was_handed_in() {
    let results = on_embedded_suites();
    let plain = command(&results, false);
    assert!(!plain.contains("--proof"), "{plain}");
    assert!(!plain.contains("rocking verify"), "{plain}");
    assert!(command(&results, true).contains("--proof FOLDER/data"));
}

#[test]
fn the_command_says_that_other_choices_ran_on_all_blocks() {
    let mut results = on_embedded_suites();
    for full in [false, true] {
        results.plan.full = full;
        let command = command(&results, false);
        assert_eq!(command.contains("--full"), full, "{command}");
    }
}

#[test]
fn identities_and_descriptions_are_counted_apart() {
    let here = basis::recorded();
    let count = |kind| here.claims.iter().filter(|c| c.kind == kind).count();
    let (identities, descriptions) =
        (count(Kind::Identity), count(Kind::Description));
    assert!(identities > 0 && descriptions > 0);
    let table = findings::identities(&here);
    assert_eq!(table.rows.len(), identities + descriptions);
    let said = &table.reading;
    assert!(said.starts_with(&format!("{identities} of these statements")));
    // A description could come out either way.
    let other = format!("{descriptions} could be true or false");
    assert!(said.contains(&other), "{said}");
}

#[test]
fn no_claim_names_a_restitution_that_a_run_may_not_have() {
    // --eta 0.90 measures against 0.90.
    for declaration in rocking_study::claims::declared() {
        let claim = &declaration.claim;
        assert!(!claim.measure.contains("0.92"), "{}", claim.id);
    }
}

/// Values with their intervals, numbers of analyses, hashes of suites.
fn numbers(findings: &Findings) -> BTreeSet<String> {
    let claims = findings.claims.iter();
    let results = claims.flat_map(|c| c.results.iter().map(move |r| (c, r)));
    let bounded = results.filter(|(_, r)| r.estimate.interval().is_some());
    let texts = bounded.map(|(c, r)| effect_text(c, r).whole());
    let suites = findings.suites.iter();
    let suites =
        suites.flat_map(|s| [s.analyses.to_string(), s.sha256.clone()]);
    texts.chain(suites).filter(|text| text.len() > 5).collect()
}

/// How many of the numbers a text shows.
fn shown_of(numbers: &BTreeSet<String>, text: &str) -> usize {
    numbers.iter().filter(|number| text.contains(*number)).count()
}

/// The caption of Figure 18 quotes the distances that its claim uses.
fn figure_18_is_about_its_claim(found: &Findings, page: &str) {
    let page = text(page);
    let claim = found.claims.iter().find(|c| c.id == "low-c-helps");
    let gain = claim
        .expect("a claim")
        .results
        .iter()
        .find(|r| r.suite == SuiteSet::Ordinary && r.arm == Some(Arm::C));
    let start = "between USFL7 and the SSFL for c = 0.25, 0.5, 0.75, 1: \
                 untrimmed ";
    // Kept captions are renewed with the kept results.
    let caption = page.rsplit_once(start).expect("a caption").1;
    let distances: Vec<f64> = caption
        .split([',', ';'])
        .take(4)
        .map(|word| word.trim().parse().expect("a number"))
        .collect();
    // The claim: by how much c = 1 is further off than c = 0.25.
    let apart =
        distances[3] - distances[0] - gain.expect("a result").estimate.value();
    assert!(apart.abs() <= 0.001, "{distances:?}");
}

#[test]
fn a_report_has_its_proof_its_names_and_its_files() {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reports/data");
    let proof = Proof::read(data.as_ref()).expect("proof");
    let (mut one, said) = small(plan(), Some(&proof));
    assert!(one.contains_key("data/ledger.csv"));
    assert!(one.remove(SUMS).is_some());
    let page = one.remove("index.html").expect("page");
    let page = String::from_utf8(page).expect("text");
    answer_alike(&page, &said);
    assert!(shown_of(&numbers(&basis::recorded()), &text(&page)) > 100);
    // Names of records stand on the page and in the drawings, as text.
    let drawings = one.iter().filter(|(name, _)| name.ends_with(".svg"));
    let drawings = drawings.map(|(_, svg)| String::from_utf8_lossy(svg));
    let all: String = drawings.chain([page.as_str().into()]).collect();
    assert!(page.contains("&lt;script&gt;alert(1)"), "no record is named");
    for word in ["<script", "</text><", "<a onload", "\"&lt;\""] {
        assert!(!all.contains(word), "{word}");
    }
    // The first case is named by an identity of the paper.
    let cases = load_all().expect("cases");
    let (id, table) = (&cases[cases.len() - 1].id, "table-precision");
    assert!(page.contains(&proof.to_string()) && !page.contains(NOT_RUN));
    assert!(page.contains(id) && page.contains(table));
    // Each data file stands on the page with its hash, but for the page.
    for (name, content) in one.iter().filter(|(n, _)| n.starts_with("data/")) {
        let hash = sha256_hex(content);
        assert!(page.contains(name) && page.contains(&hash), "{name}");
    }
    assert!(page.contains("data/verification.json"));
    // Every figure with its numbers, the findings, Table 1 and the page.
    for number in 1..=18 {
        for (folder, suffix) in [("figures", "svg"), ("data", "csv")] {
            let stem = format!("{folder}/figure-{number:02}");
            let found = one
                .keys()
                .any(|name| name.starts_with(&stem) && name.ends_with(suffix));
            assert!(found, "{stem}: no {suffix}");
        }
    }
    let recorded = "data/figure-15-recorded.csv";
    for name in [FINDINGS, "data/table-01.csv", recorded] {
        assert!(one.contains_key(name), "{name}");
    }
    // Recorded ones first, the same of embedded motions folded; no history.
    let at = |words: &str| page.find(words).expect(words);
    assert!(at("Figure 15, recorded") < at("Show: Figure 15, embedded"));
    assert!(page.contains("Figure 2, embedded motions"));
    assert!(!page.contains("Figure 2, recorded"));
    let text = String::from_utf8(one[FINDINGS].clone()).expect("text");
    let findings = Findings::parse(&text).expect("findings");
    assert_eq!(findings.text(), text);
    figure_18_is_about_its_claim(&findings, &page);
    // Every finding has results, and each a number for each yardstick.
    for claim in &findings.claims {
        let finding = claim.kind == Kind::Finding;
        assert_eq!(claim.results.is_empty(), !finding, "{}", claim.id);
        for result in &claim.results {
            let (found, all) = (result.counts.len(), claim.yardsticks.len());
            assert_eq!(found, all, "{}, {}", claim.id, result.place());
        }
    }
    // An identity names a case that there is.
    let cases = load_all().expect("cases");
    for claim in findings.claims.iter().filter(|c| c.kind == Kind::Identity) {
        let declared = cases.iter().any(|case| case.id == claim.case);
        assert!(declared, "{}: {}", claim.id, claim.case);
    }
    // Ten records, all above 0.14 g: none fails to lift alpha = 0.10.
    let uplift = findings.table(Topic::UpliftUnscaled).expect("table");
    assert_eq!(uplift.rows[1].values[0].value(), 10.0);
    // The ledger names what was measured, and all of it.
    let keys: Vec<&str> =
        findings.claims.iter().map(|claim| claim.id.as_str()).collect();
    let named: Vec<String> = requirements()
        .expect("ledger")
        .into_iter()
        .flat_map(|requirement| requirement.findings)
        .collect();
    for name in &named {
        let measured = keys.contains(&name.as_str());
        assert!(measured, "the ledger names {name}, which is no claim");
    }
    for key in &keys {
        let listed = named.iter().any(|name| name == key);
        assert!(listed, "the ledger does not name {key}");
    }
    for table in ["ledger", "credibility-assessment"] {
        assert!(page.contains(&format!("<div id=\"{table}\">")), "{table}");
    }
}

#[test]
fn a_run_of_other_settings_shows_no_kept_number_and_leads_with_its_own() {
    let mut other = plan();
    other.setup.restitution =
        Restitution::constant(0.90).expect("restitution");
    other.arms = vec![Arm::A];
    let (files, said) = small(other, None);
    let page = String::from_utf8_lossy(&files["index.html"]).into_owned();
    answer_alike(&page, &said);
    // No proof was handed in.
    let cases = load_all().expect("cases");
    let (id, table) = (&cases[cases.len() - 1].id, "table-precision");
    assert!(page.contains(NOT_RUN) && !page.contains("cases pass"));
    assert!(!page.contains(id) && !page.contains(table));
    let shown = text(&page);
    let left_out = "Results on recorded motions are stored only for other \
                    settings (grids A, B, C, not A; eta 0.92, not 0.9); they \
                    are left out.";
    assert_eq!(shown.matches(left_out).count(), 1, "said once");
    assert!(said.contains(left_out), "{said}");
    for words in
        ["ecorded, stored", "ecorded, repeatable", "recorded motions, 86"]
    {
        assert!(!shown.contains(words), "{words}");
    }
    let recorded = files.keys().find(|name| name.contains("-recorded"));
    assert_eq!(recorded, None);
    // Each but what this run happens to have as well.
    let own = String::from_utf8_lossy(&files[FINDINGS]);
    let own = numbers(&Findings::parse(&own).expect("findings"));
    assert!(shown_of(&own, &shown) > 20);
    // A kept number of few digits may equal one of this run.
    let kept = numbers(&basis::recorded());
    let kept: Vec<&String> = kept.difference(&own).collect();
    let on_page = kept.iter().filter(|number| shown.contains(**number));
    let on_page: Vec<_> = on_page.collect();
    assert!(kept.len() > 100 && on_page.len() < 2, "{on_page:?}");
    // Kept capacities of the comparison of suites are left out as well.
    let compared = String::from_utf8_lossy(&files["data/suites.csv"]);
    assert!(compared.contains(",motion,"));
    assert!(!compared.contains(",capacity,"), "kept capacities");
}
