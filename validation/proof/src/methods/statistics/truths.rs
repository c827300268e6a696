//! Simulated truths.

use libm::{exp, log, log1p, tan};
use rand_distr::{Distribution as _, Exp1, Gamma};
use rayon::prelude::*;
use rocking::streams::{Streams, below, standard_normal};
use serde::Deserialize;

use super::cells::refused;
use crate::error::MethodError;

/// The law of the values that are tested or fitted, in logarithms where the
/// study takes them.
#[derive(Clone, Copy, Deserialize)]
#[serde(
    tag = "law",
    rename_all = "kebab-case",
    rename_all_fields = "kebab-case",
    deny_unknown_fields
)]
pub(super) enum Truth {
    /// z: the null.
    Normal,
    /// ln(1 + m exp(beta z)): unshifted, of a shifted lognormal.
    Unshifted { excess: f64, dispersion: f64 },
    /// ln(x - 1) of x = 1 + m exp(beta z) put on the next level of the grid
    /// of 0.01 g.
    Gridded { excess: f64, dispersion: f64, slenderness_rad: f64 },
    /// beta z, a share of the values times a factor.
    Contaminated { dispersion: f64, one_in: usize, factor: f64 },
    /// ln of a Weibull variate (shape drops out).
    Weibull,
    /// ln of a gamma variate.
    Gamma { shape: f64 },
    /// exp(beta z), for what is fitted to the values themselves.
    Lognormal { dispersion: f64 },
}

impl Truth {
    /// Samples of n values, by index; `f` of each, in that order.
    pub(super) fn map<T: Send>(
        self,
        name: &str,
        n: usize,
        trials: u64,
        f: impl Fn(&[f64]) -> Result<T, MethodError> + Sync,
    ) -> Result<Vec<T>, MethodError> {
        let streams = Streams::new(&format!("case, {name}"), 0);
        (0..trials)
            .into_par_iter()
            .map(|index| f(&self.sample(&streams, index, n)?))
            .collect()
    }

    fn sample(
        self,
        streams: &Streams,
        index: u64,
        n: usize,
    ) -> Result<Vec<f64>, MethodError> {
        let stream = &mut streams.stream(index);
        let gamma = match self {
            Self::Gamma { shape } => {
                Some(Gamma::new(shape, 1.0).map_err(refused)?)
            }
            _ => None,
        };
        Ok((0..n)
            .map(|_| match self {
                Self::Normal => standard_normal(stream),
                Self::Unshifted { excess, dispersion } => {
                    log1p(excess * exp(dispersion * standard_normal(stream)))
                }
                Self::Gridded { excess, dispersion, slenderness_rad } => {
                    let x = 1.0
                        + excess * exp(dispersion * standard_normal(stream));
                    let step = 0.01 / tan(slenderness_rad);
                    log((x / step).ceil() * step - 1.0)
                }
                Self::Contaminated { dispersion, one_in, factor } => {
                    let z = dispersion * standard_normal(stream);
                    let hit = below(stream, one_in) == 0;
                    if hit { z + log(factor) } else { z }
                }
                Self::Weibull => {
                    let e: f64 = Exp1.sample(stream);
                    log(e)
                }
                Self::Gamma { .. } => {
                    gamma.map_or(f64::NAN, |g| log(g.sample(stream)))
                }
                Self::Lognormal { dispersion } => {
                    exp(dispersion * standard_normal(stream))
                }
            })
            .collect())
    }
}
