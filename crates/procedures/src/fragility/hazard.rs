//! Hazard curves as files: the project's own CSV, and OpenQuake's.

mod average;
mod site;

use std::fmt;

use libm::{asin, cos, hypot, log1p, sin, sqrt};
use thiserror::Error;

use super::risk::{HazardCurve, HazardError};
use rocking::names::as_text;
use rocking::stop;
use rocking_records::intensity::{Intensity, IntensityMeasure};

pub use average::{
    AverageHazardError, CorrelationFault, SpectralCorrelation, average_hazard,
};
pub use site::{Site, SiteError};

/// First columns of the project's own table: name, measure, and number of
/// the column's units in one unit of the measure (g or m/s).
const COLUMNS: [(&str, HazardMeasure, f64); 4] = [
    ("pga_g", HazardMeasure::Of(IntensityMeasure::PGA), 1.0),
    ("pgv_m_s", HazardMeasure::Of(IntensityMeasure::PGV), 1.0),
    ("pgv_cm_s", HazardMeasure::Of(IntensityMeasure::PGV), 100.0),
    ("intensity", HazardMeasure::Own, 1.0),
];

/// The second columns: annual frequencies, or probabilities in some years.
const SECOND: [&str; 2] = ["annual_frequency", "probability_of_exceedance"];

/// Columns of a site in OpenQuake's CSV; the first two are always there.
const SITE: [&str; 4] = ["lon", "lat", "depth", "custom_site_id"];

/// Sites of OpenQuake are written with five decimals of a degree.
const SAME_SITE_DEG: f64 = 0.6e-5;

/// Accelerations in g, and velocities in m/s, above which a hazard curve is
/// not plausible: at a frequency of [`SELDOM`] or more, or at any.
const LARGE: [f64; 2] = [4.0, 12.0];

/// Annual frequency.
const SELDOM: f64 = 1e-5;

/// Mean radius of the Earth in km.
const EARTH_KM: f64 = 6371.0;

/// A hazard curve from a file: its points and its intensity measure.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Hazard {
    /// The points with a frequency that is known and positive.
    pub curve: HazardCurve,
    /// The intensity measure.
    pub im: HazardMeasure,
    /// Number of the curve's units in one unit of the measure (g or m/s):
    /// 100 for a curve in cm/s.
    pub units_per_im_unit: f64,
    /// Points and assumptions to report.
    pub remarks: Vec<HazardRemark>,
}

/// Intensity measure of a hazard curve.
#[derive(Clone, Debug, PartialEq)]
pub enum HazardMeasure {
    /// The same as the fragility's, in its unit: the column is `intensity`.
    Own,
    /// A measure.
    Of(IntensityMeasure),
    /// Geometric mean of spectral accelerations at periods that the file does
    /// not state: `AvgSA` of OpenQuake.
    AverageSa,
}

impl HazardMeasure {
    /// Whether the curve applies to a fragility in this measure.
    ///
    /// ```
    /// use rocking_procedures::fragility::hazard::HazardMeasure;
    /// use rocking_records::intensity::IntensityMeasure;
    /// let mean = IntensityMeasure::AverageSa(vec![0.5, 1.0]);
    /// assert!(HazardMeasure::AverageSa.is_of(&mean));
    /// assert!(!HazardMeasure::AverageSa.is_of(&IntensityMeasure::PGA));
    /// assert!(HazardMeasure::Own.is_of(&mean));
    /// ```
    pub fn is_of(&self, im: &IntensityMeasure) -> bool {
        match self {
            Self::Own => true,
            Self::Of(own) => own == im,
            Self::AverageSa => matches!(
                im,
                IntensityMeasure::AverageSa(_)
                    | IntensityMeasure::RockingSa(_)
            ),
        }
    }

    /// The dimensionless measure, if it is an axis of IDA curves.
    pub fn dimensionless(&self) -> Option<Intensity> {
        match self {
            Self::Of(im) => im.dimensionless(),
            Self::Own | Self::AverageSa => None,
        }
    }

    /// The name of the measure; `None` for the fragility's own.
    pub fn name(&self) -> Option<String> {
        match self {
            Self::Own => None,
            Self::Of(im) => Some(im.to_string()),
            Self::AverageSa => Some("avgsa".to_owned()),
        }
    }
}

impl serde::Serialize for HazardMeasure {
    fn serialize<S: serde::Serializer>(
        &self,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        self.name().serialize(to)
    }
}

