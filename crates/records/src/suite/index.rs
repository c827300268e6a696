//! The index of a suite: a CSV file with a header, columns by name.

use std::rc::Rc;
use std::sync::Arc;

use super::cells::split;
use super::{PEAK_TOLERANCE, SuiteError, SuiteMember};
use crate::read::settle_one;
use crate::record::{Agreement, Fallback, ReadOptions, Record, sha256_hex};
use crate::text::{self, excerpt};
use rocking::accelerogram::EXPECTED;
use rocking::accelerogram::result_name;
use rocking::units::AccelerationUnit;

/// A parsed index: every row has every column.
pub(super) struct Index {
    columns: Rc<[Arc<str>]>,
    rows: Vec<IndexRow>,
    paired: bool,
}

/// One row of an index.
pub(super) struct IndexRow {
    path: Rc<str>,
    line: usize,
    file: String,
    /// PEER's number stands for a column `pair`.
    pair: Option<String>,
    columns: Rc<[Arc<str>]>,
    cells: Vec<String>,
}

/// Characters of a column's name, at most: every record carries the names.
const LONGEST_NAME: usize = 64;

/// Records of an index, at most: four times the largest database of its
/// kind.
const MOST_ROWS: usize = 100_000;

/// Columns that mean something; others are attributes.
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
#[must_use]
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

/// What separates the cells under a head.
fn separator(head: &str) -> char {
    let semicolons = head.contains(';') && !head.contains(',');
    if semicolons { ';' } else { ',' }
}

impl Index {
    /// Parses an index, or PEER's search results.
    pub(super) fn parse(path: &str, bytes: &[u8]) -> Result<Self, SuiteError> {
        let content = text::decode(path, bytes)?;
        let lines: Vec<&str> = content.lines().collect();
        let peer = lines.iter().position(|line| is_peer(line));
        let head = peer.unwrap_or(0);
        let mut table = IndexTable {
            path: path.into(),
            columns: Rc::from([]),
            separator: separator(lines.get(head).copied().unwrap_or("")),
            lines: &lines,
        };
        let head_cells = table.head(head)?;
        table.columns = head_cells.into_iter().map(Arc::from).collect();
        let left = lines.len().saturating_sub(head + 1);
        let mut rows = Vec::with_capacity(left.min(MOST_ROWS));
        for (line, text) in lines.iter().enumerate().skip(head + 1) {
            let blank = text.trim_matches([',', ';', ' ', '\t']).is_empty();
            if blank && peer.is_some() {
                break;
            }
            if rows.len() >= MOST_ROWS {
                let expected = format!("at most {MOST_ROWS} records");
                return Err(table.refuse(line, text, &expected));
            }
            if !blank {
                let cells = table.cells(line)?;
                match peer {
                    None => rows.push(table.plain_row(line, cells)?),
                    Some(_) => rows.extend(table.peer_rows(line, &cells)?),
                }
            }
        }
        let paired = peer.is_some() || table.place("pair").is_some();
        Ok(Self { columns: table.columns, rows, paired })
    }

    /// Rows in the index's order.
    pub(super) fn into_rows(self) -> Vec<IndexRow> {
        self.rows
    }

    /// Whether rows name their pair.
    pub(super) fn is_paired(&self) -> bool {
        self.paired
    }

    /// Whether there is a column `name`.
    pub(super) fn has(&self, name: &str) -> bool {
        self.columns.iter().any(|column| **column == *name)
    }
}

/// The refusal of a line, counted from 1.
fn refusal(
    path: &str,
    line: usize,
    found: &str,
    expected: &str,
) -> SuiteError {
    let (found, expected) = (excerpt(found), expected.to_owned());
    SuiteError::Index { path: path.to_owned(), line, found, expected }
}

/// Lines under a head of column names.
struct IndexTable<'a> {
    path: Rc<str>,
    columns: Rc<[Arc<str>]>,
    separator: char,
    lines: &'a [&'a str],
}

