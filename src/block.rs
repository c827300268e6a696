//! The rigid block: geometry, slenderness, frequency parameter, restitution.
//!
//! The impact law is one number, eta. A further law changes [`Restitution`],
//! `Dynamics::new`, `Driver::impact`, the impacts of `coast` (`after_impact`,
//! `last`, `hops`), `trace`, `Accuracy::impact`, `Screen::land`,
//! `BarrierHop::safe`, and the lanes (`pool`: `group`, `batch`, `chatter`). It
//! needs the proofs P1 to P5, P7, P10 and P12 of the integrator anew.
//! `Once::Restitution` and `moved` make the condition number of eta; `trace`
//! and `hops` take eta < 1 for a motion that ends.

use thiserror::Error;

/// Why a block or a restitution was refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum BlockError {
    /// The slenderness angle must lie strictly between 0 and pi/2.
    #[error(
        "slenderness angle {0} rad: expected a number strictly between 0 and pi/2"
    )]
    Slenderness(f64),
    /// The frequency parameter must be positive and finite.
    #[error("frequency parameter {0} rad/s: expected a positive number")]
    Frequency(f64),
    /// Width and height must be positive and finite.
    #[error("block of {width_m} m by {height_m} m: expected positive lengths")]
    Dimensions {
        /// Base width 2b in m.
        width_m: f64,
        /// Height 2h in m.
        height_m: f64,
    },
    /// Gravity must be positive and finite.
    #[error("gravity {0} m/s2: expected a positive number")]
    Gravity(f64),
    /// Restitution must lie in (0, 1].
    #[error(
        "coefficient of restitution {0}: expected a number in (0, 1], the ratio of angular velocities"
    )]
    Restitution(f64),
}

/// A planar rigid block by its two governing parameters.
///
/// `slenderness_rad` is alpha = atan(b/h) in (0, pi/2); `frequency_rad_s` is
/// p = sqrt(3 g / (4 R)) > 0 for a rectangular block of half diagonal R.
///
/// ```
/// use rocking::block::Block;
/// let block = Block::try_new(0.2, 3.0)?;
/// let size = block.dimensions(9.81)?;
/// // Table 1 of the paper, p = 3, alpha = 0.20:
/// assert!((size.width_m - 0.325).abs() < 5e-4);
/// assert!((size.height_m - 1.602).abs() < 5e-4);
/// assert!((size.half_diagonal_m - 0.8175).abs() < 1e-12);
/// # Ok::<(), rocking::block::BlockError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Block {
    slenderness_rad: f64,
    frequency_rad_s: f64,
}

/// Lengths of a rectangular block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensions {
    /// Base width 2b in m.
    pub width_m: f64,
    /// Height 2h in m.
    pub height_m: f64,
    /// Half diagonal R in m.
    pub half_diagonal_m: f64,
}

impl Block {
    /// Block of slenderness angle alpha (rad) and frequency parameter p
    /// (rad/s).
    ///
    /// # Errors
    /// [`BlockError`] unless 0 < alpha < pi/2 and p is positive and finite.
    pub const fn try_new(
        slenderness_rad: f64,
        frequency_rad_s: f64,
    ) -> Result<Self, BlockError> {
        let right_angle = std::f64::consts::FRAC_PI_2;
        if !(slenderness_rad > 0.0 && slenderness_rad < right_angle) {
            return Err(BlockError::Slenderness(slenderness_rad));
        }
        if !(frequency_rad_s > 0.0 && frequency_rad_s.is_finite()) {
            return Err(BlockError::Frequency(frequency_rad_s));
        }
        Ok(Self { slenderness_rad, frequency_rad_s })
    }

    /// Rectangular block of base width 2b and height 2h (m) under gravity
    /// g (m/s2): alpha = atan(b/h), p = sqrt(3 g / (4 R)).
    ///
    /// # Errors
    /// [`BlockError`] unless all three are positive and finite.
    ///
    /// ```
    /// use rocking::block::Block;
    /// let block = Block::from_dimensions(1.469, 14.641, 9.81)?;
    /// assert!((block.slenderness_rad() - 0.10).abs() < 1e-4);
    /// assert!((block.frequency_rad_s() - 1.0).abs() < 1e-4);
    /// # Ok::<(), rocking::block::BlockError>(())
    /// ```
    pub fn from_dimensions(
        width_m: f64,
        height_m: f64,
        gravity_m_s2: f64,
    ) -> Result<Self, BlockError> {
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !(positive(width_m) && positive(height_m)) {
            return Err(BlockError::Dimensions { width_m, height_m });
        }
        if !positive(gravity_m_s2) {
            return Err(BlockError::Gravity(gravity_m_s2));
        }
        let half_diagonal_m = 0.5 * libm::hypot(width_m, height_m);
        Self::try_new(
            libm::atan2(width_m, height_m),
            (0.75 * gravity_m_s2 / half_diagonal_m).sqrt(),
        )
    }

