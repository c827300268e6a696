//! The work of a run is bounded, and may be stopped.

use crate::integrator::driver::{Driver, Flight, Stage};
use crate::integrator::forcing::Forcing;
use crate::integrator::motion::RunTrace;
use crate::integrator::{Response, SceneError, Work, WorkLimit};
use crate::number::Real;
use crate::stop;

impl<N: Real> RunTrace<N> {
    /// True once the work has passed the limit; keeps the first time at which
    /// that was noticed.
    #[inline(always)]
    pub fn exceeds(&mut self, limit: WorkLimit, time_s: N) -> bool {
        stop::point();
        let Work { impacts, steps, .. } = self.work;
        let points = self.history.len() as u64;
        let (what, limit) = if impacts > limit.impacts {
            ("impacts", limit.impacts)
        } else if steps > limit.steps {
            ("steps", limit.steps)
        } else if points > limit.steps {
            ("history points", limit.steps)
        } else {
            return false;
        };
        let time_s = time_s.to_f64();
        self.exceeded.get_or_insert(SceneError::Work { what, limit, time_s });
        true
    }
}

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// Why the run is refused at this stage, if it is.
    #[inline(always)]
    pub fn refusal(&mut self, stage: &Stage<N>) -> Option<SceneError> {
        stop::point();
        if let Stage::Flying(step) = stage {
            let Work { impacts, steps, .. } = self.record.work;
            let limit = self.observe.work_limit;
            if impacts > limit.impacts || steps > limit.steps {
                self.record.exceeds(limit, self.time_s(step.place));
            }
        }
        self.record.exceeded
    }

    /// The response after a flight, unless the work has passed the limit.
    #[inline(always)]
    pub fn within_limit(
        &mut self,
        flight: &Flight<N>,
    ) -> Result<Response<N>, SceneError> {
        let time_s = match flight {
            Flight::Rest(_, time_s) | Flight::Overturned { time_s, .. } => {
                *time_s
            }
            Flight::Stopped => self.until_s.unwrap_or(self.end_s()),
            _ => self.end_s(),
        };
        let response = self.conclude(flight);
        self.record.exceeds(self.observe.work_limit, time_s);
        self.record.exceeded.map_or(Ok(response), Err)
    }
}
