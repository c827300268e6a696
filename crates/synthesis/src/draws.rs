//! Random numbers: one stream for each purpose, the same bits everywhere.

use std::f64::consts::PI;

use rocking_statistics::streams::{self, Streams};

/// A stream of random numbers, determined by its name and its index.
pub(super) struct Deviates(streams::Stream);

impl Deviates {
    /// Stream number `index` of the suite `name`.
    pub(super) fn new(name: &str, index: u64) -> Self {
        Self(Streams::new(name, 0).stream(index))
    }

    /// Uniform on [low, high).
    pub(super) fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.uniform()
    }

    /// `count` independent standard normals, by the transformation of Box
    /// and Muller. (The ziggurat of `rand_distr` calls the platform's
    /// logarithm in its tail, so its bits may differ between systems.)
    pub(super) fn normals(&mut self, count: usize) -> Vec<f64> {
        let mut out = Vec::with_capacity(count + 1);
        while out.len() < count {
            // 1 - u is in (0, 1]: the logarithm is finite.
            let u = 1.0 - self.0.uniform();
            let radius = (-2.0 * libm::log(u)).sqrt();
            let (sin, cos) = libm::sincos(2.0 * PI * self.0.uniform());
            out.push(radius * cos);
            out.push(radius * sin);
        }
        out.truncate(count);
        out
    }
}

/// Lower Cholesky factor of a correlation matrix given by the rows of its
/// strict lower triangle; `None` if it is not positive definite.
pub(super) fn cholesky(lower: &[impl AsRef<[f64]>]) -> Option<Vec<Vec<f64>>> {
    let mut factor: Vec<Vec<f64>> = Vec::with_capacity(lower.len());
    for row in lower {
        let row = row.as_ref();
        let mut new: Vec<f64> = Vec::with_capacity(row.len() + 1);
        for (j, rho) in row.iter().enumerate() {
            let done = dot(&new, &factor[j][..j]);
            new.push((rho - done) / factor[j][j]);
        }
        let rest = 1.0 - dot(&new, &new);
        if !(rest > 0.0) {
            return None;
        }
        new.push(rest.sqrt());
        factor.push(new);
    }
    Some(factor)
}

/// Correlated standard normals: `factor` times `independent`.
pub(super) fn correlate(factor: &[Vec<f64>], independent: &[f64]) -> Vec<f64> {
    factor.iter().map(|row| dot(row, independent)).collect()
}

/// Sum of products over the shorter of the two, in order.
pub(super) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).fold(0.0, |sum, (x, y)| x.mul_add(*y, sum))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normals_have_the_moments_of_the_normal_distribution() {
        let z = Deviates::new("moments", 3).normals(200_000);
        let n = z.len() as f64;
        let moment = |k: i32| {
            z.iter().fold(0.0, |s, x| s + libm::pow(*x, f64::from(k))) / n
        };
        // Five standard errors: sqrt(1/n), sqrt(2/n), sqrt(96/n).
        assert!(moment(1).abs() < 5.0 / n.sqrt());
        assert!((moment(2) - 1.0).abs() < 5.0 * (2.0 / n).sqrt());
        assert!((moment(4) - 3.0).abs() < 5.0 * (96.0 / n).sqrt());
    }

    #[test]
    fn streams_differ_by_index_and_by_name() {
        let first = |name, index| Deviates::new(name, index).uniform(0.0, 1.0);
        assert_eq!(first("a", 0), first("a", 0));
        assert_ne!(first("a", 0), first("a", 1));
        assert_ne!(first("a", 0), first("b", 0));
    }

    #[test]
    fn cholesky_of_two_and_refusal() {
        let factor = cholesky(&[vec![], vec![0.6]]).expect("definite");
        assert_eq!(factor[1], vec![0.6, 0.8]);
        assert!(cholesky(&[vec![], vec![1.0]]).is_none());
    }
}
