//! Figures 15 to 18.

use super::Heading;
use crate::paper::Intensity;
use crate::table::{Table, number};
use rocking::statistics::normal;

/// Empirical and fitted fragilities.
#[derive(Debug, Clone, PartialEq)]
pub struct Fragilities {
    /// The words.
    pub heading: Heading,
    /// One panel an intensity measure: (a) PGA, (b) PGV.
    pub panels: Vec<FragilityPanel>,
}

/// One intensity measure.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityPanel {
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// The thresholds, a colour each.
    pub thresholds: Vec<Threshold>,
}

/// One demand threshold.
#[derive(Debug, Clone, PartialEq)]
pub struct Threshold {
    /// Demand, peak |theta|/alpha.
    pub edp: f64,
    /// Capacities of all records, +infinity where the threshold was never
    /// reached; the ECDF divides by the length.
    pub sample: Vec<f64>,
    /// Fitted curves, a dash each.
    pub curves: Vec<Fitted>,
}

/// How a fitted fragility was obtained.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Estimator {
    /// Lognormal fitted to the unshifted sample.
    Usfl,
    /// Lognormal fitted to the shifted sample.
    Ssfl,
    /// The unshifted fit transformed by Eq. 7.
    Usfl7,
}

impl Estimator {
    /// The paper's abbreviation.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Usfl => "USFL",
            Self::Ssfl => "SSFL",
            Self::Usfl7 => "USFL7",
        }
    }
}

/// A fitted fragility, or why there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// How it was obtained.
    pub estimator: Estimator,
    /// The curve; none where the fit or Eq. 7 is not defined.
    pub curve: Option<Lognormal>,
}

/// A lognormal distribution of IM - shift.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Lognormal {
    /// ln of the median of IM - shift.
    pub ln_median: f64,
    /// Standard deviation of ln(IM - shift).
    pub dispersion: f64,
    /// IM_R, or zero.
    pub shift: f64,
}

impl Lognormal {
    /// Probability of exceeding the threshold at `im`.
    ///
    /// ```
    /// use rocking_validation::draw::figures::data::Lognormal;
    /// let fit = Lognormal { ln_median: 0.0, dispersion: 0.5, shift: 1.0 };
    /// assert_eq!(fit.probability(2.0), 0.5);
    /// assert_eq!(fit.probability(0.9), 0.0);
    /// ```
    #[must_use]
    pub fn probability(&self, im: f64) -> f64 {
        let excess = im - self.shift;
        if excess.is_nan() || excess <= 0.0 {
            return 0.0;
        }
        let z = (libm::log(excess) - self.ln_median) / self.dispersion;
        normal::cdf(z)
    }
}

/// The constant c of Eq. 7 compared, against a benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct ByConstant {
    /// The words.
    pub heading: Heading,
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// Demand threshold.
    pub edp: f64,
    /// (a) untrimmed, (b) trimmed.
    pub panels: Vec<ByConstantPanel>,
}

/// One way of fitting.
#[derive(Debug, Clone, PartialEq)]
pub struct ByConstantPanel {
    /// Panel title: `untrimmed MLE`.
    pub title: String,
    /// The SSFL fragility.
    pub benchmark: Option<Lognormal>,
    /// Capacities for the ECDF, or nothing.
    pub sample: Vec<f64>,
    /// USFL7 by c.
    pub curves: Vec<ConstantCurve>,
}

/// One constant.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstantCurve {
    /// The constant.
    pub c: f64,
    /// USFL7; none where Eq. 7 is not defined.
    pub curve: Option<Lognormal>,
}

impl Fragilities {
    /// `panel,im_kind,edp,curve,quantity,value`: the sample (`ecdf`), and
    /// the parameters of each fitted curve.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "panel", "im_kind", "edp", "curve", "quantity", "value",
        ]);
        for (i, panel) in self.panels.iter().enumerate() {
            for threshold in &panel.thresholds {
                let mut row = |curve: &str, quantity: &str, value| {
                    table.row([
                        super::letter(i),
                        panel.intensity.name().into(),
                        number(threshold.edp),
                        curve.into(),
                        quantity.into(),
                        number(value),
                    ]);
                };
                for im in &threshold.sample {
                    row("ECDF", "im", *im);
                }
                for fit in &threshold.curves {
                    parameters(fit.curve.as_ref(), |quantity, value| {
                        row(fit.estimator.name(), quantity, value);
                    });
                }
            }
        }
        table.finish()
    }
}

impl ByConstant {
    /// `panel,title,im_kind,edp,curve,c,quantity,value`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "panel", "title", "im_kind", "edp", "curve", "c", "quantity",
            "value",
        ]);
        for (i, panel) in self.panels.iter().enumerate() {
            let mut row = |curve: &str, c: f64, quantity: &str, value| {
                table.row([
                    super::letter(i),
                    panel.title.clone(),
                    self.intensity.name().into(),
                    number(self.edp),
                    curve.into(),
                    number(c),
                    quantity.into(),
                    number(value),
                ]);
            };
            for im in &panel.sample {
                row("ECDF", f64::NAN, "im", *im);
            }
            parameters(panel.benchmark.as_ref(), |quantity, value| {
                row("SSFL", f64::NAN, quantity, value);
            });
            for fit in &panel.curves {
                parameters(fit.curve.as_ref(), |quantity, value| {
                    row("USFL7", fit.c, quantity, value);
                });
            }
        }
        table.finish()
    }
}

/// Hands on each parameter of a fit; NaN for a fit that is not defined.
fn parameters(fit: Option<&Lognormal>, mut row: impl FnMut(&str, f64)) {
    let of = |value: fn(&Lognormal) -> f64| fit.map_or(f64::NAN, value);
    row("ln_median", of(|f| f.ln_median));
    row("dispersion", of(|f| f.dispersion));
    row("shift", of(|f| f.shift));
}
