//! Findings of a study as items: claims by name, everything else row by row.

use std::collections::BTreeSet;

use serde_json::{Map, Value};

use super::flaw::{Flaw, amount, kind};
use super::words::{identities, identity, intensity, quantity, section};
use super::{Content, Item, Limit};
use crate::paper::Verdict;

/// Numbers that a field `interval` beside them belongs to; `x_interval`
/// belongs to `x`.
const MEASURED: [&str; 3] = ["value", "median_ratio", "median"];

/// Texts of the section of suites that make it another suite.
const SUITE: [&str; 4] = ["sha256", "source", "component_rule", "remarks"];

type Object = Map<String, Value>;

/// The items of `findings.json`.
pub fn items(map: &Object) -> Result<Vec<Item>, Flaw> {
    let mut out = Vec::new();
    for (name, value) in map {
        if name == "claims" {
            claims(&mut out, value)?;
        } else {
            Row::top(name).value(&mut out, "", value)?;
        }
    }
    let mut seen = BTreeSet::new();
    for item in &out {
        if !seen.insert((&item.owner, &item.name)) {
            return Err(Flaw::new(
                item.owner.clone(),
                format!("\"{}\" twice", item.name),
                "it once",
            ));
        }
    }
    Ok(out)
}

fn claims(out: &mut Vec<Item>, value: &Value) -> Result<(), Flaw> {
    let Value::Array(claims) = value else {
        return Err(Flaw::new("claims", kind(value), "a list"));
    };
    for (k, claim) in claims.iter().enumerate() {
        let place = format!("claim {}", k + 1);
        let Value::Object(claim) = claim else {
            return Err(Flaw::new(place, kind(claim), "an object"));
        };
        one_claim(out, &place, claim)?;
    }
    Ok(())
}

fn one_claim(
    out: &mut Vec<Item>,
    place: &str,
    claim: &Object,
) -> Result<(), Flaw> {
    let text = |field: &str| {
        let found = claim.get(field);
        found.and_then(Value::as_str).ok_or_else(|| {
            let found = found.map_or("nothing", kind);
            Flaw::new(format!("{place}, {field}"), found, "a text")
        })
    };
    let (id, suite) = (text("id")?, text("suite")?);
    let group = match suite {
        "none" => "claims without records".into(),
        "both" => "both suites: claims".into(),
        suite => format!("{suite} suite: claims"),
    };
    let quoted = format!("{id}, \"{}\"", text("quote")?);
    let owner = format!("claim {id}");
    let words = |field: &str| format!("{owner}: {field}");
    let mut item = |name: &str, words: String, content| {
        let (owner, group) = (owner.clone(), group.clone());
        out.push(Item { owner, name: name.into(), group, words, content });
    };
    let verdict = text("verdict")?;
    if !Verdict::ALL.iter().any(|v| v.name() == verdict) {
        return Err(Flaw::new(
            format!("{place}, verdict"),
            format!("\"{verdict}\""),
            Verdict::ALL.map(Verdict::name).join(", "),
        ));
    }
    item("verdict", quoted, Content::Verdict(verdict.into()));
    let margin = Content::Setting(text("margin")?.into());
    item("margin", words("margin"), margin);
    let field = |field: &str| {
        claim.get(field).ok_or_else(|| {
            Flaw::new(format!("{place}, {field}"), "nothing", "a value")
        })
    };
    let value = amount(&format!("{place}, value"), field("value")?)?;
    let interval = ends(&format!("{place}, interval"), field("interval")?)?;
    item("interval", words("95 % interval"), between(interval));
    let arm = claim.get("arm").and_then(Value::as_str);
    let arm = arm.map_or(String::new(), |arm| format!(", arm {arm}"));
    item(
        "value",
        format!("{id}: {}, {}{arm}", text("measure")?, text("blocks")?),
        Content::Number { value, limit: limit(interval) },
    );
    let known = ["id", "verdict", "margin", "value", "interval"];
    for (name, value) in claim {
        if !known.contains(&name.as_str()) {
            let text = in_words(value);
            item(name, words(name), Content::Text(text));
        }
    }
    Ok(())
}

/// A row of a section, or the section itself.
struct Row {
    section: String,
    /// Fields that name the row.
    named_by: &'static [&'static str],
    owner: String,
    group: String,
    /// The intensity measure that the row is about.
    measure: String,
    /// `p = 3, alpha = 0.20`.
    place: String,
}

impl Row {
    fn top(name: &str) -> Self {
        Self {
            section: name.into(),
            named_by: &[],
            owner: section(name),
            group: section(name),
            measure: String::new(),
            place: String::new(),
        }
    }

