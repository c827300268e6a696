//! Responses of a suite at given intensities.

use super::ProcedureError;
use rocking::capacity::ResponseCurve;
use rocking_statistics::ExtendedSample;

/// The responses at one intensity.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct StripeResponses {
    /// The intensity, in the unit of the curves.
    pub intensity: f64,
    /// Records that were run up to this intensity.
    pub n: usize,
    /// 16 % quantile of the EDP; infinite if overturned.
    pub edp16: f64,
    /// Median of the EDP.
    pub edp50: f64,
    /// 84 % quantile of the EDP.
    pub edp84: f64,
    /// Records that overturn.
    pub overturned: usize,
    /// Records that were not run up to this intensity, or stood at the
    /// analysis before and overturned at the one after. They are left out, but
    /// records that overturned before are not: the quantiles and the share
    /// that overturns are too high.
    pub open: usize,
    /// Records at or above the EDP level, which a fit takes as of n: none
    /// without a level, and none if a record is open.
    pub exceeded: Option<usize>,
}

impl StripeResponses {
    /// The responses of IDA curves at `steps` + 1 intensities: from the lowest
    /// onset of rocking to the intensity at which 85 % of the curves have
    /// overturned or end.
    ///
    /// ```
    /// use rocking::capacity::ResponseCurve;
    /// use rocking_procedures::StripeResponses;
    /// let curve = |end| {
    ///     ResponseCurve::try_new(&[(1.0, 0.0), (2.0, 0.4)], Some(end))
    /// };
    /// let curves = [curve(3.0)?, curve(4.0)?, curve(5.0)?];
    /// let found = StripeResponses::over(&curves, 4)?;
    /// assert_eq!((found[0].intensity, found[4].intensity), (1.0, 5.0));
    /// assert_eq!((found[1].edp50, found[3].overturned), (0.4, 2));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`ProcedureError::Sample`] for no curve.
    pub fn over(
        curves: &[ResponseCurve],
        steps: usize,
    ) -> Result<Vec<Self>, ProcedureError> {
        let end = |curve: &ResponseCurve| {
            curve.overturning_im().unwrap_or(curve.last_im())
        };
        let sorted = |of: fn(&ResponseCurve) -> f64| {
            let all: Vec<f64> = curves.iter().map(of).collect();
            ExtendedSample::try_new(&all).map(|all| all.sorted().to_vec())
        };
        let (onsets, ends) = (sorted(ResponseCurve::onset_im)?, sorted(end)?);
        let (first, last) = (onsets[0], ends[ends.len() * 17 / 20]);
        let step = (last - first) / steps as f64;
        let levels = (0..=steps).map(|k| first + step * k as f64);
        stripes(curves, &levels.collect::<Vec<_>>(), None)
    }
}

/// Reads all curves at given intensities, each linear between its analyses
/// and infinite from the first overturning on.
///
/// `edp` is the level (peak |theta|/alpha, infinite for overturning) whose
/// exceedances are counted if no record is open;
/// [`fit_outcomes`](crate::fit_outcomes) takes open ones too.
///
/// # Errors
/// [`ProcedureError::NotRun`] for an intensity up to which no record was run,
/// [`ProcedureError::EdpLevel`] for a level that is no positive number.
pub fn stripes(
    curves: &[ResponseCurve],
    intensities: &[f64],
    edp: Option<f64>,
) -> Result<Vec<StripeResponses>, ProcedureError> {
    if let Some(level) = edp.filter(|edp| !(*edp > 0.0)) {
        return Err(ProcedureError::EdpLevel(level));
    }
    let stripe = |&im: &f64| {
        let known: Vec<f64> =
            curves.iter().filter_map(|curve| curve.edp_at(im)).collect();
        let sample = ExtendedSample::try_new(&known)
            .map_err(|_| ProcedureError::NotRun(im))?;
        let open = curves.len() - known.len();
        let exceeded =
            |level: f64| known.iter().filter(|edp| **edp >= level).count();
        Ok(StripeResponses {
            intensity: im,
            n: known.len(),
            edp16: sample.quantile(0.16),
            edp50: sample.quantile(0.5),
            edp84: sample.quantile(0.84),
            overturned: sample.censored(),
            open,
            exceeded: edp.filter(|_| open == 0).map(exceeded),
        })
    };
    intensities.iter().map(stripe).collect()
}
