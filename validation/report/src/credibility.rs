//! How far to trust the study: a credibility assessment with its gaps.

use crate::basis::FindingSets;
use crate::evidence::{NOT_RUN, Proof};
use crate::words::{Factor, Words};
use rocking_common::findings::{Findings, RecordName, SuiteSummary};
use rocking_common::table::PlainTable;
use rocking_study::kept::REPEAT;
use rocking_study::results::StudyResults;
use std::collections::BTreeSet;

/// Evidence and gap of the input of a run on embedded suites, beside which
/// results of recorded ones may be kept.
fn synthetic(basis: &FindingSets<'_>) -> (String, String) {
    let own = "Synthetic suites from published relations, adjusted to \
               moments of PEER's motions, with seeds and hashes under \
               provenance";
    let mut recorded = basis.recorded();
    let (Some((_, owned)), Some((_, free))) =
        (recorded.next(), recorded.next())
    else {
        return (
            format!("{own}."),
            "No recorded motion: these suites say how the procedure works, \
             not what earthquakes do."
                .into(),
        );
    };
    let suites = |found: &Findings| {
        let words = |s: &SuiteSummary| format!("{} {}", s.records, s.kind);
        found.suites.iter().map(words).collect::<Vec<_>>().join(" and ")
    };
    // PEER's number of a recording begins the names of its files.
    let number = |own: &RecordName| {
        own.name.split('_').next().unwrap_or_default().to_owned()
    };
    let both = |a: &[SuiteSummary], b: &[SuiteSummary]| {
        let known: BTreeSet<String> =
            a.iter().flat_map(|suite| &suite.list).map(number).collect();
        let other = b.iter().flat_map(|suite| &suite.list).map(number);
        other.filter(|own| known.contains(own)).count()
    };
    (
        format!(
            "{own}; beside them stored results on {} and on {} recorded \
             motions, with their names and hashes.",
            suites(owned),
            suites(free)
        ),
        format!(
            "The recorded motions are not part of this run. Results on the \
             latter, those of FEMA P-695, can be repeated ({REPEAT}). {} of \
             their pairs are also among the former, which may not be \
             redistributed; {} of their ordinary pairs are pulse-type there.",
            both(&owned.suites, &free.suites),
            both(&owned.suites[1..], &free.suites[..1])
        ),
    )
}
/// After NASA-STD-7009B, by our own judgement.
pub struct Credibility(Vec<Factor>);

/// The assessment of a study.
pub fn assessment(
    results: &StudyResults,
    proof: Option<&Proof>,
    basis: &FindingSets<'_>,
    words: &Words,
) -> Credibility {
    let factor = |name: &str, level: &str, evidence: String, gaps: &str| {
        let (name, level, gaps) = (name.into(), level.into(), gaps.into());
        Factor { name, level, evidence, gaps }
    };
    let mut factors = words.assessment.clone();
    let verification =
        |evidence, gaps| factor("Verification", "0", evidence, gaps);
    factors.insert(
        1,
        match proof {
            Some(proof) if proof.failed() == 0 => words.verified.clone(),
            Some(proof) => verification(
                format!(
                    "{} of {} reference cases fail.",
                    proof.failed(),
                    proof.results().len()
                ),
                "The annex has the cases that fail.",
            ),
            None => verification("Not run here.".into(), NOT_RUN),
        },
    );
    let input = if results.embedded() {
        let (evidence, gaps) = synthetic(basis);
        factor("Input pedigree", "1", evidence, &gaps)
    } else {
        words.given.clone()
    };
    factors.insert(3, input);
    Credibility(factors)
}

impl Credibility {
    /// The factors, a row each.
    pub fn table(&self) -> PlainTable {
        let row = |one: &Factor| {
            let Factor { name, level, evidence, gaps } = one.clone();
            vec![name, level, evidence, gaps]
        };
        PlainTable::new(
            "credibility-assessment",
            "Credibility, after NASA-STD-7009B",
            "Levels from 0 (insufficient evidence) to 4, by the project's \
             own judgement; no one has certified them. The lowest level \
             limits how far the whole can be trusted.",
            &["factor", "level", "evidence", "gaps"],
            self.0.iter().map(row).collect(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    #[test]
    fn recorded_results_beside_a_synthetic_run_are_shown() {
        let mut here = crate::basis::recorded();
        let (evidence, gap) =
            synthetic(&FindingSets::of(true, &here).expect("kept"));
        let words = "86 ordinary and 44 pulse-type and on 36 ordinary and 14 \
                     pulse-type recorded";
        assert!(evidence.contains(words), "{evidence}");
        assert!(gap.contains("49 of their pairs"), "{gap}");
        here.settings.eta = 0.9;
        let (evidence, gap) =
            synthetic(&FindingSets::of(true, &here).expect("kept"));
        assert!(!evidence.contains("recorded"), "{evidence}");
        assert!(gap.starts_with("No recorded motion"), "{gap}");
    }
}
