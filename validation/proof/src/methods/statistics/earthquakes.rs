//! Records of shared earthquakes: error rates of intervals and tests under a
//! known truth, and numbers of other packages.
//!
//! ln capacity of record r of earthquake g is sqrt(c) u_g + sqrt(1 - c) e_r
//! times the dispersion, with standard normal u and e and the intraclass
//! correlation c.

use anyhow::{Context as _, Result};
use libm::{exp, pow};
use rocking_procedures::counts::RecordOutcome;
use rocking_procedures::fragility::hazard::{Hazard, HazardOptions};
use rocking_procedures::fragility::total::TotalFragility;
use rocking_procedures::{
    Draws, FitOptions, FragilityInput, fit_outcomes, fit_sample, risk,
};
use rocking_statistics::regression::mixed;
use rocking_statistics::resampling::Resampling;
use rocking_statistics::streams::{Streams, standard_normal};
use rocking_statistics::{
    CensoredSample, Clusters, Estimate, Lognormal, Range, normal,
};
use serde::Deserialize;

use super::truths::{SuiteShape, percentiles, share, trials};
use crate::methods::cells::Csv;
use crate::methods::method::{Context, Memo, Reply, WrongModel};

const VALUES: Csv = Csv::new("oracles/earthquakes.csv");

/// Dispersion of the simulated capacities; their median is 1.
const DISPERSION: f64 = 0.5;

/// Replicates of an interval: they give a standard error to 5 %.
const REPLICATES: usize = 200;

/// The hazard 1e-4 x^-2.5: complete, and for the law above 1.
const HAZARD: &str = "intensity,annual_frequency\n1e-6,1e11\n1e6,1e-19\n";
const HAZARD_ABOVE: &str = "intensity,annual_frequency\n\
    1.01,9.754310265758153e-05\n100,1e-9\n";

/// Annual frequency of the law above 1: 1e-4 times the mean of (1 + x)^-2.5,
/// by SciPy's quad.
const ABOVE_SHIFT: f64 = 1.952_210_448_109_6e-5;

/// The rate that is measured.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum RateMeasure {
    /// Interval of the median of counts, of stripes of the same records.
    Counts,
    /// The test of a slope on an irrelevant attribute of the earthquake.
    Slope,
}

/// Share of simulated suites whose interval covers the truth, or whose slope
/// on an irrelevant attribute is rejected at 5 %.
pub fn rates(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        measure: RateMeasure, suite: SuiteShape, intraclass: f64, trials: u64,
    }
    let nominal = match measure {
        RateMeasure::Counts => 0.95,
        RateMeasure::Slope => 0.05,
    };
    let found = self::trials(trials, |k| {
        let own = Simulated::new(context, suite, intraclass, k);
        if let RateMeasure::Counts = measure {
            return own.counts_hold(k);
        }
        let found = mixed(&own.attribute, &own.logs, &own.drawn)?;
        Ok(found.p_value < 0.05)
    })?;
    answer.put("rate", [share(&found)], [nominal]);
    Ok(())
}

/// Shares of simulated suites whose intervals of a fit cover the truth: of the
/// median, the dispersion, the probability at the intensity 0.7, and the
/// annual frequencies under the hazard 1e-4 x^-2.5 without a shift and of the
/// same law above 1.
pub fn coverage_of_fits(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context; suite: SuiteShape, intraclass: f64, trials: u64, }
    let by_record = context.is(WrongModel::RecordsAsUnit);
    let found = FITS.get((context.case.id.clone(), by_record), |_| {
        self::trials(trials, |index| {
            let suite = Simulated::new(context, suite, intraclass, index);
            suite.intervals(index)
        })
    })?;
    for k in 0..5 {
        let holds = |suite: &[FitInterval; 5]| suite[k].holds(context.wrong);
        let held: Vec<bool> = found.iter().map(holds).collect();
        answer.put(found[0][k].name, [share(&held)], [0.95]);
    }
    Ok(())
}

/// Intervals by case, and whether records are the unit of resampling.
static FITS: Memo<(String, bool), [FitInterval; 5]> = Memo::new();

/// An interval of a fit, and what wrong models make of its replicates.
struct FitInterval {
    name: &'static str,
    estimate: Option<Estimate>,
    drawn: Vec<f64>,
    /// Normal quantile over Student's.
    ratio: f64,
    truth: f64,
}

impl FitInterval {
    fn holds(&self, wrong: Option<WrongModel>) -> bool {
        let ends = match (wrong, self.estimate) {
            (Some(WrongModel::Percentiles), _) => {
                percentiles(&self.drawn, 0.95)
            }
            (Some(WrongModel::NormalForStudent), Some(of)) => {
                let nearer = |x| of.value() * pow(x / of.value(), self.ratio);
                of.interval().map(|ends| ends.map(nearer))
            }
            (_, of) => of.and_then(|of| of.interval()),
        };
        ends.is_some_and(|ends| ends.holds(self.truth))
    }
}

/// Capacities of one suite.
struct Simulated {
    logs: Vec<f64>,
    /// By record, one value an earthquake.
    attribute: Vec<f64>,
    /// Units of resampling.
    drawn: Clusters,
}

