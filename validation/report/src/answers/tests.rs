//! Answers of every combination of verdicts.

use super::*;
use crate::basis::recorded;
use crate::verdicts::work;
use rocking_statistics::Estimate;

/// What may come out about a part.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum State {
    All(ClaimVerdict),
    /// Suites disagree.
    Split(ClaimVerdict, ClaimVerdict),
    /// Numbers without intervals.
    Bare,
    NoData,
}

const STATES: [State; 7] = {
    use ClaimVerdict::{Confirmed, Inconclusive, NotConfirmed};
    use State::{All, Bare, NoData, Split};
    [
        All(Confirmed),
        All(NotConfirmed),
        All(Inconclusive),
        Split(Confirmed, NotConfirmed),
        Split(Inconclusive, Confirmed),
        Bare,
        NoData,
    ]
};

/// The claims of a question, each part in its state.
fn claims(
    asked: &ReaderQuestion,
    states: &[State],
    all: &[Claim],
) -> Vec<Claim> {
    let mut out = Vec::new();
    for (part, state) in asked.all().zip(states) {
        let turned = |v| match v {
            ClaimVerdict::Confirmed if part.against => {
                ClaimVerdict::NotConfirmed
            }
            ClaimVerdict::NotConfirmed if part.against => {
                ClaimVerdict::Confirmed
            }
            own => own,
        };
        for id in &part.claims {
            let claim = all.iter().find(|c| c.id == *id);
            let mut claim = claim.expect("a claim").clone();
            for result in &mut claim.results {
                result.by_equivalence = match state {
                    State::All(v) => Some(turned(*v)),
                    State::Split(a, _)
                        if result.suite == SuiteSet::Ordinary =>
                    {
                        Some(turned(*a))
                    }
                    State::Split(_, b) => Some(turned(*b)),
                    State::Bare | State::NoData => None,
                };
            }
            if *state == State::NoData {
                claim.results.clear();
            }
            out.push(claim);
        }
    }
    out
}

/// Every combination of `n` states.
fn combinations(n: usize) -> Vec<Vec<State>> {
    (0..n).fold(vec![Vec::new()], |all, _| {
        let longer = all.iter().flat_map(|states| {
            STATES.map(|state| [states.as_slice(), &[state]].concat())
        });
        longer.collect()
    })
}

/// The first words by the verdicts, written down apart from the rule.
fn expected<'a>(
    asked: &'a ReaderQuestion,
    states: &[State],
) -> Option<&'a str> {
    let (mut yes, mut no, mut open) = (false, false, false);
    for state in &states[..asked.parts.len()] {
        match state {
            State::All(ClaimVerdict::Confirmed) => yes = true,
            State::All(ClaimVerdict::NotConfirmed) => no = true,
            State::All(ClaimVerdict::Inconclusive) | State::Bare => {
                open = true
            }
            State::Split(a, b) => {
                for v in [a, b] {
                    yes |= *v == ClaimVerdict::Confirmed;
                    no |= *v == ClaimVerdict::NotConfirmed;
                    open |= *v == ClaimVerdict::Inconclusive;
                }
            }
            State::NoData => {}
        }
    }
    Some(
        &asked.leads[match (yes, no, open) {
            (true, false, false) => 0,
            (true, false, true) => 1,
            (true, true, _) => 2,
            (false, true, _) => 3,
            (false, false, true) => 4,
            (false, false, false) => return None,
        }],
    )
}

/// Words with a letter or a digit.
fn words(text: &str) -> usize {
    let word = |w: &&str| w.chars().any(char::is_alphanumeric);
    text.split_whitespace().filter(word).count()
}

/// No word of the trade stands on the first screen.
fn is_plain(text: &str) -> bool {
    let trade = ["arm", "arms", "cell", "cells", "judged", "worst", "against"];
    !text.split(|c: char| !c.is_alphanumeric()).any(|w| trade.contains(&w))
}