impl IndexTable<'_> {
    fn refuse(&self, line: usize, found: &str, expected: &str) -> SuiteError {
        refusal(&self.path, line + 1, found, expected)
    }

    fn head(&self, line: usize) -> Result<Vec<String>, SuiteError> {
        let text = self.lines.get(line).copied().unwrap_or("");
        let known = |name: &String| is_file(name) || name == PEER_FIRST;
        let mut columns = split(text, self.separator)
            .filter(|columns| columns.iter().any(known))
            .ok_or_else(|| {
                let expected =
                    "a folder, or an index: a CSV file with a column `file`";
                self.refuse(line, text, expected)
            })?;
        for column in &mut columns {
            if COLUMNS.iter().any(|name| column.eq_ignore_ascii_case(name)) {
                column.make_ascii_lowercase();
            }
        }
        self.check_names(line, &columns)?;
        if let Some(long) = columns.iter().find(|c| c.len() > LONGEST_NAME) {
            let expected = format!("names of at most {LONGEST_NAME} bytes");
            return Err(self.refuse(line, long, &expected));
        }
        let mut sorted: Vec<&String> =
            columns.iter().filter(|name| !name.is_empty()).collect();
        sorted.sort_unstable();
        match sorted.windows(2).find(|w| w[0] == w[1]) {
            Some(twice) => {
                Err(self.refuse(line, twice[0], "each column once"))
            }
            None => Ok(columns),
        }
    }

    /// Refuses cells that results cannot carry: all of them become names of
    /// files, of records and of attributes, and what these are.
    fn check_names(
        &self,
        line: usize,
        cells: &[String],
    ) -> Result<(), SuiteError> {
        match cells.iter().find(|cell| result_name(cell).is_err()) {
            Some(cell) => Err(self.refuse(line, cell, EXPECTED)),
            None => Ok(()),
        }
    }

    /// Place of the column `name`.
    fn place(&self, name: &str) -> Option<usize> {
        self.columns.iter().position(|column| **column == *name)
    }

    fn cells(&self, line: usize) -> Result<Vec<String>, SuiteError> {
        let text = self.lines[line];
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

    fn plain_row(
        &self,
        line: usize,
        cells: Vec<String>,
    ) -> Result<IndexRow, SuiteError> {
        let file = self.place("file").map_or("", |place| &cells[place]);
        self.row(line, file.to_owned(), None, cells)
    }

    fn row(
        &self,
        line: usize,
        file: String,
        pair: Option<String>,
        cells: Vec<String>,
    ) -> Result<IndexRow, SuiteError> {
        if file.is_empty() {
            return Err(self.refuse(line, &file, "the name of a file"));
        }
        let (path, columns) = (self.path.clone(), self.columns.clone());
        Ok(IndexRow { path, line: line + 1, file, pair, columns, cells })
    }

    /// The two horizontal components of a row of PEER's search results.
    fn peer_rows(
        &self,
        line: usize,
        cells: &[String],
    ) -> Result<Vec<IndexRow>, SuiteError> {
        let cell = |name| self.place(name).map_or("", |i| cells[i].as_str());
        let files = [cell(PEER_FIRST), cell(PEER_SECOND)];
        let there = |file: &&str| !file.trim_matches(['-', ' ']).is_empty();
        let pair = format!("RSN{}", cell(PEER_NUMBER));
        let row = |file: &str| {
            self.row(line, file.to_owned(), Some(pair.clone()), cells.to_vec())
        };
        files.into_iter().filter(there).map(row).collect()
    }
}

impl IndexRow {
    /// The file, relative to the index.
    pub(super) fn file(&self) -> &str {
        &self.file
    }

    /// A cell that is there and not empty.
    fn cell(&self, name: &str) -> Option<&str> {
        let place =
            self.columns.iter().position(|column| **column == *name)?;
        Some(self.cells[place].as_str()).filter(|cell| !cell.is_empty())
    }

