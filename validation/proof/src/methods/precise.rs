//! The double-double engine against references of 36 and 40 digits. What is
//! observed is the error itself, taken in double-double.

use std::collections::BTreeMap;

use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real as _};

use super::method::{Answer, Context, MethodError, WrongModel};
use crate::arithmetic::decimal;
use crate::engine::{Arithmetic, WideTrace};
use crate::references::{self, Digits, Expected, LINEAR_PULSES, RECT_PULSE};
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

    /// The peak's relative error; the error itself where none is due.
    fn peak(&mut self, found: DoubleDouble, due: Option<Digits>) {
        let due = due.map(|peak| peak.wide);
        let size = due.map_or(f64::NAN, DoubleDouble::to_f64);
        let unit = if size > 0.0 { 1.0 / size } else { 1.0 };
        let name = "relative-error-of-peak";
        self.compare(name, Some(found), due, unit);
    }

    /// When the criterion of a scene is met.
    fn end(&mut self, scene: &Scene, trace: &WideTrace, due: Option<Digits>) {
        let name = match scene.overturning {
            Overturning::Alpha => "error-of-alpha-time-p",
            Overturning::HalfPi => "error-of-half-pi-time-p",
        };
        let due = due.map(|t| t.wide);
        self.compare(name, trace.overturned_s, due, scene.frequency_rad_s);
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
            let name = "error-of-impact-times-p";
            self.compare(name, hit.map(|i| i.0), Some(*time), rate);
            let name = "relative-error-of-speeds";
            self.compare(name, hit.map(|i| i.1), Some(*speed), unit);
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
    input!(context; entry: String);
    let case = references::trajectory(&entry)?;
    let mut errors = Errors::default();
    for criterion in [Overturning::HalfPi, Overturning::Alpha] {
        let scene = case.scene(criterion)?;
        let trace = run(context, &scene)?;
        put_trajectory(&mut errors, &case.expected, &scene, &trace);
    }
    Ok(errors.answer())
}

fn put_trajectory(
    errors: &mut Errors,
    due: &Expected,
    scene: &Scene,
    trace: &WideTrace,
) {
    let (p, criterion) = (scene.frequency_rad_s, scene.overturning);
    errors.end(scene, trace, due.overturned(criterion));
    let uplift = due.uplifts.first().map(|u| u.t.wide);
    errors.compare("error-of-uplift-time-p", trace.uplift_s, uplift, p);
    errors.impacts(&trace.impacts, &due.impacts_until(criterion), p);
    if due.overturned(criterion).is_some() {
        return;
    }
    errors.peak(trace.peak_ratio, due.peak());
    for (key, level) in [("1e-3", 1e-3), ("1e-6", 1e-6), ("1e-9", 1e-9)] {
        let bound = level * (p * scene.slenderness_rad);
        let speeds = trace.impacts.iter().map(|i| i.1.to_f64());
        let above = speeds.filter(|speed| *speed > bound).count();
        let due = due.faster.get(key).copied().unwrap_or(f64::NAN);
        errors.add("impacts-miscounted", (above as f64 - due).abs());
    }
    let rest = due.rest_times.last().map(|t| t.wide);
    errors.compare("error-of-rest-time-p", trace.rest_s, rest, p);
}

/// A pulse in Eq. 2 on blocks that scale exactly.
pub(super) fn linear_pulse(context: &Context) -> Result<Answer, MethodError> {
    input!(context; entry: usize, blocks: Vec<[f64; 3]>);
    let case = LINEAR_PULSES.entry(entry)?;
    let due = &case.expected;
    let mut errors = Errors::default();
    for block in blocks {
        let [alpha, p, g] = block;
        if block.iter().any(|x| libm::frexp(*x).0 != 0.5) {
            let text = format!("block {alpha}, {p}, {g}: powers of two");
            return Err(MethodError::Input(text));
        }
        let trace = run(context, &case.scene(block, Overturning::Alpha)?)?;
        let units = [1.0 / p, p * alpha];
        let listed: Vec<_> =
            due.impacts.iter().map(|hit| hit.wide(units)).collect();
        errors.impacts(&trace.impacts, &listed, p);
        let time = |t: Digits| Some(t.wide * DoubleDouble::from_f64(1.0 / p));
        let uplift = time(due.uplift_tau);
        errors.compare("error-of-uplift-time-p", trace.uplift_s, uplift, p);
        let over = due.overturned.and_then(time);
        errors.compare("error-of-alpha-time-p", trace.overturned_s, over, p);
    }
    Ok(errors.answer())
}

/// Free rocking to 40 digits, by the project's own generator.
const FREE: &str = include_str!("../../../../fixtures/oracles/free.csv");

/// One scene of the file.
#[derive(Default)]
struct FreeRow {
    times: Vec<DoubleDouble>,
    speeds: Vec<DoubleDouble>,
    settling: Option<DoubleDouble>,
}

/// Free rocking in one of the equations, every block of the file.
pub(super) fn free_rocking(context: &Context) -> Result<Answer, MethodError> {
    input!(context; equation: Model, frequency_rad_s: f64);
    let p = frequency_rad_s;
    let lacks = |line: &str| MethodError::Reference {
        file: "fixtures/oracles/free.csv",
        what: format!("line `{line}`"),
    };
    let mut rows: BTreeMap<[&str; 3], FreeRow> = BTreeMap::new();
    for line in FREE.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let [law, alpha, eta, ratio, quantity, _, value] = cells[..] else {
            return Err(lacks(line));
        };
        if law != equation.name() {
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
            model: equation,
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
        let rest = row.settling.map(|t| t / unit);
        errors.compare("error-of-rest-time-p", trace.rest_s, rest, p);
    }
    Ok(errors.answer())
}

/// Rectangular pulse in Eq. 1, by elliptic integrals.
pub(super) fn rectangular_pulse(
    context: &Context,
) -> Result<Answer, MethodError> {
    input!(context; entry: usize);
    let case = RECT_PULSE.entry(entry)?;
    let p = case.p.near;
    let mut errors = Errors::default();
    for criterion in [Overturning::HalfPi, Overturning::Alpha] {
        let scene = case.scene(criterion);
        let trace = run(context, &scene)?;
        errors.end(&scene, &trace, case.overturned(criterion));
        let Some(peak) = case.peak_over_alpha else { continue };
        let listed: Vec<_> =
            case.impacts.iter().map(|hit| hit.wide([1.0; 2])).collect();
        errors.impacts(&trace.impacts, &listed, p);
        errors.peak(trace.peak_ratio, Some(peak));
        if let Some(rest) = case.settling_time {
            let rest = Some(rest.wide);
            errors.compare("error-of-rest-time-p", trace.rest_s, rest, p);
        }
    }
    Ok(errors.answer())
}
