//! Paired comparison of two blocks over the same records.
//!
//! A ratio exists if both of a pair are finite and positive; the other pairs
//! are counted by what they are, because conditioning on both standing hides
//! divergence.

mod location;

use thiserror::Error;

use crate::beta::binomial_cdf;

pub use location::{
    Equivalence, HodgesLehmann, SignEquivalence, equivalence, hodges_lehmann,
    sign_equivalence,
};

/// Why a comparison was rejected.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum PairedError {
    /// Unequal numbers of values.
    #[error("{a} values against {b}: expected equal numbers of values")]
    Lengths {
        /// Number on the first side.
        a: usize,
        /// Number on the second side.
        b: usize,
    },
    /// A response that is negative or NaN; infinity is overturned or censored.
    #[error("pair {number}: {value}: expected a non-negative number, or inf")]
    Value {
        /// Place of the pair, from 1.
        number: usize,
        /// What stood there.
        value: f64,
    },
    /// Too few usable pairs for the procedure.
    #[error("{0} usable pairs: expected at least 2")]
    TooFew(usize),
    /// Too many usable pairs: their number squared would fill the memory.
    #[error("{0} usable pairs: expected at most {most}", most = location::MOST)]
    TooMany(usize),
    /// A margin that is not positive.
    #[error("margin {0}: expected a positive number, such as 0.05 for 5 %")]
    Margin(f64),
    /// The logarithms of the ratios don't vary.
    #[error("all ratios are equal: no interval from their spread")]
    Degenerate,
}

/// Pairs by kind.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Pairs {
    /// Ratios a/b of the usable pairs, in the order given.
    #[serde(skip)]
    pub ratios: Vec<f64>,
    /// All pairs.
    pub n: usize,
    /// Only the first of the pair is infinite.
    pub only_a_infinite: usize,
    /// Only the second is infinite.
    pub only_b_infinite: usize,
    /// Both are infinite.
    pub both_infinite: usize,
    /// Both are zero: neither rocks.
    pub both_zero: usize,
    /// Only the first is zero, the second is finite.
    pub only_a_zero: usize,
    /// Only the second is zero, the first is finite.
    pub only_b_zero: usize,
}

impl Pairs {
    /// Sorts pairs (a_i, b_i) of numbers not negative or infinite.
    ///
    /// ```
    /// use rocking_statistics::paired::Pairs;
    /// let inf = f64::INFINITY;
    /// let pairs = Pairs::try_new(&[1.0, inf, 0.0], &[2.0, 1.0, 0.0])?;
    /// assert_eq!(pairs.ratios, [0.5]);
    /// assert_eq!((pairs.only_a_infinite, pairs.both_zero), (1, 1));
    /// # Ok::<(), rocking_statistics::paired::PairedError>(())
    /// ```
    ///
    /// # Errors
    /// [`PairedError`] for unequal lengths or values that are NaN or
    /// negative.
    pub fn try_new(a: &[f64], b: &[f64]) -> Result<Self, PairedError> {
        if a.len() != b.len() {
            return Err(PairedError::Lengths { a: a.len(), b: b.len() });
        }
        let mut pairs = Self { n: a.len(), ..Self::default() };
        for (i, (&a, &b)) in a.iter().zip(b).enumerate() {
            for value in [a, b] {
                if value.is_nan() || value < 0.0 {
                    return Err(PairedError::Value { number: i + 1, value });
                }
            }
            match (a.is_infinite(), b.is_infinite()) {
                (true, true) => pairs.both_infinite += 1,
                (true, false) => pairs.only_a_infinite += 1,
                (false, true) => pairs.only_b_infinite += 1,
                (false, false) => match (a == 0.0, b == 0.0) {
                    (true, true) => pairs.both_zero += 1,
                    (true, false) => pairs.only_a_zero += 1,
                    (false, true) => pairs.only_b_zero += 1,
                    (false, false) => pairs.ratios.push(a / b),
                },
            }
        }
        Ok(pairs)
    }

    /// Share of pairs with a ratio.
    pub fn share(&self) -> f64 {
        self.ratios.len() as f64 / self.n as f64
    }

    /// Exact McNemar test on the discordant infinite pairs.
    pub fn mcnemar(&self) -> SignTest {
        SignTest::of_counts(self.only_a_infinite, self.only_b_infinite)
    }
}

/// Exact two-sided binomial test with probability 1/2.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct SignTest {
    /// Number above (or first kind of discordance).
    pub above: usize,
    /// Number below (or second kind).
    pub below: usize,
    /// Number equal, not used.
    pub equal: usize,
    /// min(1, 2 P(B <= min(above, below))), B binomial; 1 for no pair.
    pub p_value: f64,
}

impl SignTest {
    /// Sign test of values against a centre.
    ///
    /// ```
    /// use rocking_statistics::paired::SignTest;
    /// let test = SignTest::about(&[1.1, 1.2, 1.3, 1.4, 1.5, 0.9], 1.0);
    /// assert_eq!((test.above, test.below), (5, 1));
    /// assert!((test.p_value - 14.0 / 64.0).abs() < 1e-14);
    /// ```
    pub fn about(values: &[f64], centre: f64) -> Self {
        let above = values.iter().filter(|&&x| x > centre).count();
        let below = values.iter().filter(|&&x| x < centre).count();
        let equal = values.len() - above - below;
        Self { equal, ..Self::of_counts(above, below) }
    }

    fn of_counts(above: usize, below: usize) -> Self {
        let tail = binomial_cdf(above + below, above.min(below));
        Self { above, below, equal: 0, p_value: (2.0 * tail).min(1.0) }
    }
}

#[cfg(test)]
mod tests;