    /// The earthquake, which the index states for all records or for none.
    fn event(&self) -> Result<Option<String>, SuiteError> {
        let stated = |name: &str| self.columns.iter().any(|c| **c == *name);
        match ["event", PEER_EVENT].into_iter().find(|name| stated(name)) {
            None => Ok(None),
            Some(name) => match self.cell(name) {
                Some(event) => Ok(Some(event.to_owned())),
                None => Err(self.refuse("", "the earthquake of each record")),
            },
        }
    }

    fn refuse(&self, found: &str, expected: &str) -> SuiteError {
        refusal(&self.path, self.line, found, expected)
    }

    fn mismatch(
        &self,
        quantity: &'static str,
        found: String,
        expected: &str,
    ) -> SuiteError {
        SuiteError::Mismatch {
            path: self.path.to_string(),
            line: self.line,
            file: self.file.clone(),
            quantity,
            found,
            expected: expected.to_owned(),
        }
    }

    fn positive(&self, name: &'static str) -> Result<Option<f64>, SuiteError> {
        let Some(cell) = self.cell(name) else { return Ok(None) };
        match cell.parse::<f64>() {
            Ok(x) if x > 0.0 && x.is_finite() => Ok(Some(x)),
            _ => Err(self.refuse(cell, &format!("a positive {name}"))),
        }
    }

    /// Reads the row's record from `content` and checks what the row says
    /// about it. `see` settles what only the caller states.
    pub(super) fn member(
        &self,
        content: &[u8],
        options: &ReadOptions,
        see: impl FnOnce(Agreement) -> Record,
    ) -> Result<SuiteMember, SuiteError> {
        self.check_sum(content)?;
        let unit = match self.cell("units") {
            None => options.unit,
            Some(cell) => Some(
                AccelerationUnit::parse(cell)
                    .ok_or_else(|| self.refuse(cell, "g, m/s2 or cm/s2"))?,
            ),
        };
        let dt_s = self.positive("dt_s")?;
        let stated = Fallback {
            dt: dt_s.is_some(),
            unit: self.cell("units").is_some(),
        };
        let dt_s = dt_s.or(options.dt_s);
        let read_options = ReadOptions { dt_s, unit, ..*options };
        let mut settled = settle_one(&self.file, content, &read_options)?;
        // The row describes only this file.
        if stated.dt {
            settled.dt?;
            (settled.dt, settled.record.given.dt) = (Ok(()), false);
        }
        if stated.unit {
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
        let named = self.columns.iter().zip(&self.cells);
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
        let (pair, event) = (pair.map(str::to_owned), self.event()?);
        let line = Some(self.line);
        Ok(SuiteMember {
            pair,
            study_component,
            event,
            line,
            attributes,
            ..member
        })
    }

    fn check_sum(&self, content: &[u8]) -> Result<(), SuiteError> {
        let Some(expected) = self.cell("sha256") else { return Ok(()) };
        let found = sha256_hex(content);
        if found.eq_ignore_ascii_case(expected) {
            return Ok(());
        }
        Err(self.mismatch("sha256", found, expected))
    }

    fn check(
        &self,
        record: &Record,
        gravity_m_s2: f64,
    ) -> Result<(), SuiteError> {
        let motion = &record.accelerogram;
        if let Some(cell) = self.cell("format") {
            let found = record.format.name;
            if found != cell {
                return Err(self.mismatch("format", found.to_owned(), cell));
            }
        }
        if let Some(cell) = self.cell("npts") {
            let found = motion.samples_g().len();
            let expected: usize = cell
                .parse()
                .map_err(|_| self.refuse(cell, "a number of samples"))?;
            if found != expected {
                return Err(self.mismatch("npts", found.to_string(), cell));
            }
        }
        let peaks = [
            ("pga_g", motion.pga_g()),
            ("pgv_m_s", motion.pgv_m_s(gravity_m_s2)),
        ];
        for (name, found) in peaks {
            let Some(expected) = self.positive(name)? else { continue };
            if !((found - expected).abs() <= PEAK_TOLERANCE * expected) {
                let found = format!("{found:.6}");
                return Err(self.mismatch(name, found, &expected.to_string()));
            }
        }
        Ok(())
    }
}
