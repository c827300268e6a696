//! The index of a suite: a CSV file with a header, columns by name.

use std::sync::Arc;

use super::cells::split;
use super::error::Result;
use super::{PEAK_TOLERANCE, StudyRule, SuiteError, SuiteMember};
use crate::read::settle_one;
use crate::record::{Agreement, ReadOptions, Record, sha256_hex};
use crate::text::{self, excerpt};
use rocking::accelerogram::{EXPECTED, result_name};
use rocking::units::AccelerationUnit;

/// A parsed index: every row has every column.
pub(super) struct Index {
    /// In the index's order.
    pub(super) rows: Vec<IndexRow>,
    /// Whether rows name their pair.
    pub(super) paired: bool,
    /// Who chooses the study components.
    pub(super) study_rule: StudyRule,
}

/// One row of an index.
pub(super) struct IndexRow {
    head: Arc<IndexHead>,
    /// Counted from 1.
    line: usize,
    /// Relative to the index.
    pub(super) file: String,
    /// Pair by PEER's number, instead of a column `pair`.
    pair: Option<String>,
    cells: Vec<String>,
}

/// The most bytes in the name of a column: every record has a copy.
const LONGEST_NAME: usize = 64;

/// The most records in an index: four times the largest database of its kind.
const MOST_ROWS: usize = 100_000;

/// Columns with a meaning; others are attributes.
const COLUMNS: [&str; 12] = [
    "file",
    "name",
    "format",
    "units",
    "dt_s",
    "npts",
    "pga_g",
    "pgv_m_s",
    "sha256",
    "pair",
    "study_component",
    "event",
];

/// Column of PEER's search results that names the first component.
const PEER_FIRST: &str = "Horizontal-1 Acc. Filename";
const PEER_SECOND: &str = "Horizontal-2 Acc. Filename";
const PEER_NUMBER: &str = "Record Sequence Number";
const PEER_EVENT: &str = "Earthquake Name";

/// Whether the content is an index: its first line has a column `file`, or any
/// line is the head of PEER's list of records.
pub fn is_index(bytes: &[u8]) -> bool {
    let Ok(content) = text::decode("", bytes) else { return false };
    let mut lines = content.split(['\n', '\r']);
    let plain = lines
        .next()
        .and_then(|line| split(line, separator(line)))
        .is_some_and(|cells| cells.iter().any(|cell| is_file(cell)));
    plain || lines.any(is_peer)
}

/// Whether a line is the head of PEER's list of records.
fn is_peer(line: &str) -> bool {
    line.contains(PEER_FIRST) && line.contains(PEER_NUMBER)
}

fn is_file(cell: &str) -> bool {
    cell.eq_ignore_ascii_case("file")
}

/// Separator of the cells under a head.
fn separator(head: &str) -> char {
    let semicolons = head.contains(';') && !head.contains(',');
    if semicolons { ';' } else { ',' }
}

impl Index {
    /// Parses an index, or PEER's search results.
    pub(super) fn parse(path: &str, bytes: &[u8]) -> Result<Self> {
        let content = text::decode(path, bytes)?;
        let lines: Vec<&str> = content.lines().collect();
        let peer = lines.iter().position(|line| is_peer(line));
        let at = peer.unwrap_or(0);
        let first = lines.get(at).copied().unwrap_or("");
        let head = Arc::new(IndexHead::parse(path, at + 1, first)?);
        let left = lines.len().saturating_sub(at + 1);
        let mut rows = Vec::with_capacity(left.min(MOST_ROWS));
        for (text, line) in lines.iter().zip(1..).skip(at + 1) {
            let blank = text.trim_matches([',', ';', ' ', '\t']).is_empty();
            if blank && peer.is_some() {
                break;
            }
            if rows.len() >= MOST_ROWS {
                let expected = format!("at most {MOST_ROWS} records");
                return Err(head.refuse(line, text, &expected));
            }
            if !blank {
                let cells = head.cells(line, text)?;
                match peer {
                    None => rows.push(head.row(line, "file", None, cells)?),
                    Some(_) => rows.extend(head.peer_rows(line, &cells)?),
                }
            }
        }
        let paired = peer.is_some() || head.place("pair").is_some();
        let study_rule = match head.place("study_component") {
            Some(_) => StudyRule::Index,
            None => StudyRule::FirstName,
        };
        Ok(Self { rows, paired, study_rule })
    }
}

/// Common parts of the rows of an index.
struct IndexHead {
    path: String,
    columns: Vec<Arc<str>>,
    separator: char,
}

