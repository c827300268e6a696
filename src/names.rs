//! Names of choices, as files, commands and messages spell them; upper and
//! lower case are the same.

use thiserror::Error;

/// A text that names none of the choices.
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
    /// What was to be named.
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

/// Gives each variant of an enumeration its name: in `ALL`, `name`,
/// `Display` and `FromStr`; and, by the feature `serde` of the calling crate,
/// in JSON.
#[macro_export]
macro_rules! named {
    ($enum:ident, $what:literal, {
        $($variant:ident = $name:literal),+ $(,)?
    }) => {
        impl $enum {
            /// All of them.
            pub const ALL: [Self; [$($name),+].len()] =
                [$(Self::$variant),+];

            /// The name.
            #[must_use]
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

/// Serialises a type as the text of its `Display`, which its `FromStr` reads,
/// by the feature `serde` of the calling crate.
#[macro_export]
macro_rules! as_text {
    ($type:ty) => {
        #[cfg(feature = "serde")]
        impl serde::Serialize for $type {
            fn serialize<S: serde::Serializer>(
                &self,
                serializer: S,
            ) -> Result<S::Ok, S::Error> {
                serializer.collect_str(self)
            }
        }

        #[cfg(feature = "serde")]
        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(
                deserializer: D,
            ) -> Result<Self, D::Error> {
                let text =
                    <String as serde::Deserialize>::deserialize(deserializer)?;
                text.parse().map_err(serde::de::Error::custom)
            }
        }
    };
}

pub use crate::{as_text, named};
