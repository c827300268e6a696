//! Tests of the chains.

use super::*;

#[test]
fn levels_start_above_the_onset_and_keep_their_grid() {
    let threshold = libm::tan(0.25);
    let a: Vec<Level> = levels(Arm::A, threshold).take(2).collect();
    // tan 0.25 = 0.25534: the first whole hundredth above is 0.26.
    assert_eq!(a[0].pga_g, 0.26);
    assert_eq!(a[1].pga_g, 0.27);
    let c: Vec<Level> = levels(Arm::C, threshold).take(25).collect();
    assert_eq!((c[0].im, c[24].im), (1.02, 1.5));
    assert_eq!(c[24].pga_g, 1.5 * threshold);
}

#[test]
fn a_level_equal_to_the_threshold_is_not_run() {
    let mut levels = levels(Arm::A, 0.25);
    assert_eq!(levels.next().expect("level").pga_g, 0.26);
}

#[test]
fn scan_stops_at_the_first_overturning() {
    let run = |l: Level| {
        let gone = l.im > 1.31 && l.im < 1.39;
        Ok(if gone { f64::INFINITY } else { l.im - 1.0 })
    };
    let curve = scan(levels(Arm::C, 0.1), run).expect("curve");
    assert_eq!(curve.overturning_im(), Some(1.32));
    assert_eq!(curve.last_im(), 1.3);
    let fine = refine(&curve, 1e-4, |im| {
        Ok(if im > 1.31 { f64::INFINITY } else { 0.0 })
    })
    .expect("curve");
    let upper = fine.overturning_im().expect("overturned");
    assert!(upper > 1.31 && upper <= 1.31 + 1e-4);
}
