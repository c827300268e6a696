//! How a result is printed: as JSON by `serde`, or as text made of the same
//! fields by one rule.

use indexmap::IndexMap;
use serde::{Deserialize, Serialize};

use crate::failure::Failure;
use crate::terminal::COMMIT;
use rocking_common::table::columns::SCHEMA;
use rocking_common::words::columns;

/// What every JSON of a command carries.
#[derive(Serialize)]
struct JsonEnvelope<'a, T> {
    schema: u32,
    version: &'static str,
    commit: &'static str,
    #[serde(flatten)]
    result: &'a T,
}

/// A result as JSON or as text.
///
/// # Errors
/// [`Failure`] where the result cannot be serialized.
pub fn shown<T: Serialize>(json: bool, result: &T) -> Result<String, Failure> {
    if !json {
        return text(result);
    }
    let version = env!("CARGO_PKG_VERSION");
    let all = JsonEnvelope { schema: SCHEMA, version, commit: COMMIT, result };
    Ok(serde_json::to_string_pretty(&all)? + "\n")
}

/// A result as text: a row for each field, a table for each list of structs.
///
/// # Errors
/// [`Failure`] where the result cannot be serialized.
pub fn text<T: Serialize>(result: &T) -> Result<String, Failure> {
    let node: Node = serde_json::from_str(&serde_json::to_string(result)?)?;
    let mut text = String::new();
    match node {
        Node::Struct(fields) => rows(&mut text, &fields, 0),
        other => text = cell(&other) + "\n",
    }
    Ok(text)
}

/// A serialized result whose fields keep their order.
#[derive(Clone, Deserialize)]
#[serde(untagged)]
enum Node {
    None,
    Flag(bool),
    Count(u64),
    Whole(i64),
    Number(f64),
    Text(String),
    List(Vec<Self>),
    Struct(Fields),
}

type Fields = IndexMap<String, Node>;

/// Units that end the name of a field, the longer ones first.
const UNITS: [(&str, &str); 13] = [
    ("_rad_s", "rad/s"),
    ("_cm_s", "cm/s"),
    ("_m_s2", "m/s2"),
    ("_m_s", "m/s"),
    ("_per_year", "1/year"),
    ("_years", "years"),
    ("_percent", "%"),
    ("_rad", "rad"),
    ("_hz", "Hz"),
    ("_s", "s"),
    ("_m", "m"),
    ("_n", "N"),
    ("_g", "g"),
];

/// The name of a field in words, and its unit.
fn heading(name: &str) -> String {
    let with_unit =
        |(end, unit): &(&str, _)| Some((name.strip_suffix(end)?, *unit));
    match UNITS.iter().find_map(with_unit) {
        Some((words, unit)) => format!("{} ({unit})", words.replace('_', " ")),
        None => name.replace('_', " "),
    }
}

/// Columns of the widest table; a wider one becomes a block of rows a line.
const WIDEST: usize = 140;

/// One row a field; a struct is a block of rows, a list of structs a table.
fn rows(text: &mut String, fields: &Fields, depth: usize) {
    let indent = 2 * depth;
    for (name, value) in fields {
        let name = heading(name);
        match value {
            Node::Struct(inner) if interval(inner).is_none() => {
                *text += &format!("{:indent$}{name}\n", "");
                rows(text, inner, depth + 1);
            }
            Node::List(all) if all.is_empty() => {}
            Node::List(all)
                if matches!(all.first(), Some(Node::Struct(_))) =>
            {
                *text += &format!("{:indent$}{name}\n", "");
                let mut lines = String::new();
                table(&mut lines, all, indent + 2);
                if lines.lines().all(|line| line.chars().count() <= WIDEST) {
                    *text += &lines;
                    continue;
                }
                for one in all {
                    let Node::Struct(fields) = one else { continue };
                    rows(text, fields, depth + 1);
                }
            }
            _ => {
                let width = 32_usize.saturating_sub(indent);
                let name = format!("{name:<width$}");
                let gap = if name.len() > width { "  " } else { "" };
                let cell = cell(value);
                *text += &format!("{:indent$}{name}{gap}{cell}\n", "");
            }
        }
    }
}

