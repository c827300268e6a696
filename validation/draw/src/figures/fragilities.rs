//! Figures 15 to 18: empirical and fitted fragilities.

use super::common;
use super::heading::{Figure, Heading};
use crate::axis::Axis;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::panel::{Marker, Panel};
use crate::scene::Scene;
use crate::text::Horizontal;
use rocking::statistics::Lognormal;
use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number, point};
use rocking_common::words::{letter, named};

/// Empirical and fitted fragilities.
#[derive(Debug, Clone, PartialEq)]
pub struct Fragilities {
    /// The words.
    pub heading: Heading,
    /// Row by row: (a) PGA, (b) PGV; a panel a demand threshold.
    pub panels: Vec<FragilityPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One demand threshold in one intensity measure.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityPanel {
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// Demand, peak |theta|/alpha.
    pub edp: f64,
    /// Capacities of all records, +infinity where the threshold was never
    /// reached; the ECDF divides by the length.
    pub sample: Vec<f64>,
    /// Fitted curves, a colour and dash each.
    pub curves: Vec<Fitted>,
    /// The fragility that one of the curves is held against.
    pub limit: Option<Limit>,
    /// What decides, a line each, in markup.
    pub notes: Vec<String>,
}

/// How far a curve may be from another.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// The other one.
    pub around: Lognormal,
    /// Largest distance in probability.
    pub by: f64,
}

named! {
    /// How a fitted fragility was obtained.
    pub enum Estimator {
        /// Lognormal fitted to the unshifted sample.
        Usfl = "USFL",
        /// Lognormal fitted to the shifted sample.
        Ssfl = "SSFL",
        /// The unshifted fit transformed by Eq. 7.
        Usfl7 = "USFL7",
    }
}

/// A fitted fragility, or why there is none.
#[derive(Debug, Clone, PartialEq)]
pub struct Fitted {
    /// How it was obtained.
    pub estimator: Estimator,
    /// The curve; none where the fit or Eq. 7 is not defined.
    pub curve: Option<Lognormal>,
    /// Intensity, and both ends of the 95 % band there.
    pub band: Vec<(f64, f64, f64)>,
    /// What the band is of.
    pub band_of: BandOf,
}

/// What a band holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BandOf {
    /// The curve itself.
    Curve,
    /// The curve's difference to the SSFL, laid on the SSFL: the curve need
    /// not lie in it.
    DifferenceToSsfl,
}

impl BandOf {
    fn words(self, estimator: Estimator) -> String {
        let name = estimator.name();
        match self {
            Self::Curve => format!("95 % band of {name}"),
            Self::DifferenceToSsfl => {
                format!("SSFL + 95 % band of {name} \u{2212} SSFL")
            }
        }
    }

    /// Names of the ends in the CSV.
    fn ends(self) -> [&'static str; 2] {
        match self {
            Self::Curve => ["band_low", "band_high"],
            Self::DifferenceToSsfl => {
                ["ssfl_plus_difference_low", "ssfl_plus_difference_high"]
            }
        }
    }
}

/// The constant c of Eq. 7 compared, against a benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct ByConstant {
    /// The words.
    pub heading: Heading,
    /// Demand threshold.
    pub edp: f64,
    /// (a) untrimmed, (b) trimmed.
    pub panels: Vec<ByConstantPanel>,
}

/// One way of fitting.
#[derive(Debug, Clone, PartialEq)]
pub struct ByConstantPanel {
    /// Panel title: `untrimmed MLE`.
    pub title: String,
    /// The SSFL fragility.
    pub benchmark: Option<Lognormal>,
    /// Capacities for the ECDF, or nothing.
    pub sample: Vec<f64>,
    /// The constant c, and its USFL7; none where Eq. 7 is not defined.
    pub curves: Vec<(f64, Option<Lognormal>)>,
}

impl Fragilities {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `panel,im,edp,curve,quantity,at,value`: the sample (`ecdf`),
    /// the parameters of each fitted curve, its band at an intensity.
    fn csv(&self) -> String {
        let mut table = Table::headed("panel,im,edp,curve,quantity,at,value");
        for (i, panel) in self.panels.iter().enumerate() {
            let mut row = |curve: &str, quantity: &str, at: f64, value| {
                table.row([
                    letter(i / self.columns.max(1)),
                    panel.intensity.name().into(),
                    number(panel.edp),
                    curve.into(),
                    quantity.into(),
                    point(at),
                    number(value),
                ]);
            };
            for im in &panel.sample {
                row("ECDF", "intensity", f64::NAN, *im);
            }
            for fit in &panel.curves {
                let name = fit.estimator.name();
                parameters(fit.curve.as_ref(), |quantity, value| {
                    row(name, quantity, f64::NAN, value);
                });
                let [low_end, high_end] = fit.band_of.ends();
                for (im, low, high) in &fit.band {
                    row(name, low_end, *im, *low);
                    row(name, high_end, *im, *high);
                }
            }
            if let Some(limit) = &panel.limit {
                parameters(Some(&limit.around), |quantity, value| {
                    row("SSFL", quantity, f64::NAN, value);
                });
                row("SSFL", "limit", f64::NAN, limit.by);
            }
        }
        table.finish()
    }
}

