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

/// Positions of the points that must stay so that straight lines between
/// them follow `y` to `tolerance` (Douglas and Peucker, along y); values
/// that are not finite are cut off.
#[must_use]
pub fn simplified(x: &[f64], y: &[f64], tolerance: f64) -> Vec<usize> {
    let end = y.iter().position(|v| !v.is_finite()).unwrap_or(y.len());
    if end < 3 {
        return (0..end).collect();
    }
    let mut keep = vec![false; end];
    (keep[0], keep[end - 1]) = (true, true);
    let mut open = vec![(0, end - 1)];
    while let Some((a, b)) = open.pop() {
        let slope = (y[b] - y[a]) / (x[b] - x[a]);
        let (mut far, mut most) = (a, tolerance);
        for i in a + 1..b {
            let miss = (y[a] + slope * (x[i] - x[a]) - y[i]).abs();
            if miss > most {
                (far, most) = (i, miss);
            }
        }
        if far > a {
            keep[far] = true;
            open.push((a, far));
            open.push((far, b));
        }
    }
    (0..end).filter(|i| keep[*i]).collect()
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

    #[test]
    fn simplified_keeps_corners_and_follows_the_rest() {
        let x: Vec<f64> = (0..=20).map(f64::from).collect();
        let tent: Vec<f64> =
            x.iter().map(|t| 10.0 - (t - 10.0).abs()).collect();
        assert_eq!(simplified(&x, &tent, 1e-9), [0, 10, 20]);
        let curve: Vec<f64> = x.iter().map(|t| libm::sin(t / 3.0)).collect();
        let kept = simplified(&x, &curve, 0.05);
        for pair in kept.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            for i in a..=b {
                let share = (x[i] - x[a]) / (x[b] - x[a]);
                let line = curve[a] + share * (curve[b] - curve[a]);
                assert!((line - curve[i]).abs() <= 0.05);
            }
        }
        assert!(kept.len() < 18);
        assert_eq!(simplified(&x, &[0.0, 1.0, f64::INFINITY], 0.1), [0, 1]);
    }
}
