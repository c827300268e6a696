//! Hazard curves as files: the project's own CSV, and OpenQuake's.

use std::fmt;

use libm::log1p;
use thiserror::Error;

use super::risk::{HazardCurve, HazardError};
use crate::intensity::IntensityMeasure;

/// The first columns of the project's own table: name, and measure with the
/// number of its column's units in a g or a m/s.
const COLUMNS: [(&str, Option<(IntensityMeasure, f64)>); 4] = [
    ("pga_g", Some((IntensityMeasure::Pga, 1.0))),
    ("pgv_m_s", Some((IntensityMeasure::Pgv, 1.0))),
    ("pgv_cm_s", Some((IntensityMeasure::Pgv, 100.0))),
    ("intensity", None),
];

/// The second columns: annual frequencies, or probabilities in some years.
const SECOND: [&str; 2] = ["annual_frequency", "probability_of_exceedance"];

/// Sites of OpenQuake are written with five decimals of a degree.
const SAME_SITE_DEG: f64 = 0.6e-5;

/// A hazard curve of a file: its points, and what its intensities are.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hazard {
    /// The points with a frequency that is known and positive.
    pub curve: HazardCurve,
    /// The intensity measure; none where the file says `intensity`, which is
    /// that of the fragility in its own unit.
    pub im: Option<IntensityMeasure>,
    /// Number of the curve's units in one unit of the measure (g or m/s):
    /// 100 for a curve in cm/s.
    pub units_per_im_unit: f64,
    /// What was set aside.
    pub remarks: Vec<HazardRemark>,
}

/// Points of a hazard curve that were set aside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum HazardRemark {
    /// So many points at the end have a frequency of 0.
    Zeros(usize),
    /// So many points at the start have a probability of 1, which bounds no
    /// frequency.
    Certain(usize),
}

impl fmt::Display for HazardRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Zeros(n) => write!(
                f,
                "{n} points at the end of the hazard curve have frequency 0 \
                 and are set aside"
            ),
            Self::Certain(n) => write!(
                f,
                "{n} points at the start of the hazard curve have \
                 probability 1, which tells no frequency, and are set aside"
            ),
        }
    }
}

#[cfg(feature = "serde")]
impl serde::Serialize for HazardRemark {
    fn serialize<S: serde::Serializer>(
        &self,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.collect_str(self)
    }
}

/// What a hazard curve's file may leave open.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct HazardOptions {
    /// Years of the probabilities of exceedance, where the file does not say
    /// them.
    pub years: Option<f64>,
    /// Longitude and latitude in degrees of the site, where the file has
    /// several.
    pub site_deg: Option<(f64, f64)>,
}

/// A file that is no hazard curve: file, line, what was found and what was
/// expected.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{file}{}: {fault}", line.map_or(String::new(), |l| format!(":{l}")))]
#[non_exhaustive]
pub struct HazardFileError {
    /// The file.
    pub file: String,
    /// Line, counted from 1; none for the file as a whole.
    pub line: Option<usize>,
    /// What is wrong.
    pub fault: HazardFault,
}

