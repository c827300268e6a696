//! Prints moments of motions of suites side by side: the two embedded ones,
//! or those whose index files are given, for instance
//!
//! ```sh
//! cargo run -p rocking-synthesis --example motions -- ordinary.csv
//! ```
//!
//! Only the study components count, and no response of a block is computed.
//! The embedded suites are adjusted to the moments in `src/moments.rs`.

use std::error::Error;
use std::path::Path;

use rocking::accelerogram::Accelerogram;
use rocking_records::intensity::{Measures, Settings};
use rocking_records::{ReadOptions, Suite};
use rocking_synthesis::SuiteKind;

/// Periods of the response spectrum, in s.
const PERIODS_S: [f64; 16] = [
    0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0, 7.0,
    7.5, 10.0,
];

/// Parameters p of blocks, in rad/s: their average spectral acceleration is
/// the geometric mean at ten periods from 0.15 to 1.0 times 2 pi/p, at equal
/// ratios.
const P_RAD_S: [f64; 5] = [1.0, 2.0, 3.0, 4.0, 6.0];

const GRAVITY_M_S2: f64 = 9.80665;

/// A motion in the table: natural logarithms of measures by their labels, PGA
/// and PGV first, and (t_PGV - t_PGA)/D5-75.
type MotionMoments = (Vec<(String, f64)>, f64);

fn main() -> Result<(), Box<dyn Error>> {
    let paths: Vec<String> = std::env::args().skip(1).collect();
    for path in &paths {
        let suite = Suite::read(Path::new(path), &ReadOptions::default())?;
        print(path, suite.study_components().map(|m| &m.accelerogram))?;
    }
    if paths.is_empty() {
        let suites = [rocking_synthesis::ordinary, rocking_synthesis::pulse];
        for (kind, pairs) in SuiteKind::ALL.into_iter().zip(suites) {
            let pairs = pairs()?;
            let name = format!("embedded {kind}");
            print(&name, pairs.iter().map(|pair| &pair.components[0]))?;
        }
    }
    Ok(())
}

fn measured(motion: &Accelerogram) -> Result<MotionMoments, Box<dyn Error>> {
    let average = P_RAD_S.iter().flat_map(|p| {
        (0..10).map(move |i| {
            std::f64::consts::TAU / p * libm::pow(0.15, f64::from(i) / 9.0)
        })
    });
    let periods_s = PERIODS_S.into_iter().chain(average).collect();
    let settings = Settings::try_new(GRAVITY_M_S2, 0.05, periods_s)?;
    let m = Measures::of(motion, &settings)?;
    let (a, dt_s) = (motion.samples_g(), motion.dt_s());
    let mut velocity = vec![0.0; a.len()];
    for i in 1..a.len() {
        velocity[i] = velocity[i - 1] + 0.5 * dt_s * (a[i - 1] + a[i]);
    }
    let place = |values: &[f64]| {
        let sizes = values.iter().map(|x| x.abs()).enumerate();
        let largest = sizes.max_by(|x, y| x.1.total_cmp(&y.1));
        largest.map_or(0.0, |(i, _)| i as f64 * dt_s)
    };
    let delay = (place(&velocity) - place(a)) / m.significant_duration_5_75_s;
    let single = [
        ("PGA", m.pga_g),
        ("PGV", m.pgv_m_s),
        ("PGD", m.pgd_m),
        ("Tm", m.mean_period_s.ok_or("no mean period")?),
        ("D5-75", m.significant_duration_5_75_s),
    ];
    let mut rows: Vec<(String, f64)> =
        single.map(|(label, x)| (label.to_owned(), libm::log(x))).into();
    let sa: Vec<f64> =
        m.spectral_acceleration_g.iter().map(|sa| libm::log(*sa)).collect();
    let (own, averages) = sa.split_at(PERIODS_S.len());
    let single = PERIODS_S.iter().zip(own);
    rows.extend(single.map(|(t, sa)| (format!("SA {t} s"), *sa)));
    let tens = P_RAD_S.iter().zip(averages.chunks(10));
    rows.extend(tens.map(|(p, ten)| (format!("AvgSA p={p}"), mean(ten))));
    let sixes = PERIODS_S.windows(6).zip(own.windows(6)).skip(2).take(6);
    rows.extend(
        sixes.map(|(t, six)| (format!("{}..{} s", t[0], t[5]), mean(six))),
    );
    Ok((rows, delay))
}

fn print<'a>(
    name: &str,
    motions: impl Iterator<Item = &'a Accelerogram>,
) -> Result<(), Box<dyn Error>> {
    let motions: Vec<MotionMoments> =
        motions.map(measured).collect::<Result<_, _>>()?;
    println!("{name}: {} motions", motions.len());
    println!(
        "   measure      mean   sd ln   med/PGA   sd ln  rho PGA  rho PGV \
         med/mean"
    );
    let column = |k: usize| -> Vec<f64> {
        motions.iter().map(|(rows, _)| rows[k].1).collect()
    };
    let (pga, pgv) = (column(0), column(1));
    let labels = motions.first().map_or(&[][..], |(rows, _)| rows);
    for (k, (label, _)) in labels.iter().enumerate() {
        let own = column(k);
        let ratio: Vec<f64> =
            own.iter().zip(&pga).map(|(x, pga)| x - pga).collect();
        let ([mean, sd], [middle, ratio_sd]) =
            (moments(&own), moments(&ratio));
        println!(
            "{label:>10} {:9.4} {sd:7.3} {:9.4} {ratio_sd:7.3} {:8.3} \
             {:8.3} {:8.3}",
            libm::exp(mean),
            libm::exp(median(&ratio)),
            correlation(&own, &pga),
            correlation(&own, &pgv),
            libm::exp(median(&ratio) - middle),
        );
    }
    let delay: Vec<f64> = motions.iter().map(|(_, delay)| *delay).collect();
    let ([mean, sd], middle) = (moments(&delay), median(&delay));
    println!(
        "(t_PGV - t_PGA)/D5-75: median {middle:.3}, mean {mean:.3}, sd {sd:.3}"
    );
    println!();
    Ok(())
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn moments(values: &[f64]) -> [f64; 2] {
    let (n, mean) = (values.len() as f64, mean(values));
    let squares: f64 = values.iter().map(|x| (x - mean) * (x - mean)).sum();
    [mean, (squares / (n - 1.0)).sqrt()]
}

fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])
}

fn correlation(x: &[f64], y: &[f64]) -> f64 {
    let ([mx, sx], [my, sy]) = (moments(x), moments(y));
    let products: f64 =
        x.iter().zip(y).map(|(x, y)| (x - mx) * (y - my)).sum();
    products / (x.len() as f64 - 1.0) / (sx * sy)
}
