//! Comparison of the distributions of two samples.

use super::ExtendedSample;
use rocking::stop;

/// Kolmogorov and Smirnov's comparison of two samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TwoSampleTest {
    /// Largest distance of the empirical distributions.
    pub statistic: f64,
    /// Probability of one at least as large among all orders in which the
    /// values of one continuous distribution may come, exactly.
    pub p_value: f64,
}

/// Compares two samples. With ties the p-value is an upper bound.
///
/// The share of orders with a distance at least as large follows from
/// Q(i, j) = i/(i + j) Q(i - 1, j) + j/(i + j) Q(i, j - 1), one where
/// |i/n - j/m| is at least as large (Hodges, Ark. Mat. 3 (1958) 469): nothing
/// cancels, however small it is.
///
/// ```
/// use rocking_statistics::{ExtendedSample, two_sample};
/// let a = ExtendedSample::try_new(&[1.0, 2.0, 3.0])?;
/// let b = ExtendedSample::try_new(&[4.0, 5.0, 6.0])?;
/// // Two of the twenty orders keep the samples apart.
/// let found = two_sample::kolmogorov_smirnov(&a, &b);
/// assert_eq!(found.statistic, 1.0);
/// assert!((found.p_value - 0.1).abs() < 1e-15);
/// # Ok::<(), rocking_statistics::SampleError>(())
/// ```
pub fn kolmogorov_smirnov(
    a: &ExtendedSample,
    b: &ExtendedSample,
) -> TwoSampleTest {
    let (x, y) = (a.sorted(), b.sorted());
    let (n, m) = (x.len(), y.len());
    // Distances times n m are whole numbers.
    let apart = |i: usize, j: usize| (i * m).abs_diff(j * n);
    let (mut i, mut j, mut largest) = (0, 0, 0);
    while i < n && j < m {
        let least = if x[i] < y[j] { x[i] } else { y[j] };
        i += x[i..].iter().take_while(|v| **v <= least).count();
        j += y[j..].iter().take_while(|v| **v <= least).count();
        largest = largest.max(apart(i, j));
    }
    let mut share = vec![0.0; m + 1];
    for i in 0..=n {
        stop::point();
        for j in 0..=m {
            let beyond = if i + j == 0 {
                0.0
            } else {
                let all = (i + j) as f64;
                let from_i = if i > 0 { share[j] } else { 0.0 };
                let from_j = if j > 0 { share[j - 1] } else { 0.0 };
                (i as f64 * from_i + j as f64 * from_j) / all
            };
            share[j] = if apart(i, j) < largest { beyond } else { 1.0 };
        }
    }
    let statistic = largest as f64 / (n * m) as f64;
    TwoSampleTest { statistic, p_value: share[m] }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_p_value_does_not_cancel() {
        let sample = |from: u32| {
            let values: Vec<f64> = (from..from + 86).map(f64::from).collect();
            ExtendedSample::try_new(&values).unwrap()
        };
        let found = kolmogorov_smirnov(&sample(0), &sample(100));
        // Two orders of binomial(172, 86).
        let orders = (1..=86).fold(1.0, |product, k| {
            product * f64::from(86 + k) / f64::from(k)
        });
        let expected = 2.0 / orders;
        assert!((found.p_value / expected - 1.0).abs() < 1e-12);
        let same = kolmogorov_smirnov(&sample(0), &sample(0));
        assert_eq!((same.statistic, same.p_value), (0.0, 1.0));
    }
}
