//! Strong velocity pulses in a pair of components, by the algorithm of Shahi
//! and Baker ("An efficient algorithm to identify strong-velocity pulses in
//! multicomponent ground motions", BSSA 104, 2014), with the constants of
//! the authors' own program.
//!
//! The velocities of both components are transformed with the Daubechies
//! wavelet of order 4 at periods from 0.25 to 15 s. Where the sum of the
//! squares of both coefficients is largest there is a candidate, in the
//! direction in which the coefficient is largest; its period is 1.4 times
//! the wavelet's scale. Ten wavelets of that scale, each within 0.4 scales of
//! the first, make the pulse. Five candidates are tried, each more than 0.4
//! scales from those before.
//!
//! With PC = 0.63 PGV_r/PGV + 0.777 E_r/E, where r is the motion without the
//! pulse and E the sum of squared velocities, P = (PC - 1.208421) /
//! 0.2462717 and V = (PGV - 11.58861)/18.88015, PGV in cm/s, the indicator is
//! -7.817 - 0.5679 P^2 - 0.1516 V^2 - 3.0253 P - 1.7396 V - 2.7156 P V.
//! A candidate is a pulse if it is positive, and if it is early: when the
//! pulse has 5 % of its squared velocity, the motion has less than 17 % of
//! its own.
//!
//! Two details differ from that program, without effect on its results:
//! velocities are integrated by trapezoids, and energies are sums over
//! samples instead of over first-level wavelet coefficients.

mod wavelet;

use super::IntensityError;
use super::fourier::Transform;
use rocking::accelerogram::Accelerogram;
use wavelet::Wavelet;

/// Periods that are searched, in s.
const PERIODS_S: (f64, f64) = (0.25, 15.0);

/// Period over scale: the wavelet's spectrum peaks at 5/7 per scale.
const PERIOD_OVER_SCALE: f64 = 1.4;

/// Steps between the least and the largest scale.
const SCALES: f64 = 50.0;

/// Number of candidates that are tried.
const CANDIDATES: usize = 5;

/// Number of wavelets in a pulse.
const WAVELETS: usize = 10;

/// Half-width of the neighbourhood of a wavelet, in scales.
const NEIGHBOURHOOD: f64 = 0.4;

/// A candidate for a pulse.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Candidate {
    /// Direction from the first component towards the second, in -pi/2 to
    /// pi/2.
    pub direction_rad: f64,
    /// Period of the pulse.
    pub period_s: f64,
    /// Time of its first wavelet.
    pub time_s: f64,
    /// Peak velocity of the motion in that direction.
    pub pgv_m_s: f64,
    /// Peak velocity without the pulse over that with it.
    pub pgv_ratio: f64,
    /// Squared velocities without the pulse over those with it.
    pub energy_ratio: f64,
    /// The pulse indicator; positive for pulses.
    pub indicator: f64,
    /// Whether the pulse comes too late for directivity.
    pub late: bool,
}

impl Candidate {
    /// Whether it is a pulse: a positive indicator, and early.
    pub fn is_pulse(&self) -> bool {
        self.indicator > 0.0 && !self.late
    }
}

/// The first of the candidates that is a pulse.
pub fn pulse(candidates: &[Candidate]) -> Option<&Candidate> {
    candidates.iter().find(|c| c.is_pulse())
}

/// The five candidates of a pair, the largest coefficient first; fewer if
/// nothing is left to search. The longer component is cut to the shorter.
///
/// # Errors
/// [`IntensityError`] for gravity that is not positive, sampling intervals
/// that differ or are above 0.17 s, or a motion without velocity.
///
/// ```
/// use rocking_records::intensity::velocity_pulse::{candidates, pulse};
/// use rocking::accelerogram::Accelerogram;
/// // One cycle of 2 s and 0.6 m/s in the first component.
/// let w = std::f64::consts::PI;
/// let cycle = |i: u32| match i {
///     300..=500 => 0.6 * w / 9.81 * libm::cos(w * 0.01 * f64::from(i - 300)),
///     _ => 0.0,
/// };
/// let a = Accelerogram::try_new("a", 0.01, (0..1000).map(cycle).collect())?;
/// let b = Accelerogram::try_new("b", 0.01, vec![0.0; 1000])?;
/// let found = candidates(&a, &b, 9.81)?;
/// let pulse = pulse(&found).expect("a pulse");
/// assert!((pulse.period_s - 2.0).abs() < 0.4);
/// assert!(pulse.direction_rad.abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn candidates(
    first: &Accelerogram,
    second: &Accelerogram,
    gravity_m_s2: f64,
) -> Result<Vec<Candidate>, IntensityError> {
    if !(gravity_m_s2 > 0.0 && gravity_m_s2.is_finite()) {
        return Err(IntensityError::Gravity(gravity_m_s2));
    }
    let (first_s, second_s) = (first.dt_s(), second.dt_s());
    if first_s != second_s {
        return Err(IntensityError::Intervals { first_s, second_s });
    }
    let dt_s = first_s;
    let least = (PERIODS_S.0 / PERIOD_OVER_SCALE / dt_s).floor();
    if !(least >= 1.0) {
        return Err(IntensityError::Coarse(dt_s));
    }
    let largest = PERIODS_S.1 / PERIOD_OVER_SCALE / dt_s;
    let step = ((largest - least) / SCALES).ceil();
    let scales: Vec<usize> = (0..=SCALES as usize)
        .map(|k| (least + step * k as f64) as usize)
        .collect();
    let n = first.samples_g().len().min(second.samples_g().len());
    let cm_s = 100.0 * gravity_m_s2;
    let velocities = [first, second]
        .map(|r| velocity(&r.samples_g()[..n], 0.5 * dt_s * cm_s));
    let wavelet = Wavelet::new();
    let map = CoefficientMap::new(&wavelet, &velocities, &scales);
    let search = Search { wavelet, velocities, scales, dt_s };
    search.candidates(map)
}

