//! The end of observation about an overturning or an uplift, and pulses that
//! rise to the uplift threshold, against times and fates of 40 digits.

use rocking::integrator::{Assessment, Certified, Observe, Outcome, Response};
use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real as _};

use super::method::{Answer, Context, MethodError};
use crate::arithmetic::decimal;
use crate::engine::{certify, respond};
use crate::scene::{Forcing, Overturning, PulseKind, Scene};
use crate::trials::{Reading, Seen};

const ENDS: &str = include_str!("../../../../fixtures/oracles/ends.csv");

/// A row of the file: a scene and what is known of it.
struct Row {
    scene: Scene,
    values: Vec<DoubleDouble>,
}

/// Relative error of a peak that is right to all digits of a double.
const PRINTED: f64 = 0.5 * f64::EPSILON;

fn missing(what: &str) -> MethodError {
    let what = what.to_owned();
    MethodError::Reference { file: "fixtures/oracles/ends.csv", what }
}

/// The rows of a kind.
fn rows(kind: &str) -> Result<Vec<Row>, MethodError> {
    let lines =
        ENDS.lines().filter(|line| line.split(',').next() == Some(kind));
    lines.map(|line| row(line).ok_or_else(|| missing(line))?).collect()
}

fn row(line: &str) -> Option<Result<Row, MethodError>> {
    let cells: Vec<&str> = line.split(',').collect();
    let [_, law, criterion, alpha, p, eta, g, shape, _, values, given] =
        cells[..]
    else {
        return None;
    };
    let number = |text: &str| text.parse::<f64>().ok();
    let given = given.split(';').map(number).collect::<Option<Vec<_>>>()?;
    let (first, rest) = given.split_first()?;
    let amplitude = *first;
    let forcing = match (shape, rest) {
        ("record", samples) => Forcing::Samples {
            dt_s: *first,
            acceleration_m_s2: samples.to_vec(),
        },
        ("rectangle", [duration_s]) => {
            let duration_s = *duration_s;
            Forcing::Pulse(PulseKind::Rectangle { amplitude, duration_s })
        }
        ("triangle", [duration_s]) => {
            let duration_s = *duration_s;
            Forcing::Pulse(PulseKind::Triangle { amplitude, duration_s })
        }
        ("one-sine", [omega_rad_s]) => {
            let omega_rad_s = *omega_rad_s;
            Forcing::Pulse(PulseKind::OneSine { amplitude, omega_rad_s })
        }
        _ => return None,
    };
    let overturning = criterion.parse().ok()?;
    let block = [number(alpha)?, number(p)?, number(g)?];
    let scene = Scene::new(block, number(eta)?, forcing);
    let values = values.split(';').map(decimal).collect::<Option<Vec<_>>>()?;
    Some(law.parse().map_err(MethodError::Name).map(|model| Row {
        scene: Scene { model, overturning, ..scene },
        values,
    }))
}

/// What is true of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Due {
    Overturned,
    NoUplift,
    /// The largest |theta|/alpha, where it is known.
    Rocked(Option<DoubleDouble>),
}

impl Due {
    /// True where an outcome is that, and its peak within a bound but for the
    /// rounding to a double.
    fn is(self, outcome: &Outcome, error: f64) -> bool {
        match (self, outcome) {
            (Self::Overturned, Outcome::Overturned { .. })
            | (Self::NoUplift, Outcome::NoUplift)
            | (Self::Rocked(None), Outcome::Rocked { .. }) => true,
            (Self::Rocked(Some(due)), Outcome::Rocked { peak_ratio }) => {
                let found = DoubleDouble::from_f64(*peak_ratio);
                let error = error + PRINTED * due.to_f64();
                (found - due).abs().to_f64() <= error
            }
            _ => false,
        }
    }
}

/// Runs counted.
#[derive(Default)]
struct Counts {
    runs: usize,
    unresolved: usize,
    wrong_and_clear: usize,
    wrong_and_unresolved: usize,
    certified_wrong: usize,
    certified_open: usize,
    /// Resolved for all inputs that round to the same doubles, which have more
    /// than one fate.
    wrong_for_inputs: usize,
}

