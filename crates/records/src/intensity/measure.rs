//! Intensity measures by name, their units, and their values for a record.

use rocking::accelerogram::result_name;
use std::fmt;
use std::str::FromStr;

use libm::{exp, log};

use super::{IntensityError, Measures, RockingBand, Settings};
use rocking::names::{UnknownName, as_text, named};

named! {
    /// Dimensionless intensity measure: the axis of an IDA curve.
    #[derive(PartialOrd, Ord, Hash)]
    #[non_exhaustive]
    pub enum Intensity: "intensity" {
        /// PGA/(g tan alpha).
        Pga = "pga",
        /// p PGV/(g tan alpha).
        Pgv = "pgv",
    }
}

/// The row of a dimensionless measure.
#[non_exhaustive]
pub struct IntensityRow {
    /// The measure of the motion, as `PGA`.
    pub symbol: &'static str,
    /// Unit of the measure of the motion, for PGA in g and PGV in m/s.
    pub unit: &'static str,
    /// The dimensionless measure as the paper writes it.
    pub words: &'static str,
    /// The dimensionless measure in the markup of the figures.
    pub label: &'static str,
    /// The measure by PGA and PGV. It grows in proportion to both.
    of: fn(f64, f64) -> f64,
}

impl Intensity {
    /// The row of the measure.
    pub const fn row(self) -> IntensityRow {
        match self {
            Self::Pga => IntensityRow {
                symbol: "PGA",
                unit: "g",
                words: "PGA/(g tan alpha)",
                label: "PGA / (*g* tan *α*)",
                of: |pga, _| pga,
            },
            Self::Pgv => IntensityRow {
                symbol: "PGV",
                unit: "m/s",
                words: "p PGV/(g tan alpha)",
                label: "*p* PGV / (*g* tan *α*)",
                of: |_, pgv| pgv,
            },
        }
    }

