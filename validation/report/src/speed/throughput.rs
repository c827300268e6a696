//! Many analyses: the number in a second of CPU time, in lanes and one at a
//! time, and the CPU time of a sample.

use rayon::prelude::*;
use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, BlockError, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Grid, IdaCurve, curve};
use rocking::integrator::{
    BareSteps, Extent, Model, Observe, Order, Overturning, Solver, WorkLimit,
};
use rocking::number::dispatch::Isa;
use rocking_statistics::lilliefors::NullDistribution;
use serde::{Deserialize, Serialize};

use super::cases::{ETA, scene};
use super::clock::{process_s, thread_s};
use super::csv;
use rocking_common::curves::Execution;
use rocking_common::words::rounded;

/// A piece of work and its CPU time.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Throughput {
    /// Name of the work.
    pub work: String,
    /// Threads that did it.
    pub threads: usize,
    /// CPU time of all threads, in s.
    pub cpu_s: f64,
    /// Analyses, or replicates.
    pub count: u64,
    /// Samples in flight (one step each), if there are any.
    pub samples: Option<u64>,
    /// Chains whose first overturning is at another level than by the
    /// default, if they were compared.
    pub moved: Option<u64>,
}

impl Throughput {
    fn new(work: &str, threads: usize, cpu_s: f64, count: u64) -> Self {
        let (work, samples, moved) = (work.into(), None, None);
        Self { work, threads, cpu_s, count, samples, moved }
    }

    /// Analyses or replicates in a second of CPU time.
    pub fn rate_per_s(&self) -> f64 {
        self.count as f64 / self.cpu_s
    }

    /// Nanoseconds of CPU time a sample.
    pub fn sample_ns(&self) -> Option<f64> {
        self.samples.map(|n| 1e9 * self.cpu_s / n as f64)
    }
}

/// Analyses to make, and the way to make them.
#[derive(Clone, Copy)]
pub struct CurveWork<'a> {
    /// The analyses, each of every record.
    pub analyses: &'a [Analysis],
    /// The records.
    pub records: &'a [NormalisedRecord],
    /// In lanes or one by one.
    pub way: Execution,
    /// Threads.
    pub threads: usize,
}

/// The paper's analysis of every block in one of the two equations, at an
/// order if one is given.
///
/// # Errors
/// None in practice: the blocks are in range.
pub fn analyses(
    blocks: &[Block],
    model: Model,
    order: Option<Order>,
) -> Result<Vec<Analysis>, BlockError> {
    let restitution = Restitution::constant(ETA)?;
    let paper = |block: &Block| Analysis::paper(*block, restitution);
    Ok(blocks.iter().map(|b| Analysis { model, order, ..paper(b) }).collect())
}

/// CPU time of `work` on a pool of that many threads.
///
/// # Errors
/// If threads cannot be started.
pub fn on_threads<T: Send>(
    threads: usize,
    work: impl FnOnce() -> T + Send,
) -> anyhow::Result<(f64, T)> {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build()?;
    Ok(pool.install(|| {
        let begin = process_s();
        let given = work();
        (process_s() - begin, given)
    }))
}

impl<'a> CurveWork<'a> {
    /// Work on one thread.
    pub fn on_one_thread(
        analyses: &'a [Analysis],
        records: &'a [NormalisedRecord],
        way: Execution,
    ) -> Self {
        Self { analyses, records, way, threads: 1 }
    }

    /// Makes the curves three times and returns the run of median CPU time:
    /// one run of four took up to 1.5 times as long as the others.
    ///
    /// # Errors
    /// For a record that cannot be analysed.
    pub fn measure_thrice(
        &self,
        names: &[&str],
    ) -> anyhow::Result<(Throughput, Vec<Vec<IdaCurve>>)> {
        let work = names.join(", ");
        let [_, median, _] = by_time(|| self.measure(&work))?;
        Ok(median)
    }

