//! The first screen: what was done, and the answers, each a sentence made
//! from verdicts and numbers by one rule.

use anyhow::Context as _;
use serde::Deserialize;

use crate::basis::FindingSets;
use crate::evidence::Proof;
use crate::quantity::{cell_text, measured_text, number};
use crate::timings::Timings;
use crate::verdicts::{FALSE_DISCOVERIES, first_arm, rank, score, turned};
use rocking_common::findings::{
    Claim, ClaimResult, Findings, Region, SuiteSet,
};
use rocking_common::paper::{Arm, ClaimVerdict};
use rocking_draw::figures::Figure;

/// The questions that claims answer; the file says what its fields are.
const ASKED: &str = include_str!("../answers.toml");

/// A question of a reader that claims answer.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct ReaderQuestion {
    question: String,
    leads: [String; 5],
    parts: Vec<QuestionPart>,
    aside: Option<QuestionPart>,
    figures: Vec<u32>,
}

/// Claims that one fact answers.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QuestionPart {
    claims: Vec<String>,
    /// What is measured, in a few words.
    name: String,
    fact: String,
    shown: FactNumber,
    #[serde(default)]
    against: bool,
}

/// Which number of a result a fact has.
#[derive(Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum FactNumber {
    /// The distance of a ratio from 1, in per cent.
    Apart,
    /// The value, in per cent.
    Percent,
    /// The value.
    Plain,
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

/// What came out about a part.
struct PartResult {
    /// The verdicts, each once and for the part, the worst one first.
    verdicts: Vec<ClaimVerdict>,
    /// None without data.
    words: Option<PartWords>,
}

/// A part in words.
struct PartWords {
    fact: String,
    /// Its number with interval and suite.
    number: String,
    /// The blocks that it is about.
    blocks: String,
}

impl QuestionPart {
    /// The verdict on the part by one on its claim; a value without an
    /// interval decides nothing.
    fn verdict(&self, result: &ClaimResult) -> ClaimVerdict {
        match result.by_equivalence.unwrap_or(ClaimVerdict::Inconclusive) {
            ClaimVerdict::Confirmed if self.against => {
                ClaimVerdict::NotConfirmed
            }
            ClaimVerdict::NotConfirmed if self.against => {
                ClaimVerdict::Confirmed
            }
            own => own,
        }
    }

    /// What came out, in the arm that stands among the findings. The result
    /// with the worst verdict speaks; of several, the one with the worst
    /// number.
    fn found(&self, claims: &[Claim], first: Arm) -> PartResult {
        let own = claims
            .iter()
            .filter(|c| self.claims.contains(&c.id) && c.region.is_some());
        let shown = |r: &&ClaimResult| {
            r.arm.is_none_or(|arm| arm == first) && !self.value(r).is_nan()
        };
        let mut all: Vec<(&Claim, &ClaimResult)> = own
            .flat_map(|c| c.results.iter().filter(shown).map(move |r| (c, r)))
            .collect();
        let bad = |claim: &Claim, r: &ClaimResult| {
            let bad = claim.region.map_or(0.0, |g| g.badness(self.value(r)));
            if self.against { -bad } else { bad }
        };
        all.sort_by(|(c, r), (d, s)| {
            rank(self.verdict(s))
                .cmp(&rank(self.verdict(r)))
                .then(bad(d, s).total_cmp(&bad(c, r)))
        });
        let mut verdicts: Vec<ClaimVerdict> =
            all.iter().map(|(_, r)| self.verdict(r)).collect();
        verdicts.dedup();
        let several = verdicts.len() > 1;
        let words = all.first().map(|(c, r)| self.words(c, r, several));
        PartResult { verdicts, words }
    }

    /// The number that is shown: a ratio's is that of the deciding cell.
    fn value(&self, result: &ClaimResult) -> f64 {
        match &result.deciding_cell {
            Some(cell) if self.shown == FactNumber::Apart => {
                cell.estimate.value()
            }
            _ => result.estimate.value(),
        }
    }

