//! Many analyses: how many in a second of processor time, in lanes and one
//! at a time, and what a sample takes.

use rayon::prelude::*;
use rocking::block::{Block, BlockError, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, Grid, IdaCurve, curve, curves};
use rocking::integrator::{Model, Observe, Overturning, Scene, respond};
use rocking::record::Accelerogram;
use rocking::statistics::lilliefors::NullDistribution;

use super::cases::ETA;
use super::clock::process_s;
use crate::cli::Failure;

/// A piece of work and what it took.
#[derive(Clone, Debug, PartialEq)]
pub struct Throughput {
    /// What was done.
    pub name: String,
    /// Threads that did it.
    pub threads: usize,
    /// Processor time of all threads, in s.
    pub cpu_s: f64,
    /// Analyses, or replicates.
    pub count: u64,
    /// Samples in flight (one step each), where there are such.
    pub samples: Option<u64>,
}

impl Throughput {
    /// Analyses or replicates in a second of processor time.
    #[must_use]
    pub fn rate_per_s(&self) -> f64 {
        self.count as f64 / self.cpu_s
    }

    /// Nanoseconds of processor time a sample.
    #[must_use]
    pub fn sample_ns(&self) -> Option<f64> {
        self.samples.map(|n| 1e9 * self.cpu_s / n as f64)
    }
}

/// The paper's analysis of every block in one of the two equations.
///
/// # Errors
/// None in practice: the blocks are in range.
pub fn analyses(
    blocks: &[Block],
    model: Model,
) -> Result<Vec<Analysis>, BlockError> {
    let restitution = Restitution::constant(ETA)?;
    let paper = |block: &Block| Analysis::paper(*block, restitution);
    Ok(blocks.iter().map(|b| Analysis { model, ..paper(b) }).collect())
}

/// Processor time of `work` on a pool of that many threads.
///
/// # Errors
/// [`Failure`] where threads cannot be started.
pub fn on_threads<T: Send>(
    threads: usize,
    work: impl FnOnce() -> T + Send,
) -> Result<(f64, T), Failure> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    Ok(pool.install(|| {
        let begin = process_s();
        let given = work();
        (process_s() - begin, given)
    }))
}

/// Curves in lanes.
///
/// # Errors
/// [`Failure`] for a record that cannot be analysed.
pub fn in_lanes(
    name: &str,
    threads: usize,
    records: &[NormalisedRecord],
    analyses: &[Analysis],
) -> Result<(Throughput, Vec<Vec<IdaCurve>>), Failure> {
    let (cpu_s, found) =
        on_threads(threads, || curves(records, analyses, || ()))?;
    let found = found?;
    let all = found.iter().flatten();
    let count = all.map(|c| c.analyses).fold(0, u64::saturating_add);
    let name = name.into();
    let measure = Throughput { name, threads, cpu_s, count, samples: None };
    Ok((measure, found))
}

/// The same curves one analysis at a time, on one thread.
///
/// # Errors
/// [`Failure`] for a record that cannot be analysed.
pub fn one_by_one(
    name: &str,
    records: &[NormalisedRecord],
    analyses: &[Analysis],
) -> Result<Throughput, Failure> {
    let chains =
        analyses.iter().flat_map(|a| records.iter().map(move |r| (r, a)));
    let (cpu_s, found) = on_threads(1, || {
        chains
            .map(|(r, a)| curve(r, a).map(|c| c.analyses))
            .collect::<Result<Vec<u64>, _>>()
    })?;
    let count = found?.into_iter().fold(0, u64::saturating_add);
    let name = name.into();
    Ok(Throughput { name, threads: 1, cpu_s, count, samples: None })
}

/// Steps that the analyses of some curves took.
///
/// # Errors
/// [`Failure`] for a record that cannot be analysed.
pub fn samples(
    records: &[NormalisedRecord],
    analyses: &[Analysis],
    found: &[Vec<IdaCurve>],
) -> Result<u64, Failure> {
    let chains: Vec<_> = analyses
        .iter()
        .zip(found)
        .flat_map(|(a, curves)| {
            records.iter().zip(curves).map(move |(r, c)| (a, r, c))
        })
        .collect();
    let steps: Vec<Result<u64, Failure>> = chains
        .par_iter()
        .map(|(analysis, record, curve)| {
            let mut steps = 0;
            for point in &curve.points {
                let scaled = ScaledRecord::to_pga(record, point.pga_g);
                let scene = Scene {
                    block: analysis.block,
                    restitution: analysis.restitution,
                    model: analysis.model,
                    overturning: Overturning::Alpha,
                    excitation: Excitation::Record(scaled),
                    initial_ratio: 0.0,
                };
                steps += respond(&scene, &Observe::default())?.work.steps;
            }
            Ok(steps)
        })
        .collect();
    steps.into_iter().try_fold(0, |sum, own| Ok(sum + own?))
}

/// The kernel of the lanes with hardly anything else: slow sines with very
/// many samples, so that impacts are rare; steps of `step` in 1/p.
///
/// # Errors
/// None in practice: block and record are in range.
pub fn kernel(
    name: &str,
    model: Model,
    step: f64,
) -> Result<Throughput, Failure> {
    const CHAINS: usize = 32;
    let p = 2.0;
    let block = Block::try_new(0.2, p)?;
    let dt_s = step / p;
    // Twelve periods of two radians in 1/p each second.
    let count = (12.0 * std::f64::consts::PI / step) as usize;
    let sine = (0..count).map(|i| libm::sin(2.0 * step * i as f64));
    let record = Accelerogram::try_new("sine", dt_s, sine.collect())?;
    let records = vec![NormalisedRecord::new(&record); CHAINS];
    let grid = Grid::Im { step: 0.1 };
    let few = |a: Analysis| Analysis { grid, highest_im: 1.55, ..a };
    let analyses: Vec<Analysis> =
        analyses(&[block], model)?.into_iter().map(few).collect();
    let steps = {
        let one = &records[..1];
        let (_, found) = in_lanes(name, 1, one, &analyses)?;
        samples(one, &analyses, &found)? * CHAINS as u64
    };
    let mut best: Option<Throughput> = None;
    for _ in 0..3 {
        let (mut own, _) = in_lanes(name, 1, &records, &analyses)?;
        own.samples = Some(steps);
        let better = |b: &Throughput| own.cpu_s < b.cpu_s;
        if best.as_ref().is_none_or(better) {
            best = Some(own);
        }
    }
    best.ok_or_else(|| Failure::input("no measurement"))
}

/// Replicates of the Lilliefors statistic of 86 values.
///
/// # Errors
/// None in practice: the number of replicates is in range.
pub fn lilliefors() -> Result<Throughput, Failure> {
    const REPLICATES: u64 = 200_000;
    let (cpu_s, found) =
        on_threads(1, || NullDistribution::simulate(86, REPLICATES, 0))?;
    found?;
    Ok(Throughput {
        name: "Lilliefors replicates, n = 86".into(),
        threads: 1,
        cpu_s,
        count: REPLICATES,
        samples: None,
    })
}