/// Cumulative trapezoid, from rest.
fn velocity(samples: &[f64], half_interval: f64) -> Vec<f64> {
    let mut sum = 0.0;
    let later = samples.windows(2).map(|pair| {
        sum += pair[0] + pair[1];
        half_interval * sum
    });
    std::iter::once(0.0).chain(later).collect()
}

/// Coefficients of both components, by scale, then by sample.
struct CoefficientMap(Vec<Vec<(f64, f64)>>);

impl CoefficientMap {
    fn new(
        wavelet: &Wavelet,
        velocities: &[Vec<f64>; 2],
        scales: &[usize],
    ) -> Self {
        let n = velocities[0].len();
        let widest = scales.last().map_or(0, |a| 8 * a);
        let size = (n + widest).next_power_of_two();
        // Both real motions in one complex transform.
        let [first, second] = velocities;
        let both = first.iter().zip(second).map(|(a, b)| (*a, *b));
        let mut motion: Vec<(f64, f64)> = both.collect();
        motion.resize(size, (0.0, 0.0));
        let transform = Transform::new(size);
        transform.apply(&mut motion);
        let of = |scale: &usize| {
            let weights = wavelet.weights(*scale);
            let half = weights.len() / 2;
            let mut kernel = vec![(0.0, 0.0); size];
            for (j, w) in weights.iter().enumerate() {
                kernel[(j + size - half) % size].0 = *w;
            }
            transform.apply(&mut kernel);
            // Correlation: the product with the conjugate, transformed back
            // by the conjugate's transform.
            let product = motion.iter().zip(&kernel).map(|(m, k)| {
                let im = m.1 * k.0 - m.0 * k.1;
                (m.0 * k.0 + m.1 * k.1, -im)
            });
            let mut product: Vec<(f64, f64)> = product.collect();
            transform.apply(&mut product);
            let scale = 1.0 / size as f64;
            let scaled = product.iter().map(|c| (scale * c.0, -scale * c.1));
            scaled.take(n).collect()
        };
        Self(scales.iter().map(of).collect())
    }

    /// Row, column, and coefficients of the largest sum of squares.
    fn largest(&self) -> Option<(usize, usize, (f64, f64))> {
        let mut found = None;
        let mut most = 0.0;
        for (row, line) in self.0.iter().enumerate() {
            for (column, c) in line.iter().enumerate() {
                let power = c.0.mul_add(c.0, c.1 * c.1);
                if power > most {
                    (most, found) = (power, Some((row, column, *c)));
                }
            }
        }
        found
    }

    /// Sets all columns strictly within `reach` of one to zero.
    fn block(&mut self, column: usize, reach: f64) {
        for line in &mut self.0 {
            for (i, c) in line.iter_mut().enumerate() {
                if (i.abs_diff(column) as f64) < reach {
                    *c = (0.0, 0.0);
                }
            }
        }
    }
}

struct Search {
    wavelet: Wavelet,
    velocities: [Vec<f64>; 2],
    scales: Vec<usize>,
    dt_s: f64,
}

impl Search {
    fn candidates(
        &self,
        mut map: CoefficientMap,
    ) -> Result<Vec<Candidate>, IntensityError> {
        let mut found = Vec::new();
        while found.len() < CANDIDATES {
            let Some((row, column, (c, s))) = map.largest() else { break };
            let direction_rad = libm::atan(s / c);
            found.push(self.analyse(direction_rad, row, column));
            map.block(column, NEIGHBOURHOOD * self.scales[row] as f64);
        }
        if found.is_empty() {
            return Err(IntensityError::Silent);
        }
        Ok(found)
    }