    /// The fact, with the suite where suites disagree, its number, and the
    /// blocks.
    fn words(
        &self,
        claim: &Claim,
        result: &ClaimResult,
        disagree: bool,
    ) -> PartWords {
        let value = self.value(result);
        let shown = match self.shown {
            FactNumber::Apart => number(100.0 * (value - 1.0).abs()) + " %",
            FactNumber::Percent => number(100.0 * value) + " %",
            FactNumber::Plain => number(value),
        };
        let limit = match claim.region {
            Some(Region::Within(_, b)) => number(100.0 * (b - 1.0)) + " %",
            _ => String::new(),
        };
        let suite = match result.suite {
            SuiteSet::None | SuiteSet::Both => "",
            own => own.name(),
        };
        let mut fact =
            self.fact.replace("{}", &shown).replace("{limit}", &limit);
        if disagree && !suite.is_empty() {
            fact += &format!(" ({suite})");
        }
        let text = match &result.deciding_cell {
            Some(cell) if self.shown == FactNumber::Apart => {
                cell_text(claim, &cell.estimate)
            }
            _ => measured_text(claim, result),
        };
        let place = if suite.is_empty() { "" } else { &format!(", {suite}") };
        let number = format!("{} {text}{place}", self.name);
        PartWords { fact, number, blocks: claim.blocks.clone() }
    }
}

impl ReaderQuestion {
    /// The parts, and then what is said besides.
    fn all(&self) -> impl Iterator<Item = &QuestionPart> {
        self.parts.iter().chain(&self.aside)
    }

    /// Which of the first words the verdicts give; none without data.
    fn lead(&self, claims: &[Claim], first: Arm) -> Option<usize> {
        let found = self.parts.iter().map(|p| p.found(claims, first));
        let all: Vec<ClaimVerdict> = found.flat_map(|f| f.verdicts).collect();
        let (yes, no) = (ClaimVerdict::Confirmed, ClaimVerdict::NotConfirmed);
        Some(match (all.contains(&yes), all.contains(&no)) {
            _ if all.is_empty() => return None,
            (true, true) => 2,
            (true, false) if all.contains(&ClaimVerdict::Inconclusive) => 1,
            (true, false) => 0,
            (false, true) => 3,
            (false, false) => 4,
        })
    }

    /// The answer: first words, then the facts that hold, those that fail,
    /// those that are open, and what there are no data on.
    fn answer(&self, claims: &[Claim], first: Arm) -> String {
        let Some(lead) = self.lead(claims, first) else {
            return "There are no data.".into();
        };
        let found: Vec<(&QuestionPart, PartResult)> =
            self.parts.iter().map(|p| (p, p.found(claims, first))).collect();
        let facts = |verdict: Option<ClaimVerdict>| -> String {
            let own = found
                .iter()
                .filter(|(_, f)| f.verdicts.first() == verdict.as_ref());
            let words = own.map(|(part, f)| match &f.words {
                Some(words) => words.fact.as_str(),
                None => part.name.as_str(),
            });
            words.collect::<Vec<&str>>().join(", ")
        };
        let mut out = format!("{}: ", self.leads[lead]);
        let start = out.len();
        for (verdict, joint) in [
            (Some(ClaimVerdict::Confirmed), ""),
            (Some(ClaimVerdict::NotConfirmed), ", but "),
            (Some(ClaimVerdict::Inconclusive), "; not certain: "),
            (None, "; no data on "),
        ] {
            let facts = facts(verdict);
            if !facts.is_empty() {
                out += if out.len() > start { joint } else { "" };
                out += &facts;
            }
        }
        out += ".";
        let aside = self.aside.as_ref().map(|p| p.found(claims, first));
        if let Some(PartResult { verdicts, words: Some(words) }) = aside
            && verdicts[0] != ClaimVerdict::Inconclusive
        {
            out += &format!(" {}.", words.fact);
        }
        out
    }

