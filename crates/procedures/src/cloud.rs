//! Cloud analysis: a fragility of the responses to unscaled records.

use libm::{exp, log};
use thiserror::Error;

use super::fit::{IntervalBasis, check_length};
use super::{Draws, ProcedureError};
use rocking_statistics::bootstrap::BootstrapEstimate;
use rocking_statistics::lognormal::LognormalError;
use rocking_statistics::regression::{CensoredLine, RegressionError, tobit};
use rocking_statistics::{Clusters, Lognormal, Range};

/// Why a cloud analysis was rejected.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum CloudError {
    /// A level outside the responses of a cloud, which end at overturning.
    #[error("EDP level {0}: expected a positive number up to 1, or inf")]
    Level(f64),
    /// The points determine no line.
    #[error("line of (ln IM, ln EDP) of records that rock and stand: {0}")]
    Line(#[from] RegressionError),
    /// The response does not grow with the intensity.
    #[error("slope {0} of ln EDP on ln IM: expected a positive number")]
    Slope(f64),
    /// Invalid draws or clusters.
    #[error(transparent)]
    Draws(#[from] ProcedureError),
    /// The shift, or numbers that make no fragility.
    #[error(transparent)]
    Lognormal(#[from] LognormalError),
}

/// Options of a cloud analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct CloudOptions {
    /// Levels of peak |theta|/alpha, positive and up to 1; 1 and infinity are
    /// overturning.
    pub edp: Vec<f64>,
    /// Intensity up to which nothing rocks, not negative.
    pub shift: f64,
    /// Bootstrap for the intervals.
    pub draws: Draws,
}

/// A line of the responses on the intensities, and a lognormal fragility of
/// each level of response, with bootstrap intervals.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct CloudFragility {
    /// Basis of the intervals: the records that enter the line.
    #[serde(flatten)]
    pub basis: IntervalBasis,
    /// Number of records.
    pub n: usize,
    /// Records left out because the block did not uplift.
    pub not_rocking: usize,
    /// Other records left out because their IM is not above the shift.
    pub below_shift: usize,
    /// Records of the line that overturned the block: censored at EDP 1.
    pub overturned: usize,
    /// The shift, in the unit of the IM.
    pub shift: f64,
    /// a, ln EDP where IM - shift is 1.
    pub intercept: BootstrapEstimate,
    /// b, slope of ln EDP on ln(IM - shift).
    pub slope: BootstrapEstimate,
    /// sigma, standard deviation of ln EDP about the line.
    pub deviation: BootstrapEstimate,
    /// Log-likelihood of ln EDP.
    pub log_likelihood: f64,
    /// The fragility of each level.
    pub levels: Vec<CloudLevel>,
}

/// The fragility of one level of response.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct CloudLevel {
    /// Peak |theta|/alpha; infinite for overturning.
    pub edp: f64,
    /// The fragility, in the unit of the IM.
    pub fitted: Lognormal,
    /// Its median, with the standard error of ln(median - shift).
    pub median: BootstrapEstimate,
    /// Its dispersion sigma/b.
    pub dispersion: BootstrapEstimate,
}

