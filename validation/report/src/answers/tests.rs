//! Answers of every combination of words on their claims.

use super::*;
use crate::basis::recorded;
use rocking_common::paper::Arm;
use rocking_statistics::Estimate;
use rocking_study::claims::declared;

/// The answers that claims give, with these claims and their first words.
pub fn leads(findings: &Findings) -> Vec<(String, Vec<String>, [String; 4])> {
    let one = |asked: ReaderQuestion| {
        let answer = asked.answer(&findings.claims).0;
        (answer, asked.by, asked.leads)
    };
    asked().unwrap().into_iter().map(one).collect()
}

/// Words with a letter or a digit.
fn words(text: &str) -> usize {
    let word = |w: &&str| w.chars().any(char::is_alphanumeric);
    text.split_whitespace().filter(word).count()
}

/// No word of the trade stands on the first screen.
fn is_plain(text: &str) -> bool {
    let trade = ["arm", "arms", "cell", "cells", "judged", "worst", "verdict"];
    !text.split(|c: char| !c.is_alphanumeric()).any(|w| trade.contains(&w))
}

#[test]
fn every_answer_names_claims_and_numbers_that_exist() {
    let found = recorded();
    for ReaderQuestion { by, facts, .. } in asked().unwrap() {
        assert!(!by.is_empty() && !facts.is_empty());
        for id in &by {
            assert!(claim(&found.claims, id).is_some(), "{id}");
        }
        for AnswerFact { words, numbers, when } in facts {
            if let Some((id, _)) = when {
                assert!(claim(&found.claims, &id).is_some(), "{id}");
            }
            assert_eq!(words.matches("{}").count(), numbers.len(), "{words}");
            for number in numbers {
                let id = &number.claim;
                let mut all = declared().iter().map(|d| &d.claim);
                let own = all.find(|claim| claim.id == *id).expect(id);
                let k = number.count.unwrap_or_default();
                assert!(k < own.yardsticks.len(), "{id}: yardstick {k}");
                let found = claim(&found.claims, id).expect(id);
                for result in &found.results {
                    let here = |name: &&String| {
                        result.details.iter().any(|d| d.name == **name)
                    };
                    let missing = number.details.iter().find(|n| !here(n));
                    assert_eq!(missing, None, "{id}, {}", result.place());
                }
            }
        }
    }
}

/// A number without its measure is compared with the one before it.
#[test]
fn numbers_of_an_answer_have_names_of_their_own() {
    for ReaderQuestion { question, facts, .. } in asked().unwrap() {
        let mut names: Vec<String> = facts
            .into_iter()
            .flat_map(|fact| fact.numbers)
            .map(|number| number.name)
            .collect();
        let all = names.len();
        assert!(names.iter().all(|name| words(name) > 0), "{question}");
        names.sort();
        names.dedup();
        assert_eq!(names.len(), all, "{question}");
    }
}

#[test]
fn every_combination_of_words_gives_a_true_and_readable_sentence() {
    let recorded = recorded();
    for asked in &asked().unwrap() {
        let n = asked.by.len();
        for code in 0..Seen::ALL.len().pow(u32::try_from(n).unwrap()) {
            let state = |k: usize| {
                Seen::ALL
                    [code / Seen::ALL.len().pow(k as u32) % Seen::ALL.len()]
            };
            let mut claims = recorded.claims.clone();
            for (k, id) in asked.by.iter().enumerate() {
                let own = claims.iter_mut().find(|c| c.id == *id).unwrap();
                own.results.iter_mut().for_each(|r| r.seen = state(k));
            }
            let (found, numbers) = asked.answer(&claims);
            // Apart from the rule: what is not testable does not count.
            let known: Vec<Seen> = (0..n)
                .map(state)
                .filter(|seen| *seen != Seen::NotTestable)
                .collect();
            let lead = if known.is_empty() {
                &asked.leads[3]
            } else if known.iter().all(|seen| *seen == Seen::Yes) {
                &asked.leads[0]
            } else if known.iter().all(|seen| *seen == Seen::No) {
                &asked.leads[2]
            } else {
                &asked.leads[1]
            };
            assert!(found.starts_with(&format!("{lead}: ")), "{found}");
            assert!(words(&found) <= 55, "{}: {found}", words(&found));
            for text in [&found, &numbers] {
                assert!(is_plain(text), "{text}");
                for broken in ["{", "  ", ": ,", ": ;", ": .", "..", "NaN"] {
                    assert!(!text.contains(broken), "{text}");
                }
            }
            assert!(found.ends_with('.'), "{found}");
        }
        let (found, numbers) = asked.answer(&[]);
        assert_eq!(found, "There are no data.");
        assert!(numbers.is_empty());
    }
}

#[test]
fn a_fact_has_the_number_of_the_suite_that_is_furthest_off() {
    let mut claims = recorded().claims;
    let asked = &asked().unwrap()[3];
    let own = claims.iter_mut().find(|c| c.id == "eq7-trimmed-pga").unwrap();
    for result in &mut own.results {
        let x = if result.suite == SuiteSet::Ordinary { 0.06 } else { 0.03 };
        result.details[0].estimate = Estimate::exact(x);
    }
    let (found, numbers) = asked.answer(&claims);
    assert!(found.ends_with("trimmed 0.06."), "{found}");
    let listed = "PGA trimmed 0.06 ordinary, 0.03 pulse-type";
    assert!(numbers.ends_with(listed), "{numbers}");
}

