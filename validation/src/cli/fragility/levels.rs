//! The fits at several levels of an IDA table.

use std::fmt::Write as _;
use std::path::Path;

use rocking::capacity::InversionRule;
use rocking::statistics::{ExtendedSample, Lognormal};
use serde_json::json;

use super::Args;
use super::sample::Plan;
use crate::cli::capacities::ida;
use crate::cli::{Failure, print, print_json};
use crate::json;
use crate::paper::Intensity;

/// What was found at one level.
struct Row {
    edp: f64,
    censored: usize,
    /// Quantiles of the capacities: 16, 50 and 84 %.
    quantiles: [f64; 3],
    fitted: Lognormal,
    unshifted: Option<Lognormal>,
}

pub(super) fn run(args: &Args, path: &Path) -> Result<(), Failure> {
    let plan = Plan::new(args)?;
    let suite = ida::read(path, args.im.unwrap_or(Intensity::Pga))?;
    let rule = args.point.unwrap_or(InversionRule::Median);
    let levels = args.at.as_ref().map_or(&[][..], |levels| &levels.0);
    let mut rows = Vec::new();
    for &edp in levels {
        let mut ims = Vec::new();
        for (_, curve) in &suite.curves {
            ims.push(curve.capacity(edp, rule)?.im());
        }
        let sample = ExtendedSample::try_new(&ims)?;
        let at = |p| plan.quantile_type.of_extended(&sample, p);
        let fits = plan.fits(&ims).map_err(|error| {
            let path = path.display();
            Failure::input(format!("{path} at EDP {edp}: {error}"))
        })?;
        rows.push(Row {
            edp,
            censored: sample.censored(),
            quantiles: [at(0.16)?, at(0.5)?, at(0.84)?],
            fitted: fits.fit.distribution,
            unshifted: fits.unshifted,
        });
    }
    let (n, rule) = (suite.curves.len(), rule.to_string());
    if args.json {
        let rows = rows.iter().map(|row| {
            json!({
                "edp": json::number(row.edp),
                "censored": row.censored,
                "im16": json::number(row.quantiles[0]),
                "im50": json::number(row.quantiles[1]),
                "im84": json::number(row.quantiles[2]),
                "shift": json::number(row.fitted.shift()),
                "median": json::number(row.fitted.median()),
                "beta": json::number(row.fitted.dispersion()),
                "unshifted_median":
                    json::optional(row.unshifted.map(|u| u.median())),
                "unshifted_beta":
                    json::optional(row.unshifted.map(|u| u.dispersion())),
            })
        });
        let rows: Vec<_> = rows.collect();
        return print_json(json!({ "n": n, "point": rule, "levels": rows }));
    }
    let mut text = format!(
        "{n} records, {rule} crossing\n\
         {:>8} {:>8} {:>9} {:>9} {:>9} {:>8} {:>9} {:>8} {:>17}\n",
        "EDP",
        "censored",
        "16 %",
        "50 %",
        "84 %",
        "shift",
        "median",
        "beta",
        "unshifted",
    );
    for row in rows {
        let [low, median, high] = row.quantiles;
        let unshifted = row.unshifted.map_or("none".to_owned(), |u| {
            format!("{:.5} {:.5}", u.median(), u.dispersion())
        });
        writeln!(
            text,
            "{:>8} {:>8} {low:>9.5} {median:>9.5} {high:>9.5} {:>8.5} \
             {:>9.5} {:>8.5} {unshifted:>17}",
            row.edp,
            row.censored,
            row.fitted.shift(),
            row.fitted.median(),
            row.fitted.dispersion(),
        )?;
    }
    print(&text)
}
