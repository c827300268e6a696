use std::io;

use parquet::file::reader::{FileReader, SerializedFileReader};
use parquet::record::Field;

use super::*;

const COLUMNS: [(&str, Kind); 5] = [
    ("alpha_rad", Kind::Level),
    ("edp", Kind::Value),
    ("records", Kind::Count),
    ("resolved", Kind::Flag),
    ("record", Kind::Text),
];

/// Every kind, with what is hard to keep: the least subnormal, a negative
/// zero, infinity, a missing number, and text that CSV would quote.
const ROWS: [[&str; 5]; 5] = [
    ["0.1", "5e-324", "0", "true", "a"],
    ["0.1", "inf", "-1", "false", "a"],
    ["0.30000000000000004", "", "9007199254740993", "true", "b, \"c\""],
    ["-0", "0.1", "3", "true", "\u{e9}"],
    ["1e308", "-inf", "3", "false", ""],
];

fn write(
    sink: impl Write + Send,
    rows: &[[&str; 5]],
    group_rows: usize,
) -> Result<(), Error> {
    let notes = [("rocking.table", "rows")];
    let table = Table { columns: &COLUMNS, notes: &notes, group_rows };
    let mut writer = Writer::begin(sink, &table, "rocking version 1")?;
    for row in rows {
        writer.row(row.iter().copied())?;
    }
    writer.finish()
}

fn file(rows: &[[&str; 5]], group_rows: usize) -> Result<Vec<u8>, Error> {
    let mut out = Vec::new();
    write(&mut out, rows, group_rows)?;
    Ok(out)
}

#[test]
fn what_is_read_back_is_what_was_written_bit_by_bit() {
    for (group_rows, groups) in [(1, 5), (2, 3), (5, 1), (100, 1)] {
        let bytes = file(&ROWS, group_rows).unwrap();
        assert_eq!(bytes, file(&ROWS, group_rows).unwrap());
        let reader = SerializedFileReader::new(bytes::Bytes::from(bytes));
        let reader = reader.unwrap();
        let about = reader.metadata().file_metadata();
        assert_eq!(about.created_by(), Some("rocking version 1"));
        let notes = about.key_value_metadata().unwrap();
        assert_eq!(notes.len(), 1);
        assert_eq!(notes[0].value.as_deref(), Some("rows"));
        assert_eq!(reader.num_row_groups(), groups);
        let rows: Vec<_> = reader.get_row_iter(None).unwrap().collect();
        assert_eq!(rows.len(), ROWS.len());
        for (row, expected) in rows.iter().zip(ROWS) {
            let row = row.as_ref().unwrap();
            let bits = |text: &str| text.parse::<f64>().unwrap().to_bits();
            for ((name, field), cell) in row.get_column_iter().zip(expected) {
                match field {
                    Field::Double(x) => {
                        assert_eq!(x.to_bits(), bits(cell), "{name}");
                    }
                    Field::Long(x) => assert_eq!(x.to_string(), cell),
                    Field::Bool(x) => assert_eq!(x.to_string(), cell),
                    Field::Str(x) => assert_eq!(x, cell),
                    Field::Null => assert_eq!((&name[..], cell), ("edp", "")),
                    other => panic!("{other:?}"),
                }
            }
        }
    }
}

#[test]
fn a_table_without_rows_is_a_file_without_groups() {
    let bytes = file(&[], 10).unwrap();
    let reader = SerializedFileReader::new(bytes::Bytes::from(bytes));
    let reader = reader.unwrap();
    assert_eq!(
        (reader.num_row_groups(), reader.metadata().num_row_groups()),
        (0, 0)
    );
}

#[test]
fn a_cell_of_another_kind_is_named() {
    for (column, cell, words) in [
        (0, "", "row 1, column alpha_rad: \"\"; expected a number"),
        (0, "NaN", "\"NaN\"; expected a number"),
        (1, "x", "row 1, column edp: \"x\"; expected a number"),
        (2, "1.5", "column records: \"1.5\"; expected a whole number"),
        (3, "1", "column resolved: \"1\"; expected true or false"),
    ] {
        let mut row = ROWS[0];
        row[column] = cell;
        let error = file(&[row], 10).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    }
    let table = Table { columns: &COLUMNS, notes: &[], group_rows: 1 };
    let longer = [&ROWS[0][..], &["x"]].concat();
    for cells in [&ROWS[0][..4], &longer] {
        let mut writer = Writer::begin(Vec::new(), &table, "x").unwrap();
        let error = writer.row(cells.iter().copied()).unwrap_err();
        let words = format!("row 1: {} cells; expected 5", cells.len());
        assert_eq!(error.to_string(), words);
    }
}

/// A disk of so many bytes.
struct Small(usize);

impl Write for Small {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if bytes.len() > self.0 {
            return Err(io::ErrorKind::StorageFull.into());
        }
        self.0 -= bytes.len();
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_reported_in_the_system_s_words() {
    let whole = file(&ROWS, 1).unwrap().len();
    for room in [0, 3, whole / 2, whole - 1] {
        let error = io::Error::from(
            write(Small(room), &ROWS, 1).expect_err(&room.to_string()),
        );
        assert_eq!(error.kind(), io::ErrorKind::StorageFull, "{room}");
    }
    write(Small(whole), &ROWS, 1).unwrap();
}