/// Part of a hazard curve that was set aside, an assumption, or a doubt.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum HazardRemark {
    /// Number of points at the end with a frequency of 0.
    Zeros(usize),
    /// Number of points at the start with a probability of 1, which gives no
    /// frequency.
    Certain(usize),
    /// The periods of AvgSA are not stated.
    Periods,
    /// The curve is computed from several curves in SA.
    Averaged,
    /// An intensity of the curve that no earthquake reaches so often: the
    /// curve may be in another unit.
    Large(f64),
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
                 probability 1, which gives no frequency, and are set aside"
            ),
            Self::Periods => f.write_str(
                "the hazard curve is in AvgSA and does not state its \
                 periods: they are taken to be those of the fragility",
            ),
            Self::Averaged => f.write_str(
                "the hazard curve in AvgSA is computed from curves in SA with \
                 the given correlation",
            ),
            Self::Large(intensity) => write!(
                f,
                "the hazard curve reaches {intensity}, which is not \
                 plausible: check its unit"
            ),
        }
    }
}

as_text!(write HazardRemark);

/// Data that the file of a hazard curve may lack.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HazardOptions {
    /// Years of the probabilities of exceedance, if the file does not give
    /// them.
    pub years: Option<f64>,
    /// The site, if the file has several.
    pub site: Option<Site>,
}

/// Why a file is not a valid hazard curve: file, line, what was found and what
/// was expected.
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

/// Fault of the file of a hazard curve.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum HazardFault {
    /// An unexpected entry.
    #[error("found {found}: expected {expected}")]
    Found {
        /// What was found.
        found: String,
        /// What was expected.
        expected: &'static str,
    },
    /// Points that are not a valid hazard curve.
    #[error(transparent)]
    Curve(#[from] HazardError),
}

const HEADER: &str = "pga_g, pgv_m_s, pgv_cm_s or intensity, and \
    annual_frequency or probability_of_exceedance; or \
    OpenQuake's lon, lat, poe-LEVEL,.. with or without depth and \
    custom_site_id";

/// A point as it is written: line, intensity, and frequency or probability.
type Written = (usize, f64, f64);

