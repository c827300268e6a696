//! Findings and their counts as a run of trials prints them.

use std::collections::BTreeMap;
use std::fmt::Write as _;

use rocking::number::Real as _;
use rocking_proof::trials::{
    CertificateReading, Finding, SHARES, TrialSummary, WideTruth,
};

/// Findings counted, in words.
pub fn summary(findings: &[Finding]) -> String {
    let all = TrialSummary::of(findings, CertificateReading::WHOLE);
    let mut text = format!(
        "{} runs: {} clear, {} unresolved; wrong and clear {}, \
         estimates exceeded {}, wrong and unresolved {}, clear and \
         undecided {}\n",
        all.runs,
        all.clear,
        all.unresolved,
        all.wrong_and_clear,
        all.exceeded,
        all.wrong_and_unresolved,
        all.undecided
    );
    for (name, share) in SHARES {
        let _ = write!(text, "{name} {:.2e}  ", all.ratio(share));
    }
    let unclear = |f: &&Finding| !CertificateReading::WHOLE.is_clear(&f.seen);
    let mut least: BTreeMap<&str, usize> = BTreeMap::new();
    for finding in findings.iter().filter(unclear) {
        let decision = finding.seen.certificate.least().decision;
        *least.entry(decision.name()).or_default() += 1;
    }
    for (name, count) in least {
        let _ = write!(text, "\nunresolved by {name}: {count}");
    }
    text
}

/// A finding in words.
pub fn finding(of: &Finding) -> String {
    let fate = |overturned| if overturned { "over" } else { "stands" };
    let (name, seen) = (&of.name, &of.seen);
    let truth = match of.truth {
        WideTruth::Stands { peak_ratio, error } => {
            format!("stands {:e} +- {error:.1e}", peak_ratio.to_f64())
        }
        WideTruth::Overturned => "over".to_owned(),
        WideTruth::Undecided => "undecided".to_owned(),
    };
    let error = of.error();
    let error = error.map_or(String::new(), |e| format!(", error {e:.2e}"));
    let least = seen.certificate.least();
    format!(
        "{name}: double {} {:e} estimate {:.1e}, truth {truth}{error}, \
         least clear {} {:.2e} at {:.4} s",
        fate(seen.overturned),
        seen.peak_ratio,
        seen.estimate,
        least.decision.name(),
        least.ratio,
        least.time_s
    )
}
