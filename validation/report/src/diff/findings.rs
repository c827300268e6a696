//! Findings of a study as items: claims by name, tables row by row.

use std::collections::BTreeSet;

use super::flaw::flaw;
use super::item::{Content, Item, Limit};
use rocking_common::findings::{
    Claim, Findings, Measured, Place, Question, Suite, Table, Tested, Topic,
};

/// The items of a study's findings.
pub fn items(findings: &Findings) -> anyhow::Result<Vec<Item>> {
    let mut out = Vec::new();
    findings.claims.iter().for_each(|c| claim(&mut out, c));
    settings(&mut out, findings);
    findings.suites.iter().for_each(|s| suite(&mut out, s));
    findings.tables.iter().for_each(|t| table(&mut out, t));
    findings.questions.iter().for_each(|q| question(&mut out, q));
    let mut seen = BTreeSet::new();
    for item in &out {
        if !seen.insert((&item.owner, &item.name)) {
            let found = format!("\"{}\" twice", item.name);
            return Err(flaw(&item.owner, &found, "it once"));
        }
    }
    Ok(out)
}

/// Items of one owner.
struct Owner<'a> {
    out: &'a mut Vec<Item>,
    owner: String,
    group: String,
}

impl Owner<'_> {
    fn item(&mut self, name: &str, words: String, content: Content) {
        let (owner, group) = (self.owner.clone(), self.group.clone());
        self.out.push(Item {
            owner,
            name: name.into(),
            group,
            words,
            content,
        });
    }

    fn text(&mut self, name: &str, text: &str) {
        let words = format!("{}: {name}", self.owner);
        self.item(name, words, Content::Text(text.into()));
    }

    fn setting(&mut self, name: &str, text: String) {
        self.item(name, name.into(), Content::Setting(text));
    }

    /// A value, and its interval if it has one.
    fn measured(&mut self, name: &str, words: String, measured: Measured) {
        let Measured { value, interval } = measured;
        let limit = match interval {
            Some((low, high)) => Limit::Interval(low, high),
            None => Limit::None,
        };
        if let Some((low, high)) = interval {
            let ends = Content::Text(format!("{low} .. {high}"));
            let words = format!("{words}, 95 % interval");
            self.item(&format!("{name} interval"), words, ends);
        }
        self.item(name, words, Content::Number { value, limit });
    }
}

fn claim(out: &mut Vec<Item>, claim: &Claim) {
    let id = &claim.id;
    let owner = format!("claim {id}");
    let group = String::from("claims");
    let mut own = Owner { out, owner, group };
    let region = claim.region.map_or(String::new(), |r| r.to_string());
    let quantifier = claim.quantifier.map_or("", |q| q.words());
    own.item(
        "region",
        format!("claim {id}: region"),
        Content::Setting(format!("{quantifier}: {region}")),
    );
    for (name, text) in [
        ("measure", &claim.measure),
        ("blocks", &claim.blocks),
        ("quote", &claim.quote),
        ("plain words", &claim.plain),
        ("reason", &claim.reason),
        ("criterion", &claim.criterion),
        ("case", &claim.case),
        ("note", &claim.note),
    ] {
        own.text(name, text);
    }
    own.text("section", &claim.section.to_string());
    for result in &claim.results {
        let owner = format!("claim {id}, {}", result.place());
        let group = match result.suite {
            Tested::None => "claims without records".to_owned(),
            Tested::Both => "both suites: claims".to_owned(),
            suite => format!("{} suite: claims", suite.name()),
        };
        let mut own = Owner { out: &mut *out, owner, group };
        let place = result.place();
        for (name, words, verdict) in [
            ("verdict", "", result.by_equivalence),
            (
                "verdict by the paper's criterion",
                ", by the paper's criterion",
                result.by_criterion,
            ),
        ] {
            if let Some(verdict) = verdict {
                own.item(
                    name,
                    format!("{id}, {place}{words}, \"{}\"", claim.quote),
                    Content::Verdict(verdict.name().into()),
                );
            }
        }
        let words = format!("{id}: {}, {place}", claim.measure);
        own.measured("value", words, result.measured());
        own.text("at", &result.at);
        let cell = result.deciding_cell.iter();
        let named = cell.map(|cell| ("deciding cell", cell));
        let others = result.details.iter().map(|d| (d.name.as_str(), d));
        for (name, detail) in named.chain(others) {
            let words = format!("{id}: {}, {place}", detail.name);
            own.measured(name, words, detail.measured);
        }
    }
}

