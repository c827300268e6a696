//! The first screen: what was done, and the answers: sentences of
//! `answers.toml` with the numbers of findings.

use anyhow::Context as _;
use serde::Deserialize;

use crate::basis::FindingSets;
use crate::evidence::Proof;
use crate::law::LawCells;
use crate::quantity::{EstimateText, ValueScale, count_text, effect_text};
use crate::sentences::{SentenceCounts, SuiteResult, by_suite, seen, turned};
use crate::shaking::RockTests;
use crate::timings::Timings;
use rocking_common::findings::{
    Claim, Findings, Seen, SuiteSet, SuiteSummary, Theme,
};
use rocking_common::words::{percent, rounded_text};
use rocking_draw::figures::Figure;

/// The questions that claims answer; the file says what its fields are.
const QUESTIONS: &str = include_str!("../answers.toml");

/// A question of a reader that claims answer.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReaderQuestion {
    question: String,
    by: Vec<String>,
    answer: AnswerTexts,
    #[serde(rename = "number")]
    numbers: Vec<AnswerNumber>,
    figures: Vec<u32>,
    /// Whether shaking-table tests answer as well.
    #[serde(default)]
    tested: bool,
}

/// The sentences of each answer.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct AnswerTexts {
    yes: Vec<String>,
    in_part: Vec<String>,
    no: Vec<String>,
    not_testable: Vec<String>,
}

/// A number of a claim.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AnswerNumber {
    /// Its place in the sentences.
    key: String,
    claim: String,
    /// What is measured, in a few words.
    name: String,
    /// The yardstick that it belongs to; the effect if no yardstick is named.
    count: Option<usize>,
    /// Names of details, of which the largest is shown.
    #[serde(default)]
    details: Vec<String>,
    /// Whether details are shown in per cent.
    #[serde(default)]
    percent: bool,
    /// Whether a detail is of the paper's own grid.
    #[serde(default)]
    paper: bool,
    /// Whether a sentence has the smallest of the suites' numbers; the largest
    /// if not.
    #[serde(default)]
    least: bool,
}

fn reader_questions() -> anyhow::Result<Vec<ReaderQuestion>> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct QuestionFile {
        question: Vec<ReaderQuestion>,
    }
    let file: QuestionFile =
        toml::from_str(QUESTIONS).context("answers.toml")?;
    Ok(file.question)
}

fn claim<'a>(claims: &'a [Claim], id: &str) -> Option<&'a Claim> {
    claims.iter().find(|claim| claim.id == id)
}

impl AnswerNumber {
    /// The number on a suite: its distance from no effect, and its text.
    fn on(
        &self,
        claim: &Claim,
        one: &SuiteResult<'_>,
    ) -> Option<(f64, EstimateText)> {
        if let Some(k) = self.count {
            let (yardstick, count) =
                (claim.yardsticks.get(k)?, one.sample.counts.get(k)?);
            let value = count_text(yardstick, count);
            let text = EstimateText { value, interval: String::new() };
            return Some((count.value, text));
        }
        if self.details.is_empty() {
            let none = claim.no_effect.map_or(0.0, |none| none.value);
            let off = one.effect.estimate.value() - none;
            return Some((off.abs(), effect_text(claim, one.effect)));
        }
        let of = if self.paper { one.sample } else { one.effect };
        let scale = match self.percent {
            true => ValueScale::Percent,
            false => ValueScale::Plain,
        };
        let own = of.details.iter().filter(|d| self.details.contains(&d.name));
        let own = own.map(|d| d.estimate).filter(|e| !e.value().is_nan());
        let worst = own.max_by(|a, b| a.value().total_cmp(&b.value()))?;
        Some((worst.value(), EstimateText::of(&worst, scale, None)))
    }

