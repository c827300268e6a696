//! Weaknesses of a fit.

use std::fmt;

use rocking::names::as_text;
use rocking_statistics::CensoredSample;

/// A weakness of a fit.
///
/// ```
/// use rocking_procedures::{FitOptions, FitRemark, fit_sample};
/// use rocking_statistics::CensoredSample;
/// let values = [1.2, f64::INFINITY, f64::INFINITY];
/// let limits = [None, Some(1.5), Some(2.0)];
/// let sample = CensoredSample::try_new(&values, &limits)?;
/// let found = fit_sample(&sample, &FitOptions::default())?;
/// assert_eq!(found.remarks, [FitRemark::OneValue { censored: 2 }]);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum FitRemark {
    /// Only one value is not censored.
    OneValue {
        /// Number of censored values.
        censored: usize,
    },
}

impl FitRemark {
    /// Remarks on the fit to a sample with `left_out` values left out.
    pub(super) fn remarks(
        sample: &CensoredSample,
        left_out: usize,
    ) -> Vec<Self> {
        let censored = sample.censored();
        match sample.len() - censored - left_out {
            1 => vec![Self::OneValue { censored }],
            _ => Vec::new(),
        }
    }
}

impl fmt::Display for FitRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self::OneValue { censored } = self;
        write!(
            f,
            "1 value and {censored} censored: median and dispersion rest on \
             one observation"
        )
    }
}

as_text!(write FitRemark);
