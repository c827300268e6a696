//! Files that commands read; `-` is standard input.

use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

use rocking_exchange::ida::{Curves, IdaTable};
use rocking_exchange::sample::SampleFile;
use rocking_records::intensity::Intensity;

use crate::failure::{AtPlace as _, Failure};
use crate::terminal::note;
use rocking_common::suites::inputs::sha256_hex;

fn opened(path: &Path) -> io::Result<Box<dyn Read>> {
    if path == Path::new("-") {
        return Ok(Box::new(io::stdin()));
    }
    let found = fs::metadata(path)?;
    let given = path.starts_with("/dev/fd") || path.starts_with("/proc");
    if !(found.is_file() || given) {
        return Err(io::Error::other(
            "not a file: expected one, or - for standard input",
        ));
    }
    Ok(Box::new(File::open(path)?))
}

/// Opens a file.
///
/// # Errors
/// [`Failure`] if it cannot be opened, and for a device that may never end.
pub fn open(path: &Path) -> Result<Box<dyn Read>, Failure> {
    opened(path).at(format_args!("cannot read {}", path.display()))
}

/// The text of a file.
///
/// # Errors
/// [`Failure`] if it cannot be read.
pub fn text(path: &Path) -> Result<String, Failure> {
    let read = opened(path).and_then(io::read_to_string);
    read.at(format_args!("cannot read {}", path.display()))
}

/// Name and SHA-256 of a file that was read.
///
/// # Errors
/// As [`text`].
pub fn named(path: &Path) -> Result<String, Failure> {
    let name = path.file_name().unwrap_or(path.as_os_str());
    let mut bytes = Vec::new();
    let read = opened(path).and_then(|mut file| file.read_to_end(&mut bytes));
    read.at(format_args!("cannot read {}", path.display()))?;
    let sha256 = sha256_hex(&bytes);
    Ok(format!("{}, SHA-256 {sha256}", name.to_string_lossy()))
}

/// A sample file.
///
/// # Errors
/// [`Failure`] with file and line.
pub fn sample(path: &Path) -> Result<SampleFile, Failure> {
    Ok(SampleFile::parse(&text(path)?, path)?)
}

/// Notes that a procedure takes records as independent, if earthquakes of the
/// file have several.
pub fn records_as_unit(file: &SampleFile) {
    let clusters = file.clusters();
    if !clusters.is_singletons() {
        note(&format!(
            "records as the unit: {} of {} earthquakes are taken as \
             independent",
            clusters.records(),
            clusters.count()
        ));
    }
}

/// A table of `rocking ida`, and its curves against an intensity measure.
///
/// # Errors
/// [`Failure`] with file and line.
pub fn ida(
    path: &Path,
    measure: Intensity,
) -> Result<(IdaTable, Curves), Failure> {
    let table = IdaTable::read(open(path)?, path)?;
    let curves = table.curves(measure);
    let curves = curves.map_err(|(record, error)| {
        let place = path.display();
        Failure::input(format!("{place}: record {record}: {error}"))
    })?;
    Ok((table, curves))
}