    /// The number for the sentence, and all of them with intervals and
    /// suites; none without data.
    fn text(&self, claims: &[Claim]) -> Option<(String, String)> {
        let claim = claim(claims, &self.claim)?;
        let suites = by_suite(claim);
        let all = suites.iter().filter_map(|one| {
            let (size, text) = self.on(claim, one)?;
            (!size.is_nan()).then_some((one.suite, size, text))
        });
        let all: Vec<(SuiteSet, f64, EstimateText)> = all.collect();
        let mut listed: Vec<String> = all
            .iter()
            .map(|(_, _, text)| format!("{}{}", text.value, text.interval))
            .collect();
        let first = listed.first()?.clone();
        if listed.len() > 1 && listed.iter().all(|own| *own == first) {
            listed = vec![first + " on both suites"];
        } else if all[0].0 != SuiteSet::Both {
            for (text, (suite, ..)) in listed.iter_mut().zip(&all) {
                *text += &format!(" {suite}");
            }
        }
        let differs = listed.len() > 1;
        let listed = format!("{} {}", self.name, listed.join(", "));
        let by_size = all.into_iter().max_by(|(_, a, _), (_, b, _)| {
            if self.least { b.total_cmp(a) } else { a.total_cmp(b) }
        });
        let (suite, _, text) = by_size?;
        let value = match differs {
            true => format!("{} ({suite})", text.value),
            false => text.value,
        };
        Some((value, listed))
    }
}

impl ReaderQuestion {
    /// Whether its claims are seen; none without data.
    fn lead(&self, claims: &[Claim]) -> Option<Seen> {
        let own = self.by.iter().filter_map(|id| seen(claim(claims, id)?));
        own.reduce(Seen::and)
    }

    /// The sentences of an answer.
    fn sentences(&self, lead: Seen) -> &[String] {
        match lead {
            Seen::Yes => &self.answer.yes,
            Seen::InPart => &self.answer.in_part,
            Seen::No => &self.answer.no,
            Seen::NotTestable => &self.answer.not_testable,
        }
    }

    /// The answer, and its numbers with interval and suite.
    fn answer(&self, claims: &[Claim]) -> (String, String) {
        let Some(lead) = self.lead(claims) else {
            return ("There are no data.".into(), String::new());
        };
        let mut sentences = self.sentences(lead).to_vec();
        let mut listed = Vec::new();
        for number in &self.numbers {
            let Some((value, all)) = number.text(claims) else { continue };
            for sentence in &mut sentences {
                *sentence =
                    sentence.replace(&format!("{{{}}}", number.key), &value);
            }
            listed.push(all);
        }
        // Without its number a sentence ends before its colon.
        for sentence in &mut sentences {
            if sentence.contains('{') {
                let before = sentence.split_once(": ");
                let before = before.filter(|(words, _)| !words.contains('{'));
                *sentence =
                    before.map_or(String::new(), |(w, _)| w.to_owned() + ".");
            }
        }
        sentences.retain(|sentence| !sentence.is_empty());
        (sentences.join(" "), listed.join("; "))
    }
}

/// A row of the first table.
pub struct AnswerRow {
    /// What is asked.
    pub question: String,
    /// The answer: a sentence of 55 words at most.
    pub answer: String,
    /// Its numbers, each with interval, unit and suite.
    pub effect: String,
    /// Anchor and words of where it is shown.
    pub shown: Vec<(String, String)>,
}

/// A question with what the findings of one study answer.
pub(super) struct QuestionAnswer {
    pub question: String,
    /// Whether the claims behind it are seen; none without data.
    pub lead: Option<Seen>,
    /// The sentences.
    pub answer: String,
    numbers: String,
    figures: Vec<u32>,
    tested: bool,
}

/// The questions that claims answer, with their answers.
///
/// # Errors
/// If the questions have been damaged.
pub(super) fn answers(
    findings: &Findings,
) -> anyhow::Result<Vec<QuestionAnswer>> {
    let answered = |own: ReaderQuestion| {
        let (answer, numbers) = own.answer(&findings.claims);
        QuestionAnswer {
            lead: own.lead(&findings.claims),
            answer,
            numbers,
            question: own.question,
            figures: own.figures,
            tested: own.tested,
        }
    };
    Ok(reader_questions()?.into_iter().map(answered).collect())
}