impl Counts {
    /// Takes in a scene; `one_fate` where all inputs that round to the same
    /// doubles surely have one.
    fn take(
        &mut self,
        scene: &Scene,
        (due, one_fate): (Due, bool),
        reading: Reading,
    ) -> Result<(), MethodError> {
        let until_s = scene.until_s;
        let observe =
            Observe { accuracy: true, until_s, ..Observe::default() };
        let response: Response = respond(scene, &observe)?;
        let seen = Seen::of(&response, response.peak_ratio);
        let clear = reading.is_clear(&seen);
        let error = match response.assessment() {
            Assessment::Clear => reading.estimate(&seen),
            // The reading takes the run for clear, and has no bound.
            _ => f64::INFINITY,
        };
        let right = due.is(&response.outcome, error);
        self.runs += 1;
        self.unresolved += usize::from(!clear);
        self.wrong_and_clear += usize::from(clear && !right);
        self.wrong_and_unresolved += usize::from(!clear && !right);
        let fate: Certified = certify(scene)?;
        let error = fate.error.unwrap_or(f64::INFINITY);
        self.certified_open += usize::from(!fate.resolved);
        self.certified_wrong +=
            usize::from(fate.resolved && !due.is(&fate.outcome, error));
        self.wrong_for_inputs += usize::from(
            fate.resolved && fate.resolved_for_inputs && !one_fate,
        );
        Ok(())
    }

    fn answer(&self) -> Answer {
        let mut answer = Answer::default();
        for (name, count) in [
            ("wrong-and-clear", self.wrong_and_clear),
            ("certified-wrong", self.certified_wrong),
            ("wrong-for-all-inputs", self.wrong_for_inputs),
        ] {
            answer.put(name, [count as f64], [0.0]);
        }
        for (name, value) in [
            ("runs", self.runs as f64),
            ("unresolved-share", self.unresolved as f64 / self.runs as f64),
            ("wrong-and-unresolved", self.wrong_and_unresolved as f64),
            ("certified-open", self.certified_open as f64),
        ] {
            answer.see(name, [value]);
        }
        answer
    }
}

/// A number moved by units in the last place.
fn moved(x: f64, ulps: i64) -> f64 {
    f64::from_bits(x.to_bits().wrapping_add_signed(ulps))
}

/// Overturned before the end or not, lifted before it or not, and how far.
pub(super) fn ends(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        /// Units in the last place between the double next to an event and the
        /// end, to either side.
        ulps: Vec<i64>,
    }
    let reading = Reading::of(context.wrong);
    let mut counts = Counts::default();
    for Row { mut scene, values } in rows("end")? {
        let [lifted_s, over_s, rate] = values[..] else {
            return Err(missing("three values of an end"));
        };
        let alpha = DoubleDouble::from_f64(scene.slenderness_rad);
        let limit = match scene.overturning {
            Overturning::Alpha => DoubleDouble::one(),
            Overturning::HalfPi => DoubleDouble::right_angle() / alpha,
        };
        for ulps in ulps.iter().flat_map(|k| [-k, *k]) {
            for event_s in [lifted_s, over_s] {
                let until_s = moved(event_s.to_f64(), ulps);
                let left_s = event_s - DoubleDouble::from_f64(until_s);
                let is_before = left_s < DoubleDouble::zero();
                let due = match (event_s == over_s, is_before) {
                    (true, true) => Due::Overturned,
                    (true, false) => Due::Rocked(Some(limit - rate * left_s)),
                    (false, true) => Due::Rocked(None),
                    (false, false) => Due::NoUplift,
                };
                // Within half a unit the end itself has two fates.
                let unit = moved(until_s, 1) - until_s;
                let one_fate = left_s.abs().to_f64() > 0.5 * unit;
                scene.until_s = Some(until_s);
                counts.take(&scene, (due, one_fate), reading)?;
            }
        }
    }
    Ok(counts.answer())
}

/// Pulses whose peak is some units in the last place from the threshold.
pub(super) fn touches(context: &Context) -> Result<Answer, MethodError> {
    let reading = Reading::of(context.wrong);
    let mut counts = Counts::default();
    for Row { scene, values } in rows("touch")? {
        let [lifts, peak, one_fate] = values[..] else {
            return Err(missing("three values of a touch"));
        };
        let is = |x: DoubleDouble| x > DoubleDouble::zero();
        let due =
            if is(lifts) { Due::Rocked(Some(peak)) } else { Due::NoUplift };
        counts.take(&scene, (due, is(one_fate)), reading)?;
    }
    Ok(counts.answer())
}
