//! Curves of the fragilities' figures, and the columns of their CSV.

use rocking_statistics::Lognormal;

use rocking_common::paper::Intensity;
use rocking_common::table::number;
use rocking_draw::axis::Axis;
use rocking_draw::colour::{Ink, Pen};
use rocking_draw::figures::{Column, Look, Of, Series};
use rocking_draw::markup::plain;
use rocking_draw::panel::Marker;

/// Columns of the CSV: the curve, the parameters of a fitted curve, a point of
/// the curve and its band at this point.
pub(super) const KEYS: [&str; 6] =
    ["im", "edp", "curve", "ln_median", "dispersion", "shift"];
pub(super) const NUMBERS: [Column; 4] = [
    ("intensity", Of::X),
    ("probability", Of::Y),
    ("band_low", Of::Low),
    ("band_high", Of::High),
];

pub(super) fn exceedance() -> Axis {
    Axis::linear(0.0, 1.0, 5).label("probability of exceedance")
}

/// `count` steps from one end to the other.
pub(super) fn along((low, high): (f64, f64), count: u32) -> Vec<f64> {
    let step = (high - low) / f64::from(count);
    (0..=count).map(|k| step.mul_add(f64::from(k), low)).collect()
}

/// The cells that name a curve: its threshold, its words and its parameters.
pub(super) fn keys(
    (intensity, edp): (Intensity, f64),
    curve: &str,
    fit: Option<&Lognormal>,
) -> [String; 6] {
    let of =
        |value: fn(&Lognormal) -> f64| number(fit.map_or(f64::NAN, value));
    [
        intensity.name().into(),
        number(edp),
        curve.into(),
        of(Lognormal::log_mean),
        of(Lognormal::dispersion),
        of(Lognormal::shift),
    ]
}

/// The dots of the sample: at each datum the share of the data up to it.
pub(super) fn empirical(at: (Intensity, f64), sample: &[f64]) -> Series {
    let mut x = sample.to_vec();
    x.sort_by(f64::total_cmp);
    let n = x.len() as f64;
    let y = (1..=x.len()).map(|k| k as f64 / n).collect();
    let dots = Look::marks(Marker::Dot, 1.7, Ink::Muted);
    let words = "empirical fragility (ECDF)";
    Series::of(dots, x, y).labelled(words).keyed(keys(at, "ECDF", None))
}

/// A fitted curve at these intensities; a row without a point if the fit is not
/// defined.
pub(super) fn fitted(
    at: (Intensity, f64),
    (name, pen): (&str, Pen),
    fit: Option<&Lognormal>,
    grid: &[f64],
) -> Series {
    let (x, y) = fit.map_or((vec![f64::NAN], vec![f64::NAN]), |fit| {
        (grid.to_vec(), grid.iter().map(|x| fit.cdf(*x)).collect())
    });
    let curve = Series::of(Look::line(pen), x, y).labelled(name);
    curve.keyed(keys(at, &plain(name), fit))
}

/// The 97 % quantile of the data, or the last finite datum below it.
pub(super) fn most_of(sample: &[f64]) -> Option<f64> {
    let mut sorted = sample.to_vec();
    sorted.sort_by(f64::total_cmp);
    let most = (0.97 * sorted.len() as f64) as usize;
    let upper = &sorted[..sorted.len().min(most + 1)];
    upper.iter().rev().find(|x| x.is_finite()).copied()
}
