//! What the results add up to: what rounding and chance may have changed, and
//! the verdicts theme by theme and over all sentences of the paper.

use std::collections::BTreeMap;

use crate::basis::{FindingColumn, FindingSets};
use rocking_common::findings::{
    Claim, ClaimResult, Findings, SuiteSummary, Theme,
};
use rocking_common::paper::{Arm, ClaimVerdict};
use rocking_common::words::{capital, rounded_text};

/// The arm that stands among the findings.
pub(super) fn first_arm(findings: &Findings) -> Arm {
    let arms = &findings.settings.arms;
    if arms.contains(&Arm::C) { Arm::C } else { Arm::A }
}

/// False discovery rate that decisions are held against.
pub(super) const FALSE_DISCOVERIES: f64 = 0.05;

/// What the work on the suites of a side was, and what rounding may have
/// changed.
pub(super) fn work(
    (name, findings): FindingColumn<'_>,
) -> impl Iterator<Item = String> {
    let name = capital(name);
    findings.suites.iter().map(move |suite| of_suite(&name, suite))
}

fn of_suite(name: &str, suite: &SuiteSummary) -> String {
    let work = format!(
        "{name}: {} {} records, {} analyses",
        suite.records, suite.kind, suite.analyses
    );
    if suite.unresolved == 0 {
        return format!("{work}; double precision tells every one.");
    }
    let ends = suite.first_overturnings_reevaluated;
    format!(
        "{work}. In {} of them the motion is chaotic, and rounding in double \
         precision may have changed the peak or the fate. First overturnings \
         among these, on which capacities rest: {}. Assessed double precision \
         resolves {}, double-double {}, octuple precision {}, none {}. Wrong \
         in double precision: {}; the 16, 50 and 84 % overturning intensities \
         would move by {} at most.",
        suite.unresolved,
        ends.all,
        ends.resolved_by_double,
        ends.resolved_by_double_double,
        ends.resolved_by_octuple,
        ends.unresolved,
        ends.wrong_in_double,
        rounded_text(suite.largest_shift_if_flipped)
    )
}

/// How many decisions chance may have given, by the two false discovery
/// rates.
pub(super) fn trust(basis: &FindingSets<'_>) -> String {
    let counts = |findings: &Findings| {
        let found = findings.withdrawn(FALSE_DISCOVERIES);
        format!(
            "{} (any dependence: {}) of {}",
            found.positive, found.any, found.decided
        )
    };
    let counts = match basis.recorded() {
        Some(recorded) => {
            format!(
                "{} recorded, {} embedded",
                counts(recorded),
                counts(basis.here)
            )
        }
        None => counts(basis.here),
    };
    format!(
        "Chance. Kept to 5 % false discoveries (Benjamini and Hochberg; \
         Benjamini and Yekutieli), we would withdraw {counts} decisions on all grids."
    )
}

/// What came out about a theme: the plain words of its findings by verdict,
/// and where another suite says something else.
pub(super) fn by_theme(theme: Theme, basis: &FindingSets<'_>) -> String {
    let lead = basis.lead();
    let own = |findings: &Findings| -> Vec<(String, ClaimVerdict)> {
        let first = first_arm(findings);
        let claims = findings.claims.iter().filter(|c| c.theme == theme);
        claims
            .filter_map(|c| Some((c.plain.clone(), whole(c, first)?)))
            .collect()
    };
    let found = own(lead);
    let listed = |verdict: ClaimVerdict| -> String {
        let names = found.iter().filter(|(_, v)| *v == verdict);
        let names: Vec<&str> = names.map(|(name, _)| name.as_str()).collect();
        names.join("; ")
    };
    let sentences = sentences(lead, |claim| claim.theme == theme);
    let hold = sentences.iter().filter(|v| **v == ClaimVerdict::Confirmed);
    let mut words =
        format!("{} of {} sentences hold", hold.count(), sentences.len());
    let against = lead
        .claims
        .iter()
        .filter(|c| c.theme == theme && by_criterion_fails(c))
        .count();
    if against > 0 {
        words += &format!(
            " by the limits here, {against} of their claims not by the \
             paper's own criterion"
        );
    }
    let refuted = listed(ClaimVerdict::NotConfirmed);
    if !refuted.is_empty() {
        words += &format!(". Not confirmed: {refuted}");
    }
    let open = found.iter().filter(|(_, v)| *v == ClaimVerdict::Inconclusive);
    match open.count() {
        0 => {}
        1 => words += ". One claim is inconclusive",
        n => words += &format!(". {n} claims are inconclusive"),
    }
    if basis.recorded().is_none() {
        return words + ".";
    }
    let others = own(basis.here);
    let turned = others.iter().filter(|(name, verdict)| {
        found.iter().any(|(n, v)| n == name && v != verdict)
    });
    let other = match turned.count() {
        0 => "All come out alike on the embedded suites".into(),
        1 => "One comes out otherwise on the embedded suites".to_owned(),
        n => format!("{n} come out otherwise on the embedded suites"),
    };
    format!("On the recorded suites {words}. {other}.")
}

