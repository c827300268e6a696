//! Fits of counts: how many records exceeded a level at each stripe.

use std::path::Path;

use rocking::statistics::lognormal::{Stripe, fit_counts};
use serde_json::{Map, Value, json};

use super::{Args, show};
use crate::cli::Failure;
use crate::cli::samples::{Opened, Shift};

/// The columns of a table of counts.
pub(in crate::cli) const COLUMNS: [&str; 3] = ["im", "exceeded", "n"];

pub(super) fn run(args: &Args, path: &Path) -> Result<(), Failure> {
    let shift = match args.shift {
        None => 0.0,
        Some(Shift::Given(shift)) => shift,
        Some(Shift::Min | Shift::Free) => {
            return Err(Failure::input(
                "--shift with --counts: counts do not tell the shift; \
                 expected a number, as --shift 1",
            ));
        }
    };
    let found = fit_counts(&read(path)?, shift).map_err(|error| {
        Failure::input(format!("{}: {error}", path.display()))
    })?;
    let fitted = found.fit.distribution;
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| {
        out.insert(key.to_owned(), value);
    };
    put("im_unit", "that of the counts".into());
    put("n", found.fit.n.into());
    put("method", "binomial counts, probit".into());
    put("shift", json!(fitted.shift()));
    put("mu", json!(fitted.log_mean()));
    put("beta", json!(fitted.dispersion()));
    put("beta_low", json!(found.dispersion.0));
    put("beta_high", json!(found.dispersion.1));
    put("median", json!(fitted.median()));
    put("median_low", json!(found.median.0));
    put("median_high", json!(found.median.1));
    put("interval_level", json!(0.95));
    put("intervals_take", "the stripes as independent".into());
    put("log_likelihood", json!(found.fit.log_likelihood));
    put("chi_squared", json!(found.chi_squared));
    put("degrees_of_freedom", found.degrees_of_freedom.into());
    show(args, out)
}

/// Reads a table of counts.
fn read(path: &Path) -> Result<Vec<Stripe>, Failure> {
    let place = path.display();
    let refuse = |e: csv::Error| Failure::input(format!("{place}: {e}"));
    let opened = Opened::open(path);
    let opened = opened.map_err(|e| refuse(e.into()))?;
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(opened);
    let header = reader.headers().map_err(refuse)?;
    if header.iter().ne(COLUMNS) {
        return Err(Failure::input(format!(
            "{place}:1: found columns `{}`: expected `{}`",
            header.iter().collect::<Vec<_>>().join(","),
            COLUMNS.join(","),
        )));
    }
    let mut stripes = Vec::new();
    for row in reader.records() {
        let row = row.map_err(refuse)?;
        let line = row.position().map_or(0, csv::Position::line);
        let wrong = |column: usize, expected: &str| {
            Failure::input(format!(
                "{place}:{line}: found `{}` in column {}: expected {expected}",
                &row[column], COLUMNS[column],
            ))
        };
        let count = |column: usize| {
            let count = row[column].parse::<u32>().ok();
            let count = count.filter(|count| *count <= MOST_RECORDS);
            count.ok_or_else(|| wrong(column, "a count up to 1000000"))
        };
        let im = row[0].parse::<f64>().ok().filter(|im| im.is_finite());
        stripes.push(Stripe {
            im: im.ok_or_else(|| wrong(0, "an intensity"))?,
            exceeded: count(1)?,
            n: count(2)?,
        });
    }
    Ok(stripes)
}

/// Records of a stripe, at most.
const MOST_RECORDS: u32 = 1_000_000;
