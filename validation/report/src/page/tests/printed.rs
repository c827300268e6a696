//! Every word on a claim, derived again from the numbers that are printed
//! beside it.

use std::collections::BTreeMap;

use super::{Names, page_of};
use crate::basis;
use crate::tests::committed;
use rocking_common::findings::{Exists, Findings, Seen, Unit};

/// The text of markup, without tags and what is hidden.
fn text(markup: &str) -> String {
    let mut text = String::new();
    for part in markup.split('<') {
        text += part.split_once('>').map_or(part, |(_, words)| words);
    }
    let text = text.replace("&lt;", "<").replace("&gt;", ">");
    text.replace("&amp;", "&")
        .replace(['\u{a0}', '\n'], " ")
        .replace('\u{2060}', "")
}

/// The parts of markup from `start` to the next `end`.
fn parts<'a>(markup: &'a str, start: &str, end: &str) -> Vec<&'a str> {
    let all = markup.split(start).skip(1);
    all.map(|part| part.split(end).next().unwrap()).collect()
}

/// A printed number in its unit: `-0.87 %`, `+infinite`.
fn number(text: &str) -> f64 {
    let first = text.split_whitespace().next().unwrap();
    match first.trim_matches(['(', ')', ';', ',', '.']) {
        "infinite" => f64::INFINITY,
        "-infinite" => f64::NEG_INFINITY,
        other => other.parse().unwrap_or_else(|e| panic!("{text}: {e}")),
    }
}

/// An estimate as it is printed: value, ends, and the unit of the last digit.
struct PrintedEstimate {
    value: f64,
    ends: Option<(f64, f64)>,
    digit: f64,
}

fn estimate(text: &str) -> Option<PrintedEstimate> {
    if text.starts_with("no data") {
        return None;
    }
    let value = number(text);
    let digits = text.split_whitespace().next().unwrap();
    let decimals = digits.split_once('.').map_or(0, |(_, d)| d.len());
    let digit = format!("1e-{decimals}").parse().unwrap();
    let inner = text.split_once(" (").map(|(_, inner)| inner);
    let ends =
        inner.and_then(|inner| inner.split_once(')')?.0.split_once(" to "));
    let ends = ends.map(|(low, high)| (number(low), number(high)));
    Some(PrintedEstimate { value, ends, digit })
}

/// Whether a printed number lies where a printed rule says.
fn holds(rule: &str, value: f64) -> bool {
    if let Some(x) = rule.strip_prefix("at least ") {
        value >= number(x)
    } else if let Some(x) = rule.strip_prefix("above ") {
        value > number(x)
    } else if let Some(x) = rule.strip_prefix("below ") {
        value < number(x)
    } else if let Some((a, b)) = rule.split_once(" to ") {
        number(a) <= value && value <= number(b)
    } else {
        value == number(rule)
    }
}

/// The word on a sample, from rules and printed numbers.
fn seen(rules: &[String], counts: &str) -> Seen {
    let counts: Vec<&str> = counts.split("; ").collect();
    assert_eq!(rules.len(), counts.len(), "{rules:?} {counts:?}");
    if counts.contains(&"no data") {
        return Seen::NotTestable;
    }
    let each = rules.iter().zip(counts);
    let each: Vec<bool> =
        each.map(|(rule, count)| holds(rule, number(count))).collect();
    match (each.contains(&true), each.contains(&false)) {
        (true, false) => Seen::Yes,
        (false, true) => Seen::No,
        _ => Seen::InPart,
    }
}

/// The word on an effect, from what is said and printed ends.
fn exists(said: Option<&str>, effect: Option<&PrintedEstimate>) -> String {
    let Some(said) = said else { return "\u{2013}".into() };
    let words: Vec<&str> = said.splitn(2, ' ').collect();
    let (how, none) = match words[..] {
        [how @ ("above" | "below" | "not"), none] => (how, number(none)),
        _ => ("none", number(said.trim_start_matches("none ("))),
    };
    let ends = effect.and_then(|effect| effect.ends);
    let Some((low, high)) = ends else { return "no sign".into() };
    let word = match (how, low > none, high < none) {
        (_, false, false) => Exists::NoSign,
        ("above", false, _) | ("below", _, false) => Exists::Opposite,
        _ => Exists::Yes,
    };
    word.name().into()
}