#[test]
fn every_combination_of_verdicts_gives_a_true_and_readable_sentence() {
    let recorded = recorded();
    let first = first_arm(&recorded);
    for asked in &asked().unwrap() {
        let n = asked.all().count();
        for states in combinations(n) {
            let own = claims(asked, &states, &recorded.claims);
            let found = asked.answer(&own, first);
            let context = format!("{states:?}: {found}");
            assert!(words(&found) <= 25, "{context}");
            assert!(is_plain(&found), "{context}");
            assert!(is_plain(&asked.numbers(&own, first)), "{context}");
            for broken in ["{", "  ", ": ,", ": ;", ": .", "..", "NaN"] {
                assert!(!found.contains(broken), "{context}");
            }
            assert!(found.ends_with('.'), "{context}");
            let Some(lead) = expected(asked, &states) else {
                assert_eq!(found, "There are no data.", "{context}");
                continue;
            };
            let rest = found.strip_prefix(lead);
            let rest = rest.and_then(|rest| rest.strip_prefix(": "));
            let rest = rest.unwrap_or_else(|| panic!("{lead}: {context}"));
            // What fails stands behind "but" where something holds, what is
            // open is marked where something is decided.
            let worst = |v: ClaimVerdict| {
                let is = |s: &State| match s {
                    State::All(own) => *own == v,
                    State::Split(a, b) => {
                        (if rank(*a) > rank(*b) { *a } else { *b }) == v
                    }
                    State::Bare => v == ClaimVerdict::Inconclusive,
                    State::NoData => false,
                };
                states[..asked.parts.len()].iter().any(is)
            };
            let (yes, no) = (
                worst(ClaimVerdict::Confirmed),
                worst(ClaimVerdict::NotConfirmed),
            );
            let open = worst(ClaimVerdict::Inconclusive);
            assert_eq!(rest.contains(", but "), yes && no, "{context}");
            let marked = rest.contains("; not certain: ");
            assert_eq!(marked, open && (yes || no), "{context}");
            let missing = states[..asked.parts.len()].contains(&State::NoData);
            assert_eq!(rest.contains("no data on"), missing, "{context}");
            // Each fact is there once, decided or not.
            for (part, state) in asked.parts.iter().zip(&states) {
                let end = part.fact.rsplit("{}").next().unwrap();
                let start = part.fact.split("{}").next().unwrap();
                if *state != State::NoData {
                    assert!(rest.contains(start), "{context}");
                    let end = end.split('{').next().unwrap();
                    assert!(rest.contains(end), "{context}");
                }
            }
        }
    }
}

#[test]
fn a_fact_has_the_number_of_the_worst_verdict() {
    let recorded = recorded();
    let first = first_arm(&recorded);
    let asked = &asked().unwrap()[3];
    let states = [
        State::All(ClaimVerdict::Confirmed),
        State::All(ClaimVerdict::Confirmed),
        State::All(ClaimVerdict::NotConfirmed),
    ];
    let mut own = claims(asked, &states, &recorded.claims);
    // The one result that fails has the smaller number.
    let results = own[0].results.iter_mut().filter(|r| r.arm == Some(first));
    for (result, (value, verdict)) in results.zip([
        (0.06, ClaimVerdict::NotConfirmed),
        (0.08, ClaimVerdict::Inconclusive),
    ]) {
        result.estimate = Estimate::exact(value);
        result.by_equivalence = Some(verdict);
    }
    let found = asked.answer(&own, first);
    assert!(found.contains("PGV off by 0.06 (ordinary)"), "{found}");
}

/// The answers to the questions that start so, with proof and basis.
fn answered(
    basis: &FindingSets<'_>,
    proof: Option<&Proof>,
    start: &str,
) -> String {
    let timings = Timings::kept().unwrap();
    let rows = rows(basis, &timings, proof, &[]).unwrap();
    let own = rows.into_iter().find(|row| row.question.starts_with(start));
    own.expect(start).answer
}

