//! The paper's claims: declared as data in `validation/study/claims`, measured by
//! [`super::measures`], judged by [`super::inference`].

use std::cell::OnceCell;
use std::collections::BTreeSet;
use std::sync::LazyLock;

use serde::Deserialize;

use crate::distances::{Distances, all_distances};
use crate::inference::{Draws, Judged, MORE, Rule, judge, share};
use crate::measures::{Criterion, Measure, Source};
use crate::results::Results;
use rocking_common::findings::{
    Claim, ClaimResult, Detail, Kind, Quantifier, Region, Tested, Theme,
};
use rocking_common::paper::{Arm, Intensity, Section};

/// The declared claims, in the order of the page.
const FILES: [(&str, &str); 4] = [
    ("choices.toml", include_str!("../claims/choices.toml")),
    ("slenderness.toml", include_str!("../claims/slenderness.toml")),
    ("lognormality.toml", include_str!("../claims/lognormality.toml")),
    ("fragilities.toml", include_str!("../claims/fragilities.toml")),
];

/// A claim as it is declared.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Declared {
    /// Unique name.
    pub id: String,
    /// What sort of statement it is.
    pub kind: Kind,
    /// What it is about.
    pub theme: Theme,
    /// Where the paper says it.
    pub section: Section,
    /// The paper's words.
    pub quote: String,
    /// The statement in plain words, of a finding.
    #[serde(default)]
    pub plain: String,
    /// Registered name of the measure of a finding.
    pub measure: Option<Measure>,
    /// Intensity that the measure is of; PGA where none is named.
    pub intensity: Option<Intensity>,
    /// What is measured, in words.
    #[serde(default)]
    pub words: String,
    /// Blocks measured.
    #[serde(default)]
    pub blocks: String,
    /// How many of the cells.
    pub quantifier: Option<Quantifier>,
    /// Where a value has to lie.
    pub region: Option<Region>,
    /// Why there.
    #[serde(default)]
    pub reason: String,
    /// The paper's own criterion.
    pub criterion: Option<OwnCriterion>,
    /// Suites that it is tested on.
    #[serde(default)]
    pub suites: Vec<Tested>,
    /// Arms that it is tested on.
    pub arms: Option<Arms>,
    /// Declared case of an identity.
    #[serde(default)]
    pub case: String,
    /// What else a reader must know.
    #[serde(default)]
    pub note: String,
}

/// What the paper itself judges by.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct OwnCriterion {
    /// The criterion in words.
    pub words: String,
    /// Where the share of what meets it has to lie.
    pub share: Region,
}

/// Arms of the grid that a claim is tested on.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Arms {
    /// Each that is drawn.
    Drawn,
    /// The one that figures share.
    Common,
    /// None: the grid does not enter.
    None,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct File {
    claim: Vec<Declared>,
}

/// The declared claims.
///
/// # Panics
/// If a file is not of the expected form: the files are compiled in, and a
/// test reads them.
#[must_use]
pub fn declared() -> &'static [Declared] {
    static CLAIMS: LazyLock<Vec<Declared>> = LazyLock::new(|| {
        let mut out = Vec::new();
        for (name, text) in FILES {
            let file: File = toml::from_str(text)
                .unwrap_or_else(|error| panic!("{name}: {error}"));
            out.extend(file.claim);
        }
        let mut ids = BTreeSet::new();
        for claim in &out {
            assert!(ids.insert(&claim.id), "two claims named {}", claim.id);
            if let Err(error) = claim.check() {
                panic!("claim {}: {error}", claim.id);
            }
        }
        out
    });
    &CLAIMS
}

impl Declared {
    /// What a claim of its kind must have, and nothing else.
    fn check(&self) -> Result<(), &'static str> {
        let judged = self.measure.is_some()
            && self.quantifier.is_some()
            && self.region.is_some()
            && !self.reason.is_empty()
            && !self.plain.is_empty()
            && !self.suites.is_empty()
            && self.arms.is_some();
        let bare = self.measure.is_none()
            && self.intensity.is_none()
            && self.region.is_none()
            && self.plain.is_empty()
            && self.suites.is_empty();
        match self.kind {
            Kind::Finding if judged && self.case.is_empty() => Ok(()),
            Kind::Finding => Err(
                "a finding has plain words, a measure, a quantifier, a region \
                 with its reason, suites and arms, and no case",
            ),
            Kind::Identity if bare && !self.case.is_empty() => Ok(()),
            Kind::Identity => Err("an identity names its declared case"),
            Kind::Description if bare && self.case.is_empty() => Ok(()),
            Kind::Description => Err("a description is quoted alone"),
        }
    }
}

/// The end of the region that a measure is judged by which lies nearest to
/// infinity; NaN where no claim has that measure of that intensity.
#[must_use]
pub fn limit_of(measure: Measure, intensity: Intensity) -> f64 {
    let of = (Some(measure), Some(intensity));
    let named = |claim: &&Declared| (claim.measure, claim.intensity) == of;
    let region = declared().iter().find(named).and_then(|claim| claim.region);
    region.map_or(f64::NAN, |region| region.nearest_end(f64::INFINITY))
}

