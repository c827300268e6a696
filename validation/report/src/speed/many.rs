//! The work of many analyses that is measured.

use rocking::block::Block;
use rocking::excitation::NormalisedRecord;
use rocking::integrator::{Model, Order};

use super::singles::ORDERS;
use super::throughput::{
    CurveWork, Throughput, analyses, kernel, lilliefors, moved, samples_of,
};
use rocking_common::curves::Execution;
use rocking_common::paper::BLOCKS;

/// Name of the paper's analysis.
pub const PAPER: &str = "15 blocks, Eq. 1";

/// Names of both ways of making curves.
pub const IN_LANES: &str = "in lanes";
pub const ONE_BY_ONE: &str = "one by one";

fn ways() -> [(&'static str, Execution); 2] {
    [(IN_LANES, Execution::default()), (ONE_BY_ONE, Execution::OneByOne)]
}

/// Number of calls of `done`.
pub const STEPS: u64 = 22;

/// Kernels, the middle block, all blocks at every order, and replicates.
///
/// # Errors
/// For a record that cannot be analysed.
pub fn measure(
    records: &[NormalisedRecord],
    done: &dyn Fn(),
) -> anyhow::Result<Vec<Throughput>> {
    let (one, two) = (Model::Nonlinear, Model::Linearized);
    let mut all = Vec::new();
    for (words, model, order, step) in [
        ("Eq. 1, order 6", one, Some(Order::Six), 1e-3),
        ("Eq. 1, order 8", one, Some(Order::Eight), 1e-3),
        ("Eq. 1, order 9", one, None, 1e-2),
        ("Eq. 1, order 13", one, None, 0.061),
        ("Eq. 2", two, None, 1e-3),
    ] {
        let work = format!("kernel in lanes, {words}");
        all.push(kernel(&work, model, order, step)?);
        done();
    }
    // Few chains: the work for a single block under a suite.
    let middle = Block::try_new(0.15, 3.0)?;
    let analyses = analyses(&[middle], one, None)?;
    for (how, way) in ways() {
        let job = CurveWork::on_one_thread(&analyses, records, way);
        all.push(job.measure_thrice(&["p = 3, alpha = 0.15", how])?.0);
        done();
    }
    all.extend(whole(records, one, PAPER, done)?);
    all.extend(whole(records, two, "15 blocks, Eq. 2", done)?);
    all.push(lilliefors()?);
    done();
    Ok(all)
}

/// The paper's whole analysis in one equation, at every order of Eq. 1.
fn whole(
    records: &[NormalisedRecord],
    model: Model,
    work: &str,
    done: &dyn Fn(),
) -> anyhow::Result<Vec<Throughput>> {
    let shipped = analyses(&BLOCKS, model, None)?;
    let mut all = Vec::new();
    let mut base = Vec::new();
    for (how, way) in ways() {
        let job = CurveWork::on_one_thread(&shipped, records, way);
        let (measured, found) = job.measure_thrice(&[work, how])?;
        all.push(measured);
        base = found;
        done();
    }
    let threads = rayon::current_num_threads();
    if threads > 1 {
        let way = Execution::default();
        let job = CurveWork::on_one_thread(&shipped, records, way);
        let job = CurveWork { threads, ..job };
        all.push(job.measure_thrice(&[work, IN_LANES])?.0);
    }
    let samples = samples_of(records, &shipped, &base)?;
    for measured in &mut all {
        measured.samples = Some(samples);
    }
    if model == Model::Linearized {
        return Ok(all);
    }
    for (setting, order) in ORDERS.into_iter().filter(|own| own.1.is_some()) {
        let analyses = analyses(&BLOCKS, model, order)?;
        for (how, way) in ways() {
            let job = CurveWork::on_one_thread(&analyses, records, way);
            let (measured, found) =
                job.measure_thrice(&[work, how, setting])?;
            let moved = Some(moved(&found, &base));
            all.push(Throughput { moved, ..measured });
            done();
        }
    }
    Ok(all)
}
