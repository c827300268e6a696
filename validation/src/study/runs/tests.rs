//! Tests of the chains.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use rocking::record::{Accelerogram, ReadOptions};

use super::*;
use crate::suites::inputs::read_suite;
use crate::sweep::{self, Levels, Planned, Wanted, read_blocks};

/// Half a second of a triangular lobe, as in the guide to the analysis.
fn lobe() -> NormalisedRecord {
    let height = |k: i32| 0.2 - 0.008 * f64::from((k - 25).abs());
    let samples = (0..=50).map(height).collect();
    let record = Accelerogram::try_new("lobe", 0.01, samples);
    NormalisedRecord::new(&record.expect("record"))
}

fn setup() -> Setup {
    Setup {
        restitution: Restitution::constant(0.92).expect("restitution"),
        overturning: Overturning::Alpha,
        tolerance: 1e-4,
        way: Execution::default(),
        kept: Default::default(),
    }
}

fn chain(
    setup: &Setup,
    block: Block,
    record: &NormalisedRecord,
    arms: &[Arm],
) -> Vec<ResponseCurve> {
    let records = std::slice::from_ref(record);
    let method = Adjust::RecordScaling;
    let chains = setup.chains(&[block], records, arms, method, || {});
    let curves = chains.expect("chain").curves;
    curves.into_iter().flatten().flatten().collect()
}

#[test]
fn arms_differ_by_grid_and_refinement_alone() {
    let (setup, lobe) = (setup(), lobe());
    let block = Block::try_new(0.1, 3.0).expect("block");
    let arms = [Arm::A, Arm::B, Arm::C];
    let chain = chain(&setup, block, &lobe, &arms);
    let [a, b, c] = chain.as_slice() else { panic!("three") };
    let of = |curve: &ResponseCurve| curve.overturning_im().expect("end");
    // A and B share their vertices; B overturns within A's last bracket.
    assert!(a.vertices().eq(b.vertices()));
    assert!(a.last_im() < of(b) && of(b) <= of(a));
    // B and C bisect the same edge, if no window lies below.
    assert!((of(b) - of(c)).abs() <= 1e-4, "{} {}", of(b), of(c));
    // A's edge is a whole hundredth of g.
    let hundredths = 100.0 * of(a) * libm::tan(0.1);
    assert!((hundredths - hundredths.round()).abs() < 1e-9);
    // C's vertices are 1, 1.02, 1.04 and so on.
    let second = c.vertices().nth(2).expect("vertex").0;
    assert!((second - 1.04).abs() < 1e-12);
}

#[test]
fn one_arm_alone_gives_the_same_curve() {
    let (setup, lobe) = (setup(), lobe());
    let block = Block::try_new(0.1, 3.0).expect("block");
    let all = chain(&setup, block, &lobe, &[Arm::A, Arm::B, Arm::C]);
    for (arm, curve) in [Arm::A, Arm::B, Arm::C].into_iter().zip(all) {
        let alone = chain(&setup, block, &lobe, &[arm]);
        assert_eq!(alone, [curve]);
    }
}

/// A finished sweep over the records of `folder`.
fn sweep(folder: &Path, name: &str, levels: Levels) -> Planned {
    let blocks = folder.join("blocks.csv");
    fs::write(&blocks, "alpha,p\n0.1,3\n0.1,1.2\n0.2,2\n").expect("blocks");
    let read = ReadOptions::default();
    let suite = read_suite(&folder.join("records"), read).expect("suite");
    let wanted = Wanted {
        blocks: &read_blocks(&blocks, 0.92).expect("blocks"),
        suite: &suite,
        demands: vec![1.0],
        levels,
        rows: true,
        tile_minutes: 1e-9,
    };
    let place = folder.join(name);
    let planned = sweep::Plan::write(&wanted, &place, "test").expect("plan");
    sweep::run(&planned, (0, 1), &|_| ()).expect("run");
    assert_eq!(planned.plan.tiles.len(), 3);
    planned
}

