//! Two samples over different records.

use std::collections::BTreeSet;

use rayon::prelude::*;
use thiserror::Error;

use super::fit::IntervalBasis;
use super::{Draws, ProcedureError};
use rocking::accelerogram::are_places;
use rocking::stop;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::resampling::IntervalRemark;
use rocking_statistics::two_sample::kolmogorov_smirnov;
use rocking_statistics::{
    CensoredSample, Clusters, Estimate, ExtendedSample, QuantileType, Range,
    SampleError,
};

/// Most values of a sample: the time of the exact p-value grows with the
/// product of both numbers.
const MOST: usize = 3000;

/// Why a contrast was rejected, or has no interval.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ContrastError {
    /// A value that is not positive.
    #[error("value {number} is {value}: expected a positive number, or inf")]
    Value {
        /// Place in its sample, from 1.
        number: usize,
        /// The value.
        value: f64,
    },
    /// Too many values for the exact test.
    #[error("{0} values: expected at most {MOST}")]
    Many(usize),
    /// Earthquakes and values differ in number.
    #[error(
        "{events} earthquakes for {values} values: expected one per value"
    )]
    Events {
        /// Number of earthquakes.
        events: usize,
        /// Number of values.
        values: usize,
    },
    /// A record twice in a sample.
    #[error("record {0} occurs twice in a sample: expected each record once")]
    Twice(String),
    /// A record in both samples.
    #[error(
        "record {0} is in both samples: expected samples of different \
         records; a comparison pairs samples of the same records"
    )]
    Shared(String),
    /// Invalid draws.
    #[error(transparent)]
    Draws(#[from] ProcedureError),
    /// No value is left.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// A median that is unknown because of censored values.
    #[error("a median is censored: the ratio is not known")]
    Open,
    /// The test is one of independent values.
    #[error(
        "records of shared earthquakes are not independent: no p-value; the \
         interval draws earthquakes"
    )]
    Dependent,
}

/// One of two samples, with the names and earthquakes of its records.
#[derive(Clone, Copy, Debug)]
pub struct ContrastSample<'a, S> {
    /// One positive value per record, infinite if censored.
    pub sample: &'a CensoredSample,
    /// Names of the records; empty if they are not known.
    pub records: &'a [S],
    /// Earthquakes of the records; empty if they are not known.
    pub events: &'a [S],
}

/// Ratio of the medians of two samples over different records, and the
/// distance of their distributions.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Contrast {
    /// The first sample.
    pub a: Half,
    /// The second sample.
    pub b: Half,
    /// Ratio of the medians, first sample over second, with its bootstrap
    /// interval.
    #[serde(serialize_with = "super::or_reason")]
    pub median_ratio: Result<MedianRatio, ContrastError>,
    /// Kolmogorov and Smirnov's comparison.
    pub kolmogorov_smirnov: Distance,
    /// Draws of the bootstrap.
    #[serde(flatten)]
    pub draws: Draws,
}

/// One sample of a contrast.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Half {
    /// Size, censored values included.
    pub n: usize,
    /// Number of censored values.
    pub censored: usize,
    /// Median (type 5); `None` if censored values leave it unknown.
    pub median: Option<f64>,
    /// The units that the bootstrap draws.
    pub drawn: Clusters,
}

/// A ratio of medians with its interval.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct MedianRatio {
    /// The ratio; without an interval if a tenth of the draws leave it open
    /// or none moves it.
    #[serde(flatten)]
    pub estimate: Estimate,
    /// Level of the interval.
    pub level: f64,
    /// Draws in which censored values leave the ratio open.
    pub open: usize,
    /// Why the interval is rough: few records or earthquakes on a side, or few
    /// draws.
    pub remark: Option<IntervalRemark>,
}

/// Distance of two empirical distributions.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Distance {
    /// Largest difference of the distributions.
    pub distance: f64,
    /// Compared up to the least limit of a censored value, if one is known.
    pub up_to: Option<f64>,
    /// Exact p-value of independent records; an upper bound with ties.
    #[serde(serialize_with = "super::or_reason")]
    pub p_value: Result<f64, ContrastError>,
}

