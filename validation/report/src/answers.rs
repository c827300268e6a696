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
use rocking_common::words::rounded_text;
use rocking_draw::figures::Figure;

/// The questions that claims answer; the file says what its fields are.
const ASKED: &str = include_str!("../answers.toml");

/// A question of a reader that claims answer.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReaderQuestion {
    question: String,
    by: Vec<String>,
    leads: [String; 4],
    facts: Vec<AnswerFact>,
    figures: Vec<u32>,
    /// Whether shaking-table tests answer as well.
    #[serde(default)]
    tested: bool,
}

/// A clause of an answer, with numbers where it has braces.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct AnswerFact {
    words: String,
    /// A claim, and whether it is seen, if that makes it true.
    when: Option<(String, Seen)>,
    numbers: Vec<FactNumber>,
}

/// A number of a claim.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FactNumber {
    claim: String,
    /// What is measured, in a few words.
    name: String,
    /// Which of the yardsticks it is of; the effect where none is named.
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
    /// Whether the smallest of the suites' numbers stands in the sentence; the
    /// largest otherwise.
    #[serde(default)]
    least: bool,
}

fn asked() -> anyhow::Result<Vec<ReaderQuestion>> {
    #[derive(Deserialize)]
    #[serde(deny_unknown_fields)]
    struct QuestionFile {
        asked: Vec<ReaderQuestion>,
    }
    let file: QuestionFile = toml::from_str(ASKED).context("answers.toml")?;
    Ok(file.asked)
}

fn claim<'a>(claims: &'a [Claim], id: &str) -> Option<&'a Claim> {
    claims.iter().find(|claim| claim.id == id)
}

impl FactNumber {
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
        let listed = format!("{} {}", self.name, listed.join(", "));
        let by_size = all.into_iter().max_by(|(_, a, _), (_, b, _)| {
            if self.least { b.total_cmp(a) } else { a.total_cmp(b) }
        });
        Some((by_size?.2.value, listed))
    }
}

impl AnswerFact {
    /// The clause, and its numbers; none where it is not true, or lacks data.
    fn text(&self, claims: &[Claim]) -> Option<(String, Vec<String>)> {
        if let Some((id, word)) = &self.when {
            seen(claim(claims, id)?).filter(|found| found == word)?;
        }
        let mut words = self.words.clone();
        let mut listed = Vec::new();
        for number in &self.numbers {
            let (value, all) = number.text(claims)?;
            words = words.replacen("{}", &value, 1);
            listed.push(all);
        }
        Some((words, listed))
    }
}

impl ReaderQuestion {
    /// Whether its claims are seen; none without data.
    fn lead(&self, claims: &[Claim]) -> Option<Seen> {
        let own = self.by.iter().filter_map(|id| seen(claim(claims, id)?));
        own.reduce(Seen::and)
    }

    /// The first words of an answer.
    fn first(&self, seen: Seen) -> &str {
        let at = Seen::ALL.iter().position(|own| *own == seen);
        at.map_or("", |at| &self.leads[at])
    }

    /// The answer, and its numbers with the blocks that they are of.
    fn answer(&self, claims: &[Claim]) -> (String, String) {
        let Some(lead) = self.lead(claims) else {
            return ("There are no data.".into(), String::new());
        };
        let (mut facts, mut numbers) = (Vec::new(), Vec::new());
        for (words, listed) in self.facts.iter().filter_map(|f| f.text(claims))
        {
            facts.push(words);
            numbers.extend(listed);
        }
        let facts = facts.join("; ");
        let joint = if facts.is_empty() { "" } else { ": " };
        let lead = self.first(lead);
        (format!("{lead}{joint}{facts}."), numbers.join("; "))
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
    /// The words for that.
    pub first: String,
    /// The sentence.
    pub answer: String,
    numbers: String,
    figures: Vec<u32>,
    tested: bool,
}

/// The questions that claims answer, with their answers.
///
/// # Errors
/// Where the questions have been damaged.
pub(super) fn answers(
    findings: &Findings,
) -> anyhow::Result<Vec<QuestionAnswer>> {
    let answered = |asked: ReaderQuestion| {
        let lead = asked.lead(&findings.claims);
        let (answer, numbers) = asked.answer(&findings.claims);
        QuestionAnswer {
            lead,
            first: lead.map_or("No data", |seen| asked.first(seen)).into(),
            answer,
            numbers,
            question: asked.question,
            figures: asked.figures,
            tested: asked.tested,
        }
    };
    Ok(asked()?.into_iter().map(answered).collect())
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
            own.answer += &format!(" {}.", tests.on_fragility());
            own.numbers += &format!("; {}", tests.below_uplift());
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
            "How sure are integrator and model?",
            format!("{} The model: {}.", sure(proof, lead), tests.right()),
            format!("{}; {}", timings.error(), tests.right_each()),
            &[("evidence", "proof"), SHAKING],
        ),
        row("Is it fast?", fast, rate, &[("speed", "speed")]),
        row(
            "What was not checked?",
            format!(
                "What the model leaves out: {LEFT_OUT}; other objects than \
                 two rocks."
            ),
            not_run(basis),
            &[("limits", "limits")],
        ),
        row(
            "May I sign?",
            signed(proof, basis.has_recorded(), &tests),
            format!(
                "{}; {} are compared{}",
                backed(proof),
                tests.counted(),
                if basis.has_recorded() { REPEATED } else { "" }
            ),
            &[("provenance", "sign-off")],
        ),
    ];
    Ok(claimed.chain(others).collect())
}

