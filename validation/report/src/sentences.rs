//! What the results add up to: claim by claim over suites and grids, theme by
//! theme, and over all sentences of the paper.

use crate::basis::FindingSets;
use rocking_common::findings::{
    Claim, ClaimResult, Exists, Findings, Seen, StatedEffect, SuiteSet, Theme,
};
use rocking_common::paper::Arm;

/// The grid that leads where what is shown has one.
pub(super) fn first_arm(findings: &Findings) -> Arm {
    let arms = &findings.settings.arms;
    if arms.contains(&Arm::C) { Arm::C } else { Arm::A }
}

/// What was found about a claim on a suite.
#[derive(Clone, Copy)]
pub(super) struct SuiteResult<'a> {
    /// The suite.
    pub suite: SuiteSet,
    /// The sample: on the paper's own grid where this was run.
    pub sample: &'a ClaimResult,
    /// The effect: on the finest grid that was run.
    pub effect: &'a ClaimResult,
}

/// What was found about a claim, suite by suite.
pub(super) fn by_suite(claim: &Claim) -> Vec<SuiteResult<'_>> {
    let mut out: Vec<SuiteResult<'_>> = Vec::new();
    for result in &claim.results {
        match out.iter_mut().find(|one| one.suite == result.suite) {
            Some(one) if result.arm == Some(Arm::A) => one.sample = result,
            Some(one) if result.arm == Some(Arm::C) => one.effect = result,
            Some(_) => {}
            None => out.push(SuiteResult {
                suite: result.suite,
                sample: result,
                effect: result,
            }),
        }
    }
    out
}

/// Whether a claim is seen, over its suites; none without results.
pub(super) fn seen(claim: &Claim) -> Option<Seen> {
    let all = by_suite(claim).into_iter();
    all.map(|one| one.sample.seen).reduce(Seen::and)
}

/// A sentence of the paper, over its claims and suites.
struct PaperSentence<'a> {
    quote: &'a str,
    seen: Seen,
    /// Words on the effects that it names, and on those that it denies.
    named: Vec<Exists>,
    denied: Vec<Exists>,
}

fn sentences(
    findings: &Findings,
    of: impl Fn(&Claim) -> bool,
) -> Vec<PaperSentence<'_>> {
    let mut found: Vec<PaperSentence<'_>> = Vec::new();
    for claim in findings.claims.iter().filter(|c| of(c)) {
        let Some(seen) = seen(claim) else { continue };
        let quote = claim.quote.as_str();
        let at = found.iter().position(|own| own.quote == quote);
        let at = at.unwrap_or_else(|| {
            let (named, denied) = (Vec::new(), Vec::new());
            found.push(PaperSentence { quote, seen, named, denied });
            found.len() - 1
        });
        let own = &mut found[at];
        own.seen = own.seen.and(seen);
        let says = claim.no_effect.map(|none| none.says);
        let words = match says {
            Some(StatedEffect::Nothing) => &mut own.denied,
            _ => &mut own.named,
        };
        let effects = by_suite(claim).into_iter();
        words.extend(effects.filter_map(|one| one.effect.exists));
    }
    found
}

/// How many sentences of the paper are seen; what goes beyond the paper is
/// none of them.
pub(super) struct SentenceCounts {
    /// All that can come out either way.
    pub all: usize,
    /// Those that are seen, not seen, seen in part, and not testable.
    pub seen: [usize; 4],
    /// Those whose effects exist, on every suite.
    pub shown: usize,
    /// Those with an effect whose opposite exists, on a suite at least.
    pub opposite: usize,
    /// Those that deny an effect that exists, on a suite at least.
    pub denied: usize,
}

impl SentenceCounts {
    /// The score of findings.
    pub fn of(findings: &Findings) -> Self {
        let all = sentences(findings, |claim| claim.theme != Theme::Beyond);
        let count = |is: &dyn Fn(&PaperSentence<'_>) -> bool| {
            all.iter().filter(|own| is(own)).count()
        };
        let order = [Seen::Yes, Seen::No, Seen::InPart, Seen::NotTestable];
        let is_shown = |exists: &[Exists]| {
            !exists.is_empty() && exists.iter().all(|e| *e == Exists::Yes)
        };
        Self {
            all: all.len(),
            seen: order.map(|word| count(&|own| own.seen == word)),
            shown: count(&|own| is_shown(&own.named)),
            opposite: count(&|own| own.named.contains(&Exists::Opposite)),
            denied: count(&|own| own.denied.contains(&Exists::Yes)),
        }
    }

    /// The score in a sentence.
    pub fn words(&self) -> String {
        let Self { all, seen: [yes, no, part, not], .. } = self;
        format!(
            "Of {all} statements of the paper, {yes} are seen again by the \
             authors' own criteria, {no} are not, and {part} in part; {not} \
             cannot be tested with these records."
        )
    }

    /// What exists beyond the records, in a sentence.
    pub fn effects(&self) -> String {
        let Self { shown, opposite, denied, .. } = self;
        format!(
            "Beyond these records, the effect that a statement names is shown \
             on every suite for {shown} and its opposite for {opposite}; \
             {denied} deny an effect that exists, however small."
        )
    }
}

/// What came out about a theme: how many of its sentences are seen.
pub(super) fn by_theme(theme: Theme, basis: &FindingSets<'_>) -> String {
    let lead = basis.lead();
    let own = |claim: &Claim| claim.theme == theme;
    let all = sentences(lead, own);
    let yes = all.iter().filter(|own| own.seen == Seen::Yes).count();
    let words = format!("{yes} of {} statements are seen here.", all.len());
    let others = basis.columns().into_iter().skip(1).map(|(name, found)| {
        let (turned, all) = turned(found, lead, own);
        format!("{} of {all} ({name})", turned.len())
    });
    match others.collect::<Vec<_>>().join(", ").as_str() {
        "" => words,
        others => format!("{words} Seen differently: {others}."),
    }
}

/// The claims that are seen differently in other findings, once for each suite,
/// and how many results both have.
pub(super) fn turned<'a>(
    a: &'a Findings,
    b: &Findings,
    of: impl Fn(&Claim) -> bool,
) -> (Vec<&'a str>, usize) {
    let (mut turned, mut all) = (Vec::new(), 0);
    for own in a.claims.iter().filter(|claim| of(claim)) {
        let other = b.claims.iter().filter(|claim| claim.id == own.id);
        for y in other.flat_map(by_suite) {
            let x = by_suite(own).into_iter().find(|x| x.suite == y.suite);
            let Some(x) = x else { continue };
            all += 1;
            if x.sample.seen != y.sample.seen {
                turned.push(own.plain.as_str());
            }
        }
    }
    (turned, all)
}
