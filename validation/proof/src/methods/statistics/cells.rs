//! Numbers of a reference's CSV, and refusals.

use crate::error::MethodError;

/// A refusal of the core where an answer was due.
pub fn refused(error: impl std::fmt::Display) -> MethodError {
    MethodError::Oracle(error.to_string())
}

/// Rows of a CSV by their first field, the rest as words.
pub fn rows<'a>(
    csv: &'a str,
    file: &'static str,
    first: &str,
) -> Result<Vec<Vec<&'a str>>, MethodError> {
    let rows: Vec<Vec<&str>> = csv
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>())
        .filter(|fields| fields.first() == Some(&first))
        .collect();
    if rows.is_empty() {
        return Err(MethodError::Reference {
            file,
            what: format!("no row `{first}`"),
        });
    }
    Ok(rows)
}

/// A number of a CSV.
pub fn number(file: &'static str, text: &str) -> Result<f64, MethodError> {
    text.trim().parse().map_err(|_| MethodError::Reference {
        file,
        what: format!("`{text}` is no number"),
    })
}
