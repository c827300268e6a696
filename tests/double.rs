//! The double-double engine against references of 36 digits, and a wrong
//! engine that they must catch.

use std::ops::{Add, Div, Mul, Neg, Sub};

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind, ScaledRecord};
use rocking::integrator::{
    Model, Observe, Outcome, Overturning, Response, Scene, respond_in,
};
use rocking::number::double::DoubleDouble;
use rocking::number::{Number, Real};
use serde_json::Value;

const TRAJECTORIES: &str =
    include_str!("../fixtures/references/trajectories.json");
const RECORDS: &str = include_str!("../fixtures/references/records.json");

/// Double-double with coefficients rounded to double precision.
#[derive(Clone, Copy, Debug, PartialEq, PartialOrd)]
struct RoundedConstants(DoubleDouble);

macro_rules! operator {
    ($trait:ident, $name:ident) => {
        impl $trait for RoundedConstants {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Self($trait::$name(self.0, other.0))
            }
        }
    };
}
operator!(Add, add);
operator!(Sub, sub);
operator!(Mul, mul);
operator!(Div, div);

impl Neg for RoundedConstants {
    type Output = Self;
    fn neg(self) -> Self {
        Self(-self.0)
    }
}

impl Number for RoundedConstants {
    fn from_f64(x: f64) -> Self {
        Self(DoubleDouble::from_f64(x))
    }

    fn ratio(i: i32, j: i32) -> Self {
        Self::from_f64(f64::from(i) / f64::from(j))
    }

    fn mul_add(self, b: Self, c: Self) -> Self {
        Self(self.0.mul_add(b.0, c.0))
    }

    fn sin_cos_small(self) -> (Self, Self) {
        self.sin_cos()
    }
}

impl Real for RoundedConstants {
    const ROUNDOFF: f64 = DoubleDouble::ROUNDOFF;
    const NEWTON_STEP: f64 = DoubleDouble::NEWTON_STEP;

    fn to_f64(self) -> f64 {
        self.0.to_f64()
    }

    fn sqrt(self) -> Self {
        Self(self.0.sqrt())
    }

    fn abs(self) -> Self {
        Self(self.0.abs())
    }

    fn sin_cos(self) -> (Self, Self) {
        let (s, c) = self.0.sin_cos();
        (Self(s), Self(c))
    }

    fn exp(self) -> Self {
        Self(self.0.exp())
    }

    fn ln_1p(self) -> Self {
        Self(self.0.ln_1p())
    }

    fn asin(self) -> Self {
        Self(self.0.asin())
    }

    fn right_angle() -> Self {
        Self(DoubleDouble::right_angle())
    }
}

/// A type whose numbers are read as double-doubles.
trait Wide: Real {
    fn wide(self) -> DoubleDouble;
}

impl Wide for DoubleDouble {
    fn wide(self) -> DoubleDouble {
        self
    }
}

impl Wide for RoundedConstants {
    fn wide(self) -> DoubleDouble {
        self.0
    }
}

/// A decimal number to the last bit or two of a double-double.
fn decimal(text: &str) -> DoubleDouble {
    let (mantissa, exponent) = text.split_once('e').unwrap_or((text, "0"));
    let mut exponent: i32 = exponent.parse().unwrap();
    let ten = DoubleDouble::from_f64(10.0);
    let mut value = DoubleDouble::zero();
    let mut fraction = false;
    for digit in mantissa.trim_start_matches('-').chars() {
        if digit == '.' {
            fraction = true;
            continue;
        }
        let digit = f64::from(digit.to_digit(10).unwrap());
        value = value * ten + DoubleDouble::from_f64(digit);
        exponent -= i32::from(fraction);
    }
    for _ in 0..exponent.abs() {
        value = if exponent < 0 { value / ten } else { value * ten };
    }
    if mantissa.starts_with('-') { -value } else { value }
}

fn wide(value: &Value) -> DoubleDouble {
    decimal(value.as_str().unwrap())
}

fn double(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other.as_f64().unwrap(),
    }
}

/// The excitation of a case, owned.
enum Ground {
    Pulse(Pulse),
    Record { samples_m_s2: Vec<f64>, dt_s: f64, gravity_m_s2: f64 },
}

impl Ground {
    fn of(case: &Value, records: &Value) -> Self {
        let forcing = &case["forcing"];
        let get = |key: &str| double(&forcing[key]);
        let amplitude_g = || get("a_p");
        let omega_rad_s = || get("omega");
        let duration_s = || get("t_d");
        let kind = match forcing["kind"].as_str().unwrap() {
            "one_sine" => PulseKind::OneSine {
                amplitude_g: amplitude_g(),
                omega_rad_s: omega_rad_s(),
            },
            "half_sine" => PulseKind::HalfSine {
                amplitude_g: amplitude_g(),
                omega_rad_s: omega_rad_s(),
            },
            "one_cosine" => PulseKind::OneCosine {
                amplitude_g: amplitude_g(),
                omega_rad_s: omega_rad_s(),
            },
            "rectangular" => PulseKind::Rectangle {
                amplitude_g: amplitude_g(),
                duration_s: duration_s(),
            },
            "triangular" => PulseKind::Triangle {
                amplitude_g: amplitude_g(),
                duration_s: duration_s(),
            },
            "ricker_sym" => PulseKind::RickerSymmetric {
                amplitude_g: amplitude_g(),
                period_s: get("T_p"),
                cycles: get("n_Tp"),
            },
            "ricker_anti" => PulseKind::RickerAntisymmetric {
                amplitude_g: amplitude_g(),
                period_s: get("T_p"),
                cycles: get("n_Tp"),
            },
            "mavroeidis" => PulseKind::MavroeidisPapageorgiou {
                velocity_g_s: get("A_v"),
                frequency_hz: get("f_p"),
                gamma: get("gamma"),
                phase_rad: get("nu"),
            },
            "sampled" => {
                let own = &forcing["acc"];
                let samples = if own.is_array() {
                    own
                } else {
                    &records[forcing["record"].as_str().unwrap()]["acc"]
                };
                let samples = samples.as_array().unwrap();
                return Self::Record {
                    samples_m_s2: samples.iter().map(double).collect(),
                    dt_s: get("dt"),
                    gravity_m_s2: double(&case["g"]),
                };
            }
            other => panic!("unknown pulse {other}"),
        };
        Self::Pulse(Pulse::try_new_si(kind, double(&case["g"])).unwrap())
    }

