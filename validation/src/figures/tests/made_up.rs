//! Made-up numbers of the right shape; they come from closed formulas and
//! have no meaning.

use crate::figures::Figure;
use crate::figures::data::*;

pub const ALPHAS: [f64; 5] = [0.05, 0.10, 0.15, 0.20, 0.25];
pub const FREQUENCIES: [f64; 3] = [1.0, 3.0, 4.0];

pub fn heading(name: &str, arm: Option<Arm>) -> Heading {
    Heading {
        name: name.into(),
        title: format!("{name}: made up"),
        description: "Made-up numbers & <marks>.".into(),
        arm,
    }
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

pub fn all() -> Vec<Box<dyn Figure>> {
    vec![
        Box::new(sketch()),
        Box::new(histories()),
        Box::new(ida()),
        Box::new(boxplots(4)),
        Box::new(boxplots(8)),
        Box::new(quantiles()),
        Box::new(capacities()),
        Box::new(accepted()),
        Box::new(tests_along()),
        Box::new(fragilities()),
        Box::new(by_constant()),
        Box::new(chart()),
        Box::new(spectrum()),
        Box::new(fates()),
    ]
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
            intensity: Intensity::Pga,
            im: 1.5 + 0.02 * i as f64,
            until_s: 30.0,
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
        intensity: Intensity::Pga,
        panels: (0..9).map(panel).collect(),
        columns: 3,
    }
}

pub fn notched(mut sample: Vec<f64>) -> NotchedBox {
    sample.sort_by(f64::total_cmp);
    let n = sample.len();
    let at = |q: f64| sample[((n - 1) as f64 * q) as usize];
    let (q1, median, q3) = (at(0.25), at(0.5), at(0.75));
    let half = 1.57 * (q3 - q1) / (n as f64).sqrt();
    let inside =
        |x: &&f64| **x >= q1 - 1.5 * (q3 - q1) && **x <= q3 + 1.5 * (q3 - q1);
    NotchedBox {
        q1,
        median,
        q3,
        notch_low: median - half,
        notch_high: median + half,
        whisker_low: *sample.iter().find(inside).unwrap(),
        whisker_high: *sample.iter().rev().find(inside).unwrap(),
        outliers: sample.iter().filter(|x| !inside(x)).copied().collect(),
        median_interval: None,
    }
}

pub fn boxplots(panels: usize) -> Boxplots {
    let levels = [1.1, 1.25, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0];
    let panel = |i: usize| BoxPanel {
        p_rad_s: if panels == 4 { 1.0 } else { FREQUENCIES[1 + i / 4] },
        alpha_rad: [0.05, 0.15, 0.20, 0.25][i % 4],
        note: String::new(),
        stripes: levels
            .iter()
            .enumerate()
            .map(|(k, level)| {
                let usable = 86 - 11 * k;
                let spread = 0.05 + 0.06 * i as f64;
                let ratio =
                    |r| libm::exp(spread * normal(r + 100 * k + 900 * i));
                let sample = (0..usable).map(ratio).collect();
                let summary = (usable >= 10).then(|| notched(sample));
                Stripe { level: *level, usable, records: 86, summary }
            })
            .collect(),
    };
    Boxplots {
        heading: heading(&format!("figure-06-{panels}"), Some(Arm::C)),
        ratio_label: "*r*_{*α*} = *θ̃*_{*α*} / *θ̃*_{0.10}".into(),
        stripes: StripeKind::Intensity(Intensity::Pga),
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
            q16: curve(-1.0),
            q50: curve(0.0),
            q84: curve(1.0),
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
        intensity: Intensity::Pga,
        panels: FREQUENCIES.iter().map(panel).collect(),
        columns: 3,
    }
}

