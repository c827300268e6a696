//! What the kinds of arithmetic share.

use rocking::number::Real;
use rocking::number::double::DoubleDouble;

/// A number of any arithmetic to the last digit of a double-double; what goes
/// further is rounded.
///
/// ```
/// use rocking_proof::arithmetic::wide;
/// assert_eq!((wide(0.5).hi(), wide(0.5).lo()), (0.5, 0.0));
/// ```
pub fn wide<N: Real>(x: N) -> DoubleDouble {
    let hi = x.to_f64();
    DoubleDouble::sum(hi, (x - N::from_f64(hi)).to_f64())
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
