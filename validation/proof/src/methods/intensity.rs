//! Intensity measures against closed forms and other packages.

use std::f64::consts::PI;

use rocking::intensity::{IntensityError, Measures, PairMeasures, Settings};
use rocking::record::Accelerogram;
use rocking::units::STANDARD_GRAVITY_M_S2;
use serde::Deserialize;

use super::method::{Answer, Context, MethodError, WrongModel};

const EXPECTED: &str = "fixtures/oracles/intensity.csv";
const EXPECTED_CSV: &str =
    include_str!("../../../../fixtures/oracles/intensity.csv");
const PAIR_CSV: &str =
    include_str!("../../../../fixtures/oracles/intensity-pair.csv");

/// How a component is made.
#[derive(Deserialize)]
#[serde(deny_unknown_fields, tag = "kind", rename_all = "kebab-case")]
enum Motion {
    /// The samples themselves.
    Listed { dt_s: f64, samples_g: Vec<f64> },
    /// `count` samples of a sum of amplitude times sin(2 pi f t + phase).
    Sines { rate_hz: f64, count: u32, terms: Vec<[f64; 3]> },
    /// The first component times the tangent of an angle.
    Parallel { angle_deg: f64 },
    /// A column of the synthetic pair.
    Synthetic { column: usize },
}

impl Motion {
    fn record(
        &self,
        first: Option<&Accelerogram>,
    ) -> Result<Accelerogram, MethodError> {
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
                let first = first.ok_or_else(|| {
                    MethodError::Input("parallel to nothing".into())
                })?;
                let factor = libm::tan(angle_deg.to_radians());
                let scaled = first.samples_g().iter().map(|a| factor * a);
                (first.dt_s(), scaled.collect())
            }
            Self::Synthetic { column } => (0.02, pair_column(*column)),
        };
        Accelerogram::try_new("case", dt_s, samples)
            .map_err(|e| MethodError::Input(e.to_string()))
    }
}

fn pair_column(column: usize) -> Vec<f64> {
    PAIR_CSV
        .lines()
        .skip(1)
        .filter_map(|line| line.split(',').nth(column)?.parse().ok())
        .collect()
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

fn refused(error: IntensityError) -> MethodError {
    MethodError::Oracle(error.to_string())
}

/// Measures of one or two components.
pub(super) fn measures(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        /// Name of the motion in the file of expected values.
        motion: String,
        /// What is compared: `first`, `second`, `geometric_mean`, `rotd50`.
        of: Vec<String>,
        first: Motion, second: Option<Motion>,
    }
    let rows: Vec<[&str; 4]> = EXPECTED_CSV
        .lines()
        .filter_map(|line| {
            <[&str; 4]>::try_from(line.split(',').collect::<Vec<_>>()).ok()
        })
        .filter(|row| row[0] == motion)
        .collect();
    let mut periods: Vec<(&str, f64)> = Vec::new();
    for row in &rows {
        if let Some(text) = row[2].strip_prefix("sa_")
            && !periods.iter().any(|(known, _)| *known == text)
        {
            periods.push((text, parse(text)?));
        }
    }
    let stretch = context.or(WrongModel::PeriodOnePercentLong, 1.01, 1.0);
    let damping = context.or(WrongModel::NoDamping, 0.0, 0.05);
    let settings = Settings::try_new(
        STANDARD_GRAVITY_M_S2,
        damping,
        periods.iter().map(|(_, t)| stretch * t).collect(),
    )
    .map_err(refused)?;
    let mut first = first.record(None)?;
    let mut second = match &second {
        Some(motion) => Some(motion.record(Some(&first))?),
        None => None,
    };
    if context.is(WrongModel::VelocityForAcceleration) {
        first = velocity(&first).unwrap_or(first);
        second = second.as_ref().and_then(velocity);
    }
    let mut found: Vec<(&str, Measures)> = Vec::new();
    match &second {
        Some(second) => {
            let pair = PairMeasures::of(&first, second, &settings)
                .map_err(refused)?;
            let rotd50 = match context.wrong {
                Some(WrongModel::GeometricMeanForRotd50) => {
                    pair.geometric_mean.clone()
                }
                _ => pair.rotd50,
            };
            let mean = context.or(
                WrongModel::Rotd50ForGeometricMean,
                rotd50.clone(),
                pair.geometric_mean,
            );
            let [one, two] = pair.components;
            found.extend([
                ("first", one),
                ("second", two),
                ("geometric_mean", mean),
                ("rotd50", rotd50),
            ]);
        }
        None => {
            let one = Measures::of(&first, &settings).map_err(refused)?;
            found.push(("first", one));
        }
    }
    let mut answer = Answer::default();
    for of in &of {
        let measures = found.iter().find(|(name, _)| name == of);
        let Some((_, measures)) = measures else {
            return Err(MethodError::Input(format!("no measures of `{of}`")));
        };
        for row in rows.iter().filter(|row| row[1] == of) {
            let position = row[2]
                .strip_prefix("sa_")
                .and_then(|t| periods.iter().position(|(p, _)| *p == t));
            let own = value(measures, row[2], position, context.wrong)
                .ok_or_else(|| MethodError::Reference {
                    file: EXPECTED,
                    what: format!("`{}` is no measure", row[2]),
                })?;
            let name = match position {
                Some(_) => "spectral-acceleration-g".to_owned(),
                None => row[2].replace('_', "-"),
            };
            answer.put(&name, [own], [parse(row[3])?]);
        }
    }
    Ok(answer)
}

fn value(
    m: &Measures,
    name: &str,
    period: Option<usize>,
    wrong: Option<WrongModel>,
) -> Option<f64> {
    Some(match name {
        "pga_g" => m.pga_g,
        "pgv_m_s" => m.pgv_m_s,
        "pgd_m" => m.pgd_m,
        "arias_intensity_m_s" => match wrong {
            // The integral of a^2 over g.
            Some(WrongModel::AriasWithoutItsFactor) => {
                m.arias_intensity_m_s * std::f64::consts::FRAC_2_PI
            }
            _ => m.arias_intensity_m_s,
        },
        "cav_m_s" => m.cav_m_s,
        "significant_duration_5_75_s" => m.significant_duration_5_75_s,
        "significant_duration_5_95_s" => m.significant_duration_5_95_s,
        "mean_period_s" => m.mean_period_s?,
        _ => *m.spectral_acceleration_g.get(period?)?,
    })
}

fn parse(text: &str) -> Result<f64, MethodError> {
    text.parse().map_err(|_| MethodError::Reference {
        file: EXPECTED,
        what: format!("`{text}` is no number"),
    })
}
