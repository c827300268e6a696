//! Findings of a study as items: the answers, claims by name, tables cell by
//! cell in the order of consequence.

use std::collections::BTreeSet;

use anyhow::bail;

use super::item::{Content, Item};
use super::moved::{Limit, Number};
use crate::answers::{Answered, answers};
use rocking_common::findings::{
    Claim, ClaimResult, Effect, Findings, Measured, Quantifier, Row, Suite,
    Table, Unit,
};

/// The items of a study's findings.
pub fn items(findings: &Findings) -> anyhow::Result<Vec<Item>> {
    let mut out = Vec::new();
    for own in answers(findings)? {
        let Answered { question, answer, verdicts, .. } = own;
        let mut own = Owner::new(&mut out, "answers", question.clone());
        own.item("", &question, Content::Answer(verdicts, answer));
    }
    let mut tables: Vec<&Table> = findings.tables.iter().collect();
    tables.sort_by_key(|table| table.topic);
    tables.iter().for_each(|table| cells(&mut out, table));
    for by_paper in [false, true] {
        let claims = findings.claims.iter();
        claims.for_each(|claim| verdicts(&mut out, claim, by_paper));
    }
    findings.claims.iter().for_each(|c| claim(&mut out, c));
    settings(&mut out, findings);
    findings.suites.iter().for_each(|s| suite(&mut out, s));
    for question in &findings.questions {
        let owner = format!("question {}", question.id);
        let mut own = Owner::new(&mut out, "questions", owner);
        own.text("question", &question.question);
        own.text("answer", &question.answer);
        own.text("data", &question.data);
    }
    let mut seen = BTreeSet::new();
    for item in &out {
        if !seen.insert(item.key()) {
            let Item { owner, name, .. } = item;
            bail!("{owner}: found \"{name}\" twice, expected it once");
        }
    }
    Ok(out)
}

/// Items of one owner.
struct Owner<'a> {
    out: &'a mut Vec<Item>,
    topic: &'static str,
    owner: String,
    place: String,
}

impl<'a> Owner<'a> {
    fn new(
        out: &'a mut Vec<Item>,
        topic: &'static str,
        owner: String,
    ) -> Self {
        Self { out, topic, owner, place: String::new() }
    }

    /// An item whose name holds its place too.
    fn item(&mut self, name: &str, words: &str, content: Content) {
        let Self { topic, owner, place, .. } = self;
        self.out.push(Item {
            topic,
            owner: owner.clone(),
            name: format!("{name}, {place}"),
            words: words.into(),
            place: place.clone(),
            content,
        });
    }

    fn text(&mut self, name: &str, text: &str) {
        let words = format!("{}: {name}", self.owner);
        self.item(name, &words, Content::Text(text.into()));
    }

    fn setting(&mut self, name: &str, text: String) {
        let words = match self.owner.as_str() {
            "settings" => name.into(),
            owner => format!("{owner}, {name}"),
        };
        self.item(name, &words, Content::Setting(text));
    }

    /// An interval: shown, and judged by nothing.
    fn interval(&mut self, name: &str, measured: Measured) {
        if let Some((low, high)) = measured.interval {
            self.text(
                &format!("{name}, interval"),
                &format!("{low} .. {high}"),
            );
        }
    }
}

/// A claim by its plain words and its name.
fn named(claim: &Claim) -> String {
    let Claim { id, plain, measure, .. } = claim;
    let words = if plain.is_empty() { measure } else { plain };
    format!("\"{words}\" ({id})")
}

/// The verdicts on a claim: by the limits here, or by the paper's criterion.
fn verdicts(out: &mut Vec<Item>, claim: &Claim, by_paper: bool) {
    let mut own = Owner::new(out, "claims", format!("claim {}", claim.id));
    let by = if by_paper { ", by the paper's criterion" } else { "" };
    let words = named(claim) + by;
    for result in &claim.results {
        let here = result.by_equivalence;
        let found = if by_paper { result.by_criterion } else { here };
        let Some(verdict) = found else { continue };
        own.place = result.place();
        let content = Content::Verdict(verdict.name().into());
        own.item(&format!("verdict{by}"), &words, content);
    }
}

