//! A number of each test as a predictor of the outcomes, and its measured and
//! computed fragilities.

use super::fates::{Fates, left_out, log_likelihood, probit};
use super::{DistributionComparison, Predictor};
use libm::{exp, expm1};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::lognormal::FitError;
use rocking_statistics::{Lognormal, Range};

/// One number of each test.
pub(super) struct PredictorNumbers {
    pub name: String,
    pub x: Vec<f64>,
    /// Tests in ascending order of the number.
    order: Vec<usize>,
    /// Whether each outcome is right.
    right: Vec<bool>,
    /// ln of the predicted probability of each outcome.
    ln_of_fate: Vec<f64>,
    pub fit: Lognormal,
}

/// Scores of a predictor in a draw: share right, median, dispersion, AUC, log
/// score.
pub(super) type Scores = [f64; 5];

impl PredictorNumbers {
    /// Fits the outcomes; `threshold` is the least number at which overturning
    /// is predicted; `None` if the probability decides.
    ///
    /// # Errors
    /// The motion that was left out, if one was, and why there is no fit.
    pub fn new(
        name: String,
        x: Vec<f64>,
        fates: &Fates,
        threshold: Option<f64>,
    ) -> Result<Self, (Option<usize>, FitError)> {
        let fit = probit(&x, &fates.overturned, &fates.once(), 0.0)
            .map_err(|source| (None, source))?;
        let ln_of_fate = left_out(&x, fates)
            .map_err(|(motion, source)| (Some(motion), source))?;
        let mut order: Vec<usize> = (0..x.len()).collect();
        order.sort_by(|a, b| x[*a].total_cmp(&x[*b]));
        let is_right = |i: usize| match threshold {
            Some(least) => (x[i] >= least) == fates.overturned[i],
            None => ln_of_fate[i] > -std::f64::consts::LN_2,
        };
        let right = (0..x.len()).map(is_right).collect();
        Ok(Self { name, order, right, ln_of_fate, fit, x })
    }

    /// Predicted probability of overturning of each test.
    pub fn probabilities(&self, fates: &Fates) -> Vec<f64> {
        let tests = self.ln_of_fate.iter().zip(&fates.overturned);
        let of = |(ln, fate): (&f64, &bool)| {
            if *fate { exp(*ln) } else { -expm1(*ln) }
        };
        tests.map(of).collect()
    }

    /// The scores of a fit to the tests as often as they are drawn; the
    /// predicted probabilities stay.
    pub fn scores(
        &self,
        fit: Option<&Lognormal>,
        fates: &Fates,
        counts: &[u32],
    ) -> Scores {
        let (mut right, mut score, mut all) = (0.0, 0.0, 0.0);
        for (i, count) in counts.iter().enumerate() {
            let n = f64::from(*count);
            all += n;
            right += if self.right[i] { n } else { 0.0 };
            score -= n * self.ln_of_fate[i];
        }
        [
            right / all,
            fit.map_or(f64::NAN, Lognormal::median),
            fit.map_or(f64::NAN, Lognormal::dispersion),
            self.auc(fates, counts),
            score / all,
        ]
    }

    /// Probability that a test that overturned the specimen has a larger
    /// number than one that did not; equal numbers count half.
    fn auc(&self, fates: &Fates, counts: &[u32]) -> f64 {
        let (mut pairs, mut stood, mut fell) = (0.0, 0.0, 0.0);
        // In ascending order: a number at or above the next one equals it.
        for tied in self.order.chunk_by(|a, b| self.x[*a] >= self.x[*b]) {
            let drawn = |fate: bool| {
                let own =
                    tied.iter().filter(|i| fates.overturned[**i] == fate);
                own.fold(0.0, |sum, i| sum + f64::from(counts[*i]))
            };
            let (stands, falls) = (drawn(false), drawn(true));
            pairs += falls * f64::mul_add(0.5, stands, stood);
            stood += stands;
            fell += falls;
        }
        pairs / (stood * fell)
    }

    /// The predictor with its intervals from its scores in the draws.
    pub fn predictor(&self, fates: &Fates, drawn: &[Scores]) -> Predictor {
        let points = self.scores(Some(&self.fit), fates, &fates.once());
        let (share, positive) = (Range::Share, Range::NotNegative);
        let ranges = [share, positive, positive, share, positive];
        let [right, median, dispersion, auc, log_score] =
            fates.estimates(points, drawn, ranges);
        Predictor {
            predictor: self.name.clone(),
            right,
            median,
            dispersion,
            auc,
            log_score,
            log_likelihood: log_likelihood(
                &self.fit,
                &self.x,
                &fates.overturned,
            ),
        }
    }
}

/// Ratio of the medians, difference of the dispersions, difference of their
/// squares.
pub(super) type Differences = [f64; 3];

pub(super) fn differences(
    measured: &Lognormal,
    computed: &Lognormal,
) -> Differences {
    let [s, t] = [measured, computed].map(Lognormal::dispersion);
    [measured.median() / computed.median(), s - t, (s - t) * (s + t)]
}

/// The comparison with its intervals from the differences in the draws.
pub(super) fn distribution(
    im: &IntensityMeasure,
    fates: &Fates,
    [measured, computed]: [&Lognormal; 2],
    drawn: &[Differences],
) -> DistributionComparison {
    let ranges = [Range::NotNegative, Range::Real, Range::Real];
    let [median_ratio, dispersion_difference, squares] =
        fates.estimates(differences(measured, computed), drawn, ranges);
    DistributionComparison {
        im: im.to_string(),
        unit: im.unit().to_owned(),
        measured_median: measured.median(),
        measured_dispersion: measured.dispersion(),
        computed_median: computed.median(),
        computed_dispersion: computed.dispersion(),
        median_ratio,
        dispersion_difference,
        missing_dispersion: squares.map(|square| square.max(0.0).sqrt()),
    }
}
