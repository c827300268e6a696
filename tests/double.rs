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
/// for instants; infinite where the fate or the number of impacts is wrong.
#[derive(Default)]
struct Errors {
    /// Peak, uplift, impacts.
    motion: f64,
    /// When it overturned, where it did.
    end: Option<f64>,
    compared: usize,
}

impl Errors {
    fn add(&mut self, error: f64) {
        self.motion = self.motion.max(error);
        self.compared += 1;
    }

    fn demand(&mut self, holds: bool) {
        self.add(if holds { 0.0 } else { f64::INFINITY });
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
    if overturns != found.outcome.is_overturned() {
        errors.motion = f64::INFINITY;
        return (errors, found);
    }
    if let Outcome::Overturned { time_s, .. } = found.outcome {
        errors.end = Some(difference(time_s, wide(&expected[when])) * p);
    } else {
        let peak = wide(&expected["peak_abs_theta_over_alpha"]);
        let size = if peak.to_f64() > 0.0 { peak.to_f64() } else { 1.0 };
        errors.add(difference(found.peak_ratio, peak) / size);
        let bound = found.error_estimate.unwrap();
        errors.demand(difference(found.peak_ratio, peak) <= bound);
        let rest = expected["rest_times"].as_array().and_then(|v| v.last());
        if let Some(rest) = rest {
            let time_s = found.rest_time_s.unwrap();
            errors.add(difference(time_s, wide(rest)) * p);
            for level in ["1e-3", "1e-6", "1e-9"] {
                let counts =
                    &expected["n_impacts_with_speed_over_p_alpha_above"];
                let bound = double(&Value::from(level)) * p * get("alpha");
                let speeds = found.impacts.iter();
                let above = speeds
                    .filter(|i| i.speed_before_rad_s.to_f64() > bound)
                    .count();
                errors.demand(above as u64 == counts[level].as_u64().unwrap());
            }
        }
    }
    let uplift = expected["uplifts"].get(0);
    if let (Some(uplift), Some(time_s)) = (uplift, found.uplift_time_s) {
        errors.add(difference(time_s, wide(&uplift["t"])) * p);
    }
    let impacts = expected["impacts"].as_array().unwrap();
    let before = |reference: &&Value| match found.outcome {
        Outcome::Overturned { time_s, .. } => {
            wide(&reference["t"]) < time_s.wide()
        }
        Outcome::Rocked { .. } | Outcome::NoUplift => true,
    };
    let impacts: Vec<&Value> = impacts.iter().filter(before).collect();
    errors.demand(found.impacts.len() >= impacts.len());
    for (impact, reference) in found.impacts.iter().zip(impacts) {
        errors.add(difference(impact.time_s, wide(&reference["t"])) * p);
        let speed = wide(&reference["theta_dot_before"]).abs();
        let off = difference(impact.speed_before_rad_s, speed);
        errors.add(off / speed.to_f64());
    }
    (errors, found)
}

/// What conditioning leaves of 28 digits: ten times as many roundoffs as a
/// code in double precision is off.
fn tolerance(case: &Value) -> f64 {
    let attainable = case["attainable_float64"].as_object().unwrap();
    let errors = attainable.iter().filter(|(key, _)| key.contains("_err"));
    let worst = errors.fold(0.0_f64, |most, (_, x)| most.max(double(x)));
    (10.0 * worst * DoubleDouble::ROUNDOFF / f64::ROUNDOFF).max(1e-28)
}

/// The same for the instant of overturning, which the margin magnifies.
fn end_tolerance<N: Wide>(case: &Value, found: &Response<N>) -> f64 {
    let by_margin = found.fate_error.unwrap() / found.fate_margin;
    tolerance(case).max(by_margin)
}

fn each_case(mut check: impl FnMut(&str, &Value, &Ground, Overturning)) {
    let all: Value = serde_json::from_str(TRAJECTORIES).unwrap();
    let records: Value = serde_json::from_str(RECORDS).unwrap();
    for case in all["cases"].as_array().unwrap() {
        let name = case["name"].as_str().unwrap();
        let ground = Ground::of(case, &records);
        for overturning in [Overturning::Alpha, Overturning::HalfPi] {
            check(name, case, &ground, overturning);
        }
    }
}

#[test]
fn trajectories_agree_with_the_references_to_28_digits() {
    let (mut runs, mut well, mut compared) = (0, 0, 0);
    each_case(|name, case, ground, overturning| {
        let (errors, found) =
            compare::<DoubleDouble>(case, ground, overturning);
        let bound = tolerance(case);
        println!(
            "{name:32} {overturning:?}: motion {:.1e} (bound {bound:.1e}), \
             overturning {:.1e}",
            errors.motion,
            errors.end.unwrap_or(f64::NAN),
        );
        assert!(errors.motion <= bound, "{name} {overturning:?}");
        if let Some(end) = errors.end {
            assert!(end <= end_tolerance(case, &found), "{name}");
        }
        runs += 1;
        well += usize::from(bound <= 1e-28);
        compared += errors.compared;
    });
    assert_eq!(runs, 2 * 41);
    println!("{well} of {runs} well conditioned, {compared} numbers");
    assert!(well >= 36 && compared >= 1400);
}

#[test]
fn coefficients_rounded_to_double_precision_are_caught() {
    let (mut caught, mut flights) = (0, 0);
    each_case(|name, case, ground, overturning| {
        let (errors, found) =
            compare::<RoundedConstants>(case, ground, overturning);
        if found.work.steps == 0 {
            return;
        }
        flights += 1;
        let end = errors.end.unwrap_or(0.0);
        let missed = errors.motion <= tolerance(case)
            && end <= end_tolerance(case, &found);
        if missed {
            println!("{name} {overturning:?} does not tell");
        }
        caught += usize::from(!missed);
    });
    println!("{caught} of {flights} runs catch rounded constants");
    // All but a touch of the threshold by one unit in the last place.
    assert!(caught >= flights - 2 && flights >= 80);
}
