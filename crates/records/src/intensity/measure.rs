//! Intensity measures by name, their units, and their values for a record.

use rocking::accelerogram::result_name;
use std::fmt;
use std::str::FromStr;

use libm::{exp, log};

use super::Measures;
use rocking::names::{UnknownName, as_text, named};

named! {
    /// Dimensionless intensity measure: the axis of an IDA curve.
    #[derive(PartialOrd, Ord, Hash)]
    pub enum Intensity: "intensity" {
        /// PGA/(g tan alpha).
        Pga = "pga",
        /// p PGV/(g tan alpha).
        Pgv = "pgv",
    }
}

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
    /// use rocking_records::intensity::Intensity;
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
/// `column:NAME`; all but NAME in upper or lower case.
///
/// ```
/// use rocking_records::intensity::{IntensityMeasure, Measures, Settings};
/// use rocking::accelerogram::Accelerogram;
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
/// assert_eq!("PGA".parse(), Ok(IntensityMeasure::Pga));
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
        let (kind, rest) = match text.split_once(':') {
            Some((kind, rest)) => (kind.to_ascii_lowercase(), Some(rest)),
            None => (text.to_ascii_lowercase(), None),
        };
        let found = match (kind.as_str(), rest) {
            ("sa", Some(t)) => period(t).map(Self::Sa),
            ("avgsa", Some(list)) => {
                let periods: Option<_> = list.split(',').map(period).collect();
                periods.map(Self::AverageSa)
            }
            ("column", Some(name))
                if !name.is_empty() && result_name(name).is_ok() =>
            {
                Some(Self::Column(name.to_owned()))
            }
            (word, None) => {
                let named = WORDS.iter().find(|(name, _)| *name == word);
                named.map(|(_, measure)| measure.clone())
            }
            _ => None,
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

impl From<Intensity> for IntensityMeasure {
    fn from(intensity: Intensity) -> Self {
        match intensity {
            Intensity::Pga => Self::Pga,
            Intensity::Pgv => Self::Pgv,
        }
    }
}

fn listed(periods_s: &[f64], separator: &str) -> String {
    let texts: Vec<String> = periods_s.iter().map(f64::to_string).collect();
    texts.join(separator)
}

/// A block at its uplift, where PGA/(g tan alpha) is 1: the intensity at
/// which a suite's measures are compared.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AtUplift {
    /// PGA at which the block lifts off, in g.
    pub pga_g: f64,
    /// Frequency parameter of the block, in rad/s.
    pub p_rad_s: f64,
    /// Gravity in m/s2.
    pub gravity_m_s2: f64,
}

impl AtUplift {
    /// The measure of a record that is scaled to the uplift of the block,
    /// dimensionless for PGA and PGV; `attribute` is that of the unscaled
    /// record for [`IntensityMeasure::Column`], and NaN comes of a period
    /// that was not measured.
    ///
    /// ```
    /// use rocking_records::intensity::{
    ///     AtUplift, IntensityMeasure, Measures, Settings,
    /// };
    /// use rocking::accelerogram::Accelerogram;
    /// let record = Accelerogram::try_new("step", 0.5, vec![0.1; 5])?;
    /// let measures = Measures::of(&record, &Settings::default())?;
    /// let uplift =
    ///     AtUplift { pga_g: 0.2, p_rad_s: 3.0, gravity_m_s2: 9.81 };
    /// let cav = IntensityMeasure::Cav;
    /// let found = uplift.value(&cav, &measures, &[], f64::NAN);
    /// assert!((found / measures.cav_m_s - 2.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    #[must_use]
    pub fn value(
        &self,
        measure: &IntensityMeasure,
        of: &Measures,
        periods_s: &[f64],
        attribute: f64,
    ) -> f64 {
        let factor = self.pga_g / of.pga_g;
        let velocity = self.p_rad_s / (self.gravity_m_s2 * self.pga_g);
        let value = || measure.value(of, periods_s).unwrap_or(f64::NAN);
        match measure {
            IntensityMeasure::Column(_) => factor * attribute,
            IntensityMeasure::Pga => 1.0,
            IntensityMeasure::Pgv => velocity * factor * of.pgv_m_s,
            squared if squared.is_squared() => factor * factor * value(),
            _ => factor * value(),
        }
    }
}

impl IntensityMeasure {
    /// The measures that a ranking compares where none are named.
    #[must_use]
    pub fn usual() -> Vec<Self> {
        let mut all: Vec<Self> =
            WORDS.iter().map(|(_, measure)| measure.clone()).collect();
        all.extend([0.5, 1.0, 2.0, 3.0, 4.0].map(Self::Sa));
        all.push(Self::AverageSa(vec![0.5, 1.0, 1.5, 2.0, 3.0]));
        all
    }

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

    /// The measure of these [`words`](Self::words).
    ///
    /// ```
    /// use rocking_records::intensity::IntensityMeasure;
    /// let found = IntensityMeasure::of_words("AvgSA(0.5, 1 s) (g)");
    /// assert_eq!(found, Some(IntensityMeasure::AverageSa(vec![0.5, 1.0])));
    /// assert_eq!(IntensityMeasure::of_words("SA(1 s), g"), None);
    /// ```
    #[must_use]
    pub fn of_words(words: &str) -> Option<Self> {
        let fixed = WORDS.iter().map(|(_, measure)| measure);
        if let Some(found) = fixed.into_iter().find(|m| m.words() == words) {
            return Some(found.clone());
        }
        let periods = words.strip_suffix(" s) (g)");
        let name = [("SA(", "sa:"), ("AvgSA(", "avgsa:")]
            .into_iter()
            .find_map(|(before, name)| {
                let list = periods?.strip_prefix(before)?;
                Some(format!("{name}{}", list.replace(", ", ",")))
            });
        let column = words.strip_prefix("column ");
        let name = name.or(column.map(|name| format!("column:{name}")));
        name?.parse().ok().filter(|found: &Self| found.words() == words)
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