/// What is printed of a claim: its rules, and what it says of its effect.
struct PrintedClaim {
    sentence: String,
    theme: String,
    rules: Vec<String>,
    said: Option<String>,
    seen: Vec<Seen>,
    exists: Vec<String>,
}

impl PrintedClaim {
    /// Whether an effect is named; a number alone denies one.
    fn names(&self) -> bool {
        let starts = ["above ", "below ", "not "];
        let said = self.said.as_deref();
        said.is_none_or(|said| starts.iter().any(|s| said.starts_with(s)))
    }
}

/// The rules and the effect in a cell of statements.
fn rules(cell: &str) -> (Vec<String>, Option<String>) {
    let (_, rest) = cell.split_once("Seen: ").expect(cell);
    let rule = |words: &str| words.rsplit_once(", ").expect(cell).1.to_owned();
    let (rules, said) = match rest.split_once(". Effect: ") {
        Some((rules, said)) => (rules, Some(said.to_owned())),
        None => (rest, None),
    };
    (rules.split("; ").map(rule).collect(), said)
}

/// The cells of a row, by their labels.
fn cells(row: &str) -> BTreeMap<String, String> {
    let cells = row.split("<td").skip(1);
    cells
        .map(|cell| {
            let label = cell.split_once("data-label=\"").unwrap().1;
            let label = label.split('"').next().unwrap();
            let cell = format!("<td{cell}");
            (label.to_owned(), text(&cell).trim().to_owned())
        })
        .collect()
}

/// A word behind its sign, and the rest.
fn marked(cell: &str) -> (&str, &str) {
    let words = cell.split_once(' ').map_or(cell, |(_, words)| words);
    let all = Seen::ALL
        .map(Seen::name)
        .into_iter()
        .chain(Exists::ALL.map(Exists::name));
    let mut all: Vec<&str> = all.collect();
    all.sort_by_key(|name| std::cmp::Reverse(name.len()));
    let word = all.into_iter().find(|name| words.starts_with(name));
    word.map_or((cell, ""), |word| (word, words[word.len()..].trim()))
}

/// Reads the tables of findings; every word in them follows from what is
/// printed beside it.
fn checked(html: &str) -> BTreeMap<String, PrintedClaim> {
    let mut out: BTreeMap<String, PrintedClaim> = BTreeMap::new();
    let mut sentence = String::new();
    let mut id = String::new();
    for theme in html.split("<div id=\"theme-").skip(1) {
        let name = theme.split('"').next().unwrap();
        let table =
            theme.split_once("<table class=\"cards findings\"").unwrap().1;
        let body = parts(table, "<tbody>", "</tbody>")[0];
        for row in body.split("<tr").skip(1) {
            if let Some(own) = row.strip_prefix(" id=\"finding-") {
                id = own.split('"').next().unwrap().into();
            }
            if let Some(quote) = row.split_once('\u{201c}') {
                sentence = quote.1.split('\u{201d}').next().unwrap().into();
            }
            let cells = cells(row);
            if let Some(head) = row.split_once("<th") {
                let head = head.1.split("</th>").next().unwrap();
                let (rules, said) = rules(&text(head));
                let (seen, exists) = (Vec::new(), Vec::new());
                let (sentence, theme) = (sentence.clone(), name.into());
                let one = PrintedClaim {
                    sentence,
                    theme,
                    rules,
                    said,
                    seen,
                    exists,
                };
                out.insert(id.clone(), one);
            }
            let own = out.get_mut(&id).unwrap();
            let cell = |start: &str| {
                let mut all =
                    cells.iter().filter(|(label, _)| label.starts_with(start));
                let lead = all
                    .clone()
                    .find(|(label, _)| !label.ends_with("embedded"));
                &lead.or_else(|| all.next()).unwrap().1[..]
            };
            let (word, counts) = marked(cell("Seen here"));
            let found = seen(&own.rules, counts);
            assert_eq!(word, found.name(), "{id}: {counts}, {:?}", own.rules);
            let effect = estimate(cell("How large"));
            let said =
                own.said.as_deref().filter(|_| found != Seen::NotTestable);
            let found_effect = exists(said, effect.as_ref());
            let (word, _) = marked(cell("Beyond"));
            assert_eq!(word, found_effect, "{id}: {}", cell("How large"));
            own.seen.push(found);
            own.exists.push(found_effect);
        }
    }
    assert!(out.len() > 40, "{} claims", out.len());
    for row in parts(html, "<a href=\"#finding-", "</tr>") {
        let own = &out[row.split('"').next().unwrap()];
        for outcome in parts(row, "<div class=\"outcome\">", "</div>") {
            result(own, &text(outcome));
        }
    }
    out
}