/// What of the kept results is open to everyone.
const REPEATED: &str =
    "; anyone can repeat the results on FEMA P-695's motions";

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
        (true, true) => {
            "recorded motions anew (their results are kept; python -m \
             rocking.recorded gets those of FEMA P-695), "
        }
        (true, false) => "recorded motions, ",
        (false, _) => "",
    };
    format!("Not run: {records}other machines than x86-64 Linux")
}

fn sure(proof: Option<&Proof>, lead: &Findings) -> String {
    let shifts = lead.suites.iter().map(|s| s.largest_shift_if_flipped);
    match proof.map(|proof| (proof.failed(), proof.results().len())) {
        None => "Open: the cases with known answers were not run here.".into(),
        Some((0, all)) => format!(
            "The integrator, very: all {all} cases with known answers pass, \
             and rounding moves percentiles of overturning by {} at most.",
            rounded_text(shifts.fold(0.0, f64::max))
        ),
        Some((failed, all)) => format!(
            "Not sure: {failed} of {all} cases with known answers fail."
        ),
    }
}

fn signed(proof: Option<&Proof>, kept: bool, tests: &RockTests) -> String {
    let kept = match kept {
        true => "; recorded results are kept, not run here",
        false => "",
    };
    match proof.map(Proof::failed) {
        None => "Not yet: the cases with known answers were not run.".into(),
        Some(0) => format!(
            "For the computation, yes{kept}. For a real object only with the \
             error of the model, which rests on {}, with one fitted angle \
             each.",
            tests.counted()
        ),
        Some(_) => "Not before every case with a known answer passes.".into(),
    }
}

fn backed(proof: Option<&Proof>) -> String {
    proof.map_or("No declared case was run".into(), |proof| {
        let (failed, all) = (proof.failed(), proof.results().len());
        format!("{} of {all} declared cases pass", all - failed)
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

/// What was done, in a few sentences.
pub(super) fn done(basis: &FindingSets<'_>) -> String {
    let lead = basis.lead();
    let source = match (basis.embedded, basis.has_recorded()) {
        (true, true) => "recorded ",
        (true, false) => "synthetic ",
        (false, _) => "",
    };
    format!(
        "Fifteen blocks rocked under {source}motions, {}, to check a paper by \
         Lachanas, Vamvatsikos and Dimitrakopoulos [1]; and two tested rocks \
         were computed, to check the model. {}",
        suites_of(lead).join(" and "),
        SentenceCounts::of(lead).words()
    )
}

/// How the answers of the embedded motions differ from those of each kind of
/// recorded ones, and on which claims, or that recorded results were left out;
/// to be less certain is not to answer differently.
///
/// # Errors
/// As [`answers`].
pub(super) fn differing(
    basis: &FindingSets<'_>,
) -> anyhow::Result<Option<String>> {
    if !basis.has_recorded() {
        return basis.left_out();
    }
    let own = answers(basis.here)?;
    let mut words = Vec::new();
    for (name, recorded) in basis.recorded() {
        let counted = |claim: &Claim| claim.theme != Theme::Beyond;
        let (mut turned, all) = turned(basis.here, recorded, counted);
        let count = turned.len();
        turned.dedup();
        let mut other = String::new();
        for (own, kept) in own.iter().zip(answers(recorded)?) {
            if own.lead != kept.lead {
                let QuestionAnswer { question, first, .. } = own;
                other += &format!(" {question} {first} ({}).", kept.first);
            }
        }
        words.push(match other.as_str() {
            "" => {
                format!("Embedded motions give the answers of “{name}”.")
            }
            _ => format!(
                "Embedded motions answer differently from “{name}” (in \
                 brackets):{other}"
            ),
        });
        words.push(match turned.join("; ").as_str() {
            "" => format!("None of {all} results differs."),
            names => format!("Of {all} results {count} differ: {names}."),
        });
    }
    Ok(Some(words.join(" ")))
}

#[cfg(test)]
pub(crate) mod tests;
