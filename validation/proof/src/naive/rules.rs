//! The rules of the naive integrator, and the mistakes it can make.

/// Largest step in units of 1/p of the right rules.
pub const STEP_P: f64 = 0.005;

/// How impacts and overturning are noticed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Events {
    /// Located inside the step, dips inside a step included.
    Located,
    /// By the sign at the ends of steps as long as a sample, the rotation
    /// set to zero there.
    StepEnds,
    /// By that sign, at the zero of the straight line through the ends.
    Interpolated,
    /// As `StepEnds`, but the rotation keeps its value.
    StepEndsRotationKept,
}

/// When rocking is declared to be over.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Rest {
    /// After an impact below the threshold, once the remaining chatter is
    /// shorter than rounding; its geometric tail is added.
    Chatter,
    /// After an impact slower than this share of p alpha, whatever the
    /// ground does.
    Slower(f64),
}

/// What an impact does to the speed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Loss {
    /// Restitution at every impact.
    Every,
    /// The first impact goes by without loss.
    FirstMissed,
}

/// What happens when the ground pushes back at the instant of an impact.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pushback {
    /// The pivot changes; a short hop follows.
    Hop,
    /// The block stays on its old side, with one loss.
    Suppressed,
}

/// Acceleration between samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Hold {
    /// Linear.
    Linear,
    /// Constant from each sample to the next.
    Zero,
}

/// Uplift threshold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Threshold {
    /// That of the equation.
    Own,
    /// That of the other equation: g alpha in Eq. 1, g tan(alpha) in Eq. 2.
    Other,
}

/// The rules of a naive run; the default is right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rules {
    /// How events are noticed.
    pub events: Events,
    /// When rocking is over.
    pub rest: Rest,
    /// Loss at impacts.
    pub loss: Loss,
    /// Ground pushing back at impact.
    pub pushback: Pushback,
    /// Acceleration between samples.
    pub hold: Hold,
    /// Uplift threshold.
    pub threshold: Threshold,
    /// Whether the motion goes on after the ground has stopped.
    pub after_end: bool,
    /// Largest step in units of 1/p; ten times that where impacts are not
    /// located.
    pub step_p: f64,
}

impl Default for Rules {
    fn default() -> Self {
        Self {
            events: Events::Located,
            rest: Rest::Chatter,
            loss: Loss::Every,
            pushback: Pushback::Hop,
            hold: Hold::Linear,
            threshold: Threshold::Own,
            after_end: true,
            step_p: STEP_P,
        }
    }
}
