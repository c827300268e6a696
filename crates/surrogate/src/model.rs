//! The surface and its error.

use libm::{exp, log, sqrt};
use rocking_statistics::Lognormal;
use serde::{Deserialize, Serialize};

use super::blocks::rows;
use super::{
    FREQUENCY_RANGE_RAD_S, Fitted, SHIFT, SLENDERNESS_RANGE_RAD,
    SurrogateError, read_table,
};
use rocking_exchange::table::{Table, number};
use rocking_synthesis::SuiteKind;

/// The coefficients, and the blocks that none of them was fitted to.
const COEFFICIENTS: &str =
    rocking_fixtures::text("surrogate/coefficients.csv");
const UNSEEN: &str = rocking_fixtures::text("surrogate/unseen.csv");

/// Highest degrees of a surface in u (of p) and in v (of alpha); terms of a
/// total degree above that in u are left out.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
pub struct Degrees {
    /// In u.
    pub p: usize,
    /// In v.
    pub alpha: usize,
}

impl Degrees {
    /// Degrees (i, j) of the terms, in their order.
    #[must_use]
    pub fn terms(self) -> Vec<(usize, usize)> {
        (0..=self.p)
            .flat_map(|i| (0..=self.alpha).map(move |j| (i, j)))
            .filter(|(i, j)| i + j <= self.p)
            .collect()
    }
}

/// The terms of a surface at a block.
pub(super) fn terms(
    (alpha_rad, p_rad_s): (f64, f64),
    of: &[(usize, usize)],
) -> Vec<f64> {
    let (low, high) = FREQUENCY_RANGE_RAD_S;
    let u = 2.0 * log(p_rad_s / low) / log(high / low) - 1.0;
    let (low, high) = SLENDERNESS_RANGE_RAD;
    let v = 2.0 * (alpha_rad - low) / (high - low) - 1.0;
    let term = |(i, j): &(usize, usize)| legendre(*i, u) * legendre(*j, v);
    of.iter().map(term).collect()
}

/// Legendre's polynomial of degree n, by Bonnet's recursion.
fn legendre(n: usize, x: f64) -> f64 {
    let (mut before, mut now) = (0.0, 1.0);
    for k in 0..n {
        let k = k as f64;
        let next = ((2.0 * k + 1.0) * x * now - k * before) / (k + 1.0);
        before = now;
        now = next;
    }
    now
}

/// Surfaces of mu and ln beta for one suite.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// The suite.
    pub suite: SuiteKind,
    /// Degrees of the terms.
    pub terms: Vec<(usize, usize)>,
    /// Coefficients of mu and of ln beta.
    pub coefficients: [Vec<f64>; 2],
}

impl Surface {
    /// The fragility of a block within the range.
    ///
    /// # Errors
    /// [`SurrogateError::Range`] for another block.
    pub fn at(
        &self,
        alpha_rad: f64,
        p_rad_s: f64,
    ) -> Result<Lognormal, SurrogateError> {
        for (what, found, (low, high), unit) in [
            ("alpha", alpha_rad, SLENDERNESS_RANGE_RAD, "rad"),
            ("p", p_rad_s, FREQUENCY_RANGE_RAD_S, "rad/s"),
        ] {
            if !(low <= found && found <= high) {
                return Err(SurrogateError::Range {
                    what,
                    found,
                    low,
                    high,
                    unit,
                });
            }
        }
        let terms = terms((alpha_rad, p_rad_s), &self.terms);
        let [mu, beta] = self.coefficients.each_ref().map(|own| {
            own.iter().zip(&terms).fold(0.0, |sum, (c, t)| sum + c * t)
        });
        Ok(Lognormal::try_new(SHIFT, mu, exp(beta))?)
    }

    /// The error at blocks with analyses of their own.
    ///
    /// # Errors
    /// [`SurrogateError`] for a block outside the range or no fragility.
    pub fn errors(&self, blocks: &[Fitted]) -> Result<Errors, SurrogateError> {
        let mut errors = Errors::default();
        let mut inside = 0.0;
        for block in blocks.iter().filter(|b| b.suite == self.suite) {
            let found = self.at(block.alpha_rad, block.p_rad_s)?;
            let own = block.lognormal()?;
            let median = found.median() / block.median - 1.0;
            let dispersion = found.dispersion() / block.dispersion - 1.0;
            let off = found.distance(&own).unwrap_or(f64::NAN);
            errors.median.add(median);
            errors.dispersion.add(dispersion);
            errors.probability.add(off);
            errors.blocks += 1;
            let holds = block.median_low <= found.median()
                && found.median() <= block.median_high;
            inside += if holds { 1.0 } else { 0.0 };
        }
        let n = errors.blocks;
        for size in [
            &mut errors.median,
            &mut errors.dispersion,
            &mut errors.probability,
        ] {
            size.finish(n);
        }
        errors.inside = inside / n as f64;
        Ok(errors)
    }
}