/// A result among all results: its words follow, too.
fn result(own: &PrintedClaim, outcome: &str) {
    let (_, sample) = outcome.split_once(": ").unwrap();
    let (sample, effect) =
        sample.split_once("; beyond these records: ").unwrap();
    let (word, counts) = marked(sample);
    let found = seen(&own.rules, counts.trim_start_matches(", "));
    assert_eq!(word, found.name(), "{outcome}");
    let (word, effect) = effect.split_once(", ").unwrap();
    let said = own.said.as_deref();
    let said = said.filter(|_| found != Seen::NotTestable);
    let found = exists(said, estimate(effect).as_ref());
    assert_eq!(marked(word).0, found, "{outcome}");
}

/// The findings of the recorded and of the embedded suites, each as a run on
/// suites of its own would show them.
fn sides() -> [(Findings, String); 2] {
    [basis::recorded(), committed()].map(|findings| {
        let names = Names { own_suites: true, ..Names::default() };
        let html = page_of(names, findings.clone());
        (findings, html)
    })
}

#[test]
fn every_word_and_the_score_follow_from_the_numbers_beside_them() {
    for (findings, html) in sides() {
        let all = checked(&html);
        let mut sentences: BTreeMap<&str, Vec<&PrintedClaim>> =
            BTreeMap::new();
        for own in all.values().filter(|own| own.theme != "beyond") {
            sentences.entry(&own.sentence).or_default().push(own);
        }
        let words = sentences.values().map(|claims| {
            let seen = claims.iter().flat_map(|own| &own.seen);
            let known = seen.filter(|seen| **seen != Seen::NotTestable);
            let known: Vec<Seen> = known.copied().collect();
            match known.first() {
                None => Seen::NotTestable,
                Some(first) if known.iter().all(|s| s == first) => *first,
                Some(_) => Seen::InPart,
            }
        });
        let words: Vec<Seen> = words.collect();
        let count = |seen| words.iter().filter(|own| **own == seen).count();
        let effects = |names: bool, is: &dyn Fn(&[&str]) -> bool| {
            let of = |claims: &&Vec<&PrintedClaim>| {
                let claims = claims.iter().filter(|own| own.names() == names);
                let all = claims.flat_map(|own| &own.exists);
                let all = all.map(String::as_str).filter(|e| *e != "\u{2013}");
                is(&all.collect::<Vec<&str>>())
            };
            sentences.values().filter(of).count()
        };
        let score = format!(
            "Of {} statements of the paper, {} are seen again by the \
             authors' own criteria, {} are not, and {} in part; {} cannot be \
             tested with these records.",
            words.len(),
            count(Seen::Yes),
            count(Seen::No),
            count(Seen::InPart),
            count(Seen::NotTestable),
        );
        let found = format!(
            "Beyond these records, the effect that a statement names is shown \
             on every suite for {} and its opposite for {}; {} deny an effect \
             that exists, however small.",
            effects(true, &|all| {
                !all.is_empty() && all.iter().all(|e| *e == "yes")
            }),
            effects(true, &|all| all.contains(&"the opposite")),
            effects(false, &|all| all.contains(&"yes")),
        );
        for score in [score, found] {
            assert!(text(&html).contains(&score), "{score}");
        }
        // A page of it all has every claim.
        let findings =
            findings.claims.iter().filter(|c| !c.results.is_empty());
        assert_eq!(findings.count(), all.len());
    }
}

