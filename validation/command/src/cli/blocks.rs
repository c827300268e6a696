//! The table of blocks: CSV, one row a block, the same for all commands.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::{Path, PathBuf};

use rocking::block::{Block, Restitution};
use rocking_exchange::Id;
use rocking_exchange::read::{no_csv, reader};
use serde::Deserialize;

use crate::failure::{AtPlace as _, Failure, bail, ensure};
use crate::input;

/// The columns that a table of blocks has.
const EXPECTED: &str = "numbers in the columns alpha and p, or width_m and \
                        height_m, and where wanted id, eta, sample, \
                        friction, limit_ratio and floor";

/// The cells of a row; `None` for an empty one.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct BlockCells {
    id: Option<Id>,
    alpha: Option<f64>,
    p: Option<f64>,
    width_m: Option<f64>,
    height_m: Option<f64>,
    /// Coefficient of restitution.
    pub eta: Option<f64>,
    sample: Option<String>,
    /// Coefficient of friction of the floor.
    pub friction: Option<f64>,
    /// Rotation over slenderness that must not be exceeded.
    pub limit_ratio: Option<f64>,
    /// The floor of the building; `None` for the ground.
    pub floor: Option<Id>,
}

/// A row of the table.
#[derive(Clone, Debug)]
pub struct BlockRow {
    /// File and line.
    pub place: String,
    /// The name, by default made of alpha and p.
    pub id: Id,
    /// The block.
    pub block: Block,
    /// Its own sample files beside the table, one a limit state.
    pub samples: Vec<PathBuf>,
    /// Its other cells.
    pub cells: BlockCells,
}

impl BlockRow {
    /// A block that is not from a table.
    pub fn of(id: Id, block: Block) -> Self {
        let (samples, cells) = (Vec::new(), BlockCells::default());
        Self { place: id.to_string(), id, block, samples, cells }
    }
}

/// Reads a table with the columns `alpha,p` (rad, rad/s) or
/// `width_m,height_m`, and where wanted `id`, `eta`, `sample` with files
/// separated by `;`, `friction`, `limit_ratio` and `floor`.
///
/// # Errors
/// [`Failure`] with the line for another column, a cell of another form, a
/// block out of range, a name that comes again, and no row at all.
pub fn read(path: &Path, gravity_m_s2: f64) -> Result<Vec<BlockRow>, Failure> {
    parse(input::open(path)?, path, gravity_m_s2)
}

/// Reads the text of such a table; `path` is its name in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(
    from: impl Read,
    path: &Path,
    gravity_m_s2: f64,
) -> Result<Vec<BlockRow>, Failure> {
    let place = path.display();
    let mut reader = reader(from, csv::Trim::All, None);
    let header = reader.headers().map_err(|e| no_csv(path, e))?.clone();
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut rows: Vec<BlockRow> = Vec::new();
    let mut ids = BTreeMap::new();
    for record in reader.records() {
        let record = record.map_err(|e| no_csv(path, e))?;
        let line = record.position().map_or(0, csv::Position::line);
        let place = format!("{place}:{line}");
        let at = |what: String| Failure::input(format!("{place}: {what}"));
        let mut cells: BlockCells = record
            .deserialize(Some(&header))
            .map_err(|e| at(format!("{e}: expected {EXPECTED}")))?;
        let block = match (cells.alpha, cells.p, cells.width_m, cells.height_m)
        {
            (Some(alpha), Some(p), None, None) => Block::try_new(alpha, p),
            (None, None, Some(width_m), Some(height_m)) => {
                Block::from_dimensions(width_m, height_m, gravity_m_s2)
            }
            _ => bail!("{place}: expected {EXPECTED}"),
        };
        let block = block.at(&place)?;
        if let Some(eta) = cells.eta {
            Restitution::constant(eta).at(&place)?;
        }
        let id =
            cells.id.take().map_or_else(|| Id::of(&block), Ok).map_err(at)?;
        if let Some(before) = ids.insert(id.clone(), line) {
            bail!(
                "{place}: {id} is already on line {before}: expected a \
                 unique id"
            );
        }
        let samples = cells.sample.take().map_or(Vec::new(), |names| {
            names.split(';').map(|name| folder.join(name.trim())).collect()
        });
        let mu = cells.friction.filter(|mu| !(*mu > 0.0 && mu.is_finite()));
        if let Some(mu) = mu {
            bail!("{place}: friction {mu}: expected a positive number");
        }
        rows.push(BlockRow { place, id, block, samples, cells });
    }
    ensure!(!rows.is_empty(), "{place}: no block");
    Ok(rows)
}

/// Reads a table of blocks that all stand on the ground.
///
/// # Errors
/// [`Failure`] for a table that [`read`] refuses, and a row with a floor.
pub fn on_ground(
    path: &Path,
    gravity_m_s2: f64,
) -> Result<Vec<BlockRow>, Failure> {
    let rows = read(path, gravity_m_s2)?;
    if let Some(row) = rows.iter().find(|row| row.cells.floor.is_some()) {
        bail!(
            "{}: a floor: expected none, motions here are those of the ground",
            row.place
        );
    }
    Ok(rows)
}
