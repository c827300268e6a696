//! Published coefficients of the near-fault model: Dabaghi and Der Kiureghian
//! (2014, PEER report 2014/20; 2017; 2018), as distributed with the NHERI
//! SimCenter's stochastic motion library, rounded to five decimals.
//!
//! Six of its 19 parameters: pulse amplitude, period, gamma, phase, time of
//! the peak, and D0-30 of the other waves along the pulse.

/// Coefficients on 1, M, max(M - 6.5, 0), ln sqrt(R^2 + 36 km2), reverse
/// faulting, ln Vs30, length of rupture towards the site in km.
///
/// Some details are inferred. The third regressor is max(M - 6.5, 0), although
/// the program has M - 6.5: with that, the coefficients of the amplitude,
/// 0.608 and -0.608, would cancel the magnitude. In the program "reverse
/// faulting" is multiplied by the depth of the rupture's top in km, at most 1:
/// here the top is at least 1 km deep.
#[rustfmt::skip]
pub(super) const REGRESSION: [[f64; 7]; 6] = [
    [1.698626, 0.60819, -0.60819, -0.576217, 0.183071, -0.093932, 0.006571],
    [-2.479243, 0.670396, 0.0, 0.0, -0.263958, -0.232549, 0.00792],
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
    [-4.248733, 0.852186, 0.0, 0.389602, -0.380323, -0.088013, 0.0],
    [-4.776824, 0.879982, 0.0, 0.31061, -0.339226, 0.0, 0.0],
];

/// Standard deviations of the errors.
pub(super) const DEVIATION: [f64; 6] =
    [0.38532, 0.5806, 1.0, 1.0, 0.4686, 0.39355];

/// Correlation of the errors, strict lower triangle.
#[rustfmt::skip]
pub(super) const CORRELATION: [&[f64]; 6] = [
    &[],
    &[-0.17584],
    &[-0.02035, 0.18336],
    &[0.17359, 0.00131, -0.19002],
    &[0.19108, 0.43155, 0.24277, 0.11916],
    &[0.12, 0.36816, 0.23643, 0.07182, 0.78866],
];