/// What is wrong with a hazard curve's file.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum HazardFault {
    /// Something else than is read.
    #[error("found {found}: expected {expected}")]
    Found {
        /// What was found.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// Points that are no hazard curve.
    #[error(transparent)]
    Curve(#[from] HazardError),
}

const HEADER: &str = "pga_g, pgv_m_s, pgv_cm_s or intensity, and \
    annual_frequency or probability_of_exceedance; or \
    lon,lat,depth,poe-LEVEL,.. of OpenQuake";

/// A point as it is written: line, intensity, and frequency or probability.
type Written = (usize, f64, f64);

impl Hazard {
    /// Unit of the curve's intensities.
    #[must_use]
    pub fn unit(&self) -> &'static str {
        match &self.im {
            None => "that of the fragility",
            Some(_) if self.units_per_im_unit != 1.0 => "cm/s",
            Some(im) => im.unit(),
        }
    }

    /// Reads a hazard curve from the text of a file.
    ///
    /// The project's own CSV has two columns: `pga_g`, `pgv_m_s`, `pgv_cm_s`
    /// or `intensity` (the unit of the fragility), and `annual_frequency` in
    /// 1/year or `probability_of_exceedance` P in T years. A hazard curve of
    /// OpenQuake has `lon,lat,depth,poe-LEVEL,..` behind a comment with
    /// `investigation_time=T` and `imt='PGA'`, `'PGV'` (levels in cm/s) or
    /// `'SA(1.0)'`. A probability makes the frequency -ln(1 - P)/T of a
    /// Poisson process. `file` is named in errors.
    ///
    /// Points of frequency 0 at the end and of probability 1 at the start
    /// are set aside, with a remark.
    ///
    /// ```
    /// use rocking::fragility::hazard::{Hazard, HazardOptions};
    /// let text = "pga_g,annual_frequency\n0.05,0.02\n0.2,0.002\n1,0\n";
    /// let hazard = Hazard::parse("h.csv", text, &HazardOptions::default())?;
    /// assert_eq!(hazard.curve.points(), [(0.05, 0.02), (0.2, 0.002)]);
    /// assert_eq!(hazard.remarks.len(), 1);
    /// # Ok::<(), rocking::fragility::hazard::HazardFileError>(())
    /// ```
    ///
    /// # Errors
    /// [`HazardFileError`] with file and line.
    pub fn parse(
        file: &str,
        text: &str,
        options: &HazardOptions,
    ) -> Result<Self, HazardFileError> {
        read(text, options).map_err(|(line, fault)| HazardFileError {
            file: file.to_owned(),
            line,
            fault,
        })
    }
}

type Faulty = (Option<usize>, HazardFault);

fn fault(
    line: impl Into<Option<usize>>,
    found: impl Into<String>,
    expected: &'static str,
) -> Faulty {
    let found = found.into();
    (line.into(), HazardFault::Found { found, expected })
}

fn read(text: &str, options: &HazardOptions) -> Result<Hazard, Faulty> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line));
    let mut comments = String::new();
    let header = lines.by_ref().find(|(_, line)| {
        let is_comment = line.starts_with('#');
        if is_comment {
            comments = comments.clone() + line + "\n";
        }
        !is_comment && !line.trim().is_empty()
    });
    let (at, header) = header.unwrap_or((1, ""));
    let columns = cells(header);
    let mut rows = Vec::new();
    for (line, row) in lines {
        if row.starts_with('#') || row.trim().is_empty() {
            continue;
        }
        let row = cells(row);
        if row.len() != columns.len() {
            let found = format!("{} cells", row.len());
            return Err(fault(line, found, "one a column"));
        }
        rows.push((line, row));
    }
    if columns.starts_with(&["lon", "lat", "depth"]) {
        return openquake(&comments, (at, &columns), &rows, options);
    }
    let own = match columns[..] {
        [first, second] => COLUMNS
            .into_iter()
            .find(|(name, _)| *name == first)
            .filter(|_| SECOND.contains(&second)),
        _ => None,
    };
    let Some((_, measure)) = own else {
        return Err(fault(at, format!("columns `{header}`"), HEADER));
    };
    if options.site_deg.is_some() {
        let found = "a curve of no site";
        return Err(fault(at, found, "no site asked for (--site)"));
    }
    let mut points = Vec::new();
    for (line, row) in &rows {
        points.push((*line, number(*line, row[0])?, number(*line, row[1])?));
    }
    let years = match columns[1] == SECOND[1] {
        true => Some(options.years),
        false => None,
    };
    made(points, years, measure)
}

