//! Carlson's symmetric elliptic integral of the first kind.

/// R_F(x, y, z) by the duplication theorem; at most one argument zero.
///
/// ```
/// use rocking_proof::oracles::carlson::rf;
/// // R_F(x, x, x) = 1/sqrt(x); R_F(0, 1, 1) = pi/2.
/// assert!((rf(4.0, 4.0, 4.0) - 0.5).abs() < 1e-16);
/// assert!((rf(0.0, 1.0, 1.0) - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
/// // Carlson 1995, R_F(2, 3, 4).
/// assert!((rf(2.0, 3.0, 4.0) - 0.584_082_841_677_15).abs() < 1e-13);
/// ```
pub fn rf(mut x: f64, mut y: f64, mut z: f64) -> f64 {
    // Each round divides the spread by four: sixty are more than enough.
    for _ in 0..60 {
        let mean = (x + y + z) / 3.0;
        let spread = (mean - x).abs().max((mean - y).abs());
        if spread.max((mean - z).abs()) <= 1e-3 * mean {
            break;
        }
        let (a, b, c) = (x.sqrt(), y.sqrt(), z.sqrt());
        let lambda = a * b + b * c + c * a;
        [x, y, z] = [x, y, z].map(|x| 0.25 * (x + lambda));
    }
    let mean = (x + y + z) / 3.0;
    let (a, b) = (1.0 - x / mean, 1.0 - y / mean);
    let c = -(a + b);
    let e2 = a * b - c * c;
    let e3 = a * b * c;
    let series = 1.0 - e2 / 10.0 + e3 / 14.0 + e2 * e2 / 24.0
        - 3.0 * e2 * e3 / 44.0
        - 5.0 * e2 * e2 * e2 / 208.0
        + 3.0 * e3 * e3 / 104.0
        + e2 * e2 * e3 / 16.0;
    series / mean.sqrt()
}
