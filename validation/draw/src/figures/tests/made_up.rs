//! Made-up numbers of the right shape; they come from closed formulas and
//! have no meaning.

mod statistics;

use rocking::statistics::{Boxplot, ExtendedSample, QuantileType};

use crate::figures::*;
use rocking_common::paper::{Arm, Intensity};
pub use statistics::{
    accepted, by_constant, chart, fragilities, spectrum, tests_along,
};

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
    vec![
        sketch().figure(String::new()),
        histories().figure(String::new()),
        ida().figure(String::new()),
        boxplots(4).figure(String::new()),
        boxplots(8).figure(String::new()),
        quantiles().figure(String::new()),
        capacities().figure(String::new()),
        accepted().figure(String::new()),
        tests_along().figure(String::new()),
        fragilities().figure(String::new()),
        by_constant().figure(String::new()),
        chart().figure(String::new()),
        spectrum().figure(String::new()),
        fates().figure(String::new()),
    ]
}

pub fn fates() -> FateMap {
    let ends = |count: usize, step: f64| -> Vec<f64> {
        (0..=count).map(|k| libm::exp(step * k as f64)).collect()
    };
    let of = |k: usize| Fate::after([None, Some(0), Some(1), Some(2)][k % 4]);
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

pub fn histories() -> Histories {
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
    Histories {
        heading: heading("figure-02", None),
        panels: (0..9).map(panel).collect(),
        columns: 3,
    }
}

pub fn ida() -> IdaCurves {
    let panel = |i: usize| {
        let p = FREQUENCIES[i / 3];
        let curves = ALPHAS
            .iter()
            .enumerate()
            .map(|(k, alpha)| {
                let fall = 1.6 + 0.9 * noise(i) + 0.1 * normal(7 * i + k);
                let im: Vec<f64> =
                    (0..200).map(|n| 1.0 + 0.02 * n as f64).collect();
                let im: Vec<f64> =
                    im.into_iter().take_while(|x| *x <= fall).collect();
                let edp = im
                    .iter()
                    .enumerate()
                    .map(|(n, x)| {
                        let s = (x - 1.0) / (fall - 1.0);
                        let weave = 0.04 * noise(n + 3 * i);
                        0.9 * s * s + weave * s
                    })
                    .collect();
                IdaCurve {
                    alpha_rad: *alpha,
                    im,
                    edp,
                    overturning_im: Some(fall),
                }
            })
            .collect();
        IdaPanel {
            p_rad_s: p,
            record: format!("RSN{}_QUAKE_A{}-090, 1994", 700 + i, i),
            curves,
        }
    };
    IdaCurves {
        heading: heading("figure-04", Some(Arm::A)),
        panels: (0..9).map(panel).collect(),
        columns: 3,
    }
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
        heading: heading(&format!("figure-06-{panels}"), Some(Arm::C)),
        ratio_label: "*r*_{*α*} = *θ̃*_{*α*} / *θ̃*_{0.10}".into(),
        panels: (0..panels).map(panel).collect(),
        columns: if panels == 4 { 2 } else { 4 },
    }
}

pub fn quantiles() -> Quantiles {
    let group = |p: f64, alpha: f64| {
        let im: Vec<f64> = (0..400).map(|n| 1.0 + 0.02 * n as f64).collect();
        let curve = |z: f64| -> Vec<f64> {
            let fall = 1.0 + (5.0 / p) * libm::exp(-0.6 * z + 0.2 * alpha);
            im.iter()
                .map(|x| {
                    let s = (x - 1.0) / (fall - 1.0);
                    if s < 1.0 { 0.85 * s * s } else { f64::INFINITY }
                })
                .collect()
        };
        QuantileGroup {
            label: format!("*α* = {alpha:.2} rad"),
            quantiles: [-1.0, 0.0, 1.0].map(curve),
            im,
        }
    };
    let panel = |p: &f64| QuantilePanel {
        p_rad_s: *p,
        note: String::new(),
        groups: ALPHAS.iter().map(|a| group(*p, *a)).collect(),
    };
    Quantiles {
        heading: heading("figure-08", Some(Arm::A)),
        panels: FREQUENCIES.iter().map(panel).collect(),
        columns: 3,
    }
}

pub fn capacities() -> Capacities {
    let panel = |(intensity, shift): (Intensity, f64)| CapacityPanel {
        intensity,
        shift,
        quantiles: (0..=100)
            .map(|k| 0.01 * f64::from(k))
            .map(|e| (e, [1.0, 2.0, 4.0].map(|q| shift + q * e.sqrt())))
            .collect(),
        curves: (0..86)
            .map(|r| {
                let edp: Vec<f64> =
                    (0..=100).map(|k| 0.01 * k as f64).collect();
                let reach = 3.0 * libm::exp(0.5 * normal(r));
                let start = match intensity {
                    Intensity::Pga => 1.0,
                    Intensity::Pgv => shift * (1.0 + noise(r + 500)),
                };
                let im = |(k, e): (usize, &f64)| {
                    start + reach * e.sqrt() + 0.1 * noise(k + 101 * r) * e
                };
                CapacityCurve {
                    record: format!("R{r}"),
                    im: edp.iter().enumerate().map(im).collect(),
                    edp,
                }
            })
            .collect(),
    };
    Capacities {
        heading: heading("figure-11", Some(Arm::A)),
        alpha_rad: 0.20,
        p_rad_s: 1.0,
        panels: [(Intensity::Pga, 1.0), (Intensity::Pgv, 0.14)]
            .into_iter()
            .map(panel)
            .collect(),
    }
}