/// What the paper's notch says is said only where it says so.
#[test]
fn a_clause_that_is_not_true_is_left_out() {
    let asked = &asked().unwrap()[0];
    let said = |seen: Seen| {
        let mut claims = recorded().claims;
        let own = claims.iter_mut().find(|claim| claim.id == "ratios-p1");
        let results = &mut own.expect("a claim").results;
        results.iter_mut().for_each(|result| result.seen = seen);
        asked.answer(&claims).0
    };
    assert!(said(Seen::No).contains("notch rejects"));
    assert!(!said(Seen::Yes).contains("notch"));
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
        let very = format!("The integrator, very: all {all} {known} pass, ");
        assert!(sure(Some(&green)).starts_with(&very));
        let found = signed(Some(&green));
        assert!(found.starts_with("For the computation, yes"), "{found}");
        assert_eq!(found.contains("kept, not run here"), are_kept, "{found}");
        for red in &reds {
            let failed = red.failed();
            let words = format!("Not sure: {failed} of {all} {known} fail.");
            assert!(sure(Some(red)).starts_with(&words));
            let found = signed(Some(red));
            assert!(found.starts_with("Not before every case"), "{found}");
            assert!(!found.contains("yes"), "{found}");
        }
        for proof in [None, Some(&green), Some(&reds[0])] {
            for text in [sure(proof), signed(proof)] {
                assert!(words(&text) <= 55 && is_plain(&text), "{text}");
            }
        }
    }
}

/// No more is claimed than two rocks, their tests and one fitted angle, and
/// the answer turns with what the tests say.
#[test]
fn tests_of_two_rocks_stand_in_the_answers() {
    let here = recorded();
    let basis = FindingSets::of(true, &here).unwrap();
    let green = Proof::committed(0);
    let said = |start: &str| answered(&basis, Some(&green), start);
    let tests = RockTests::kept().unwrap();
    let fragility = said("Which fragility");
    let words = format!(" {}.", tests.on_fragility());
    assert!(fragility.ends_with(&words), "{fragility}");
    assert_eq!(fragility.matches("rocks").count(), 1);
    assert!(!said("May I shift").contains("rocks"));
    let angle = "one angle fitted to each of two rocks";
    let asked = [("How sure", angle), ("May I sign", "one fitted angle each")];
    for (start, angle) in asked {
        let own = said(start);
        assert!(own.contains("490") && own.contains("two rocks"), "{own}");
        assert!(own.contains(angle), "{own}");
    }
    assert!(said("What was not checked").contains("other objects"));
}

#[test]
fn results_of_other_settings_are_left_out_and_named() {
    let mut here = recorded();
    let basis = FindingSets::of(true, &here).unwrap();
    assert_eq!(basis.recorded().count(), 2);
    assert!(basis.left_out().unwrap().is_none());
    assert!(done(&basis).contains("under recorded motions, 86 "));
    // Suites of files have no kept results beside them.
    let own = FindingSets::of(false, &here).unwrap();
    assert!(!own.has_recorded() && differing(&own).unwrap().is_none());
    here.settings.eta = 0.90;
    here.settings.arms = vec![Arm::A];
    let basis = FindingSets::of(true, &here).unwrap();
    assert!(!basis.has_recorded());
    let words = differing(&basis).unwrap().unwrap();
    assert!(words.contains("(arms A, B, C, not A; eta 0.92, not 0.9)"));
    assert!(done(&basis).contains("under synthetic motions, 86 "));
    assert!(!done(&basis).contains("recorded"));
}

/// Each kind of recorded motions has its sentence, with the claims that are
/// seen differently.
#[test]
fn claims_that_embedded_motions_turn_are_named() {
    let mut here = recorded();
    let said = |here: &Findings| {
        let basis = FindingSets::of(true, here).unwrap();
        differing(&basis).unwrap().unwrap()
    };
    let same = "Embedded motions give the answers of “recorded, kept”. None of \
                82 results differs.";
    let found = said(&here);
    assert!(found.starts_with(same), "{found}");
    assert!(found.contains("“recorded, repeatable”"), "{found}");
    for id in ["criterion", "quantiles-coincide"] {
        let own = here.claims.iter_mut().find(|own| own.id == id).unwrap();
        own.results.iter_mut().for_each(|result| result.seen = Seen::No);
    }
    let found = said(&here);
    let turned = "Of 82 results 3 differ: both overturning criteria agree; \
                  the quantiles coincide.";
    assert!(found.contains(turned), "{found}");
    let other = "answer differently from “recorded, kept” (in brackets): Does \
                 shape matter once size is known? Yes (Hardly, if every";
    assert!(found.contains(other), "{found}");
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
    let recorded = format!("{wrong} of {all} (recorded, kept)");
    assert!(said.contains(&recorded), "{said}");
    assert!(said.contains("7 of 98 (embedded)"), "{said}");
    let annex = basis.work();
    let of = |start: &str| {
        let own = annex.iter().find(|words| words.starts_with(start));
        own.expect(start).clone()
    };
    let said = of("Embedded: 86 ordinary");
    assert!(said.contains("Wrong in double precision: 4;"), "{said}");
    assert!(said.contains("move by 0.0421 at most"), "{said}");
    let shift = format!("{:.4}", kept.suites[0].largest_shift_if_flipped);
    let said = of("Recorded, kept: 86 ordinary");
    assert!(said.contains(&format!("move by {shift} at most")), "{said}");
}
