//! Many tests at once: adjusted p-values and accepted shares.

/// Holm's step-down adjusted p-values, in the order given: a level is
/// rejected with family-wise error a where its value is at most a (Scand. J.
/// Statistics 6 (1979) 65). Valid for any dependence.
///
/// ```
/// use rocking_statistics::multiple::holm;
/// assert_eq!(holm(&[0.01, 0.04, 0.03]), [0.03, 0.06, 0.06]);
/// ```
#[must_use]
pub fn holm(p_values: &[f64]) -> Vec<f64> {
    let order = ascending(p_values);
    let n = order.len();
    let mut adjusted = vec![0.0; n];
    let mut largest = 0.0_f64;
    for (rank, &i) in order.iter().enumerate() {
        largest = largest.max((n - rank) as f64 * p_values[i]);
        adjusted[i] = largest.min(1.0);
    }
    adjusted
}

/// Benjamini and Hochberg's adjusted p-values, in the order given: the
/// expected share of false rejections among those at most q is q (J. R.
/// Statist. Soc. B 57 (1995) 289), for independent or positively dependent
/// tests.
///
/// ```
/// use rocking_statistics::multiple::benjamini_hochberg;
/// assert_eq!(benjamini_hochberg(&[0.01, 0.04, 0.03]), [0.03, 0.04, 0.04]);
/// ```
#[must_use]
pub fn benjamini_hochberg(p_values: &[f64]) -> Vec<f64> {
    let order = ascending(p_values);
    let n = order.len();
    let mut adjusted = vec![0.0; n];
    let mut least = 1.0_f64;
    for (rank, &i) in order.iter().enumerate().rev() {
        least = least.min(p_values[i] * n as f64 / (rank + 1) as f64);
        adjusted[i] = least;
    }
    adjusted
}

/// Benjamini and Yekutieli's adjusted p-values, in the order given: those of
/// [`benjamini_hochberg`] times 1 + 1/2 + ... + 1/n, at most 1 (Ann. Statist.
/// 29 (2001) 1165). Valid for any dependence.
///
/// ```
/// use rocking_statistics::multiple::benjamini_yekutieli;
/// let adjusted = benjamini_yekutieli(&[0.01, 0.04, 0.03]);
/// assert!((adjusted[0] - 0.03 * 11.0 / 6.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn benjamini_yekutieli(p_values: &[f64]) -> Vec<f64> {
    let harmonic = (1..=p_values.len()).map(|i| 1.0 / i as f64).sum::<f64>();
    let raised = |p: f64| (p * harmonic).min(1.0);
    benjamini_hochberg(p_values).into_iter().map(raised).collect()
}

fn ascending(p_values: &[f64]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..p_values.len()).collect();
    order.sort_by(|&i, &j| p_values[i].total_cmp(&p_values[j]));
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    /// R 4.2: p.adjust(c(.001,.02,.03,.04,.5,.04), "holm" and "BH").
    #[test]
    fn adjustments_agree_with_r() {
        let p = [0.001, 0.02, 0.03, 0.04, 0.5, 0.04];
        let close = |ours: Vec<f64>, theirs: [f64; 6]| {
            ours.iter().zip(theirs).all(|(a, b)| (a - b).abs() < 1e-15)
        };
        assert!(close(holm(&p), [0.006, 0.1, 0.12, 0.12, 0.5, 0.12]));
        let expected = [0.006, 0.048, 0.048, 0.048, 0.5, 0.048];
        assert!(close(benjamini_hochberg(&p), expected));
        // R 4.2: p.adjust(p, "BY").
        let by = [0.0147, 0.1176, 0.1176, 0.1176, 1.0, 0.1176];
        assert!(close(benjamini_yekutieli(&p), by));
    }
}
