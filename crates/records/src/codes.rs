//! Enumerations with a short name for each variant.

/// Gives each variant the short name that is written behind it.
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
            /// Short name, the same in every version.
            pub fn code(&self) -> &'static str {
                match self {
                    $(Self::$variant { .. } => $code),+
                }
            }
        }
    };
}

pub(super) use coded;