/// The rows of the first table.
///
/// # Errors
/// As [`answers`].
pub(super) fn rows(
    basis: &FindingSets<'_>,
    timings: &Timings,
    proof: Option<&Proof>,
    figures: &[&Figure],
) -> anyhow::Result<Vec<AnswerRow>> {
    let (lead, tests) = (basis.lead(), RockTests::kept()?);
    let claimed = answers(lead)?.into_iter().map(|mut own| {
        if own.tested {
            own.numbers += &format!(
                "; {} ({})",
                tests.on_fragility(),
                tests.below_uplift()
            );
        }
        let shown = own.figures.iter().filter_map(|number| {
            let is = |f: &&&Figure| f.heading.number == Some(*number);
            let name = figures.iter().find(is)?.heading.name.clone();
            Some((name, format!("Figure {number}")))
        });
        let table = own.tested.then(|| link(SHAKING));
        AnswerRow {
            shown: shown.chain(table).collect(),
            question: own.question,
            answer: own.answer,
            effect: own.numbers,
        }
    });
    let row = |question: &str, answer, effect, shown: &[(&str, &str)]| {
        let shown = shown.iter().map(|to| link(*to)).collect();
        AnswerRow { question: question.into(), answer, effect, shown }
    };
    let (fast, rate) = timings.speed();
    let (one, spread) = LawCells::kept()?.answer()?;
    let is_drawn = figures.iter().any(|f| f.heading.name == "law");
    let drawn = is_drawn.then_some(("law", "figure")).into_iter();
    let drawn: Vec<(&str, &str)> =
        drawn.chain([("law-of-avgsa", "annex")]).collect();
    let others = [
        row("Is there one curve for all blocks?", one, spread, &drawn),
        row(
            "How exact and how fast is the computation?",
            format!("{} {fast}", exact(timings, proof, lead)),
            format!(
                "{}; {}; {rate}. Rounding may have changed {} of all analyses",
                backed(proof),
                timings.error(),
                flagged(lead)
            ),
            &[("evidence", "proof"), ("speed", "speed")],
        ),
        row(
            "What was not checked?",
            format!(
                "No object other than two granite rocks, for which the model, \
                 with one angle fitted to each, gives {}. The model leaves out \
                 {LEFT_OUT}.",
                tests.right()
            ),
            format!("{}. {}", tests.right_each(), not_run(basis)),
            &[SHAKING, ("limits", "limits")],
        ),
        row(
            "What may I sign?",
            signed(proof).into(),
            repeatable(basis).into(),
            &[("provenance", "sign-off")],
        ),
    ];
    Ok(claimed.chain(others).collect())
}

/// Anchor and name of the chapter on shaking-table tests.
const SHAKING: (&str, &str) = ("shaking", "tests");

fn link((id, words): (&str, &str)) -> (String, String) {
    (id.into(), words.into())
}

/// What the model leaves out.
pub(super) const LEFT_OUT: &str =
    "sliding, bouncing, vertical motion and flexible supports";

/// What else was not run.
pub(super) fn not_run(basis: &FindingSets<'_>) -> String {
    let records = match (basis.embedded, basis.has_recorded()) {
        (true, true) => "recorded motions (their results are stored), ",
        (true, false) => "recorded motions, ",
        (false, _) => "",
    };
    format!("Not run here: {records}any other machine")
}

fn exact(timings: &Timings, proof: Option<&Proof>, lead: &Findings) -> String {
    let shifts = lead.suites.iter().map(|s| s.largest_shift_if_flipped);
    match proof.map(|proof| (proof.failed(), proof.results().len())) {
        None => "Not known: the reference cases were not run here.".into(),
        Some((0, _)) => format!(
            "{}, and rounding moves no 16, 50 or 84 % overturning intensity \
             under these motions by more than {} g tan α.",
            timings.precision(),
            rounded_text(shifts.fold(0.0, f64::max))
        ),
        Some((failed, all)) => {
            format!("Not known: {failed} of {all} reference cases fail.")
        }
    }
}

/// Which results the run at hand did not compute.
fn repeatable(basis: &FindingSets<'_>) -> &'static str {
    match basis.has_recorded() {
        true => {
            "Recorded results: computed earlier; anyone can repeat those on \
             the motions of FEMA P-695 (python -m rocking.recorded)"
        }
        false => "All results were computed by this run",
    }
}

/// The share of analyses that rounding may have changed.
fn flagged(lead: &Findings) -> String {
    let all: u64 = lead.suites.iter().map(|s| s.analyses).sum();
    let open: usize = lead.suites.iter().map(|s| s.unresolved).sum();
    percent(open as f64 / all as f64, 1)
}

fn signed(proof: Option<&Proof>) -> &'static str {
    match proof.map(Proof::failed) {
        None => "Nothing yet: the reference cases were not run.",
        Some(0) => {
            "That every reference case passes, that the files have the listed \
             hashes, and that the answers agree with the numbers. Not that a \
             real object behaves like the model."
        }
        Some(_) => "Nothing before every reference case passes.",
    }
}

/// What the signatures at the end of the page confirm.
pub(super) fn confirmed(proof: Option<&Proof>) -> &'static str {
    match proof.map(Proof::failed) {
        Some(0) => {
            "By signing I confirm that every reference case passes, that the \
             files of this report have the hashes listed in the annexes, and \
             that the answers agree with the numbers in this report. I do not \
             confirm that a real object behaves like the model."
        }
        _ => {
            "Not every reference case has passed in this report: it cannot be \
             signed yet."
        }
    }
}

