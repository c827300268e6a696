//! Tiles put together: as CSV, and as Parquet where the program has it.

use std::cell::RefCell;
use std::io;
use std::path::Path;

use super::content::Content;
use super::plan::Planned;
use super::tile;
use crate::failure::Failure;
use rocking_common::files::Outputs;

/// Puts the tiles together in the plan's order, one after the other: as
/// Parquet where the name of `out` ends so, else as CSV. The bytes are the
/// same for any number of tasks.
///
/// # Errors
/// [`Failure`] for a tile that is missing, of another plan, or
/// damaged; and for Parquet where the program was built without it.
/// `out` is then as it was.
pub fn merge(
    planned: &Planned,
    content: Content,
    out: &Path,
) -> Result<(), Failure> {
    let parquet = out.extension().is_some_and(|e| e == "parquet");
    if parquet && !cfg!(feature = "parquet") {
        return Err(Failure::input(format!(
            "{}: this program writes no Parquet; expected another ending for \
             CSV, or a program built by `cargo install --path validation \
             --features parquet`",
            out.display()
        )));
    }
    let output = Outputs::of(planned.files()).open(out)?;
    let refused = RefCell::new(None);
    let written = output.write_with(&|file| {
        let body = &|tile| {
            tile::body(planned, content, tile).map_err(|failure| {
                *refused.borrow_mut() = Some(failure);
                io::Error::other("a tile is not done")
            })
        };
        match parquet {
            true => as_parquet(planned, content, body, file),
            false => as_csv(planned, body, file),
        }
    });
    match refused.into_inner() {
        Some(failure) => Err(failure),
        None => Ok(written?),
    }
}

/// Gives the text of a tile.
type Bodies<'a> = &'a dyn Fn(usize) -> io::Result<String>;

fn as_csv(
    planned: &Planned,
    body: Bodies<'_>,
    file: &mut dyn io::Write,
) -> io::Result<()> {
    for tile in 0..planned.plan.tiles.len() {
        let body = body(tile)?;
        // The header stands once.
        let rows = match tile {
            0 => body.as_str(),
            _ => body.split_once('\n').map_or("", |(_, rows)| rows),
        };
        file.write_all(rows.as_bytes())?;
    }
    Ok(())
}

/// Rows of a group of a Parquet file: 2^20 of them take about 100 MB.
#[cfg(feature = "parquet")]
const GROUP_ROWS: usize = 1 << 20;

#[cfg(feature = "parquet")]
fn as_parquet(
    planned: &Planned,
    content: Content,
    body: Bodies<'_>,
    file: &mut (dyn io::Write + Send),
) -> io::Result<()> {
    use rocking_parquet::{Kind, Table, Writer};

    let plan = &planned.plan;
    let columns = content.columns(plan);
    let columns: Vec<(&str, Kind)> = columns
        .iter()
        .map(|(name, cells)| {
            let kind = match *cells {
                "level" => Kind::Level,
                "count" => Kind::Count,
                "flag" => Kind::Flag,
                "text" => Kind::Text,
                _ => Kind::Value,
            };
            (name.as_str(), kind)
        })
        .collect();
    let settings = plan.settings();
    let notes = [
        ("rocking.table", content.name()),
        ("rocking.plan_sha256", &planned.hash),
        ("rocking.software", &plan.software),
        ("rocking.settings", &settings),
    ];
    let table =
        Table { columns: &columns, notes: &notes, group_rows: GROUP_ROWS };
    let by = plan.software.replacen(' ', " version ", 1);
    let mut writer = Writer::begin(file, &table, &by)?;
    let mut row = csv::StringRecord::new();
    for tile in 0..plan.tiles.len() {
        let body = body(tile)?;
        let mut reader = csv::Reader::from_reader(body.as_bytes());
        while reader.read_record(&mut row).map_err(io::Error::other)? {
            writer.row(row.iter())?;
        }
    }
    Ok(writer.finish()?)
}

#[cfg(not(feature = "parquet"))]
fn as_parquet(
    _: &Planned,
    _: Content,
    _: Bodies<'_>,
    _: &mut dyn io::Write,
) -> io::Result<()> {
    Err(io::ErrorKind::Unsupported.into())
}
