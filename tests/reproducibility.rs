//! A thousand short analyses have the same bits at every instruction-set
//! level, on one thread and two, one at a time and in lanes, in dev and in
//! release builds (`cargo test --release --test gate bits`).

use rayon::prelude::*;

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, Batch, Grid, IdaPoint, Resurrections, curves};
use rocking::integrator::{
    Model, Observe, Outcome, Overturning, Scene, Solver, uplift_threshold,
};
use rocking::number::dispatch::Isa;
use rocking_common::suites::inputs::sha256_hex;
use rocking_statistics::streams::Streams;

use super::compare::hold;

/// Levels of every chain: IM 1.2, 1.4, ..., 6.
const LEVELS: u32 = 25;

/// Filtered noise under a parabola, four seconds.
fn record(index: u64, dt_s: f64) -> NormalisedRecord {
    let mut stream = Streams::new("reproducibility", 0).stream(index);
    let count = (4.0 / dt_s) as usize;
    let (mut fast, mut slow) = (0.0, 0.0);
    let samples = (0..count)
        .map(|k| {
            let white = stream.uniform() - 0.5;
            fast += 0.3 * (white - 0.5 * fast);
            slow += 0.2 * (fast - slow);
            let share = k as f64 / count as f64;
            slow * share * (1.0 - share)
        })
        .collect();
    let name = format!("noise {index}");
    NormalisedRecord::new(&Accelerogram::try_new(name, dt_s, samples).unwrap())
}

/// Ten kinds of analysis: both equations, both criteria, every length of the
/// series.
fn panel() -> Vec<Analysis> {
    let restitution = Restitution::constant(0.92).unwrap();
    let blocks =
        [(1.0, 0.1), (3.0, 0.05), (3.0, 0.25), (4.0, 0.15), (8.0, 0.02)];
    let analysis = |(k, (p, alpha)): (usize, (f64, f64))| {
        let block = Block::try_new(alpha, p).unwrap();
        let common = Analysis {
            grid: Grid::Im { step: 0.2 },
            highest_im: 6.0,
            resurrections: Some(Resurrections::To(6.0)),
            ..Analysis::paper(block, restitution)
        };
        let overturning =
            if k % 2 == 0 { Overturning::HalfPi } else { Overturning::Alpha };
        [
            Analysis { overturning, ..common },
            Analysis { model: Model::Linearized, ..common },
        ]
    };
    blocks.into_iter().enumerate().flat_map(analysis).collect()
}

fn records() -> Vec<NormalisedRecord> {
    let intervals = [0.005, 0.01, 0.02, 0.005];
    (0..).zip(intervals).map(|(k, dt_s)| record(k, dt_s)).collect()
}

/// The bits of an analysis.
fn bits(im: f64, outcome: &Outcome, margin: f64) -> [u64; 4] {
    let (kind, value) = match *outcome {
        Outcome::NoUplift => (0, 0.0),
        Outcome::Rocked { peak_ratio } => (1, peak_ratio),
        Outcome::Overturned { time_s, side } => {
            (if side.sign() > 0.0 { 2 } else { 3 }, time_s)
        }
    };
    [im.to_bits(), kind, value.to_bits(), margin.to_bits()]
}

fn hash(analyses: &[[u64; 4]]) -> String {
    assert_eq!(analyses.len(), 1000);
    let bytes: Vec<u8> =
        analyses.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
    sha256_hex(&bytes)
}

/// All chains in lanes.
fn in_lanes(isa: Isa) -> Vec<[u64; 4]> {
    let batch = Batch { isa, ..Batch::default() };
    let curves = curves(&records(), &panel(), &batch).unwrap();
    let of = |p: &IdaPoint| bits(p.im, &p.outcome, p.fate_margin);
    curves
        .iter()
        .flatten()
        .flat_map(|curve| curve.points.iter().chain(&curve.above).map(of))
        .collect()
}

/// The same analyses one at a time.
fn alone(isa: Isa) -> Vec<[u64; 4]> {
    let (records, panel) = (records(), panel());
    let mut jobs = Vec::new();
    for analysis in &panel {
        for record in &records {
            jobs.extend((1..=LEVELS).map(|k| (analysis, record, k)));
        }
    }
    jobs.par_iter()
        .map(|&(analysis, record, k)| {
            let im = 1.0 + f64::from(k) / 5.0;
            let threshold = uplift_threshold(&analysis.block, analysis.model);
            let scene = Scene {
                block: analysis.block,
                restitution: analysis.restitution,
                model: analysis.model,
                overturning: analysis.overturning,
                excitation: Excitation::Record(ScaledRecord::to_pga(
                    record,
                    im * threshold,
                )),
                initial_ratio: 0.0,
            };
            let observe = Observe::default();
            let found = Solver { isa, ..Solver::default() }
                .respond(&scene, &observe)
                .unwrap();
            bits(im, &found.outcome, found.fate_margin)
        })
        .collect()
}

/// What to do about ways that disagree.
fn explain(found: &[(String, String)]) -> String {
    let list: Vec<String> =
        found.iter().map(|(way, hash)| format!("  {hash} {way}")).collect();
    format!(
        "The ways disagree among themselves: the same input no longer gives \
         the same bytes. This is a defect, never to be accepted: look for a \
         product and sum without `mul_add`, a platform function, a sum whose \
         order depends on threads or lanes.\n{}",
        list.join("\n")
    )
}

#[test]
fn regresses_bits_of_a_thousand_analyses() {
    let available = Isa::available();
    for name in ["baseline", "avx2", "avx512"] {
        if available.iter().all(|isa| isa.name() != name) {
            println!("{name}: not run, this machine lacks it");
        }
    }
    let mut found = Vec::new();
    for isa in available {
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new()
                .num_threads(threads)
                .build()
                .unwrap();
            let (lanes, scalar) = pool.install(|| (in_lanes(isa), alone(isa)));
            for (way, analyses) in [("lanes", lanes), ("scalar", scalar)] {
                let way = format!("{}, {threads} threads, {way}", isa.name());
                found.push((way, hash(&analyses)));
            }
        }
    }
    let first = &found[0].1;
    assert!(found.iter().all(|f| f.1 == *first), "{}", explain(&found));
    let thousand = [("every way".to_owned(), first.clone())];
    hold("golden.txt", "hash of all bits", &thousand);
}