/// All claims, with what came out.
///
/// # Errors
/// Where a measure cannot be computed.
pub fn all(results: &Results, draws: &Draws) -> anyhow::Result<Vec<Claim>> {
    let distances = all_distances(results, draws)?;
    let more = OnceCell::new();
    let drawn = Drawn { results, draws, more: &more, distances: &distances };
    declared().iter().map(|claim| measured(claim, &drawn)).collect()
}

/// The draws that all claims share, and more of them, made where a verdict
/// needs them.
struct Drawn<'a> {
    results: &'a Results,
    draws: &'a Draws,
    more: &'a OnceCell<Draws>,
    distances: &'a [Distances],
}

fn measured(claim: &Declared, drawn: &Drawn<'_>) -> anyhow::Result<Claim> {
    let results = drawn.results;
    let mut found = Vec::new();
    if let (Some(measure), Some(quantifier), Some(region)) =
        (claim.measure, claim.quantifier, claim.region)
    {
        let (unit, range) = measure.unit();
        let rule = Rule { quantifier, region, unit, range };
        let common = results.plan.common();
        let arms: Vec<(Arm, Option<Arm>)> = match claim.arms {
            Some(Arms::Drawn) => {
                let drawn = results.plan.drawn();
                drawn.into_iter().map(|arm| (arm, Some(arm))).collect()
            }
            Some(Arms::Common) => vec![(common, Some(common))],
            Some(Arms::None) | None => vec![(common, None)],
        };
        for suite in &claim.suites {
            for (arm, shown) in &arms {
                let source = Source {
                    results,
                    draws: drawn.draws,
                    distances: drawn.distances,
                    tested: *suite,
                    arm: *arm,
                    intensity: claim.intensity.unwrap_or(Intensity::Pga),
                };
                let asked = Asked { claim, measure, rule, shown: *shown };
                let mut judged = asked.judged(&source)?;
                if judged.more {
                    let more = || results.draws(MORE);
                    let draws = drawn.more.get_or_init(more);
                    judged = asked.judged(&Source { draws, ..source })?;
                }
                found.push(judged.result);
            }
        }
    }
    Ok(Claim {
        id: claim.id.clone(),
        kind: claim.kind,
        theme: claim.theme,
        section: claim.section,
        quote: claim.quote.clone(),
        plain: claim.plain.clone(),
        measure: claim.words.clone(),
        blocks: claim.blocks.clone(),
        quantifier: claim.quantifier,
        region: claim.region,
        reason: claim.reason.clone(),
        criterion: claim
            .criterion
            .as_ref()
            .map_or_else(String::new, |own| own.words.clone()),
        case: claim.case.clone(),
        note: claim.note.clone(),
        results: found,
    })
}

/// A claim on a suite and arm.
struct Asked<'a> {
    claim: &'a Declared,
    measure: Measure,
    rule: Rule,
    shown: Option<Arm>,
}

impl Asked<'_> {
    /// The verdict by the draws of a source.
    fn judged(&self, source: &Source<'_>) -> anyhow::Result<Judged> {
        let prepared = self.measure.prepare(source)?;
        let mut judged = judge(
            source.draws,
            source.tested,
            self.shown,
            &self.rule,
            &prepared.cells,
            &prepared.measured,
        );
        let result = &mut judged.result;
        if let (Some(own), Some(criterion)) =
            (&self.claim.criterion, &prepared.criterion)
        {
            by_criterion(source.draws, own, criterion, result);
        }
        result.details.extend(prepared.details);
        Ok(judged)
    }
}

/// The verdict by the paper's own criterion.
fn by_criterion(
    draws: &Draws,
    own: &OwnCriterion,
    found: &Criterion,
    result: &mut ClaimResult,
) {
    let (measured, verdict) =
        share(draws, result.suite, &found.measured, own.share);
    result.by_criterion = Some(verdict);
    result.details.push(Detail { name: found.name.clone(), measured });
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_measure_has_a_claim_and_every_claim_its_measure() {
        // A finding without a measure does not load; so what is left is a
        // measure that no claim names.
        let named: BTreeSet<Measure> =
            declared().iter().filter_map(|claim| claim.measure).collect();
        for measure in Measure::ALL {
            assert!(named.contains(measure), "{measure:?}: no claim");
        }
        assert_eq!(named.len(), Measure::ALL.len());
    }

    #[test]
    fn quotations_are_whole_sentences() {
        for claim in declared() {
            let quote = &claim.quote;
            let first = quote.chars().next().unwrap();
            assert!(first.is_uppercase(), "{}: {quote}", claim.id);
            assert!(quote.ends_with('.'), "{}: {quote}", claim.id);
            assert!(!quote.contains("..."), "{}: {quote}", claim.id);
        }
    }
}
