//! The double-double engine against references of 36 and 40 digits. The
//! observed quantities are the errors, computed in double-double.

use std::collections::BTreeMap;

use anyhow::{Result, ensure};
use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real as _};

use super::cells::Csv;
use super::method::{Context, Reply, WrongModel};
use crate::engine::{Precision, WideTrace};
use crate::references::{self, Decimal, LINEAR_PULSES, RECT_PULSE};
use crate::scene::{CaseScene, Forcing, Model, Overturning, by_criterion};

/// The largest error of each quantity; infinite if a value is missing.
impl Reply {
    fn add(&mut self, name: &str, error: f64) {
        let error = if error.is_nan() { f64::INFINITY } else { error };
        let worst = self.observed.entry(name.to_owned()).or_default();
        *worst = vec![worst.first().map_or(error, |x| x.max(error))];
        self.expected.insert(name.to_owned(), vec![0.0]);
    }

    /// |found - due| times `unit`; both or neither must be there.
    fn compare(
        &mut self,
        name: &str,
        found: Option<DoubleDouble>,
        due: Option<DoubleDouble>,
        unit: f64,
    ) {
        let error = match (found, due) {
            (Some(a), Some(b)) => (a - b).abs().to_f64() * unit,
            (None, None) => 0.0,
            _ => f64::INFINITY,
        };
        self.add(name, error);
    }

    /// The relative error of the peak; infinite if no peak is expected.
    fn peak(&mut self, found: DoubleDouble, due: Option<Decimal>) {
        let size = due.map_or(f64::NAN, |peak| peak.near);
        let unit = if size > 0.0 { 1.0 / size } else { 1.0 };
        let due = due.map(|peak| peak.wide);
        self.compare("relative-error-of-peak", Some(found), due, unit);
    }

    /// Time at which the criterion of a scene is met.
    fn end(
        &mut self,
        scene: &CaseScene,
        trace: &WideTrace,
        due: Option<Decimal>,
    ) {
        let names = ["error-of-alpha-time-p", "error-of-half-pi-time-p"];
        let name = by_criterion(scene.overturning, names[0], names[1]);
        let due = due.map(|t| t.wide);
        self.compare(name, trace.overturned_s, due, scene.frequency_rad_s);
    }

    /// Times times `rate`, and speeds relative, as many as are listed.
    fn impacts(
        &mut self,
        trace: &WideTrace,
        listed: impl IntoIterator<Item = (DoubleDouble, DoubleDouble)>,
        rate: f64,
    ) {
        for (k, (time, speed)) in listed.into_iter().enumerate() {
            let hit = trace.impacts.get(k);
            let unit = 1.0 / speed.to_f64();
            let name = "error-of-impact-times-p";
            self.compare(name, hit.map(|i| i.0), Some(time), rate);
            let name = "relative-error-of-speeds";
            self.compare(name, hit.map(|i| i.1), Some(speed), unit);
        }
    }
}

fn wide_trace(context: &Context, scene: &CaseScene) -> Result<WideTrace> {
    let arithmetic = match context.wrong {
        #[cfg(not(target_family = "wasm"))]
        Some(WrongModel::F64Constants) => Precision::RoundedConstants,
        Some(WrongModel::F64Inputs) => Precision::DoubleDoubleOfRounded,
        _ => Precision::DoubleDouble,
    };
    Ok(WideTrace::run(&context.altered(scene), arithmetic)?)
}

/// A trajectory of 36 digits, under both criteria.
pub fn trajectory(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entry: String);
    let case = references::trajectory(&entry)?;
    let due = &case.expected;
    for criterion in [Overturning::HalfPi, Overturning::Alpha] {
        let scene = case.scene(criterion)?;
        let trace = wide_trace(context, &scene)?;
        let p = scene.frequency_rad_s;
        answer.end(&scene, &trace, due.overturned(criterion));
        let uplift = due.uplifts.first().map(|u| u.t.wide);
        answer.compare("error-of-uplift-time-p", trace.uplift_s, uplift, p);
        answer.impacts(&trace, due.impacts_until(criterion), p);
        if due.overturned(criterion).is_some() {
            continue;
        }
        answer.peak(trace.peak_ratio, due.peak());
        for (key, level) in [("1e-3", 1e-3), ("1e-6", 1e-6), ("1e-9", 1e-9)] {
            let bound = level * (p * scene.slenderness_rad);
            let speeds = trace.impacts.iter().map(|i| i.1.to_f64());
            let above = speeds.filter(|speed| *speed > bound).count();
            let due = due.faster.get(key).copied().unwrap_or(f64::NAN);
            answer.add("impacts-miscounted", (above as f64 - due).abs());
        }
        let rest = due.rest_times.last().map(|t| t.wide);
        answer.compare("error-of-rest-time-p", trace.rest_s, rest, p);
    }
    Ok(())
}

