//! Answers of every combination of words on their claims.

use super::*;
use crate::basis::recorded;
use rocking_common::paper::Arm;
use rocking_statistics::Estimate;
use rocking_study::claims::declared;

/// The answers that claims give, with these claims and the first words of
/// each possible answer.
pub fn leads(findings: &Findings) -> Vec<(String, Vec<String>, [String; 4])> {
    let one = |own: ReaderQuestion| {
        let answer = own.answer(&findings.claims).0;
        let first = |seen: &Seen| {
            let words = own.sentences(*seen)[0].split('{').next();
            words.unwrap_or_default().to_owned()
        };
        let firsts = Seen::ALL.each_ref().map(first);
        (answer, own.by, firsts)
    };
    reader_questions().unwrap().into_iter().map(one).collect()
}

/// Words with a letter or a digit.
fn words(text: &str) -> usize {
    let word = |w: &&str| w.chars().any(char::is_alphanumeric);
    text.split_whitespace().filter(word).count()
}

/// No word of the trade stands on the first screen.
fn is_plain(text: &str) -> bool {
    let trade = ["arm", "arms", "cell", "cells", "judged", "verdict"];
    !text.split(|c: char| !c.is_alphanumeric()).any(|w| trade.contains(&w))
}

/// Sentences of a text: each ends with a full stop and a blank, or the text.
fn sentences(text: &str) -> usize {
    text.split(". ").count()
}

