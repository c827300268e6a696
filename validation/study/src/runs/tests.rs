//! Tests of the chains.

use rocking::accelerogram::Accelerogram;

use super::*;

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
    let progress = ProgressBar::hidden();
    let chains = setup.chains(&[block], records, arms, method, &progress);
    let (arms, _) = chains.expect("chain");
    arms.into_iter().flat_map(|arm| arm.curves).flatten().collect()
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
