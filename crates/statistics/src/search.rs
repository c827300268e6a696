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