/// Root mean square and largest size of an error.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Size {
    /// Root mean square.
    pub rms: f64,
    /// Largest absolute value.
    pub largest: f64,
}

impl Size {
    /// Adds an error; [`finish`](Self::finish) makes the mean.
    pub(super) fn add(&mut self, error: f64) {
        self.rms += error * error;
        self.largest = self.largest.max(error.abs());
    }

    /// Makes the sum of n squares their root mean.
    pub(super) fn finish(&mut self, n: usize) {
        self.rms = sqrt(self.rms / n as f64);
    }
}

/// How far a surface is from analyses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
pub struct Errors {
    /// Blocks with analyses.
    pub blocks: usize,
    /// Of the median, relative.
    #[serde(rename = "median_relative")]
    pub median: Size,
    /// Of the dispersion, relative.
    #[serde(rename = "beta_relative")]
    pub dispersion: Size,
    /// Largest difference of the fragilities in probability.
    pub probability: Size,
    /// Share of the blocks with the surface's median in the 95 % interval of
    /// their own.
    #[serde(rename = "share_within_interval")]
    pub inside: f64,
}

/// A coefficient as it is kept.
#[derive(Deserialize, Serialize)]
#[serde(deny_unknown_fields)]
struct Coefficient {
    suite: SuiteKind,
    degree_p: usize,
    degree_alpha: usize,
    mu: f64,
    ln_dispersion: f64,
}

/// Surfaces of both suites, with their errors.
#[derive(Clone, Debug, PartialEq)]
pub struct Surrogate {
    /// Each suite's, with its error.
    pub models: Vec<(Surface, Errors)>,
    /// The blocks of the errors.
    pub unseen: Vec<Fitted>,
}

impl Surrogate {
    /// The one that ships.
    ///
    /// # Errors
    /// None in practice: the tables are fixed.
    pub fn embedded() -> Result<Self, SurrogateError> {
        Self::parse(COEFFICIENTS, UNSEEN)
    }

    /// From the texts of its two tables.
    ///
    /// # Errors
    /// [`SurrogateError`] for tables of another form.
    pub fn parse(
        coefficients: &str,
        unseen: &str,
    ) -> Result<Self, SurrogateError> {
        let unseen = read_table("unseen.csv", unseen)?;
        let mut models: Vec<Surface> = SuiteKind::ALL
            .map(|suite| Surface {
                suite,
                terms: Vec::new(),
                coefficients: [Vec::new(), Vec::new()],
            })
            .into();
        let expected = "a table of fixtures/surrogate";
        let found =
            rows::<Coefficient>("coefficients.csv", coefficients, expected)?;
        for (_, row) in found {
            for model in models.iter_mut().filter(|m| m.suite == row.suite) {
                model.terms.push((row.degree_p, row.degree_alpha));
                model.coefficients[0].push(row.mu);
                model.coefficients[1].push(row.ln_dispersion);
            }
        }
        let with = |model: Surface| {
            let errors = model.errors(&unseen)?;
            Ok((model, errors))
        };
        let models = models
            .into_iter()
            .map(with)
            .collect::<Result<_, SurrogateError>>()?;
        Ok(Self { models, unseen })
    }

    /// The coefficients as CSV.
    #[must_use]
    pub fn coefficients(models: &[Surface]) -> String {
        let mut table =
            Table::headed("suite,degree_p,degree_alpha,mu,ln_dispersion");
        for model in models {
            let [mu, beta] = &model.coefficients;
            for (k, (i, j)) in model.terms.iter().enumerate() {
                table.row([
                    model.suite.name().to_owned(),
                    i.to_string(),
                    j.to_string(),
                    number(mu[k]),
                    number(beta[k]),
                ]);
            }
        }
        table.finish()
    }
}