/// Fits fragilities to `pairs` (IM, EDP) of unscaled records: cloud analysis
/// (Cornell, Jalayer, Hamburger and Foutch, Journal of Structural Engineering
/// 128 (2002) 526) with overturning as censoring.
///
/// ln EDP = a + b ln(IM - shift) + sigma eps, EDP the peak |theta|/alpha and
/// eps standard normal, by maximum likelihood. An EDP of 1 or more, infinite
/// included, is overturning: of it the line knows only that EDP is not below 1
/// ([`tobit`]; Tobin 1958, Olsen 1978). A record with EDP 0 did not rock the
/// block, and one whose IM is not above the shift has no place on the line:
/// both are left out and counted. The fragility of a level edp is lognormal
/// above the shift, with median shift + exp((ln edp - a)/b) and dispersion
/// sigma/b; overturning is the level 1. Jalayer et al. (Earthquake Engineering
/// and Structural Dynamics 46 (2017) 2639) fit the line to the records that
/// stand, and the probability of collapse by a logistic regression beside it:
/// two more parameters, and no lognormal fragility.
///
/// `clusters` are the earthquakes of the pairs: these are drawn, without the
/// records that are left out. A draw that would be rejected has no line; if a
/// tenth have none there is no interval.
///
/// ```
/// use rocking_procedures::{CloudOptions, Draws, fit_cloud};
/// use rocking_statistics::Clusters;
/// let pairs = [(1.5, 0.1), (2.0, 0.3), (3.0, 0.4), (4.0, f64::INFINITY)];
/// let draws = Draws { replicates: 100, seed: 0 };
/// let options = CloudOptions { edp: vec![0.5, 1.0], shift: 1.0, draws };
/// let found = fit_cloud(&pairs, &Clusters::singletons(4), &options)?;
/// assert_eq!((found.n, found.overturned), (4, 1));
/// // exp(ln 2/b) between the levels.
/// let [half, one] = [0, 1].map(|k| found.levels[k].fitted.median() - 1.0);
/// let power = 2.0_f64.powf(1.0 / found.slope.estimate.value());
/// assert!((one / half / power - 1.0).abs() < 1e-12);
/// # Ok::<(), rocking_procedures::CloudError>(())
/// ```
///
/// # Errors
/// [`CloudError`] for a pair or a level that is no number, fewer than
/// three records that rock the block and leave it standing, those with one
/// IM, one EDP or on one line, and a slope that is not positive.
pub fn fit_cloud(
    pairs: &[(f64, f64)],
    clusters: &Clusters,
    options: &CloudOptions,
) -> Result<CloudFragility, CloudError> {
    let CloudOptions { ref edp, shift, draws } = *options;
    draws.check()?;
    Lognormal::try_new(shift, 0.0, 1.0)?;
    check_length("earthquakes", clusters.records(), pairs.len())?;
    let is_level = |x: f64| (x > 0.0 && x <= 1.0) || x == f64::INFINITY;
    if let Some(level) = edp.iter().find(|x| !is_level(**x)) {
        return Err(CloudError::Level(*level));
    }
    let is_pair = |own: &(f64, f64)| own.0.is_finite() && own.1 >= 0.0;
    if let Some(place) = pairs.iter().position(|own| !is_pair(own)) {
        return Err(RegressionError::NotFinite { number: place + 1 }.into());
    }
    let enters = |i: &usize| pairs[*i].0 > shift && pairs[*i].1 > 0.0;
    let kept: Vec<usize> = (0..pairs.len()).filter(enters).collect();
    let logarithms = |&i: &usize| (log(pairs[i].0 - shift), log(pairs[i].1));
    let points: Vec<(f64, f64)> = kept.iter().map(logarithms).collect();
    let line = rising(&points)?;
    let clusters = clusters.part(&kept);
    let drawn = draws.of("cloud", &clusters).map(|places| {
        let own: Vec<_> = places.iter().map(|&i| points[i]).collect();
        rising(&own).ok()
    });
    let basis = IntervalBasis::new(draws, &clusters);
    let estimate = |range, of: &dyn Fn(&CensoredLine) -> f64| {
        let values = drawn.iter().map(|own| own.as_ref().map_or(f64::NAN, of));
        basis.value(of(&line), &values.collect::<Vec<f64>>(), range)
    };
    let level = |&edp: &f64| {
        let ln_edp = log(edp.min(1.0));
        let log_mean =
            |own: &CensoredLine| (ln_edp - own.intercept) / own.slope;
        let dispersion = |own: &CensoredLine| own.deviation / own.slope;
        let fitted =
            Lognormal::try_new(shift, log_mean(&line), dispersion(&line))?;
        let mut median = estimate(Range::Real, &log_mean);
        median.estimate = median.estimate.map(|y| shift + exp(y));
        let dispersion = estimate(Range::NotNegative, &dispersion);
        Ok(CloudLevel { edp, fitted, median, dispersion })
    };
    let levels = edp.iter().map(level).collect::<Result<_, CloudError>>()?;
    let not_rocking = pairs.iter().filter(|own| own.1 == 0.0).count();
    Ok(CloudFragility {
        n: pairs.len(),
        not_rocking,
        below_shift: pairs.len() - kept.len() - not_rocking,
        overturned: points.iter().filter(|own| own.1 >= 0.0).count(),
        shift,
        intercept: estimate(Range::Real, &|own| own.intercept),
        slope: estimate(Range::Real, &|own| own.slope),
        deviation: estimate(Range::NotNegative, &|own| own.deviation),
        log_likelihood: line.log_likelihood,
        levels,
        basis,
    })
}

