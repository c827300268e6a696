//! Work counters: expected values that come from this program, and are
//! therefore kept in a separate file.

use std::collections::BTreeMap;

use toml::Value;

use super::case::{Case, Values};
use rocking_common::table::cells;

/// The method whose cases expect them.
pub const COUNTERS: &str = "work-counters";

/// The accepted counters. Like the values in case files, they are only
/// compared with, never printed or written.
pub(super) const ACCEPTED: &str = include_str!("../../work-counters.csv");

/// Gives the cases of work counters their expected values from `csv`. The case
/// of a trajectory without a row fails.
pub fn expect_counters(cases: &mut [Case], csv: &str) {
    let mut lines = csv.lines().map(cells);
    let header = lines.next().unwrap_or_default();
    let rows: Vec<Vec<String>> = lines.filter(|row| !row.is_empty()).collect();
    for case in cases.iter_mut().filter(|case| case.method == COUNTERS) {
        let entries = case.input.get("entries").and_then(Value::as_array);
        let entries = entries.into_iter().flatten().filter_map(Value::as_str);
        let mut values = BTreeMap::new();
        for (k, quantity) in header.iter().enumerate().skip(1) {
            let of = |entry: &str| {
                let row = rows.iter().find(|row| row[..1] == [entry])?;
                row.get(k)?.parse().ok()
            };
            let found = entries.clone().filter_map(of).collect();
            values.insert(quantity.clone(), Values::Many(found));
        }
        case.expect.values = values;
    }
}
