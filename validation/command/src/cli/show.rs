//! How a result is printed: as JSON by `serde`, or for people, who read a
//! sentence first, then the same quantities by the names and units of one
//! vocabulary.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};
use serde_json::Number;

use crate::failure::Failure;
use crate::terminal::COMMIT;
use rocking_common::table::columns::SCHEMA;
use rocking_common::words::{capital, columns, rounded};

/// The fields that every JSON of a command begins with.
#[derive(Serialize)]
struct JsonEnvelope<'a, T> {
    schema: u32,
    version: &'static str,
    commit: &'static str,
    #[serde(flatten)]
    result: &'a T,
}

/// A result as JSON.
///
/// # Errors
/// [`Failure`] if the result cannot be serialized.
pub fn json<T: Serialize>(result: &T) -> Result<String, Failure> {
    let version = env!("CARGO_PKG_VERSION");
    let all = JsonEnvelope { schema: SCHEMA, version, commit: COMMIT, result };
    Ok(serde_json::to_string_pretty(&all)? + "\n")
}

/// A result for people: the first sentence whose quantities `{path}` are all
/// known, a list of named quantities, and a table for each list of structs.
///
/// # Errors
/// [`Failure`] if the result cannot be serialized.
pub fn text<T: Serialize>(
    sentences: &[&str],
    result: &T,
) -> Result<String, Failure> {
    let fields: Fields =
        serde_json::from_str(&serde_json::to_string(result)?)?;
    let mut tables = Vec::new();
    let list = cells("", "", &fields, &mut |path, name, all| {
        tables.push(table(path, name, all));
        Vec::new()
    });
    let row = |one: NamedCell| vec![one.name, one.cell + " " + one.unit];
    let list: Vec<Vec<String>> = list.into_iter().map(row).collect();
    let sentence = sentences.iter().find_map(|one| filled(one, &fields));
    let sentence = sentence.unwrap_or_default() + "\n";
    let parts = [sentence, columns(&list, |_| false)];
    let parts = parts.into_iter().chain(tables);
    let parts: Vec<String> = parts.filter(|part| part.len() > 1).collect();
    Ok(parts.join("\n"))
}

/// A serialized result whose fields keep their order.
#[derive(Clone, Deserialize)]
#[serde(untagged)]
enum Node {
    None,
    Flag(bool),
    Number(Number),
    Text(String),
    List(Vec<Self>),
    Struct(Fields),
}

type Fields = IndexMap<String, Node>;

/// A sentence with its quantities; none if one is not known.
fn filled(sentence: &str, fields: &Fields) -> Option<String> {
    let mut parts = sentence.split('{');
    let mut text = parts.next()?.to_owned();
    for part in parts {
        let (path, rest) = part.split_once('}')?;
        let mut keys = path.split('.');
        let first = fields.get(keys.next()?)?;
        let found = keys.try_fold(first, |node, key| match node {
            Node::Struct(fields) => fields.get(key),
            Node::List(all) if key == "last" => all.last(),
            _ => None,
        });
        text += &cell(found?, "95 % interval ")?;
        text += rest;
    }
    Some(text)
}

/// Names of quantities by the end of their path, and units by the end of a
/// key; an empty name leaves the quantity to the JSON.
static VOCABULARY: LazyLock<BTreeMap<&str, &str>> = LazyLock::new(|| {
    let lines = include_str!("vocabulary.txt").lines();
    let entry = |line: &'static str| line.split_once('=');
    lines.filter_map(entry).map(|(k, n)| (k.trim(), n.trim())).collect()
});

