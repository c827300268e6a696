//! The conditions of a suite: four moments of each quantity, and medians of
//! seven ratios to PGA.
//!
//! Geometric mean, in g, m/s or s, standard deviation of the natural
//! logarithm, and its correlation with the logarithms of PGA and PGV: of PGA,
//! the spectral accelerations at the other periods, of PGV and of D5-75, over
//! the study components of recorded pairs of PEER's database, without further
//! processing. This program contains nothing else of those records.

use std::ops::Range;

use rocking_statistics::normal;

use crate::attenuation::{PGV, QUANTITIES};
use crate::draws::dot;

/// Logarithms of the quantities of both components of a pair.
pub(super) type Components = [[f64; QUANTITIES]; 2];

/// Four moments of each quantity.
pub(super) type Moments = [[f64; 4]; QUANTITIES];

/// Of 86 ordinary pairs.
pub(super) const ORDINARY: Moments = [
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

/// Of 44 pulse-type pairs.
pub(super) const PULSE: Moments = [
    [0.4462, 0.482, 1.000, 0.349],
    [0.6636, 0.598, 0.912, 0.148],
    [0.8049, 0.605, 0.825, 0.148],
    [0.8544, 0.543, 0.812, 0.303],
    [0.8518, 0.498, 0.829, 0.362],
    [0.8189, 0.520, 0.780, 0.501],
    [0.8358, 0.499, 0.754, 0.456],
    [0.7181, 0.543, 0.564, 0.652],
    [0.5872, 0.497, 0.463, 0.667],
    [0.3831, 0.547, 0.230, 0.793],
    [0.2841, 0.616, 0.164, 0.833],
    [0.1752, 0.709, -0.053, 0.723],
    [0.1004, 0.829, -0.068, 0.688],
    [0.0680, 0.907, -0.086, 0.636],
    [0.0304, 0.998, -0.111, 0.599],
    [0.0158, 1.006, -0.100, 0.600],
    [0.6350, 0.488, 0.349, 1.000],
    [4.9180, 0.533, -0.172, -0.103],
];

/// Quantities whose geometric mean over PGA has the recorded median: six
/// groups of spectral accelerations at six neighbouring periods, the first
/// from 0.2 to 1 s and the last from 1 to 5 s, and PGV. These groups cover the
/// average spectral acceleration of blocks with p of 6 to 1 rad/s.
const RATIOS: [Range<usize>; 7] =
    [3..9, 4..10, 5..11, 6..12, 7..13, 8..14, PGV..PGV + 1];

/// Median of each of these ratios over its geometric mean, of the ordinary
/// and of the pulse-type pairs. Above 1, a few small ratios are far from the
/// others: an oscillator amplifies the ground's motion only so far.
pub(super) const ORDINARY_MEDIANS: [f64; 7] =
    [1.071, 1.095, 1.116, 1.142, 1.147, 1.106, 1.079];
pub(super) const PULSE_MEDIANS: [f64; 7] =
    [1.063, 1.054, 1.062, 1.154, 1.162, 1.129, 1.065];

/// Gives the ratios to PGA of a sample of logarithms, the first component of
/// each pair, these medians over their geometric means, which they keep: a
/// ratio becomes the quantile of z + q (1 - z^2), scaled, at its rank, where z
/// is standard normal. One ratio after the other, so that an earlier one is
/// disturbed a little.
pub(super) fn bend(pairs: &mut [Components], medians: &[f64; 7]) {
    for (range, median) in RATIOS.into_iter().zip(medians) {
        let ratio = |v: &[f64; QUANTITIES]| {
            let sum = v[range.clone()].iter().fold(0.0, |s, x| s + x);
            sum / range.len() as f64 - v[0]
        };
        let first: Vec<f64> = pairs.iter().map(|p| ratio(&p[0])).collect();
        let [mean, deviation] = moments(&first);
        let q = libm::log(*median) / deviation;
        for v in pairs.iter_mut().flatten() {
            let own = ratio(v);
            let below = first.iter().filter(|x| **x < own).count();
            let rank = below.min(first.len() - 1) as f64 + 0.5;
            let z = normal::quantile(rank / first.len() as f64);
            let bent = (1.0 - 2.0 * q * q).sqrt() * z + q * (1.0 - z * z);
            for x in &mut v[range.clone()] {
                *x += mean + deviation * bent - own;
            }
        }
    }
}

/// Slopes of a quantity of the recorded suite on the two scores, and the
/// standard deviation of the rest.
fn slopes(recorded: &Moments, k: usize) -> [f64; 3] {
    let [_, deviation, with_pga, with_pgv] = recorded[k];
    let rho = recorded[PGV][2];
    let second = (with_pgv - rho * with_pga) / (1.0 - rho * rho).sqrt();
    let rest = 1.0 - with_pga * with_pga - second * second;
    let rest = if rest > 0.0 { rest.sqrt() } else { 0.0 };
    [with_pga, second, rest].map(|x| deviation * x)
}

/// Gives a sample of logarithms, the first component of each pair, the
/// recorded moments by an affine transformation, which takes the second ones
/// along: what PGA and PGV do not explain of a quantity keeps its
/// correlations.
///
/// The two scores have mean 0, standard deviation 1 and no correlation. The
/// first is the score of PGA, the second the score of the part of PGV that PGA
/// does not explain.
pub(super) fn condition(pairs: &mut [Components], recorded: &Moments) {
    let column = |k: usize| {
        let mut values: Vec<f64> = pairs.iter().map(|p| p[0][k]).collect();
        let [mean, _] = moments(&values);
        values.iter_mut().for_each(|x| *x -= mean);
        (mean, values)
    };
    let slope = |scores: &[f64], values: &[f64]| {
        dot(scores, values) / (values.len() as f64 - 1.0)
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
    // Of each quantity of the sample: mean, slopes on the two scores, and the
    // stretch of the rest that the scores do not explain.
    let rows: [[f64; 4]; QUANTITIES] = std::array::from_fn(|k| {
        let (mean, values) = column(k);
        let [one, other] = [&first, &second].map(|z| slope(z, &values));
        let rest = less(&values, one, &first);
        let [_, rest] = moments(&less(&rest, other, &second));
        // Only rounding is left of PGA and of PGV.
        let is_score = k == 0 || k == PGV;
        let stretch = slopes(recorded, k)[2] / rest;
        [mean, one, other, if is_score { 0.0 } else { stretch }]
    });
    for values in pairs.iter_mut().flatten() {
        let [mean, deviation, ..] = rows[0];
        let first = (values[0] - mean) / deviation;
        let [mean, slope, deviation, _] = rows[PGV];
        let second = (values[PGV] - mean - slope * first) / deviation;
        for (k, x) in values.iter_mut().enumerate() {
            let [mean, one, other, stretch] = rows[k];
            let rest = *x - mean - one * first - other * second;
            let [slope, next, _] = slopes(recorded, k);
            *x = libm::log(recorded[k][0])
                + slope * first
                + next * second
                + stretch * rest;
        }
    }
}

/// Mean and standard deviation.
pub(super) fn moments(values: &[f64]) -> [f64; 2] {
    let n = values.len() as f64;
    let mean = values.iter().fold(0.0, |s, x| s + x) / n;
    let squares = values.iter().fold(0.0, |s, x| s + (x - mean) * (x - mean));
    [mean, (squares / (n - 1.0)).sqrt()]
}
