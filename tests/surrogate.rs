//! The blocks that the surrogate rests on, analysed again.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;

use rocking_common::table::digits;
use rocking_surrogate::{
    RESTITUTION, SHIFT, Surrogate, fit, point, read_table,
};
use rocking_synthesis::SuiteKind;

use super::compare::{accepting, committed};
use super::support::{answer, folder, run};

const DESIGN: &str = "fixtures/surrogate/design.csv";

const HEADER: &str = "suite,alpha_rad,p_rad_s,median,median_low,median_high,\
                      dispersion,dispersion_low,dispersion_high";

/// Blocks of each suite that are analysed first. Where they are as they are
/// kept, so are all others, and twelve minutes of a core are saved.
const FIRST: usize = 4;

/// Overturning of blocks in PGA/(g tan alpha) under both embedded suites, by
/// `rocking sweep`: the points `first` and on of the surrogate's design.
fn analysed(first: u64, blocks: u64) -> String {
    let mut list = "alpha,p\n".to_owned();
    for (alpha, p) in (first..first + blocks).map(point) {
        writeln!(list, "{alpha:.6},{p:.6}").unwrap();
    }
    let place = folder("surrogate", &[("blocks.csv", &list)]);
    answer(&place, "suite export --out suites");
    let mut table = format!("{HEADER}\n");
    for (suite, name) in SuiteKind::ALL.into_iter().zip(["ordinary", "pulse"])
    {
        for line in [
            "plan --blocks blocks.csv --suite suites/NAME.csv --out NAME",
            "run NAME",
            "merge NAME --out NAME.merged.csv",
        ] {
            let line = format!("sweep {}", line.replace("NAME", name));
            let (status, _, error) = run(&place, &line);
            assert_eq!(status, 0, "{line}: {error}");
        }
        let merged = place.join(format!("{name}.merged.csv"));
        let mut reader = csv::Reader::from_path(merged).unwrap();
        for row in reader.deserialize::<BTreeMap<String, String>>() {
            let row = row.unwrap();
            let number = |name: &str| row[name].parse::<f64>().unwrap();
            if row["im"] != "pga" || number("demand") != 1.0 {
                continue;
            }
            // A sweep fits no block that a record never overturns.
            if row["median"].is_empty() {
                continue;
            }
            let held = [number("eta"), number("shift")];
            assert_eq!(held, [RESTITUTION, SHIFT]);
            table += suite.name();
            for name in HEADER.split(',').skip(1) {
                write!(table, ",{}", digits(number(name), 6)).unwrap();
            }
            table.push('\n');
        }
    }
    table
}

#[test]
fn the_first_blocks_of_the_surrogate_are_as_they_are_kept() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
    let mut design = fs::read_to_string(format!("{root}/{DESIGN}")).unwrap();
    let of = |suite: SuiteKind| {
        let rows = design.lines();
        let own = rows.filter(move |row| row.starts_with(suite.name()));
        own.take(FIRST)
    };
    let first: String = std::iter::once(HEADER)
        .chain(SuiteKind::ALL.into_iter().flat_map(of))
        .map(|row| format!("{row}\n"))
        .collect();
    let now = analysed(1, FIRST as u64);
    if accepting().is_none() {
        assert!(now == first, "{DESIGN}: {first}now\n{now}");
        return;
    }
    if now != first {
        design = analysed(1, 1000);
        committed(DESIGN, &design);
        let unseen = analysed(1001, 100);
        committed("fixtures/surrogate/unseen.csv", &unseen);
    }
    let (models, _) = fit(&read_table(DESIGN, &design).unwrap()).unwrap();
    let coefficients = Surrogate::coefficients(&models);
    committed("fixtures/surrogate/coefficients.csv", &coefficients);
}
