//! The answer of a tool to a case, and its errors.

use rocking::integrator::{
    Observe, Outcome, Response, SceneError, respond_precise,
};
use rocking::number::double::DoubleDouble;

use super::cases::{ETA, SpeedCase};
use super::rest::{GroundRecord, without_chatter};

/// Impacts whose times are compared.
pub const COMPARED: usize = 10;

/// A tool's answer.
#[derive(Clone, Debug, PartialEq)]
pub struct ToolAnswer {
    /// Peak |theta|/alpha; infinite when overturned, NaN without an answer.
    pub peak_ratio: f64,
    /// Impacts up to the record's end, those of series that end at rest
    /// counted once.
    pub impacts: usize,
    /// Times of the first of them, in s.
    pub first_impacts_s: Vec<f64>,
}

impl ToolAnswer {
    /// The answer in a response that was observed with events.
    pub fn of(case: &SpeedCase, response: &Response) -> Self {
        Self::rounded(case, response, |x| x)
    }

    /// The answer in double-double, rounded.
    ///
    /// # Errors
    /// As [`respond_precise`].
    pub fn reference(case: &SpeedCase) -> Result<Self, SceneError> {
        let observe = Observe { events: true, ..Observe::default() };
        let response =
            respond_precise::<DoubleDouble>(&case.scene(), &observe)?;
        Ok(Self::rounded(case, &response, DoubleDouble::hi))
    }

    fn rounded<N: Copy>(
        case: &SpeedCase,
        response: &Response<N>,
        double: fn(N) -> f64,
    ) -> Self {
        let peak_ratio = match response.outcome {
            Outcome::NoUplift => 0.0,
            Outcome::Rocked { peak_ratio } => double(peak_ratio),
            Outcome::Overturned { .. } => f64::INFINITY,
        };
        let seen = response.impacts.iter();
        let seen = seen
            .map(|i| (double(i.time_s), double(i.speed_before_rad_s)))
            .collect::<Vec<_>>();
        let samples_g = case.samples_g();
        let dt_s = case.record.dt_s();
        let ground = GroundRecord { samples_g: &samples_g, dt_s };
        let mut times =
            without_chatter(&case.analysis.block, ETA, &ground, &seen);
        let impacts = times.len();
        times.truncate(COMPARED);
        Self { peak_ratio, impacts, first_impacts_s: times }
    }

    /// Whether the block overturned; none without an answer.
    pub fn is_overturned(&self) -> Option<bool> {
        let peak = self.peak_ratio;
        (!peak.is_nan()).then_some(peak == f64::INFINITY)
    }

    /// Largest error of the times of the first impacts, in s; infinite if one
    /// is missing.
    pub fn impact_error_s(&self, reference: &Self) -> f64 {
        let (own, known) = (&self.first_impacts_s, &reference.first_impacts_s);
        if own.len() < known.len() {
            return f64::INFINITY;
        }
        let errors = own.iter().zip(known).map(|(a, b)| (a - b).abs());
        errors.fold(0.0, f64::max)
    }
}