impl ByConstant {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, by_constant(self), self.csv(), reading)
    }

    /// `panel,title,im,edp,curve,c,quantity,value`.
    fn csv(&self) -> String {
        let mut table =
            Table::headed("panel,title,im,edp,curve,c,quantity,value");
        for (i, panel) in self.panels.iter().enumerate() {
            let mut row = |curve: &str, c: f64, quantity: &str, value| {
                table.row([
                    letter(i),
                    panel.title.clone(),
                    Intensity::Pga.name().into(),
                    number(self.edp),
                    curve.into(),
                    number(c),
                    quantity.into(),
                    number(value),
                ]);
            };
            for im in &panel.sample {
                row("ECDF", f64::NAN, "intensity", *im);
            }
            parameters(panel.benchmark.as_ref(), |quantity, value| {
                row("SSFL", f64::NAN, quantity, value);
            });
            for (c, curve) in &panel.curves {
                parameters(curve.as_ref(), |quantity, value| {
                    row("USFL7", *c, quantity, value);
                });
            }
        }
        table.finish()
    }
}

/// Hands on each parameter of a fit; NaN for a fit that is not defined.
fn parameters(fit: Option<&Lognormal>, mut row: impl FnMut(&str, f64)) {
    let of = |value: fn(&Lognormal) -> f64| fit.map_or(f64::NAN, value);
    row("ln_median", of(Lognormal::log_mean));
    row("dispersion", of(Lognormal::dispersion));
    row("shift", of(Lognormal::shift));
}

const LIMIT: Fill = Fill::tint(Ink::Muted, 30);
const BAND_PERCENT: u8 = 26;

fn pen(estimator: Estimator) -> Pen {
    let (series, dash) = match estimator {
        Estimator::Usfl => (0, Dash::Solid),
        Estimator::Ssfl => (2, Dash::Dashed),
        Estimator::Usfl7 => (1, Dash::Dashed),
    };
    Pen::new(Ink::Series(series), 1.4).dash(dash)
}

fn scene(figure: &Fragilities) -> Scene {
    let fits = || figure.panels.iter().flat_map(|p| &p.curves);
    let mut estimators: Vec<Estimator> = fits().map(|c| c.estimator).collect();
    estimators.sort();
    estimators.dedup();
    let dots = Sample::Mark(Marker::Dot, Ink::Muted);
    let mut legend = vec![Entry::new(dots, "empirical fragility (ECDF)")];
    for estimator in &estimators {
        let sample = Sample::Line(pen(*estimator));
        legend.push(Entry::new(sample, estimator.name()));
    }
    for estimator in &estimators {
        let own = |f: &&Fitted| f.estimator == *estimator;
        let drawn = |f: &&Fitted| !f.band.is_empty();
        if let Some(fit) = fits().filter(own).find(drawn) {
            let fill = Fill::tint(pen(*estimator).ink, BAND_PERCENT);
            let words = fit.band_of.words(*estimator);
            legend.push(Entry::new(Sample::Band(fill), words));
        }
    }
    if let Some(limit) = figure.panels.iter().find_map(|p| p.limit) {
        let words = format!("limit: SSFL ± {}", limit.by);
        legend.push(Entry::new(Sample::Band(LIMIT), words));
    }
    let grid = Grid::new(figure.panels.len(), figure.columns);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let (low, high) = Fragilities::range(&shown.sample);
        let x = Axis::linear(low, high, 5)
            .label(common::intensity(shown.intensity));
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, exceedance());
        draw_panel(&mut panel, shown);
        let name = shown.intensity.name().to_uppercase();
        let words = format!("{name}, *θ̃* = {:.2}", shown.edp);
        let row = i / grid.columns;
        panel.finish(&common::panel_title(row, &words), "");
    }
    scene
}

fn exceedance() -> Axis {
    Axis::linear(0.0, 1.0, 5).label("probability of exceedance")
}

/// What 97 % of the data do not exceed, or the last finite datum below.
fn most_of(sample: &[f64]) -> Option<f64> {
    let mut sorted = sample.to_vec();
    sorted.sort_by(f64::total_cmp);
    let most = (0.97 * sorted.len() as f64) as usize;
    let upper = &sorted[..sorted.len().min(most + 1)];
    upper.iter().rev().find(|x| x.is_finite()).copied()
}

impl Fragilities {
    /// Ends of a panel's intensity axis: from below the least datum to what
    /// 97 % of the data do not exceed.
    pub fn range(sample: &[f64]) -> (f64, f64) {
        let data = sample.iter().copied();
        let (least, _) = common::span(data, true).unwrap_or((1.0, 2.0));
        let most = most_of(sample).filter(|x| *x > least);
        (0.6 * least, 1.05 * most.unwrap_or(2.0 * least))
    }
}

