//! Confidence bands of a fragility over intensity: what few records leave
//! open at each intensity.

use std::fmt::Write as _;
use std::path::PathBuf;

use rocking::statistics::bootstrap::{Bootstrap, estimate};
use rocking::statistics::lognormal::FitMethod;
use rocking::statistics::{Lognormal, normal};
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

/// Delta method: the score z = (ln(x - shift) - mu)/beta of a fit to n values
/// has the variance (1 + z^2/2)/n, since mu has beta^2/n, beta has
/// beta^2/(2 n), and both are independent.
fn delta(fitted: &Lognormal, n: usize, im: f64) -> (f64, f64) {
    let z = fitted.score(im);
    let wide = normal::quantile(0.5 * (1.0 + LEVEL));
    let half = wide * ((1.0 + 0.5 * z * z) / n as f64).sqrt();
    if z.is_finite() {
        (normal::cdf(z - half), normal::cdf(z + half))
    } else {
        (fitted.cdf(im), fitted.cdf(im))
    }
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
                delta: (complete && known).then(|| delta(fitted, n, im)),
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

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::statistics::ExtendedSample;
    use rocking::statistics::lognormal::fit;

    /// By Python: N = statistics.NormalDist(); z = (log(1.5) - 0.2)/0.5;
    /// N.cdf(z -+ N.inv_cdf(0.975)*sqrt((1 + z*z/2)/86)).
    #[test]
    fn the_delta_method_is_its_formula() {
        let fitted = Lognormal::try_new(1.0, 0.2, 0.5).unwrap();
        let (low, high) = delta(&fitted, 86, 2.5);
        assert!((low - LOW).abs() < 1e-12, "{low}");
        assert!((high - HIGH).abs() < 1e-12, "{high}");
        assert_eq!(delta(&fitted, 86, 1.0), (0.0, 0.0));
        assert_eq!(delta(&fitted, 86, 0.5), (0.0, 0.0));
    }

    const LOW: f64 = 0.575_674_673_392_426_2;
    const HIGH: f64 = 0.735_986_294_185_030_7;

    /// For many records both are normal: 1000 values at the quantiles of a
    /// lognormal. An end of a percentile interval from 4000 samples has a
    /// standard deviation of 4 % of the half width, both ends of 3 % of the
    /// width, so that 10 % are passed once in a thousand. Without the
    /// uncertainty of beta the width is 1/sqrt(3) at two deviations.
    #[test]
    fn bootstrap_and_delta_method_agree_for_many_records() {
        let truth = Lognormal::try_new(1.0, 0.2, 0.5).unwrap();
        let n = 1000;
        let place = |k: usize| (k as f64 + 0.5) / n as f64;
        let values: Vec<f64> =
            (0..n).map(|k| truth.quantile(place(k))).collect();
        let sample = ExtendedSample::try_new(&values).unwrap();
        let method = FitMethod::MaximumLikelihood;
        let fitted = fit(&sample, 1.0, method).unwrap().distribution;
        let limits = vec![None; n];
        let values = Limited::new(&values, &limits);
        let at = |z: f64| 1.0 + libm::exp(0.2 + 0.5 * z);
        let levels = Levels([-2.0, -1.0, 0.0, 1.0, 2.0].map(at).to_vec());
        let plan = Plan::of(method, 1.0);
        let band = Band::new(&plan, &values, &fitted, (&levels, 4000, 0));
        for row in &band.rows {
            let z = normal::quantile;
            let width = |(low, high): (f64, f64)| z(high) - z(low);
            let own = width(row.bootstrap.unwrap());
            let ratio = own / width(row.delta.unwrap());
            assert!((ratio - 1.0).abs() < 0.1, "{}: {ratio}", row.im);
            let score = z(row.probability);
            let plain = 2.0 * 1.96 / (n as f64).sqrt();
            let beyond = score.abs() > 1.9;
            assert!(!beyond || own / plain > 1.5, "{}", own / plain);
        }
    }
}