#[test]
fn first_words_of_answers_follow_from_the_words_below() {
    for (findings, html) in sides() {
        let all = checked(&html);
        for (answer, by, leads) in crate::answers::tests::leads(&findings) {
            let known = by.iter().flat_map(|id| &all[id].seen);
            let known = known.filter(|seen| **seen != Seen::NotTestable);
            let known: Vec<Seen> = known.copied().collect();
            let lead = match (
                known.contains(&Seen::Yes),
                known.contains(&Seen::No),
            ) {
                _ if known.contains(&Seen::InPart) => 1,
                (true, true) => 1,
                (true, false) => 0,
                (false, true) => 2,
                (false, false) => 3,
            };
            assert!(answer.starts_with(&leads[lead]), "{answer}");
            assert!(text(&html).contains(&answer), "{answer}");
        }
    }
}

/// Every interval lies in the range of its quantity and holds its value, and
/// has no digit that other draws would change, but to show on which side of
/// no effect an end lies.
#[test]
fn printed_intervals_are_possible_and_settled() {
    for (findings, html) in sides() {
        let mut found = 0;
        for outcome in parts(&html, "<div class=\"outcome\">", "</div>") {
            let outcome = text(outcome);
            let (place, rest) =
                outcome.split_once("; beyond these records: ").unwrap();
            let (_, effect) = rest.split_once(", ").unwrap();
            let Some(effect) = estimate(effect) else { continue };
            let Some((low, high)) = effect.ends else { continue };
            found += 1;
            assert!(low <= effect.value && effect.value <= high, "{outcome}");
            let half = (high - effect.value).max(effect.value - low);
            let unit = effect.digit;
            // 1/sqrt(2 x 2000) of a half-width, which itself is rounded.
            let scatter = (half - unit) / 4000_f64.sqrt();
            let coarse = |x: f64| (x / unit / 10.0).round() * unit * 10.0;
            let none = [0.0, 1.0, 16.0, 50.0, 90.0];
            // The end that was rounded to what is printed.
            let ends = [low, high].into_iter().flat_map(|end| {
                [-0.49, 0.0, 0.49].map(|part| end + part * unit)
            });
            let turns = ends.into_iter().any(|end| {
                none.iter().any(|none| {
                    (coarse(end) > *none) != (end > *none)
                        || (coarse(end) < *none) != (end < *none)
                })
            });
            assert!(
                turns || !half.is_finite() || scatter < 0.5 * unit,
                "{place}: {outcome}"
            );
        }
        assert!(found > 100, "{found}");
        for claim in &findings.claims {
            for result in &claim.results {
                let (low, high) = match result.unit {
                    Unit::Share => (0.0, 1.0),
                    Unit::Points | Unit::Distance | Unit::Probability => {
                        (-1.0, 1.0)
                    }
                    Unit::One | Unit::Count => (0.0, f64::INFINITY),
                };
                let Some(interval) = result.estimate.interval() else {
                    continue;
                };
                let id = &claim.id;
                assert!(interval.holds(result.estimate.value()), "{id}");
                assert!(
                    low <= interval.low() && interval.high() <= high,
                    "{id}"
                );
                assert!(
                    interval.low() < interval.high(),
                    "{id}, {}",
                    result.place()
                );
            }
        }
    }
}
