//! The double-double engine against references of 36 and 40 digits. What is
//! observed is the error itself, taken in double-double.

use std::collections::BTreeMap;

use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real as _};
use serde::Deserialize;
use serde_json::Value;

use super::method::{Answer, Context};
use crate::arithmetic::decimal;
use crate::cases::WrongModel;
use crate::engine::{Arithmetic, WideTrace};
use crate::error::MethodError;
use crate::references;
use crate::references::{
    LINEAR_PULSES, Named, Numbered, PulseOnBlocks, RECT_PULSE, TRAJECTORIES,
};
use crate::scene::{Forcing, Model, Overturning, Scene};

/// Largest error of each quantity; infinite where something is missing.
#[derive(Default)]
struct Errors(BTreeMap<&'static str, f64>);

impl Errors {
    fn add(&mut self, name: &'static str, error: f64) {
        let error = if error.is_nan() { f64::INFINITY } else { error };
        let worst = self.0.entry(name).or_insert(0.0);
        *worst = worst.max(error);
    }

    /// |found - due| times `unit`; both or neither must be there.
    fn compare(
        &mut self,
        name: &'static str,
        found: Option<DoubleDouble>,
        due: Option<DoubleDouble>,
        unit: f64,
    ) {
        self.add(
            name,
            match (found, due) {
                (Some(a), Some(b)) => (a - b).abs().to_f64() * unit,
                (None, None) => 0.0,
                _ => f64::INFINITY,
            },
        );
    }

    /// Times times `rate`, and speeds relative, as many as are listed.
    fn impacts(
        &mut self,
        found: &[(DoubleDouble, DoubleDouble)],
        listed: &[(DoubleDouble, DoubleDouble)],
        rate: f64,
    ) {
        for (k, (time, speed)) in listed.iter().enumerate() {
            let hit = found.get(k);
            let unit = 1.0 / speed.to_f64();
            self.compare(
                "error-of-impact-times-p",
                hit.map(|i| i.0),
                Some(*time),
                rate,
            );
            self.compare(
                "relative-error-of-speeds",
                hit.map(|i| i.1),
                Some(*speed),
                unit,
            );
        }
    }

    fn answer(self) -> Answer {
        let mut answer = Answer::default();
        for (name, error) in self.0 {
            answer.put(name, [error], [0.0]);
        }
        answer
    }
}

fn run(context: &Context, scene: &Scene) -> Result<WideTrace, MethodError> {
    let arithmetic = match context.wrong {
        Some(WrongModel::F64Constants) => Arithmetic::RoundedConstants,
        Some(WrongModel::F64Inputs) => Arithmetic::DoubleDoubleOfRounded,
        _ => Arithmetic::DoubleDouble,
    };
    Ok(WideTrace::run(&context.altered(scene), arithmetic)?)
}

/// A trajectory of 36 digits, under both criteria.
pub(super) fn trajectory(context: &Context) -> Result<Answer, MethodError> {
    let Named { entry } = context.input()?;
    let case = references::trajectory(&entry)?;
    let mut errors = Errors::default();
    for criterion in [Overturning::HalfPi, Overturning::Alpha] {
        let scene = references::scene(case, criterion)?;
        let trace = run(context, &scene)?;
        put_trajectory(&mut errors, case, &scene, &trace)?;
    }
    Ok(errors.answer())
}

fn put_trajectory(
    errors: &mut Errors,
    case: &Value,
    scene: &Scene,
    trace: &WideTrace,
) -> Result<(), MethodError> {
    let file = &TRAJECTORIES;
    let p = scene.frequency_rad_s;
    let expected = file.get(case, "expected")?;
    let (name, flag, key) = match scene.overturning {
        Overturning::Alpha => (
            "error-of-alpha-time-p",
            "first_reaches_alpha",
            "t_first_abs_theta_eq_alpha",
        ),
        Overturning::HalfPi => (
            "error-of-half-pi-time-p",
            "overturned_pi_over_2",
            "t_abs_theta_eq_pi_over_2",
        ),
    };
    let over = expected[flag] == true;
    let when = over.then(|| file.wide(expected, key)).transpose()?;
    errors.compare(name, trace.overturned_s, when, p);
    let uplift = file.list(expected, "uplifts")?.first();
    let uplift = uplift.map(|u| file.wide(u, "t")).transpose()?;
    errors.compare("error-of-uplift-time-p", trace.uplift_s, uplift, p);
    let mut listed = Vec::new();
    for impact in file.list(expected, "impacts")? {
        let time = file.wide(impact, "t")?;
        // A run ends at overturning.
        if when.is_none_or(|when| time < when) {
            listed.push((time, file.wide(impact, "theta_dot_before")?.abs()));
        }
    }
    errors.impacts(&trace.impacts, &listed, p);
    if over {
        return Ok(());
    }
    let peak = file.wide(expected, "peak_abs_theta_over_alpha")?;
    let size = peak.to_f64();
    let unit = if size > 0.0 { 1.0 / size } else { 1.0 };
    errors.compare(
        "relative-error-of-peak",
        Some(trace.peak_ratio),
        Some(peak),
        unit,
    );
    let key = "n_impacts_with_speed_over_p_alpha_above";
    let counts = file.get(expected, key)?;
    for level in ["1e-3", "1e-6", "1e-9"] {
        let unit = p * scene.slenderness_rad;
        let bound = file.number(&Value::from(level))? * unit;
        let speeds = trace.impacts.iter().map(|i| i.1.to_f64());
        let above = speeds.filter(|speed| *speed > bound).count();
        let due = file.f64(counts, level)?;
        errors.add("impacts-miscounted", (above as f64 - due).abs());
    }
    let rests = file.list(expected, "rest_times")?;
    let rest = rests.last().and_then(Value::as_str).and_then(decimal);
    errors.compare("error-of-rest-time-p", trace.rest_s, rest, p);
    Ok(())
}

/// A pulse in Eq. 2 on blocks that scale exactly.
pub(super) fn linear_pulse(context: &Context) -> Result<Answer, MethodError> {
    let input: PulseOnBlocks = context.input()?;
    let file = &LINEAR_PULSES;
    let case = &references::entry(file, input.entry)?;
    let expected = file.get(case, "expected")?;
    let mut errors = Errors::default();
    for [alpha, p, g] in input.blocks.iter().copied() {
        if [alpha, p, g].iter().any(|x| libm::frexp(*x).0 != 0.5) {
            let text = format!("block {alpha}, {p}, {g}: powers of two");
            return Err(MethodError::Input(text));
        }
        let block = [alpha, p, g];
        let scene = references::linear_scene(case, block, Overturning::Alpha)?;
        let trace = run(context, &scene)?;
        let (time, speed) = (1.0 / p, p * alpha);
        let rescaled =
            |x: DoubleDouble, unit: f64| x * DoubleDouble::from_f64(unit);
        let mut listed = Vec::new();
        for impact in file.list(expected, "impacts")? {
            listed.push((
                rescaled(file.wide(impact, "tau")?, time),
                rescaled(file.wide(impact, "phi_dot_before")?.abs(), speed),
            ));
        }
        errors.impacts(&trace.impacts, &listed, p);
        let uplift = rescaled(file.wide(expected, "uplift_tau")?, time);
        errors.compare(
            "error-of-uplift-time-p",
            trace.uplift_s,
            Some(uplift),
            p,
        );
        let key = "tau_first_abs_phi_eq_1";
        let over = !file.get(expected, key)?.is_null();
        let when = over.then(|| file.wide(expected, key)).transpose()?;
        errors.compare(
            "error-of-alpha-time-p",
            trace.overturned_s,
            when.map(|t| rescaled(t, time)),
            p,
        );
    }
    Ok(errors.answer())
}

/// Free rocking to 40 digits, by the project's own generator.
const FREE: &str = include_str!("../../../../fixtures/oracles/free.csv");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FreeInput {
    equation: Model,
    frequency_rad_s: f64,
}

/// One scene of the file.
#[derive(Default)]
struct FreeRow {
    times: Vec<DoubleDouble>,
    speeds: Vec<DoubleDouble>,
    settling: Option<DoubleDouble>,
}

/// Free rocking in one of the equations, every block of the file.
pub(super) fn free_rocking(context: &Context) -> Result<Answer, MethodError> {
    let input: FreeInput = context.input()?;
    let p = input.frequency_rad_s;
    let lacks = |line: &str| MethodError::Reference {
        file: "fixtures/oracles/free.csv",
        what: format!("line `{line}`"),
    };
    let mut rows: BTreeMap<[&str; 3], FreeRow> = BTreeMap::new();
    for line in FREE.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [equation, alpha, eta, ratio, quantity, _, value] = cells[..]
        else {
            return Err(lacks(line));
        };
        if equation != input.equation.name() {
            continue;
        }
        let value = decimal(value).ok_or_else(|| lacks(line))?;
        let row = rows.entry([alpha, eta, ratio]).or_default();
        match quantity {
            "time" => row.times.push(value),
            "speed" => row.speeds.push(value),
            _ => row.settling = Some(value),
        }
    }
    let number = |text: &str| text.parse().map_err(|_| lacks(text));
    let mut errors = Errors::default();
    for ([alpha, eta, ratio], row) in &rows {
        let alpha: f64 = number(alpha)?;
        let scene = Scene {
            model: input.equation,
            ..Scene::new(
                [alpha, p, 9.81],
                number(eta)?,
                Forcing::Free { rotation_rad: alpha * number(ratio)? },
            )
        };
        let trace = run(context, &scene)?;
        let unit = DoubleDouble::from_f64(p);
        let listed: Vec<_> = row
            .times
            .iter()
            .zip(&row.speeds)
            .map(|(t, v)| (*t / unit, *v * unit))
            .collect();
        errors.impacts(&trace.impacts, &listed, p);
        errors.compare(
            "error-of-rest-time-p",
            trace.rest_s,
            row.settling.map(|t| t / unit),
            p,
        );
    }
    Ok(errors.answer())
}

