//! The end of observation near an overturning or an uplift, and pulses that
//! rise to the uplift threshold, against times and outcomes of 40 digits.

use std::collections::BTreeMap;

use anyhow::{Result, bail};
use rocking::integrator::{Assessment, Certify, Observe, Outcome, certify};
use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real as _};

use super::cells::{Csv, CsvRow};
use super::method::{Context, Reply};
use crate::engine::{Quotient, on_core, respond};
use crate::scene::{CaseScene, Forcing, by_criterion};
use crate::trials::{CertificateReading, DoubleRun, moved};

const ENDS: Csv = Csv::new("oracles/ends.csv");

/// Relative error of a peak that is right to all digits of a double.
const PRINTED: f64 = 0.5 * f64::EPSILON;

/// The scenes of a kind, each with three known numbers.
fn scenes(kind: &str) -> Result<Vec<(CaseScene, [DoubleDouble; 3])>> {
    let of = |row: CsvRow| {
        let given = row.list(10, ';')?;
        let forcing = match (row.text(7), given.as_slice()) {
            ("record", [dt_s, samples @ ..]) => {
                Forcing::samples(*dt_s, samples.to_vec())
            }
            (pulse, [amplitude, scale]) => {
                Forcing::pulse(pulse.parse()?, *amplitude, *scale)
            }
            (other, _) => bail!(ENDS.lacks(other)),
        };
        let [alpha, p, eta, gravity] = row.numbers(3)?;
        let scene = CaseScene::new([alpha, p, gravity], eta, forcing)
            .in_equation(row.text(1).parse()?)
            .to(row.text(2).parse()?);
        let known = <[DoubleDouble; 3]>::try_from(row.decimals(9)?);
        Ok((scene, known.map_err(|_| ENDS.lacks("three values"))?))
    };
    ENDS.rows(kind)?.into_iter().map(of).collect()
}

/// The truth about a run.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Due {
    Overturned,
    NoUplift,
    /// The largest |theta|/alpha, if it is known.
    Rocked(Option<DoubleDouble>),
}

impl Due {
    /// True if an outcome agrees, with its peak within a bound and the
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

/// Counts of runs by name.
#[derive(Default)]
struct Counts(BTreeMap<&'static str, f64>);

impl Counts {
    /// Counts a scene; `one_fate` is true if all inputs that round to the same
    /// doubles surely have the same outcome.
    fn take(
        &mut self,
        scene: &CaseScene,
        (due, one_fate): (Due, bool),
        reading: CertificateReading,
    ) -> Result<()> {
        let until_s = scene.until_s;
        let observe = Observe { accuracy: true, ..Observe::default() };
        let response = respond(scene, &observe)?;
        let seen = DoubleRun::of(&response);
        let clear = reading.is_clear(&seen);
        // A wrong reading can call a run clear that has no bound.
        let bounded = response.assessment() == Assessment::Clear;
        let error =
            if bounded { reading.estimate(&seen) } else { f64::INFINITY };
        let right = due.is(&response.outcome, error);
        let fate = on_core(scene, Quotient::Kept, |scene| {
            certify(scene, &Certify { until_s, ..Certify::default() })
        })?;
        let bound = fate.error.unwrap_or(f64::INFINITY);
        let certified = due.is(&fate.outcome, bound);
        let surely = fate.resolved && fate.resolved_for_inputs;
        for (name, is) in [
            ("runs", true),
            ("unresolved-share", !clear),
            ("wrong-and-clear", clear && !right),
            ("wrong-and-unresolved", !clear && !right),
            ("certified-open", !fate.resolved),
            ("certified-wrong", fate.resolved && !certified),
            // Inputs that round to the same doubles differ in outcome.
            ("wrong-for-all-inputs", surely && !one_fate),
        ] {
            *self.0.entry(name).or_default() += f64::from(is);
        }
        Ok(())
    }

    fn put(self, answer: &mut Reply) {
        let runs = self.0["runs"];
        for (name, count) in self.0 {
            let share = name == "unresolved-share";
            answer.see(name, [if share { count / runs } else { count }]);
        }
        for never in
            ["wrong-and-clear", "certified-wrong", "wrong-for-all-inputs"]
        {
            answer.put(never, [], [0.0]);
        }
    }
}

/// Overturning and uplift before and after the end, and the peak.
pub fn ends(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Units in the last place between the double next to an event and the
        /// end, to either side.
        ulps: Vec<i64>,
    }
    let reading = CertificateReading(context.wrong);
    let mut counts = Counts::default();
    for (mut scene, [lifted_s, over_s, rate]) in scenes("end")? {
        let alpha = DoubleDouble::from_f64(scene.slenderness_rad);
        let right_angle = DoubleDouble::right_angle() / alpha;
        let limit =
            by_criterion(scene.overturning, DoubleDouble::one(), right_angle);
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
                // Within half a unit the end itself has two outcomes.
                let unit = moved(until_s, 1) - until_s;
                let one_fate = left_s.abs().to_f64() > 0.5 * unit;
                scene.until_s = Some(until_s);
                counts.take(&scene, (due, one_fate), reading)?;
            }
        }
    }
    counts.put(answer);
    Ok(())
}

/// Pulses whose peak is some units in the last place from the threshold.
pub fn touches(context: &Context, answer: &mut Reply) -> Result<()> {
    let reading = CertificateReading(context.wrong);
    let mut counts = Counts::default();
    for (scene, [lifts, peak, one_fate]) in scenes("touch")? {
        let is = |x: DoubleDouble| x > DoubleDouble::zero();
        let rocked = Due::Rocked(Some(peak));
        let due = if is(lifts) { rocked } else { Due::NoUplift };
        counts.take(&scene, (due, is(one_fate)), reading)?;
    }
    counts.put(answer);
    Ok(())
}
