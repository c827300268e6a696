//! Names of choices, as files, commands and messages spell them; upper and
//! lower case are the same.

use thiserror::Error;

/// A text that is not the name of a choice.
///
/// ```
/// use rocking::integrator::Model;
/// let error = "both".parse::<Model>().unwrap_err();
/// assert_eq!("Linearized".parse(), Ok(Model::Linearized));
/// let words = "model \"both\": expected one of nonlinear, linearized";
/// assert_eq!(error.to_string(), words);
/// ```
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{what} {found:?}: expected one of {}", expected.join(", "))]
pub struct UnknownName {
    /// Kind of choice.
    pub what: &'static str,
    /// The text.
    pub found: String,
    /// Names that are known.
    pub expected: Vec<&'static str>,
}

/// The value among `all` that has this name, in upper or lower case.
pub fn find<T: Copy>(
    what: &'static str,
    found: &str,
    all: &[T],
    name: fn(T) -> &'static str,
) -> Result<T, UnknownName> {
    let is_it = |value: &T| name(*value).eq_ignore_ascii_case(found);
    let named = all.iter().copied().find(is_it);
    named.ok_or_else(|| UnknownName {
        what,
        found: found.to_owned(),
        expected: all.iter().map(|value| name(*value)).collect(),
    })
}

/// An enumeration whose variants have names, in `ALL`, `name`, `Display`,
/// `FromStr` and, with the feature `serde`, in files; the text after the colon
/// says in messages what is named.
#[macro_export]
macro_rules! named {
    ($(#[$attribute:meta])+ $vis:vis enum $enum:ident: $what:literal {
        $($(#[$about:meta])+ $variant:ident = $name:literal),+ $(,)?
    }) => {
        $(#[$attribute])+
        #[derive(Clone, Copy, Debug, PartialEq, Eq)]
        $vis enum $enum {
            $($(#[$about])+ $variant),+
        }

        impl $enum {
            /// All of them.
            pub const ALL: [Self; [$($name),+].len()] =
                [$(Self::$variant),+];

            /// The name.
            pub const fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $name),+
                }
            }
        }

        impl std::fmt::Display for $enum {
            fn fmt(
                &self,
                f: &mut std::fmt::Formatter<'_>,
            ) -> std::fmt::Result {
                f.pad(self.name())
            }
        }

        impl std::str::FromStr for $enum {
            type Err = $crate::names::UnknownName;

            fn from_str(text: &str) -> Result<Self, Self::Err> {
                $crate::names::find($what, text, &Self::ALL, Self::name)
            }
        }

        $crate::names::as_text!($enum);
    };
}

/// Without the feature `serde`, types have only their text.
#[cfg(not(feature = "serde"))]
#[macro_export]
macro_rules! as_text {
    (write $type:ty) => {};
    ($type:ty) => {};
}

/// Serialises a type as the text of its `Display`, and reads it by its
/// `FromStr`; with `write` before the type, it only serialises.
#[cfg(feature = "serde")]
#[macro_export]
macro_rules! as_text {
    (write $type:ty) => {
        impl $crate::names::serde::Serialize for $type {
            fn serialize<S: $crate::names::serde::Serializer>(
                &self,
                serializer: S,
            ) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }
    };
    ($type:ty) => {
        $crate::names::as_text!(write $type);

        impl<'de> $crate::names::serde::Deserialize<'de> for $type {
            fn deserialize<D: $crate::names::serde::Deserializer<'de>>(
                deserializer: D,
            ) -> Result<Self, D::Error> {
                use $crate::names::serde::{Deserialize, de::Error};
                let text = <String as Deserialize>::deserialize(deserializer)?;
                text.parse().map_err(D::Error::custom)
            }
        }
    };
}

#[cfg(feature = "serde")]
#[doc(hidden)]
pub use serde;

pub use crate::{as_text, named};
