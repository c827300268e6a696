//! Charts of what a suite does to a block, each a function of that result,
//! which is asked for its values at the intensities that are drawn.

use rocking::capacity::ResponseCurve;
use rocking_procedures::fragility::hazard::{Hazard, HazardMeasure};
use rocking_procedures::{FragilityInput, StripeResponses};
use rocking_records::intensity::IntensityMeasure as M;

use super::{Chart, ChartAxis, ChartPanel, Look, Mark, Series, common};
use crate::colour::{Fill, Ink, Pen};
use crate::markup;
use crate::panel::Marker;

/// Steps of intensity in which a fragility is drawn.
const STEPS: u32 = 150;

/// The largest rotation over slenderness that is drawn.
const MOST_EDP: f64 = 1.2;

/// A chart as SVG, of panels side by side.
fn svg(heading: [&str; 3], panels: Vec<ChartPanel>) -> String {
    let chart = Chart::of(heading, panels).thinned((560.0, 320.0));
    chart.figure(String::new()).svg()
}

/// Quantiles of the rotation over slenderness by intensity.
fn quantiles(stripes: &[StripeResponses], mark: Mark) -> [Series; 3] {
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

/// IDA curves with the quantiles of the rotation by intensity, as SVG;
/// `block` says of what, in markup.
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
    series.extend(quantiles(stripes, Mark::Line));
    let ends = stripes.first().zip(stripes.last());
    let ends = ends.map(|(a, b)| (a.intensity, b.intensity));
    let x = ChartAxis::linear(common::DEMAND, (0.0, MOST_EDP));
    let y = ChartAxis::linear(intensity, ends);
    let n = curves.len();
    let words = format!(
        "Largest rotation divided by slenderness against intensity, {n} \
         records, and its quantiles; a curve is level at overturning."
    );
    let panel = ChartPanel::new(block, x, y, series);
    svg(["ida", "IDA curves", &words], vec![panel])
}

/// Rotations at stripes with their quantiles, and the shares of the records
/// that overturn, as SVG.
pub fn stripes_svg(
    curves: &[ResponseCurve],
    stripes: &[StripeResponses],
    intensity: &str,
) -> String {
    let im: Vec<f64> = stripes.iter().map(|s| s.intensity).collect();
    let each = im.iter().flat_map(|im| curves.iter().map(|c| (c, *im)));
    let stands = each.filter_map(|(c, im)| Some((c.edp_at(im)?, im)));
    let (x, y) = stands.filter(|(edp, _)| edp.is_finite()).unzip();
    let dot = Look::marks(Marker::Dot, 1.5, Ink::Muted);
    let mut series = vec![Series::of(dot, x, y).labelled("a record")];
    series.extend(quantiles(stripes, Mark::LineAndPoints));
    let all_run = stripes.iter().filter(|s| s.open == 0);
    let share = |s: &StripeResponses| s.overturned as f64 / s.n as f64;
    let (shares, im) = all_run.map(|s| (share(s), s.intensity)).unzip();
    let shares = Series::new("overturned", Mark::LineAndPoints, shares, im);
    let panel = |title, label, last, series| {
        let y = ChartAxis::linear(intensity, None::<(f64, f64)>);
        ChartPanel::new(
            title,
            ChartAxis::linear(label, (0.0, last)),
            y,
            series,
        )
    };
    let rotation = "Rotation if the block stands";
    let words = "Largest rotation divided by slenderness at each intensity, \
                 its quantiles, and the share of the records that overturn.";
    svg(
        ["stripes", "Responses at stripes", words],
        vec![
            panel(rotation, common::DEMAND, MOST_EDP, series),
            panel("Overturned", "share of the records", 1.0, vec![shares]),
        ],
    )
}

/// The lines of fragilities at these intensities, with their bands.
fn lines(all: &[FragilityInput], levels: &[f64]) -> Vec<Series> {
    let line = |one: &FragilityInput| {
        let label = markup::escape(&one.fragility);
        let y = levels.iter().map(|im| one.fitted.cdf(*im)).collect();
        let line = Series::new(&*label, Mark::Line, levels.to_vec(), y);
        let Some(sampled) = &one.sampled else { return line };
        let band = sampled.band(&one.fitted, levels);
        let points = band.points.iter();
        line.with(points.map(|p| p.probability.ends()).collect())
            .labelled(label + ", 95 % band")
    };
    all.iter().map(line).collect()
}

