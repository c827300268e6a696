//! Intensity measures by name, and their values for a record.

use std::fmt;
use std::str::FromStr;

use libm::{exp, log};
use rocking::intensity::Measures;
use rocking::record::result_name;

/// An intensity measure of a record.
#[derive(Clone, Debug, PartialEq)]
pub enum Measure {
    /// PGA/(g tan alpha), as in the table.
    Pga,
    /// p PGV/(g tan alpha), as in the table.
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
    /// Geometric mean of spectral accelerations.
    AverageSa(Vec<f64>),
    /// A column of the suite's index or of --attributes.
    Column(String),
}

impl FromStr for Measure {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let refuse = || {
            format!(
                "found `{text}`: expected pga, pgv, pgd, arias, cav, \
                 pgv-d575, sa:T, avgsa:T1,T2,.. with periods in s, or \
                 column:NAME"
            )
        };
        let period = |text: &str| {
            let period = text.trim().parse::<f64>().ok();
            let positive = |t: &f64| *t > 0.0 && t.is_finite();
            period.filter(positive).ok_or_else(refuse)
        };
        Ok(match text.split_once(':') {
            None => match text {
                "pga" => Self::Pga,
                "pgv" => Self::Pgv,
                "pgd" => Self::Pgd,
                "arias" => Self::Arias,
                "cav" => Self::Cav,
                "pgv-d575" => Self::PgvDuration,
                _ => return Err(refuse()),
            },
            Some(("sa", t)) => Self::Sa(period(t)?),
            Some(("avgsa", list)) => {
                let periods = list.split(',').map(period);
                Self::AverageSa(periods.collect::<Result<_, _>>()?)
            }
            Some(("column", name))
                if !name.is_empty() && result_name(name).is_ok() =>
            {
                Self::Column(name.to_owned())
            }
            Some(_) => return Err(refuse()),
        })
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Pga => f.write_str("PGA/(g tan alpha)"),
            Self::Pgv => f.write_str("p PGV/(g tan alpha)"),
            Self::Pgd => f.write_str("PGD (m)"),
            Self::Arias => f.write_str("Arias intensity (m/s)"),
            Self::Cav => f.write_str("CAV (m/s)"),
            Self::PgvDuration => f.write_str("PGV D5-75^(1/4) (m s^(-3/4))"),
            Self::Sa(t) => write!(f, "SA({t} s) (g)"),
            Self::AverageSa(list) => {
                let list: Vec<_> = list.iter().map(f64::to_string).collect();
                write!(f, "AvgSA({} s) (g)", list.join(", "))
            }
            Self::Column(name) => write!(f, "column {name}"),
        }
    }
}

impl Measure {
    /// Whether the table of an IDA tells it.
    #[must_use]
    pub fn is_in_table(&self) -> bool {
        matches!(self, Self::Pga | Self::Pgv)
    }

    /// Whether it grows with the square of the acceleration; all others grow
    /// in proportion to it.
    #[must_use]
    pub fn is_squared(&self) -> bool {
        matches!(self, Self::Arias)
    }

    /// A few letters, for the tick of an axis; Arias intensity by its root.
    #[must_use]
    pub fn short(&self) -> String {
        match self {
            Self::Pga => "PGA".into(),
            Self::Pgv => "PGV".into(),
            Self::Pgd => "PGD".into(),
            Self::Arias => "√Arias".into(),
            Self::Cav => "CAV".into(),
            Self::PgvDuration => "PGV D".into(),
            Self::Sa(period_s) => format!("SA({period_s})"),
            Self::AverageSa(periods_s) => {
                let (first, last) = (periods_s.first(), periods_s.last());
                let of = |t: Option<&f64>| t.copied().unwrap_or(f64::NAN);
                format!("SA({}–{})", of(first), of(last))
            }
            Self::Column(name) => name.clone(),
        }
    }

    /// Periods of the spectral accelerations that it is made of, in s.
    #[must_use]
    pub fn periods(&self) -> &[f64] {
        match self {
            Self::Sa(period) => std::slice::from_ref(period),
            Self::AverageSa(periods) => periods,
            _ => &[],
        }
    }

    /// Its value for a record: PGA, SA and its average in g, lengths in m,
    /// times in s; `sa_g` tells the spectral acceleration at a period. None
    /// for a column, which no motion tells.
    #[must_use]
    pub fn value(
        &self,
        of: &Measures,
        sa_g: &dyn Fn(f64) -> f64,
    ) -> Option<f64> {
        Some(match self {
            Self::Pga => of.pga_g,
            Self::Pgv => of.pgv_m_s,
            Self::Pgd => of.pgd_m,
            Self::Arias => of.arias_intensity_m_s,
            Self::Cav => of.cav_m_s,
            Self::PgvDuration => {
                of.pgv_m_s * of.significant_duration_5_75_s.sqrt().sqrt()
            }
            Self::Sa(period_s) => sa_g(*period_s),
            Self::AverageSa(periods_s) => {
                let logs = periods_s.iter().map(|t| log(sa_g(*t)));
                exp(logs.sum::<f64>() / periods_s.len() as f64)
            }
            Self::Column(_) => return None,
        })
    }
}
