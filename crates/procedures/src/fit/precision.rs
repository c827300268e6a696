//! Number of records needed for a precision.

use libm::log;

use rocking_statistics::{CensoredSample, Clusters, Lognormal, normal};

/// Target relative precision.
const PRECISION: f64 = 0.1;

/// Level of the interval.
const LEVEL: f64 = 0.9;

/// Number of records that bring the median above the shift, and the
/// dispersion, to a precision, for the fitted dispersion and the same
/// distribution of records over earthquakes.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct SampleSize {
    /// Half the width of the interval, relative to the value: 0.1.
    pub precision: f64,
    /// Level of the interval: 0.9.
    pub level: f64,
    /// Records for the median.
    pub for_median: f64,
    /// Records for the dispersion.
    pub for_dispersion: f64,
    /// Share of the variance of the logarithms that lies between earthquakes;
    /// none if no earthquake has two records.
    pub intraclass_correlation: Option<f64>,
    /// Number of records that count as much as one independent record.
    pub design_effect: f64,
}

impl SampleSize {
    /// The numbers for the fit of a sample with these clusters; `None` if
    /// censored values of shared earthquakes leave the design effect open.
    ///
    /// With z = 1.645, the dispersion beta and the design effect D, the
    /// median needs (z beta/ln 1.1)^2 D records, the dispersion (z/ln 1.1)^2
    /// D/2. D = 1 + (m - 1) rho, m = sum n_g^2/n the mean size of a record's
    /// own earthquake and rho the intraclass correlation (Kish, Survey
    /// Sampling, 1965).
    pub(super) fn for_fit(
        sample: &CensoredSample,
        fitted: &Lognormal,
        clusters: &Clusters,
    ) -> Option<Self> {
        let n = clusters.records() as f64;
        let logs = sample.values().iter().map(|x| log(x - fitted.shift()));
        let correlation = match (clusters.is_singletons(), sample.censored()) {
            (true, _) => None,
            (false, 0) => {
                Some(clusters.intraclass(&logs.collect::<Vec<_>>())?)
            }
            (false, _) => return None,
        };
        let size = n / clusters.effective();
        let design_effect = 1.0 + (size - 1.0) * correlation.unwrap_or(0.0);
        let z = normal::quantile(0.5 + 0.5 * LEVEL);
        let each = z / log(1.0 + PRECISION);
        let square = each * each * design_effect;
        let beta = fitted.dispersion();
        Some(Self {
            precision: PRECISION,
            level: LEVEL,
            for_median: (square * beta * beta).ceil(),
            for_dispersion: (0.5 * square).ceil(),
            intraclass_correlation: correlation,
            design_effect,
        })
    }
}