/// Name and samples (multiples of g, by their number) of a record.
type Shape = (&'static str, fn(i32) -> f64);

/// Three records of half a second: a lobe, a sine, and a short strong pulse.
fn records(folder: &Path) -> Vec<Accelerogram> {
    let place = folder.join("records");
    fs::create_dir_all(&place).expect("folder");
    let shapes: [Shape; 3] = [
        ("lobe", |k| 0.2 - 0.008 * f64::from((k - 25).abs())),
        ("sine", |k| 0.3 * libm::sin(0.4 * f64::from(k))),
        ("step", |k| if k < 3 { 0.9 } else { -0.01 }),
    ];
    shapes
        .map(|(name, shape)| {
            let samples = (0..=50).map(shape).collect();
            let record = Accelerogram::try_new(name, 0.01, samples);
            let record = record.expect("record");
            let text = crate::suites::export::at2(&record);
            fs::write(place.join(format!("{name}.at2")), text).expect("file");
            record
        })
        .to_vec()
}

#[test]
fn chains_from_sweeps_are_those_that_are_made() {
    let place = tempfile::tempdir().expect("folder");
    let motions = records(place.path());
    let records: Vec<_> = motions.iter().map(NormalisedRecord::new).collect();
    let folders = [Levels::StepIm(0.02), Levels::StepPgaG(0.01)]
        .into_iter()
        .zip(["im", "pga"])
        .map(|(levels, name)| sweep(place.path(), name, levels).folder)
        .collect::<Vec<_>>();
    let of = |folders: &[PathBuf]| {
        let kept = Arc::new(Kept::read(folders, "test").expect("kept"));
        Setup { kept, ..setup() }
    };
    let blocks = [(0.1, 1.2), (0.2, 2.0), (0.3, 2.0)]
        .map(|(alpha, p)| Block::try_new(alpha, p).expect("block"));
    let run = |setup: &Setup, adjust: Adjust| {
        let arms = [Arm::A, Arm::B, Arm::C];
        let done = AtomicUsize::new(0);
        let tell = || {
            done.fetch_add(1, Ordering::Relaxed);
        };
        let chains = setup.chains(&blocks, &records, &arms, adjust, tell);
        let chains = chains.expect("chains");
        assert_eq!(done.into_inner(), 2 * 3 * 3);
        (chains.curves, chains.analyses, chains.certainty)
    };
    let scaled = Adjust::RecordScaling;
    let expected = run(&setup(), scaled);
    let whole = expected.1;
    let (both, one) = (of(&folders), of(&folders[1..]));
    for setup in [&both, &one] {
        assert!(run(setup, scaled) == expected);
    }
    // Both grids of two of three blocks, or one.
    let (taken, made) = both.kept.counts();
    let (fewer, more) = one.kept.counts();
    assert!(taken > fewer && fewer > 0 && made > 0, "{taken} {fewer} {made}");
    assert_eq!((taken + made, fewer + more), (whole, whole));
    // Another criterion, restitution or adjustment takes nothing.
    let eta = Restitution::constant(0.91).expect("restitution");
    let strange = [
        (Setup { overturning: Overturning::HalfPi, ..of(&folders) }, scaled),
        (Setup { restitution: eta, ..of(&folders) }, scaled),
        (Setup { tolerance: 1e-3, ..of(&folders) }, scaled),
        (of(&folders), Adjust::SlendernessAdjustment),
    ];
    for (setup, adjust) in strange {
        run(&setup, adjust);
        assert_eq!(setup.kept.counts().0, 0);
    }
    // Neither does a record that differs in one bit.
    let mut samples = motions[1].samples_g().to_vec();
    samples[7] = samples[7].next_up();
    let other = Accelerogram::try_new("sine", 0.01, samples).expect("record");
    let other = [NormalisedRecord::new(&other)];
    let setup = of(&folders);
    let chains = setup.chains(&blocks, &other, &[Arm::C], scaled, || ());
    assert!(chains.is_ok() && setup.kept.counts().0 == 0);
}