/// Contrasts two samples over different records.
///
/// The interval is Student's t on the logarithm, with the standard error of a
/// bootstrap and the degrees of freedom of the sample that has fewer. The
/// bootstrap draws the records of each sample or, if they are known, the
/// earthquakes with all their records; an earthquake with records in both
/// samples is drawn for both.
///
/// ```
/// use rocking_procedures::contrast::{ContrastSample, contrast};
/// use rocking_procedures::Draws;
/// use rocking_statistics::CensoredSample;
/// let sample = |values: &[f64]| CensoredSample::try_new(values, &[]);
/// let (pulse, ordinary) =
///     (sample(&[1.1, 1.3, 1.4, 1.8])?, sample(&[2.2, 2.6, 2.8, 3.6, 9.0])?);
/// fn all(sample: &CensoredSample) -> ContrastSample<'_, &str> {
///     ContrastSample { sample, records: &[], events: &[] }
/// }
/// let draws = Draws { replicates: 200, seed: 0 };
/// let found = contrast(all(&pulse), all(&ordinary), draws)?;
/// let ratio = found.median_ratio?;
/// assert!((ratio.estimate.value() - 1.35 / 2.8).abs() < 1e-12);
/// let remark = ratio.remark.unwrap().to_string();
/// assert_eq!(remark, "intervals are rough: 4 records, fewer than 8");
/// // Two of the 126 orders of 4 and 5 values separate the samples.
/// let p_value = found.kolmogorov_smirnov.p_value?;
/// assert!((p_value - 2.0 / 126.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ContrastError`] for a value that is not positive, more than 3000 values,
/// a record that occurs twice in a sample or in both, and invalid draws.
pub fn contrast<S: AsRef<str>>(
    a: ContrastSample<'_, S>,
    b: ContrastSample<'_, S>,
    draws: Draws,
) -> Result<Contrast, ContrastError> {
    draws.check()?;
    let (a, b) = (&a, &b);
    a.check()?;
    b.check()?;
    refuse_shared(a, b)?;
    let (of_a, of_b) = (a.half(), b.half());
    let independent = of_a.drawn.is_singletons() && of_b.drawn.is_singletons();
    let median_ratio = match (of_a.median, of_b.median) {
        (Some(x), Some(y)) => {
            let ratios = ratios((a, b), draws);
            let freedom = |of: &Clusters| match of.count() {
                0 | 1 => 0.0,
                _ => of.degrees_of_freedom(),
            };
            let b_has_more = freedom(&of_a.drawn) < freedom(&of_b.drawn);
            let of = if b_has_more { &of_a.drawn } else { &of_b.drawn };
            let basis = IntervalBasis::new(draws, of);
            let range = Range::NotNegative;
            Ok(MedianRatio {
                estimate: basis.value(x / y, &ratios, range).estimate,
                level: basis.level,
                open: ratios.iter().filter(|x| !x.is_finite()).count(),
                remark: basis.remark,
            })
        }
        _ => Err(ContrastError::Open),
    };
    let limits = [a, b].into_iter().flat_map(|of| of.sample.limits());
    let up_to = limits.flatten().copied().reduce(f64::min);
    let cut = |of: &ContrastSample<'_, S>| {
        let most = up_to.unwrap_or(f64::INFINITY);
        let cut = |x: &f64| if *x <= most { *x } else { f64::INFINITY };
        let values = of.sample.values().iter().map(cut);
        ExtendedSample::try_new(&values.collect::<Vec<f64>>())
    };
    let found = kolmogorov_smirnov(&cut(a)?, &cut(b)?);
    let p_value = independent.then_some(found.p_value);
    let kolmogorov_smirnov = Distance {
        distance: found.statistic,
        up_to,
        p_value: p_value.ok_or(ContrastError::Dependent),
    };
    Ok(Contrast { a: of_a, b: of_b, median_ratio, kolmogorov_smirnov, draws })
}

