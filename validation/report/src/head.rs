//! Where the page comes from: which program ran on what, and who signs for
//! it.

use rocking_common::suites::inputs::sha256_hex;
use rocking_study::results::Results;

/// The versions of everything that the program is built from.
const LOCK: &str = include_str!(env!("ROCKING_LOCK"));

/// Who signs for a report, and when it was issued: words of the user, since
/// the program knows no clock and no names.
#[derive(Clone, Debug, Default, clap::Args)]
pub struct Signatures {
    /// Date of issue, as it is to stand on the page.
    #[arg(long, value_name = "DATE")]
    pub issued: Option<String>,
    /// Who prepared the report; otherwise the page has a line to sign.
    #[arg(long, value_name = "NAME")]
    pub prepared_by: Option<String>,
    /// Who reviewed the report; otherwise the page has a line to sign.
    #[arg(long, value_name = "NAME")]
    pub reviewed_by: Option<String>,
    /// Who approved the report; otherwise the page has a line to sign.
    #[arg(long, value_name = "NAME")]
    pub approved_by: Option<String>,
    /// The commit of the program, which an issued copy names.
    #[arg(skip)]
    pub commit: &'static str,
}

impl Signatures {
    /// Each with what it is.
    pub fn shown(&self) -> Vec<(String, Option<String>)> {
        [
            ("Issued", &self.issued),
            ("Prepared by", &self.prepared_by),
            ("Reviewed by", &self.reviewed_by),
            ("Approved by", &self.approved_by),
        ]
        .map(|(what, given)| (what.to_owned(), given.clone()))
        .into()
    }
}

/// The program, its input and the command; whether results of the declared
/// cases were handed in. A committed page cannot name the commit that holds
/// it, so the commit stands on issued copies alone.
pub fn head(
    results: &Results,
    proved: bool,
    signatures: &Signatures,
) -> Vec<(String, String)> {
    let commit = match signatures.issued {
        Some(_) => signatures.commit,
        None => {
            "that which holds this page; a copy made with --issued names it"
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

/// Headings of the changelog, newest first, with the version of this one.
pub fn revisions() -> String {
    let headings =
        rocking::changelog::TEXT.lines().filter_map(|l| l.strip_prefix("## "));
    let all: Vec<&str> = headings.collect();
    format!("{}; this is {}", all.join(", "), env!("CARGO_PKG_VERSION"))
}

/// The command that makes the page again.
fn command(results: &Results, proved: bool) -> String {
    let setup = &results.plan.setup;
    let arms: Vec<&str> =
        results.plan.arms.iter().map(|arm| arm.letter()).collect();
    let suites = match results.embedded() {
        true => "",
        false => " --ordinary ORDINARY --pulse PULSE",
    };
    let proof = match proved {
        true => " --proof FOLDER/data, after rocking validate --out FOLDER",
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
