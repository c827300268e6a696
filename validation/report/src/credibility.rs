//! How far to trust the study: a credibility assessment with its gaps.

use crate::evidence::{NOT_RUN, Proof};
use crate::words::{Factor, Words};
use rocking_common::findings::Findings;
use rocking_common::table::PlainTable;
use rocking_study::results::StudyResults;

/// Evidence and gap of the input of a run on embedded suites, beside which
/// results of recorded ones may be kept.
fn synthetic(recorded: Option<&Findings>) -> (String, &'static str) {
    let own = "Synthetic suites from published relations, adjusted to \
               moments of PEER's motions, with seeds and hashes under \
               provenance";
    let Some(recorded) = recorded else {
        return (
            format!("{own}."),
            "No recorded motion: these suites say how the procedure works, \
             not what earthquakes do.",
        );
    };
    let suites: Vec<String> = recorded
        .suites
        .iter()
        .map(|s| format!("{} {}", s.records, s.kind))
        .collect();
    (
        format!(
            "{own}; beside them results of {} recorded motions, whose names \
             and hashes are kept.",
            suites.join(" and ")
        ),
        "The recorded motions are not part of this run and may not be passed \
         on. Anybody can run the study on those of FEMA P-695.",
    )
}

/// After NASA-STD-7009B, by our own judgement.
pub struct Credibility(Vec<Factor>);

/// The assessment of a study.
pub fn assessment(
    results: &StudyResults,
    proof: Option<&Proof>,
    recorded: Option<&Findings>,
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
                    "{} of {} declared cases fail.",
                    proof.failed(),
                    proof.results().len()
                ),
                "The annex has the cases that fail.",
            ),
            None => verification("Not run here.".into(), NOT_RUN),
        },
    );
    let input = if results.embedded() {
        let (evidence, gaps) = synthetic(recorded);
        factor("Input pedigree", "1", evidence, gaps)
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
            "Levels from 0, insufficient evidence, to 4, by the \
             project's own judgement; no one has certified them. The \
             least of them bounds what the whole can be trusted for.",
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
        let recorded = crate::basis::recorded();
        let (evidence, gap) = synthetic(Some(&recorded));
        assert!(evidence.contains("86 ordinary and 44 pulse-type recorded"));
        assert!(!gap.contains("No recorded motion"), "{gap}");
        let (evidence, gap) = synthetic(None);
        assert!(!evidence.contains("recorded"), "{evidence}");
        assert!(gap.starts_with("No recorded motion"), "{gap}");
    }
}
