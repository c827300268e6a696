//! A block's overturning fragility without an analysis: the law of average
//! spectral acceleration.

use libm::{exp, hypot, log, sqrt, tan};
use thiserror::Error;

use crate::ModelError;
use rocking::block::Block;
use rocking_records::intensity::{IntensityMeasure, RockingBand};
use rocking_statistics::Lognormal;
use rocking_statistics::lognormal::LognormalError;

/// Frequency parameters in rad/s for which the law holds.
pub const FREQUENCY_RANGE_RAD_S: (f64, f64) = (0.7, 8.0);

/// Slenderness angles in rad for which the law holds.
pub const SLENDERNESS_RANGE_RAD: (f64, f64) = (0.05, 0.60);

/// Coefficients of restitution for which the law holds; Housner's is above for
/// alpha below 0.097.
pub const RESTITUTION_RANGE: (f64, f64) = (0.85, 0.986);

/// Peak |theta|/alpha for which the law holds; infinity is overturning.
pub const DEMAND_RANGE: (f64, f64) = (0.2, 1.0);

/// Why the law has no fragility.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LawError {
    /// A block or a demand outside the range.
    #[error(
        "{what} {found}: expected {low} to {high}, the range of the law of \
         AvgSA"
    )]
    Range {
        /// The parameter.
        what: &'static str,
        /// Its value.
        found: f64,
        /// Least value.
        low: f64,
        /// Largest value.
        high: f64,
    },
    /// Parameters of no distribution.
    #[error(transparent)]
    Lognormal(#[from] LognormalError),
}

/// A fragility by the law of average spectral acceleration.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct LawFragility {
    /// Slenderness angle.
    pub alpha_rad: f64,
    /// Frequency parameter.
    pub p_rad_s: f64,
    /// Coefficient of restitution.
    pub eta: f64,
    /// Peak |theta|/alpha; infinite for overturning.
    pub edp: f64,
    /// The intensity measure.
    pub im: IntensityMeasure,
    /// Its periods in s.
    pub periods_s: Vec<f64>,
    /// Median AvgSA over g tan alpha.
    pub median_ratio: f64,
    /// Dispersion by the choice of the record.
    pub record_dispersion: f64,
    /// Error of the law: the root mean square of the logarithm of the median
    /// by analyses over the median by the law, over suites that it was not
    /// fitted to.
    pub law_error: f64,
    /// The fragility in AvgSA (g): both dispersions together.
    pub fitted: Lognormal,
    /// The error of the model.
    pub model_error: ModelError,
    /// The fragility of a real object, with the model error included.
    pub total: Lognormal,
    /// Its origin, in words.
    pub origin: String,
}

impl LawFragility {
    /// Origin of the fragilities of the law, in words.
    pub fn origin(edp: f64) -> String {
        let edp = edp.is_finite().then(|| format!("EDP {edp}"));
        let what = edp.as_deref().unwrap_or("overturning");
        format!("{what} by the law of AvgSA, without an analysis")
    }
}

/// The fragility of a block by the law of average spectral acceleration.
///
/// AvgSA is the geometric mean of SA(T, 5 %) over the periods of
/// [`RockingBand`], 0.15 to 1.0 times 2 pi/p. For every block and suite of
/// ground motions AvgSA/(g tan alpha) at the first overturning, or where
/// |theta|/alpha first reaches `edp`, is lognormal with about the same median:
/// with l = ln(p/sqrt(6 rad^2/s^2)), e = 0.92 - eta, and d = `edp`, or 1 for
/// overturning,
///
/// ```text
/// ln median     = 0.8552 + 3.294 e - 1.57 e l + 0.09546 l^2
///                 + (1 - d)^2 (0.5335 l - 0.6268)
/// ln dispersion = -1.591 - 0.4473 l + 0.4941 (1 - d)^2 l
/// error         = 0.07 + 0.085 (1 - d)
/// ```
///
/// The terms were fitted to 86 ordinary recorded motions by a rule that was
/// fixed before, and judged on six other suites (`fixtures/law/law.py`): the
/// error is the root mean square of the logarithm of their medians over those
/// of the law, rounded up.
///
/// ```
/// use rocking::Block;
/// use rocking_procedures::{ModelError, law_fragility};
/// let block = Block::try_new(0.15, 3.0)?;
/// let error = ModelError::none();
/// let found = law_fragility(&block, 0.92, f64::INFINITY, error)?;
/// assert!((found.median_ratio - 2.36).abs() < 0.01);
/// // 2.36 g tan(0.15)
/// assert!((found.fitted.median() - 0.357).abs() < 1e-3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`LawError::Range`] outside [`FREQUENCY_RANGE_RAD_S`],
/// [`SLENDERNESS_RANGE_RAD`], [`RESTITUTION_RANGE`] and [`DEMAND_RANGE`].
pub fn law_fragility(
    block: &Block,
    eta: f64,
    edp: f64,
    model_error: ModelError,
) -> Result<LawFragility, LawError> {
    let (alpha_rad, p_rad_s) =
        (block.slenderness_rad(), block.frequency_rad_s());
    let demand = if edp == f64::INFINITY { 1.0 } else { edp };
    for (what, found, (low, high)) in [
        ("alpha in rad", alpha_rad, SLENDERNESS_RANGE_RAD),
        ("p in rad/s", p_rad_s, FREQUENCY_RANGE_RAD_S),
        ("eta", eta, RESTITUTION_RANGE),
        ("peak |theta|/alpha", demand, DEMAND_RANGE),
    ] {
        if !(low <= found && found <= high) {
            return Err(LawError::Range { what, found, low, high });
        }
    }
    let (l, e) = (log(p_rad_s / sqrt(6.0)), 0.92 - eta);
    let below = (1.0 - demand) * (1.0 - demand);
    let ln_median = 0.8552 + 3.294 * e - 1.57 * e * l
        + 0.09546 * l * l
        + below * (0.5335 * l - 0.6268);
    let record_dispersion = exp(-1.591 - 0.4473 * l + 0.4941 * below * l);
    let law_error = 0.07 + 0.085 * (1.0 - demand);
    let fitted = Lognormal::try_new(
        0.0,
        ln_median + log(tan(alpha_rad)),
        hypot(record_dispersion, law_error),
    )?;
    let total = model_error.total(fitted)?;
    let band = RockingBand::try_new(p_rad_s);
    Ok(LawFragility {
        alpha_rad,
        p_rad_s,
        eta,
        edp,
        periods_s: band.iter().flat_map(|b| b.periods_s()).copied().collect(),
        im: IntensityMeasure::RockingSa(band),
        median_ratio: exp(ln_median),
        record_dispersion,
        law_error,
        fitted,
        model_error,
        // Without a shift the total is lognormal.
        total: total.closed().unwrap_or(fitted),
        origin: LawFragility::origin(edp),
    })
}