impl Hazard {
    /// Unit of the curve's intensities.
    pub fn unit(&self) -> &'static str {
        match &self.im {
            HazardMeasure::Own => "that of the fragility",
            HazardMeasure::Of(_) if self.units_per_im_unit != 1.0 => "cm/s",
            HazardMeasure::Of(im) => im.unit(),
            HazardMeasure::AverageSa => "g",
        }
    }

    /// Name of the measure, or the unit if the measure has no name.
    pub(crate) fn name(&self) -> String {
        self.im.name().unwrap_or_else(|| self.unit().to_owned())
    }

    /// Reads a hazard curve from the text of a file.
    ///
    /// The project's own CSV has two columns: `pga_g`, `pgv_m_s`, `pgv_cm_s`
    /// or `intensity` (the unit of the fragility), and `annual_frequency` in
    /// 1/year or `probability_of_exceedance` P in T years. A hazard curve of
    /// OpenQuake has the columns `lon`, `lat`, `poe-LEVEL`, .. and, if
    /// OpenQuake writes them, `depth` and `custom_site_id`, behind a comment
    /// with `investigation_time=T` and `imt='PGA'`, `'PGV'` (levels in cm/s),
    /// `'SA(1.0)'` or `'AvgSA'`. A probability makes the frequency
    /// -ln(1 - P)/T of a Poisson process. `file` is named in errors.
    ///
    /// Points of frequency 0 at the end and of probability 1 at the start
    /// are set aside, with a remark.
    ///
    /// ```
    /// use rocking_procedures::fragility::hazard::{Hazard, HazardOptions};
    /// let text = "pga_g,annual_frequency\n0.05,0.02\n0.2,0.002\n1,0\n";
    /// let hazard = Hazard::parse("h.csv", text, &HazardOptions::default())?;
    /// assert_eq!(hazard.curve.points(), [(0.05, 0.02), (0.2, 0.002)]);
    /// assert_eq!(hazard.remarks.len(), 1);
    /// # Ok::<(), rocking_procedures::fragility::hazard::HazardFileError>(())
    /// ```
    ///
    /// # Errors
    /// [`HazardFileError`] with file and line.
    pub fn parse(
        file: &str,
        text: &str,
        options: &HazardOptions,
    ) -> Result<Self, HazardFileError> {
        parse_hazard(text, options).map_err(|(line, fault)| HazardFileError {
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

/// A row of the table: line and cells.
type Row<'a> = (usize, Vec<&'a str>);

fn parse_hazard(
    text: &str,
    options: &HazardOptions,
) -> Result<Hazard, Faulty> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    let mut lines = text.lines().enumerate().map(|(i, line)| (i + 1, line));
    let mut comments = String::new();
    let header = lines.by_ref().find(|(_, line)| {
        let is_comment = line.starts_with('#');
        if is_comment {
            comments.push_str(line);
            comments.push('\n');
        }
        !is_comment && !line.trim().is_empty()
    });
    let (at, header) = header.unwrap_or((1, ""));
    let columns = cells(header);
    let rows = lines
        .filter(|(_, row)| !(row.starts_with('#') || row.trim().is_empty()))
        .map(|(line, row)| {
            stop::point();
            let row = cells(row);
            if row.len() != columns.len() {
                let found = format!("{} cells", row.len());
                return Err(fault(line, found, "one per column"));
            }
            Ok((line, row))
        });
    if ["lon", "lat"].iter().all(|name| columns.contains(name)) {
        return openquake(&comments, (at, &columns), rows, options);
    }
    let own = match columns[..] {
        [first, second] => COLUMNS
            .into_iter()
            .find(|(name, ..)| *name == first)
            .filter(|_| SECOND.contains(&second)),
        _ => None,
    };
    let Some((_, im, per_unit)) = own else {
        let found = format!("columns `{}`", beginning(header));
        return Err(fault(at, found, HEADER));
    };
    if options.site.is_some() {
        return Err(fault(at, "a curve of no site", "no site (--site)"));
    }
    let mut points = Vec::new();
    for row in rows {
        let (line, row) = row?;
        points.push((line, number(line, row[0])?, number(line, row[1])?));
    }
    let years = (columns[1] == SECOND[1]).then_some(options.years);
    made(points, years, (im, per_unit))
}

/// A curve of OpenQuake: one row per site, one column per level.
fn openquake<'a>(
    comments: &str,
    (at, columns): (usize, &[&str]),
    rows: impl Iterator<Item = Result<Row<'a>, Faulty>>,
    options: &HazardOptions,
) -> Result<Hazard, Faulty> {
    let imt = said(comments, "imt=");
    let expected = "imt='PGA', 'PGV', 'SA(T)' or 'AvgSA' in the first comment";
    let imt = imt.ok_or_else(|| fault(1, "no imt", expected))?;
    let period = |name: &str| {
        let text = name.strip_prefix("SA(")?.strip_suffix(')')?;
        text.parse().ok().filter(|t: &f64| *t > 0.0 && t.is_finite())
    };
    let of = HazardMeasure::Of;
    let measure = match imt {
        "PGA" => (of(IntensityMeasure::PGA), 1.0),
        "PGV" => (of(IntensityMeasure::PGV), 100.0),
        "AvgSA" => (HazardMeasure::AverageSa, 1.0),
        name => match period(name) {
            Some(period_s) => (of(IntensityMeasure::Sa(period_s)), 1.0),
            None => {
                let found = format!("imt '{}'", beginning(name));
                return Err(fault(1, found, expected));
            }
        },
    };
    let years = said(comments, "investigation_time=");
    let years = years.map(|text| number(1, text)).transpose()?;
    let mut levels = Vec::new();
    for (place, name) in columns.iter().enumerate() {
        match name.strip_prefix("poe-") {
            Some(level) => levels.push((place, number(at, level)?)),
            None if SITE.contains(name)
                && !columns[..place].contains(name) => {}
            None => {
                let found = format!("column `{}`", beginning(name));
                return Err(fault(at, found, HEADER));
            }
        }
    }
    let (line, row) = site(columns, rows, options.site.as_ref())?;
    let mut points = Vec::new();
    for (place, level) in levels {
        points.push((line, level, number(line, row[place])?));
    }
    made(points, Some(years.or(options.years)), measure)
}

/// Sites that a message names, at most.
const MOST_NAMED: usize = 5;

