//! `cargo bench`: what a sample, an analysis, a curve, a study and a
//! Lilliefors replicate take, and how that grows with records, levels,
//! samples and threads. Wall-clock time; `rocking speed` tells processor
//! time and error.

use std::hint::black_box;
use std::sync::LazyLock;

use divan::Bencher;
use divan::counter::ItemsCount;
use rocking::block::Block;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Grid, curve};
use rocking::integrator::{Model, Observe, Order, Solver, respond_precise};
use rocking::number::dispatch::Isa;
use rocking::number::double::DoubleDouble;
use rocking::record::{Accelerogram, Processing, ReadOptions};
use rocking::statistics::lilliefors::NullDistribution;
use rocking_common::curves::Execution;
use rocking_common::paper::BLOCKS;
use rocking_common::suites::StudySuite;
use rocking_common::suites::export::at2;
use rocking_common::suites::inputs::{profiles, reread};
use rocking_common::suites::remarks::Remarks;
use rocking_report::speed::cases::{self, Case};
use rocking_report::speed::throughput::{Kernel, analyses};

static RECORDS: LazyLock<Vec<NormalisedRecord>> = LazyLock::new(|| {
    let suites = StudySuite::embedded().expect("suites");
    let motions = suites.iter().flat_map(|suite| &suite.motions);
    motions.map(|m| NormalisedRecord::new(&m.study)).collect()
});

static CASES: LazyLock<Vec<Case>> =
    LazyLock::new(|| cases::all().expect("cases"));

fn main() {
    divan::main();
}

/// A suite in its files: read, remarked on, and read again; items are
/// records.
#[divan::bench(args = [500, 1000, 2000, 4000], sample_count = 3)]
fn streamed(bencher: Bencher, records: usize) {
    let place = tempfile::tempdir().expect("folder");
    for k in 0..records {
        let phase = f64::from(u32::try_from(k).expect("count"));
        let wave = (0..1000).map(|i| {
            let t = 0.01 * f64::from(i);
            let beat = libm::sin((5.0 + 0.01 * phase) * t + phase);
            0.2 * beat * libm::sin(0.314 * t) * libm::cos(phase * t)
        });
        let name = format!("{k:06}");
        let motion = Accelerogram::try_new(&*name, 0.01, wave.collect());
        let text = at2(&motion.expect("motion"));
        let path = place.path().join(format!("{name}.at2"));
        std::fs::write(path, text).expect("file");
    }
    let (read, none) = (ReadOptions::default(), Processing::default());
    bencher.counter(ItemsCount::new(records)).bench_local(|| {
        let suite = profiles::<anyhow::Error>(place.path(), read, &none);
        let suite = suite.expect("suite");
        black_box(Remarks::on(&suite));
        let members: Vec<_> = suite.members().iter().collect();
        reread(place.path(), read, &none, &members, |record, _| {
            black_box(NormalisedRecord::new(record));
            anyhow::Ok(())
        })
    });
}

/// The block in the middle of the paper's fifteen.
fn middle() -> Vec<Analysis> {
    let block = Block::try_new(0.15, 3.0).expect("block");
    analyses(&[block], Model::Nonlinear, None).expect("analyses")
}

/// Curves on a pool of its own; items are analyses.
fn ida(
    bencher: Bencher,
    threads: usize,
    records: &[NormalisedRecord],
    analyses: &[Analysis],
) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
    let pool = pool.expect("threads");
    let run = || {
        pool.install(|| Execution::default().curves(records, analyses, &|| ()))
    };
    let once = run().expect("curves");
    let count: u64 =
        once.iter().flatten().map(|c| c.analyses).fold(0, u64::saturating_add);
    bencher
        .counter(ItemsCount::new(count))
        .bench_local(|| black_box(run().expect("curves")));
}

/// One analysis; items are the samples stepped in flight.
mod analysis {
    use super::*;

    fn all(bencher: Bencher, order: Option<Order>) {
        let solver = Solver { order, ..Solver::default() };
        let run =
            |case: &Case| solver.respond(&case.scene(), &Observe::default());
        let steps = CASES
            .iter()
            .map(|case| run(case).expect("scene").work.steps)
            .fold(0, u64::saturating_add);
        bencher.counter(ItemsCount::new(steps)).bench_local(|| {
            for case in CASES.iter() {
                black_box(run(case).expect("scene"));
            }
        });
    }

    #[divan::bench(args = Order::ALL)]
    fn thirty_at_order(bencher: Bencher, order: Order) {
        all(bencher, Some(order));
    }

    #[divan::bench]
    fn thirty_as_shipped(bencher: Bencher) {
        all(bencher, None);
    }

