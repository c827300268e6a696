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
    vec![Box::new(ida()), Box::new(boxplots(2)), Box::new(boxplots(4))]
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
        p_rad_s: 1.0,
        alpha_rad: [0.05, 0.15, 0.20, 0.25][i],
        note: String::new(),
        stripes: levels
            .iter()
            .enumerate()
            .map(|(k, level)| {
                let usable = 86 - 11 * k;
                let spread = 0.05 + 0.06 * i as f64;
                let sample = (0..usable)
                    .map(|r| libm::exp(spread * normal(r + 100 * k + 900 * i)))
                    .collect();
                Stripe {
                    level: *level,
                    usable,
                    records: 86,
                    summary: (usable >= 10).then(|| notched(sample)),
                }
            })
            .collect(),
    };
    Boxplots {
        heading: heading(&format!("figure-06-{panels}"), Some(Arm::C)),
        ratio_label: "*r*_{*α*} = *θ̃*_{*α*} / *θ̃*_{0.10}".into(),
        stripes: StripeKind::Intensity(Intensity::Pga),
        panels: (0..panels).map(panel).collect(),
        columns: 2,
    }
}