/// The name of a quantity, below that of the struct which holds it, and its
/// unit; none if it is left to the JSON.
fn heading(path: &str, outer: &str) -> Option<(String, &'static str)> {
    let mut ends = path.match_indices('.').map(|(dot, _)| &path[dot + 1..]);
    let known = ends.find_map(|end| VOCABULARY.get(end));
    let key = path.rsplit('.').next().unwrap_or(path);
    let unit = |(at, _)| Some((at, *VOCABULARY.get(&key[at..])?));
    let unit = key.match_indices('_').find_map(unit);
    let (end, unit) = unit.unwrap_or((key.len(), ""));
    let own = key[..end].replace('_', " ");
    let name = match (known, outer) {
        (Some(name), _) => (*name).to_owned(),
        (None, "") => capital(&own),
        (None, outer) => format!("{outer}, {own}"),
    };
    (!name.is_empty()).then_some((name, unit))
}

/// A quantity as it is shown.
struct NamedCell {
    name: String,
    cell: String,
    unit: &'static str,
}

/// Makes the quantities of a list of structs from its path, its name and the
/// structs.
type OfList<'a> = &'a mut dyn FnMut(&str, &str, &[Node]) -> Vec<NamedCell>;

/// The quantities of a struct named `outer`.
fn cells(
    path: &str,
    outer: &str,
    fields: &Fields,
    of_list: OfList<'_>,
) -> Vec<NamedCell> {
    let mut found = Vec::new();
    for (key, value) in fields {
        let path = format!("{path}.{key}");
        let Some((name, unit)) = heading(&path, outer) else { continue };
        match (value, cell(value, "")) {
            (Node::List(all), _)
                if matches!(all[..], [Node::Struct(_), ..]) =>
            {
                found.extend(of_list(&path, &name, all));
            }
            (Node::Struct(fields), None) => match fields.get("reason") {
                Some(Node::Text(reason)) if fields.len() == 1 => {
                    let cell = format!("none: {reason}");
                    found.push(NamedCell { name, cell, unit });
                }
                _ => found.extend(cells(&path, &name, fields, of_list)),
            },
            (_, Some(cell)) => found.push(NamedCell { name, cell, unit }),
            (_, None) => {}
        }
    }
    found
}

/// The quantities of a list in the line of a table. The first field of each
/// struct names its other quantities.
fn listed(path: &str, name: &str, all: &[Node]) -> Vec<NamedCell> {
    let mut found = Vec::new();
    for one in all {
        let Node::Struct(fields) = one else { continue };
        let mut rest = fields.clone();
        let first = rest.shift_remove_index(0);
        let first = first.and_then(|(_, first)| cell(&first, ""));
        let first = first.unwrap_or_default();
        let behind = |one: NamedCell| NamedCell {
            name: format!("{name} {first}: {}", one.name),
            ..one
        };
        let inner = cells(path, "", &rest, &mut listed).into_iter();
        found.extend(inner.map(behind));
    }
    found
}

/// Stands in a table for what is not known.
const NONE: &str = "-";

/// A title, a head of the names, and one line a struct; columns of numbers
/// end at one place.
fn table(path: &str, title: &str, all: &[Node]) -> String {
    let mut heads: IndexMap<String, usize> = IndexMap::new();
    let mut lines: Vec<Vec<String>> = vec![Vec::new()];
    for one in all {
        let Node::Struct(fields) = one else { continue };
        let mut line = Vec::new();
        for NamedCell { name, cell, unit } in
            cells(path, "", fields, &mut listed)
        {
            let unit = match unit {
                "" => String::new(),
                unit => format!(" ({unit})"),
            };
            let next = heads.len();
            let place = *heads.entry(name + &unit).or_insert(next);
            line.resize(heads.len(), NONE.to_owned());
            line[place] = cell;
        }
        lines.push(line);
    }
    lines.iter_mut().for_each(|l| l.resize(heads.len(), NONE.to_owned()));
    lines[0] = heads.into_keys().collect();
    let is_number = |k: usize| {
        let mut cells = lines.iter().skip(1).filter_map(|line| line.get(k));
        cells.all(|cell| cell == NONE || cell.parse::<f64>().is_ok())
    };
    format!("{title}:\n{}", columns(&lines, is_number))
}

