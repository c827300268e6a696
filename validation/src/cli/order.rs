//! The flag that trades error for speed.

use clap::ValueEnum;
use rocking::integrator::{Model, Order};

use super::Failure;

/// An order of the Taylor polynomial.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum OrderName {
    /// A first look.
    #[value(name = "4")]
    Four,
    /// Exploring large numbers of analyses.
    #[value(name = "6")]
    Six,
    /// Statistics of many analyses.
    #[value(name = "8")]
    Eight,
    /// More accurate than most steps need.
    #[value(name = "10")]
    Ten,
}

impl OrderName {
    /// The order.
    ///
    /// # Errors
    /// [`Failure`] for Eq. 2, which has no choice of it.
    pub fn order(self, model: Model) -> Result<Order, Failure> {
        if model == Model::Linearized {
            return Err(Failure::input(
                "--order is for Eq. 1; --model linearized has no choice of it",
            ));
        }
        Ok(match self {
            Self::Four => Order::Four,
            Self::Six => Order::Six,
            Self::Eight => Order::Eight,
            Self::Ten => Order::Ten,
        })
    }

    /// Its name.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Four => "4",
            Self::Six => "6",
            Self::Eight => "8",
            Self::Ten => "10",
        }
    }
}
