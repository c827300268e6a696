//! Where the page comes from: which program ran on what, and who signs for
//! it.

use crate::basis::{FindingColumn, FindingSets, REPEATABLE};
use rocking::integrator::Overturning;
use rocking_common::findings::SuiteSummary;
use rocking_common::suites::inputs::sha256_hex;
use rocking_common::words::capital;
use rocking_study::kept::REPEAT;
use rocking_study::results::StudyResults;

/// The versions of everything that the program is built from.
const LOCK: &str = include_str!(env!("ROCKING_LOCK"));

/// Who signs for a report, and when it was issued: words of the user, since
/// the program knows no clock and no names.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Signatures {
    /// Date of issue, as it should appear on the page.
    #[arg(long, value_name = "DATE")]
    pub issued: Option<String>,
    /// Name of the preparer; if omitted, the page has a signature line.
    #[arg(long, value_name = "NAME")]
    pub prepared_by: Option<String>,
    /// Name of the reviewer; if omitted, the page has a signature line.
    #[arg(long, value_name = "NAME")]
    pub reviewed_by: Option<String>,
    /// Name of the approver; if omitted, the page has a signature line.
    #[arg(long, value_name = "NAME")]
    pub approved_by: Option<String>,
    /// The commit of the program, which an issued copy names.
    #[arg(skip)]
    pub commit: &'static str,
}

impl Signatures {
    /// What is signed for, and by whom or when if that was given.
    pub(crate) fn lines(&self) -> [(&'static str, Option<&str>); 4] {
        [
            ("Issued", self.issued.as_deref()),
            ("Prepared by", self.prepared_by.as_deref()),
            ("Reviewed by", self.reviewed_by.as_deref()),
            ("Approved by", self.approved_by.as_deref()),
        ]
    }
}

/// The program, its input, the command and the kept results of recorded
/// suites, by name; `proved`: whether results of the declared cases were
/// handed in.
pub(crate) fn inputs(
    results: &StudyResults,
    proved: bool,
    signatures: &Signatures,
    basis: &FindingSets<'_>,
) -> Vec<(String, String)> {
    let mut rows = program(results, proved, signatures);
    rows.extend(basis.recorded().flat_map(kept));
    rows.extend(provenance(results));
    rows
}

/// The program, its input and the command. A committed page cannot name the commit that holds
/// it, so the commit stands on issued copies alone.
fn program(
    results: &StudyResults,
    proved: bool,
    signatures: &Signatures,
) -> Vec<(String, String)> {
    let commit = match signatures.issued {
        Some(_) => signatures.commit,
        None => {
            "the commit that contains this page; a copy made with --issued names it"
        }
    };
    let program = format!(
        "rocking {}, sha256 of Cargo.lock {}",
        env!("CARGO_PKG_VERSION"),
        sha256_hex(LOCK.as_bytes())
    );
    let [ordinary, pulse] = results.suites().map(|suite| {
        let (records, sha256) = (suite.records.len(), &suite.sha256);
        let from = &suite.source;
        (
            format!("Suite, {}", suite.kind),
            format!("{from}, {records} records, sha256 {sha256}"),
        )
    });
    vec![
        ("Program".into(), program),
        ("Commit".into(), commit.into()),
        ordinary,
        pulse,
        ("Command".into(), command(results, proved)),
    ]
}

/// Where the numbers of recorded suites come from.
fn kept(
    (name, found): FindingColumn<'_>,
) -> impl Iterator<Item = (String, String)> {
    let how = match name {
        REPEATABLE => format!("stored results; `{REPEAT}` repeats them"),
        _ => "stored results, not run here".to_owned(),
    };
    let row = move |suite: &SuiteSummary| {
        let SuiteSummary { records, sha256, kind, .. } = suite;
        let words = format!("{records} records, sha256 {sha256}; {how}");
        (format!("{}, {kind}", capital(name)), words)
    };
    found.suites.iter().map(row)
}

/// The settings, and what is to be known of the suites.
fn provenance(results: &StudyResults) -> Vec<(String, String)> {
    let setup = &results.plan.setup;
    let overturning = match setup.overturning {
        Overturning::Alpha => "|theta| reaches alpha",
        Overturning::HalfPi => "|theta| exceeds pi/2",
    };
    let refinement = format!("{} in dimensionless intensity", setup.tolerance);
    let arms = results.plan.arms.iter();
    let arms: Vec<&str> = arms.map(|arm| arm.words()).collect();
    let restitution = setup.restitution.velocity_ratio().to_string();
    let mut out = vec![
        ("Revisions".into(), revisions()),
        ("Restitution".into(), restitution),
        ("Overturning".into(), overturning.into()),
        ("Refinement".into(), refinement),
        ("Grids".into(), arms.join("; ")),
    ];
    for suite in results.suites() {
        let (records, rule) = (suite.records.len(), &suite.component_rule);
        out.push((
            format!("Suite, {}", suite.kind),
            format!("{records} records, component: {rule}"),
        ));
        if let Some(remarks) = &suite.remarks {
            let name = format!("Remarks on records, {}", suite.kind);
            out.push((name, remarks.clone()));
        }
        if !suite.set_aside.is_empty() {
            let name = format!("Set aside, {} suite", suite.kind);
            out.push((name, suite.set_aside.to_string()));
        }
    }
    out
}

/// Headings of the changelog, newest first, with the version of this one.
fn revisions() -> String {
    let headings =
        rocking::changelog::TEXT.lines().filter_map(|l| l.strip_prefix("## "));
    let all: Vec<&str> = headings.collect();
    format!("{}; this is {}", all.join(", "), env!("CARGO_PKG_VERSION"))
}

/// The command that makes the page again.
fn command(results: &StudyResults, proved: bool) -> String {
    let setup = &results.plan.setup;
    let arms: Vec<&str> =
        results.plan.arms.iter().map(|arm| arm.name()).collect();
    let suites = match results.embedded() {
        true => "",
        false => " --ordinary ORDINARY --pulse PULSE",
    };
    let proof = match proved {
        true => " --proof FOLDER/data, after rocking verify --out FOLDER",
        false => "",
    };
    let full = if results.plan.full { " --full" } else { "" };
    format!(
        "rocking study{suites} --eta {} --overturn {} --refine {} \
         --arms {}{full}{proof}",
        setup.restitution.velocity_ratio(),
        setup.overturning,
        setup.tolerance,
        arms.join(",")
    )
}