/// A value in words; none of nothing and of a struct of several quantities.
fn cell(value: &Node, called: &str) -> Option<String> {
    Some(match value {
        Node::None => return None,
        Node::Flag(yes) => String::from(if *yes { "yes" } else { "no" }),
        // A name with a line break stays in its row.
        Node::Text(text) => text.replace('\n', "\\u000a"),
        Node::Number(x) if x.is_f64() => number(x.as_f64()?, None),
        Node::Number(n) => n.to_string(),
        Node::List(all) if all.is_empty() => return None,
        Node::List(all) => {
            let cells = all.iter().filter_map(|one| cell(one, called));
            cells.collect::<Vec<_>>().join(" ")
        }
        Node::Struct(fields) => {
            let at = |name: &str| match fields.get(name)? {
                Node::Number(x) => x.as_f64(),
                _ => None,
            };
            let point = at("point").or_else(|| at("value"))?;
            fields.get("low")?;
            interval(point, [at("low"), at("high")], called)
        }
    })
}

/// A number with the ends of its interval: two digits of its width.
fn interval(point: f64, ends: [Option<f64>; 2], called: &str) -> String {
    let [low, high] = ends;
    if low.or(high).is_none() {
        return number(point, None);
    }
    let error = low.zip(high).map(|(low, high)| 0.1 * (high - low));
    let end = |x: Option<f64>| x.map_or("open".into(), |x| number(x, error));
    let (point, [low, high]) = (number(point, error), ends.map(end));
    format!("{point} ({called}{low} to {high})")
}

/// A number with six significant digits, fewer if its error is known: none
/// below the first digit of the error.
pub fn number(x: f64, error: Option<f64>) -> String {
    let place = |x: f64| libm::log10(x.abs()).floor() as i32;
    let first = if x == 0.0 { 0 } else { place(x) };
    let last = error.filter(|error| *error > 0.0).map(place);
    let digits = last.map_or(6, |last| first.saturating_sub(last) + 1);
    let digits = digits.clamp(1, 6);
    let x = rounded(x, digits as usize);
    if x != 0.0 && !(1e-4..1e6).contains(&x.abs()) {
        return if x.is_finite() { format!("{x:e}") } else { x.to_string() };
    }
    match last {
        Some(_) => format!("{x:.0$}", (digits - 1 - first).max(0) as usize),
        None => x.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn a_sentence_is_followed_by_named_quantities_and_tables() {
        let result = json!({
            "alpha_rad": 0.15,
            "beta": { "point": 0.4, "low": 0.297, "high": 0.5 },
            "mine": { "by": [{ "on": "M", "slope": 0.5 }], "used": 3 },
            "none": null,
            "other": { "reason": "too few" },
            "rows": [
                { "im": "pga", "new_g": 0.123_456_78, "left_out": null },
                { "im": "sa:1", "new_g": 12_345_678.0, "left_out": 3 },
            ],
            "seed": 3,
        });
        let expected = "\
            It has 0.40 (95 % interval 0.30 to 0.50).\n\n\
            Slenderness alpha  0.15 rad\n\
            Dispersion         0.40 (0.30 to 0.50)\nMine, used         3\n\
            Other              none: too few\n\n\
            Mine, by:\nOn  Slope\nM     0.5\n\nRows:\n\
            Intensity measure    New (g)  Left out\n\
            pga                 0.123457         -\n\
            sa:1               1.23457e7         3\n";
        let sentences = ["Not {none}.", "It has {beta}."];
        assert_eq!(text(&sentences, &result).unwrap(), expected);
    }

    #[test]
    fn digits_end_at_the_error() {
        assert_eq!(number(0.012_345, Some(2e-4)), "0.0123");
        assert_eq!(number(1234.5, Some(100.0)), "1200");
        assert_eq!(number(0.0, Some(0.01)), "0.00");
        assert_eq!(number(f64::INFINITY, None), "inf");
    }
}
