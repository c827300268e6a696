//! Data that are empty, infinite, or missing.

use super::made_up::{self, heading};
use crate::figures::*;
use rocking_common::paper::Arm;

const HOLES: [f64; 4] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0];

pub fn all() -> Vec<Figure> {
    let mut histories = made_up::histories();
    histories.heading = heading("spare-02", None);
    histories.panels[0].curves.clear();
    for curve in &mut histories.panels[1].curves {
        curve.ratio = HOLES.to_vec();
        curve.time_s = HOLES.to_vec();
    }
    histories.panels[2].record = "A_very_long_name_".repeat(9);

    let mut ida = made_up::ida();
    ida.heading = heading("spare-04", None);
    ida.panels[0].curves.clear();
    for curve in &mut ida.panels[1].curves {
        curve.edp = vec![f64::INFINITY; curve.im.len()];
        curve.overturning_im = None;
    }
    for curve in &mut ida.panels[2].curves {
        curve.im = vec![f64::NAN; 4];
        curve.edp = HOLES.to_vec();
        curve.overturning_im = None;
    }

    let mut boxplots = made_up::boxplots(4);
    boxplots.heading = heading("spare-06", Some(Arm::C));
    boxplots.panels[0].stripes.clear();
    for stripe in &mut boxplots.panels[1].stripes {
        stripe.summary = None;
        stripe.usable = 0;
    }
    for stripe in &mut boxplots.panels[2].stripes {
        if let Some(b) = &mut stripe.summary {
            b.outliers = HOLES.to_vec();
            b.notch_high = f64::NAN;
        }
    }

    let mut quantiles = made_up::quantiles();
    quantiles.heading = heading("spare-08", None);
    quantiles.panels[0].groups.clear();
    for group in &mut quantiles.panels[1].groups {
        group.quantiles[0] = vec![f64::NAN; group.im.len()];
        group.quantiles[2].clear();
    }

    let mut capacities = made_up::capacities();
    capacities.heading = heading("spare-11", None);
    capacities.panels[0].curves.clear();
    capacities.panels[0].quantiles.clear();
    capacities.panels[1].shift = f64::NAN;

    let mut accepted = made_up::accepted();
    accepted.heading = heading("spare-12", None);
    accepted.panels[0].shares.clear();
    for share in &mut accepted.panels[1].shares {
        share.share = f64::NAN;
        share.null_band = None;
    }

    let mut tests = made_up::tests_along();
    tests.heading = heading("spare-13", None);
    tests.blocks[0].original = vec![f64::NAN; 100];
    tests.blocks[0].shifted.clear();
    tests.blocks[0].original_histogram = Histogram::freedman_diaconis(
        &[],
        (f64::NAN, f64::NAN),
        f64::NAN,
        f64::NAN,
    );

    let mut fragilities = made_up::fragilities();
    fragilities.heading = heading("spare-16", None);
    fragilities.panels[0].sample = vec![f64::INFINITY; 86];
    fragilities.panels[0].limit = None;
    for fit in &mut fragilities.panels[0].curves {
        fit.curve = None;
        fit.band.clear();
    }

    let mut by_constant = made_up::by_constant();
    by_constant.heading = heading("spare-18", None);
    by_constant.panels[0].benchmark = None;
    by_constant.panels[0].sample.clear();
    by_constant.panels[0].curves.clear();

    let mut chart = made_up::chart();
    chart.heading = heading("spare-speed", None);
    for series in &mut chart.panels[0].series {
        series.x = HOLES.to_vec();
        series.y = vec![-1.0; 4];
    }

    vec![
        histories.figure(String::new()),
        ida.figure(String::new()),
        boxplots.figure(String::new()),
        quantiles.figure(String::new()),
        capacities.figure(String::new()),
        accepted.figure(String::new()),
        tests.figure(String::new()),
        fragilities.figure(String::new()),
        by_constant.figure(String::new()),
        chart.figure(String::new()),
    ]
}
