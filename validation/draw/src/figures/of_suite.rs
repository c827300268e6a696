//! Charts of what a suite does to a block, each a function of that result.

use rocking::capacity::ResponseCurve;
use rocking::fragility::hazard::Hazard;
use rocking::fragility::risk::Contribution;
use rocking::intensity::IntensityMeasure;
use rocking::procedures::StripeResponses;
use rocking::procedures::fit::Band;
use rocking::statistics::Lognormal;

use super::{
    Chart, ChartAxis, ChartPanel, Heading, Look, Mark, Series, common,
};
use crate::colour::{Fill, Ink, Pen};
use crate::markup;
use crate::panel::Marker;

/// Intensities at which a fragility is drawn.
const LEVELS: u32 = 150;

/// The largest rotation over slenderness that is drawn.
const MOST_EDP: f64 = 1.2;

/// A fragility to draw, its intensities in one unit.
#[derive(Clone, Debug)]
pub struct Fragility {
    /// Its name.
    pub name: String,
    /// The fragility.
    pub fitted: Lognormal,
    /// Its band at the intensities where it is drawn; none: no band.
    pub band: Option<Band>,
    /// Intensities and shares of what it is fitted to.
    pub points: Vec<(f64, f64)>,
    /// Annual frequency of damage by intensity.
    pub contributions: Vec<Contribution>,
}

impl Fragility {
    /// A fragility without a band.
    #[must_use]
    pub fn new(name: impl Into<String>, fitted: Lognormal) -> Self {
        let (name, band) = (name.into(), None);
        let (points, contributions) = (Vec::new(), Vec::new());
        Self { name, fitted, band, points, contributions }
    }
}

/// Intensities at which fragilities are drawn: from 0 on.
#[must_use]
pub fn levels(all: &[Fragility]) -> Vec<f64> {
    let ends = all.iter().flat_map(|one| {
        let points = one.points.iter().map(|(x, _)| *x);
        points.chain([one.fitted.quantile(0.95)])
    });
    let last = ends.filter(|x| x.is_finite()).fold(0.0, f64::max);
    let step = 1.02 * last / f64::from(LEVELS);
    (0..=LEVELS).map(|k| step * f64::from(k)).collect()
}

/// Intensities at which fragilities are drawn under a hazard curve.
#[must_use]
pub fn levels_under(hazard: &Hazard) -> Vec<f64> {
    let points = hazard.curve.points();
    let (first, last) = (points[0].0, points[points.len() - 1].0);
    let step = libm::log(last / first) / f64::from(LEVELS);
    (0..=LEVELS).map(|k| first * libm::exp(step * f64::from(k))).collect()
}

/// The rotations of all records by intensity, and their quantiles.
fn responses(stripes: &[StripeResponses], mark: Mark) -> [Series; 3] {
    let quantile = |name: &str, of: fn(&StripeResponses) -> f64| {
        let im = stripes.iter().map(|s| s.intensity).collect();
        Series::new(name, mark, stripes.iter().map(of).collect(), im)
    };
    [
        quantile("16 %", |s| s.edp16),
        quantile("50 %", |s| s.edp50),
        quantile("84 % quantile", |s| s.edp84),
    ]
}

/// IDA curves and the quantiles of the rotation by intensity, as SVG; `block`
/// says of what, in markup.
#[must_use]
pub fn ida_svg(
    curves: &[ResponseCurve],
    stripes: &[StripeResponses],
    (intensity, block): (&str, &str),
) -> String {
    let one = |curve: &ResponseCurve| {
        let falls = curve.overturning_im().map(|im| (im, f64::INFINITY));
        let (im, edp) = curve.vertices().chain(falls).unzip();
        Series::of(Look::line(Pen::new(Ink::Muted, 0.3)), edp, im)
    };
    let mut series: Vec<Series> = curves.iter().map(one).collect();
    series.extend(responses(stripes, Mark::Line));
    let ends = stripes.first().zip(stripes.last());
    let ends = ends.map(|(a, b)| (a.intensity, b.intensity));
    let n = curves.len();
    let chart = Chart {
        heading: Heading::new(
            "ida",
            "IDA curves",
            format!(
                "Largest rotation over slenderness against intensity, of {n} \
                 records, and its 16, 50 and 84 % quantiles; a curve is level \
                 where the block overturns."
            ),
        ),
        panels: vec![ChartPanel::new(
            block,
            ChartAxis::linear(common::DEMAND, (0.0, MOST_EDP)),
            ChartAxis::linear(intensity, ends),
            series,
        )],
        columns: 1,
    };
    chart.thinned((560.0, 320.0)).figure(String::new()).svg()
}

