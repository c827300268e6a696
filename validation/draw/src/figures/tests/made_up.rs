//! Made-up numbers of the right shape; they come from closed formulas and
//! have no meaning.

mod chart;

use rocking_statistics::{Boxplot, ExtendedSample, QuantileType};

use crate::figures::*;
pub use chart::chart;
use rocking_common::paper::Arm;

pub const ALPHAS: [f64; 5] = [0.05, 0.10, 0.15, 0.20, 0.25];
pub const FREQUENCIES: [f64; 3] = [1.0, 3.0, 4.0];

pub fn heading(name: &str, arm: Option<Arm>) -> Heading {
    let title = format!("{name}: made up");
    let words = Heading::new(name, title, "Made-up numbers & <marks>.");
    Heading { arm, ..words }
}

/// Between 0 and 1, without a pattern.
pub fn noise(i: usize) -> f64 {
    let x = libm::sin(12.9898 * (i as f64 + 1.0)) * 43_758.545;
    x - x.floor()
}

/// About normal, from a sum of twelve.
pub fn normal(i: usize) -> f64 {
    (0..12).map(|k| noise(12 * i + k)).sum::<f64>() - 6.0
}

pub fn all() -> Vec<Figure> {
    let arm = Some(Arm::C);
    vec![
        sketch().figure(String::new()),
        histories(heading("figure-02", None), &motions(), 3, String::new()),
        boxplots(4).figure(&heading("figure-06", arm), String::new()),
        boxplots(8).figure(&heading("figure-07", arm), String::new()),
        chart().figure(String::new()),
        fates().figure(String::new()),
    ]
}

pub fn fates() -> FateMap {
    let ends = |count: usize, step: f64| -> Vec<f64> {
        (0..=count).map(|k| libm::exp(step * k as f64)).collect()
    };
    let of =
        |k: usize| MapFate::after([None, Some(0), Some(1), Some(2)][k % 4]);
    FateMap {
        heading: heading("figure-21", None),
        frequencies: ends(20, 0.1),
        amplitudes: ends(16, 0.2),
        cells: (0..20)
            .map(|x| (0..16).map(|y| of((x + y) / 9)).collect())
            .collect(),
        boundaries: vec![
            ("first".into(), vec![(1.0, 2.0), (5.0, 9.0)]),
            ("second".into(), vec![(1.0, 3.0), (5.0, 4.0)]),
        ],
    }
}

pub fn sketch() -> BlockSketch {
    BlockSketch {
        heading: heading("figure-01", None),
        alpha_rad: 0.36,
        rotation_rad: 0.17,
    }
}

pub fn motions() -> Vec<HistoryPanel> {
    let panel = |i: usize| {
        let p = FREQUENCIES[i / 3];
        let curve = |(k, alpha): (usize, &f64)| {
            let overturned = i == 8 && k > 2;
            let time_s: Vec<f64> =
                (0..3000).map(|n| 0.01 * n as f64).collect();
            let ratio = |t: &f64| {
                let w = (0.9 + 0.02 * k as f64) * p;
                let swell = if overturned { 0.05 * t } else { 0.0 };
                (libm::exp(-0.12 * t) * 0.7 + swell)
                    * libm::sin(w * t + 0.3 * libm::sin(1.7 * t))
            };
            let ratio: Vec<f64> = time_s.iter().map(ratio).collect();
            let stands = ratio.iter().take_while(|y| y.abs() < 1.0).count();
            History {
                alpha_rad: *alpha,
                time_s: time_s[..stands].to_vec(),
                ratio: ratio[..stands].to_vec(),
                overturned: stands < ratio.len(),
            }
        };
        HistoryPanel {
            p_rad_s: p,
            record: format!("RSN{}_QUAKE_A{}-090, 1994", 700 + i, i),
            im: 1.5 + 0.02 * i as f64,
            curves: ALPHAS.iter().enumerate().map(curve).collect(),
        }
    };
    (0..9).map(panel).collect()
}

pub fn notched(sample: &[f64]) -> Boxplot {
    let sample = ExtendedSample::try_new(sample).unwrap();
    Boxplot::try_new(&sample, QuantileType::default()).unwrap()
}

pub fn boxplots(panels: usize) -> Boxplots {
    let levels = [1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0];
    let panel = |i: usize| BoxPanel {
        p_rad_s: if panels == 4 { 1.0 } else { FREQUENCIES[1 + i / 4] },
        alpha_rad: [0.05, 0.15, 0.20, 0.25][i % 4],
        stripes: levels
            .iter()
            .enumerate()
            .map(|(k, level)| {
                let usable = 86 - 11 * k;
                let spread = 0.05 + 0.06 * i as f64;
                let ratio =
                    |r| libm::exp(spread * normal(r + 100 * k + 900 * i));
                let sample: Vec<f64> = (0..usable).map(ratio).collect();
                let summary = (usable >= 10).then(|| notched(&sample));
                let closed_form = (panels == 4).then_some(0.99);
                Stripe {
                    level: *level,
                    usable,
                    records: 86,
                    closed_form,
                    summary,
                }
            })
            .collect(),
    };
    Boxplots {
        ratio_label: "*r*_{*α*} = *θ̃*_{*α*} / *θ̃*_{0.10}".into(),
        panels: (0..panels).map(panel).collect(),
    }
}