#[test]
fn other_answers_follow_from_the_cases_that_passed() {
    let green = Proof::committed(0);
    let all = green.results().len();
    // One case fails, or all of them.
    let reds = [1, all].map(Proof::committed);
    let here = recorded();
    let mut elsewhere = here.clone();
    elsewhere.settings.eta = 0.90;
    let kept = FindingSets::of(true, &here).unwrap();
    let left_out = FindingSets::of(true, &elsewhere).unwrap();
    let own = FindingSets::of(false, &here).unwrap();
    for (basis, are_kept) in [(&kept, true), (&left_out, false), (&own, false)]
    {
        let sure = |proof| answered(basis, proof, "How sure");
        let signed = |proof| answered(basis, proof, "May I sign");
        assert!(sure(None).starts_with("Open: "));
        assert!(signed(None).starts_with("Not yet: "));
        let known = "cases with known answers";
        assert_eq!(
            sure(Some(&green)),
            format!("Very: all {all} {known} pass.")
        );
        let found = signed(Some(&green));
        assert!(found.starts_with("For the computation, yes"), "{found}");
        assert_eq!(found.contains("kept, not run here"), are_kept, "{found}");
        for red in &reds {
            let failed = red.failed();
            let words = format!("Not sure: {failed} of {all} {known} fail.");
            assert_eq!(sure(Some(red)), words);
            let found = signed(Some(red));
            assert!(found.starts_with("Not before every case"), "{found}");
            assert!(!found.contains("yes"), "{found}");
        }
        for proof in [None, Some(&green), Some(&reds[0])] {
            for text in [sure(proof), signed(proof)] {
                assert!(words(&text) <= 25 && is_plain(&text), "{text}");
            }
        }
    }
}

#[test]
fn results_of_other_settings_are_left_out_and_named() {
    let mut here = recorded();
    let basis = FindingSets::of(true, &here).unwrap();
    assert!(basis.recorded().is_some() && basis.left_out().unwrap().is_none());
    assert!(done(&basis).contains("analyses of an earlier run"));
    // Suites of files have no kept results beside them.
    let own = FindingSets::of(false, &here).unwrap();
    assert!(own.recorded().is_none() && otherwise(&own).unwrap().is_none());
    here.settings.eta = 0.90;
    here.settings.arms = vec![Arm::A];
    let basis = FindingSets::of(true, &here).unwrap();
    assert!(basis.recorded().is_none());
    let words = otherwise(&basis).unwrap().unwrap();
    assert!(words.contains("(arms A, B, C, not A; eta 0.92, not 0.9)"));
    assert!(done(&basis).contains(" synthetic motions"));
    assert!(!done(&basis).contains("earlier run"));
}

#[test]
fn each_number_names_its_blocks() {
    let found = recorded();
    let answers = answers(&found).unwrap();
    // The fragility was examined for one block.
    let of = |start: &str| {
        let own = answers.iter().find(|own| own.question.starts_with(start));
        &own.expect(start).numbers
    };
    let one = "blocks: p = 3, alpha = 0.20";
    assert!(of("Which fragility").ends_with(one));
    assert!(of("May I shift").ends_with(one));
    let all = of("Does shape matter").matches("blocks: ").count();
    assert_eq!(all, 3);
    assert!(of("Does shape matter").contains("blocks: all 15"));
}

#[test]
fn what_rounding_changed_is_said_of_both_suites() {
    let mut here = recorded();
    let counts = |findings: &mut Findings, k: usize, wrong, all| {
        let ends = &mut findings.suites[k].first_overturnings_reevaluated;
        (ends.wrong_in_double, ends.all) = (wrong, all);
    };
    counts(&mut here, 0, 4, 90);
    counts(&mut here, 1, 3, 8);
    here.suites[0].largest_shift_if_flipped = 0.0421;
    let basis = FindingSets::of(true, &here).unwrap();
    let said = basis.rounding();
    let kept = recorded();
    let ends = kept.suites.iter().map(|s| s.first_overturnings_reevaluated);
    let (wrong, all) = ends.fold((0, 0), |(wrong, all), end| {
        (wrong + end.wrong_in_double, all + end.all)
    });
    assert!(wrong > 0, "the kept results have some");
    let recorded = format!("{wrong} of {all} (recorded suites)");
    assert!(said.contains(&recorded), "{said}");
    assert!(said.contains("7 of 98 (embedded suites)"), "{said}");
    let annex: Vec<String> =
        basis.columns().into_iter().flat_map(work).collect();
    let of = |start: &str| {
        let own = annex.iter().find(|words| words.starts_with(start));
        own.expect(start).clone()
    };
    let said = of("Embedded suites: 86 ordinary");
    assert!(said.contains("Wrong in double precision: 4;"), "{said}");
    assert!(said.contains("move by 0.0421 at most"), "{said}");
    let shift = format!("{:.4}", kept.suites[0].largest_shift_if_flipped);
    let said = of("Recorded suites: 86 ordinary");
    assert!(said.contains(&format!("move by {shift} at most")), "{said}");
}