impl IndexHead {
    /// The columns that `text` names, line `line` of the index.
    fn parse(path: &str, line: usize, text: &str) -> Result<Self> {
        let mut head = Self {
            path: path.to_owned(),
            columns: Vec::new(),
            separator: separator(text),
        };
        let known = |name: &String| is_file(name) || name == PEER_FIRST;
        let mut columns = split(text, head.separator)
            .filter(|columns| columns.iter().any(known))
            .ok_or_else(|| {
                let expected =
                    "a folder, or an index: a CSV file with a column `file`";
                head.refuse(line, text, expected)
            })?;
        for column in &mut columns {
            if COLUMNS.iter().any(|name| column.eq_ignore_ascii_case(name)) {
                column.make_ascii_lowercase();
            }
        }
        head.check_names(line, &columns)?;
        if let Some(long) = columns.iter().find(|c| c.len() > LONGEST_NAME) {
            let expected = format!("names of at most {LONGEST_NAME} bytes");
            return Err(head.refuse(line, long, &expected));
        }
        let mut sorted: Vec<&String> =
            columns.iter().filter(|name| !name.is_empty()).collect();
        sorted.sort_unstable();
        if let Some(twice) = sorted.windows(2).find(|w| w[0] == w[1]) {
            return Err(head.refuse(line, twice[0], "each column once"));
        }
        head.columns = columns.into_iter().map(Arc::from).collect();
        Ok(head)
    }

    /// The refusal of a line, counted from 1.
    fn refuse(&self, line: usize, found: &str, expected: &str) -> SuiteError {
        let (found, expected) = (excerpt(found), expected.to_owned());
        SuiteError::Index { path: self.path.clone(), line, found, expected }
    }

    /// Refuses cells that results cannot contain: all of them become names of
    /// files, records or attributes, or values of attributes.
    fn check_names(&self, line: usize, cells: &[String]) -> Result<()> {
        match cells.iter().find(|cell| result_name(cell).is_err()) {
            Some(cell) => Err(self.refuse(line, cell, EXPECTED)),
            None => Ok(()),
        }
    }

    /// Place of the column `name`.
    fn place(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| **column == *name)
    }

    fn cells(&self, line: usize, text: &str) -> Result<Vec<String>> {
        let mut cells = split(text, self.separator).ok_or_else(|| {
            let expected = format!(
                "cells separated by {:?}, quotes closed",
                self.separator
            );
            self.refuse(line, text, &expected)
        })?;
        // Some programs end a line with separators.
        while cells.len() > self.columns.len()
            && cells.last().is_some_and(String::is_empty)
        {
            cells.pop();
        }
        self.check_names(line, &cells)?;
        if cells.len() != self.columns.len() {
            let expected =
                format!("{} cells, as the head", self.columns.len());
            let found = format!("{} cells", cells.len());
            return Err(self.refuse(line, &found, &expected));
        }
        Ok(cells)
    }

    /// A row; its column `name` has the file. Windows writes `\` between folders,
    /// and reads `/` as well.
    fn row(
        self: &Arc<Self>,
        line: usize,
        name: &str,
        pair: Option<String>,
        cells: Vec<String>,
    ) -> Result<IndexRow> {
        let file = self.place(name).map_or("", |place| &cells[place]);
        if file.is_empty() {
            return Err(self.refuse(line, file, "the name of a file"));
        }
        let (head, file) = (Arc::clone(self), file.replace('\\', "/"));
        Ok(IndexRow { head, line, file, pair, cells })
    }

    /// The two horizontal components of a row of PEER's search results.
    fn peer_rows(
        self: &Arc<Self>,
        line: usize,
        cells: &[String],
    ) -> Result<Vec<IndexRow>> {
        let cell = |name: &str| self.place(name).map_or("", |i| &cells[i]);
        let there =
            |name: &&str| !cell(name).trim_matches(['-', ' ']).is_empty();
        let pair = format!("RSN{}", cell(PEER_NUMBER));
        let row =
            |name| self.row(line, name, Some(pair.clone()), cells.to_vec());
        [PEER_FIRST, PEER_SECOND].into_iter().filter(there).map(row).collect()
    }
}

impl IndexRow {
    /// A cell that exists and is not empty.
    fn cell(&self, name: &str) -> Option<&str> {
        let cell = self.cells[self.head.place(name)?].as_str();
        Some(cell).filter(|cell| !cell.is_empty())
    }

