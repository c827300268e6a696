//! Reading the CSV of `rocking ida` back into response curves.

use std::path::{Path, PathBuf};

use rocking::capacity::{CapacityError, ResponseCurve};
use rocking::ida::Adjust;
use rocking::record::result_name;
use thiserror::Error;

use crate::cli::samples::Opened;
use rocking_common::table::columns::{IDA, SCHEMA_COLUMN};

use crate::cli::table::{SETTING, Setting};
use rocking_common::paper::Intensity;

/// Why an IDA file was refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum IdaFileError {
    /// The file could not be read as CSV.
    #[error("{}: {source}", path.display())]
    Csv {
        /// The file.
        path: PathBuf,
        /// What the reader said, with the line where there is one.
        #[source]
        source: csv::Error,
    },
    /// Not the columns of an IDA file.
    #[error(
        "{}:1: found columns `{found}`: expected `{}`",
        path.display(), IDA.names().collect::<Vec<_>>().join(",")
    )]
    Header {
        /// The file.
        path: PathBuf,
        /// The first line.
        found: String,
    },
    /// A field that is not what its column holds.
    #[error(
        "{}:{line}: found `{found}` in column {column}: expected {expected}",
        path.display()
    )]
    Field {
        /// The file.
        path: PathBuf,
        /// Line number from 1.
        line: u64,
        /// The column's name.
        column: &'static str,
        /// The field's text.
        found: String,
        /// What the column holds.
        expected: &'static str,
    },
    /// Rows of one record stand together.
    #[error(
        "{}:{line}: record {record} comes again: expected its rows together",
        path.display()
    )]
    Scattered {
        /// The file.
        path: PathBuf,
        /// Line number from 1.
        line: u64,
        /// The record.
        record: String,
    },
    /// A row of another analysis than the first.
    #[error(
        "{}:{line}: {column} is {found}: expected {expected}, as on the first row: a table of one analysis",
        path.display()
    )]
    Mixed {
        /// The file.
        path: PathBuf,
        /// Line number from 1.
        line: u64,
        /// The column's name.
        column: &'static str,
        /// The field's text.
        found: String,
        /// The first row's.
        expected: String,
    },
    /// The rows of a record make no curve.
    #[error("{}: record {record}: {source}", path.display())]
    Curve {
        /// The file.
        path: PathBuf,
        /// The record.
        record: String,
        /// What is wrong with it.
        #[source]
        source: CapacityError,
    },
    /// No row at all.
    #[error("{}: no analysis in the file", path.display())]
    Empty {
        /// The file.
        path: PathBuf,
    },
}

/// The response curves of a suite.
#[derive(Clone, Debug)]
pub struct Suite {
    /// Records and their curves, in the order of the file.
    pub curves: Vec<(String, ResponseCurve)>,
    /// IM_R: 1 for PGA, the lowest onset for PGV.
    pub im_r: f64,
    /// Rows past their record's first overturning, not used.
    pub after_overturning: usize,
    /// Slenderness angle (rad) and frequency parameter (rad/s) as written;
    /// the angle of an adjusted slenderness is none.
    pub block: (Option<String>, String),
    /// What all rows share.
    pub setting: Setting,
    /// Whether the measure is the square of the curves' intensity, so that
    /// the curves stay linear in the acceleration.
    pub squared: bool,
}

impl Suite {
    /// The curves, in the order of the table.
    #[must_use]
    pub fn into_curves(self) -> Vec<ResponseCurve> {
        self.curves.into_iter().map(|(_, curve)| curve).collect()
    }

    /// The curves against a measure whose values at intensity 1 are these:
    /// proportional to the intensity, or to its square.
    ///
    /// # Errors
    /// [`CapacityError::Factor`] for a value that is not positive.
    pub fn against(
        mut self,
        at_one: &[f64],
        squared: bool,
    ) -> Result<Self, CapacityError> {
        for ((_, curve), &factor) in self.curves.iter_mut().zip(at_one) {
            let factor = if squared { factor.sqrt() } else { factor };
            *curve = curve.scaled(factor)?;
        }
        let onsets = self.curves.iter().map(|(_, curve)| curve.onset_im());
        self.im_r = onsets.fold(f64::INFINITY, f64::min);
        self.squared = squared;
        Ok(self)
    }

    /// The measure at an intensity of the curves.
    #[must_use]
    pub fn told(&self, im: f64) -> f64 {
        if self.squared { im * im } else { im }
    }
}

/// One row.
struct Row {
    record: String,
    line: u64,
    im: f64,
    edp: f64,
    refined: bool,
}

/// Reads an IDA file against an intensity measure.
///
/// # Errors
/// [`IdaFileError`] with file and line.
pub fn read(path: &Path, measure: Intensity) -> Result<Suite, IdaFileError> {
    let (rows, common) = rows(path, measure)?;
    let Some(Common { alpha_rad, p_rad_s, setting }) = common else {
        return Err(IdaFileError::Empty { path: path.to_owned() });
    };
    let mut suite = Suite {
        curves: Vec::new(),
        im_r: 1.0,
        after_overturning: 0,
        block: (alpha_rad, p_rad_s),
        setting,
        squared: false,
    };
    for group in rows.chunk_by(|a, b| a.record == b.record) {
        let record = &group[0].record;
        if suite.curves.iter().any(|(known, _)| known == record) {
            return Err(IdaFileError::Scattered {
                path: path.to_owned(),
                line: group[0].line,
                record: record.clone(),
            });
        }
        let (curve, unused) = curve(group).map_err(|source| {
            let (path, record) = (path.to_owned(), record.clone());
            IdaFileError::Curve { path, record, source }
        })?;
        suite.after_overturning += unused;
        suite.curves.push((record.clone(), curve));
    }
    let onsets = suite.curves.iter().map(|(_, curve)| curve.onset_im());
    let least = onsets.fold(f64::INFINITY, f64::min);
    if measure == Intensity::Pgv {
        suite.im_r = least;
    }
    Ok(suite)
}