impl<S: AsRef<str>> ContrastSample<'_, S> {
    fn check(&self) -> Result<(), ContrastError> {
        let values = self.sample.values();
        if values.len() > MOST {
            return Err(ContrastError::Many(values.len()));
        }
        if let Some(place) = values.iter().position(|x| !(*x > 0.0)) {
            let (number, value) = (place + 1, values[place]);
            return Err(ContrastError::Value { number, value });
        }
        let (events, values) = (self.events.len(), values.len());
        if events > 0 && events != values {
            return Err(ContrastError::Events { events, values });
        }
        let mut seen = BTreeSet::<&str>::new();
        let mut names = self.records.iter().map(AsRef::as_ref);
        match names.find(|name| !seen.insert(*name)) {
            Some(name) => Err(ContrastError::Twice(name.to_owned())),
            None => Ok(()),
        }
    }

    fn half(&self) -> Half {
        Half {
            n: self.sample.len(),
            censored: self.sample.censored(),
            median: median(self.sample),
            drawn: Clusters::of_events(self.events, self.sample.len()),
        }
    }
}

/// Rejects samples with a record in common; places do not count as names.
fn refuse_shared<S: AsRef<str>>(
    a: &ContrastSample<'_, S>,
    b: &ContrastSample<'_, S>,
) -> Result<(), ContrastError> {
    if are_places(a.records) || are_places(b.records) {
        return Ok(());
    }
    match set(a.records).intersection(&set(b.records)).next() {
        None => Ok(()),
        Some(name) => Err(ContrastError::Shared((*name).to_owned())),
    }
}

fn set<S: AsRef<str>>(names: &[S]) -> BTreeSet<&str> {
    names.iter().map(AsRef::as_ref).collect()
}

/// The median, if it is a number.
fn median(sample: &CensoredSample) -> Option<f64> {
    let median = sample.quantile(QuantileType::default(), 0.5);
    median.filter(|median| median.is_finite())
}

/// Ratios of the medians of draws; NaN if censored values leave them open.
fn ratios<S: AsRef<str>>(
    (a, b): (&ContrastSample<'_, S>, &ContrastSample<'_, S>),
    draws: Draws,
) -> Vec<f64> {
    let n = a.sample.len();
    // Earthquakes of the first sample, of the second, and of both.
    let (own, others) = (set(a.events), set(b.events));
    let mut parts: [(Vec<usize>, Vec<String>); 3] = Default::default();
    for (side, of) in [a, b].into_iter().enumerate() {
        for i in 0..of.sample.len() {
            let event = of.events.get(i).map(AsRef::as_ref);
            let is_shared =
                event.is_some_and(|e| own.contains(e) && others.contains(e));
            let part = &mut parts[if is_shared { 2 } else { side }];
            part.0.push(side * n + i);
            part.1.push(event.map_or_else(|| i.to_string(), str::to_owned));
        }
    }
    let names = ["contrast/a", "contrast/b", "contrast/both"];
    let drawn = names.into_iter().zip(parts);
    let drawn: Vec<(Vec<usize>, Bootstrap)> = drawn
        .filter(|(_, (places, _))| !places.is_empty())
        .map(|(name, (places, labels))| {
            (places, draws.of(name, &Clusters::from_labels(labels)))
        })
        .collect();
    let of_draw = |index: u64| -> Option<f64> {
        stop::point();
        let places = drawn.iter().flat_map(|(places, draws)| {
            draws.draw(index).into_iter().map(move |i| places[i])
        });
        let (of_a, of_b): (Vec<usize>, Vec<usize>) =
            places.partition(|place| *place < n);
        if of_a.is_empty() || of_b.is_empty() {
            return None;
        }
        let of_b: Vec<usize> = of_b.iter().map(|place| place - n).collect();
        let x = median(&a.sample.resample(&of_a))?;
        Some(x / median(&b.sample.resample(&of_b))?)
    };
    let all = (0..draws.replicates as u64).into_par_iter().panic_fuse();
    all.map(|index| of_draw(index).unwrap_or(f64::NAN)).collect()
}

#[cfg(test)]
mod tests;