fn backed(proof: Option<&Proof>) -> String {
    proof.map_or("No reference case was run".into(), |proof| {
        let (failed, all) = (proof.failed(), proof.results().len());
        format!("{} of {all} reference cases pass", all - failed)
    })
}

/// The suites of findings: `86 ordinary of 22 earthquakes`.
pub(super) fn suites_of(findings: &Findings) -> Vec<String> {
    let words = |suite: &SuiteSummary| {
        let of = suite.earthquakes.map(|n| format!(" of {n} earthquakes"));
        let (records, kind) = (suite.records, suite.kind);
        format!("{records} {kind}{}", of.unwrap_or_default())
    };
    findings.suites.iter().map(words).collect()
}

/// A count with commas between thousands.
fn grouped(n: u64) -> String {
    match n / 1000 {
        0 => n.to_string(),
        more => format!("{},{:03}", grouped(more), n % 1000),
    }
}

/// What was done, the result, and how far it is checked: paragraphs, each with
/// its first word.
///
/// # Errors
/// For kept results that cannot be read.
pub(super) fn summary(
    basis: &FindingSets<'_>,
    proof: Option<&Proof>,
) -> anyhow::Result<[(&'static str, String); 3]> {
    let lead = basis.lead();
    let (motions, records) = match (basis.embedded, basis.has_recorded()) {
        (true, true) => (
            "recorded motions",
            "Records: most may not be redistributed; their results were \
             computed earlier and are stored.",
        ),
        (true, false) => {
            ("synthetic motions", "Records: none; the motions are synthetic.")
        }
        (false, _) => ("the motions of your suites", "Records: your own."),
    };
    let analyses: u64 = lead.suites.iter().map(|s| s.analyses).sum();
    let counts = SentenceCounts::of(lead);
    let tests = RockTests::kept()?;
    Ok([
        (
            "",
            format!(
                "This report repeats and checks a study by Lachanas, Vamvatsikos \
             and Dimitrakopoulos, “Statistical property parameterization of \
             simple rocking block response” (Earthquake Engineering and \
             Structural Dynamics) [1]: which properties of a free-standing \
             object (statue, cabinet, column) decide whether it \
             overturns in an earthquake, and which probability distribution \
             describes that. Our program computed 15 blocks under \
             {motions}, {}: {} analyses.",
                suites_of(lead).join(" and "),
                grouped(analyses),
            ),
        ),
        ("Result.", format!("{} {}", counts.words(), counts.effects())),
        (
            "Status.",
            format!(
                "Equations and statistics: {}. Model: compared with {} only. \
             {records} Nothing on this page by itself justifies leaving a \
             real object unrestrained.",
                backed(proof),
                tests.counted(),
            ),
        ),
    ])
}

/// How many results and which answers differ on the other motions, and what
/// these are; or that recorded results were left out.
///
/// # Errors
/// As [`answers`].
pub(super) fn differing(
    basis: &FindingSets<'_>,
) -> anyhow::Result<Option<String>> {
    if !basis.has_recorded() {
        return basis.left_out();
    }
    let lead = basis.lead();
    let kept = answers(lead)?;
    let mut words = vec![
        "The answers are from the motions “recorded, stored”. “Recorded, \
         repeatable” are those of FEMA P-695, which anyone can install; \
         “embedded” are synthetic motions that come with the program."
            .to_owned(),
    ];
    for (name, found) in basis.columns().into_iter().skip(1) {
        let counted = |claim: &Claim| claim.theme != Theme::Beyond;
        let (turned, all) = turned(found, lead, counted);
        let own = answers(found)?;
        let other = own.iter().zip(&kept).filter(|(a, b)| a.lead != b.lead);
        let other: Vec<String> = other
            .map(|(own, _)| {
                let word = own.lead.map_or("no data", Seen::name);
                format!("“{}” ({word})", own.question)
            })
            .collect();
        let answers = match other.as_slice() {
            [] => "no answer changes".into(),
            other => format!("these answers change: {}", other.join(", ")),
        };
        words.push(format!(
            "On the motions “{name}” {} of {all} results differ, and {answers}.",
            turned.len()
        ));
    }
    Ok(Some(words.join(" ")))
}

#[cfg(test)]
pub(crate) mod tests;