/// How many claims come out otherwise in other findings, of how many that
/// both judge.
pub(super) fn turned(a: &Findings, b: &Findings) -> (usize, usize) {
    let own = |findings: &Findings| -> BTreeMap<String, ClaimVerdict> {
        let first = first_arm(findings);
        let claims = findings.claims.iter();
        claims.filter_map(|c| Some((c.id.clone(), whole(c, first)?))).collect()
    };
    let (a, b) = (own(a), own(b));
    let both = a.iter().filter_map(|(id, v)| Some((v, b.get(id)?)));
    let (same, other): (Vec<_>, Vec<_>) = both.partition(|(v, w)| v == w);
    (other.len(), same.len() + other.len())
}

/// The verdict on each sentence of the paper: confirmed where every claim in
/// it is, not confirmed where one is refuted.
fn sentences(
    findings: &Findings,
    of: impl Fn(&Claim) -> bool,
) -> Vec<ClaimVerdict> {
    let first = first_arm(findings);
    let mut found: Vec<(&str, ClaimVerdict)> = Vec::new();
    for claim in findings.claims.iter().filter(|c| of(c)) {
        let Some(verdict) = whole(claim, first) else { continue };
        match found.iter_mut().find(|(quote, _)| *quote == claim.quote) {
            Some((_, sentence)) => *sentence = worse(*sentence, verdict),
            None => found.push((&claim.quote, verdict)),
        }
    }
    found.into_iter().map(|(_, verdict)| verdict).collect()
}

/// The worse a verdict is, the higher.
pub(super) fn rank(verdict: ClaimVerdict) -> u8 {
    match verdict {
        ClaimVerdict::Confirmed => 0,
        ClaimVerdict::Inconclusive => 1,
        ClaimVerdict::NotConfirmed => 2,
    }
}

/// The worse of two verdicts.
fn worse(a: ClaimVerdict, b: ClaimVerdict) -> ClaimVerdict {
    if rank(b) > rank(a) { b } else { a }
}

/// How many sentences of the paper have which verdict, in the order of
/// [`ClaimVerdict::ALL`]; what goes beyond the paper is none of them.
pub fn score(findings: &Findings) -> Vec<(ClaimVerdict, usize)> {
    let all = sentences(findings, |claim| claim.theme != Theme::Beyond);
    let count = |v: ClaimVerdict| all.iter().filter(|own| **own == v).count();
    ClaimVerdict::ALL.into_iter().map(|v| (v, count(v))).collect()
}

/// Whether a claim holds by the limits here and nowhere by the paper's own
/// criterion.
fn by_criterion_fails(claim: &Claim) -> bool {
    let fails = |r: &&ClaimResult| {
        r.by_equivalence == Some(ClaimVerdict::Confirmed)
            && r.by_criterion == Some(ClaimVerdict::NotConfirmed)
    };
    let all = claim.results.iter().filter(|r| r.by_equivalence.is_some());
    let failing = claim.results.iter().filter(fails).count();
    failing > 0 && failing == all.count()
}

/// The verdict on a claim over its suites: confirmed where each of them
/// confirms it, not confirmed where one refutes it.
fn whole(claim: &Claim, first: Arm) -> Option<ClaimVerdict> {
    let shown = |r: &&ClaimResult| r.arm.is_none_or(|arm| arm == first);
    let all = claim.results.iter().filter(shown);
    all.filter_map(|r| r.by_equivalence).reduce(worse)
}
