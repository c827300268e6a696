//! The place at which an outcome changes.

/// The number between `low` and `high` at which a predicate turns true, to
/// this relative tolerance; not a number if it does not.
///
/// # Errors
/// An error of the predicate.
pub fn edge<E>(
    [mut low, mut high]: [f64; 2],
    tolerance: f64,
    above: impl Fn(f64) -> Result<bool, E>,
) -> Result<f64, E> {
    if !(low < high) || above(low)? || !above(high)? {
        return Ok(f64::NAN);
    }
    while high - low > tolerance * high {
        let mid = 0.5 * (low + high);
        if above(mid)? { high = mid } else { low = mid }
    }
    Ok(0.5 * (low + high))
}

/// The range within this relative distance of a number.
pub fn around(near: f64, reach: f64) -> [f64; 2] {
    [near * (1.0 - reach), near * (1.0 + reach)]
}
