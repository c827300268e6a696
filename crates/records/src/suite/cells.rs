//! A line of separated cells.

/// Cells of a line; `None` for a quote that does not close or is in the middle
/// of a cell. A doubled quote inside quotes is one quote.
pub(super) fn split(line: &str, separator: char) -> Option<Vec<String>> {
    let mut cells = Vec::new();
    let mut rest = line;
    loop {
        let quoted = rest.trim_start().strip_prefix('"');
        let (cell, after) = match quoted {
            Some(quoted) => unquote(quoted)?,
            None => {
                let end = rest.find(separator).unwrap_or(rest.len());
                (rest[..end].trim().to_owned(), &rest[end..])
            }
        };
        if cell.contains('"') && quoted.is_none() {
            return None;
        }
        cells.push(cell);
        match after.trim_start().strip_prefix(separator) {
            Some(more) => rest = more,
            None if after.trim().is_empty() => return Some(cells),
            None => return None,
        }
    }
}

fn unquote(quoted: &str) -> Option<(String, &str)> {
    let mut cell = String::new();
    let mut rest = quoted;
    loop {
        let end = rest.find('"')?;
        cell.push_str(&rest[..end]);
        rest = &rest[end + 1..];
        match rest.strip_prefix('"') {
            Some(more) => {
                cell.push('"');
                rest = more;
            }
            None => return Some((cell, rest)),
        }
    }
}
