//! Confidence bands of a fragility over intensity: what few records leave
//! open at each intensity.

use std::fmt::Write as _;
use std::path::PathBuf;

use rocking::statistics::Lognormal;
use rocking::statistics::bootstrap::{Bootstrap, estimate};
use rocking::statistics::lognormal::FitMethod;
use serde_json::{Value, json};

use super::limits::Limited;
use super::sample::Plan;
use crate::cli::capacities::Levels;
use crate::table::{Table, number, optional};

/// Level of the bands.
const LEVEL: f64 = 0.95;

/// Probabilities of a fragility with their bands.
#[derive(clap::Args)]
pub(super) struct BandArgs {
    /// Probability at these intensities with its 95 % band, of one intensity
    /// at a time: from the records of --bootstrap, and by the delta method
    /// (fits of complete samples by mle or moment, known shift).
    /// FIRST:LAST:STEP or separated by commas.
    #[arg(
        long,
        value_name = "LEVELS",
        requires_all = ["sample", "bootstrap"],
        allow_hyphen_values = true
    )]
    pub(super) band: Option<Levels>,
    /// The same as a table.
    #[arg(long, value_name = "FILE.csv", requires = "band")]
    pub(super) band_csv: Option<PathBuf>,
}

/// One intensity of a band.
pub(super) struct Row {
    im: f64,
    probability: f64,
    bootstrap: Option<(f64, f64)>,
    delta: Option<(f64, f64)>,
}

/// A band and where it comes from.
pub(super) struct Band {
    rows: Vec<Row>,
    replicates: usize,
    seed: u64,
}

impl Band {
    /// The band of a fit, whose records are drawn anew.
    pub(super) fn new(
        plan: &Plan,
        values: &Limited,
        fitted: &Lognormal,
        (levels, replicates, seed): (&Levels, usize, u64),
    ) -> Self {
        let n = values.values.len();
        let draws = Bootstrap::new("fragility", seed, n, replicates);
        let fits = draws.map(|places| {
            let fits = plan.fits(&values.at(places)).ok();
            fits.map(|fits| fits.fit.distribution)
        });
        let complete = values.values.iter().all(|x| x.is_finite());
        let method = plan.method();
        let known =
            matches!(method, FitMethod::MaximumLikelihood | FitMethod::Moment);
        let row = |&im: &f64| {
            let at = |fit: &Option<Lognormal>| {
                fit.as_ref().map_or(f64::NAN, |fit| fit.cdf(im))
            };
            let column: Vec<f64> = fits.iter().map(at).collect();
            let probability = fitted.cdf(im);
            let found = estimate(probability, &column, LEVEL);
            Row {
                im,
                probability,
                bootstrap: found.map(|e| (e.low, e.high)),
                delta: (complete && known)
                    .then(|| fitted.interval_of_cdf(n, im, LEVEL)),
            }
        };
        let rows = levels.0.iter().map(row).collect();
        Self { rows, replicates, seed }
    }

    pub(super) fn json(&self) -> Value {
        let row = |row: &Row| {
            json!({
                "im": row.im,
                "probability": row.probability,
                "low": row.bootstrap.map(|b| b.0),
                "high": row.bootstrap.map(|b| b.1),
                "delta_low": row.delta.map(|d| d.0),
                "delta_high": row.delta.map(|d| d.1),
            })
        };
        json!({
            "level": LEVEL,
            "of": "one intensity at a time",
            "replicates": self.replicates,
            "seed": self.seed,
            "rows": self.rows.iter().map(row).collect::<Vec<_>>(),
        })
    }

    pub(super) fn text(&self) -> String {
        let mut text = format!(
            "\nbands (95 %, of one intensity at a time): bootstrap of {} \
             samples, delta method\n{:>12} {:>11} {:>11} {:>11} {:>11} \
             {:>11}\n",
            self.replicates,
            "im",
            "probability",
            "low",
            "high",
            "delta low",
            "delta high",
        );
        let cell = |x: Option<f64>| {
            x.map_or("none".to_owned(), |x| format!("{x:.6}"))
        };
        for row in &self.rows {
            let _ = writeln!(
                text,
                "{:>12} {:>11.6} {:>11} {:>11} {:>11} {:>11}",
                row.im,
                row.probability,
                cell(row.bootstrap.map(|b| b.0)),
                cell(row.bootstrap.map(|b| b.1)),
                cell(row.delta.map(|d| d.0)),
                cell(row.delta.map(|d| d.1)),
            );
        }
        text
    }

    pub(super) fn csv(&self) -> String {
        let mut table =
            Table::headed("im,probability,low,high,delta_low,delta_high");
        let low = |band: Option<(f64, f64)>| optional(band.map(|b| b.0));
        let high = |band: Option<(f64, f64)>| optional(band.map(|b| b.1));
        for row in &self.rows {
            table.row([
                number(row.im),
                number(row.probability),
                low(row.bootstrap),
                high(row.bootstrap),
                low(row.delta),
                high(row.delta),
            ]);
        }
        table.finish()
    }
}
