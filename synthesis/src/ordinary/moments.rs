//! What the suite is conditioned on: four moments of each quantity.

use super::attenuation::{PGV, QUANTITIES};
use crate::draws::dot;

/// Geometric mean, in g, m/s or s, standard deviation of the natural
/// logarithm, and its correlation with those of PGA and PGV, of PGA, of the
/// spectral accelerations at the other periods, of PGV and of D5-75, over the
/// study components of 86 recorded ordinary pairs of PEER's database, without
/// further processing. They are all that this program knows of those records.
pub(super) const RECORDED: [[f64; 4]; QUANTITIES] = [
    [0.3494, 0.524, 1.000, 0.695],
    [0.6010, 0.586, 0.851, 0.449],
    [0.6928, 0.556, 0.807, 0.416],
    [0.7456, 0.552, 0.869, 0.511],
    [0.7432, 0.564, 0.853, 0.679],
    [0.7263, 0.603, 0.789, 0.820],
    [0.6175, 0.683, 0.693, 0.868],
    [0.4363, 0.797, 0.667, 0.885],
    [0.3350, 0.775, 0.594, 0.878],
    [0.2022, 0.800, 0.520, 0.881],
    [0.1187, 0.840, 0.431, 0.855],
    [0.0611, 0.871, 0.372, 0.805],
    [0.0381, 0.919, 0.277, 0.708],
    [0.0248, 0.940, 0.292, 0.692],
    [0.0111, 1.017, 0.270, 0.635],
    [0.0057, 1.035, 0.274, 0.647],
    [0.3063, 0.597, 0.695, 1.000],
    [6.7559, 0.599, -0.128, -0.007],
];

/// The affine transformation of logarithms that gives a sample the recorded
/// moments: what PGA and PGV do not explain of a quantity keeps its
/// correlations.
///
/// Scores have mean 0, standard deviation 1 and no correlation: one is that of
/// PGA, the other is of what PGA does not explain of PGV.
#[derive(Clone, Debug)]
pub(super) struct Conditioning {
    /// Of each quantity of the sample: mean, and slopes on the two scores.
    rows: [[f64; 3]; QUANTITIES],
    /// Stretch of what the scores do not explain.
    stretch: [f64; QUANTITIES],
}

/// Slopes of a quantity of the recorded suite on the two scores, and the
/// standard deviation of the rest.
fn recorded(k: usize) -> [f64; 3] {
    let [_, deviation, with_pga, with_pgv] = RECORDED[k];
    let rho = RECORDED[PGV][2];
    let second = (with_pgv - rho * with_pga) / (1.0 - rho * rho).sqrt();
    let rest = 1.0 - with_pga * with_pga - second * second;
    let rest = if rest > 0.0 { rest.sqrt() } else { 0.0 };
    [with_pga, second, rest].map(|x| deviation * x)
}

impl Conditioning {
    /// For a sample of logarithms, one row a motion.
    pub(super) fn of(sample: &[[f64; QUANTITIES]]) -> Self {
        let column = |k: usize| {
            let values: Vec<f64> = sample.iter().map(|v| v[k]).collect();
            let [mean, _] = moments(&values);
            (mean, values.iter().map(|x| x - mean).collect::<Vec<_>>())
        };
        let slope = |scores: &[f64], values: &[f64]| {
            dot(scores, values) / (sample.len() as f64 - 1.0)
        };
        let less = |values: &[f64], slope: f64, scores: &[f64]| {
            let rest = values.iter().zip(scores).map(|(x, z)| x - slope * z);
            rest.collect::<Vec<f64>>()
        };
        let score = |values: &[f64]| {
            let [_, deviation] = moments(values);
            values.iter().map(|x| x / deviation).collect::<Vec<f64>>()
        };
        let first = score(&column(0).1);
        let pgv = column(PGV).1;
        let second = score(&less(&pgv, slope(&first, &pgv), &first));
        let (mut rows, mut stretch) = ([[0.0; 3]; QUANTITIES], [0.0; QUANTITIES]);
        for k in 0..QUANTITIES {
            let (mean, values) = column(k);
            let slopes = [&first, &second].map(|z| slope(z, &values));
            rows[k] = [mean, slopes[0], slopes[1]];
            let rest = less(&values, slopes[0], &first);
            let [_, rest] = moments(&less(&rest, slopes[1], &second));
            // Nothing but rounding is left of PGA and of PGV.
            if k != 0 && k != PGV {
                stretch[k] = recorded(k)[2] / rest;
            }
        }
        Self { rows, stretch }
    }

    /// The logarithms of one motion, transformed.
    pub(super) fn apply(
        &self,
        values: &[f64; QUANTITIES],
    ) -> [f64; QUANTITIES] {
        let [mean, deviation, _] = self.rows[0];
        let first = (values[0] - mean) / deviation;
        let [mean, slope, deviation] = self.rows[PGV];
        let second = (values[PGV] - mean - slope * first) / deviation;
        let mut out = *values;
        for (k, x) in out.iter_mut().enumerate() {
            let [mean, one, other] = self.rows[k];
            let rest = *x - mean - one * first - other * second;
            let [slope, next, _] = recorded(k);
            *x = libm::log(RECORDED[k][0])
                + slope * first
                + next * second
                + self.stretch[k] * rest;
        }
        out
    }
}

/// Mean and standard deviation.
pub(super) fn moments(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().fold(0.0, |s, x| s + x) / n;
    let squares = values.iter().fold(0.0, |s, x| s + (x - mean) * (x - mean));
    [mean, (squares / (n - 1.0)).sqrt()]
}
