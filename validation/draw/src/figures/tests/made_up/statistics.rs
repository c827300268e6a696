//! Made-up tests and fits.

use rocking::statistics::Lognormal;

use super::{ALPHAS, FREQUENCIES, heading, noise, normal};
use crate::figures::*;
use rocking_common::paper::{Arm, Intensity};

pub fn accepted() -> AcceptedShares {
    let panel = |i: usize| {
        let mut shares = Vec::new();
        for (k, p) in FREQUENCIES.iter().enumerate() {
            for (j, alpha) in ALPHAS.iter().enumerate() {
                for (m, arm) in [Arm::A, Arm::C].into_iter().enumerate() {
                    let at = 31 * i + 7 * k + 3 * j + m;
                    let share = if i.is_multiple_of(2) {
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
                        levels: 200 - k,
                    });
                }
            }
        }
        let pulse = i > 1;
        SharePanel {
            suite: if pulse { "pulse-type" } else { "ordinary" }.into(),
            records: if pulse { 44 } else { 86 },
            shifted: !i.is_multiple_of(2),
            shares,
        }
    };
    AcceptedShares {
        heading: heading("figure-12", None),
        intensity: Intensity::Pga,
        expected: 0.95,
        levels: 200,
        panels: (0..4).map(panel).collect(),
        columns: 2,
    }
}

fn sample(n: usize, seed: usize, scale: f64) -> Vec<f64> {
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
            grid_critical: Some(1.4),
            original_histogram: histogram(&original),
            shifted_histogram: histogram(&shifted),
        }
    };
    TestsAlongDemand {
        heading: heading("figure-13", Some(Arm::A)),
        edp: 0.5,
        blocks: vec![block(0.05, 1), block(0.20, 2)],
    }
}

fn lognormal(shift: f64, log_mean: f64, dispersion: f64) -> Lognormal {
    Lognormal::try_new(shift, log_mean, dispersion).unwrap()
}

pub fn fragilities() -> Fragilities {
    let panel = |(intensity, shift): (Intensity, f64), edp: f64, seed| {
        let mut capacities: Vec<f64> = sample(86, seed, 0.5)
            .iter()
            .map(|x| shift + edp.sqrt() * 2.0 * x)
            .collect();
        capacities[5] = f64::INFINITY;
        let ln_median = libm::log(2.0 * edp.sqrt());
        let fit = |estimator, curve: Option<Lognormal>| {
            let ends = |c: &Lognormal, x| (x, c.cdf(x) - 0.1, c.cdf(x) + 0.1);
            let at = |c| (1..60).map(move |k| ends(c, 0.1 * f64::from(k)));
            let band = curve.as_ref().into_iter().flat_map(at).collect();
            Fitted { estimator, curve, band, band_of: BandOf::Curve }
        };
        let shifted = lognormal(shift, ln_median, 0.5);
        let unshifted =
            lognormal(0.0, libm::log(shift + 2.0 * edp.sqrt()), 0.4);
        FragilityPanel {
            intensity,
            edp,
            sample: capacities,
            curves: vec![
                fit(Estimator::Usfl, Some(unshifted)),
                fit(
                    Estimator::Usfl7,
                    (edp > 0.2 || shift < 0.5).then_some(shifted),
                ),
            ],
            limit: Some(Limit { around: shifted, by: 0.05 }),
            notes: vec!["largest distance".into(), "0.05".into()],
        }
    };
    let panels = [(Intensity::Pga, 1.0), (Intensity::Pgv, 0.14)]
        .into_iter()
        .flat_map(|of| {
            [(0.15, 3), (0.35, 4), (1.0, 5)]
                .map(|(edp, seed)| panel(of, edp, seed))
        });
    Fragilities {
        heading: heading("figure-16", Some(Arm::A)),
        panels: panels.collect(),
        columns: 3,
    }
}

pub fn by_constant() -> ByConstant {
    let fit = |dispersion| lognormal(1.0, 0.0, dispersion);
    let panel = |(title, grow): (&str, f64)| ByConstantPanel {
        title: title.into(),
        benchmark: Some(fit(0.7)),
        sample: sample(86, 6, 0.7).iter().map(|x| x + 1.0).collect(),
        curves: [0.25, 0.5, 0.75, 1.0]
            .into_iter()
            .map(|c| {
                let curve =
                    (c < 1.0 || grow < 1.0).then(|| fit(0.7 + grow * c * c));
                (c, curve)
            })
            .collect(),
    };
    ByConstant {
        heading: heading("figure-18", Some(Arm::A)),
        edp: 0.15,
        panels: [("untrimmed MLE", 1.2), ("trimmed moments", 0.1)]
            .into_iter()
            .map(panel)
            .collect(),
    }
}

fn axis(label: &str, scale: Scale) -> ChartAxis {
    match scale {
        Scale::Linear => ChartAxis::linear(label, None::<(f64, f64)>),
        Scale::Logarithmic => {
            ChartAxis::logarithmic(label, None::<(f64, f64)>)
        }
    }
}

pub fn chart() -> Chart {
    let series = |k: usize| {
        let n = 8;
        Series::new(
            ["Taylor 8", "DOP853", "RK4", "ode45"][k],
            Mark::LineAndPoints,
            (0..n).map(|i| libm::pow(10.0, -2.0 - 1.4 * i as f64)).collect(),
            (0..n)
                .map(|i| {
                    libm::pow(10.0, -6.0 + 0.4 * k as f64 + 0.2 * i as f64)
                })
                .collect(),
        )
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
                x: axis("error of *θ*/*α*", Scale::Logarithmic)
                    .with_second(1e3, "error in thousandths"),
                y: axis("time for an analysis (s)", Scale::Logarithmic),
                series: (0..4).map(series).collect(),
            },
            ChartPanel {
                title: "named ticks".into(),
                x: ChartAxis {
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
            y: ChartAxis {
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