/// Fragilities with what each is fitted to, as SVG: intensities and shares;
/// `marks` says what that is.
pub fn fragilities_svg(
    all: &[FragilityInput],
    points: &[Vec<(f64, f64)>],
    (intensity, marks): (&str, &str),
) -> String {
    let fitted = all.iter().map(|one| one.fitted.quantile(0.95));
    let seen = points.iter().flatten().map(|(im, _)| *im);
    let last = 1.02 * fitted.chain(seen).fold(0.0, f64::max);
    let step = last / f64::from(STEPS);
    let levels: Vec<f64> = (0..=STEPS).map(|k| step * f64::from(k)).collect();
    let mut series = lines(all, &levels);
    for (k, points) in points.iter().enumerate() {
        let dots = Look::marks(Marker::of_series(k), 2.2, Ink::Series(k));
        let (x, y) = points.iter().copied().unzip();
        series.push(Series::of(dots, x, y));
    }
    let x = ChartAxis::linear(markup::escape(intensity), (0.0, last));
    let y = ChartAxis::linear("probability of damage", (0.0, 1.0));
    let words = "Probability of damage against intensity: the fitted \
                 distribution, its band if requested, and the data it is \
                 fitted to.";
    let panel = ChartPanel::new(marks, x, y, series);
    svg(["fragility", "Fragility", words], vec![panel])
}

/// A hazard curve, the fragilities under it, and the annual frequency of
/// damage by intensity, as SVG.
pub fn risk_svg(hazard: &Hazard, all: &[FragilityInput]) -> String {
    let points = hazard.curve.points();
    let (first, last) = (points[0].0, points[points.len() - 1].0);
    let step = libm::log(last / first) / f64::from(STEPS);
    let at = |k: u32| first * libm::exp(step * f64::from(k));
    let levels: Vec<f64> = (0..=STEPS).map(at).collect();
    let (x, y): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
    let part = |(k, one): (usize, &FragilityInput)| {
        let parts = hazard.curve.contributions(one.fitted);
        let look = Look {
            bins: Some(Fill::tint(Ink::Series(k), 20)),
            ..Look::line(Pen::of_series(k))
        };
        let rates = parts.iter().map(|part| part.annual_frequency);
        Series::of(look, x.clone(), rates.collect())
    };
    let parts: Vec<Series> = all.iter().enumerate().map(part).collect();
    let most = parts.iter().flat_map(|s| &s.y).fold(0.0, |a, b| b.max(a));
    let curve = Look {
        marker: Some((Marker::Dot, 2.0, Ink::Text)),
        ..Look::line(Pen::new(Ink::Text, 1.2))
    };
    let curve = Series::of(curve, x.clone(), y);
    let panel = |title, y: ChartAxis, series| {
        let x = ChartAxis::logarithmic(intensity(hazard), (first, last));
        ChartPanel::new(title, x, y, series)
    };
    let exceeded =
        ChartAxis::logarithmic("exceeded, 1/year", None::<(f64, f64)>);
    let probability = ChartAxis::linear("probability of damage", (0.0, 1.0));
    let damage = ChartAxis::linear("damage, 1/year", (0.0, 1.05 * most));
    let words = "Annual frequency at which an intensity is exceeded; \
                 probability of damage; annual frequency of damage between \
                 two points of the hazard curve.";
    svg(
        ["risk", "Hazard, fragility and risk", words],
        vec![
            panel("Hazard", exceeded, vec![curve]),
            panel("Fragility", probability, lines(all, &levels)),
            panel("Damage by intensity", damage, parts),
        ],
    )
}

/// The intensity of a hazard curve with its unit, as an axis label.
fn intensity(hazard: &Hazard) -> String {
    match &hazard.im {
        HazardMeasure::Own => "intensity, unit of the fragility".to_owned(),
        HazardMeasure::Of(M::Axis(im)) => {
            format!("{} ({})", im.row().symbol, hazard.unit())
        }
        HazardMeasure::Of(other) => markup::escape(&other.words()),
        HazardMeasure::AverageSa => format!("AvgSA ({})", hazard.unit()),
    }
}