/// The row of a site, or the only one.
fn site<'a>(
    columns: &[&str],
    rows: impl Iterator<Item = Result<Row<'a>, Faulty>>,
    wanted: Option<&Site>,
) -> Result<Row<'a>, Faulty> {
    let within = |at: Option<usize>, (lon, lat): (f64, f64)| {
        if lon.abs() <= 360.0 && lat.abs() <= 90.0 {
            return Ok((lon, lat));
        }
        let expected = "a longitude from -360 to 360 and a latitude from \
                        -90 to 90 degrees";
        Err(fault(at, format!("site {lon},{lat}"), expected))
    };
    if let Some(Site::Degrees(lon, lat)) = wanted {
        within(None, (*lon, *lat))?;
    }
    let place = |name: &str| columns.iter().position(|own| *own == name);
    let [lon, lat] = [SITE[0], SITE[1]].map(|own| place(own).unwrap_or(0));
    let id_at = place(SITE[3]);
    let name = |(_, row): &Row<'_>| {
        let degrees = format!("{},{}", row[lon], row[lat]);
        let id = id_at.map(|at| format!(" ({})", beginning(row[at])));
        beginning(&degrees).to_owned() + &id.unwrap_or_default()
    };
    let (mut all, mut found, mut named) = (0, Vec::new(), Vec::new());
    let mut nearest: Option<(f64, String)> = None;
    for row in rows {
        let row = row?;
        let own = (number(row.0, row.1[lon])?, number(row.0, row.1[lat])?);
        let own = within(Some(row.0), own)?;
        all += 1;
        let is_it = match wanted {
            None => true,
            Some(Site::Id(id)) => id_at.is_some_and(|at| row.1[at] == id),
            Some(Site::Degrees(lon, lat)) => {
                let away_km = distance_km(own, (*lon, *lat));
                if nearest.as_ref().is_none_or(|(km, _)| away_km < *km) {
                    nearest = Some((away_km, name(&row)));
                }
                away_deg(own.0, *lon) <= SAME_SITE_DEG
                    && (own.1 - lat).abs() <= SAME_SITE_DEG
            }
        };
        if is_it && found.is_empty() {
            named.clear();
        }
        if named.len() < MOST_NAMED && (is_it || found.is_empty()) {
            named.push(name(&row));
        }
        if is_it && found.len() < 2 {
            found.push(row);
        }
    }
    if found.len() == 1
        && let Some(row) = found.pop()
    {
        return Ok(row);
    }
    let one = "one site (--site LON,LAT or --site ID)";
    let names = named.join(", ");
    let found = match (wanted, nearest) {
        _ if all == 0 => "no site".to_owned(),
        (None, _) => format!("{all} sites, such as {names}"),
        (Some(site), _) if !found.is_empty() => {
            format!("several sites {site}: {names}")
        }
        (Some(site), Some((km, nearest))) => format!(
            "no site {site} among {all}: the nearest one is {nearest}, \
             {km:.3} km away"
        ),
        (Some(site), None) if id_at.is_none() => {
            format!("no site {site}, and no column {}", SITE[3])
        }
        (Some(site), None) => {
            format!("no site {site} among {all}, such as {names}")
        }
    };
    Err(fault(None, found, one))
}

/// Difference of two longitudes in degrees, the short way round.
fn away_deg(a: f64, b: f64) -> f64 {
    let away = (a - b).abs() % 360.0;
    away.min(360.0 - away)
}

/// Distance in km of two places (longitude, latitude) in degrees on a sphere,
/// by the haversine formula.
fn distance_km(a: (f64, f64), b: (f64, f64)) -> f64 {
    let half = |degrees: f64| sin(0.5 * degrees.to_radians());
    let across = sqrt(cos(a.1.to_radians()) * cos(b.1.to_radians()));
    let chord = hypot(half(a.1 - b.1), across * half(a.0 - b.0));
    2.0 * EARTH_KM * asin(chord.min(1.0))
}

/// The curve through points. `years` is `Some` for probabilities; it contains
/// the number of years if that is known.
fn made(
    mut points: Vec<Written>,
    years: Option<Option<f64>>,
    (im, units_per_im_unit): (HazardMeasure, f64),
) -> Result<Hazard, Faulty> {
    let mut remarks = Vec::new();
    if im == HazardMeasure::AverageSa {
        remarks.push(HazardRemark::Periods);
    }
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
            | HazardError::Frequency { number, .. }
            | HazardError::Range { number, .. } => {
                let line = points.get(*number - 1).map(|(line, ..)| *line);
                *number += certain;
                line
            }
            HazardError::Points(_) => None,
        };
        (line, error.into())
    })?;
    let large = |(x, frequency): &&(f64, f64)| {
        let limit = LARGE[usize::from(!(*frequency >= SELDOM))];
        im != HazardMeasure::Own && !(*x <= limit * units_per_im_unit)
    };
    let largest = pairs.iter().rev().find(large);
    remarks.extend(largest.map(|(x, _)| HazardRemark::Large(*x)));
    Ok(Hazard { curve, im, units_per_im_unit, remarks })
}

fn cells(line: &str) -> Vec<&str> {
    line.split(',').map(str::trim).collect()
}

/// The beginning of a text, as long as a message shows it.
fn beginning(text: &str) -> &str {
    text.char_indices().nth(60).map_or(text, |(end, _)| &text[..end])
}

fn number(line: usize, text: &str) -> Result<f64, Faulty> {
    let found = || format!("`{}`", beginning(text));
    text.parse().map_err(|_| fault(line, found(), "a number"))
}

/// The value behind `name` in a comment of OpenQuake, without its quotes.
fn said<'a>(comments: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = comments.split_once(name)?;
    let rest = rest.trim_start_matches(['\'', '"']);
    rest.split(['\'', '"', ',', '\n']).next().map(str::trim)
}

#[cfg(test)]
mod tests;
