//! The registry of tables, against what commands write and `docs/tables.md`.

use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use rocking_common::table::columns::{
    BAND, BLOCKS, Column, FORCES, FRAGILITIES, HISTORY, IDA, Layout, OUTCOMES,
    SCHEMA, SWEEP_CAPACITIES, SWEEP_FRAGILITIES, SWEEP_ROWS, TABLES,
};

use super::super::compare::committed;
use super::support::{at2, folder, motion, run};

/// The page that the registry makes.
fn page() -> String {
    let mut text = format!(
        "# Tables\n\nEach file of rows that a command reads or writes, with \
         its columns. A test makes\nthis page of `crates/exchange/src/columns.txt`, \
         from which the writers take their header\nlines. A table that a \
         command writes ends with the column `schema`, now\n{SCHEMA}; each \
         JSON has a field of that name. It rises when a column or a field\n\
         changes its name, its unit or its meaning, and a table of another \
         schema is\nrefused. Unit 1 is a number without a unit. `inf` is \
         infinity. An empty cell of\nnumbers is missing. `im` is the name of \
         an intensity measure; a number is an\n`intensity`. An index of \
         records carries no schema: its other columns are\nattributes of the \
         records.\n"
    );
    for table in TABLES {
        writeln!(
            text,
            "\n## {}\n\n{}\n\n| column | cells | unit | meaning |\n\
             |---|---|---|---|",
            table.name, table.about
        )
        .unwrap();
        for Column { name, cells, unit, meaning, .. } in &table.columns {
            let meaning = meaning.replace('|', "\\|");
            writeln!(text, "| `{name}` | {cells} | {unit} | {meaning} |")
                .unwrap();
        }
    }
    text
}

/// `.ci/accept` renews it.
#[test]
fn the_page_of_tables_is_that_of_the_registry() {
    if let Some(kept) = committed("docs/tables.md", &page()) {
        assert!(kept == page(), "docs/tables.md: expected\n{}", page());
    }
    // `im` is a name wherever it stands.
    assert!(TABLES.iter().all(|table| !table.columns.is_empty()));
    let all = TABLES.iter().flat_map(|table| &table.columns);
    for column in all {
        assert!(column.name != "im" || column.cells == "text");
    }
}

/// Holds a table to its layout; `extra` columns stand before the schema.
fn holds(place: &Path, file: &str, layout: &Layout, extra: &[&str]) {
    let text = fs::read_to_string(place.join(file)).unwrap();
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header: Vec<String> =
        reader.headers().unwrap().iter().map(String::from).collect();
    let mut expected: Vec<&str> = layout.names().collect();
    expected
        .splice(layout.columns.len()..layout.columns.len(), extra.to_vec());
    assert_eq!(header, expected, "{file}");
    let mut rows = 0;
    for row in reader.records() {
        let row = row.unwrap();
        rows += 1;
        for (column, cell) in layout.columns.iter().zip(&row) {
            let fits = match column.cells {
                "text" => cell.parse::<f64>().is_err(),
                "number" => cell.is_empty() || cell.parse::<f64>().is_ok(),
                "count" => cell.parse::<u64>().is_ok(),
                "flag" => cell.parse::<bool>().is_ok(),
                other => panic!("{other}"),
            };
            assert!(fits, "{file}, {}: {cell}", column.name);
        }
        assert_eq!(row.get(row.len() - 1), Some("1"), "{file}");
    }
    assert!(rows > 0, "{file}");
}

#[test]
fn tables_of_commands_have_the_columns_of_the_registry() {
    let samples = motion(9.0);
    let record = at2("0.02", samples.len(), &samples);
    let blocks: Vec<&str> = BLOCKS.names().collect();
    let cells = blocks.iter().map(|name| match *name {
        "alpha" => "0.1",
        "p" => "3",
        "eta" => "0.92",
        _ => "",
    });
    let cells = cells.collect::<Vec<_>>().join(",");
    let blocks = format!("{}\n{cells}\n", blocks.join(","));
    let files = [
        ("a.at2", record.as_str()),
        ("sample.txt", "1.2\n1.5\n1.9\n2.6\n"),
        ("blocks.csv", &blocks),
    ];
    let place = folder("tables", &files);
    for command in [
        "respond --alpha 0.1 --p 3 --record a.at2 --im 2 --history h.csv",
        "ida --alpha 0.1 --p 3 --suite a.at2 --step-im 0.5 --out ida.csv \
         --forces forces.csv",
        "stripes --ida ida.csv --levels 1.2,1.4 --at 0.01 --counts n.csv",
        "fragility fit --sample sample.txt --bootstrap 20 --band 1:2:0.5 \
         --band-csv band.csv",
        "fragility export --sample sample.txt --im pga --blocks blocks.csv \
         --format csv --out e.csv",
        "sweep plan --blocks blocks.csv --suite a.at2 --out plan --step-im \
         0.5 --demands 0.5,1 --rows",
        "sweep run plan",
        "sweep merge plan --out f.csv",
        "sweep merge plan --what capacities --out c.csv",
        "sweep merge plan --what rows --out r.csv",
    ] {
        let (status, _, error) = run(&place, command);
        assert_eq!(status, 0, "{command}: {error}");
    }
    for (file, layout) in [
        ("h.csv", &HISTORY),
        ("ida.csv", &IDA),
        ("forces.csv", &FORCES),
        ("n.csv", &OUTCOMES),
        ("band.csv", &BAND),
        ("e.csv", &FRAGILITIES),
        ("f.csv", &SWEEP_FRAGILITIES),
        ("r.csv", &SWEEP_ROWS),
    ] {
        holds(&place, file, layout, &[]);
    }
    let capacities = ["intensity_at_0.5", "intensity_at_1"];
    holds(&place, "c.csv", &SWEEP_CAPACITIES, &capacities);
    // A table of another schema is refused.
    let ida = fs::read_to_string(place.join("ida.csv")).unwrap();
    fs::write(place.join("ida.csv"), ida.replace(",1\n", ",7\n")).unwrap();
    let (status, _, error) =
        run(&place, "capacities --ida ida.csv --at 1 --out -");
    assert_eq!(status, 2);
    let words = "ida.csv:2: found `7` in column schema: expected 1";
    assert!(error.contains(words), "{error}");
}
