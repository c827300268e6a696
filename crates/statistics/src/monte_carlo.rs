//! p-values by simulation: one formula for all tests.

/// The p-value of a sample, (b + 1)/(N + 1), where b of N replicates lie at
/// least as far from the null as the sample: their share among the replicates
/// and the sample itself. It is never 0, and at most a level with no more
/// than that probability, over both draws (Davison and Hinkley, Bootstrap
/// Methods and their Application, 1997, section 4.2).
pub(super) fn p_value(as_far: usize, replicates: usize) -> f64 {
    (as_far + 1) as f64 / (replicates + 1) as f64
}
