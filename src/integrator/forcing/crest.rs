//! The crest of a smooth excitation.

use crate::integrator::roots::first_descent;
use crate::integrator::taylor::value;
use crate::number::Real;
use crate::number::dispatch::Isa;

/// First stationary point of the polynomial `c` within (0, `length`), and the
/// absolute value there; `None` if the polynomial is monotone.
pub(super) fn crest<N: Real, const F: usize>(
    c: &[N; F],
    length: N,
    isa: Isa,
) -> Option<(N, N)> {
    let mut slope = [N::zero(); F];
    for k in 1..F {
        slope[k - 1] = c[k] * N::ratio(k as i32, 1);
    }
    let first = *slope.iter().find(|x| **x != N::zero())?;
    if first < N::zero() {
        slope = slope.map(|x| -x);
    }
    // A derivative that starts at zero has that crest before.
    let tau = first_descent(&slope, length, isa)?;
    (tau > N::zero() && tau < length).then(|| (tau, value(c, tau).abs()))
}

#[cfg(test)]
mod tests {
    use super::{Isa, crest};

    #[test]
    fn a_crest_is_where_the_slope_vanishes() {
        // 1 - (x - 1/2)^2 is 1 at its crest; upside down as well.
        let c = [0.75, 1.0, -1.0, 0.0];
        let found = Some((0.5, 1.0));
        assert_eq!(crest(&c, 1.0, Isa::best()), found);
        assert_eq!(crest(&c.map(|x: f64| -x), 1.0, Isa::best()), found);
        assert_eq!(crest(&c, 0.4, Isa::best()), None);
        assert_eq!(crest(&[1.0, 2.0], 9.0, Isa::best()), None);
        assert_eq!(crest(&[0.0; 3], 9.0, Isa::best()), None);
    }
}
