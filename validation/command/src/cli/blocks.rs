//! The table of blocks: CSV, one row a block, the same for all commands.

use std::collections::BTreeMap;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

use csv::{ReaderBuilder, StringRecord};
use rocking::accelerogram::{EXPECTED, result_name};
use rocking::block::Block;
use rocking_exchange::Id;
use rocking_exchange::columns::BLOCKS;
use rocking_exchange::read::{Closed, no_csv};

use crate::failure::{AtPlace as _, Failure, bail, ensure};
use crate::input;

/// The most faults that a message lists.
const MOST_FAULTS: usize = 20;

/// The cells of a row beside names and sizes; `None` for an empty one.
#[derive(Clone, Debug, Default)]
pub struct BlockCells {
    /// Coefficient of restitution.
    pub eta: Option<f64>,
    /// Coefficient of friction of the floor.
    pub friction: Option<f64>,
    /// Rotation over slenderness that must not be exceeded.
    pub limit_ratio: Option<f64>,
    /// The floor of the building; `None` for the ground.
    pub floor: Option<String>,
}

/// A row of the table.
#[derive(Clone, Debug)]
pub struct BlockRow {
    /// File and line.
    pub place: String,
    /// The name for people, by default `id`.
    pub label: String,
    /// The name in files, by default made of the label, or of alpha and p.
    pub id: Id,
    /// The block.
    pub block: Block,
    /// Whether the width of the block is the depth of the object, which
    /// overturns about the shorter side of its base.
    pub depth_governs: bool,
    /// Position in the room in m.
    pub position_m: Option<(f64, f64)>,
    /// Its own sample files beside the table, one a limit state.
    pub samples: Vec<PathBuf>,
    /// Its other cells.
    pub cells: BlockCells,
    /// Cells of columns without a meaning, with their heads, in order.
    pub notes: Vec<(String, String)>,
    /// Whether a number has a decimal comma.
    pub decimal_commas: bool,
}

impl BlockRow {
    /// A block that is not from a table.
    pub fn of(id: Id, block: Block) -> Self {
        Self {
            place: id.to_string(),
            label: id.to_string(),
            id,
            block,
            depth_governs: false,
            position_m: None,
            samples: Vec::new(),
            cells: BlockCells::default(),
            notes: Vec::new(),
            decimal_commas: false,
        }
    }
}

/// Reads a table with the columns of [`BLOCKS`]; other columns are notes.
///
/// # Errors
/// [`Failure`] with all faults, each with its line: a column that is nearly a
/// known one, a cell of another form, a block out of range, a label that comes
/// again; and for no row at all.
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
    let text = io::read_to_string(from);
    let text = text.at(format_args!("{place}: expected CSV in UTF-8"))? + "\n";
    let text = text.trim_start_matches('\u{feff}').replace("\r\n", "\n");
    let header = text.trim_start().lines().next().unwrap_or_default();
    let [comma, semi, tab] = [',', ';', '\t'].map(|c| header.contains(c));
    ensure!(comma || semi || !tab, "{place}: tabs: expected commas");
    let separator = if semi && !comma { b';' } else { b',' };
    let mut csv = ReaderBuilder::new();
    let csv = csv.delimiter(separator).flexible(true);
    let mut csv =
        csv.from_reader(Closed::new(text.as_bytes(), None, separator));
    let header = csv.headers().map_err(|e| no_csv(path, e))?;
    let mut table = BlockTable::of(place.to_string(), separator, header);
    let mut rows = Vec::new();
    while csv.read_record(&mut table.record).map_err(|e| no_csv(path, e))? {
        // The reader is at the line below the row.
        let within = table.record.as_slice().matches('\n').count();
        table.line = csv.position().line() - 1 - within as u64;
        let row = table.row(path, gravity_m_s2);
        rows.extend(row);
    }
    let more = table.faults.saturating_sub(MOST_FAULTS);
    table.listed.extend((more > 0).then(|| format!("and {more} more")));
    ensure!(table.listed.is_empty(), "{}", table.listed.join("\n"));
    ensure!(!rows.is_empty(), "{place}: no block");
    // An id that is derived differs from all that are given.
    let given = &table.names[1];
    let is_given = |row: &&mut BlockRow| {
        let line = given.get(&row.id.to_string());
        line.is_some_and(|line| row.place == format!("{place}:{line}"))
    };
    let (own, derived): (Vec<_>, Vec<_>) = rows.iter_mut().partition(is_given);
    let all = own.into_iter().chain(derived);
    Id::distinguish(all.map(|row| &mut row.id));
    Ok(rows)
}