pub fn capacities() -> Capacities {
    let panel = |(intensity, shift): (Intensity, f64)| CapacityPanel {
        intensity,
        shift,
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

pub fn accepted() -> AcceptedShares {
    let panel = |i: usize| {
        let mut shares = Vec::new();
        for (k, p) in FREQUENCIES.iter().enumerate() {
            for (j, alpha) in ALPHAS.iter().enumerate() {
                for (m, arm) in [Arm::A, Arm::C].into_iter().enumerate() {
                    let at = 31 * i + 7 * k + 3 * j + m;
                    let share = if i % 2 == 0 {
                        noise(at)
                    } else {
                        0.9 + 0.1 * noise(at)
                    };
                    shares.push(BlockShare {
                        p_rad_s: *p,
                        alpha_rad: *alpha,
                        arm,
                        share,
                        null_band: Some((0.71, 1.0)),
                    });
                }
            }
        }
        let pulse = i > 1;
        SharePanel {
            suite: if pulse { "pulse-type" } else { "ordinary" }.into(),
            records: if pulse { 44 } else { 86 },
            shifted: i % 2 == 1,
            shares,
        }
    };
    AcceptedShares {
        heading: heading("figure-12", None),
        intensity: Intensity::Pga,
        expected: 0.95,
        panels: (0..4).map(panel).collect(),
        columns: 2,
    }
}

pub fn sample(n: usize, seed: usize, scale: f64) -> Vec<f64> {
    let one = |i| libm::exp(scale * normal(i + 1000 * seed));
    (0..n).map(one).collect()
}

fn histogram(sample: &[f64]) -> Histogram {
    let mut logs: Vec<f64> = sample.iter().map(|x| libm::log(*x)).collect();
    logs.sort_by(f64::total_cmp);
    let n = logs.len() as f64;
    let mean = logs.iter().sum::<f64>() / n;
    let squares: f64 = logs.iter().map(|x| (x - mean) * (x - mean)).sum();
    let quartiles = (logs[logs.len() / 4], logs[3 * logs.len() / 4]);
    let deviation = (squares / (n - 1.0)).sqrt();
    Histogram::freedman_diaconis(&logs, quartiles, mean, deviation)
}

pub fn tests_along() -> TestsAlongDemand {
    let block = |alpha: f64, seed: usize| {
        let edp: Vec<f64> = (1..=100).map(|k| 0.01 * k as f64).collect();
        let shifted = sample(86, seed, 0.6);
        let original: Vec<f64> = shifted.iter().map(|x| x + 1.0).collect();
        TestedBlock {
            p_rad_s: 3.0,
            alpha_rad: alpha,
            original: (0..100)
                .map(|k| 1.3 + 0.2 * noise(k + 99 * seed))
                .collect(),
            shifted: (0..100)
                .map(|k| 0.7 + 0.4 * noise(k + 77 * seed))
                .collect(),
            edp,
            original_histogram: histogram(&original),
            shifted_histogram: histogram(&shifted),
        }
    };
    TestsAlongDemand {
        heading: heading("figure-13", Some(Arm::A)),
        intensity: Intensity::Pga,
        edp: 0.5,
        blocks: vec![block(0.05, 1), block(0.20, 2)],
    }
}

pub fn fragilities() -> Fragilities {
    let threshold = |edp: f64, seed: usize, shift: f64| {
        let mut capacities: Vec<f64> = sample(86, seed, 0.5)
            .iter()
            .map(|x| shift + edp.sqrt() * 2.0 * x)
            .collect();
        capacities[5] = f64::INFINITY;
        let ln_median = libm::log(2.0 * edp.sqrt());
        let fit = |estimator, curve| Fitted { estimator, curve };
        let shifted = Lognormal { ln_median, dispersion: 0.5, shift };
        let unshifted = Lognormal {
            ln_median: libm::log(shift + 2.0 * edp.sqrt()),
            dispersion: 0.4,
            shift: 0.0,
        };
        Threshold {
            edp,
            sample: capacities,
            curves: vec![
                fit(Estimator::Usfl, Some(unshifted)),
                fit(
                    Estimator::Usfl7,
                    (edp > 0.2 || shift < 0.5).then_some(shifted),
                ),
            ],
        }
    };
    let panel = |(intensity, shift): (Intensity, f64)| FragilityPanel {
        intensity,
        thresholds: [(0.15, 3), (0.35, 4), (1.0, 5)]
            .into_iter()
            .map(|(edp, seed)| threshold(edp, seed, shift))
            .collect(),
    };
    Fragilities {
        heading: heading("figure-16", Some(Arm::A)),
        panels: [(Intensity::Pga, 1.0), (Intensity::Pgv, 0.14)]
            .into_iter()
            .map(panel)
            .collect(),
    }
}

pub fn by_constant() -> ByConstant {
    let fit =
        |dispersion| Lognormal { ln_median: 0.0, dispersion, shift: 1.0 };
    let panel = |(title, grow): (&str, f64)| ByConstantPanel {
        title: title.into(),
        benchmark: Some(fit(0.7)),
        sample: sample(86, 6, 0.7).iter().map(|x| x + 1.0).collect(),
        curves: [0.25, 0.5, 0.75, 1.0]
            .into_iter()
            .map(|c| ConstantCurve {
                c,
                curve: (c < 1.0 || grow < 1.0)
                    .then(|| fit(0.7 + grow * c * c)),
            })
            .collect(),
    };
    ByConstant {
        heading: heading("figure-18", Some(Arm::A)),
        intensity: Intensity::Pga,
        edp: 0.15,
        panels: [("untrimmed MLE", 1.2), ("trimmed moments", 0.1)]
            .into_iter()
            .map(panel)
            .collect(),
    }
}

fn axis(label: &str, scale: Scale) -> Axis {
    Axis { label: label.into(), scale, range: None, categories: vec![] }
}

pub fn chart() -> Chart {
    let series = |k: usize| {
        let n = 8;
        Series {
            label: ["Taylor 8", "DOP853", "RK4", "ode45"][k].into(),
            mark: Mark::LineAndPoints,
            x: (0..n)
                .map(|i| libm::pow(10.0, -2.0 - 1.4 * i as f64))
                .collect(),
            y: (0..n)
                .map(|i| {
                    libm::pow(10.0, -6.0 + 0.4 * k as f64 + 0.2 * i as f64)
                })
                .collect(),
            interval: vec![],
        }
    };
    let power = |k: usize| Series {
        label: ["Taylor 8", "DOP853"][k].into(),
        mark: Mark::Points,
        x: (0..3).map(|i| i as f64 + 0.9 + 0.2 * k as f64).collect(),
        y: (0..3).map(|i| 0.2 + 0.2 * i as f64 + 0.1 * noise(k)).collect(),
        interval: (0..3)
            .map(|i| (0.1 + 0.2 * f64::from(i), 0.4 + 0.2 * f64::from(i)))
            .collect(),
    };
    Chart {
        heading: heading("figure-speed", None),
        panels: vec![
            ChartPanel {
                title: "speed against error".into(),
                x: axis("error of *θ*/*α*", Scale::Logarithmic),
                y: axis("time for an analysis (s)", Scale::Logarithmic),
                series: (0..4).map(series).collect(),
            },
            ChartPanel {
                title: "named ticks".into(),
                x: Axis {
                    categories: vec![
                        "option 1".into(),
                        "option 2".into(),
                        "option 3".into(),
                    ],
                    ..axis("", Scale::Linear)
                },
                y: axis("power", Scale::Linear),
                series: (0..2).map(power).collect(),
            },
        ],
        columns: 2,
    }
}

pub fn spectrum() -> Chart {
    let series = |(label, mark, from): (&str, Mark, f64)| {
        let x: Vec<f64> = (0..200).map(|i| 0.05 * f64::from(i)).collect();
        Series {
            label: label.into(),
            mark,
            y: x.iter().map(|w| from + 0.2 * w * w).collect(),
            interval: x
                .iter()
                .map(|w| (0.9 * (from + 0.2 * w * w), from + 0.25 * w * w))
                .collect(),
            x,
        }
    };
    Chart {
        heading: heading("figure-spectrum", None),
        panels: vec![ChartPanel {
            title: "one-sine pulse".into(),
            x: axis("*ω*_{p} / *p*", Scale::Linear),
            y: Axis {
                range: Some((0.0, 12.0)),
                ..axis("*a*_{p} / (*g* tan *α*)", Scale::Linear)
            },
            series: [
                ("criterion *α*", Mark::Line, 1.0),
                ("criterion π/2", Mark::Line, 2.0),
                ("", Mark::Dashed, 0.5),
            ]
            .into_iter()
            .map(series)
            .collect(),
        }],
        columns: 1,
    }
}

pub fn fates() -> FateMap {
    let edges = |low: f64, high: f64| -> Vec<f64> {
        let step = (high - low) / 120.0;
        (0..=120).map(|i| low + step * f64::from(i)).collect()
    };
    let fate = |i: usize| {
        let (x, y) = ((i % 120) as f64 / 12.0, (i / 120) as f64 / 12.0);
        if y < 1.0 {
            Fate::NoUplift
        } else if y > 1.0 + 0.2 * x * x {
            Fate::OverturnedWithoutImpact
        } else if y > 1.0 + 0.1 * x * x {
            Fate::OverturnedAfterImpact
        } else {
            Fate::Rocked
        }
    };
    FateMap {
        heading: heading("figure-fates", None),
        panels: vec![FatePanel {
            title: "one-sine pulse".into(),
            x: axis("*ω*_{p} / *p*", Scale::Linear),
            y: axis("*a*_{p} / (*g* tan *α*)", Scale::Linear),
            x_edges: edges(0.0, 10.0),
            y_edges: edges(0.0, 10.0),
            fates: (0..120 * 120).map(fate).collect(),
        }],
        columns: 1,
    }
}