    fn excitation(&self) -> Excitation<'_> {
        match self {
            Self::Pulse(pulse) => Excitation::Pulse(pulse),
            Self::Record { samples_m_s2, dt_s, gravity_m_s2 } => {
                let record = ScaledRecord::try_new_si(
                    samples_m_s2,
                    *dt_s,
                    *gravity_m_s2,
                );
                Excitation::Record(record.unwrap())
            }
        }
    }
}

/// Largest errors of a case: relative for the peak and the speeds, times p
/// for instants.
#[derive(Default, Debug)]
struct Errors {
    peak: f64,
    instants: f64,
    speeds: f64,
    rest: f64,
    fates: usize,
    compared: usize,
}

impl Errors {
    fn worst(&self) -> f64 {
        self.peak.max(self.instants).max(self.speeds).max(self.rest)
    }
}

fn difference<N: Wide>(found: N, expected: DoubleDouble) -> f64 {
    (found.wide() - expected).abs().to_f64()
}

fn compare<N: Wide>(
    case: &Value,
    ground: &Ground,
    overturning: Overturning,
) -> (Errors, Response<N>) {
    let get = |key: &str| double(&case[key]);
    let p = get("p");
    let scene = Scene {
        block: Block::try_new(get("alpha"), p).unwrap(),
        restitution: Restitution::constant(get("eta")).unwrap(),
        model: match case["model"].as_str().unwrap() {
            "linear" => Model::Linearized,
            _ => Model::Nonlinear,
        },
        overturning,
        excitation: ground.excitation(),
        initial_ratio: 0.0,
    };
    let observe =
        Observe { events: true, accuracy: true, ..Observe::default() };
    let found: Response<N> = respond_in(&scene, &observe).unwrap();
    let expected = &case["expected"];
    let (overturns, when) = match overturning {
        Overturning::Alpha => {
            ("first_reaches_alpha", "t_first_abs_theta_eq_alpha")
        }
        Overturning::HalfPi => {
            ("overturned_pi_over_2", "t_abs_theta_eq_pi_over_2")
        }
    };
    let overturns = expected[overturns].as_bool().unwrap();
    let mut errors = Errors::default();
    errors.fates += usize::from(overturns != found.outcome.is_overturned());
    if let Outcome::Overturned { time_s, .. } = found.outcome
        && overturns
    {
        let error = difference(time_s, wide(&expected[when])) * p;
        errors.instants = errors.instants.max(error);
        errors.compared += 1;
    }
    if !overturns {
        let peak = wide(&expected["peak_abs_theta_over_alpha"]);
        let size = if peak.to_f64() > 0.0 { peak.to_f64() } else { 1.0 };
        errors.peak = difference(found.peak_ratio, peak) / size;
        errors.compared += 1;
        let rest = expected["rest_times"].as_array().and_then(|v| v.last());
        if let (Some(rest), Some(time_s)) = (rest, found.rest_time_s) {
            errors.rest = difference(time_s, wide(rest)) * p;
            errors.compared += 1;
        }
    }
    let uplift = expected["uplifts"].get(0);
    if let (Some(uplift), Some(time_s)) = (uplift, found.uplift_time_s) {
        let error = difference(time_s, wide(&uplift["t"])) * p;
        errors.instants = errors.instants.max(error);
        errors.compared += 1;
    }
    let impacts = expected["impacts"].as_array().unwrap();
    for (impact, reference) in found.impacts.iter().zip(impacts) {
        let time = difference(impact.time_s, wide(&reference["t"])) * p;
        let speed = wide(&reference["theta_dot_before"]).abs();
        let off = difference(impact.speed_before_rad_s, speed);
        errors.instants = errors.instants.max(time);
        errors.speeds = errors.speeds.max(off / speed.to_f64());
        errors.compared += 2;
    }
    (errors, found)
}

#[test]
fn trajectories_agree_with_the_references_to_28_digits() {
    let all: Value = serde_json::from_str(TRAJECTORIES).unwrap();
    let records: Value = serde_json::from_str(RECORDS).unwrap();
    for case in all["cases"].as_array().unwrap() {
        let name = case["name"].as_str().unwrap();
        let ground = Ground::of(case, &records);
        for overturning in [Overturning::Alpha, Overturning::HalfPi] {
            let (errors, found) =
                compare::<DoubleDouble>(case, &ground, overturning);
            println!(
                "{name:32} {overturning:?} {:.1e} {:.1e} {:.1e} {:.1e} fates {} compared {} est {:.1e} fate {:.1e}/{:.1e} cond {:.1e} steps {}",
                errors.peak,
                errors.instants,
                errors.speeds,
                errors.rest,
                errors.fates,
                errors.compared,
                found.error_estimate.unwrap(),
                found.fate_margin,
                found.fate_error.unwrap(),
                found.condition_number.unwrap(),
                found.work.steps,
            );
        }
    }
}
