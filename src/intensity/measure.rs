//! Intensity measures by name, their units, and their values for a record.

use crate::record::result_name;
use std::fmt;
use std::str::FromStr;

use libm::{exp, log};

use super::Measures;
use crate::names::{UnknownName, as_text, named};

/// Dimensionless intensity measure: the axis of an IDA curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Intensity {
    /// PGA/(g tan alpha).
    Pga,
    /// p PGV/(g tan alpha).
    Pgv,
}

named!(Intensity, "intensity", { Pga = "pga", Pgv = "pgv" });

impl Intensity {
    /// The measure as the paper writes it.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Pga => "PGA/(g tan alpha)",
            Self::Pgv => "p PGV/(g tan alpha)",
        }
    }

    /// The PGA (g) of a motion at this intensity of `im`, for a block of
    /// uplift threshold `threshold` (over g) and frequency parameter
    /// `p_rad_s`; PGV/(g PGA) of the motion is `velocity_ratio_s`.
    ///
    /// ```
    /// use rocking::intensity::Intensity;
    /// let pga_g = Intensity::Pgv.pga_g(2.0, 0.1, 3.0, 0.2);
    /// // p PGV/(g tan alpha)
    /// assert!((3.0 * 0.2 * pga_g / 0.1 - 2.0).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn pga_g(
        self,
        im: f64,
        threshold: f64,
        p_rad_s: f64,
        velocity_ratio_s: f64,
    ) -> f64 {
        match self {
            Self::Pga => im * threshold,
            Self::Pgv => im * threshold / (p_rad_s * velocity_ratio_s),
        }
    }
}

/// An intensity measure of a record: its name is `pga`, `pgv`, `pgd`,
/// `arias`, `cav`, `pgv-d575`, `sa:T`, `avgsa:T1,T2,..` with periods in s, or
/// `column:NAME`.
///
/// ```
/// use rocking::intensity::{IntensityMeasure, Measures, Settings};
/// use rocking::record::Accelerogram;
/// let record = Accelerogram::try_new("step", 0.5, vec![0.1; 5])?;
/// let periods_s = [1.0, 4.0];
/// let settings = Settings::try_new(9.81, 0.05, periods_s.to_vec())?;
/// let measures = Measures::of(&record, &settings)?;
/// let measure: IntensityMeasure = "avgsa:1,4".parse()?;
/// let [one, four] = measures.spectral_acceleration_g[..] else { panic!() };
/// let value = measure.value(&measures, &periods_s).expect("both periods");
/// assert!((value * value / (one * four) - 1.0).abs() < 1e-15);
/// assert_eq!(measure.unit(), "g");
/// assert_eq!(measure.to_string(), "avgsa:1,4");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntensityMeasure {
    /// Peak ground acceleration.
    Pga,
    /// Peak ground velocity.
    Pgv,
    /// Peak ground displacement.
    Pgd,
    /// Arias intensity.
    Arias,
    /// Cumulative absolute velocity.
    Cav,
    /// PGV times the fourth root of the duration D5-75, after the measure of
    /// Fajfar, Vidic and Fischinger (1990, Earthquake Engineering and
    /// Structural Dynamics 19).
    PgvDuration,
    /// Spectral acceleration at a period in s, 5 % damping.
    Sa(f64),
    /// Geometric mean of spectral accelerations at periods in s.
    AverageSa(Vec<f64>),
    /// A column of a suite's index, or another attribute of its records.
    Column(String),
}

/// The measures whose name is a word.
static WORDS: [(&str, IntensityMeasure); 6] = [
    (Intensity::Pga.name(), IntensityMeasure::Pga),
    (Intensity::Pgv.name(), IntensityMeasure::Pgv),
    ("pgd", IntensityMeasure::Pgd),
    ("arias", IntensityMeasure::Arias),
    ("cav", IntensityMeasure::Cav),
    ("pgv-d575", IntensityMeasure::PgvDuration),
];

impl FromStr for IntensityMeasure {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let period = |text: &str| {
            let period = text.trim().parse::<f64>().ok();
            period.filter(|t| *t > 0.0 && t.is_finite())
        };
        let found = match text.split_once(':') {
            Some(("sa", t)) => period(t).map(Self::Sa),
            Some(("avgsa", list)) => {
                let periods: Option<_> = list.split(',').map(period).collect();
                periods.map(Self::AverageSa)
            }
            Some(("column", name))
                if !name.is_empty() && result_name(name).is_ok() =>
            {
                Some(Self::Column(name.to_owned()))
            }
            _ => {
                let named = WORDS.iter().find(|(name, _)| *name == text);
                named.map(|(_, measure)| measure.clone())
            }
        };
        found.ok_or_else(|| UnknownName {
            what: "intensity measure",
            found: text.to_owned(),
            expected: WORDS
                .iter()
                .map(|(name, _)| *name)
                .chain(["sa:T", "avgsa:T1,T2,.. (periods in s)"])
                .chain(["column:NAME"])
                .collect(),
        })
    }
}