    /// The measure by PGA and PGV, with or without units.
    ///
    /// ```
    /// use rocking_records::intensity::Intensity;
    /// assert_eq!(Intensity::Pgv.of(0.4, 0.6), 0.6);
    /// ```
    pub fn of(self, pga: f64, pgv: f64) -> f64 {
        (self.row().of)(pga, pgv)
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
    pub fn pga_g(
        self,
        im: f64,
        threshold: f64,
        p_rad_s: f64,
        velocity_ratio_s: f64,
    ) -> f64 {
        im * threshold / self.of(1.0, p_rad_s * velocity_ratio_s)
    }
}

named! {
    /// An intensity measure of a record that has neither period nor parameter.
    #[non_exhaustive]
    pub enum ScalarMeasure: "intensity measure" {
        /// Peak ground displacement.
        Pgd = "pgd",
        /// Arias intensity.
        Arias = "arias",
        /// Cumulative absolute velocity.
        Cav = "cav",
        /// PGV times the fourth root of the duration D5-75, after the measure
        /// of Fajfar, Vidic and Fischinger (1990, Earthquake Engineering and
        /// Structural Dynamics 19).
        PgvDuration = "pgv-d575",
    }
}

/// The row of a measure of a record.
#[non_exhaustive]
pub struct ScalarRow {
    /// The measure in text.
    symbol: &'static str,
    /// A short name for the ticks of a figure; the root of a measure that
    /// grows with the square of the acceleration.
    pub short: &'static str,
    unit: &'static str,
    /// Whether it grows with the square of the acceleration.
    is_squared: bool,
    value: fn(&Measures) -> f64,
}

impl ScalarRow {
    /// A measure that is proportional to the acceleration.
    const fn of(
        symbol: &'static str,
        unit: &'static str,
        value: fn(&Measures) -> f64,
    ) -> Self {
        Self { symbol, short: symbol, unit, is_squared: false, value }
    }
}

impl ScalarMeasure {
    /// The row of the measure.
    pub const fn row(self) -> ScalarRow {
        match self {
            Self::Pgd => ScalarRow::of("PGD", "m", |m| m.pgd_m),
            Self::Arias => ScalarRow {
                short: "√Arias",
                is_squared: true,
                ..ScalarRow::of("Arias intensity", "m/s", |m| {
                    m.arias_intensity_m_s
                })
            },
            Self::Cav => ScalarRow::of("CAV", "m/s", |m| m.cav_m_s),
            Self::PgvDuration => ScalarRow {
                short: "PGV D",
                ..ScalarRow::of("PGV D5-75^(1/4)", "m s^(-3/4)", |m| {
                    m.pgv_m_s * m.significant_duration_5_75_s.sqrt().sqrt()
                })
            },
        }
    }
}

/// An intensity measure of a record. Its name is `pga`, `pgv`, `pgd`, `arias`,
/// `cav`, `pgv-d575`, `sa:T`, `avgsa:T1,T2,..` with periods in s,
/// `avgsa:rocking` with the periods of a block, or `column:NAME`, all except
/// NAME in upper or lower case.
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
/// assert_eq!("PGA".parse(), Ok(IntensityMeasure::PGA));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum IntensityMeasure {
    /// A measure that is also an axis of IDA curves, with its unit.
    Axis(Intensity),
    /// Another measure without a parameter.
    Scalar(ScalarMeasure),
    /// Spectral acceleration at a period in s, 5 % damping.
    Sa(f64),
    /// Geometric mean of spectral accelerations at periods in s.
    AverageSa(Vec<f64>),
    /// Geometric mean of spectral accelerations at the periods of a block.
    /// Without a block it has no value; [`IntensityMeasure::of_block`] adds
    /// the block.
    RockingSa(Option<RockingBand>),
    /// A column of a suite's index, or another attribute of its records.
    Column(String),
}

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
            ("avgsa", Some("rocking")) => Some(Self::RockingSa(None)),
            ("avgsa", Some(list)) => match list.strip_prefix("rocking:") {
                Some(p) => period(p)
                    .and_then(RockingBand::try_new)
                    .map(|band| Self::RockingSa(Some(band))),
                None => {
                    let periods_s = list.split(',').map(period);
                    periods_s.collect::<Option<_>>().map(Self::AverageSa)
                }
            },
            ("column", Some(name))
                if !name.is_empty() && result_name(name).is_ok() =>
            {
                Some(Self::Column(name.to_owned()))
            }
            (word, None) => {
                Self::words_alone().find(|measure| measure.to_string() == word)
            }
            _ => None,
        };
        found.ok_or_else(|| UnknownName {
            what: "intensity measure",
            found: text.to_owned(),
            expected: Intensity::ALL
                .map(Intensity::name)
                .into_iter()
                .chain(ScalarMeasure::ALL.map(ScalarMeasure::name))
                .chain(["sa:T", "avgsa:T1,T2,.. (periods in s)"])
                .chain(["avgsa:rocking", "column:NAME"])
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
            Self::RockingSa(None) => f.pad("avgsa:rocking"),
            Self::RockingSa(Some(band)) => {
                write!(f, "avgsa:rocking:{}", band.p_rad_s())
            }
            Self::Column(name) => write!(f, "column:{name}"),
            Self::Axis(intensity) => f.pad(intensity.name()),
            Self::Scalar(scalar) => f.pad(scalar.name()),
        }
    }
}

as_text!(IntensityMeasure);

impl From<Intensity> for IntensityMeasure {
    fn from(intensity: Intensity) -> Self {
        Self::Axis(intensity)
    }
}

fn listed(periods_s: &[f64], separator: &str) -> String {
    let texts: Vec<String> = periods_s.iter().map(f64::to_string).collect();
    texts.join(separator)
}