/// Rectangular pulse in Eq. 1, by elliptic integrals.
pub(super) fn rectangular_pulse(
    context: &Context,
) -> Result<Answer, MethodError> {
    let Numbered { entry } = context.input()?;
    let file = &RECT_PULSE;
    let case = &references::entry(file, entry)?;
    let p = file.f64(case, "p")?;
    let mut errors = Errors::default();
    for criterion in [Overturning::HalfPi, Overturning::Alpha] {
        let scene = references::rectangular_scene(case, criterion)?;
        let trace = run(context, &scene)?;
        let (name, key) = match criterion {
            Overturning::Alpha => {
                ("error-of-alpha-time-p", "t_theta_eq_alpha")
            }
            Overturning::HalfPi => {
                ("error-of-half-pi-time-p", "t_theta_eq_pi_over_2")
            }
        };
        let over = case["outcome"] == "overturns";
        let when = over.then(|| file.wide(case, key)).transpose()?;
        errors.compare(name, trace.overturned_s, when, p);
        if over {
            continue;
        }
        let mut listed = Vec::new();
        for impact in file.list(case, "impacts")? {
            listed
                .push((file.wide(impact, "t")?, file.wide(impact, "speed")?));
        }
        errors.impacts(&trace.impacts, &listed, p);
        let peak = file.wide(case, "peak_over_alpha")?;
        errors.compare(
            "relative-error-of-peak",
            Some(trace.peak_ratio),
            Some(peak),
            1.0 / peak.to_f64(),
        );
        if !case["settling_time"].is_null() {
            let settling = file.wide(case, "settling_time")?;
            errors.compare(
                "error-of-rest-time-p",
                trace.rest_s,
                Some(settling),
                p,
            );
        }
    }
    Ok(errors.answer())
}