/// A curve of OpenQuake: a row a site, a column a level.
fn openquake(
    comments: &str,
    (at, columns): (usize, &[&str]),
    rows: &[(usize, Vec<&str>)],
    options: &HazardOptions,
) -> Result<Hazard, Faulty> {
    let imt = said(comments, "imt=");
    let expected = "imt='PGA', 'PGV' or 'SA(T)' in the first comment";
    let imt = imt.ok_or_else(|| fault(1, "no imt", expected))?;
    let period = |name: &str| {
        let text = name.strip_prefix("SA(")?.strip_suffix(')')?;
        text.parse().ok().filter(|t: &f64| *t > 0.0 && t.is_finite())
    };
    let measure = match imt {
        "PGA" => (IntensityMeasure::Pga, 1.0),
        "PGV" => (IntensityMeasure::Pgv, 100.0),
        name => match period(name) {
            Some(period_s) => (IntensityMeasure::Sa(period_s), 1.0),
            None => return Err(fault(1, format!("imt '{name}'"), expected)),
        },
    };
    let years = match said(comments, "investigation_time=") {
        Some(text) => Some(number(1, text)?),
        None => options.years,
    };
    let levels = columns[3..].iter().map(|name| {
        let found = || format!("column `{name}`");
        let level = name.strip_prefix("poe-");
        level.ok_or_else(|| fault(at, found(), HEADER))
    });
    let levels: Vec<&str> = levels.collect::<Result<_, _>>()?;
    let mut found = Vec::new();
    for (line, row) in rows {
        let site = (number(*line, row[0])?, number(*line, row[1])?);
        let here = options.site_deg.is_none_or(|(lon, lat)| {
            (site.0 - lon).abs() <= SAME_SITE_DEG
                && (site.1 - lat).abs() <= SAME_SITE_DEG
        });
        if here {
            found.push((*line, row));
        }
    }
    let [(line, row)] = found[..] else {
        let found = format!("{} such sites of {}", found.len(), rows.len());
        return Err(fault(None, found, "one (--site LON,LAT)"));
    };
    let mut points = Vec::new();
    for (level, cell) in levels.iter().zip(&row[3..]) {
        points.push((line, number(at, level)?, number(line, cell)?));
    }
    made(points, Some(years), Some(measure))
}

/// The curve through points; `years` are there for probabilities, and say
/// the years where these are known.
fn made(
    mut points: Vec<Written>,
    years: Option<Option<f64>>,
    measure: Option<(IntensityMeasure, f64)>,
) -> Result<Hazard, Faulty> {
    let mut remarks = Vec::new();
    let mut certain = 0;
    if let Some(years) = years {
        let found = "probabilities of exceedance";
        let years = years.ok_or_else(|| {
            fault(None, found, "the years that they are for (--years)")
        })?;
        if !(years > 0.0 && years.is_finite()) {
            let found = format!("{years} years");
            return Err(fault(None, found, "a positive number"));
        }
        for (line, _, p) in &mut points {
            if !(0.0..=1.0).contains(p) {
                let found = format!("probability {p}");
                return Err(fault(*line, found, "a number from 0 to 1"));
            }
            *p = -log1p(-*p) / years;
        }
        let unknown = |(.., frequency): &&Written| frequency.is_infinite();
        certain = points.iter().take_while(unknown).count();
        points.drain(..certain);
        if certain > 0 {
            remarks.push(HazardRemark::Certain(certain));
        }
    }
    let zero = |(.., frequency): &&Written| *frequency == 0.0;
    let zeros = points.iter().rev().take_while(zero).count();
    points.truncate(points.len() - zeros);
    if zeros > 0 {
        remarks.push(HazardRemark::Zeros(zeros));
    }
    let pairs: Vec<(f64, f64)> =
        points.iter().map(|(_, im, frequency)| (*im, *frequency)).collect();
    let curve = HazardCurve::try_new(&pairs).map_err(|mut error| {
        let line = match &mut error {
            HazardError::Intensity { number, .. }
            | HazardError::Frequency { number, .. } => {
                let line = points.get(*number - 1).map(|(line, ..)| *line);
                *number += certain;
                line
            }
            HazardError::Points(_) => None,
        };
        (line, error.into())
    })?;
    let (im, units_per_im_unit) = match measure {
        Some((im, per_unit)) => (Some(im), per_unit),
        None => (None, 1.0),
    };
    Ok(Hazard { curve, im, units_per_im_unit, remarks })
}

fn cells(line: &str) -> Vec<&str> {
    line.split(',').map(str::trim).collect()
}

fn number(line: usize, text: &str) -> Result<f64, Faulty> {
    let found = || text.chars().take(40).collect::<String>();
    text.parse().map_err(|_| fault(line, format!("`{}`", found()), "a number"))
}

/// The value behind `name` in a comment of OpenQuake, without its quotes.
fn said<'a>(comments: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = comments.split_once(name)?;
    let rest = rest.trim_start_matches(['\'', '"']);
    rest.split(['\'', '"', ',', '\n']).next().map(str::trim)
}

#[cfg(test)]
mod tests;
