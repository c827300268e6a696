//! The paper's claims: `validation/study/claims` declares them as data,
//! [`super::measures`] measures them.

use std::collections::BTreeSet;
use std::sync::LazyLock;

use serde::Deserialize;

use crate::distances::all_distances;
use crate::inference::Resamples;
use crate::measures::{ClaimMeasure, Measured, Scope};
use crate::results::StudyResults;
use rocking_common::findings::{
    Claim, ClaimResult, Exists, Kind, Seen, SuiteSet,
};
use rocking_common::paper::Intensity;

/// The declared claims, in the order of the page.
const FILES: [(&str, &str); 4] = [
    ("choices.toml", include_str!("../claims/choices.toml")),
    ("slenderness.toml", include_str!("../claims/slenderness.toml")),
    ("lognormality.toml", include_str!("../claims/lognormality.toml")),
    ("fragilities.toml", include_str!("../claims/fragilities.toml")),
];

/// A declared claim, without results.
#[derive(Clone, Debug)]
pub struct Declaration {
    /// The statement.
    pub claim: Claim,
    /// Test of a finding.
    pub test: Option<ClaimTest>,
}

/// Test of a finding.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClaimTest {
    /// Registered name of the measure.
    pub measure: ClaimMeasure,
    /// Intensity measure; PGA by default.
    pub intensity: Option<Intensity>,
    /// Suites of the test.
    pub suites: Vec<SuiteSet>,
    /// Grids of the test.
    pub arms: Arms,
}

/// Grids on which a claim is tested.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arms {
    /// Every drawn grid.
    Drawn,
    /// The grid that figures share.
    Common,
    /// No grid: the result does not depend on it.
    None,
}

/// The declared claims.
///
/// # Panics
/// If a file has another form. The files are compiled in, and a test reads them.
pub fn declared() -> &'static [Declaration] {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct ClaimFile {
        claim: Vec<toml::Table>,
    }
    static CLAIMS: LazyLock<Vec<Declaration>> = LazyLock::new(|| {
        let mut out = Vec::new();
        let mut ids = BTreeSet::new();
        for (name, text) in FILES {
            let file: ClaimFile = toml::from_str(text)
                .unwrap_or_else(|error| panic!("{name}: {error}"));
            for table in file.claim {
                let declaration = Declaration::new(table)
                    .unwrap_or_else(|error| panic!("{name}: {error}"));
                let id = &declaration.claim.id;
                assert!(ids.insert(id.clone()), "two claims named {id}");
                if let Err(error) = declaration.check() {
                    panic!("claim {id}: {error}");
                }
                out.push(declaration);
            }
        }
        out
    });
    &CLAIMS
}

impl Declaration {
    fn new(mut table: toml::Table) -> Result<Self, toml::de::Error> {
        let test = table.remove("test").map(ClaimTest::deserialize);
        // Texts that not every claim has.
        for key in ["plain", "measure", "blocks", "case", "note"] {
            table.entry(key).or_insert_with(|| "".into());
        }
        for key in ["yardsticks", "results"] {
            let none = toml::Value::Array(Vec::new());
            table.entry(key).or_insert(none);
        }
        Ok(Self { claim: table.try_into()?, test: test.transpose()? })
    }

    /// Refuses a claim that lacks a field of its kind, or has a field too many.
    fn check(&self) -> Result<(), &'static str> {
        let Claim { yardsticks, measure, plain, case, .. } = &self.claim;
        let has_case = !case.is_empty();
        let judged = !yardsticks.is_empty()
            && !measure.is_empty()
            && !plain.is_empty()
            && self.test.as_ref().is_some_and(|t| !t.suites.is_empty());
        let bare =
            self.test.is_none() && yardsticks.is_empty() && plain.is_empty();
        match self.claim.kind {
            Kind::Finding if judged && !has_case => Ok(()),
            Kind::Finding => Err(
                "a finding has plain words, yardsticks, a measure, suites and \
                 arms, and no case",
            ),
            Kind::Identity if bare && has_case => Ok(()),
            Kind::Identity => Err("an identity names its declared case"),
            Kind::Description if bare && !has_case => Ok(()),
            Kind::Description => Err("a description is quoted alone"),
        }
    }

    /// The results by suite and grid; empty for a claim without a test.
    fn results(&self, scope: &Scope<'_>) -> anyhow::Result<Vec<ClaimResult>> {
        let Some(test) = &self.test else { return Ok(Vec::new()) };
        let plan = &scope.results.plan;
        let arms = match test.arms {
            Arms::Drawn => plan.drawn(),
            Arms::Common | Arms::None => vec![plan.common()],
        };
        let intensity = test.intensity.unwrap_or(Intensity::Pga);
        let places = test.suites.iter();
        let places =
            places.flat_map(|own| arms.iter().map(|arm| (*own, *arm)));
        let scopes = places.map(|(tested, arm)| Scope {
            tested,
            arm,
            intensity,
            ..*scope
        });
        scopes.map(|scope| self.result(test, &scope)).collect()
    }

    /// The result on the suite and grid of the scope. The verdicts follow from the
    /// numbers.
    fn result(
        &self,
        test: &ClaimTest,
        scope: &Scope<'_>,
    ) -> anyhow::Result<ClaimResult> {
        let Measured { counts, effect, at, details } =
            test.measure.found(scope)?;
        let (unit, range) = test.measure.unit();
        let estimate = scope.estimate(range, &effect);
        let Claim { yardsticks, no_effect, .. } = &self.claim;
        let seen = Seen::of(yardsticks, &counts);
        // A statement whose premise is missing has no effect.
        let effect = no_effect.filter(|_| seen != Seen::NotTestable);
        Ok(ClaimResult {
            suite: scope.tested,
            arm: (test.arms != Arms::None).then_some(scope.arm),
            seen,
            counts,
            exists: effect.map(|own| Exists::of(&own, &estimate)),
            estimate,
            unit,
            at,
            details,
        })
    }
}

/// All claims with their results.
///
/// # Errors
/// If a measure cannot be computed.
pub fn measured_claims(
    results: &StudyResults,
    draws: &Resamples,
) -> anyhow::Result<Vec<Claim>> {
    let scope = Scope {
        results,
        draws,
        distances: &all_distances(results, draws)?,
        tested: SuiteSet::None,
        arm: results.plan.common(),
        intensity: Intensity::Pga,
    };
    let measured = |own: &Declaration| {
        Ok(Claim { results: own.results(&scope)?, ..own.claim.clone() })
    };
    declared().iter().map(measured).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_measure_has_a_claim_and_every_claim_its_measure() {
        // A finding without a measure does not load; so what is left is a
        // measure that no claim names.
        let named: BTreeSet<ClaimMeasure> = declared()
            .iter()
            .filter_map(|d| Some(d.test.as_ref()?.measure))
            .collect();
        for measure in ClaimMeasure::ALL {
            assert!(named.contains(measure), "{measure:?}: no claim");
        }
        assert_eq!(named.len(), ClaimMeasure::ALL.len());
    }

    #[test]
    fn quotations_are_whole_sentences() {
        for Declaration { claim, .. } in declared() {
            let quote = &claim.quote;
            let first = quote.chars().next().unwrap();
            assert!(first.is_uppercase(), "{}: {quote}", claim.id);
            assert!(quote.ends_with('.'), "{}: {quote}", claim.id);
            assert!(!quote.contains("..."), "{}: {quote}", claim.id);
        }
    }
}