    /// The numbers of its facts, each with interval, suite and blocks; blocks
    /// that all of them share are named once.
    fn numbers(&self, claims: &[Claim], first: Arm) -> String {
        let found = self.all().filter_map(|p| p.found(claims, first).words);
        let mut out = String::new();
        let mut found = found.peekable();
        while let Some(PartWords { number, blocks, .. }) = found.next() {
            out += &number;
            match found.peek() {
                Some(next) if next.blocks == blocks => out += "; ",
                next => {
                    out += &format!("; blocks: {blocks}");
                    out += if next.is_some() { "; " } else { "" };
                }
            }
        }
        out
    }
}

/// A row of the first table.
pub struct AnswerRow {
    /// What is asked.
    pub question: String,
    /// The answer: a sentence of 25 words at most.
    pub answer: String,
    /// Its numbers, each with interval, unit and suite.
    pub effect: String,
    /// Anchor and words of where it is shown.
    pub shown: Vec<(String, String)>,
}

/// A question with what the findings of one study answer.
pub(super) struct QuestionAnswer {
    pub question: String,
    /// Which of the first words; none without data.
    pub lead: Option<usize>,
    /// Those words.
    pub first: String,
    /// The sentence.
    pub answer: String,
    numbers: String,
    figures: Vec<u32>,
}

