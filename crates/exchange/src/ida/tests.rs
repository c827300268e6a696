use std::path::Path;

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Grid, curve};
use rocking_records::intensity::Intensity;

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
    assert!(again.contains("a.csv:4: record A is repeated"), "{again}");
    // Levels that begin anew are those of another record.
    let refined = ROWS[2].replace("overturned", "overturned-refined");
    let refined = refined.replace(",2,1,inf", ",1.8,0.9,inf");
    let whole = [ROWS[0], ROWS[1], ROWS[2], &refined];
    assert_eq!(read(&whole).unwrap().records().count(), 1);
    for rows in [
        &[ROWS[0], ROWS[1], ROWS[0]][..],
        &[ROWS[0], ROWS[1], ROWS[1]],
        &[ROWS[0], ROWS[1], &refined, &refined],
        &[ROWS[0], ROWS[1], &refined, ROWS[2]],
        &[&whole[..], &whole[..]].concat(),
    ] {
        let error = read(rows).unwrap_err();
        assert!(error.contains("expected rising levels"), "{error}");
        assert!(error.contains("do two records share the name?"), "{error}");
    }
    assert!(read(&[]).unwrap_err().contains("no analysis"));
}

/// A curve belongs to its place in the suite, never to a name.
#[test]
fn as_many_curves_as_records_whatever_their_names() {
    let lobe = |name: &str, dt_s| {
        let record = Accelerogram::try_new(name, dt_s, vec![0.0, 0.2, 0.0]);
        NormalisedRecord::new(&record.unwrap())
    };
    let block = Block::try_new(0.1, 3.0).unwrap();
    let analysis = Analysis {
        grid: Grid::Im { step: 0.5 },
        ..Analysis::paper(block, Restitution::constant(0.92).unwrap())
    };
    for names in [["", "", ""], ["a", "a", "a"], ["a", "b", "c"]] {
        let records = [0, 1, 2].map(|i| lobe(names[i], 0.2 + 0.05 * i as f64));
        let found = records.map(|record| curve(&record, &analysis).unwrap());
        let known = |_: &str| (String::new(), String::new());
        let about = ("none", "x");
        let table = IdaTable::of(&found, &analysis, 9.81, about, known);
        assert_eq!(table.records().collect::<Vec<_>>(), names);
        // The area of a lobe is its height times its interval.
        for (rows, dt_s) in table.by_record().zip([0.2, 0.25, 0.3]) {
            for row in rows {
                let pgv_m_s = 9.81 * row.pga_g * dt_s;
                assert!((row.pgv_m_s / pgv_m_s - 1.0).abs() < 1e-12);
            }
        }
        let curves = table.curves(Intensity::Pga).unwrap().curves;
        let overturning: Vec<_> =
            curves.iter().map(|(_, curve)| curve.overturning_im()).collect();
        let expected = found.map(|one| one.overturning.map(|o| o.im()));
        assert_eq!(overturning, expected);
        let read = IdaTable::read(table.csv().as_bytes(), Path::new("a.csv"));
        assert_eq!(read.is_ok(), names[0] != names[1]);
    }
}