fn settings(out: &mut Vec<Item>, findings: &Findings) {
    let owner = String::from("settings");
    let group = owner.clone();
    let mut own = Owner { out, owner, group };
    own.text("version", &findings.version);
    let settings = &findings.settings;
    let arms: Vec<&str> = settings.arms.iter().map(|a| a.letter()).collect();
    own.setting("arms", arms.join(", "));
    own.setting("eta", settings.eta.to_string());
    own.setting("overturning", settings.overturning.to_string());
    own.setting("refinement im", settings.refinement_im.to_string());
}

fn suite(out: &mut Vec<Item>, suite: &Suite) {
    let owner = format!("{} suite: suite and work", suite.kind);
    let group = owner.clone();
    let mut own = Owner { out, owner, group };
    own.setting("source", suite.source.clone());
    own.setting("component rule", suite.component_rule.clone());
    own.setting("sha256", suite.sha256.clone());
    let none = String::from("none");
    own.setting("remarks", suite.remarks.clone().unwrap_or(none));
    let aside = suite.set_aside.iter();
    let aside = aside.map(|a| format!("{} {}", a.files, a.code));
    let aside = aside.collect::<Vec<_>>().join(", ");
    let nothing = aside.is_empty().then(|| String::from("none"));
    own.setting("set aside", nothing.unwrap_or(aside));
    own.text("shown alone", &suite.shown_alone.join(", "));
    let again = &suite.first_overturnings_reevaluated;
    let ends = "first overturnings reevaluated";
    for (name, value) in [
        ("records".to_owned(), suite.records as f64),
        ("analyses".to_owned(), suite.analyses as f64),
        ("unresolved by double precision".to_owned(), suite.unresolved as f64),
        (format!("{ends} all"), again.all as f64),
        (
            format!("{ends} resolved by double"),
            again.resolved_by_double as f64,
        ),
        (
            format!("{ends} resolved by double double"),
            again.resolved_by_double_double as f64,
        ),
        (
            format!("{ends} resolved by octuple"),
            again.resolved_by_octuple as f64,
        ),
        (format!("{ends} unresolved"), again.unresolved as f64),
        (format!("{ends} wrong in double"), again.wrong_in_double as f64),
        (
            "largest shift of an overturning quantile if all open fates \
             flipped"
                .to_owned(),
            suite.largest_shift_if_flipped,
        ),
    ] {
        own.measured(&name, name.clone(), Measured::exact(value));
    }
}

fn table(out: &mut Vec<Item>, table: &Table) {
    for row in &table.rows {
        let Place { suite, intensity, .. } = row.at;
        let topic = table.topic.words();
        let group = suite.map_or(topic.to_owned(), |suite| {
            format!("{suite} suite: {topic}")
        });
        let intensity = intensity.map_or("", |intensity| intensity.words());
        let place = row.at.to_string();
        let parts = [group.as_str(), intensity, place.as_str()];
        let parts: Vec<&str> =
            parts.into_iter().filter(|part| !part.is_empty()).collect();
        let owner = parts.join(", ");
        let mut own = Owner { out, owner, group };
        for (quantity, value) in table.quantities.iter().zip(&row.values) {
            let mut words = quantity.words.clone();
            if !intensity.is_empty() {
                let of = match table.topic {
                    Topic::Overturning => " ",
                    _ => ", by ",
                };
                words += &format!("{of}{intensity}");
            }
            if !place.is_empty() {
                words += &format!(" at {place}");
            }
            own.measured(&quantity.name, words, *value);
        }
    }
}

fn question(out: &mut Vec<Item>, question: &Question) {
    let owner = format!("questions beyond the paper, {}", question.id);
    let group = "questions beyond the paper".into();
    let mut own = Owner { out, owner, group };
    own.text("question", &question.question);
    own.text("answer", &question.answer);
    own.text("data", &question.data);
}
