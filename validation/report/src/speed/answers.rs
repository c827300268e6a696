//! What a tool answers to a case, and how wrong it is.

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

/// How far an answer is from the reference.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ToolError {
    /// Absolute error of peak |theta|/alpha; NaN where one overturned.
    pub peak: f64,
    /// Largest error of the times of the first impacts in s; infinite where
    /// one is missing.
    pub impact_s: f64,
    /// Whether it stands where it should.
    pub right_fate: bool,
    /// Whether it has as many impacts.
    pub same_impacts: bool,
}

impl ToolAnswer {
    /// The answer in a response that was observed with events.
    pub fn of(case: &SpeedCase, response: &Response) -> Self {
        let seen = response.impacts.iter();
        let all: Vec<(f64, f64)> =
            seen.map(|i| (i.time_s, i.speed_before_rad_s)).collect();
        Self::new(case, response.outcome.edp(), &all)
    }

    /// The answer in double-double, rounded.
    ///
    /// # Errors
    /// As [`respond_precise`].
    pub fn reference(case: &SpeedCase) -> Result<Self, SceneError> {
        let observe = Observe { events: true, ..Observe::default() };
        let response =
            respond_precise::<DoubleDouble>(&case.scene(), &observe)?;
        let peak_ratio = match response.outcome {
            Outcome::NoUplift => 0.0,
            Outcome::Rocked { peak_ratio } => peak_ratio.hi(),
            Outcome::Overturned { .. } => f64::INFINITY,
        };
        let seen = response.impacts.iter();
        let all: Vec<(f64, f64)> =
            seen.map(|i| (i.time_s.hi(), i.speed_before_rad_s.hi())).collect();
        Ok(Self::new(case, peak_ratio, &all))
    }

    fn new(case: &SpeedCase, peak_ratio: f64, all: &[(f64, f64)]) -> Self {
        let samples_g = case.samples_g();
        let dt_s = case.record.dt_s();
        let ground = GroundRecord { samples_g: &samples_g, dt_s };
        let mut times = without_chatter(&case.block, ETA, &ground, all);
        let impacts = times.len();
        times.truncate(COMPARED);
        Self { peak_ratio, impacts, first_impacts_s: times }
    }

    /// Its error against the reference.
    pub fn error(&self, reference: &Self) -> ToolError {
        let overturned = |a: &Self| a.peak_ratio == f64::INFINITY;
        let right_fate = !self.peak_ratio.is_nan()
            && overturned(self) == overturned(reference);
        let stands = right_fate && !overturned(self);
        let (own, true_s) =
            (&self.first_impacts_s, &reference.first_impacts_s);
        let apart = own.iter().zip(true_s).map(|(a, b)| (a - b).abs());
        let impact_s = if own.len() < true_s.len() {
            f64::INFINITY
        } else {
            apart.fold(0.0, f64::max)
        };
        ToolError {
            peak: if stands {
                (self.peak_ratio - reference.peak_ratio).abs()
            } else {
                f64::NAN
            },
            impact_s,
            right_fate,
            same_impacts: self.impacts == reference.impacts,
        }
    }
}
