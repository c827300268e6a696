//! Independent closed forms: no formula here is shared with the core. Only the
//! names and parameters of the pulses are.

pub mod carlson;
pub mod free_rocking;
pub mod linear;
pub mod overturning;
pub mod rectangular;
pub mod square;

/// Root of `f` between `low` and `high`; not a number if `f` has the same sign
/// at both.
pub fn bisect(mut low: f64, mut high: f64, f: impl Fn(f64) -> f64) -> f64 {
    let rising = f(high) > 0.0;
    if (f(low) > 0.0) == rising {
        return f64::NAN;
    }
    for _ in 0..200 {
        let mid = 0.5 * (low + high);
        if mid <= low || mid >= high {
            break;
        }
        if (f(mid) > 0.0) == rising {
            high = mid;
        } else {
            low = mid;
        }
    }
    0.5 * (low + high)
}