    fn row(&self, k: usize, row: &Object) -> Self {
        let named_by = identities(&self.section);
        let text = |field: &str| row.get(field).and_then(Value::as_str);
        let mut places: Vec<String> = named_by
            .iter()
            .filter_map(|field| {
                let value = in_words(row.get(*field)?);
                identity(field, value.trim_end_matches(".0"))
            })
            .collect();
        let suite = text("suite").or(text("kind"));
        if places.is_empty() && suite.is_none() {
            places.push(format!("row {}", k + 1));
        }
        let mut group = section(&self.section);
        if let Some(suite) = suite {
            group = format!("{suite} suite: {group}");
        }
        let measure = text("im_kind").map_or("", intensity).to_owned();
        let place = places.join(", ");
        let parts = [group.clone(), measure.clone(), place.clone()];
        let parts: Vec<String> =
            parts.into_iter().filter(|part| !part.is_empty()).collect();
        Self {
            section: self.section.clone(),
            named_by,
            owner: parts.join(", "),
            group,
            measure,
            place,
        }
    }

    /// `median overturning PGA/(g tan alpha) at p = 3, alpha = 0.20`.
    fn words(&self, name: &str) -> String {
        let mut words = quantity(&self.section, name);
        if !self.measure.is_empty() {
            let overturning = self.section == "overturning";
            words += if overturning { " " } else { ", by " };
            words += &self.measure;
        }
        if !self.place.is_empty() {
            words += &format!(" at {}", self.place);
        }
        words
    }

    fn item(&self, name: &str, content: Content) -> Item {
        Item {
            owner: self.owner.clone(),
            name: name.into(),
            group: self.group.clone(),
            words: self.words(name),
            content,
        }
    }

    /// Everything below a value; `name` is the path to it within the row.
    fn value(
        &self,
        out: &mut Vec<Item>,
        name: &str,
        value: &Value,
    ) -> Result<(), Flaw> {
        match value {
            Value::Object(map) => self.object(out, name, map),
            Value::Array(rows)
                if !rows.is_empty() && rows.iter().all(Value::is_object) =>
            {
                let rows = rows.iter().filter_map(Value::as_object);
                for (k, row) in rows.enumerate() {
                    self.row(k, row).object(out, "", row)?;
                }
                Ok(())
            }
            leaf => {
                let content = self.leaf(name, leaf)?;
                out.push(self.item(name, content));
                Ok(())
            }
        }
    }

    fn object(
        &self,
        out: &mut Vec<Item>,
        name: &str,
        map: &Object,
    ) -> Result<(), Flaw> {
        for (field, value) in map {
            if name.is_empty() && self.named_by.contains(&field.as_str()) {
                continue;
            }
            let path = if name.is_empty() {
                field.clone()
            } else {
                format!("{name} {field}")
            };
            let place = || format!("{}, {path}", self.owner);
            if field == "interval" {
                let content = between(ends(&place(), value)?);
                out.push(self.item(&path, content));
            } else if let Some(of) = field.strip_suffix("_interval")
                && map.contains_key(of)
            {
                let content = between(ends(&place(), value)?);
                out.push(self.item(&path, content));
            } else if let Some(interval) =
                map.get(&format!("{field}_interval")).or_else(|| {
                    let own = MEASURED.contains(&field.as_str());
                    map.get("interval").filter(|_| own)
                })
            {
                let value = amount(&place(), value)?;
                let limit = limit(ends(&place(), interval)?);
                out.push(self.item(&path, Content::Number { value, limit }));
            } else {
                self.value(out, &path, value)?;
            }
        }
        Ok(())
    }

    fn leaf(&self, name: &str, value: &Value) -> Result<Content, Flaw> {
        let setting = (self.section == "options" && name != "version")
            || (self.section == "suites" && SUITE.contains(&name));
        if setting {
            return Ok(Content::Setting(in_words(value)));
        }
        Ok(match value {
            Value::String(text) if text != "inf" && text != "-inf" => {
                Content::Text(text.clone())
            }
            Value::Array(_) | Value::Bool(_) => Content::Text(in_words(value)),
            other => {
                let place = format!("{}, {name}", self.owner);
                let value = amount(&place, other)?;
                Content::Number { value, limit: Limit::None }
            }
        })
    }
}

/// A value as text; lists by commas.
fn in_words(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(values) => {
            values.iter().map(in_words).collect::<Vec<_>>().join(", ")
        }
        Value::Null => "none".into(),
        other => other.to_string(),
    }
}

/// Two ends, or none.
fn ends(place: &str, value: &Value) -> Result<Option<(f64, f64)>, Flaw> {
    let wrong = |found: String| {
        Flaw::new(place, found, "null or a list of two rising numbers")
    };
    match value {
        Value::Null => Ok(None),
        Value::Array(list) if list.len() == 2 => {
            let (low, high) =
                (amount(place, &list[0])?, amount(place, &list[1])?);
            if low <= high {
                Ok(Some((low, high)))
            } else {
                Err(wrong(value.to_string()))
            }
        }
        other => Err(wrong(other.to_string())),
    }
}

fn limit(interval: Option<(f64, f64)>) -> Limit {
    interval.map_or(Limit::None, |(low, high)| Limit::Interval(low, high))
}

fn between(interval: Option<(f64, f64)>) -> Content {
    Content::Text(
        interval.map_or("none".into(), |(a, b)| format!("{a} .. {b}")),
    )
}
