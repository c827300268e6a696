//! Work counters: expected values that this program finds itself, so that
//! they stand in a file of their own and not in the cases.

use std::collections::BTreeMap;

use super::case::{Case, Values};
use rocking_common::table::cells;

/// The method whose cases expect them.
pub const COUNTERS: &str = "work-counters";

/// The counters as accepted. Like the case files, these are values to
/// compare with: nothing that is printed or written comes from here.
pub(super) const ACCEPTED: &str = include_str!("../../work-counters.csv");

/// Reference trajectories that a case names.
fn entries(case: &Case) -> impl Iterator<Item = &str> {
    let list = case.input.get("entries").and_then(toml::Value::as_array);
    list.into_iter().flatten().filter_map(toml::Value::as_str)
}

/// Gives the cases of work counters their expected values from `csv`. A
/// trajectory that has no row there has none, and its case fails.
pub fn expect_counters(cases: &mut [Case], csv: &str) {
    let mut lines = csv.lines().map(cells);
    let header = lines.next().unwrap_or_default();
    let rows: Vec<Vec<String>> = lines.filter(|row| !row.is_empty()).collect();
    for case in cases.iter_mut().filter(|case| case.method == COUNTERS) {
        let mut values = BTreeMap::new();
        for (k, quantity) in header.iter().enumerate().skip(1) {
            let of = |entry: &str| {
                let row = rows.iter().find(|row| row[..1] == [entry])?;
                row.get(k)?.parse().ok()
            };
            let found = entries(case).filter_map(of).collect();
            values.insert(quantity.clone(), Values::Many(found));
        }
        case.expect.values = values;
    }
}
