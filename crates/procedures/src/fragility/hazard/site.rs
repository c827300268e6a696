//! Sites of hazard curves.

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

/// A site in the file of a hazard curve.
///
/// ```
/// use rocking_procedures::fragility::hazard::Site;
/// assert_eq!("23.8,37.9".parse(), Ok(Site::Degrees(23.8, 37.9)));
/// assert_eq!("7zzzzzzz".parse(), Ok(Site::Id("7zzzzzzz".to_owned())));
/// assert!("23.8,north".parse::<Site>().is_err());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub enum Site {
    /// Longitude and latitude in degrees.
    Degrees(f64, f64),
    /// Its `custom_site_id`.
    Id(String),
}

/// A text that is not a site.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "found `{0}`: expected longitude,latitude in degrees, or the id of a site"
)]
pub struct SiteError(String);

impl FromStr for Site {
    type Err = SiteError;

    fn from_str(text: &str) -> Result<Self, SiteError> {
        let refused = || SiteError(text.to_owned());
        let degrees = |text: &str| {
            let degrees = text.trim().parse().ok();
            degrees.filter(|x: &f64| x.is_finite()).ok_or_else(refused)
        };
        match text.split_once(',') {
            Some((lon, lat)) => {
                Ok(Self::Degrees(degrees(lon)?, degrees(lat)?))
            }
            None if text.trim().is_empty() => Err(refused()),
            None => Ok(Self::Id(text.trim().to_owned())),
        }
    }
}

impl fmt::Display for Site {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Degrees(lon, lat) => write!(f, "{lon},{lat}"),
            Self::Id(id) => f.write_str(id),
        }
    }
}