/// What a column should be, if its name is nearly a known one.
fn nearest(name: &str) -> Option<String> {
    let stem = name.split('_').next()?;
    if ["width", "height", "depth"].contains(&stem) {
        return Some(format!("{stem}_m, {stem}_cm or {stem}_mm"));
    }
    let near = BLOCKS.names().find(|own| {
        // A short name is near many others, and the distance of a long one
        // takes memory.
        let most = [0, 0, 0, 1, 1, 1].get(own.len()).copied().unwrap_or(2);
        own.len().abs_diff(name.len()) <= most
            && strsim::damerau_levenshtein(own, name) <= most
    });
    near.map(|own| format!("{own}, or another name"))
}

/// Words for the numbers that a cell may have, and which these are.
type Fits = (&'static str, fn(f64) -> bool);

const ANY: Fits = ("a number", |_| true);
const POSITIVE: Fits = ("a positive number", |x| x > 0.0);
const RATIO: Fits = ("a number between 0 and 1", |x| x > 0.0 && x < 1.0);
const ETA: Fits = ("a number in (0, 1]", |x| x > 0.0 && x <= 1.0);

/// A table that is read row by row, and its faults.
#[derive(Default)]
struct BlockTable {
    place: String,
    separator: u8,
    /// Names of known columns, and heads of notes.
    columns: Vec<String>,
    /// Whether the header line has a fault that leaves rows without a size.
    lacks_length: bool,
    record: StringRecord,
    /// Line of the record, from 1.
    line: u64,
    /// Whether a number of the record has a decimal comma.
    decimal_commas: bool,
    /// Lines of the labels, and of the texts of which ids are made.
    names: [BTreeMap<String, u64>; 2],
    faults: usize,
    /// The first of them.
    listed: Vec<String>,
}

impl BlockTable {
    fn of(place: String, separator: u8, header: &StringRecord) -> Self {
        let mut table = Self { place, separator, line: 1, ..Self::default() };
        table.columns.reserve_exact(header.len());
        for head in header {
            // Each row has a copy.
            let head = format!("{:.64}", head.trim().replace('\n', " "));
            // Capitals, blanks and brackets are no part of a name.
            let name = Id::of_label(&head).map(|id| id.to_string());
            let name = name.unwrap_or_default().to_lowercase();
            let name = if name == "name" { "label".into() } else { name };
            let is_known = BLOCKS.names().any(|own| own == name)
                && !table.columns.contains(&name);
            if !is_known && let Some(expected) = nearest(&name) {
                table.fault(&format!("column {head}"), &expected);
                table.lacks_length |= expected.contains("_m");
            }
            table.columns.push(if is_known { name } else { head });
        }
        table
    }

    fn fault(&mut self, found: &str, expected: &str) {
        self.faults += 1;
        if self.faults <= MOST_FAULTS {
            let place = format!("{}:{}", self.place, self.line);
            self.listed.push(format!("{place}: {found}: expected {expected}"));
        }
    }

    /// The text of a cell; none if it is empty or the table lacks the column.
    fn text(&self, column: &str) -> Option<String> {
        let place = self.columns.iter().position(|own| own == column)?;
        let text = self.record[place].trim().replace('\n', " ");
        (!text.is_empty()).then_some(text)
    }

    /// A text that results can contain.
    fn name(&mut self, column: &str) -> Option<String> {
        let text = self.text(column)?;
        if result_name(&text).is_err() {
            self.fault(&format!("{column} is \"{text:.64}\""), EXPECTED);
        }
        Some(text)
    }

    fn number(&mut self, column: &str, fits: Fits) -> Option<f64> {
        let text = self.text(column)?;
        let [point, whole] = [".", ""].map(|to| text.replacen(',', to, 1));
        let is_thousands = self.separator == b','
            && matches!(text.as_bytes(), [b'1'..=b'9', .., b',', _, _, _]);
        let expected = match point.parse::<f64>() {
            Err(_) => "a number with a decimal point, such as 0.16",
            Ok(_) if is_thousands => &format!("{whole} or {point}"),
            Ok(x) if x.is_finite() && fits.1(x) => {
                self.decimal_commas |= text.contains(',');
                return Some(x);
            }
            Ok(_) => fits.0,
        };
        self.fault(&format!("{column} is \"{text:.64}\""), expected);
        None
    }

    /// The row; `None` for one with faults, or without cells.
    fn row(&mut self, path: &Path, gravity_m_s2: f64) -> Option<BlockRow> {
        let (found, expected) = (self.record.len(), self.columns.len());
        if self.record.as_slice().trim().is_empty() {
            return None;
        }
        if found != expected {
            self.fault(&format!("{found} cells"), &expected.to_string());
            return None;
        }
        self.decimal_commas = false;
        let before = self.faults;
        let [alpha, p] = ["alpha", "p"].map(|c| self.number(c, POSITIVE));
        let sides = ["width", "height", "depth"].map(|side| {
            let units = [("m", 1.0), ("cm", 1e2), ("mm", 1e3)].into_iter();
            let given = units.filter_map(|(unit, per)| {
                Some(self.number(&format!("{side}_{unit}"), POSITIVE)? / per)
            });
            given.collect::<Vec<f64>>()
        });
        let block = match (alpha, p, sides.each_ref().map(Vec::as_slice)) {
            (Some(a), Some(p), [[], [], []]) => Block::try_new(a, p).ok(),
            (None, None, [[w], [h], d @ ([] | [_])]) => {
                let width_m = d.first().unwrap_or(w).min(*w);
                Block::from_dimensions(width_m, *h, gravity_m_s2).ok()
            }
            _ => None,
        };
        if block.is_none() && self.faults == before && !self.lacks_length {
            self.fault("size", "width and height, or alpha below pi/2 and p");
        }
        let cells = BlockCells {
            eta: self.number("eta", ETA),
            friction: self.number("friction", POSITIVE),
            limit_ratio: self.number("limit_ratio", RATIO),
            floor: self.name("floor"),
        };
        let [x, y] = ["x_m", "y_m"].map(|column| self.number(column, ANY));
        if self.text("x_m").is_some() != self.text("y_m").is_some() {
            self.fault("x_m or y_m is empty", "both or neither");
        }
        let numbered: Id = format!("object_{}", self.line).parse().ok()?;
        let own = block.map(|own| Id::of(&own).unwrap_or(numbered.clone()));
        let [id, label] = ["id", "label"].map(|column| self.name(column));
        let label = label.or(id.clone()).or(own.map(|own| own.to_string()))?;
        let name = id.unwrap_or(label.clone());
        for (k, text) in [&label, &name].into_iter().enumerate() {
            if let Some(line) = self.names[k].insert(text.clone(), self.line) {
                let found = format!("{text} is already on line {line}");
                self.fault(&found, ["a unique label", "a unique id"][k]);
                break;
            }
        }
        let samples = self.text("sample").unwrap_or_default();
        let samples = samples.split(';').filter(|name| !name.is_empty());
        let samples = samples.map(|name| path.with_file_name(name.trim()));
        let notes = self.columns.iter().zip(&self.record);
        let notes = notes.filter(|(own, cell)| {
            BLOCKS.names().all(|n| n != **own) && !cell.trim().is_empty()
        });
        let notes = notes.map(|(own, cell)| (own.clone(), cell.trim().into()));
        Some(BlockRow {
            place: format!("{}:{}", self.place, self.line),
            label,
            depth_governs: !sides[2].is_empty() && sides[2] < sides[0],
            position_m: x.zip(y),
            samples: samples.collect(),
            cells,
            notes: notes.collect(),
            decimal_commas: self.decimal_commas,
            ..BlockRow::of(Id::of_label(&name).unwrap_or(numbered), block?)
        })
    }
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

#[cfg(test)]
mod tests;