    /// Makes the curves and measures the CPU time.
    ///
    /// # Errors
    /// For a record that cannot be analysed.
    pub fn measure(
        &self,
        work: &str,
    ) -> anyhow::Result<(Throughput, Vec<Vec<IdaCurve>>)> {
        let Self { analyses, records, way, threads } = *self;
        let (cpu_s, found) =
            on_threads(threads, || way.curves(records, analyses, &|| ()))?;
        let found = found?;
        let all = found.iter().flatten();
        let count = all.map(|c| c.analyses).fold(0, u64::saturating_add);
        Ok((Throughput::new(work, threads, cpu_s, count), found))
    }
}

/// Three runs, the quickest first.
fn by_time<T>(
    run: impl Fn() -> anyhow::Result<(Throughput, T)>,
) -> anyhow::Result<[(Throughput, T); 3]> {
    let mut all = [run()?, run()?, run()?];
    all.sort_by(|a, b| a.0.cpu_s.total_cmp(&b.0.cpu_s));
    Ok(all)
}

/// Chains whose first overturning is at another level than those of `base`.
pub fn moved(found: &[Vec<IdaCurve>], base: &[Vec<IdaCurve>]) -> u64 {
    let level = |c: &IdaCurve| c.overturning.map(|first| first.scanned_im);
    let both = found.iter().flatten().zip(base.iter().flatten());
    both.filter(|(own, other)| level(own) != level(other)).count() as u64
}

/// Number of steps of the analyses of some curves.
///
/// # Errors
/// For a record that cannot be analysed.
pub fn samples_of(
    records: &[NormalisedRecord],
    analyses: &[Analysis],
    found: &[Vec<IdaCurve>],
) -> anyhow::Result<u64> {
    let chains: Vec<_> = analyses
        .iter()
        .zip(found)
        .flat_map(|(a, curves)| {
            records.iter().zip(curves).map(move |(r, c)| (a, r, c))
        })
        .collect();
    let observe = Observe { work_limit: WorkLimit::IDA, ..Observe::default() };
    let solver = Solver { extent: Extent::Peak, ..Solver::default() };
    let steps: Vec<anyhow::Result<u64>> = chains
        .par_iter()
        .map(|(analysis, record, curve)| {
            let mut steps = 0;
            for point in &curve.points {
                let scene = scene(analysis, record, point.pga_g);
                steps += solver.respond(&scene, &observe)?.work.steps;
            }
            Ok(steps)
        })
        .collect();
    steps.into_iter().try_fold(0, |sum, own| Ok(sum + own?))
}

/// The measurements as CSV.
///
/// # Errors
/// None in practice: memory can be written to.
pub fn text(rows: &[Throughput]) -> Result<Vec<u8>, csv::Error> {
    csv(rows
        .iter()
        .map(|row| Throughput { cpu_s: rounded(row.cpu_s, 4), ..row.clone() }))
}

/// The lane kernel with little else: blocks rock freely after a push, in long
/// flights with many samples.
struct LaneKernel {
    record: [NormalisedRecord; 1],
    chains: Vec<Analysis>,
    samples: u64,
}

impl LaneKernel {
    /// A kernel with samples of length `step` in 1/p, at an order if one is
    /// given.
    fn new(
        model: Model,
        order: Option<Order>,
        step: f64,
    ) -> anyhow::Result<Self> {
        const CHAINS: usize = 64;
        let block = Block::try_new(0.2, 1.0)?;
        let push = (1.0 / step) as usize;
        let samples = (0..200 * push).map(|i| {
            let turn = std::f64::consts::PI * step * i as f64;
            if i < push { libm::sin(turn) } else { 0.0 }
        });
        let push = Accelerogram::try_new("push", step, samples.collect())?;
        let record = [NormalisedRecord::new(&push)];
        let restitution = Restitution::constant(0.9995)?;
        // By the other criterion a run would go on after its peak is known.
        let overturning = Overturning::HalfPi;
        let paper = Analysis {
            model,
            order,
            overturning,
            ..Analysis::paper(block, restitution)
        };
        // A single level, a little below overturning.
        let grid = Grid::Im { step: 0.01 };
        let tried = curve(&record[0], &Analysis { grid, ..paper })?;
        let first = tried.overturning.map_or(2.0, |first| first.scanned_im);
        let level = 0.98 * (first - 1.0);
        let grid = Grid::Im { step: level };
        let highest_im = 1.0 + 1.5 * level;
        let one = Analysis { grid, highest_im, ..paper };
        let found = [vec![curve(&record[0], &one)?]];
        let chains = vec![one; CHAINS];
        let each = samples_of(&record, &chains[..1], &found)?;
        let samples = each * CHAINS as u64;
        Ok(Self { record, chains, samples })
    }