/// The curve of one record's rows, and the number of rows not used.
///
/// First overturning is the refined end of its bracket if there is one, else
/// the first overturned row of the scan.
fn curve(rows: &[Row]) -> Result<(ResponseCurve, usize), CapacityError> {
    let end = rows.iter().position(|row| row.edp == f64::INFINITY);
    let standing = &rows[..end.unwrap_or(rows.len())];
    let vertices: Vec<(f64, f64)> =
        standing.iter().map(|row| (row.im, row.edp)).collect();
    let refined = rows.iter().find(|row| row.refined);
    let overturned = refined.or(end.map(|i| &rows[i]));
    let unused = end.map_or(0, |i| {
        rows[i + 1..].iter().filter(|row| !row.refined).count()
    });
    let overturning = overturned.map(|row| row.im);
    Ok((ResponseCurve::try_new(&vertices, overturning)?, unused))
}

/// What the rows of one analysis have in common, as it is written.
struct Common {
    alpha_rad: Option<String>,
    p_rad_s: String,
    setting: Setting,
}

impl Common {
    fn of(fields: &csv::StringRecord) -> Self {
        let cell = |column: usize| fields[column].to_owned();
        let setting = Setting::of(cell);
        let scaled = setting.by.parse() == Ok(Adjust::RecordScaling);
        let alpha_rad = scaled.then(|| cell(1));
        Self { alpha_rad, p_rad_s: cell(2), setting }
    }

    /// The first column of `fields` that has something else.
    fn differs(&self, fields: &csv::StringRecord) -> Option<(usize, &str)> {
        let alpha = self.alpha_rad.iter().map(|a| (1, a.as_str()));
        let p = std::iter::once((2, self.p_rad_s.as_str()));
        let setting = self.setting.cells().into_iter().enumerate();
        let setting = setting.map(|(i, cell)| (SETTING + i, cell));
        let mut all = alpha.chain(p).chain(setting);
        all.find(|(column, cell)| fields[*column] != **cell)
    }
}

type Rows = (Vec<Row>, Option<Common>);

fn rows(path: &Path, measure: Intensity) -> Result<Rows, IdaFileError> {
    let csv_error =
        |source| IdaFileError::Csv { path: path.to_owned(), source };
    let opened = Opened::open(path).map_err(|e| csv_error(e.into()))?;
    let mut reader = csv::Reader::from_reader(opened);
    let header = reader.headers().map_err(csv_error)?;
    if !IDA.has(header) {
        return Err(IdaFileError::Header {
            path: path.to_owned(),
            found: header.iter().collect::<Vec<_>>().join(","),
        });
    }
    let im_column = match measure {
        Intensity::Pga => 5,
        Intensity::Pgv => 6,
    };
    let mut rows = Vec::new();
    let mut common: Option<Common> = None;
    for record in reader.records() {
        let fields = record.map_err(csv_error)?;
        let line = fields.position().map_or(0, csv::Position::line);
        let refuse = |column: usize, expected| IdaFileError::Field {
            path: path.to_owned(),
            line,
            column: IDA.columns[column].name,
            found: fields[column].to_owned(),
            expected,
        };
        let schema = IDA.columns.len();
        if !IDA.is_current(fields.get(schema)) {
            return Err(IdaFileError::Field {
                path: path.to_owned(),
                line,
                column: SCHEMA_COLUMN,
                found: fields[schema].to_owned(),
                expected: "1, the schema of this program",
            });
        }
        let first = common.get_or_insert_with(|| Common::of(&fields));
        if let Some((column, expected)) = first.differs(&fields) {
            return Err(IdaFileError::Mixed {
                path: path.to_owned(),
                line,
                column: IDA.columns[column].name,
                found: fields[column].to_owned(),
                expected: expected.to_owned(),
            });
        }
        let number = |column: usize, expected: &'static str| {
            let value = fields[column].parse::<f64>().ok();
            value.filter(|x| *x >= 0.0).ok_or_else(|| refuse(column, expected))
        };
        let outcomes = "no-uplift, rocked, overturned, overturned-refined \
                        or unresolved";
        let outcome = &fields[8];
        let known = [
            "no-uplift",
            "rocked",
            "overturned",
            "overturned-refined",
            "unresolved",
        ];
        if !known.contains(&outcome) {
            return Err(refuse(8, outcomes));
        }
        let edp = number(7, "a number, not negative, or inf")?;
        if outcome.starts_with("overturned") != edp.is_infinite()
            && outcome != "unresolved"
        {
            return Err(refuse(7, "inf where overturned, and only there"));
        }
        let name = result_name(&fields[0]);
        let name = name.map_err(|_| refuse(0, "a name of a record"))?;
        rows.push(Row {
            record: name.to_owned(),
            line,
            im: number(im_column, "a positive number")?,
            edp,
            refined: outcome == "overturned-refined",
        });
    }
    Ok((rows, common))
}
