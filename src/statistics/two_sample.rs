//! Do two samples come from one distribution?

use super::ExtendedSample;

/// Kolmogorov and Smirnov's comparison of two samples.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Comparison {
    /// Largest distance of the empirical distributions.
    pub statistic: f64,
    /// Probability of one at least as large among all orders in which the
    /// values of one continuous distribution may come, exactly.
    pub p_value: f64,
}

/// Compares two samples. With ties the p-value is an upper bound.
///
/// The share of orders with a smaller distance follows from P(i, j) =
/// i/(i + j) P(i - 1, j) + j/(i + j) P(i, j - 1), zero where |i/n - j/m| is
/// not smaller (Hodges, Ark. Mat. 3 (1958) 469).
///
/// ```
/// use rocking::statistics::{ExtendedSample, two_sample};
/// let a = ExtendedSample::try_new(&[1.0, 2.0, 3.0])?;
/// let b = ExtendedSample::try_new(&[4.0, 5.0, 6.0])?;
/// // Two of the twenty orders keep the samples apart.
/// let found = two_sample::kolmogorov_smirnov(&a, &b);
/// assert_eq!(found.statistic, 1.0);
/// assert!((found.p_value - 0.1).abs() < 1e-15);
/// # Ok::<(), rocking::statistics::SampleError>(())
/// ```
#[must_use]
pub fn kolmogorov_smirnov(
    a: &ExtendedSample,
    b: &ExtendedSample,
) -> Comparison {
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
        for j in 0..=m {
            let below = if i + j == 0 {
                1.0
            } else {
                let all = (i + j) as f64;
                let from_i = if i > 0 { share[j] } else { 0.0 };
                let from_j = if j > 0 { share[j - 1] } else { 0.0 };
                (i as f64 * from_i + j as f64 * from_j) / all
            };
            share[j] = if apart(i, j) < largest { below } else { 0.0 };
        }
    }
    let p_value = if largest == 0 { 1.0 } else { 1.0 - share[m] };
    Comparison { statistic: largest as f64 / (n * m) as f64, p_value }
}