    /// Slenderness angle alpha in rad.
    pub fn slenderness_rad(&self) -> f64 {
        self.slenderness_rad
    }

    /// Frequency parameter p in rad/s.
    pub fn frequency_rad_s(&self) -> f64 {
        self.frequency_rad_s
    }

    /// Lengths of the rectangular block that has these parameters under
    /// gravity g: R = 3 g / (4 p^2), 2b = 2 R sin(alpha),
    /// 2h = 2 R cos(alpha).
    ///
    /// # Errors
    /// [`BlockError::Gravity`] unless g is positive and finite.
    pub fn dimensions(
        &self,
        gravity_m_s2: f64,
    ) -> Result<Dimensions, BlockError> {
        if !(gravity_m_s2 > 0.0 && gravity_m_s2.is_finite()) {
            return Err(BlockError::Gravity(gravity_m_s2));
        }
        let p = self.frequency_rad_s;
        let half_diagonal_m = 0.75 * gravity_m_s2 / (p * p);
        Ok(Dimensions {
            width_m: 2.0 * half_diagonal_m * libm::sin(self.slenderness_rad),
            height_m: 2.0 * half_diagonal_m * libm::cos(self.slenderness_rad),
            half_diagonal_m,
        })
    }
}

/// Coefficient of restitution: ratio of angular velocities after and before
/// an impact (Eq. 3), in (0, 1].
///
/// Housner's r is a ratio of kinetic energies, the square of this number; use
/// [`Restitution::from_energy_ratio`] for it.
///
/// ```
/// use rocking::block::Restitution;
/// let eta = Restitution::constant(0.92)?;
/// // The paper: an energy loss of 15.36 % per impact.
/// assert!((1.0 - eta.energy_ratio() - 0.1536).abs() < 1e-12);
/// # Ok::<(), rocking::block::BlockError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Restitution(f64);

impl Restitution {
    /// Constant coefficient eta for any block.
    ///
    /// # Errors
    /// [`BlockError::Restitution`] unless 0 < eta <= 1.
    pub const fn constant(velocity_ratio: f64) -> Result<Self, BlockError> {
        if velocity_ratio > 0.0 && velocity_ratio <= 1.0 {
            Ok(Self(velocity_ratio))
        } else {
            Err(BlockError::Restitution(velocity_ratio))
        }
    }

    /// Housner's coefficient, eta = 1 - 3/2 sin^2(alpha), from conservation
    /// of angular momentum about the new pivot.
    ///
    /// # Errors
    /// [`BlockError::Restitution`] if alpha exceeds about 0.955 rad, because
    /// the formula is not positive there.
    ///
    /// ```
    /// use rocking::block::{Block, Restitution};
    /// let eta = Restitution::housner(&Block::try_new(0.25, 3.0)?)?;
    /// assert!((eta.velocity_ratio() - 0.908187).abs() < 1e-6);
    /// # Ok::<(), rocking::block::BlockError>(())
    /// ```
    pub fn housner(block: &Block) -> Result<Self, BlockError> {
        let sine = libm::sin(block.slenderness_rad);
        Self::constant(1.0 - 1.5 * sine * sine)
    }

    /// Coefficient from a ratio of kinetic energies r: eta = sqrt(r).
    ///
    /// # Errors
    /// [`BlockError::Restitution`] unless 0 < r <= 1.
    pub fn from_energy_ratio(energy_ratio: f64) -> Result<Self, BlockError> {
        if energy_ratio > 0.0 && energy_ratio <= 1.0 {
            Self::constant(energy_ratio.sqrt())
        } else {
            Err(BlockError::Restitution(energy_ratio))
        }
    }

    /// Ratio of angular velocities, eta.
    pub fn velocity_ratio(&self) -> f64 {
        self.0
    }

    /// Ratio of kinetic energies, eta squared.
    pub fn energy_ratio(&self) -> f64 {
        self.0 * self.0
    }
}
