//! Tiles put together: as CSV, and as Parquet where the program has it.

use std::path::Path;

use rocking::stop;

use super::content::Content;
use super::plan::Planned;
use super::tile;
use crate::failure::Failure;
use rocking_common::files::{Output, Outputs};
use rocking_common::table::body;

/// Puts the tiles together in the plan's order, one after the other: as
/// Parquet where the name of `out` ends so, else as CSV. The bytes are the
/// same for any number of tasks.
///
/// # Errors
/// [`Failure`] for a tile that is missing, of another plan or another build,
/// or damaged; and for Parquet where the program was built without it.
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
    let mut output = Outputs::of(planned.files()).open(out)?;
    match parquet {
        true => as_parquet(planned, content, &mut output)?,
        false => as_csv(planned, content, &mut output)?,
    }
    Ok(output.finish()?)
}

fn as_csv(
    planned: &Planned,
    content: Content,
    output: &mut Output,
) -> Result<(), Failure> {
    for tile in 0..planned.plan.tiles.len() {
        stop::point();
        let text = tile::body(planned, content, tile)?;
        // The header stands once.
        output.add(if tile == 0 { &text } else { body(&text) })?;
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
    output: &mut Output,
) -> Result<(), Failure> {
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
    // As the format has it: NAME version VERSION (build HASH).
    let by = plan.software.replacen(' ', " version ", 1);
    let by = by.replacen("(commit ", "(build ", 1);
    let mut writer = Writer::begin(output, &table, &by)?;
    let mut row = csv::StringRecord::new();
    for tile in 0..plan.tiles.len() {
        stop::point();
        let body = tile::body(planned, content, tile)?;
        let mut reader = csv::Reader::from_reader(body.as_bytes());
        while reader.read_record(&mut row)? {
            writer.row(row.iter())?;
        }
    }
    Ok(writer.finish()?)
}

#[cfg(not(feature = "parquet"))]
fn as_parquet(_: &Planned, _: Content, _: &mut Output) -> Result<(), Failure> {
    Err(std::io::Error::from(std::io::ErrorKind::Unsupported).into())
}