/// Rotations at stripes with their quantiles, and the shares of the records
/// that overturn, as SVG.
#[must_use]
pub fn stripes_svg(
    curves: &[ResponseCurve],
    stripes: &[StripeResponses],
    intensity: &str,
) -> String {
    let dot = Look::marks(Marker::Dot, 1.5, Ink::Muted);
    let im: Vec<f64> = stripes.iter().map(|s| s.intensity).collect();
    let (x, y) = im
        .iter()
        .flat_map(|im| curves.iter().map(|c| (c.edp_at(*im), *im)))
        .filter_map(|(edp, im)| Some((edp?, im)))
        .filter(|(edp, _)| edp.is_finite())
        .unzip();
    let mut series = vec![Series::of(dot, x, y).labelled("a record")];
    series.extend(responses(stripes, Mark::LineAndPoints));
    let share = |s: &StripeResponses| s.overturned as f64 / s.n as f64;
    let shares = stripes.iter().map(share).collect();
    let overturned =
        Series::new("overturned", Mark::LineAndPoints, shares, im);
    let axis = || ChartAxis::linear(intensity, None::<(f64, f64)>);
    let chart = Chart {
        heading: Heading::new(
            "stripes",
            "Responses at stripes",
            "Largest rotation over slenderness at each intensity with its 16, \
             50 and 84 % quantiles, and the share of the records that \
             overturn the block.",
        ),
        panels: vec![
            ChartPanel::new(
                "Rotation where the block stands",
                ChartAxis::linear(common::DEMAND, (0.0, MOST_EDP)),
                axis(),
                series,
            ),
            ChartPanel::new(
                "Overturned",
                ChartAxis::linear("share of the records", (0.0, 1.0)),
                axis(),
                vec![overturned],
            ),
        ],
        columns: 2,
    };
    chart.figure(String::new()).svg()
}

/// Lines with bands, and the points that they are fitted to.
fn lines(all: &[Fragility], levels: &[f64]) -> Vec<Series> {
    let mut series = Vec::new();
    for (k, one) in all.iter().enumerate() {
        let mut x = levels.to_vec();
        let mut y: Vec<f64> = x.iter().map(|x| one.fitted.cdf(*x)).collect();
        let mut ends = Vec::new();
        let mut label = markup::escape(&one.name);
        if let Some(band) = &one.band {
            x = band.points.iter().map(|p| p.intensity).collect();
            y = band.points.iter().map(|p| p.probability).collect();
            let end = |x: Option<f64>| x.unwrap_or(f64::NAN);
            let points = band.points.iter();
            ends = points.map(|p| (end(p.low), end(p.high))).collect();
            label += ", 95 % band";
        }
        series.push(Series::new(label, Mark::Line, x, y).with(ends));
        let dots = Look::marks(Marker::of_series(k), 2.2, Ink::Series(k));
        let (x, y) = one.points.iter().copied().unzip();
        series.push(Series::of(dots, x, y));
    }
    series
}

/// Fragilities with what they are fitted to, as SVG; `marks` says what that
/// is.
#[must_use]
pub fn fragilities_svg(
    all: &[Fragility],
    intensity: &str,
    marks: &str,
) -> String {
    let levels = levels(all);
    let last = levels[levels.len() - 1];
    let chart = Chart {
        heading: Heading::new(
            "fragility",
            "Fragility",
            "Probability of damage against intensity: the fitted lognormal \
             distribution, its 95 % band where draws were asked for, and the \
             shares of the records.",
        ),
        panels: vec![ChartPanel::new(
            marks,
            ChartAxis::linear(markup::escape(intensity), (0.0, last)),
            ChartAxis::linear("probability of damage", (0.0, 1.0)),
            lines(all, &levels),
        )],
        columns: 1,
    };
    chart.figure(String::new()).svg()
}

/// A hazard curve, the fragilities under it, and the annual frequency of
/// damage by intensity, as SVG.
#[must_use]
pub fn risk_svg(hazard: &Hazard, all: &[Fragility]) -> String {
    let points = hazard.curve.points();
    let (x, y): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
    let range = x.first().copied().zip(x.last().copied());
    let axis = || ChartAxis::logarithmic(intensity(hazard), range);
    let mut parts = Vec::new();
    for (k, one) in all.iter().enumerate() {
        let edges = x.clone();
        let rates = one.contributions.iter().map(|c| c.annual_frequency);
        let look = Look {
            bins: Some(Fill::tint(Ink::Series(k), 20)),
            pen: Some(Pen::of_series(k)),
            ..Look::default()
        };
        parts.push(Series::of(look, edges, rates.collect()));
    }
    let rates = all.iter().flat_map(|one| &one.contributions);
    let most = rates.map(|c| c.annual_frequency).fold(0.0, f64::max);
    let chart = Chart {
        heading: Heading::new(
            "risk",
            "Hazard, fragility and risk",
            "Annual frequency of exceedance of the intensity; probability of \
             damage; annual frequency of damage by motions between two points \
             of the hazard curve.",
        ),
        panels: vec![
            ChartPanel::new(
                "Hazard",
                axis(),
                ChartAxis::logarithmic("exceeded, 1/year", None::<(f64, f64)>),
                vec![Series::of(
                    Look {
                        pen: Some(Pen::new(Ink::Text, 1.2)),
                        marker: Some((Marker::Dot, 2.0, Ink::Text)),
                        ..Look::default()
                    },
                    x,
                    y,
                )],
            ),
            ChartPanel::new(
                "Fragility",
                axis(),
                ChartAxis::linear("probability of damage", (0.0, 1.0)),
                lines(all, &levels_under(hazard)),
            ),
            ChartPanel::new(
                "Damage by intensity",
                axis(),
                ChartAxis::linear("damage, 1/year", (0.0, 1.05 * most)),
                parts,
            ),
        ],
        columns: 3,
    };
    chart.figure(String::new()).svg()
}

/// The intensity of a hazard curve with its unit, as an axis label.
fn intensity(hazard: &Hazard) -> String {
    let symbol = match &hazard.im {
        None => return "intensity, unit of the fragility".to_owned(),
        Some(IntensityMeasure::Pga) => "PGA",
        Some(IntensityMeasure::Pgv) => "PGV",
        Some(other) => return markup::escape(&other.words()),
    };
    format!("{symbol} ({})", hazard.unit())
}
