//! From the end of a flight to the answer; histories.

use crate::integrator::coast::{Coast, coast};
use crate::integrator::driver::{Driver, Flight};
use crate::integrator::dynamics::Overturning;
use crate::integrator::forcing::{Forcing, Moment};
use crate::integrator::taylor::{TaylorSeries, value};
use crate::integrator::{HistoryPoint, Outcome, Response, Side};
use crate::number::Real;

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// Zeros of a history up to a time.
    pub(super) fn sample_rest(&mut self, to_s: N) {
        let Some(interval) = self.interval_s else { return };
        let mut time_s = self.record.history.len() as f64 * interval;
        while time_s <= to_s.to_f64() {
            if self.record.exceeds(self.limit, N::from_f64(time_s)) {
                return;
            }
            self.record.history.push(HistoryPoint {
                time_s: N::from_f64(time_s),
                rotation_rad: N::zero(),
                velocity_rad_s: N::zero(),
            });
            time_s = self.record.history.len() as f64 * interval;
        }
    }

    /// Points of a history within the time `tau` of a step of some length.
    #[inline(never)]
    pub(super) fn sample_step<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
        (tau, length): (N, N),
        place: Moment<N>,
        side: Side,
    ) {
        let Some(interval) = self.interval_s else { return };
        let start_s = self.time_s(place);
        let p = self.dynamics.p;
        let sign = N::from_f64(side.sign());
        loop {
            let time_s = self.record.history.len() as f64 * interval;
            let time_s = N::from_f64(time_s);
            let at = (time_s - start_s) * p;
            if !(at <= tau) || self.record.exceeds(self.limit, time_s) {
                return;
            }
            let x = at.positive_part() / length;
            self.record.history.push(HistoryPoint {
                time_s,
                rotation_rad: sign * value(&series.c, x),
                velocity_rad_s: sign * (value(&series.v, x) * p),
            });
        }
    }

    /// From the end of a flight to the answer.
    pub fn conclude(&mut self, flight: &Flight<N>) -> Response<N> {
        let mut margin = None;
        let mut overturned = None;
        // Margin of what was decided at the end of the last flight.
        let mut decided = None;
        match *flight {
            Flight::Rest(_, time_s) => {
                if self.record.work.impacts > 0 && self.observes(time_s) {
                    self.record.rest_time_s = Some(time_s);
                }
                let end = self.until_s.unwrap_or(self.end_s());
                self.sample_rest(end);
            }
            Flight::Settled | Flight::Stopped | Flight::Doubtful => {}
            Flight::Overturned { time_s, side, margin: beyond } => {
                margin = Some(beyond);
                overturned = Some((time_s, side));
                decided = Some(beyond);
                for tracker in self.record.trackers() {
                    tracker.overturned();
                }
            }
            Flight::End(motion) if self.cuts(motion) => {
                let flight = self.follow(motion);
                return self.conclude(&flight);
            }
            Flight::End(motion) => {
                let end_s = self.end_s();
                let coasting = Coast {
                    dynamics: &self.dynamics,
                    start_s: end_s,
                    events: self.events,
                    until_s: self.until_s,
                    limit: self.limit,
                };
                let before = self.record.peak;
                let fate = coast(&coasting, motion, &mut self.record);
                self.screen_coast(before);
                margin = fate.margin;
                overturned = fate.overturned;
                decided = Some(fate.nearest);
                if self.watched && self.record.exceeded.is_none() {
                    self.trace(motion);
                }
            }
        }
        self.answer(overturned, margin, decided)
    }

    pub(super) fn answer(
        &mut self,
        overturned: Option<(N, Side)>,
        margin: Option<f64>,
        decided: Option<f64>,
    ) -> Response<N> {
        let alpha = self.dynamics.alpha;
        let record = &mut self.record;
        let moved = record.uplift_time_s.is_some()
            || record.peak > N::zero()
            || record.work.impacts > 0;
        let ratio = record.peak / alpha;
        let own = match self.dynamics.overturning {
            Overturning::Alpha => N::one() - ratio,
            Overturning::HalfPi => (N::right_angle() - record.peak) / alpha,
        };
        let outcome = match overturned {
            Some((time_s, side)) => Outcome::Overturned { time_s, side },
            None if moved => Outcome::Rocked { peak_ratio: ratio },
            None => Outcome::NoUplift,
        };
        let fate_margin = match margin {
            Some(beyond) if outcome.is_overturned() => beyond,
            Some(decision) => own.to_f64().min(decision),
            None => own.to_f64(),
        };
        let own = match outcome {
            Outcome::Overturned { .. } => None,
            Outcome::Rocked { .. } | Outcome::NoUplift => Some(own.to_f64()),
        };
        let doubt = self.screened(decided, own);
        let record = &mut self.record;
        let accuracy = record.accuracy;
        let inputs = record.inputs.or(accuracy);
        let clear = accuracy.is_some_and(|a| a.certificate().is_clear());
        let known = |error: Option<f64>| error.filter(|_| clear);
        Response {
            outcome,
            peak_ratio: ratio,
            peak_time_s: record.peak_time_s,
            uplift_time_s: record.uplift_time_s,
            rest_time_s: record.rest_time_s,
            impacts: std::mem::take(&mut record.impacts),
            fate_margin,
            error_estimate: accuracy.and_then(|a| a.peak_error()),
            rest_error_s: known(record.rest_error_s),
            overturning_error_s: known(record.overturning_error_s),
            condition_number: accuracy.map(|a| a.peak_condition()),
            certificate: accuracy.map(|a| a.certificate()),
            input_certificate: inputs.map(|a| a.certificate()),
            doubt,
            work: record.work,
            history: std::mem::take(&mut record.history),
            forces: record.forces,
        }
    }
}
