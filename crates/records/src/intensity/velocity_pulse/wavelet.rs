//! The Daubechies wavelet of order 4 (eight coefficients, support of seven).

/// Coefficients of the scaling function (Daubechies 1988, Table 1).
const SCALING: [f64; 8] = [
    0.230_377_813_308_855_2,
    0.714_846_570_552_541_5,
    0.630_880_767_929_590_4,
    -0.027_983_769_416_983_85,
    -0.187_034_811_718_881_14,
    0.030_841_381_835_986_965,
    0.032_883_011_666_982_945,
    -0.010_597_401_784_997_278,
];

/// Support of the wavelet.
const SUPPORT: usize = 7;

/// Number of values for each unit of the argument.
const FINE: usize = 1024;

/// The wavelet at the multiples of 1/1024 in 0 to 7, and its integral.
pub(super) struct Wavelet {
    values: Vec<f64>,
    integral: Vec<f64>,
}

impl Wavelet {
    pub(super) fn new() -> Self {
        let scaling = scaling_function();
        let root = std::f64::consts::SQRT_2;
        let n = SUPPORT * FINE;
        // psi(x) = sqrt(2) sum (-1)^k h(7 - k) phi(2 x - k).
        let factor = |k: usize| {
            let sign = if k.is_multiple_of(2) { root } else { -root };
            sign * SCALING[7 - k]
        };
        let value = |i| refined(&scaling, i, factor);
        let values: Vec<f64> = (0..=n).map(value).collect();
        let mut sum = 0.0;
        let mut integral = vec![0.0];
        for pair in values.windows(2) {
            sum += 0.5 * (pair[0] + pair[1]) / FINE as f64;
            integral.push(sum);
        }
        Self { values, integral }
    }

    /// Weights of the samples around a place: their sum of products with a
    /// motion, whose samples are constant for one interval, is the coefficient
    /// at `scale` intervals. Their number is odd, with the place in the
    /// middle.
    pub(super) fn weights(&self, scale: usize) -> Vec<f64> {
        let a = scale as f64;
        let root = a.sqrt();
        let half = half_width(scale) as f64;
        let weight = |j: usize| {
            let j = j as f64 - half;
            let to = at(&self.integral, (j + 0.5) / a);
            let from = at(&self.integral, (j - 0.5) / a);
            root * (to - from)
        };
        (0..2 * half_width(scale) + 1).map(weight).collect()
    }

    /// Values at the samples around a place, of unit energy.
    pub(super) fn shape(&self, scale: usize) -> Vec<f64> {
        let a = scale as f64;
        let half = half_width(scale) as f64;
        (0..2 * half_width(scale) + 1)
            .map(|j| at(&self.values, (j as f64 - half) / a) / a.sqrt())
            .collect()
    }
}

/// Number of samples on each side that the wavelet reaches.
fn half_width(scale: usize) -> usize {
    (SUPPORT * scale).div_ceil(2) + 1
}

/// Value at an argument counted from the middle of the support, between the
/// tabulated ones by a straight line; constant beyond both ends.
fn at(table: &[f64], x: f64) -> f64 {
    let x = (x + 0.5 * SUPPORT as f64) * FINE as f64;
    let last = table.len() - 1;
    if !(x > 0.0) {
        return table[0];
    }
    let i = x.floor() as usize;
    if i >= last {
        return table[last];
    }
    (table[i + 1] - table[i]).mul_add(x - i as f64, table[i])
}

/// The scaling function at the multiples of 1/1024 in 0 to 7, by its own
/// equation: phi(x) = sqrt(2) sum h(k) phi(2 x - k).
fn scaling_function() -> Vec<f64> {
    let root = std::f64::consts::SQRT_2;
    let n = SUPPORT * FINE;
    let mut phi = vec![0.0; n + 1];
    // At the whole numbers 1 to 6: the fixed point of the equation, whose
    // sum is 1. Other eigenvalues are at most 1/2.
    let mut whole = [0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    for _ in 0..80 {
        let mut next = [0.0; 8];
        for (i, value) in next.iter_mut().enumerate() {
            for (k, h) in SCALING.iter().enumerate() {
                let from = (2 * i).checked_sub(k).filter(|m| *m < 8);
                *value += root * h * from.map_or(0.0, |m| whole[m]);
            }
        }
        let sum = next.iter().fold(0.0, |s, x| s + x);
        whole = next.map(|x| x / sum);
    }
    for (i, value) in whole.iter().enumerate() {
        phi[i * FINE] = *value;
    }
    let mut step = FINE;
    while step > 1 {
        step /= 2;
        // The odd multiples of the step from the multiples of twice it.
        for i in (step..n).step_by(2 * step) {
            phi[i] = refined(&phi, i, |k| root * SCALING[k]);
        }
    }
    phi
}

/// Sum of `factor(k)` phi(2 x - k) at the place `i` of x in a table of phi.
fn refined(phi: &[f64], i: usize, factor: impl Fn(usize) -> f64) -> f64 {
    (0..SCALING.len()).fold(0.0, |sum, k| {
        let from = (2 * i).checked_sub(k * FINE).and_then(|m| phi.get(m));
        factor(k).mul_add(from.copied().unwrap_or(0.0), sum)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_wavelet_is_orthonormal_and_has_four_vanishing_moments() {
        let w = Wavelet::new();
        let fine = FINE as f64;
        let integral = |f: &dyn Fn(usize) -> f64| {
            (0..w.values.len()).fold(0.0, |s, i| s + f(i) / fine)
        };
        assert!((integral(&|i| w.values[i] * w.values[i]) - 1.0).abs() < 1e-6);
        for moment in 0..4 {
            let m = integral(&|i| {
                w.values[i]
                    * libm::pow(i as f64 / fine - 3.5, f64::from(moment))
            });
            assert!(m.abs() < 1e-6, "moment {moment}: {m}");
        }
        // Shifted by a whole number it is orthogonal to itself.
        let shifted = integral(&|i| {
            w.values.get(i + FINE).map_or(0.0, |v| v * w.values[i])
        });
        assert!(shifted.abs() < 1e-6, "{shifted}");
    }

    #[test]
    fn a_wavelet_has_its_own_coefficient() {
        let w = Wavelet::new();
        for scale in [20, 173] {
            let product = w
                .weights(scale)
                .iter()
                .zip(w.shape(scale))
                .fold(0.0, |s, (a, b)| s + a * b);
            assert!((product - 1.0).abs() < 2e-3, "{scale}: {product}");
        }
    }
}
