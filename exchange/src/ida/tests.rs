use std::path::Path;

use rocking::intensity::Intensity;

use super::IdaTable;
use crate::columns::IDA;

const ROWS: [&str; 4] = [
    "A,0.2,3,0.2,0.1,1,0.5,0,no-uplift,inf,,X,0.92,nonlinear,,alpha,\
     record-scaling,9.80665,none,x,1",
    "A,0.2,3,0.3,0.2,1.5,0.75,0.4,rocked,0.6,,X,0.92,nonlinear,,alpha,\
     record-scaling,9.80665,none,x,1",
    "A,0.2,3,0.4,0.3,2,1,inf,overturned,0.1,,X,0.92,nonlinear,,alpha,\
     record-scaling,9.80665,none,x,1",
    "B,0.2,3,0.2,0.1,1,0.6,0,no-uplift,inf,,X,0.92,nonlinear,,alpha,\
     record-scaling,9.80665,none,x,1",
];

fn read(rows: &[&str]) -> Result<IdaTable, String> {
    let header: Vec<&str> = IDA.names().collect();
    let text = format!("{}\n{}\n", header.join(","), rows.join("\n"));
    let table = IdaTable::read(text.as_bytes(), Path::new("a.csv"));
    table.map_err(|error| error.to_string())
}

#[test]
fn a_table_is_written_as_it_was_read() {
    let table = read(&ROWS).unwrap();
    assert_eq!(read(&table.csv().lines().skip(1).collect::<Vec<_>>()), {
        Ok(table.clone())
    });
    assert_eq!(table.csv().lines().skip(1).collect::<Vec<_>>(), ROWS);
    assert_eq!(table.records().collect::<Vec<_>>(), ["A", "B"]);
    assert_eq!(table.events(), Some(vec!["X", "X"]));
    let found = table.curves(Intensity::Pgv).unwrap();
    assert_eq!((found.clusters.records(), found.clusters.count()), (2, 1));
    assert_eq!(found.im_r, 0.5);
    assert_eq!(found.curves[0].1.overturning_im(), Some(1.0));
}

#[test]
fn a_table_that_is_none_is_refused_with_its_line() {
    let changed = |from: &str, to: &str| ROWS[1].replace(from, to);
    let mixed = "alpha_rad is 0.3: expected 0.2, as on the first row";
    let cases = [
        (changed("A,0.2", "A,0.3"), mixed),
        (changed(",0.92,", ",0.9,"), "eta is 0.9: expected 0.92"),
        (changed("0.4,rocked", "-1,rocked"), "found `-1` in column edp"),
        (changed("0.4,rocked", "inf,rocked"), "inf where overturned"),
        (changed("rocked", "fell"), "found `fell` in column outcome"),
        (changed(",0.6,,", ",x,,"), "found `x` in column margin"),
        (changed("none,x", "none,y"), "software is y: expected x, as on"),
        (changed(",X,", ",,"), "the earthquake of every record, or of none"),
        (changed("x,1", "x,2"), "found `2` in column schema"),
    ];
    for (row, expected) in cases {
        let refused = read(&[ROWS[0], &row]).unwrap_err();
        assert!(refused.starts_with("a.csv:3: "), "{refused}");
        assert!(refused.contains(expected), "{refused}");
    }
    let fixed = read(&[&ROWS[0].replace("ar,,al", "ar,6,al")]).unwrap_err();
    assert!(fixed.contains("a.csv:2: found `6` in column order"), "{fixed}");
    let again = read(&[ROWS[0], ROWS[3], ROWS[1]]).unwrap_err();
    assert!(again.contains("a.csv:4: record A comes again"), "{again}");
    assert!(read(&[]).unwrap_err().contains("no analysis"));
}
