//! The answers of the page, each made from verdicts and measured numbers by
//! one rule, and what stands about every theme and every suite.

use crate::evidence::Proof;
use crate::page::AnswerRow;
use crate::quantity::{cell_text, rule_text, value_text};
use crate::timings::Timings;
use rocking_common::findings::{Claim, ClaimResult, Findings, Theme};
use rocking_common::paper::{Arm, Verdict};
use rocking_common::words::rounded_text;
use rocking_draw::figures::Figure;
use rocking_study::analyses::SuiteResults;
use rocking_study::results::Results;

/// A part of a question: its short name, and the claims that answer it.
type Part = (&'static str, &'static [&'static str]);

/// A question that claims answer: words, parts, the claim whose number is
/// shown, and the figures.
struct Asked {
    question: &'static str,
    parts: &'static [Part],
    /// What that number is.
    name: &'static str,
    effect: &'static str,
    /// What the answer leaves out: words, and the claim with their number.
    except: Option<(&'static str, &'static str)>,
    figures: &'static [u32],
}

const ASKED: [Asked; 4] = [
    Asked {
        question: "Is the slenderness normalized out of the statistics, at \
                   constant restitution?",
        parts: &[
            ("ratios on stripes", &["ratios-p1", "ratios-p3-p4"]),
            ("ratios at demands", &["ratios-at-demand"]),
            ("quantiles", &["quantiles-coincide"]),
        ],
        name: "Median ratio, p = 3 and 4",
        effect: "ratios-p3-p4",
        except: Some(("with Housner's restitution", "housner-breaks")),
        figures: &[6, 7, 8],
    },
    Asked {
        question: "Do scaled records and an adjusted slenderness give the \
                   same statistics?",
        parts: &[
            ("ratios", &["adjustment-ratios"]),
            ("quantiles", &["adjustment-quantiles"]),
        ],
        name: "Median ratio, adjusted over scaled",
        effect: "adjustment-ratios",
        except: None,
        figures: &[9, 10],
    },
    Asked {
        question: "Does the shifted lognormal fit capacities, in PGA better \
                   than the unshifted one?",
        parts: &[
            ("distance in PGA", &["shift-gains-pga"]),
            ("lognormality in PGA", &["shift-better-pga"]),
            ("lognormality in PGV", &["pgv-shifted"]),
        ],
        name: "Gain in distance to the sample in PGA",
        effect: "shift-gains-pga",
        except: None,
        figures: &[12, 14, 15],
    },
    Asked {
        question: "Do Eqs. 5 to 7 give the shifted fragility?",
        parts: &[
            ("untrimmed PGV", &["eq7-untrimmed-pgv"]),
            ("trimmed PGA", &["eq7-trimmed-pga"]),
            ("untrimmed PGA", &["eq7-untrimmed-fails-pga"]),
        ],
        name: "Trimmed PGA, distance to the shifted lognormal",
        effect: "eq7-trimmed-pga",
        except: None,
        figures: &[16, 17, 18],
    },
];

/// The claim that Eq. 7 fails: its verdict speaks against the question.
const AGAINST: &str = "eq7-untrimmed-fails-pga";

/// How many results of a part have which verdict.
#[derive(Clone, Copy, Default)]
struct Count {
    yes: usize,
    no: usize,
    open: usize,
}

impl Count {
    fn of(findings: &Findings, claims: &[&str]) -> Self {
        let first = first_arm(findings);
        let mut count = Self::default();
        let own = |c: &&Claim| claims.contains(&c.id.as_str());
        for claim in findings.claims.iter().filter(own) {
            let against = claim.id == AGAINST;
            for result in &claim.results {
                if result.arm.is_some_and(|arm| arm != first) {
                    continue;
                }
                match result.by_equivalence {
                    Some(Verdict::Confirmed) if against => count.no += 1,
                    Some(Verdict::NotConfirmed) if against => count.yes += 1,
                    Some(Verdict::Confirmed) => count.yes += 1,
                    Some(Verdict::NotConfirmed) => count.no += 1,
                    Some(Verdict::Inconclusive) => count.open += 1,
                    None => {}
                }
            }
        }
        count
    }

    fn all(self) -> usize {
        self.yes + self.no + self.open
    }

    fn words(self) -> String {
        let Self { yes, no, open } = self;
        format!("{yes} for, {no} against, {open} open")
    }
}

/// The arm that stands among the findings.
pub(super) fn first_arm(findings: &Findings) -> Arm {
    let arms = &findings.settings.arms;
    if arms.contains(&Arm::C) { Arm::C } else { Arm::A }
}

/// An answer from the verdicts of its parts: its word, and what follows it.
///
/// Yes: every result speaks for it. No: none does and some speak against.
/// Nearly: none speaks against, and more than half for it. Only for: whole
/// parts speak for it, others do not. Open: the rest.
fn answered(parts: &[(&str, Count)]) -> (&'static str, String) {
    let sum = |of: fn(&Count) -> usize| -> usize {
        parts.iter().map(|(_, count)| of(count)).sum()
    };
    let (yes, no) = (sum(|c| c.yes), sum(|c| c.no));
    let all = sum(|c| c.all());
    let names = |is: fn(&Count) -> bool| -> String {
        let found = parts.iter().filter(|(_, count)| is(count));
        let names: Vec<&str> = found.map(|(name, _)| *name).collect();
        names.join(", ")
    };
    let whole = names(|c| c.all() > 0 && c.yes == c.all());
    let open = names(|c| c.no == 0 && c.yes < c.all());
    let against = names(|c| c.no > 0);
    let rest = |words: &str, names: &str| match names {
        "" => String::new(),
        _ => format!("; {words} {names}"),
    };
    let rest = rest("open for", &open) + &rest("not for", &against);
    if all == 0 {
        ("Open", ": there are no data.".into())
    } else if yes == all {
        ("Yes", format!(": all {all} results confirm it."))
    } else if yes == 0 && no > 0 {
        let words =
            format!(": {no} of {all} results refute it, none confirms it.");
        ("No", words)
    } else if whole.is_empty() {
        ("Open", format!(": {yes} of {all} results for it, {no} against."))
    } else if no == 0 && 2 * yes > all {
        ("Nearly", format!(": for {whole}{rest}."))
    } else {
        ("Only", format!(" for {whole}{rest}."))
    }
}

/// That answer as a sentence.
fn sentence(parts: &[(&str, Count)]) -> String {
    let (word, rest) = answered(parts);
    word.to_owned() + &rest
}

/// The questions with their answers by the findings of one study.
pub(super) fn answers(findings: &Findings) -> Vec<(&'static str, String)> {
    let answer = |asked: &Asked| {
        let count = |(name, ids): &Part| (*name, Count::of(findings, ids));
        let parts: Vec<_> = asked.parts.iter().map(count).collect();
        (asked.question, sentence(&parts))
    };
    ASKED.iter().map(answer).collect()
}

/// The rows of the first table. The first of `recorded` and `here` that
/// there is leads.
pub(super) fn rows(
    embedded: bool,
    here: &Findings,
    recorded: Option<&Findings>,
    timings: &Timings,
    proof: Option<&Proof>,
    figures: &[&Figure],
) -> Vec<AnswerRow> {
    let sources: Vec<&Findings> = recorded.into_iter().chain([here]).collect();
    let lead = recorded.unwrap_or(here);
    let mut rows: Vec<AnswerRow> = ASKED
        .iter()
        .map(|asked| {
            let counts = |findings: &Findings| -> Vec<(&str, Count)> {
                let parts = asked.parts.iter();
                parts.map(|(n, ids)| (*n, Count::of(findings, ids))).collect()
            };
            let column = |findings: &&Findings| {
                let all = asked.parts.iter().flat_map(|(_, ids)| *ids);
                let all: Vec<&str> = all.copied().collect();
                let (word, _) = answered(&counts(findings));
                let counts = Count::of(findings, &all).words();
                match sources.len() {
                    1 => counts,
                    _ => format!("{word}: {counts}"),
                }
            };
            let shown = asked.figures.iter().filter_map(|number| {
                let is = |f: &&&Figure| f.heading.number == Some(*number);
                let name = figures.iter().find(is)?.heading.name.clone();
                Some((name, format!("Figure {number}")))
            });
            AnswerRow {
                question: asked.question.into(),
                answer: sentence(&counts(lead)),
                effect: effect(lead, asked),
                columns: sources.iter().map(column).collect(),
                shown: shown.collect(),
            }
        })
        .collect();
    let same = |words: &str| vec![words.to_owned(); sources.len()];
    let to = |id: &str, words: &str| vec![(id.into(), words.into())];
    rows.push(AnswerRow {
        question: "Does the integrator pass every declared case?".into(),
        answer: accuracy(proof),
        effect: timings.error(),
        columns: same(""),
        shown: match proof {
            Some(_) => to("evidence", "proof"),
            None => Vec::new(),
        },
    });
    let (answer, rate) = timings.speed();
    rows.push(AnswerRow {
        question: "Is it faster than other tools at no larger error?".into(),
        answer,
        effect: rate,
        columns: same(""),
        shown: to("speed", "speed"),
    });
    rows.push(AnswerRow {
        question: "What was not checked?".into(),
        answer: "Open: the model against experiments, and what it leaves out."
            .into(),
        effect: not_checked(embedded),
        columns: same(""),
        shown: to("limits", "limits"),
    });
    rows
}

/// False discovery rate that decisions are held against.
const FALSE_DISCOVERIES: f64 = 0.05;

/// The number of a claim on the suite and arm where it is worst.
fn effect(findings: &Findings, asked: &Asked) -> String {
    let own = |c: &&Claim| c.id == asked.effect;
    let Some(claim) = findings.claims.iter().find(own) else {
        return String::new();
    };
    let Some(region) = claim.region else { return String::new() };
    let value = |r: &ClaimResult| {
        r.deciding_cell.as_ref().map_or(r.value, |c| c.measured.value)
    };
    let worst =
        claim.results.iter().filter(|r| !value(r).is_nan()).max_by(|a, b| {
            let bad = |r| region.badness(value(r));
            bad(a).total_cmp(&bad(b))
        });
    let Some(worst) = worst else { return "no data".into() };
    let text = match &worst.deciding_cell {
        Some(cell) => cell_text(claim, cell.measured),
        None => value_text(claim, worst),
    };
    format!(
        "{}: worst judged {text}, {}; limit {}{}",
        asked.name,
        worst.suite.name(),
        rule_text(claim),
        exception(findings, asked)
    )
}

/// The number of what an answer leaves out.
fn exception(findings: &Findings, asked: &Asked) -> String {
    let number = |(words, id): (&str, &str)| {
        let claim = findings.claims.iter().find(|c| c.id == id)?;
        let result = claim.results.first()?;
        Some(format!("; {words} {}", value_text(claim, result)))
    };
    asked.except.and_then(number).unwrap_or_default()
}

fn accuracy(proof: Option<&Proof>) -> String {
    let Some(proof) = proof else {
        return "Open: the declared cases were not run here.".into();
    };
    let (passed, all) = (proof.passed(), proof.results().len());
    if passed == all {
        format!("Yes: all {all} pass.")
    } else {
        format!("No: {} of {all} fail.", all - passed)
    }
}

/// What the work on a suite was, and what rounding may have changed.
pub(super) fn work(suite: &SuiteResults) -> String {
    let certainty = suite.work.certainty;
    let work = format!(
        "{} {} records, {} analyses",
        suite.records.len(),
        suite.kind,
        suite.work.analyses
    );
    if certainty.unresolved == 0 {
        return format!("{work}; double precision tells every one.");
    }
    let ends = certainty.reevaluated;
    format!(
        "{work}. In {} of them the motion is chaotic, and rounding in double \
         precision may have changed the peak or the fate. {} of these are \
         first overturnings, on which capacities rest. Assessed double \
         precision resolves {}, double-double {}, octuple precision {}, none \
         {}. {} had been wrong; the 16, 50 and 84 % overturning intensities \
         would move by {} at most.",
        certainty.unresolved,
        ends.all,
        ends.resolved_by_double,
        ends.resolved_by_double_double,
        ends.resolved_by_octuple,
        ends.unresolved,
        ends.wrong_in_double,
        rounded_text(certainty.largest_shift)
    )
}

/// How many analyses rounding may have changed, in a sentence.
pub(super) fn rounding(results: &Results) -> String {
    let suites = [&results.ordinary, &results.pulse];
    let all: u64 = suites.iter().map(|s| s.work.analyses).sum();
    let open = suites.iter().map(|s| s.work.certainty.unresolved);
    format!(
        "In {} of {all} analyses rounding may have changed the peak or the \
         fate. First overturnings among them are resolved in wider arithmetic \
         (annex).",
        open.sum::<usize>()
    )
}

/// How many decisions chance may have given, by the two false discovery
/// rates.
pub(super) fn trust(
    findings: &Findings,
    recorded: Option<&Findings>,
) -> String {
    let counts = |findings: &Findings| {
        let found = findings.withdrawn(FALSE_DISCOVERIES);
        format!(
            "{} (any dependence: {}) of {}",
            found.positive, found.any, found.decided
        )
    };
    let counts = match recorded {
        Some(recorded) => {
            format!(
                "{} recorded, {} embedded",
                counts(recorded),
                counts(findings)
            )
        }
        None => counts(findings),
    };
    format!(
        "Chance. Kept to 5 % false discoveries (Benjamini and Hochberg; \
         Benjamini and Yekutieli), we would withdraw {counts} decisions."
    )
}

pub(super) fn not_checked(embedded: bool) -> String {
    let records = if embedded {
        "recorded motions anew (their results are kept), "
    } else {
        ""
    };
    format!(
        "Shaking tables, {records}sliding, bouncing, vertical \
         motion, flexible supports, other machines than x86-64 Linux"
    )
}

/// What came out about a theme: the plain words of its findings by verdict,
/// and where another suite says something else.
pub(super) fn by_theme(
    theme: Theme,
    here: &Findings,
    recorded: Option<&Findings>,
) -> String {
    let lead = recorded.unwrap_or(here);
    let own = |findings: &Findings| -> Vec<(String, Verdict)> {
        let first = first_arm(findings);
        let claims = findings.claims.iter().filter(|c| c.theme == theme);
        claims
            .filter_map(|c| Some((c.plain.clone(), whole(c, first)?)))
            .collect()
    };
    let found = own(lead);
    let listed = |verdict: Verdict| -> String {
        let names = found.iter().filter(|(_, v)| *v == verdict);
        let names: Vec<&str> = names.map(|(name, _)| name.as_str()).collect();
        names.join("; ")
    };
    let sentences = sentences(lead, |claim| claim.theme == theme);
    let hold = sentences.iter().filter(|v| **v == Verdict::Confirmed);
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
    let refuted = listed(Verdict::NotConfirmed);
    if !refuted.is_empty() {
        words += &format!(". Not confirmed: {refuted}");
    }
    let open = found.iter().filter(|(_, v)| *v == Verdict::Inconclusive);
    match open.count() {
        0 => {}
        1 => words += ". One claim is inconclusive",
        n => words += &format!(". {n} claims are inconclusive"),
    }
    if recorded.is_none() {
        return words + ".";
    }
    let others = own(here);
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

/// The verdict on each sentence of the paper: confirmed where every claim in
/// it is, not confirmed where one is refuted.
fn sentences(
    findings: &Findings,
    of: impl Fn(&Claim) -> bool,
) -> Vec<Verdict> {
    let first = first_arm(findings);
    let mut found: Vec<(&str, Verdict)> = Vec::new();
    for claim in findings.claims.iter().filter(|c| of(c)) {
        let Some(verdict) = whole(claim, first) else { continue };
        match found.iter_mut().find(|(quote, _)| *quote == claim.quote) {
            Some((_, sentence)) => *sentence = worse(*sentence, verdict),
            None => found.push((&claim.quote, verdict)),
        }
    }
    found.into_iter().map(|(_, verdict)| verdict).collect()
}

/// The worse of two verdicts.
fn worse(a: Verdict, b: Verdict) -> Verdict {
    match (a, b) {
        (Verdict::NotConfirmed, _) | (_, Verdict::NotConfirmed) => {
            Verdict::NotConfirmed
        }
        (Verdict::Confirmed, other) => other,
        (Verdict::Inconclusive, _) => Verdict::Inconclusive,
    }
}

/// How many sentences of the paper have which verdict, in the order of
/// [`Verdict::ALL`]; what goes beyond the paper is none of them.
pub fn score(findings: &Findings) -> Vec<(Verdict, usize)> {
    let all = sentences(findings, |claim| claim.theme != Theme::Beyond);
    let count = |v: Verdict| all.iter().filter(|own| **own == v).count();
    Verdict::ALL.into_iter().map(|v| (v, count(v))).collect()
}

/// Whether a claim holds by the limits here and nowhere by the paper's own
/// criterion.
fn by_criterion_fails(claim: &Claim) -> bool {
    let fails = |r: &&ClaimResult| {
        r.by_equivalence == Some(Verdict::Confirmed)
            && r.by_criterion == Some(Verdict::NotConfirmed)
    };
    let all = claim.results.iter().filter(|r| r.by_equivalence.is_some());
    let failing = claim.results.iter().filter(fails).count();
    failing > 0 && failing == all.count()
}

/// The verdict on a claim over its suites: confirmed where each of them
/// confirms it, not confirmed where one refutes it.
fn whole(claim: &Claim, first: Arm) -> Option<Verdict> {
    let shown = |arm: Option<Arm>| arm.is_none_or(|arm| arm == first);
    let verdicts: Vec<Verdict> = claim
        .results
        .iter()
        .filter(|r| shown(r.arm))
        .filter_map(|r| r.by_equivalence)
        .collect();
    let all = |v: &Verdict| *v == Verdict::Confirmed;
    if verdicts.is_empty() {
        None
    } else if verdicts.iter().all(all) {
        Some(Verdict::Confirmed)
    } else if verdicts.contains(&Verdict::NotConfirmed) {
        Some(Verdict::NotConfirmed)
    } else {
        Some(Verdict::Inconclusive)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn count(yes: usize, no: usize, open: usize) -> Count {
        Count { yes, no, open }
    }

    #[test]
    fn answers_follow_from_the_verdicts_of_their_parts() {
        let (good, bad) = (count(4, 0, 0), count(0, 4, 0));
        let (open, mixed) = (count(1, 0, 3), count(3, 1, 0));
        for (parts, answer) in [
            (vec![("a", good), ("b", good)], "Yes: all 8 results"),
            (vec![("a", bad), ("b", bad)], "No: 8 of 8 results refute it"),
            (vec![("a", good), ("b", open)], "Nearly: for a; open for b."),
            (
                vec![("a", good), ("b", open), ("c", bad)],
                "Only for a; open for b; not for c.",
            ),
            (vec![("a", mixed), ("b", open)], "Open: 4 of 8 results"),
            (vec![("a", count(0, 0, 4))], "Open: 0 of 4 results"),
            (vec![("a", count(0, 0, 0))], "Open: there are no data."),
        ] {
            let found = sentence(&parts);
            assert!(found.starts_with(answer), "{found:?}, {answer:?}");
        }
    }

    #[test]
    fn answers_have_at_most_fifteen_words_and_rest_on_claims() {
        let recorded = crate::recorded::recorded().unwrap();
        for asked in &ASKED {
            let ids = asked.parts.iter().flat_map(|(_, ids)| *ids);
            for id in ids.chain([&asked.effect]) {
                let there = recorded.claims.iter().any(|c| c.id == *id);
                assert!(there, "{id}");
            }
            for (first, other) in [
                (count(1, 0, 0), count(0, 1, 0)),
                (count(1, 0, 0), count(0, 0, 1)),
                (count(0, 0, 1), count(0, 0, 1)),
            ] {
                let parts = asked.parts.iter().enumerate();
                let parts: Vec<(&str, Count)> = parts
                    .map(|(k, (n, _))| {
                        (*n, if k == 0 { first } else { other })
                    })
                    .collect();
                let found = sentence(&parts);
                assert!(found.split(' ').count() <= 15, "{found}");
            }
        }
    }
}
