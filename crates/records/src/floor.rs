//! The motion of a floor, for objects in a building.
//!
//! The building is one linear mode: it stays elastic, and its higher modes are
//! neglected. A block that rocks on the floor does not affect it.

use std::f64::consts::TAU;

use thiserror::Error;

use crate::intensity::LEAST_PERIOD_S;
use crate::intensity::oscillator::Oscillator;
use rocking::accelerogram::{Accelerogram, AccelerogramError};

/// The longest period of a mode, in s.
const MOST_PERIOD_S: f64 = 20.0;

/// The smallest damping ratio of a mode: with less, free motion takes too
/// long.
const LEAST_DAMPING: f64 = 0.005;

/// The largest height ratio.
const MOST_HEIGHT_RATIO: f64 = 3.0;

/// Part of the largest acceleration of the floor at which free motion ends.
const LAST_PART: f64 = 1e-3;

/// The most steps of the mode, before and after the end of the record.
const MOST_STEPS: f64 = 1e7;

/// Why a floor or its motion is refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FloorError {
    /// Modes of buildings have periods of 0.001 to 20 s.
    #[error("period {0} s: expected a number from 0.001 to 20 s")]
    Period(f64),
    /// Free motion must end.
    #[error("damping ratio {0}: expected a number from 0.005 to below 1")]
    Damping(f64),
    /// Height ratios of first modes are from 0 to 1.6.
    #[error("height ratio {0}: expected a number from 0 to 3")]
    HeightRatio(f64),
    /// The samples are too many, or too far apart for the period.
    #[error("{0:.0} steps of the mode: expected at most 10 million")]
    Steps(f64),
    /// The accelerations are too large.
    #[error(transparent)]
    Record(#[from] AccelerogramError),
}

/// A floor of a building that moves in one linear mode.
///
/// | symbol | unit | range | is |
/// |---|---|---|---|
/// | T | s | 0.001 to 20 | period of the mode |
/// | zeta | 1 | 0.005 to below 1 | damping ratio of the mode |
/// | h | 1 | 0 to 3 | height ratio, Gamma phi(z) |
///
/// The height ratio is the participation factor Gamma of the mode times its
/// shape phi at the height z of the floor. It is 0 on the ground. For a
/// building with a straight mode and uniform mass it is 1.5 z/H below a roof
/// at the height H; for a uniform cantilever in bending it is 1.57 at the
/// roof. It is not a ratio of peak accelerations like H_f of ASCE 7-22 section
/// 13.3.1.1 (PFA over PGA).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Floor {
    period_s: f64,
    damping_ratio: f64,
    height_ratio: f64,
}

impl Floor {
    /// A floor by period T in s, damping ratio zeta and height ratio h of its
    /// mode.
    ///
    /// # Errors
    /// [`FloorError`] for T outside 0.001 to 20 s, zeta outside 0.005 to below
    /// 1, and h outside 0 to 3.
    pub fn try_new(
        period_s: f64,
        damping_ratio: f64,
        height_ratio: f64,
    ) -> Result<Self, FloorError> {
        if !(LEAST_PERIOD_S..=MOST_PERIOD_S).contains(&period_s) {
            return Err(FloorError::Period(period_s));
        }
        if !(LEAST_DAMPING..1.0).contains(&damping_ratio) {
            return Err(FloorError::Damping(damping_ratio));
        }
        if !(0.0..=MOST_HEIGHT_RATIO).contains(&height_ratio) {
            return Err(FloorError::HeightRatio(height_ratio));
        }
        Ok(Self { period_s, damping_ratio, height_ratio })
    }

    /// Absolute acceleration of the floor under a motion of the ground, at
    /// its sampling interval dt and under its name.
    ///
    /// The floor has a_f = a_g + h x'' in multiples of gravity, with the mode
    /// x'' + 2 zeta w x' + w^2 x = -a_g, w = 2 pi/T, which starts at rest. So
    /// h = 0 is the ground, and h = 1 the mass of an oscillator on it. A rigid
    /// building (T to 0) moves with the ground; the floor of a soft building
    /// (T to infinity) has (1 - h) a_g.
    ///
    /// The samples are exact for a ground that is linear between its samples.
    /// Like every accelerogram, the floor is linear between its own samples.
    /// The line differs from the motion by about (pi dt/T)^2/2 of the largest
    /// acceleration of the floor: 5 % if T is 10 dt, 0.2 % if T is 50 dt. A
    /// smaller dt of the ground gives a better floor.
    ///
    /// The motion continues after the record of the ground, and ends when the
    /// amplitude of the free motion is 1/1000 of the largest acceleration, so
    /// after at most ln(1000)/(2 pi zeta) periods: 22 at 5 % damping, 55 at 2
    /// %. A jump of the ground at its end is a ramp of one interval.
    ///
    /// Source: Chopra, Dynamics of Structures, chapter 13, modal response
    /// history, with one mode; Taghavi and Miranda (2005) for buildings with
    /// few known numbers.
    ///
    /// # Errors
    /// [`FloorError`] if the mode takes more than 10 million steps of at most
    /// T/20, or if an acceleration is not finite.
    ///
    /// ```
    /// use rocking_records::floor::Floor;
    /// use rocking::accelerogram::Accelerogram;
    /// let ground = Accelerogram::try_new("a", 0.01, vec![0.0, 0.2, 0.0])?;
    /// let rigid = Floor::try_new(0.001, 0.05, 1.4)?.motion(&ground)?;
    /// assert!((rigid.pga_g() - 0.2).abs() < 0.01);
    /// let soft = Floor::try_new(20.0, 0.05, 1.4)?.motion(&ground)?;
    /// assert!((soft.pga_g() - 0.08).abs() < 0.001);
    /// // The soft building sways on.
    /// assert!(soft.duration_s() > ground.duration_s());
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn motion(
        &self,
        ground: &Accelerogram,
    ) -> Result<Accelerogram, FloorError> {
        let (samples, dt_s) = (ground.samples_g(), ground.dt_s());
        let steps = (20.0 * dt_s / self.period_s).max(1.0);
        self.affordable(steps * samples.len() as f64)?;
        let mode = Oscillator::new(self.period_s, self.damping_ratio, dt_s);
        let h = self.height_ratio;
        let (moved, end) = mode.absolute([0.0; 2], samples);
        let pairs = moved.iter().zip(samples);
        let mut floor: Vec<f64> =
            pairs.map(|(mass, a)| h * mass + (1.0 - h) * a).collect();
        let free = h * mode.free_amplitude(end);
        let peak = floor.iter().fold(free, |peak, a| peak.max(a.abs()));
        let decay = TAU * self.damping_ratio * dt_s / self.period_s;
        let rest = libm::log(free / (LAST_PART * peak)) / decay;
        // If the comparison is false, or NaN, nothing moves.
        if rest > 0.0 {
            self.affordable(steps * rest)?;
            let still = vec![0.0; 1 + rest.ceil() as usize];
            let (moved, _) = mode.absolute(end, &still);
            floor.extend(moved.iter().skip(1).map(|mass| h * mass));
        }
        Ok(Accelerogram::try_new(ground.name(), dt_s, floor)?)
    }

    fn affordable(&self, steps: f64) -> Result<(), FloorError> {
        if steps <= MOST_STEPS {
            return Ok(());
        }
        Err(FloorError::Steps(steps))
    }
}

#[cfg(test)]
mod tests;
