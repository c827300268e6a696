//! What the suite is conditioned on: two moments of each quantity.

use super::attenuation::QUANTITIES;

/// Geometric mean, in g, m/s or s, and standard deviation of the natural
/// logarithm of PGA, of the spectral accelerations at the other periods, of
/// PGV and of D5-75, over the study components of 86 recorded ordinary pairs
/// of PEER's database, without further processing. They are all that this
/// program knows of those records.
pub(super) const RECORDED: [[f64; 2]; QUANTITIES] = [
    [0.3494, 0.524],
    [0.6010, 0.586],
    [0.6928, 0.556],
    [0.7456, 0.552],
    [0.7432, 0.564],
    [0.7292, 0.603],
    [0.6175, 0.683],
    [0.4363, 0.797],
    [0.3350, 0.775],
    [0.2022, 0.800],
    [0.1187, 0.840],
    [0.0611, 0.871],
    [0.0381, 0.919],
    [0.0248, 0.940],
    [0.0111, 1.017],
    [0.0057, 1.035],
    [0.3063, 0.597],
    [6.7559, 0.599],
];

/// The affine transformation of logarithms that gives a sample the recorded
/// means and standard deviations.
#[derive(Clone, Copy, Debug)]
pub(super) struct Conditioning {
    /// Of each quantity: mean of the sample, mean wanted, stretch.
    rows: [[f64; 3]; QUANTITIES],
}

impl Conditioning {
    /// For a sample of logarithms, one row a motion.
    pub(super) fn of(sample: &[[f64; QUANTITIES]]) -> Self {
        let mut rows = [[0.0; 3]; QUANTITIES];
        for (k, row) in rows.iter_mut().enumerate() {
            let values: Vec<f64> = sample.iter().map(|v| v[k]).collect();
            let [mean, deviation] = moments(&values);
            let [middle, wanted] = RECORDED[k];
            *row = [mean, libm::log(middle), wanted / deviation];
        }
        Self { rows }
    }

    /// The logarithms of one motion, transformed.
    pub(super) fn apply(
        &self,
        values: &[f64; QUANTITIES],
    ) -> [f64; QUANTITIES] {
        let mut out = *values;
        for (x, [from, to, stretch]) in out.iter_mut().zip(&self.rows) {
            *x = to + stretch * (*x - from);
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
