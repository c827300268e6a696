//! The list of work of many analyses that is measured.

use rocking::block::Block;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, IdaCurve};
use rocking::integrator::{Model, Order};

use super::singles::ORDERS;
use super::throughput::{
    CurveWork, Throughput, analyses, kernel, lilliefors, moved, samples_of,
};
use rocking_common::curves::Execution;
use rocking_common::paper::BLOCKS;

/// Names of both ways of making curves.
const WAYS: [&str; 2] = ["in lanes", "one by one"];

/// How often `done` is called.
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
    // Few chains: what a single block under a suite takes.
    let middle = Block::try_new(0.15, 3.0)?;
    let analyses = analyses(&[middle], one, None)?;
    for how in WAYS {
        let work = format!("p = 3, alpha = 0.15, {how}");
        all.push(make(&work, &analyses, records, how)?.0);
        done();
    }
    all.extend(whole(records, one, "Eq. 1", done)?);
    all.extend(whole(records, two, "Eq. 2", done)?);
    all.push(lilliefors()?);
    done();
    Ok(all)
}

/// The paper's whole analysis in one equation, at every order that it has.
fn whole(
    records: &[NormalisedRecord],
    model: Model,
    words: &str,
    done: &dyn Fn(),
) -> anyhow::Result<Vec<Throughput>> {
    let shipped = analyses(&BLOCKS, model, None)?;
    let mut all = Vec::new();
    let mut base = Vec::new();
    for how in WAYS {
        let work = format!("15 blocks, {words}, {how}");
        let (measured, found) = make(&work, &shipped, records, how)?;
        all.push(measured);
        base = found;
        done();
    }
    let threads = rayon::current_num_threads();
    if threads > 1 {
        let work = format!("15 blocks, {words}, in lanes");
        let way = Execution::default();
        let job = CurveWork { analyses: &shipped, records, way, threads };
        all.push(job.measure_thrice(&work)?.0);
    }
    let samples = samples_of(records, &shipped, &base)?;
    for measured in &mut all {
        measured.samples = Some(samples);
    }
    let fixed = ORDERS.iter().filter_map(|(name, order)| {
        order.filter(|_| model == Model::Nonlinear).map(|o| (name, o))
    });
    for (setting, order) in fixed {
        let analyses = analyses(&BLOCKS, model, Some(order))?;
        for how in WAYS {
            let work = format!("15 blocks, {words}, {how}, {setting}");
            let (mut measured, found) = make(&work, &analyses, records, how)?;
            measured.moved = Some(moved(&found, &base));
            all.push(measured);
            done();
        }
    }
    Ok(all)
}

fn make(
    work: &str,
    analyses: &[Analysis],
    records: &[NormalisedRecord],
    how: &str,
) -> anyhow::Result<(Throughput, Vec<Vec<IdaCurve>>)> {
    let lanes = how == WAYS[0];
    let way = if lanes { Execution::default() } else { Execution::OneByOne };
    CurveWork { analyses, records, way, threads: 1 }.measure_thrice(work)
}