/// Draws the bands, then the sample, then the curves.
fn draw_panel(panel: &mut Panel<'_>, shown: &FragilityPanel) {
    if let Some(limit) = &shown.limit {
        let along = along(panel);
        let rows: Vec<_> = along
            .map(|x| (x, limit.around.cdf(x)))
            .map(|(x, p)| (x, p - limit.by, p + limit.by))
            .collect();
        panel.band(&rows, LIMIT);
    }
    for fit in &shown.curves {
        let fill = Fill::tint(pen(fit.estimator).ink, BAND_PERCENT);
        panel.band(&fit.band, fill);
    }
    draw_sample(panel, &shown.sample);
    let mut notes = shown.notes.clone();
    for fit in &shown.curves {
        match &fit.curve {
            Some(curve) => draw_curve(panel, curve, pen(fit.estimator)),
            None => {
                let name = fit.estimator.name();
                notes.push(format!("{name} is not defined"));
            }
        }
    }
    for (k, words) in notes.iter().rev().enumerate() {
        let down = 0.96 - 0.06 * k as f64;
        panel.note(words.as_str(), (0.985, down), Horizontal::Right);
    }
}

/// Dots of the ECDF.
fn draw_sample(panel: &mut Panel<'_>, sample: &[f64]) {
    let mut sorted = sample.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let dots =
        sorted.iter().enumerate().map(|(i, x)| (*x, (i + 1) as f64 / n));
    panel.marks(dots, Marker::Dot, 1.7, Ink::Muted);
}

fn draw_curve(panel: &mut Panel<'_>, curve: &Lognormal, pen: Pen) {
    let points: Vec<_> = along(panel).map(|x| (x, curve.cdf(x))).collect();
    panel.line(points, pen);
}

/// Intensities from one end of the axis to the other.
fn along(panel: &Panel<'_>) -> impl Iterator<Item = f64> + use<> {
    let (low, high) = panel.horizontal_range();
    let step = (high - low) / 300.0;
    (0..=300).map(move |i| step.mul_add(f64::from(i), low))
}

fn by_constant(figure: &ByConstant) -> Scene {
    let mut constants: Vec<f64> =
        figure.panels.iter().flat_map(|p| &p.curves).map(|c| c.0).collect();
    constants.sort_by(f64::total_cmp);
    constants.dedup();
    let pen = |k: usize| {
        let dashes = [Dash::Dotted, Dash::Dashed, Dash::DashDot, Dash::Long];
        Pen::new(Ink::Series(k), 1.3).dash(dashes[k % 4])
    };
    let benchmark = Pen::new(Ink::Text, 1.3);
    let mut legend = Vec::new();
    if figure.panels.iter().any(|p| !p.sample.is_empty()) {
        let dots = Sample::Mark(Marker::Dot, Ink::Muted);
        legend.push(Entry::new(dots, "ECDF"));
    }
    legend.push(Entry::new(Sample::Line(benchmark), "SSFL"));
    for (k, c) in constants.iter().enumerate() {
        let words = format!("USFL7, *c* = {c}");
        legend.push(Entry::new(Sample::Line(pen(k)), words));
    }
    let grid = Grid::new(figure.panels.len(), 2).plot(440.0, 290.0);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    let reach =
        figure.panels.iter().flat_map(|p| p.benchmark.as_ref()).map(|f| {
            f.shift()
                + libm::exp(2.0_f64.mul_add(f.dispersion(), f.log_mean()))
        });
    let most = figure.panels.iter().filter_map(|p| most_of(&p.sample));
    let high = common::span(reach, true).map_or(1.0, |(_, high)| high);
    let end = (1.02 * most.fold(1.0, f64::max)).max(high);
    for (i, shown) in figure.panels.iter().enumerate() {
        let x =
            Axis::around(0.0, end, 7).label(common::intensity(Intensity::Pga));
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, exceedance());
        draw_sample(&mut panel, &shown.sample);
        if let Some(curve) = &shown.benchmark {
            draw_curve(&mut panel, curve, benchmark);
        }
        let mut missing = Vec::new();
        for (c, curve) in &shown.curves {
            let k = constants.iter().position(|k| k == c).unwrap_or(0);
            match curve {
                Some(curve) => draw_curve(&mut panel, curve, pen(k)),
                None => missing.push(c.to_string()),
            }
        }
        if !missing.is_empty() {
            let words =
                format!("not defined for *c* = {}", missing.join(", "));
            panel.note(words, (0.985, 0.95), Horizontal::Right);
        }
        let words = common::words(&shown.title);
        let title = format!("{words}, *θ̃* = {:.2}", figure.edp);
        panel.finish(&common::panel_title(i, &title), "");
    }
    scene
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_that_is_laid_on_another_curve_is_named_so() {
        let curve = BandOf::Curve.words(Estimator::Usfl7);
        assert_eq!(curve, "95 % band of USFL7");
        let laid = BandOf::DifferenceToSsfl.words(Estimator::Usfl7);
        assert!(laid.starts_with("SSFL + "), "{laid}");
        assert!(laid.ends_with("USFL7 \u{2212} SSFL"), "{laid}");
        assert_ne!(BandOf::Curve.ends(), BandOf::DifferenceToSsfl.ends());
    }
}