    /// Flies once, at an instruction-set level.
    fn measure(&self, work: &str, isa: Isa) -> anyhow::Result<Throughput> {
        let Self { record, chains, samples } = self;
        let way = Execution::Lanes(isa);
        let job = CurveWork::on_one_thread(chains, record, way);
        let samples = Some(*samples);
        Ok(Throughput { samples, ..job.measure(work)?.0 })
    }
}

/// A kernel's least time of three; samples have a length of `step` in 1/p.
///
/// # Errors
/// None in practice: block and record are in range.
pub fn kernel(
    work: &str,
    model: Model,
    order: Option<Order>,
    step: f64,
) -> anyhow::Result<Throughput> {
    let kernel = LaneKernel::new(model, order, step)?;
    let fly = || Ok((kernel.measure(work, Isa::best())?, ()));
    let [(least, ()), ..] = by_time(fly)?;
    Ok(least)
}

/// A sample in the kernel of the lanes beside one in a loop written by hand
/// that looks for no event, in turn: medians of seven.
#[derive(Clone, Debug, Serialize)]
pub struct AgainstLoop {
    /// Instruction-set level.
    pub isa: &'static str,
    /// CPU time of a sample, in ns.
    pub kernel_ns: f64,
    pub loop_ns: f64,
    /// Median of the ratios kernel : loop.
    pub ratio: f64,
}

/// Kernel and loop of Eq. 1 at order 8, at each level with lanes.
///
/// # Errors
/// As [`kernel`].
pub fn against_loop() -> anyhow::Result<Vec<AgainstLoop>> {
    const TURNS: usize = 7;
    const FLIGHTS: u32 = 100;
    let step = 1e-3;
    let kernel = LaneKernel::new(Model::Nonlinear, Some(Order::Eight), step)?;
    let samples = [0.0; 1001];
    let block = Block::try_new(0.2, 1.0)?;
    let bare = BareSteps { block, samples: &samples, step, ratio: 0.5 };
    let steps = 1e3 * f64::from(FLIGHTS) * BareSteps::LANES as f64;
    let median = |mut all: Vec<f64>| {
        all.sort_by(f64::total_cmp);
        all[TURNS / 2]
    };
    let levels = Isa::available().into_iter().filter(|isa| isa.is_wide());
    let turns = |isa: Isa| {
        let (mut kernels, mut loops) = (Vec::new(), Vec::new());
        for _ in 0..TURNS {
            let kernel = kernel.measure("", isa)?.sample_ns();
            kernels.push(kernel.unwrap_or(f64::NAN));
            let begin = thread_s();
            std::hint::black_box(bare.fly(isa, FLIGHTS));
            loops.push(1e9 * (thread_s() - begin) / steps);
        }
        let ratios = kernels.iter().zip(&loops).map(|(k, l)| k / l);
        Ok(AgainstLoop {
            isa: isa.name(),
            ratio: median(ratios.collect()),
            kernel_ns: median(kernels),
            loop_ns: median(loops),
        })
    };
    levels.map(turns).collect()
}

/// Replicates of the Lilliefors statistic of 86 values.
///
/// # Errors
/// None in practice: the number of replicates is in range.
pub fn lilliefors() -> anyhow::Result<Throughput> {
    const REPLICATES: u64 = 200_000;
    let (cpu_s, found) =
        on_threads(1, || NullDistribution::simulate(86, REPLICATES, 0))?;
    found?;
    let work = "Lilliefors replicates, n = 86";
    Ok(Throughput::new(work, 1, cpu_s, REPLICATES))
}