/// The questions that claims answer, with their answers.
///
/// # Errors
/// Where the questions have been damaged.
pub(super) fn answers(
    findings: &Findings,
) -> anyhow::Result<Vec<QuestionAnswer>> {
    let (claims, first) = (&findings.claims, first_arm(findings));
    let answered = |asked: ReaderQuestion| {
        let lead = asked.lead(claims, first);
        QuestionAnswer {
            lead,
            first: lead.map_or("No data", |k| &asked.leads[k]).into(),
            answer: asked.answer(claims, first),
            numbers: asked.numbers(claims, first),
            question: asked.question,
            figures: asked.figures,
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
    let lead = basis.lead();
    let claimed = answers(lead)?.into_iter().map(|own| {
        let shown = own.figures.iter().filter_map(|number| {
            let is = |f: &&&Figure| f.heading.number == Some(*number);
            let name = figures.iter().find(is)?.heading.name.clone();
            Some((name, format!("Figure {number}")))
        });
        AnswerRow {
            shown: shown.collect(),
            question: own.question,
            answer: own.answer,
            effect: own.numbers,
        }
    });
    let row = |question: &str, answer, effect, (id, words): (&str, &str)| {
        AnswerRow {
            question: question.into(),
            answer,
            effect,
            shown: vec![(id.into(), words.into())],
        }
    };
    let (fast, rate) = timings.speed();
    let others = [
        row(
            "How sure is the integrator?",
            sure(proof),
            format!("{}; {}", timings.error(), basis.open()),
            ("evidence", "proof"),
        ),
        row("Is it fast?", fast, rate, ("speed", "speed")),
        row(
            "What was not checked?",
            format!(
                "The model against shaking-table tests. It leaves out \
                 {LEFT_OUT}."
            ),
            not_run(basis),
            ("limits", "limits"),
        ),
        row(
            "May I sign?",
            signed(proof, basis.recorded().is_some()),
            chance(lead),
            ("provenance", "sign-off"),
        ),
    ];
    Ok(claimed.chain(others).collect())
}

/// What the model leaves out.
pub(super) const LEFT_OUT: &str =
    "sliding, bouncing, vertical motion and flexible supports";

/// What else was not run.
pub(super) fn not_run(basis: &FindingSets<'_>) -> String {
    let records = match (basis.embedded, basis.recorded()) {
        (true, Some(_)) => "recorded motions anew (their results are kept), ",
        (true, None) => "recorded motions, ",
        (false, _) => "",
    };
    format!("Not run: {records}other machines than x86-64 Linux")
}

fn sure(proof: Option<&Proof>) -> String {
    match proof.map(|proof| (proof.failed(), proof.results().len())) {
        None => "Open: the cases with known answers were not run here.".into(),
        Some((0, all)) => {
            format!("Very: all {all} cases with known answers pass.")
        }
        Some((failed, all)) => format!(
            "Not sure: {failed} of {all} cases with known answers fail."
        ),
    }
}

fn signed(proof: Option<&Proof>, kept: bool) -> String {
    let kept = match kept {
        true => "; recorded results are kept, not run here",
        false => "",
    };
    match proof.map(Proof::failed) {
        None => "Not yet: the cases with known answers were not run.".into(),
        Some(0) => format!(
            "For the computation, yes{kept}. For real objects, no: no test \
             backs the model."
        ),
        Some(_) => "Not before every case with a known answer passes.".into(),
    }
}

fn chance(findings: &Findings) -> String {
    let found = findings.withdrawn(FALSE_DISCOVERIES);
    format!(
        "{} of {} verdicts on all grids would not stand at 5 % false \
         discoveries, {} under any dependence",
        found.positive, found.decided, found.any
    )
}

/// What was done, in a few sentences.
pub(super) fn done(basis: &FindingSets<'_>) -> String {
    let lead = basis.lead();
    let source = match (basis.embedded, basis.recorded()) {
        (true, Some(_)) => " recorded",
        (true, None) => " synthetic",
        (false, _) => "",
    };
    let motions: Vec<String> = lead
        .suites
        .iter()
        .map(|suite| {
            let of = suite.earthquakes.map(|n| format!(" of {n} earthquakes"));
            format!(
                "{} {}{source} motions{}",
                suite.records,
                suite.kind,
                of.unwrap_or_default()
            )
        })
        .collect();
    let analyses = |findings: &Findings| -> u64 {
        findings.suites.iter().map(|s| s.analyses).sum()
    };
    let run = match basis.recorded() {
        Some(_) => format!(
            "{} analyses of an earlier run; this run made {} under synthetic \
             motions",
            analyses(lead),
            analyses(basis.here)
        ),
        None => format!("{} analyses", analyses(lead)),
    };
    let score = score(lead);
    let count = |v| score.iter().find(|(own, _)| *own == v).map_or(0, |s| s.1);
    let all: usize = score.iter().map(|s| s.1).sum();
    format!(
        "Fifteen blocks rocked under {} at rising intensity ({run}), to check \
         a paper by Lachanas, Vamvatsikos and Dimitrakopoulos. Of its {all} \
         sentences that one can test, {} hold, {} fail and {} stay open.",
        motions.join(" and "),
        count(ClaimVerdict::Confirmed),
        count(ClaimVerdict::NotConfirmed),
        count(ClaimVerdict::Inconclusive)
    )
}

/// How the answers of the embedded motions differ from those of the recorded
/// ones, or that recorded results were left out; to be less certain is not to
/// answer otherwise.
///
/// # Errors
/// As [`answers`].
pub(super) fn otherwise(
    basis: &FindingSets<'_>,
) -> anyhow::Result<Option<String>> {
    let Some(recorded) = basis.recorded() else { return basis.left_out() };
    let (turned, all) = turned(basis.here, recorded);
    let alike = |lead| if lead == Some(1) { Some(0) } else { lead };
    let mut other = String::new();
    for (own, kept) in answers(basis.here)?.iter().zip(answers(recorded)?) {
        if alike(own.lead) != alike(kept.lead) {
            other += &format!(" {} {}.", own.question, own.first);
        }
    }
    Ok(Some(match other.as_str() {
        "" => format!(
            "Embedded synthetic motions give the same answers, though {turned} \
             of {all} claims come out otherwise."
        ),
        _ => format!(
            "Embedded synthetic motions answer otherwise:{other} Of {all} \
             claims {turned} come out otherwise."
        ),
    }))
}

#[cfg(test)]
mod tests;