/// A block at its uplift, where PGA/(g tan alpha) is 1. The measures of a
/// suite are compared at this intensity.
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
    /// dimensionless for PGA and PGV. For [`IntensityMeasure::Column`],
    /// `attribute` is the attribute of the unscaled record. A period that was
    /// not measured gives NaN.
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
    /// let cav = "cav".parse()?;
    /// let found = uplift.value(&cav, &measures, &[], f64::NAN);
    /// assert!((found / measures.cav_m_s - 2.0).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn value(
        &self,
        measure: &IntensityMeasure,
        of: &Measures,
        periods_s: &[f64],
        attribute: f64,
    ) -> f64 {
        let factor = self.pga_g / of.pga_g;
        if let IntensityMeasure::Axis(intensity) = measure {
            let velocity = self.p_rad_s / (self.gravity_m_s2 * self.pga_g);
            return intensity.of(1.0, velocity * factor * of.pgv_m_s);
        }
        let factor =
            if measure.is_squared() { factor * factor } else { factor };
        factor * self.unscaled(measure, of, periods_s, attribute)
    }

    /// The measure of the unscaled record, with the units of [`Self::value`].
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
    /// let pga = "pga".parse()?;
    /// // PGA/(g tan alpha)
    /// assert_eq!(uplift.unscaled(&pga, &measures, &[], f64::NAN), 0.5);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn unscaled(
        &self,
        measure: &IntensityMeasure,
        of: &Measures,
        periods_s: &[f64],
        attribute: f64,
    ) -> f64 {
        let velocity = self.p_rad_s / (self.gravity_m_s2 * self.pga_g);
        match measure {
            IntensityMeasure::Column(_) => attribute,
            IntensityMeasure::Axis(intensity) => {
                intensity.of(of.pga_g / self.pga_g, velocity * of.pgv_m_s)
            }
            _ => measure.value(of, periods_s).unwrap_or(f64::NAN),
        }
    }
}

impl Settings {
    /// The settings for these measures: their periods, each once, with the
    /// default damping.
    ///
    /// # Errors
    /// As [`Settings::try_new`].
    pub fn of<'a>(
        gravity_m_s2: f64,
        measures: impl IntoIterator<Item = &'a IntensityMeasure>,
    ) -> Result<Self, IntensityError> {
        let mut periods_s: Vec<f64> = Vec::new();
        for period in measures.into_iter().flat_map(|im| im.periods_s()) {
            if !periods_s.contains(period) {
                periods_s.push(*period);
            }
        }
        let damping = Self::default().damping_ratio();
        Self::try_new(gravity_m_s2, damping, periods_s)
    }
}

impl IntensityMeasure {
    /// Peak ground acceleration.
    pub const PGA: Self = Self::Axis(Intensity::Pga);
    /// Peak ground velocity.
    pub const PGV: Self = Self::Axis(Intensity::Pgv);

    /// The measures without a parameter.
    fn words_alone() -> impl Iterator<Item = Self> {
        let axes = Intensity::ALL.into_iter().map(Self::Axis);
        axes.chain(ScalarMeasure::ALL.into_iter().map(Self::Scalar))
    }

    /// The default measures of a ranking.
    pub fn usual() -> Vec<Self> {
        let mut all: Vec<Self> = Self::words_alone().collect();
        all.extend([0.5, 1.0, 2.0, 3.0, 4.0].map(Self::Sa));
        all.push(Self::RockingSa(None));
        all
    }

    /// The default measures for comparisons of shaking-table tests: PGA, PGV
    /// and the last of the [`usual`](Self::usual) measures.
    pub fn usual_of_tests() -> Vec<Self> {
        vec![Self::PGA, Self::PGV, Self::RockingSa(None)]
    }