fn claim(out: &mut Vec<Item>, claim: &Claim) {
    let id = &claim.id;
    let mut own = Owner::new(out, "claims", format!("claim {id}"));
    let region = claim.region.map_or(String::new(), |r| r.to_string());
    let rule = claim.quantifier.map_or("", Quantifier::words);
    own.setting("region", format!("{rule}: {region}"));
    let section = claim.section.to_string();
    for (name, text) in [
        ("measure", &claim.measure),
        ("blocks", &claim.blocks),
        ("quote", &claim.quote),
        ("plain words", &claim.plain),
        ("reason", &claim.reason),
        ("criterion", &claim.criterion),
        ("case", &claim.case),
        ("note", &claim.note),
        ("section", &section),
    ] {
        own.text(name, text);
    }
    let words = format!("value of {}", named(claim));
    for result in &claim.results {
        own.place = result.place();
        let effect = Effect::of_claim(claim.region, result.unit);
        let number = Number {
            decided_at: decided_at(claim, result),
            ..Number::new(result.value, Limit::of(effect, result.unit))
        };
        own.item("value", &words, Content::Number(number));
        own.text("at", &result.at);
        own.interval("value", result.measured());
        for detail in result.deciding_cell.iter().chain(&result.details) {
            own.interval(&detail.name, detail.measured);
            own.text(&detail.name, &detail.measured.value.to_string());
        }
    }
}

/// The cell whose value a result has, where a claim is about every cell.
fn decided_at(claim: &Claim, result: &ClaimResult) -> String {
    let one_of_many = claim.quantifier == Some(Quantifier::All);
    if one_of_many { result.at.clone() } else { String::new() }
}

fn settings(out: &mut Vec<Item>, findings: &Findings) {
    let mut own = Owner::new(out, "settings", "settings".into());
    own.text("version", &findings.version);
    for (name, value) in findings.settings.named() {
        own.setting(name, value);
    }
}

fn suite(out: &mut Vec<Item>, suite: &Suite) {
    let owner = format!("{} suite", suite.kind);
    let mut own = Owner::new(out, "suites", owner);
    let sha256: String = suite.sha256.chars().take(8).collect();
    let records = format!("{}, sha256 {sha256}", suite.records);
    own.setting("records", records);
    own.setting("source", suite.source.clone());
    own.setting("component rule", suite.component_rule.clone());
    own.setting("remarks", suite.remarks.clone().unwrap_or_default());
    let aside = suite.set_aside.iter();
    let aside = aside.map(|a| format!("{} {}", a.files, a.code));
    own.setting("set aside", aside.collect::<Vec<_>>().join(", "));
    own.text("shown alone", &suite.shown_alone.join(", "));
    let work = (
        suite.analyses,
        suite.unresolved,
        suite.first_overturnings_reevaluated,
    );
    own.text("work", &format!("{work:?}"));
    let limit = Limit::of(Effect::of(Unit::Share), Unit::Share);
    let shift = Number::new(suite.largest_shift_if_flipped, limit);
    let words = "shift of overturning quantiles if all open fates flipped";
    let words = format!("{}: {words}", own.owner);
    own.item("shift", &words, Content::Number(shift));
}

/// The cells of a table, those of a quantity, suite and intensity measure
/// together.
fn cells(out: &mut Vec<Item>, table: &Table) {
    let topic = table.topic.words();
    let mut own = Owner::new(out, topic, topic.into());
    for (k, quantity) in table.quantities.iter().enumerate() {
        let effect = table.topic.smallest_effect(quantity.unit);
        let limit = Limit::of(effect, quantity.unit);
        for Row { at, values } in &table.rows {
            let suite = at.suite.map(|suite| suite.to_string());
            let intensity = at.intensity.map(|im| im.words().to_owned());
            let part = [intensity, suite].into_iter().flatten();
            let part: String = part.map(|one| format!(", {one}")).collect();
            let number = Number {
                p_rad_s: at.p_rad_s,
                ..Number::new(values[k].value, limit)
            };
            own.place = at.to_string();
            let name = format!("{}{part}", quantity.name);
            let words = format!("{}{part}", quantity.words);
            own.item(&name, &words, Content::Number(number));
            own.interval(&name, values[k]);
        }
    }
}