/// The line of points (ln IM, ln EDP), which rises.
fn rising(points: &[(f64, f64)]) -> Result<CensoredLine, CloudError> {
    let line = tobit(points, 0.0)?;
    if line.slope > 0.0 {
        return Ok(line);
    }
    Err(CloudError::Slope(line.slope))
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORACLE: &str = rocking_fixtures::text("oracles/censored.csv");
    const OUT: f64 = f64::INFINITY;
    /// The records of `fixtures/oracles/censored.py`.
    const CLOUD: [(f64, f64); 15] = [
        (2.6, 0.41),
        (1.3, 0.05),
        (3.4, OUT),
        (1.9, 0.11),
        (0.7, 0.0),
        (2.2, 0.47),
        (4.4, 0.86),
        (1.1, 0.013),
        (5.2, OUT),
        (1.6, 0.14),
        (2.9, 0.33),
        (0.9, 0.03),
        (3.1, 1.2),
        (1.45, 0.06),
        (2.4, OUT),
    ];

    fn found(
        pairs: &[(f64, f64)],
        edp: &[f64],
        shift: f64,
    ) -> Result<CloudFragility, CloudError> {
        let draws = Draws { replicates: 200, seed: 0 };
        let options = CloudOptions { edp: edp.to_vec(), shift, draws };
        fit_cloud(pairs, &Clusters::singletons(pairs.len()), &options)
    }

    fn close(ours: f64, theirs: f64) -> bool {
        (ours / theirs - 1.0).abs() < 1e-12
    }

    #[test]
    fn a_line_agrees_with_scipy_and_mpmath() {
        for (shift, below) in [(0.0, 0), (1.0, 1)] {
            let name = format!("tobit-{shift}");
            let row = ORACLE.lines().find(|row| row.starts_with(&name));
            let cells: Vec<&str> = row.unwrap().split(',').collect();
            let [kept, a, b, likelihood, sigma] =
                [1, 2, 3, 4, 9].map(|k| cells[k].parse::<f64>().unwrap());
            let own = found(&CLOUD, &[0.3, 1.0, OUT], shift).unwrap();
            let drawn = own.basis.drawn.records();
            assert_eq!(drawn as f64, kept);
            assert_eq!((own.not_rocking, own.below_shift), (1, below));
            assert_eq!((own.n, own.overturned), (15, 4));
            for (ours, theirs) in [
                (own.intercept.estimate.value(), a),
                (own.slope.estimate.value(), b),
                (own.deviation.estimate.value(), sigma),
                (own.log_likelihood, likelihood),
            ] {
                assert!(close(ours, theirs), "{ours} {theirs}");
            }
            for (level, edp) in own.levels.iter().zip([0.3, 1.0, 1.0]) {
                let median = shift + exp((log(edp) - a) / b);
                assert!(close(level.fitted.median(), median));
                assert!(close(level.median.estimate.value(), median));
                assert!(close(level.fitted.dispersion(), sigma / b));
                let ends = level.median.estimate.interval().unwrap();
                assert!(ends.low() > shift && ends.holds(median));
            }
            // Overturning as an EDP of exactly 1 is another model.
            let exact = CLOUD.map(|(im, edp)| (im, edp.min(1.0 - 1e-12)));
            let wrong = found(&exact, &[1.0], shift).unwrap();
            assert!(b / wrong.slope.estimate.value() > 1.05);
        }
    }

    #[test]
    fn a_doubled_intensity_doubles_the_median_and_its_interval() {
        let doubled = CLOUD.map(|(im, edp)| (2.0 * im, edp));
        let one = found(&CLOUD, &[0.5], 1.0).unwrap();
        let two = found(&doubled, &[0.5], 2.0).unwrap();
        let [one, two] = [&one.levels[0], &two.levels[0]];
        let ends = |level: &CloudLevel| level.median.estimate.ends();
        assert!(close(two.fitted.median(), 2.0 * one.fitted.median()));
        assert!((ends(two).0 / ends(one).0 - 2.0).abs() < 1e-9);
        assert!((ends(two).1 / ends(one).1 - 2.0).abs() < 1e-9);
        let beta = |level: &CloudLevel| level.fitted.dispersion();
        assert!(close(beta(two), beta(one)));
    }

    #[test]
    fn a_cloud_that_tells_no_fragility_is_refused() {
        let refused = |pairs: &[(f64, f64)]| {
            found(pairs, &[1.0], 1.0).unwrap_err().to_string()
        };
        let few = refused(&[(1.5, 0.1), (2.0, 0.3), (3.0, OUT), (0.5, 0.0)]);
        assert!(few.ends_with("2 pairs: expected at least 3"), "{few}");
        let line = [2.0, 3.0, 5.0].map(|im| (im, 0.1 * (im - 1.0)));
        assert!(refused(&line).contains("on one line"));
        let flat = [(2.0, 0.2), (3.0, 0.2), (4.0, 0.2), (5.0, OUT)];
        assert!(refused(&flat).contains("on one line"));
        let same = [(2.0, 0.2), (2.0, 0.3), (2.0, 0.4)];
        assert!(refused(&same).contains("x are all the same"));
        let falling = [(2.0, 0.4), (3.0, 0.2), (4.0, 0.1), (5.0, 0.06)];
        assert!(refused(&falling).starts_with("slope -"));
        for bad in [(f64::NAN, 0.3), (2.0, f64::NAN), (OUT, 0.3), (2.0, -0.1)]
        {
            let text = refused(&[CLOUD[0], bad]);
            assert!(text.contains("pair 2: expected"), "{text}");
        }
        for level in [0.0, 1.5, f64::NAN, -OUT] {
            let error = found(&CLOUD, &[level], 0.0).unwrap_err();
            assert!(matches!(error, CloudError::Level(_)));
        }
        for shift in [-1.0, f64::NAN, OUT] {
            assert!(found(&CLOUD, &[1.0], shift).is_err());
        }
    }
}