/// A head of the field names, and one line a struct.
fn table(text: &mut String, all: &[Node], indent: usize) {
    let mut lines = Vec::new();
    for one in all {
        let Node::Struct(fields) = one else { continue };
        let mut row = Vec::new();
        flatten("", fields, &mut row);
        if lines.is_empty() {
            lines.push(row.iter().map(|(name, _)| name.clone()).collect());
        }
        lines.push(row.into_iter().map(|(_, cell)| cell).collect());
    }
    let is_word = |cell: &String| {
        cell.parse::<f64>().is_err() && cell != "none" && !cell.ends_with(']')
    };
    let is_right = |column: usize| {
        let body = lines.iter().skip(1);
        !body.filter_map(|line: &Vec<_>| line.get(column)).any(is_word)
    };
    for line in columns(&lines, is_right).lines() {
        *text += &format!("{:indent$}{line}\n", "");
    }
}

/// The cells of a row, the fields of inner structs behind their own name.
fn flatten(before: &str, fields: &Fields, into: &mut Vec<(String, String)>) {
    for (name, value) in fields {
        let name = format!("{before}{}", heading(name));
        match value {
            Node::Struct(inner) if interval(inner).is_none() => {
                flatten(&format!("{name} "), inner, into);
            }
            // Each struct of a list behind its first field, which names it.
            Node::List(all)
                if matches!(all.first(), Some(Node::Struct(_))) =>
            {
                for one in all {
                    let Node::Struct(inner) = one else { continue };
                    let mut inner = inner.clone();
                    let Some((_, first)) = inner.shift_remove_index(0) else {
                        continue;
                    };
                    flatten(&format!("{} ", cell(&first)), &inner, into);
                }
            }
            _ => into.push((name, cell(value))),
        }
    }
}

/// A value with the ends of its interval: a struct with `point` or `value`,
/// `low` and `high`.
fn interval(fields: &Fields) -> Option<String> {
    let at = |name: &str| fields.get(name).map(cell);
    let point = at("point").or_else(|| at("value"))?;
    let (low, high) = (at("low")?, at("high")?);
    Some(format!("{point} [{low}, {high}]"))
}

fn cell(value: &Node) -> String {
    match value {
        Node::None => "none".into(),
        Node::Flag(yes) => String::from(if *yes { "yes" } else { "no" }),
        Node::Count(n) => n.to_string(),
        Node::Whole(n) => n.to_string(),
        // A name with a line break stays in its row.
        Node::Text(text) => text.replace('\n', "\\u000a"),
        Node::Number(x) => number(*x),
        Node::List(all) => all.iter().map(cell).collect::<Vec<_>>().join(" "),
        Node::Struct(fields) => interval(fields).unwrap_or_default(),
    }
}

/// Six significant digits.
fn number(x: f64) -> String {
    let size = x.abs();
    if x == 0.0 || (1e-4..1e6).contains(&size) {
        let before = if x == 0.0 { 0.0 } else { libm::log10(size).floor() };
        let places = (5.0 - before).clamp(0.0, 9.0) as usize;
        let text = format!("{x:.places$}");
        if places == 0 {
            return text;
        }
        return text.trim_end_matches('0').trim_end_matches('.').to_owned();
    }
    format!("{x:.5e}")
}

#[cfg(test)]
mod tests {
    use super::text;
    use serde_json::json;

    #[test]
    fn fields_are_rows_with_units_and_lists_are_tables() {
        let result = json!({
            "a_rad": 0.15,
            "beta": { "point": 0.4, "low": 0.3, "high": 0.5 },
            "none": null,
            "rows": [
                { "im": "pga", "median_g": 0.123_456_78 },
                { "im": "sa:1", "median_g": 12_345_678.0 },
            ],
            "sub": { "of": [{ "on": "M", "slope": 0.5 }], "used": 3 },
        });
        let expected = "\
            a (rad)                         0.15\n\
            beta                            0.4 [0.3, 0.5]\n\
            none                            none\n\
            rows\n  im    median (g)\n  pga     0.123457\n  \
            sa:1   1.23457e7\n\
            sub\n  of\n    on  slope\n    M     0.5\n  \
            used                          3\n";
        assert_eq!(text(&result).unwrap(), expected);
    }
}
