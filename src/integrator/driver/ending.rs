//! From the end of a flight to the answer; histories.

use crate::integrator::coast::{Coast, CoastEnd, coast};
use crate::integrator::driver::{Driver, Flight};
use crate::integrator::dynamics::Overturning;
use crate::integrator::forcing::{Forcing, Moment};
use crate::integrator::taylor::{TaylorSeries, value};
use crate::integrator::{HistoryPoint, Outcome, Response, Side};
use crate::number::Real;

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// Time of the next point of a history, if there is one to record.
    fn next_sample_s(&self) -> Option<N> {
        let points = self.record.history.len() as f64;
        let interval_s = self.observe.history_interval_s?;
        Some(N::from_f64(points * interval_s))
    }

    /// Adds a point to a history.
    fn sample(&mut self, time_s: N, [rotation_rad, rate]: [N; 2]) {
        let velocity_rad_s = rate * self.dynamics.p;
        let point = HistoryPoint { time_s, rotation_rad, velocity_rad_s };
        self.record.history.push(point);
    }

    /// Adds zeros to a history up to a time.
    pub(super) fn sample_rest(&mut self, to_s: N) {
        while let Some(time_s) = self.next_sample_s()
            && time_s.to_f64() <= to_s.to_f64()
            && !self.record.exceeds(self.observe.work_limit, time_s)
        {
            self.sample(time_s, [N::zero(); 2]);
        }
    }

    /// Adds the points of a history that lie within `tau` of the start of a
    /// step of some length.
    #[inline(never)]
    pub(super) fn sample_step<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
        (tau, length): (N, N),
        place: Moment<N>,
        side: Side,
    ) {
        let start_s = self.time_s(place);
        let sign = N::from_f64(side.sign());
        while let Some(time_s) = self.next_sample_s() {
            let at = (time_s - start_s) * self.dynamics.p;
            let limit = self.observe.work_limit;
            if !(at <= tau) || self.record.exceeds(limit, time_s) {
                return;
            }
            let x = at.positive_part() / length;
            let motion = [value(&series.c, x), value(&series.v, x)];
            self.sample(time_s, motion.map(|x| sign * x));
        }
    }

    /// Adds the point of a history at the end of observation, which rounding
    /// may place beyond the last step.
    pub(super) fn sample_end(&mut self, until_s: N, motion: [N; 2]) {
        if let Some(time_s) = self.next_sample_s()
            && time_s <= until_s
        {
            self.sample(time_s, motion);
        }
    }

    /// The response, from the end of a flight.
    pub fn conclude(&mut self, flight: &Flight<N>) -> Response<N> {
        let end = match *flight {
            Flight::Rest(_, time_s) => {
                if self.record.work.impacts > 0 && self.observes(time_s) {
                    self.record.rest_time_s = Some(time_s);
                }
                self.sample_rest(self.until_s.unwrap_or(self.end_s()));
                CoastEnd::default()
            }
            Flight::Settled | Flight::Stopped | Flight::Doubtful => {
                CoastEnd::default()
            }
            Flight::Overturned { time_s, side, margin } => {
                CoastEnd::overturned(&mut self.record, time_s, side, margin)
            }
            Flight::End(motion) if self.cuts(motion) => {
                let flight = self.follow(motion);
                return self.conclude(&flight);
            }
            Flight::End(motion) => {
                let coasting = Coast {
                    dynamics: &self.dynamics,
                    start_s: self.end_s(),
                    observe: &self.observe,
                    until_s: self.until_s,
                };
                let before = self.record.peak;
                let end = coast(&coasting, motion, &mut self.record);
                self.screen_coast(before);
                if self.watched && self.record.exceeded.is_none() {
                    self.trace(motion);
                }
                end
            }
        };
        self.answer(&end)
    }

    fn answer(&mut self, end: &CoastEnd<N>) -> Response<N> {
        let alpha = self.dynamics.alpha;
        let record = &self.record;
        let moved = record.uplift_time_s.is_some()
            || record.peak > N::zero()
            || record.work.impacts > 0;
        let ratio = record.peak / alpha;
        let own = match self.dynamics.overturning {
            Overturning::Alpha => N::one() - ratio,
            Overturning::HalfPi => (N::right_angle() - record.peak) / alpha,
        };
        let outcome = match end.overturned {
            Some((time_s, side)) => Outcome::Overturned { time_s, side },
            None if moved => Outcome::Rocked { peak_ratio: ratio },
            None => Outcome::NoUplift,
        };
        let fate_margin = match end.margin {
            Some(beyond) if outcome.is_overturned() => beyond,
            Some(decision) => own.to_f64().min(decision),
            None => own.to_f64(),
        };
        let own = (!outcome.is_overturned()).then(|| own.to_f64());
        let doubt = self.screened(end.nearest, own);
        let record = &mut self.record;
        let accuracy = record.accuracy;
        let inputs = record.inputs.or(accuracy);
        let clear = accuracy.is_some_and(|a| a.certificate.is_clear());
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
            condition_number: accuracy.map(|a| a.peak_condition),
            certificate: accuracy.map(|a| a.certificate),
            input_certificate: inputs.map(|a| a.certificate),
            doubt,
            work: record.work,
            history: std::mem::take(&mut record.history),
            forces: record.forces,
        }
    }
}
