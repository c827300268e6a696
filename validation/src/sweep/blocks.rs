//! The table of blocks of a sweep.

use std::path::Path;

use rocking::block::{Block, Restitution};
use rocking::units::STANDARD_GRAVITY_M_S2;

use super::SweepError;

/// A block and its coefficient of restitution.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Given {
    /// The block.
    pub block: Block,
    /// Coefficient of restitution.
    pub eta: f64,
}

/// Columns that a table of blocks may have.
const EXPECTED: &str = "a header of alpha,p or width_m,height_m, and \
     optionally eta; then a row a block";

/// The blocks of a CSV file: `alpha,p` (rad, rad/s) or `width_m,height_m`,
/// and optionally `eta`; where a file has no column `eta`, it is `eta`.
///
/// # Errors
/// [`SweepError::Blocks`] with the line for another header, a cell that is
/// no number, a block or restitution out of range, and a table without rows.
pub fn read_blocks(path: &Path, eta: f64) -> Result<Vec<Given>, SweepError> {
    let flaw = |line: u64, found: String| SweepError::Blocks {
        path: path.to_owned(),
        line,
        found,
        expected: EXPECTED,
    };
    let text = std::fs::read_to_string(path).map_err(|source| {
        SweepError::Read { path: path.to_owned(), source }
    })?;
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .from_reader(text.as_bytes());
    let header = reader.headers().map_err(|e| flaw(1, e.to_string()))?.clone();
    let column = |name: &str| header.iter().position(|cell| cell == name);
    let known = ["alpha", "p", "width_m", "height_m", "eta"];
    if let Some(other) = header.iter().find(|cell| !known.contains(cell)) {
        return Err(flaw(1, format!("column {other:?}")));
    }
    let angles = column("alpha").zip(column("p"));
    let sizes = column("width_m").zip(column("height_m"));
    let mut out = Vec::new();
    for row in reader.records() {
        let row = row.map_err(|e| {
            flaw(e.position().map_or(1, csv::Position::line), e.to_string())
        })?;
        let line = row.position().map_or(1, csv::Position::line);
        let cell = |column: usize| -> Result<f64, SweepError> {
            let text = row.get(column).unwrap_or_default();
            text.parse().map_err(|_| flaw(line, format!("{text:?}")))
        };
        let block = match (angles, sizes) {
            (Some((alpha, p)), None) => Block::try_new(cell(alpha)?, cell(p)?),
            (None, Some((width, height))) => Block::from_dimensions(
                cell(width)?,
                cell(height)?,
                STANDARD_GRAVITY_M_S2,
            ),
            _ => return Err(flaw(1, format!("{header:?}"))),
        };
        let block = block.map_err(|e| flaw(line, e.to_string()))?;
        let eta = column("eta").map_or(Ok(eta), cell)?;
        Restitution::constant(eta).map_err(|e| flaw(line, e.to_string()))?;
        out.push(Given { block, eta });
    }
    if out.is_empty() {
        return Err(flaw(2, "no block".into()));
    }
    Ok(out)
}
