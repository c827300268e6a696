//! Intensity measures against closed forms and other packages.

use std::f64::consts::{FRAC_2_PI, PI};

use anyhow::{Context as _, Result, bail};
use rocking::accelerogram::Accelerogram;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::intensity::{Measures, PairMeasures, Settings};
use serde::Deserialize;

use super::cells::Csv;
use super::method::{Context, Reply, WrongModel};

const EXPECTED: Csv = Csv::new("oracles/intensity.csv");
const PAIR_CSV: &str = rocking_fixtures::text("oracles/intensity-pair.csv");

/// Source of a component.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, tag = "kind", rename_all = "kebab-case")]
enum ComponentInput {
    /// The samples themselves.
    Listed { dt_s: f64, samples_g: Vec<f64> },
    /// `count` samples of a sum of amplitude times sin(2 pi f t + phase).
    Sines { rate_hz: f64, count: u32, terms: Vec<[f64; 3]> },
    /// The first component times the tangent of an angle.
    Parallel { angle_deg: f64 },
    /// A column of the synthetic pair.
    Synthetic { column: usize },
}

impl ComponentInput {
    fn record(&self, first: Option<&Accelerogram>) -> Result<Accelerogram> {
        let (dt_s, samples) = match self {
            Self::Listed { dt_s, samples_g } => (*dt_s, samples_g.clone()),
            Self::Sines { rate_hz, count, terms } => {
                let at = |i: u32| {
                    let t = f64::from(i) / rate_hz;
                    terms.iter().fold(0.0, |sum, [amplitude, hz, phase]| {
                        let angle = 2.0 * PI * hz * t + phase;
                        amplitude.mul_add(libm::sin(angle), sum)
                    })
                };
                (1.0 / rate_hz, (0..*count).map(at).collect())
            }
            Self::Parallel { angle_deg } => {
                let first = first.context("parallel to nothing")?;
                let factor = libm::tan(angle_deg.to_radians());
                let scaled = first.samples_g().iter().map(|a| factor * a);
                (first.dt_s(), scaled.collect())
            }
            Self::Synthetic { column } => {
                let cell =
                    |line: &str| line.split(',').nth(*column)?.parse().ok();
                (0.02, PAIR_CSV.lines().skip(1).filter_map(cell).collect())
            }
        };
        Ok(Accelerogram::try_new("case", dt_s, samples)?)
    }
}

/// Velocity in g s taken for the acceleration.
fn velocity(record: &Accelerogram) -> Option<Accelerogram> {
    let mut sum = 0.0;
    let mut samples = vec![0.0];
    for pair in record.samples_g().windows(2) {
        sum += 0.5 * record.dt_s() * (pair[0] + pair[1]);
        samples.push(sum);
    }
    Accelerogram::try_new("velocity", record.dt_s(), samples).ok()
}

/// Measures of one or two components.
pub fn measures(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Name of the motion in the file of expected values.
        motion: String,
        /// The measures to compare: `first`, `second`, `geometric_mean`,
        /// `rotd50`, `rotd100`.
        of: Vec<String>,
        first: ComponentInput, second: Option<ComponentInput>,
    }
    let rows = EXPECTED.rows(&motion)?;
    let mut periods: Vec<f64> =
        rows.iter().filter_map(|row| period(row.text(2))).collect();
    periods.sort_by(f64::total_cmp);
    periods.dedup();
    let stretch = context.or(WrongModel::PeriodOnePercentLong, 1.01, 1.0);
    let damping = context.or(WrongModel::NoDamping, 0.0, 0.05);
    let stretched = periods.iter().map(|t| stretch * t).collect();
    let settings =
        Settings::try_new(STANDARD_GRAVITY_M_S2, damping, stretched)?;
    let mut first = first.record(None)?;
    let mut second = second.map(|m| m.record(Some(&first))).transpose()?;
    if context.is(WrongModel::VelocityForAcceleration) {
        first = velocity(&first).unwrap_or(first);
        second = second.as_ref().and_then(velocity);
    }
    let alone = Measures::of(&first, &settings)?;
    let pair = second.map(|second| {
        PairMeasures::of(&first, &second, &settings, &[50.0, 100.0])
    });
    let pair = pair.transpose()?;
    for of in &of {
        let used = match (context.wrong, of.as_str()) {
            (Some(WrongModel::GeometricMeanForRotd50), "rotd50") => {
                "geometric_mean"
            }
            (Some(WrongModel::Rotd50ForGeometricMean), "geometric_mean") => {
                "rotd50"
            }
            (_, of) => of,
        };
        let measures = match (used, &pair) {
            ("first", None) => &alone,
            ("first", Some(pair)) => &pair.components[0],
            ("second", Some(pair)) => &pair.components[1],
            ("geometric_mean", Some(pair)) => &pair.geometric_mean,
            ("rotd50", Some(pair)) => &pair.rotd[0],
            ("rotd100", Some(pair)) => &pair.rotd[1],
            _ => bail!("no measures of `{of}`"),
        };
        for row in rows.iter().filter(|row| row.text(1) == of) {
            let name = row.text(2);
            let place = |t| periods.iter().position(|own| *own == t);
            let place = period(name).and_then(place);
            let own = match place {
                Some(k) => measures.spectral_acceleration_g.get(k).copied(),
                None if name == "mean_period_s" => measures.mean_period_s,
                None => measures.scalar(name),
            };
            // The integral of a^2 over g.
            let is_arias = name == "arias_intensity_m_s";
            let wrong = context.is(WrongModel::AriasWithoutItsFactor);
            let factor = if wrong && is_arias { FRAC_2_PI } else { 1.0 };
            let none = || EXPECTED.lacks(format!("`{name}` is no measure"));
            let own = [factor * own.ok_or_else(none)?];
            let name = match place {
                Some(_) => "spectral-acceleration-g".to_owned(),
                None => name.replace('_', "-"),
            };
            answer.put(&name, own, [row.number(3)?]);
        }
    }
    Ok(())
}

/// The period of a spectral acceleration, s.
fn period(name: &str) -> Option<f64> {
    name.strip_prefix("sa_")?.parse().ok()
}
