//! The fits at several levels of an IDA table.

use std::fmt::Write as _;
use std::path::Path;

use rocking::capacity::{Capacity, InversionRule};
use rocking::statistics::{ExtendedSample, Lognormal};
use serde_json::json;

use super::Args;
use super::limits::Limited;
use super::sample::Plan;
use crate::cli::capacities::ida;
use crate::cli::{Failure, print, print_json};
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
    let measure = args.im.unwrap_or(Intensity::Pga);
    let suite = ida::read(path, measure)?;
    let rule = args.point.unwrap_or(InversionRule::Median);
    let levels = args.at.as_ref().map_or(&[][..], |levels| &levels.0);
    let mut rows = Vec::new();
    for &edp in levels {
        let (mut ims, mut limits) = (Vec::new(), Vec::new());
        for (_, curve) in &suite.curves {
            let capacity = curve.capacity(edp, rule)?;
            ims.push(capacity.im());
            limits.push(match capacity {
                Capacity::Reached(_) => None,
                Capacity::Censored { above } => Some(above),
            });
        }
        let sample = ExtendedSample::try_new(&ims)?;
        let limited = Limited::new(&ims, &limits);
        let at = |p| {
            let value = limited.quantile(plan.quantile_type, p);
            value.unwrap_or(f64::NAN)
        };
        let fits = plan.fits(&limited).map_err(|error| {
            let path = path.display();
            Failure::input(format!("{path} at EDP {edp}: {error}"))
        })?;
        rows.push(Row {
            edp,
            censored: sample.censored(),
            quantiles: [at(0.16), at(0.5), at(0.84)],
            fitted: fits.fit.distribution,
            unshifted: fits.unshifted,
        });
    }
    let (n, rule) = (suite.curves.len(), rule.to_string());
    if args.json {
        let rows = rows.iter().map(|row| {
            json!({
                "edp": row.edp,
                "censored": row.censored,
                "im16": row.quantiles[0],
                "im50": row.quantiles[1],
                "im84": row.quantiles[2],
                "shift": row.fitted.shift(),
                "median": row.fitted.median(),
                "beta": row.fitted.dispersion(),
                "unshifted_median":
                    row.unshifted.map(|u| u.median()),
                "unshifted_beta":
                    row.unshifted.map(|u| u.dispersion()),
            })
        });
        let rows: Vec<_> = rows.collect();
        return print_json(json!({
            "im_unit": measure.words(),
            "n": n,
            "point": rule,
            "levels": rows,
        }));
    }
    let mut text = format!(
        "{n} records, {rule} crossing, intensities in {}\n\
         {:>8} {:>8} {:>9} {:>9} {:>9} {:>8} {:>9} {:>8} {:>17}\n",
        measure.words(),
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