#[test]
fn every_answer_names_claims_and_numbers_that_exist() {
    let found = recorded();
    for own in reader_questions().unwrap() {
        assert!(!own.by.is_empty() && !own.numbers.is_empty());
        for id in &own.by {
            assert!(claim(&found.claims, id).is_some(), "{id}");
        }
        for number in &own.numbers {
            let id = &number.claim;
            let mut all = declared().iter().map(|d| &d.claim);
            let claimed = all.find(|claim| claim.id == *id).expect(id);
            let k = number.count.unwrap_or_default();
            assert!(k < claimed.yardsticks.len(), "{id}: yardstick {k}");
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

/// A number without its measure is compared with the one before it.
#[test]
fn numbers_of_an_answer_have_names_of_their_own() {
    for ReaderQuestion { question, numbers, .. } in reader_questions().unwrap()
    {
        let names = numbers.iter().map(|n| &n.name).collect();
        let keys = numbers.iter().map(|n| &n.key).collect();
        for mut names in [names, keys] as [Vec<&String>; 2] {
            assert!(names.iter().all(|name| words(name) > 0), "{question}");
            names.sort();
            names.dedup();
            assert_eq!(names.len(), numbers.len(), "{question}");
        }
    }
}

/// Each state of its claims has its own text, of two sentences at most, and
/// every place in a sentence has its number.
#[test]
fn every_combination_of_words_gives_a_true_and_readable_answer() {
    let recorded = recorded();
    for own in &reader_questions().unwrap() {
        let texts = Seen::ALL.map(|seen| own.sentences(seen).concat());
        for (k, text) in texts.iter().enumerate() {
            assert!(!texts[..k].contains(text), "{text}");
        }
        let n = own.by.len();
        for code in 0..Seen::ALL.len().pow(u32::try_from(n).unwrap()) {
            let state = |k: usize| {
                Seen::ALL
                    [code / Seen::ALL.len().pow(k as u32) % Seen::ALL.len()]
            };
            let mut claims = recorded.claims.clone();
            for (k, id) in own.by.iter().enumerate() {
                let own = claims.iter_mut().find(|c| c.id == *id).unwrap();
                own.results.iter_mut().for_each(|r| r.seen = state(k));
            }
            let (found, numbers) = own.answer(&claims);
            // Apart from the rule: what is not testable does not count.
            let known: Vec<Seen> = (0..n)
                .map(state)
                .filter(|seen| *seen != Seen::NotTestable)
                .collect();
            let texts = if known.is_empty() {
                &own.answer.not_testable
            } else if known.iter().all(|seen| *seen == Seen::Yes) {
                &own.answer.yes
            } else if known.iter().all(|seen| *seen == Seen::No) {
                &own.answer.no
            } else {
                &own.answer.in_part
            };
            assert_eq!(sentences(&found), texts.len(), "{found}");
            assert!(texts.len() <= 2 && words(&found) <= 75, "{found}");
            let first = texts[0].split('{').next().unwrap();
            assert!(found.starts_with(first), "{found}");
            for text in [&found, &numbers] {
                assert!(is_plain(text), "{text}");
                for broken in ["{", "  ", ": ,", ": ;", ": .", "..", "NaN"] {
                    assert!(!text.contains(broken), "{text}");
                }
            }
            assert!(found.ends_with('.'), "{found}");
        }
        let (found, numbers) = own.answer(&[]);
        assert_eq!(found, "There are no data.");
        assert!(numbers.is_empty());
    }
}

#[test]
fn a_sentence_has_the_number_of_the_suite_that_is_furthest_off() {
    let mut claims = recorded().claims;
    let question = &reader_questions().unwrap()[3];
    let own = claims.iter_mut().find(|c| c.id == "eq7-trimmed-pga").unwrap();
    for result in &mut own.results {
        let x = if result.suite == SuiteSet::Ordinary { 0.06 } else { 0.03 };
        result.details[0].estimate = Estimate::exact(x);
    }
    let (found, numbers) = question.answer(&claims);
    let words = "0.06 (ordinary) in PGA without the upper 5 %";
    assert!(found.contains(words), "{found}");
    let listed = "PGA, trimmed: 0.06 ordinary, 0.03 pulse-type";
    assert!(numbers.ends_with(listed), "{numbers}");
}

#[test]
fn a_sentence_without_its_number_is_left_out() {
    let question = &reader_questions().unwrap()[0];
    let mut claims = recorded().claims;
    let whole = question.answer(&claims).0;
    assert!(whole.contains("Housner"));
    claims.retain(|claim| claim.id != "housner-breaks");
    let cut = question.answer(&claims).0;
    assert!(whole.starts_with(&cut) && !cut.contains("Housner"), "{cut}");
    let own = claims.iter_mut().find(|c| c.id == "quantiles-coincide");
    let results = &mut own.expect("a claim").results;
    results.iter_mut().for_each(|result| result.details.clear());
    let short = question.answer(&claims).0;
    let words = "Hardly, if every impact loses the same share of energy.";
    assert_eq!(short, words);
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
    let kept = FindingSets::of(true, &here).unwrap();
    let exact = |proof| answered(&kept, proof, "How exact");
    let signed = |proof| answered(&kept, proof, "What may I sign");
    let status = |proof| summary(&kept, proof).unwrap()[2].1.clone();
    assert!(exact(None).starts_with("Not known: "));
    assert!(signed(None).starts_with("Nothing yet: "));
    assert!(status(None).contains("No reference case was run"));
    assert!(exact(Some(&green)).contains("digits in the median"));
    assert!(signed(Some(&green)).starts_with("That every reference case"));
    let passed = format!("{all} of {all} reference cases pass");
    assert!(status(Some(&green)).contains(&passed));
    assert!(confirmed(Some(&green)).starts_with("By signing"));
    for unsigned in [None, Some(&reds[0])] {
        assert!(confirmed(unsigned).ends_with("cannot be signed yet."));
    }
    for red in &reds {
        let failed = red.failed();
        let words = format!("Not known: {failed} of {all} reference cases");
        assert!(exact(Some(red)).starts_with(&words));
        assert!(signed(Some(red)).starts_with("Nothing before every"));
        assert!(!status(Some(red)).contains(&passed));
    }
    for proof in [None, Some(&green), Some(&reds[0])] {
        for text in [exact(proof), signed(proof)] {
            assert!(words(&text) <= 70 && is_plain(&text), "{text}");
            assert!(sentences(&text) <= 2, "{text}");
        }
    }
}

/// No more is claimed than two rocks, their tests and one fitted angle.
#[test]
fn tests_of_two_rocks_stand_in_the_answers() {
    let here = recorded();
    let basis = FindingSets::of(true, &here).unwrap();
    let green = Proof::committed(0);
    let said = |start: &str| answered(&basis, Some(&green), start);
    let own = said("What was not checked");
    assert!(own.contains("two granite rocks"), "{own}");
    assert!(own.contains("one angle fitted to each"), "{own}");
    assert!(own.contains("490 tests") && own.contains(LEFT_OUT), "{own}");
    assert!(
        summary(&basis, None).unwrap()[2]
            .1
            .contains("490 shaking-table tests")
    );
    let timings = Timings::kept().unwrap();
    let rows = rows(&basis, &timings, None, &[]).unwrap();
    let own = rows.iter().find(|row| row.question.starts_with("Which frag"));
    let tests = RockTests::kept().unwrap();
    let numbers = &own.unwrap().effect;
    assert!(numbers.contains(tests.on_fragility()), "{numbers}");
}

#[test]
fn the_first_screen_has_eight_answers() {
    let here = recorded();
    let basis = FindingSets::of(true, &here).unwrap();
    let timings = Timings::kept().unwrap();
    assert_eq!(rows(&basis, &timings, None, &[]).unwrap().len(), 8);
}

#[test]
fn results_of_other_settings_are_left_out_and_named() {
    let mut here = recorded();
    let basis = FindingSets::of(true, &here).unwrap();
    assert_eq!(basis.recorded().count(), 2);
    assert!(basis.left_out().unwrap().is_none());
    let done = |basis: &FindingSets<'_>| {
        summary(basis, None).unwrap().map(|(_, words)| words)
    };
    assert!(done(&basis)[0].contains("under recorded motions, 86 "));
    // Suites of files have no kept results beside them.
    let own = FindingSets::of(false, &here).unwrap();
    assert!(!own.has_recorded() && differing(&own).unwrap().is_none());
    here.settings.eta = 0.90;
    here.settings.arms = vec![Arm::A];
    let basis = FindingSets::of(true, &here).unwrap();
    assert!(!basis.has_recorded());
    let words = differing(&basis).unwrap().unwrap();
    assert!(words.contains("(grids A, B, C, not A; eta 0.92, not 0.9)"));
    assert!(done(&basis)[0].contains("under synthetic motions, 86 "));
    assert!(!done(&basis).concat().contains("recorded"));
}

/// Each kind of recorded motions has its sentence, with the answers that
/// differ.
#[test]
fn results_that_embedded_motions_turn_are_counted() {
    let mut here = recorded();
    let said = |here: &Findings| {
        let basis = FindingSets::of(true, here).unwrap();
        differing(&basis).unwrap().unwrap()
    };
    let same = "On the motions “embedded” 0 of 82 results differ, and no \
                answer changes.";
    let found = said(&here);
    assert!(found.contains(same), "{found}");
    assert!(found.contains("“recorded, repeatable”"), "{found}");
    for id in ["criterion", "quantiles-coincide"] {
        let own = here.claims.iter_mut().find(|own| own.id == id).unwrap();
        own.results.iter_mut().for_each(|result| result.seen = Seen::No);
    }
    let found = said(&here);
    let turned = "“embedded” 3 of 82 results differ, and these answers \
                  change: “Does shape matter once size is known?” (no).";
    assert!(found.contains(turned), "{found}");
}