impl Simulated {
    fn new(
        context: &Context,
        suite: SuiteShape,
        intraclass: f64,
        index: u64,
    ) -> Self {
        let shape = suite.clusters();
        let name = format!("cases/{}", context.case.id);
        let mut stream = Streams::new(&name, 0).stream(index);
        let mut normals = |n: usize| -> Vec<f64> {
            (0..n).map(|_| standard_normal(&mut stream)).collect()
        };
        let shared = normals(shape.count());
        let attribute = normals(shape.count());
        let own = normals(shape.records());
        let of = |(record, own): (usize, &f64)| {
            let shared = shared[shape.cluster_of(record)];
            let between = intraclass.sqrt() * shared;
            DISPERSION * (between + (1.0 - intraclass).sqrt() * own)
        };
        let logs = own.iter().enumerate().map(of).collect();
        let attribute = (0..shape.records())
            .map(|record| attribute[shape.cluster_of(record)])
            .collect();
        Self { logs, attribute, drawn: context.drawn(&shape) }
    }

    fn values(&self) -> Vec<f64> {
        self.logs.iter().map(|y| exp(*y)).collect()
    }

    /// True if the interval of the median of counts, from five stripes of the
    /// same records, covers it.
    fn counts_hold(&self, seed: u64) -> Result<bool> {
        let values = self.values();
        let draws = Draws { replicates: REPLICATES, seed };
        let mut outcomes = Vec::new();
        for im in [0.5, 0.75, 1.0, 1.35, 2.0] {
            for (record, x) in values.iter().enumerate() {
                let exceeded = *x <= im;
                outcomes.push(RecordOutcome { im, record, exceeded });
            }
        }
        let found = fit_outcomes(&outcomes, &self.drawn, 0.0, Some(draws))?;
        Ok(found.median.interval().is_some_and(|ends| ends.holds(1.0)))
    }

    /// The intervals of a fit.
    fn intervals(&self, seed: u64) -> Result<[FitInterval; 5]> {
        const AT: f64 = 0.7;
        let sample = CensoredSample::try_new(&self.values(), &[])?;
        let options = FitOptions {
            draws: Some(Draws { replicates: REPLICATES, seed }),
            clusters: Some(self.drawn.clone()),
            ..FitOptions::default()
        };
        let none = "no bootstrap";
        let fitted = sample.fit(0.0, options.method)?.distribution;
        let sampled = options.sampled(&sample)?.context(none)?;
        let student = self.drawn.student(0.95).context(none)?;
        let ratio = normal::quantile(0.975) / student;
        let interval = |name, estimate, drawn: Vec<f64>, truth| FitInterval {
            name,
            estimate,
            drawn,
            ratio,
            truth,
        };
        let drawn = |of: &dyn Fn(&TotalFragility) -> f64| {
            let of = |law: &Option<_>| law.as_ref().map_or(f64::NAN, of);
            sampled.fitted.iter().map(of).collect::<Vec<f64>>()
        };
        let of_law = |name, of: fn(&Lognormal) -> f64, truth: f64| {
            let drawn = drawn(&|law| of(law.records()));
            let (how, range) = (Resampling::Bootstrap, Range::NotNegative);
            let point = of(&fitted);
            let found = self.drawn.estimate(point, &drawn, how, range, 0.95);
            interval(name, found.map(|found| found.estimate), drawn, truth)
        };
        let band = sampled.band(&fitted.into(), &[AT]).points[0].probability;
        let drawn = drawn(&|law| law.cdf(AT));
        let truth = Lognormal::try_new(0.0, 0.0, DISPERSION)?.cdf(AT);
        // Cornell's closed form.
        let cornell = 1e-4 * exp(0.5 * 2.5 * 2.5 * DISPERSION * DISPERSION);
        let frequency = |name, shift: f64, truth: f64| -> Result<_> {
            let text = if shift > 0.0 { HAZARD_ABOVE } else { HAZARD };
            let hazard = Hazard::parse("h", text, &HazardOptions::default())?;
            let above = |law: &Lognormal| {
                Lognormal::try_new(shift, law.log_mean(), law.dispersion())
                    .map(TotalFragility::from)
            };
            let mut sampled = sampled.clone();
            for law in sampled.fitted.iter_mut().flatten() {
                *law = above(law.records())?;
            }
            let of = FragilityInput {
                fragility: "block".into(),
                fitted: above(&fitted)?,
                sampled: Some(sampled),
            };
            let found = risk(&hazard, &[of], 50.0)?.fragilities.remove(0);
            let own = found.sampling.context(none)?;
            let drawn = own.drawn_annual_frequencies;
            Ok(interval(name, Some(own.annual_frequency), drawn, truth))
        };
        Ok([
            of_law("median", Lognormal::median, 1.0),
            of_law("dispersion", Lognormal::dispersion, DISPERSION),
            interval("probability", Some(band), drawn, truth),
            frequency("frequency", 0.0, cornell)?,
            frequency("frequency-above-shift", 1.0, ABOVE_SHIFT)?,
        ])
    }
}

/// Slopes with a random intercept, and the factors that widen an interval of
/// few earthquakes.
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
        let needed = fit_sample(&sample, &options)?.needed;
        let needed = needed.context("no design effect")?;
        let (median, dispersion) = (needed.for_median, needed.for_dispersion);
        let records = [("records", median), ("records", dispersion)];
        row.put(answer, 4, &[("share", share)])?;
        row.put(answer, 5, &records)?;
    }
    for row in VALUES.rows("interval")? {
        let own = clusters(row.text(2));
        let nu = own.degrees_of_freedom();
        let (t, effective) = (own.student(0.95), own.effective());
        let wider = (effective / (effective - 1.0)).sqrt();
        let width = wider * t.unwrap_or(f64::NAN);
        row.put(answer, 3, &[("freedom", nu), ("half-width", width)])?;
    }
    Ok(())
}
