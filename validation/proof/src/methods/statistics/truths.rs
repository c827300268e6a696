//! Simulated truths.

use std::convert::Infallible;

use anyhow::Result;
use libm::{exp, log, log1p, tan};
use rand::TryRng;
use rand_distr::{Distribution as _, Exp1, Gamma};
use rayon::prelude::*;
use rocking_statistics::lognormal::FitMethod;
use rocking_statistics::streams::{Stream, Streams, below, standard_normal};
use rocking_statistics::{Clusters, Interval, QuantileType, Sample};
use serde::Deserialize;

use crate::methods::method::{Context, WrongModel};

/// A stream as a generator of `rand_distr`.
pub(super) struct StreamRng<'a>(pub &'a mut Stream);

impl TryRng for StreamRng<'_> {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        Ok((self.0.next_u64() >> 32) as u32)
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        Ok(self.0.next_u64())
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        for part in bytes.chunks_mut(8) {
            let word = self.0.next_u64().to_le_bytes();
            part.copy_from_slice(&word[..part.len()]);
        }
        Ok(())
    }
}

/// The law of the tested or fitted values; in logarithms if the study takes
/// logarithms.
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
    /// `f` of samples of n values, in the order of their indices.
    pub(super) fn map<T: Send>(
        self,
        name: &str,
        n: usize,
        trials: u64,
        f: impl Fn(&[f64]) -> Result<T> + Sync,
    ) -> Result<Vec<T>> {
        let streams = Streams::new(&format!("case, {name}"), 0);
        self::trials(trials, |index| f(&self.sample(&streams, index, n)?))
    }

    fn sample(
        self,
        streams: &Streams,
        index: u64,
        n: usize,
    ) -> Result<Vec<f64>> {
        let stream = &mut streams.stream(index);
        let mut draw = || {
            Ok(match self {
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
                    let e: f64 = Exp1.sample(&mut StreamRng(stream));
                    log(e)
                }
                Self::Gamma { shape } => {
                    let law = Gamma::new(shape, 1.0)?;
                    log(law.sample(&mut StreamRng(stream)))
                }
                Self::Lognormal { dispersion } => {
                    exp(dispersion * standard_normal(stream))
                }
            })
        };
        (0..n).map(|_| draw()).collect()
    }
}

/// Records by earthquake: of the recorded suites, and of few earthquakes.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum SuiteShape {
    Ordinary,
    Pulse,
    Eight,
    Five,
    Three,
}

impl SuiteShape {
    pub(super) fn clusters(self) -> Clusters {
        let sizes: &[usize] = match self {
            Self::Ordinary => &[
                12, 12, 11, 9, 6, 5, 5, 4, 4, 3, 2, 2, 2, 1, 1, 1, 1, 1, 1, 1,
                1, 1,
            ],
            Self::Pulse => &[6, 6, 6, 6, 3, 2, 2, 2, 2, 2, 2, 1, 1, 1, 1, 1],
            Self::Eight => &[8, 6, 5, 4, 3, 2, 2, 1],
            Self::Five => &[8, 6, 5, 4, 3],
            Self::Three => &[8, 7, 6],
        };
        let labels = sizes
            .iter()
            .enumerate()
            .flat_map(|(g, size)| std::iter::repeat_n(g.to_string(), *size));
        Clusters::from_labels(labels)
    }
}

/// The method of a fit; by mistake with the other divisor, of the uncensored
/// values only, or by moments instead of quantiles.
pub(super) fn divided(context: &Context, method: FitMethod) -> FitMethod {
    match method {
        own if !context.is(WrongModel::OtherDivisor) => own,
        FitMethod::Moment => FitMethod::MaximumLikelihood,
        FitMethod::Censored(kind) => FitMethod::Trimmed(kind),
        _ => FitMethod::Moment,
    }
}

/// The result of each trial, in their order.
pub(super) fn trials<T: Send>(
    count: u64,
    trial: impl Fn(u64) -> Result<T> + Sync + Send,
) -> Result<Vec<T>> {
    (0..count).into_par_iter().panic_fuse().map(trial).collect()
}

/// Share of true values.
pub(super) fn share(held: &[bool]) -> f64 {
    held.iter().filter(|held| **held).count() as f64 / held.len() as f64
}

/// The percentiles of replicates (type 7) as ends of an interval.
pub(super) fn percentiles(values: &[f64], level: f64) -> Option<Interval> {
    let finite = values.iter().copied().filter(|x| x.is_finite());
    let sample = Sample::try_new(&finite.collect::<Vec<f64>>()).ok()?;
    let rule = QuantileType::try_new(7).ok()?;
    let at = |p| rule.quantile(&sample, p).ok();
    let ends = (at(0.5 - 0.5 * level)?, at(0.5 + 0.5 * level)?);
    Interval::try_new(ends.0, ends.1).ok()
}
