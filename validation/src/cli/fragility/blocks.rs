//! A table of blocks: one row a block, CSV.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use rocking::block::Block;
use rocking_exchange::Id;

use crate::cli::Failure;

/// Columns that a table of blocks may have.
const COLUMNS: [&str; 7] =
    ["id", "alpha", "p", "width_m", "height_m", "eta", "sample"];

/// A row of the table.
pub(super) struct Row {
    /// Line of the file.
    pub line: u64,
    pub id: Option<Id>,
    pub block: Block,
    pub eta: Option<f64>,
    /// Its own sample, beside the table.
    pub sample: Option<PathBuf>,
}

/// Reads a table with the columns `alpha,p` (rad, rad/s) or
/// `width_m,height_m`, and `id`, `eta` and `sample` where wanted.
pub(super) fn read(
    path: &Path,
    gravity_m_s2: f64,
) -> Result<Vec<Row>, Failure> {
    let place = path.display();
    let file = File::open(path)
        .map_err(|e| Failure::input(format!("cannot read {place}: {e}")))?;
    let mut reader =
        csv::ReaderBuilder::new().trim(csv::Trim::All).from_reader(file);
    let broken = |e: csv::Error| Failure::input(format!("{place}: {e}"));
    let header = reader.headers().map_err(broken)?.clone();
    for name in &header {
        if !COLUMNS.contains(&name) {
            return Err(Failure::input(format!(
                "{place}:1: column `{name}`: expected some of {}",
                COLUMNS.join(", ")
            )));
        }
    }
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut rows = Vec::new();
    for record in reader.records() {
        let record = record.map_err(broken)?;
        let line = record.position().map_or(0, csv::Position::line);
        let at =
            |what: String| Failure::input(format!("{place}:{line}: {what}"));
        let cells: BTreeMap<&str, &str> = header
            .iter()
            .zip(&record)
            .filter(|(_, cell)| !cell.is_empty())
            .collect();
        let number = |name: &str| {
            let Some(text) = cells.get(name) else { return Ok(None) };
            let value = text.parse().ok().filter(|x: &f64| x.is_finite());
            value.map(Some).ok_or_else(|| {
                at(format!("{name}: found `{text}`: expected a number"))
            })
        };
        let size = [
            number("alpha")?,
            number("p")?,
            number("width_m")?,
            number("height_m")?,
        ];
        let block = match size {
            [Some(alpha), Some(p), None, None] => Block::try_new(alpha, p),
            [None, None, Some(width_m), Some(height_m)] => {
                Block::from_dimensions(width_m, height_m, gravity_m_s2)
            }
            _ => {
                return Err(at("expected alpha and p, or width_m and \
                               height_m"
                    .to_owned()));
            }
        };
        let block = block.map_err(|e| at(e.to_string()))?;
        let eta = number("eta")?;
        if eta.is_some_and(|eta| !(eta > 0.0 && eta <= 1.0)) {
            return Err(at("eta: expected a number in (0, 1]".to_owned()));
        }
        let id = cells.get("id").map(|text| text.parse::<Id>());
        let id = id.transpose().map_err(at)?;
        let sample = cells.get("sample").map(|name| folder.join(name));
        rows.push(Row { line, id, block, eta, sample });
    }
    if rows.is_empty() {
        return Err(Failure::input(format!("{place}: no block")));
    }
    Ok(rows)
}
