//! The table of floors: CSV, one row a floor of a building.

use std::collections::BTreeMap;
use std::io::Read;
use std::path::Path;

use rocking_exchange::read::{no_csv, reader};
use rocking_records::floor::Floor;
use serde::Deserialize;

use super::blocks::BlockRow;
use crate::failure::{AtPlace as _, Failure, bail, ensure};
use crate::input;

/// The columns that a table of floors has.
const EXPECTED: &str = "name, and numbers in the columns period_s, damping \
                        and height_ratio";

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FloorCells {
    name: String,
    period_s: f64,
    damping: f64,
    height_ratio: f64,
}

/// Reads a table with the columns `name`, `period_s`, `damping` (a ratio) and
/// `height_ratio` (participation factor times mode shape).
///
/// # Errors
/// [`Failure`] with the line for another column, a cell of another form, a
/// floor out of range, a name that comes again, and no row at all.
pub fn read(path: &Path) -> Result<BTreeMap<String, Floor>, Failure> {
    parse(input::open(path)?, path)
}

/// Reads the text of such a table; `path` is its name in messages.
///
/// # Errors
/// As [`read`].
pub fn parse(
    from: impl Read,
    path: &Path,
) -> Result<BTreeMap<String, Floor>, Failure> {
    let place = path.display();
    let mut reader = reader(from, csv::Trim::All, None);
    let header = reader.headers().map_err(|e| no_csv(path, e))?.clone();
    let mut floors = BTreeMap::new();
    for record in reader.records() {
        let record = record.map_err(|e| no_csv(path, e))?;
        let line = record.position().map_or(0, csv::Position::line);
        let place = format!("{place}:{line}");
        let FloorCells { name, period_s, damping, height_ratio } =
            record.deserialize(Some(&header)).map_err(|e| {
                Failure::input(format!("{place}: {e}: expected {EXPECTED}"))
            })?;
        ensure!(!name.is_empty(), "{place}: no name: expected {EXPECTED}");
        let floor = Floor::try_new(period_s, damping, height_ratio);
        ensure!(
            floors.insert(name.clone(), floor.at(&place)?).is_none(),
            "{place}: floor {name} is already on a line above: expected each \
             name once"
        );
    }
    ensure!(!floors.is_empty(), "{place}: no floor");
    Ok(floors)
}

/// The floor of each row, from a table of floors; none is the ground.
///
/// # Errors
/// [`Failure`] for a table that is refused or that no row needs, and with the
/// line for a floor that is in no table.
pub fn of_rows(
    path: Option<&Path>,
    rows: &[BlockRow],
) -> Result<Vec<Option<Floor>>, Failure> {
    let floors = path.map(read).transpose()?.unwrap_or_default();
    if let Some(path) = path
        && rows.iter().all(|row| row.cells.floor.is_none())
    {
        bail!(
            "{}: no object has a floor: expected a column floor in the table \
             of objects",
            path.display()
        );
    }
    let floor = |row: &BlockRow| {
        let Some(name) = &row.cells.floor else { return Ok(None) };
        let found = floors.get(name).copied();
        found.map(Some).ok_or_else(|| {
            let names: Vec<_> = floors.keys().cloned().collect();
            let expected = match path {
                None => "--floors with a table that has it".to_owned(),
                Some(path) => {
                    format!("{} of {}", names.join(", "), path.display())
                }
            };
            let place = &row.place;
            Failure::input(format!(
                "{place}: floor {name}: expected {expected}"
            ))
        })
    };
    rows.iter().map(floor).collect()
}

#[cfg(test)]
mod tests {
    use super::super::blocks;
    use super::*;

    const FLOORS: &str = "name,period_s,damping,height_ratio\n\
                          third,0.8,0.05,0.9\nroof,0.8,0.05,1.4\n";

    /// The floors of two objects, by tables of these texts.
    fn found(
        floors: &str,
        objects: &str,
    ) -> Result<Vec<Option<Floor>>, String> {
        let folder = tempfile::tempdir().unwrap();
        let path = |name: &str, text: &str| {
            let path = folder.path().join(name);
            std::fs::write(&path, text).unwrap();
            path
        };
        let rows = blocks::read(&path("objects.csv", objects), 9.81);
        let table = path("floors.csv", floors);
        let table = Some(&*table).filter(|_| !floors.is_empty());
        let found = rows.and_then(|rows| of_rows(table, &rows));
        found.map_err(|failure| {
            let folder = format!("{}/", folder.path().display());
            failure.message.replace(&folder, "")
        })
    }

    #[test]
    fn an_object_has_the_floor_that_it_names() {
        let objects = "id,width_m,height_m,floor\nvase,0.2,0.8,third\n\
                       stele,0.5,1.8,\n";
        let third = Floor::try_new(0.8, 0.05, 0.9).unwrap();
        assert_eq!(found(FLOORS, objects), Ok(vec![Some(third), None]));
    }

    #[test]
    fn a_table_that_makes_no_sense_is_refused_with_its_line() {
        let objects = "alpha,p,floor\n0.2,3,attic\n";
        let head = "name,period_s,damping,height_ratio";
        for (floors, words) in [
            (
                FLOORS,
                "objects.csv:2: floor attic: expected roof, third of floors.csv",
            ),
            ("", "objects.csv:2: floor attic: expected --floors"),
            (&*format!("{head}\n"), "floors.csv: no floor"),
            (&*format!("{head},z\na,1,0.05,1,3\n"), "floors.csv:2: "),
            ("name,period_s,damping\na,1,0.05\n", "floors.csv:2: "),
            (
                &*format!("{head}\na,1,5,1\n"),
                "floors.csv:2: damping ratio 5: ",
            ),
            (
                &*format!("{head}\na,1,NaN,1\n"),
                "floors.csv:2: damping ratio NaN",
            ),
            (&*format!("{head}\n,1,0.05,1\n"), "floors.csv:2: "),
            (
                &*format!("{head}\na,1,0.05,\"1\n"),
                "floors.csv: a cell that begins with a quote on line 2 has",
            ),
            (
                &*format!("{head}\na,1,0.05,1\na,1,0.05,1\n"),
                "floors.csv:3: floor a",
            ),
        ] {
            let message = found(floors, objects).unwrap_err();
            assert!(message.starts_with(words), "{message}");
        }
        let message = found(FLOORS, "alpha,p\n0.2,3\n").unwrap_err();
        assert!(message.starts_with("floors.csv: no object has a floor"));
    }
}
