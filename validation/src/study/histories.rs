//! How far two response histories are apart.

/// Normalized L2 distance of two histories of theta/alpha sampled at the
/// same equal intervals: the root of the integral of the squared difference
/// over that of the squared reference; the shorter one has come to rest and
/// continues as zero. NaN where the reference never moves.
#[must_use]
pub fn distance(compared: &[f64], reference: &[f64]) -> f64 {
    let at = |history: &[f64], i| history.get(i).copied().unwrap_or(0.0);
    let length = compared.len().max(reference.len());
    let (mut apart, mut size) = (0.0, 0.0);
    for i in 0..length {
        let (a, b) = (at(compared, i), at(reference, i));
        apart += (a - b) * (a - b);
        size += b * b;
    }
    if size > 0.0 { f64::sqrt(apart / size) } else { f64::NAN }
}

/// Mean of |ln(a/b)| over the pairs in which both are finite; NaN where
/// there is none.
#[must_use]
pub fn mean_log_ratio(a: &[f64], b: &[f64]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (x, y) in a.iter().zip(b) {
        if x.is_finite() && y.is_finite() {
            sum += libm::log(x / y).abs();
            count += 1.0;
        }
    }
    sum / count
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distance_of_scaled_and_opposite_histories() {
        let y = [0.0, 0.3, -0.4, 0.0];
        let twice: Vec<f64> = y.iter().map(|v| 2.0 * v).collect();
        let opposite: Vec<f64> = y.iter().map(|v| -v).collect();
        assert_eq!(distance(&y, &y), 0.0);
        assert_eq!(distance(&twice, &y), 1.0);
        assert_eq!(distance(&opposite, &y), 2.0);
        // A longer history is compared with rest.
        assert_eq!(distance(&[0.0, 0.3, -0.4, 0.0, 0.5], &y), 1.0);
        assert!(distance(&y, &[0.0]).is_nan());
    }

    #[test]
    fn log_ratio_leaves_censored_levels_out() {
        let inf = f64::INFINITY;
        let mean = mean_log_ratio(&[2.0, 1.0, inf], &[1.0, 4.0, 3.0]);
        assert!((mean - 1.5 * libm::log(2.0)).abs() < 1e-15);
        assert!(mean_log_ratio(&[inf], &[1.0]).is_nan());
    }
}
