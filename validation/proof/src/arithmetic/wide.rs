//! What the kinds of arithmetic share.

use rocking::number::double::DoubleDouble;
use rocking::number::octuple::Octuple;
use rocking::number::{Number as _, Real};

/// Arithmetic whose numbers a double-double holds, or nearly so.
pub trait Wide: Real {
    /// The number, to the last digit of a double-double.
    fn wide(self) -> DoubleDouble;
}

impl Wide for f64 {
    fn wide(self) -> DoubleDouble {
        DoubleDouble::from_f64(self)
    }
}

impl Wide for DoubleDouble {
    fn wide(self) -> DoubleDouble {
        self
    }
}

impl Wide for Octuple {
    /// Rounded: its own digits go further.
    fn wide(self) -> DoubleDouble {
        let hi = self.to_f64();
        let rest = self - Self::from_f64(hi);
        DoubleDouble::sum(hi, rest.to_f64())
    }
}

/// Forwards the four operations and the sign to the number inside.
macro_rules! forward {
    ($type:ident: $($trait:ident $name:ident),+) => {
        $(impl std::ops::$trait for $type {
            type Output = Self;
            fn $name(self, other: Self) -> Self {
                Self(std::ops::$trait::$name(self.0, other.0))
            }
        })+
        impl std::ops::Neg for $type {
            type Output = Self;
            fn neg(self) -> Self {
                Self(-self.0)
            }
        }
    };
}
pub(super) use forward;

/// Functions of the number inside.
macro_rules! functions {
    ($($name:ident $function:path),+) => {
        $(fn $name(self) -> Self {
            Self($function(self.0))
        })+
    };
}
pub(super) use functions;
