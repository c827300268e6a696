//! Records of shared earthquakes: what intervals and tests do when the truth
//! is known, and numbers of other packages.
//!
//! ln capacity of record r of earthquake g is sqrt(c) u_g + sqrt(1 - c) e_r
//! times the dispersion, with standard normal u and e and the intraclass
//! correlation c.

use anyhow::{Result, anyhow};
use libm::exp;
use rayon::prelude::*;
use rocking_procedures::counts::RecordOutcome;
use rocking_procedures::fragility::hazard::{Hazard, HazardOptions};
use rocking_procedures::{
    Draws, FitOptions, FragilityInput, fit_outcomes, fit_sample, risk,
};
use rocking_statistics::regression::mixed;
use rocking_statistics::streams::{Streams, standard_normal};
use rocking_statistics::{CensoredSample, Clusters, Estimate, Lognormal};
use serde::Deserialize;

use super::truths::{SuiteShape, share};
use crate::methods::cells::{Csv, csv};
use crate::methods::method::{Context, Reply};

const VALUES: Csv = csv!("oracles/earthquakes.csv");

/// Dispersion of the simulated capacities; their median is 1.
const DISPERSION: f64 = 0.5;

/// Replicates of an interval.
const REPLICATES: usize = 400;

/// What is judged.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum RateMeasure {
    /// BCa interval of the median.
    Median,
    /// BCa interval of the dispersion.
    Dispersion,
    /// Bootstrap band of the probability at the intensity 0.7.
    Probability,
    /// Interval of the annual frequency under the hazard 1e-4 x^-2.
    AnnualFrequency,
    /// Interval of the median of counts, of stripes of the same records.
    Counts,
    /// The test of a slope on an attribute of the earthquake that has none.
    Slope,
}

/// Share of simulated suites whose interval holds the truth, or whose slope
/// on an attribute without meaning is rejected at 5 %.
pub fn rates(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        measure: RateMeasure, suite: SuiteShape, intraclass: f64, trials: u64,
    }
    let shape = suite.clusters();
    let taken = context.drawn(&shape);
    let streams = Streams::new(&format!("cases/{}", context.case.id), 0);
    let trial = |index: u64| -> Result<bool> {
        let mut stream = streams.stream(index);
        let mut normals = |n: usize| -> Vec<f64> {
            (0..n).map(|_| standard_normal(&mut stream)).collect()
        };
        let shared = normals(shape.count());
        let attribute = normals(shape.count());
        let own = normals(shape.records());
        let logs: Vec<f64> = own
            .iter()
            .enumerate()
            .map(|(record, own)| {
                let shared = shared[shape.cluster_of(record)];
                let between = intraclass.sqrt() * shared;
                DISPERSION * (between + (1.0 - intraclass).sqrt() * own)
            })
            .collect();
        if matches!(measure, RateMeasure::Slope) {
            let x: Vec<f64> = (0..logs.len())
                .map(|r| attribute[shape.cluster_of(r)])
                .collect();
            let found = mixed(&x, &logs, &taken)?;
            return Ok(found.p_value < 0.05);
        }
        let values: Vec<f64> = logs.iter().map(|y| exp(*y)).collect();
        holds(measure, &values, &taken, index)
    };
    let found = (0..trials).into_par_iter().panic_fuse().map(trial);
    let rate = share(&found.collect::<Result<Vec<bool>>>()?);
    let nominal =
        if matches!(measure, RateMeasure::Slope) { 0.05 } else { 0.95 };
    answer.put("rate", [rate], [nominal]);
    Ok(())
}

