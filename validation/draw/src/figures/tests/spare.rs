//! Data that are empty, infinite, or missing.

use super::made_up::{self, heading};
use crate::figures::*;
use rocking_common::paper::Arm;

const HOLES: [f64; 4] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0];

pub fn all() -> Vec<Figure> {
    let mut motions = made_up::motions();
    motions[0].curves.clear();
    for curve in &mut motions[1].curves {
        curve.ratio = HOLES.to_vec();
        curve.time_s = HOLES.to_vec();
    }
    motions[2].record = "A_very_long_name_".repeat(9);

    let mut boxplots = made_up::boxplots(4);
    boxplots.panels[0].p_rad_s = 3.0;
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

    let mut chart = made_up::chart();
    chart.heading = heading("spare-speed", None);
    for series in &mut chart.panels[1].series {
        series.x = HOLES.to_vec();
        series.y = vec![-1.0; 4];
        series.interval.clear();
    }

    vec![
        histories(heading("spare-02", None), &motions, 3, String::new()),
        boxplots.figure(&heading("spare-06", Some(Arm::C)), String::new()),
        chart.figure(String::new()),
    ]
}
