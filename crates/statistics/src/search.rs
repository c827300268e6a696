//! Searches for a maximum, and for the place where a condition changes.

/// Two places between which a condition changes that holds at `yes` and not at
/// `no`: halves the interval as long as `goes_on` holds for its ends.
pub fn narrow(
    mut yes: f64,
    mut no: f64,
    mut goes_on: impl FnMut(f64, f64) -> bool,
    holds: impl Fn(f64) -> bool,
) -> (f64, f64) {
    while goes_on(yes, no) {
        let middle = 0.5 * (yes + no);
        *(if holds(middle) { &mut yes } else { &mut no }) = middle;
    }
    (yes, no)
}

/// The zero of a function that rises from `low` to `high`, two places with the
/// values there, by the Illinois method; its value is `near` 0.
pub fn zero(
    f: impl Fn(f64) -> f64,
    (mut low, mut at_low): (f64, f64),
    (mut high, mut at_high): (f64, f64),
    near: f64,
) -> f64 {
    let mut side = 0;
    for _ in 0..100 {
        let y = (low * at_high - high * at_low) / (at_high - at_low);
        let at = f(y);
        if !(at.abs() > near && y > low && y < high) {
            return y;
        }
        // An end that stays counts half.
        if at < 0.0 {
            (low, at_low) = (y, at);
            at_high *= if side < 0 { 0.5 } else { 1.0 };
            side = -1;
        } else {
            (high, at_high) = (y, at);
            at_low *= if side > 0 { 0.5 } else { 1.0 };
            side = 1;
        }
    }
    0.5 * (low + high)
}

/// The place of a maximum between two places, by golden sections.
pub fn golden(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    const SHARE: f64 = 0.618_033_988_749_894_8;
    let inner = |low: f64, high: f64| {
        (high - SHARE * (high - low), low + SHARE * (high - low))
    };
    let (mut a, mut b) = inner(low, high);
    let (mut at_a, mut at_b) = (f(a), f(b));
    while high - low > 1e-8 {
        if at_a < at_b {
            (low, a, at_a) = (a, b, at_b);
            b = inner(low, high).1;
            at_b = f(b);
        } else {
            (high, b, at_b) = (b, a, at_a);
            a = inner(low, high).0;
            at_a = f(a);
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use std::cell::Cell;

    use super::zero;

    #[test]
    fn a_zero_is_found_in_a_few_steps() {
        let steps = Cell::new(0);
        let f = |x: f64| {
            steps.set(steps.get() + 1);
            f64::mul_add(x * x, x, -2.0)
        };
        let found = zero(f, (0.0, -2.0), (2.0, 6.0), 1e-14);
        assert!((found - libm::cbrt(2.0)).abs() < 1e-14, "{found}");
        assert!(steps.get() <= 12, "{steps:?}");
    }
}
