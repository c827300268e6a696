//! Lilliefors' test of a sample, with the reasons for which it may not apply.

use thiserror::Error;

use super::{
    LillieforsError, LillieforsTable, NullDistribution, NullSource, Statistic,
    Verdict,
};
use crate::lognormal::{FitError, shifted_finite};
use crate::{Estimate, ExtendedSample, Sample, SampleError};

/// Share of distinct values below which ties decide the test.
const DISTINCT: f64 = 0.8;

/// Scale on which normality is tested.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scale {
    /// The values themselves.
    Linear,
    /// ln(x - shift).
    Logarithmic {
        /// The shift IM_R, not negative; 0 for the ordinary lognormal.
        shift: f64,
    },
}

/// Why a test has no verdict.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum Inapplicable {
    /// Censored values, which the test cannot take.
    #[error("{censored} of {n} values are infinite")]
    Censored {
        /// Number of infinite values.
        censored: usize,
        /// Size of the sample.
        n: usize,
    },
    /// The logarithm does not exist.
    #[error(transparent)]
    Logarithm(#[from] FitError),
    /// A logarithm is not finite.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// The null supposes a continuous distribution: with fewer than 80 %
    /// distinct values the steps of the ties decide.
    #[error(
        "ties: {distinct} distinct values of {n}, the largest tie {largest_tie}"
    )]
    Ties {
        /// Number of distinct values.
        distinct: usize,
        /// Size of the largest group of equal values.
        largest_tie: usize,
        /// Size of the sample.
        n: usize,
    },
    /// The statistic or its null distribution does not exist.
    #[error(transparent)]
    Test(#[from] LillieforsError),
}

/// Null distribution of a test.
#[derive(Clone, Copy, Debug)]
pub enum Null<'a> {
    /// The committed table.
    Table(&'a LillieforsTable),
    /// A simulation of the sample's size.
    Simulated(&'a NullDistribution),
}

/// Lilliefors' test of one sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct LillieforsTest {
    /// Size of the sample, censored values included.
    pub n: usize,
    /// The values tested, if they exist.
    pub tested: Option<Sample>,
    /// The statistic, if it exists.
    pub statistic: Option<Statistic>,
    /// Its p-value, with the 95 % interval of its Monte Carlo error.
    pub p_value: Option<Estimate>,
    /// Origin of the p-value.
    pub source: Option<NullSource>,
    /// The critical value at the level.
    pub critical_value: Option<f64>,
    /// The level.
    pub level: f64,
    /// The verdict, or why there is none.
    pub verdict: Result<Verdict, Inapplicable>,
}

impl LillieforsTest {
    /// Tests a sample at a level.
    ///
    /// ```
    /// use rocking_statistics::ExtendedSample;
    /// use rocking_statistics::lilliefors::{
    ///     LillieforsTest, Null, Scale, LillieforsTable, Verdict,
    /// };
    /// let values: Vec<f64> = (1..=40).map(f64::from).collect();
    /// let sample = ExtendedSample::try_new(&values)?;
    /// let table = Null::Table(LillieforsTable::embedded());
    /// let test = LillieforsTest::new(&sample, Scale::Linear, 0.05, table);
    /// assert_eq!(test.verdict, Ok(Verdict::NotRejected));
    /// # Ok::<(), rocking_statistics::SampleError>(())
    /// ```
    pub fn new(
        sample: &ExtendedSample,
        scale: Scale,
        level: f64,
        null: Null<'_>,
    ) -> Self {
        let mut assessment = Self {
            n: sample.len(),
            tested: None,
            statistic: None,
            p_value: None,
            source: None,
            critical_value: None,
            level,
            verdict: Ok(Verdict::Indeterminate),
        };
        assessment.verdict = assessment.test(sample, scale, null);
        assessment
    }

    /// Whether D exceeds the critical value (strictly), with ties or without;
    /// `None` if there is no statistic.
    pub fn exceeds(&self) -> Option<bool> {
        Some(self.statistic?.d > self.critical_value?)
    }

    /// D over the critical value; none if there is no statistic.
    pub fn ratio(&self) -> Option<f64> {
        Some(self.statistic?.d / self.critical_value?)
    }

    fn test(
        &mut self,
        sample: &ExtendedSample,
        scale: Scale,
        null: Null<'_>,
    ) -> Result<Verdict, Inapplicable> {
        let (censored, n) = (sample.censored(), sample.len());
        if censored > 0 {
            return Err(Inapplicable::Censored { censored, n });
        }
        let tested = match scale {
            Scale::Linear => Sample::try_new(sample.sorted())?,
            Scale::Logarithmic { shift } => {
                Sample::try_new(&shifted_finite(sample, shift)?)?
            }
        };
        let (distinct, largest_tie) =
            (tested.distinct(), tested.largest_tie());
        let statistic = Statistic::try_new(&tested);
        self.tested = Some(tested);
        let statistic = statistic?;
        self.statistic = Some(statistic);
        let d = statistic.d;
        let (p_value, source) = match null {
            Null::Table(table) => {
                let critical = table.critical_value(n, self.level)?;
                self.critical_value = Some(critical.0);
                let found = table.p_value(n, d)?;
                (found.estimate, found.source)
            }
            Null::Simulated(null) if null.n() != n => {
                let (found, expected) = (n, null.n());
                return Err(LillieforsError::Size { found, expected }.into());
            }
            Null::Simulated(null) => {
                let critical = null.critical_value(self.level)?;
                self.critical_value = Some(critical.estimate.value());
                (null.p_value(d), NullSource::Simulation)
            }
        };
        (self.p_value, self.source) = (Some(p_value), Some(source));
        if (distinct as f64) < DISTINCT * n as f64 {
            return Err(Inapplicable::Ties { distinct, largest_tie, n });
        }
        Ok(Verdict::at_level(&p_value, self.level))
    }
}
