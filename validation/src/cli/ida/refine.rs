//! The value of `--refine`.

/// Bisection of the first overturning bracket.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Refine(Option<f64>);

impl std::str::FromStr for Refine {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "none" {
            return Ok(Self(None));
        }
        match text.parse() {
            Ok(width) if width > 0.0 && f64::is_finite(width) => {
                Ok(Self(Some(width)))
            }
            _ => Err("expected a positive number, or none".to_owned()),
        }
    }
}

impl Refine {
    /// The width, if any.
    #[must_use]
    pub fn width(self) -> Option<f64> {
        self.0
    }
}