    #[divan::bench(sample_count = 5)]
    fn one_in_double_double(bencher: Bencher) {
        let scene = CASES[0].scene();
        bencher.bench_local(|| {
            black_box(respond_precise::<DoubleDouble>(
                &scene,
                &Observe::default(),
            ))
        });
    }
}

/// Free rocking in lanes, hardly an impact: items are samples.
#[divan::bench(args = ["Eq. 1", "Eq. 2"], sample_count = 10)]
fn kernel(bencher: Bencher, equation: &str) {
    let (model, order) = match equation {
        "Eq. 1" => (Model::Nonlinear, Some(Order::Eight)),
        _ => (Model::Linearized, None),
    };
    let kernel = Kernel::new(model, order, 1e-3).expect("kernel");
    let fly = || kernel.measure("", Isa::best()).expect("curves");
    bencher
        .counter(ItemsCount::new(fly().samples.expect("samples")))
        .bench_local(|| black_box(fly()));
}

/// The curves of one block under all embedded records; items are analyses.
mod one_block {
    use super::*;

    #[divan::bench(sample_count = 10)]
    fn in_lanes(bencher: Bencher) {
        ida(bencher, 1, &RECORDS, &middle());
    }

    #[divan::bench(sample_count = 5)]
    fn one_by_one(bencher: Bencher) {
        let analysis = middle()[0];
        let run = || {
            RECORDS
                .iter()
                .map(|r| curve(r, &analysis).expect("curve").analyses)
                .fold(0, u64::saturating_add)
        };
        bencher
            .counter(ItemsCount::new(run()))
            .bench_local(|| black_box(run()));
    }

    #[divan::bench(args = [16, 32, 64, 128], sample_count = 10)]
    fn by_records(bencher: Bencher, records: usize) {
        ida(bencher, 1, &RECORDS[..records], &middle());
    }

    /// Levels a g: their number.
    #[divan::bench(args = [50, 100, 200, 400], sample_count = 10)]
    fn by_levels(bencher: Bencher, levels: u32) {
        let grid = Grid::Pga { step_g: 1.0 / f64::from(levels) };
        let analysis = Analysis { grid, ..middle()[0] };
        ida(bencher, 1, &RECORDS, &[analysis]);
    }

    /// Records with as many samples in each interval.
    #[divan::bench(args = [1, 2, 4], sample_count = 10)]
    fn by_samples(bencher: Bencher, parts: usize) {
        let records: Vec<NormalisedRecord> =
            RECORDS.iter().map(|record| divided(record, parts)).collect();
        ida(bencher, 1, &records, &middle());
    }

    #[divan::bench(args = [1, 2, 4], sample_count = 10)]
    fn by_threads(bencher: Bencher, threads: usize) {
        ida(bencher, threads, &RECORDS, &middle());
    }

    /// The same record, each interval in parts.
    fn divided(record: &NormalisedRecord, parts: usize) -> NormalisedRecord {
        let mut finer = Vec::new();
        for ends in record.samples().windows(2) {
            for part in 0..parts {
                let share = part as f64 / parts as f64;
                finer.push((ends[1] - ends[0]).mul_add(share, ends[0]));
            }
        }
        finer.extend(record.samples().last());
        let dt_s = record.dt_s() / parts as f64;
        let finer = Accelerogram::try_new(record.name(), dt_s, finer);
        NormalisedRecord::new(&finer.expect("record"))
    }
}

/// 15 blocks, all embedded records, 0.01 g: arm A of the study.
#[divan::bench(
    args = ["Eq. 1", "Eq. 1, order 8", "Eq. 1, order 6", "Eq. 2"],
    sample_count = 2
)]
fn whole_study(bencher: Bencher, work: &str) {
    let (model, order) = match work {
        "Eq. 2" => (Model::Linearized, None),
        "Eq. 1, order 8" => (Model::Nonlinear, Some(Order::Eight)),
        "Eq. 1, order 6" => (Model::Nonlinear, Some(Order::Six)),
        _ => (Model::Nonlinear, None),
    };
    let all = analyses(&BLOCKS, model, order).expect("analyses");
    let threads = rayon::current_num_threads();
    ida(bencher, threads, &RECORDS, &all);
}

/// Replicates of the statistic of 86 values, on one thread.
#[divan::bench(args = [10_000, 20_000, 40_000], sample_count = 10)]
fn lilliefors(bencher: Bencher, replicates: u64) {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let pool = pool.expect("threads");
    let run = || NullDistribution::simulate(86, replicates, 0);
    bencher
        .counter(ItemsCount::new(replicates))
        .bench_local(|| pool.install(|| black_box(run().expect("simulated"))));
}