/// Whether the interval of a measure holds its truth.
fn holds(
    measure: RateMeasure,
    values: &[f64],
    clusters: &Clusters,
    seed: u64,
) -> Result<bool> {
    const AT: f64 = 0.7;
    let draws = Draws { replicates: REPLICATES, seed };
    let holds = |of: Estimate, truth: f64| {
        of.interval().is_some_and(|interval| interval.holds(truth))
    };
    let truth = Lognormal::try_new(0.0, 0.0, DISPERSION)?;
    if matches!(measure, RateMeasure::Counts) {
        let stripe = |&im: &f64| {
            let of = move |(record, x): (usize, &f64)| RecordOutcome {
                im,
                record,
                exceeded: *x <= im,
            };
            values.iter().enumerate().map(of)
        };
        let levels = [0.5, 0.75, 1.0, 1.35, 2.0];
        let draws = Draws { replicates: REPLICATES / 2, seed };
        let outcomes: Vec<RecordOutcome> =
            levels.iter().flat_map(stripe).collect();
        let found = fit_outcomes(&outcomes, clusters, 0.0, Some(draws));
        return Ok(holds(found?.median, 1.0));
    }
    let sample = CensoredSample::try_new(values, &[])?;
    let options = FitOptions {
        draws: Some(draws),
        clusters: Some(clusters.clone()),
        band: vec![AT],
        ..FitOptions::default()
    };
    if matches!(measure, RateMeasure::AnnualFrequency) {
        let text = "intensity,annual_frequency\n1e-6,1e8\n1e6,1e-16\n";
        let hazard = Hazard::parse("h", text, &HazardOptions::default());
        let exposed = |fitted, sampled| FragilityInput {
            fragility: "block".into(),
            fitted,
            sampled,
        };
        let fit = fit_sample(&sample, &options)?;
        let sampled = options.sampled(&sample)?;
        let all = [exposed(fit.fitted, sampled)];
        let found = risk(&hazard?, &all, 50.0);
        let found = found?;
        let own = found.fragilities[0].sampling.as_ref();
        // Cornell's closed form.
        let lambda = 1e-4 * exp(2.0 * DISPERSION * DISPERSION);
        return Ok(own.is_some_and(|own| holds(own.annual_frequency, lambda)));
    }
    let fit = fit_sample(&sample, &options)?;
    if matches!(measure, RateMeasure::Probability) {
        let point = fit.band.as_ref().and_then(|band| band.points.first());
        let truth = truth.cdf(AT);
        return Ok(point.is_some_and(|point| holds(point.probability, truth)));
    }
    let none = || anyhow!("no bootstrap");
    let all = fit.bootstrap.ok_or_else(none)?;
    let (own, truth) = match measure {
        RateMeasure::Dispersion => (all.dispersion, DISPERSION),
        _ => (all.median, 1.0),
    };
    Ok(own.is_some_and(|found| holds(found.estimate, truth)))
}

/// Slopes with a random intercept, and what widens an interval of few
/// earthquakes.
pub fn other_packages(context: &Context, answer: &mut Reply) -> Result<()> {
    let clusters = |text: &'static str| {
        context.drawn(&Clusters::from_labels(text.split(' ')))
    };
    for row in VALUES.rows("line")? {
        let (x, y) = (row.list(2, ' ')?, row.list(3, ' ')?);
        let found = mixed(&x, &y, &clusters(row.text(4)))?;
        let quantities = [
            ("intercept", found.intercept),
            ("slope", found.slope),
            ("standard-error", found.standard_error),
            ("within", found.residual_deviation),
            ("between", found.event_deviation.unwrap_or(0.0)),
            ("degrees-of-freedom", found.degrees_of_freedom),
            ("p-value", found.p_value),
        ];
        row.put(answer, 5, &quantities)?;
    }
    for row in VALUES.rows("share")? {
        let logs = row.list(2, ' ')?;
        let clusters = clusters(row.text(3));
        let share = clusters.intraclass(&logs).unwrap_or(0.0);
        let values: Vec<f64> = logs.iter().map(|y| exp(*y)).collect();
        let sample = CensoredSample::try_new(&values, &[])?;
        let clusters = Some(clusters);
        let options = FitOptions { clusters, ..FitOptions::default() };
        let fit = fit_sample(&sample, &options)?;
        let none = || anyhow!("no design effect");
        let needed = fit.needed.ok_or_else(none)?;
        let quantities = [
            ("share", share),
            ("records", needed.for_median),
            ("records", needed.for_dispersion),
        ];
        row.put(answer, 4, &quantities)?;
    }
    for row in VALUES.rows("interval")? {
        let own = clusters(row.text(2));
        let nu = own.degrees_of_freedom();
        let width = own.half_width(0.95);
        row.put(answer, 3, &[("freedom", nu), ("half-width", width)])?;
    }
    Ok(())
}
