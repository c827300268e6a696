//! Fourier amplitudes at 0.25 to 20 Hz, and the mean period.

use std::f64::consts::PI;

use rocking::stop;

/// Least and largest frequency of the mean period, in Hz.
const BAND_HZ: (f64, f64) = (0.25, 20.0);

/// Least duration (s) of the samples, after zeros are appended.
const LEAST_S: f64 = 20.0;

/// Fourier coefficients inside the band.
pub(super) struct Spectrum {
    hz: Vec<f64>,
    coefficients: Vec<(f64, f64)>,
}

impl Spectrum {
    pub(super) fn of(samples: &[f64], dt_s: f64) -> Self {
        let least = (LEAST_S / dt_s).ceil() as usize;
        let n = samples.len().max(least).next_power_of_two();
        let mut values: Vec<(f64, f64)> =
            samples.iter().map(|a| (*a, 0.0)).collect();
        values.resize(n, (0.0, 0.0));
        Transform::new(n).apply(&mut values);
        let step = 1.0 / (n as f64 * dt_s);
        let (mut hz, mut coefficients) = (Vec::new(), Vec::new());
        for (k, value) in values.iter().enumerate().take(n / 2 + 1) {
            let f = k as f64 * step;
            if f >= BAND_HZ.0 && f <= BAND_HZ.1 {
                hz.push(f);
                coefficients.push(*value);
            }
        }
        Self { hz, coefficients }
    }

    /// Mean period in s of this motion, or of `cos` times this motion plus
    /// `sin` times another.
    pub(super) fn mean_period_s(
        &self,
        rotation: Option<(&Self, f64, f64)>,
    ) -> Option<f64> {
        let (mut over, mut under) = (0.0, 0.0);
        for (k, (f, c)) in self.hz.iter().zip(&self.coefficients).enumerate() {
            let (re, im) = match rotation {
                None => *c,
                Some((other, cos, sin)) => {
                    let d = other.coefficients[k];
                    (cos * c.0 + sin * d.0, cos * c.1 + sin * d.1)
                }
            };
            let power = re.mul_add(re, im * im);
            over += power / f;
            under += power;
        }
        (under > 0.0).then(|| over / under)
    }
}

/// The discrete Fourier transform of a power of two of values (Cooley and
/// Tukey 1965).
pub(super) struct Transform {
    /// Factors of every stage: 1, then 2, 4 and so on.
    factors: Vec<Vec<(f64, f64)>>,
}

impl Transform {
    /// For `size` values, a power of two.
    pub(super) fn new(size: usize) -> Self {
        let stage = |bit: u32| {
            stop::point();
            let half = 1_usize << bit;
            // Each factor from its own angle: errors don't add up.
            let factor = |k: usize| {
                let (sin, cos) = libm::sincos(-PI * k as f64 / half as f64);
                (cos, sin)
            };
            (0..half).map(factor).collect()
        };
        Self { factors: (0..size.trailing_zeros()).map(stage).collect() }
    }

    /// Transforms in place; does nothing to values of another size.
    pub(super) fn apply(&self, values: &mut [(f64, f64)]) {
        let n = values.len();
        let bits = self.factors.len();
        if n != 1 << bits || bits == 0 {
            return;
        }
        for i in 0..n {
            let j = i.reverse_bits() >> (usize::BITS as usize - bits);
            if i < j {
                values.swap(i, j);
            }
        }
        for factors in &self.factors {
            stop::point();
            for block in values.chunks_exact_mut(2 * factors.len()) {
                let (low, high) = block.split_at_mut(factors.len());
                for ((a, b), (cos, sin)) in
                    low.iter_mut().zip(high).zip(factors)
                {
                    let turned =
                        (b.0 * cos - b.1 * sin, b.0 * sin + b.1 * cos);
                    *b = (a.0 - turned.0, a.1 - turned.1);
                    *a = (a.0 + turned.0, a.1 + turned.1);
                }
            }
        }
    }
}