    /// The earthquake, which an index states for all records or for none.
    fn event(&self) -> Result<Option<String>> {
        let stated = |name: &&str| self.head.place(name).is_some();
        let name = ["event", PEER_EVENT].into_iter().find(stated);
        let Some(name) = name else { return Ok(None) };
        let event = self.cell(name).map(|event| Some(event.to_owned()));
        event.ok_or_else(|| self.refuse("", "the earthquake of each record"))
    }

    fn refuse(&self, found: &str, expected: &str) -> SuiteError {
        self.head.refuse(self.line, found, expected)
    }

    fn mismatch<T>(
        &self,
        quantity: &'static str,
        found: impl ToString,
        expected: impl ToString,
    ) -> Result<T> {
        let (path, file) = (self.head.path.clone(), self.file.clone());
        let (found, expected) = (found.to_string(), expected.to_string());
        let line = self.line;
        Err(SuiteError::Mismatch {
            path,
            line,
            file,
            quantity,
            found,
            expected,
        })
    }

    fn positive(&self, name: &'static str) -> Result<Option<f64>> {
        let Some(cell) = self.cell(name) else { return Ok(None) };
        match cell.parse::<f64>() {
            Ok(x) if x > 0.0 && x.is_finite() => Ok(Some(x)),
            _ => Err(self.refuse(cell, &format!("a positive {name}"))),
        }
    }

    /// Reads the record of the row from `content` and checks it against the
    /// row. `see` settles the values that only the caller states.
    pub(super) fn member(
        &self,
        content: &[u8],
        options: &ReadOptions,
        see: impl FnOnce(Agreement) -> Record,
    ) -> Result<SuiteMember> {
        if let Some(expected) = self.cell("sha256") {
            let found = sha256_hex(content);
            if !found.eq_ignore_ascii_case(expected) {
                return self.mismatch("sha256", found, expected);
            }
        }
        let unit = |cell| {
            let refuse = || self.refuse(cell, "g, m/s2 or cm/s2");
            AccelerationUnit::parse(cell).ok_or_else(refuse)
        };
        let unit = self.cell("units").map(unit).transpose()?;
        let dt_s = self.positive("dt_s")?;
        let given = ReadOptions {
            dt_s: dt_s.or(options.dt_s),
            unit: unit.or(options.unit),
            ..*options
        };
        let mut settled = settle_one(&self.file, content, &given)?;
        // The row describes only this file.
        if dt_s.is_some() {
            settled.dt?;
            (settled.dt, settled.record.given.dt) = (Ok(()), false);
        }
        if unit.is_some() {
            settled.unit?;
            (settled.unit, settled.record.given.unit) = (Ok(()), false);
        }
        let record = see(settled);
        self.check(&record, options.gravity_m_s2)?;
        let study_component = match self.cell("study_component") {
            None | Some("0" | "false") => false,
            Some("1" | "true") => true,
            Some(cell) => return Err(self.refuse(cell, "1 or 0")),
        };
        let named = self.head.columns.iter().zip(&self.cells);
        let attributes = named
            .filter(|(name, _)| !COLUMNS.contains(&&***name))
            .map(|(name, cell)| (Arc::clone(name), cell.clone()))
            .collect();
        let mut member = SuiteMember::of(record, self.file.clone());
        if let Some(name) = self.cell("name") {
            let named = member.accelerogram.named(name);
            member.accelerogram =
                named.map_err(|_| self.refuse(name, EXPECTED))?;
        }
        let pair = self.pair.as_deref().or_else(|| self.cell("pair"));
        member.pair = pair.map(str::to_owned);
        member.study_component = study_component;
        member.event = self.event()?;
        member.line = Some(self.line);
        member.attributes = attributes;
        Ok(member)
    }

    fn check(&self, record: &Record, gravity_m_s2: f64) -> Result<()> {
        let motion = &record.accelerogram;
        if let Some(cell) = self.cell("format") {
            let found = record.format.name;
            if found != cell {
                return self.mismatch("format", found, cell);
            }
        }
        if let Some(cell) = self.cell("npts") {
            let found = motion.samples_g().len();
            let expected: usize = cell
                .parse()
                .map_err(|_| self.refuse(cell, "a number of samples"))?;
            if found != expected {
                return self.mismatch("npts", found, cell);
            }
        }
        let peaks = [
            ("pga_g", motion.pga_g()),
            ("pgv_m_s", motion.pgv_m_s(gravity_m_s2)),
        ];
        for (name, found) in peaks {
            let Some(expected) = self.positive(name)? else { continue };
            if !((found - expected).abs() <= PEAK_TOLERANCE * expected) {
                return self.mismatch(name, format!("{found:.6}"), expected);
            }
        }
        Ok(())
    }
}