/// A pulse in Eq. 2 on blocks that scale exactly.
pub fn linear_pulse(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entry: usize, blocks: Vec<[f64; 3]>);
    let case = LINEAR_PULSES.entry(entry)?;
    let due = &case.expected;
    for block in blocks {
        let [alpha, p, g] = block;
        let exact = block.iter().all(|x| libm::frexp(*x).0 == 0.5);
        ensure!(exact, "block {alpha}, {p}, {g}: powers of two");
        let scene = case.scene(block, Overturning::Alpha)?;
        let trace = wide_trace(context, &scene)?;
        let units = [1.0 / p, p * alpha];
        let listed = due.impacts.iter().map(|hit| hit.wide(units));
        answer.impacts(&trace, listed, p);
        let time = |t: Decimal| Some(t.wide * DoubleDouble::from_f64(1.0 / p));
        let uplift = time(due.uplift_tau);
        answer.compare("error-of-uplift-time-p", trace.uplift_s, uplift, p);
        let over = due.overturned.and_then(time);
        answer.compare("error-of-alpha-time-p", trace.overturned_s, over, p);
    }
    Ok(())
}

/// Free rocking to 40 digits, by the project's own generator.
const FREE: Csv = Csv::new("oracles/free.csv");

/// Free rocking in one of the equations, every block of the file.
pub fn free_rocking(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; equation: Model, frequency_rad_s: f64);
    let p = frequency_rad_s;
    let mut blocks = BTreeMap::<_, BTreeMap<_, Vec<DoubleDouble>>>::new();
    for row in FREE.rows(equation.name())? {
        let block = [1, 2, 3].map(|column| row.text(column));
        let lists = blocks.entry(block).or_default();
        lists.entry(row.text(4)).or_default().extend(row.decimals(6)?);
    }
    let unit = DoubleDouble::from_f64(p);
    for (block, lists) in blocks {
        let [alpha, eta, ratio] = block.map(str::parse::<f64>);
        let (alpha, rotation_ratio) = (alpha?, ratio?);
        let release = Forcing::Free { rotation_rad: alpha * rotation_ratio };
        let scene = CaseScene::new([alpha, p, 9.81], eta?, release);
        let trace = wide_trace(context, &scene.in_equation(equation))?;
        let pairs = lists["time"].iter().zip(&lists["speed"]);
        let listed = pairs.map(|(t, v)| (*t / unit, *v * unit));
        answer.impacts(&trace, listed, p);
        let rest = lists.get("settling").and_then(|list| list.last());
        let rest = rest.map(|t| *t / unit);
        answer.compare("error-of-rest-time-p", trace.rest_s, rest, p);
    }
    Ok(())
}

/// Rectangular pulse in Eq. 1, by elliptic integrals.
pub fn rectangular_pulse(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entry: usize);
    let case = RECT_PULSE.entry(entry)?;
    let p = case.p.near;
    for criterion in [Overturning::HalfPi, Overturning::Alpha] {
        let scene = case.scene(criterion);
        let trace = wide_trace(context, &scene)?;
        answer.end(&scene, &trace, case.overturned(criterion));
        let Some(peak) = case.peak_over_alpha else { continue };
        let listed = case.impacts.iter().map(|hit| hit.wide([1.0; 2]));
        answer.impacts(&trace, listed, p);
        answer.peak(trace.peak_ratio, Some(peak));
        let Some(rest) = case.settling_time else { continue };
        let rest = Some(rest.wide);
        answer.compare("error-of-rest-time-p", trace.rest_s, rest, p);
    }
    Ok(())
}