impl fmt::Display for IntensityMeasure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Sa(period_s) => write!(f, "sa:{period_s}"),
            Self::AverageSa(periods_s) => {
                write!(f, "avgsa:{}", listed(periods_s, ","))
            }
            Self::Column(name) => write!(f, "column:{name}"),
            word => {
                let own = WORDS.iter().find(|(_, measure)| measure == word);
                f.pad(own.map_or("", |(name, _)| name))
            }
        }
    }
}

as_text!(IntensityMeasure);

fn listed(periods_s: &[f64], separator: &str) -> String {
    let texts: Vec<String> = periods_s.iter().map(f64::to_string).collect();
    texts.join(separator)
}

impl IntensityMeasure {
    /// Unit of its [`value`](Self::value); empty for a column.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Pga | Self::Sa(_) | Self::AverageSa(_) => "g",
            Self::Pgv | Self::Arias | Self::Cav => "m/s",
            Self::Pgd => "m",
            Self::PgvDuration => "m s^(-3/4)",
            Self::Column(_) => "",
        }
    }

    /// The dimensionless measure, where it is the axis of an IDA curve.
    #[must_use]
    pub fn dimensionless(&self) -> Option<Intensity> {
        match self {
            Self::Pga => Some(Intensity::Pga),
            Self::Pgv => Some(Intensity::Pgv),
            _ => None,
        }
    }

    /// The measure in words with its unit; PGA and PGV are dimensionless, as
    /// of an IDA curve.
    #[must_use]
    pub fn words(&self) -> String {
        let symbol = match self {
            Self::Pga => return Intensity::Pga.words().to_owned(),
            Self::Pgv => return Intensity::Pgv.words().to_owned(),
            Self::Column(name) => return format!("column {name}"),
            Self::Pgd => "PGD".to_owned(),
            Self::Arias => "Arias intensity".to_owned(),
            Self::Cav => "CAV".to_owned(),
            Self::PgvDuration => "PGV D5-75^(1/4)".to_owned(),
            Self::Sa(period_s) => format!("SA({period_s} s)"),
            Self::AverageSa(list) => {
                format!("AvgSA({} s)", listed(list, ", "))
            }
        };
        format!("{symbol} ({})", self.unit())
    }

    /// Whether it grows with the square of the acceleration; all others grow
    /// in proportion to it.
    #[must_use]
    pub fn is_squared(&self) -> bool {
        matches!(self, Self::Arias)
    }

    /// Periods of the spectral accelerations that it is made of, in s.
    #[must_use]
    pub fn periods_s(&self) -> &[f64] {
        match self {
            Self::Sa(period_s) => std::slice::from_ref(period_s),
            Self::AverageSa(periods_s) => periods_s,
            _ => &[],
        }
    }

    /// Its value for a record, in its [`unit`](Self::unit); `periods_s` are
    /// those of the measured spectral accelerations. `None` for a column, and
    /// for a period that was not measured.
    #[must_use]
    pub fn value(&self, of: &Measures, periods_s: &[f64]) -> Option<f64> {
        let sa_g = |period_s: &f64| {
            let place = periods_s.iter().position(|t| t == period_s)?;
            of.spectral_acceleration_g.get(place).copied()
        };
        Some(match self {
            Self::Pga => of.pga_g,
            Self::Pgv => of.pgv_m_s,
            Self::Pgd => of.pgd_m,
            Self::Arias => of.arias_intensity_m_s,
            Self::Cav => of.cav_m_s,
            Self::PgvDuration => {
                of.pgv_m_s * of.significant_duration_5_75_s.sqrt().sqrt()
            }
            Self::Sa(period_s) => sa_g(period_s)?,
            Self::AverageSa(all_s) => {
                let sum = all_s.iter().try_fold(0.0, |sum, period_s| {
                    Some(sum + log(sa_g(period_s)?))
                })?;
                exp(sum / all_s.len() as f64)
            }
            Self::Column(_) => return None,
        })
    }
}
