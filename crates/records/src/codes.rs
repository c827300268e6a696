//! Enumerations whose variants have a short name for programs.

/// Gives each variant its short name, written behind it.
macro_rules! coded {
    ($(#[$meta:meta])+ pub enum $enum:ident {
        $(
            $(#[$about:meta])+
            $variant:ident $(($($of:tt)*))? $({$($fields:tt)*})? =
                $code:literal
        ),+ $(,)?
    }) => {
        $(#[$meta])+
        pub enum $enum {
            $(
                $(#[$about])+
                $variant $(($($of)*))? $({$($fields)*})?
            ),+
        }

        impl $enum {
            /// Short name of the reason, the same in every version.
            #[must_use]
            pub fn code(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $code),+
                }
            }
        }
    };
}

pub(super) use coded;
