//! p-values by simulation, for one size of sample.

use rayon::prelude::*;

use super::shapiro_wilk::{deficit, weights};
use super::{NormalityTest, a2, w2};
use crate::Sample;
use crate::lilliefors::{LillieforsError, NullDistribution, standardised};
use crate::streams::{Streams, standard_normals};
use rocking::stop;

/// Null distributions of A^2, W^2 and 1 - W for samples of one size, by
/// simulation: p-values free of any approximation but the number of
/// replicates, which their intervals hold.
///
/// Replicate i draws from stream i of the family "normality, n".
///
/// ```
/// use rocking_statistics::{Sample, normality::Battery};
/// let battery = Battery::simulate(6, 2000, 0)?;
/// let sample = Sample::try_new(&[1.0, 2.0, 4.0, 8.0, 16.0, 32.0])?;
/// let [anderson_darling, ..] = battery.assess(&sample)?;
/// assert!(anderson_darling.p_value.low() > Some(0.03));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Battery {
    n: usize,
    /// A^2, W^2, 1 - W: large values are against normality.
    nulls: [NullDistribution; 3],
}

impl Battery {
    /// Largest sample that [`simulate`](Self::simulate) takes: Shapiro and
    /// Wilk's weights hold up to it.
    pub const MOST_VALUES: usize = super::shapiro_wilk::LARGEST;

    /// Simulates the statistics of `replicates` normal samples of n values.
    ///
    /// # Errors
    /// [`LillieforsError`] for n < 4 or > 5000, and for fewer than 100 or
    /// more than 10^8 replicates.
    pub fn simulate(
        n: usize,
        replicates: u64,
        seed: u64,
    ) -> Result<Self, LillieforsError> {
        NullDistribution::check(n, replicates)?;
        if n > Self::MOST_VALUES {
            let expected = Self::MOST_VALUES;
            return Err(LillieforsError::TooMany { found: n, expected });
        }
        let streams = Streams::new(&format!("normality, {n}"), seed);
        let weights = weights(n);
        let row = |index| {
            stop::point();
            let mut values = vec![0.0; n];
            standard_normals(&mut streams.stream(index), &mut values);
            let scores = standardised(&Sample::from_finite(values), 4)?;
            Ok([a2(&scores), w2(&scores), deficit(&weights, &scores)])
        };
        let rows = (0..replicates).into_par_iter().panic_fuse().map(row);
        let rows = rows.collect::<Result<Vec<_>, LillieforsError>>()?;
        let null = |k: usize| {
            let column = rows.iter().map(|row| row[k]).collect();
            NullDistribution::from_statistics(n, column)
        };
        Ok(Self { n, nulls: [null(0), null(1), null(2)] })
    }

    /// Anderson-Darling, Cramer-von Mises and Shapiro-Wilk of a sample.
    ///
    /// # Errors
    /// [`LillieforsError`] for a sample of another size, or whose values
    /// don't vary.
    pub fn assess(
        &self,
        sample: &Sample,
    ) -> Result<[NormalityTest; 3], LillieforsError> {
        if sample.len() != self.n {
            let (found, expected) = (sample.len(), self.n);
            return Err(LillieforsError::Size { found, expected });
        }
        let scores = standardised(sample, 4)?;
        let deficit = deficit(&weights(self.n), &scores);
        let [a, w, s] = &self.nulls;
        let test = |null: &NullDistribution, distance, statistic| {
            NormalityTest { statistic, p_value: null.p_value(distance) }
        };
        let (a2, w2) = (a2(&scores), w2(&scores));
        Ok([test(a, a2, a2), test(w, w2, w2), test(s, deficit, 1.0 - deficit)])
    }

    /// The null distributions of A^2, W^2 and 1 - W.
    pub fn nulls(&self) -> &[NullDistribution; 3] {
        &self.nulls
    }
}