    /// Extracts the pulse about a coefficient and weighs it.
    fn analyse(
        &self,
        direction_rad: f64,
        row: usize,
        column: usize,
    ) -> Candidate {
        let (sin, cos) = libm::sincos(direction_rad);
        let [a, b] = &self.velocities;
        let motion: Vec<f64> =
            a.iter().zip(b).map(|(x, y)| cos * x + sin * y).collect();
        let last = self.scales.len() - 1;
        let from = self.scales[row.saturating_sub(1)];
        let to = self.scales[(row + 1).min(last)];
        let (mut scale, mut most) = (self.scales[row], 0.0);
        for finer in from..=to {
            let weights = self.wavelet.weights(finer);
            let c = coefficient(&motion, &weights, column).abs();
            if c > most {
                (scale, most) = (finer, c);
            }
        }
        let (pulse, rest, first) = self.extract(&motion, scale, column);
        let peak = |v: &[f64]| v.iter().fold(0.0, |p: f64, x| p.max(x.abs()));
        let pgv = peak(&motion);
        let pgv_ratio = peak(&rest) / pgv;
        let energy_ratio = energy(&rest) / energy(&motion);
        let component = (0.63 * pgv_ratio + 0.777 * energy_ratio - 1.208_421)
            / 0.246_271_7;
        let size = (pgv - 11.588_61) / 18.880_15;
        let indicator = -7.817
            - 0.5679 * component * component
            - 0.1516 * size * size
            - 3.0253 * component
            - 1.7396 * size
            - 2.7156 * component * size;
        Candidate {
            direction_rad,
            period_s: PERIOD_OVER_SCALE * scale as f64 * self.dt_s,
            time_s: first as f64 * self.dt_s,
            pgv_m_s: 0.01 * pgv,
            pgv_ratio,
            energy_ratio,
            indicator,
            late: late(&pulse, &motion),
        }
    }

    /// The pulse, the rest of the motion, and the place of the first wavelet.
    fn extract(
        &self,
        motion: &[f64],
        scale: usize,
        column: usize,
    ) -> (Vec<f64>, Vec<f64>, usize) {
        let weights = self.wavelet.weights(scale);
        let shape = self.wavelet.shape(scale);
        let reach = (NEIGHBOURHOOD * scale as f64).ceil() as usize;
        let mut pulse = vec![0.0; motion.len()];
        let mut rest = motion.to_vec();
        let mut centre = column;
        for k in 0..WAVELETS {
            let end = (centre + reach).min(motion.len() - 1);
            let (mut best, mut at) = (0.0, centre);
            for place in centre.saturating_sub(reach)..=end {
                let c = coefficient(&rest, &weights, place);
                if f64::abs(c) > f64::abs(best) {
                    (best, at) = (c, place);
                }
            }
            if k == 0 {
                centre = at;
            }
            let (start, skipped) = overlap(at, shape.len());
            let both = pulse.iter_mut().zip(&mut rest).skip(start);
            for ((p, r), value) in both.zip(&shape[skipped..]) {
                *p += best * value;
                *r -= best * value;
            }
        }
        (pulse, rest, centre)
    }
}

/// Wavelet coefficient at one place; zeros outside the motion.
fn coefficient(motion: &[f64], weights: &[f64], place: usize) -> f64 {
    let (start, skipped) = overlap(place, weights.len());
    let pairs = motion.iter().skip(start).zip(&weights[skipped..]);
    pairs.fold(0.0, |sum, (v, w)| v.mul_add(*w, sum))
}

/// Place of the first sample under a table of `count` values around `place`, and
/// number of values before it.
fn overlap(place: usize, count: usize) -> (usize, usize) {
    let skipped = (count / 2).saturating_sub(place);
    (place + skipped - count / 2, skipped)
}

fn energy(velocity: &[f64]) -> f64 {
    velocity.iter().fold(0.0, |s, v| v.mul_add(*v, s))
}

/// Whether the motion has 17 % of its squared velocity when the pulse has
/// 5 % of its own.
fn late(pulse: &[f64], motion: &[f64]) -> bool {
    let (whole, all) = (energy(pulse), energy(motion));
    let (mut own, mut other) = (0.0, 0.0);
    let mut share = 0.0;
    for (p, v) in pulse.iter().zip(motion) {
        own = p.mul_add(*p, own);
        other = v.mul_add(*v, other);
        if own <= 0.05 * whole {
            share = other / all;
        }
    }
    share >= 0.17
}