    /// The measure for a block with frequency parameter p in rad/s:
    /// [`RockingSa`](Self::RockingSa) without a block gets the periods of the
    /// block; any other measure is unchanged.
    ///
    /// ```
    /// use rocking_records::intensity::IntensityMeasure;
    /// let of_any: IntensityMeasure = "avgsa:rocking".parse()?;
    /// assert!(of_any.periods_s().is_empty());
    /// let own = of_any.of_block(3.0);
    /// assert_eq!(own.periods_s().len(), 12);
    /// assert_eq!(own.to_string(), "avgsa:rocking:3");
    /// assert_eq!(own.to_string().parse(), Ok(own.clone()));
    /// assert_eq!(IntensityMeasure::of_words(&own.words()), Some(own));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of_block(&self, p_rad_s: f64) -> Self {
        match self {
            Self::RockingSa(None) => {
                Self::RockingSa(RockingBand::try_new(p_rad_s))
            }
            other => other.clone(),
        }
    }

    /// Unit of its [`value`](Self::value); empty for a column.
    pub fn unit(&self) -> &'static str {
        match self {
            Self::Axis(intensity) => intensity.row().unit,
            Self::Scalar(scalar) => scalar.row().unit,
            Self::Sa(_) | Self::AverageSa(_) | Self::RockingSa(_) => "g",
            Self::Column(_) => "",
        }
    }

    /// The dimensionless measure, if it is the axis of an IDA curve.
    pub fn dimensionless(&self) -> Option<Intensity> {
        match self {
            Self::Axis(intensity) => Some(*intensity),
            _ => None,
        }
    }

    /// The measure in words with its unit; an axis of IDA curves is
    /// dimensionless.
    pub fn words(&self) -> String {
        let symbol = match self {
            Self::Axis(intensity) => return intensity.row().words.to_owned(),
            Self::Column(name) => return format!("column {name}"),
            Self::Scalar(scalar) => scalar.row().symbol.to_owned(),
            Self::Sa(period_s) => format!("SA({period_s} s)"),
            Self::AverageSa(list) => {
                format!("AvgSA({} s)", listed(list, ", "))
            }
            Self::RockingSa(None) => {
                format!("AvgSA({})", RockingBand::words())
            }
            Self::RockingSa(Some(band)) => format!(
                "AvgSA({}, p = {} rad/s)",
                RockingBand::words(),
                band.p_rad_s()
            ),
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
    pub fn of_words(words: &str) -> Option<Self> {
        let mut fixed = Self::words_alone();
        if let Some(found) = fixed.find(|m| m.words() == words) {
            return Some(found);
        }
        let (kind, rest) = words.split_once(['(', ' '])?;
        let name = if kind == "column" {
            format!("column:{rest}")
        } else if let Some(list) = rest.strip_suffix(" s) (g)") {
            format!("{kind}:{}", list.replace(", ", ","))
        } else {
            let (_, p) = rest.split_once(", p = ")?;
            format!("{kind}:rocking:{}", p.strip_suffix(" rad/s) (g)")?)
        };
        name.parse().ok().filter(|found: &Self| found.words() == words)
    }

    /// Whether it grows with the square of the acceleration; all other
    /// measures are proportional to it.
    pub fn is_squared(&self) -> bool {
        matches!(self, Self::Scalar(scalar) if scalar.row().is_squared)
    }

    /// Periods of its spectral accelerations, in s.
    pub fn periods_s(&self) -> &[f64] {
        match self {
            Self::Sa(period_s) => std::slice::from_ref(period_s),
            Self::AverageSa(periods_s) => periods_s,
            Self::RockingSa(Some(band)) => band.periods_s(),
            _ => &[],
        }
    }

    /// Its value for a record, in its [`unit`](Self::unit); `periods_s` are
    /// the periods of the measured spectral accelerations. `None` for a
    /// column, and for a period that was not measured.
    pub fn value(&self, of: &Measures, periods_s: &[f64]) -> Option<f64> {
        let sa_g = |period_s: &f64| {
            let place = periods_s.iter().position(|t| t == period_s)?;
            of.spectral_acceleration_g.get(place).copied()
        };
        Some(match self {
            Self::Axis(intensity) => intensity.of(of.pga_g, of.pgv_m_s),
            Self::Scalar(scalar) => (scalar.row().value)(of),
            Self::Sa(period_s) => sa_g(period_s)?,
            Self::AverageSa(_) | Self::RockingSa(Some(_)) => {
                let all_s = self.periods_s();
                let sum = all_s.iter().try_fold(0.0, |sum, period_s| {
                    Some(sum + log(sa_g(period_s)?))
                })?;
                exp(sum / all_s.len() as f64)
            }
            Self::RockingSa(None) | Self::Column(_) => return None,
        })
    }
}
