//! Flags that say what block, what restitution, what model: shared by the
//! commands that integrate.

use rocking::block::{Block, Restitution};
use rocking::integrator::{Model, Overturning};
use rocking::units::STANDARD_GRAVITY_M_S2;

use super::names;
use super::shared::positive;
use crate::failure::{Failure, bail};

/// The block, by its parameters or by its size.
#[derive(clap::Args, Clone, Debug)]
pub struct BlockArgs {
    /// Slenderness angle alpha in rad.
    #[arg(
        long,
        value_name = "A",
        requires = "p",
        conflicts_with_all = ["width_m", "height_m"]
    )]
    pub alpha: Option<f64>,
    /// Frequency parameter p in rad/s.
    #[arg(
        long,
        value_name = "P",
        conflicts_with_all = ["width_m", "height_m"]
    )]
    pub p: Option<f64>,
    /// Base width 2b in m.
    #[arg(long, value_name = "2B", requires = "height_m")]
    width_m: Option<f64>,
    /// Height 2h in m.
    #[arg(long, value_name = "2H", requires = "width_m")]
    height_m: Option<f64>,
}

impl BlockArgs {
    /// Whether any flag is given.
    pub fn is_given(&self) -> bool {
        let all = [self.alpha, self.p, self.width_m, self.height_m];
        all.iter().any(Option::is_some)
    }

    /// The block under gravity g (m/s2).
    ///
    /// # Errors
    /// [`Failure`] for parameters outside the range of a block.
    pub fn block(&self, gravity_m_s2: f64) -> Result<Block, Failure> {
        match (self.alpha, self.p, self.width_m, self.height_m) {
            (Some(alpha), Some(p), None, None) => {
                Ok(Block::try_new(alpha, p)?)
            }
            (None, None, Some(width_m), Some(height_m)) => {
                Ok(Block::from_dimensions(width_m, height_m, gravity_m_s2)?)
            }
            _ => {
                bail!("expected --alpha and --p, or --width-m and --height-m")
            }
        }
    }
}

/// The model, shared by all commands that integrate.
#[derive(clap::Args, Clone, Debug)]
pub struct ModelArgs {
    /// Coefficient of restitution (ratio of angular velocities), or
    /// `housner` for 1 - 1.5 sin^2(alpha).
    #[arg(long, value_name = "E|housner", default_value = "0.92")]
    pub eta: Eta,
    /// Equation of motion: Eq. 1 or Eq. 2.
    #[arg(long, value_parser = names::model(), default_value = "nonlinear")]
    pub model: Model,
    /// When the block counts as overturned.
    #[arg(long, value_parser = names::overturning(), default_value = "alpha")]
    pub overturn: Overturning,
    /// Gravity in m/s2, for sizes and for records in SI units.
    #[arg(
        long = "gravity",
        value_name = "G",
        value_parser = positive,
        default_value_t = STANDARD_GRAVITY_M_S2
    )]
    pub gravity_m_s2: f64,
}

/// Restitution as it is written on the command line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Eta {
    /// A constant.
    Constant(f64),
    /// Housner's, from the slenderness.
    Housner,
}

impl std::str::FromStr for Eta {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "housner" {
            return Ok(Self::Housner);
        }
        text.parse()
            .map(Self::Constant)
            .map_err(|_| "expected a number in (0, 1], or housner".to_owned())
    }
}

impl Eta {
    /// The coefficient of a block.
    ///
    /// # Errors
    /// [`Failure`] for a coefficient outside (0, 1].
    pub fn restitution(self, block: &Block) -> Result<Restitution, Failure> {
        Ok(match self {
            Self::Constant(eta) => Restitution::constant(eta)?,
            Self::Housner => Restitution::housner(block)?,
        })
    }
}
