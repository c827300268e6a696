//! Figures 15 to 18: empirical and fitted fragilities.

use super::{Figure, Heading, common};
use crate::draw::{
    Axis, Dash, Entry, Grid, Horizontal, Ink, Marker, Panel, Pen, Sample,
    Scene,
};
use crate::paper::Intensity;
use crate::table::{Table, number};
use crate::words::{letter, named};
use rocking::statistics::Lognormal;

/// Empirical and fitted fragilities.
#[derive(Debug, Clone, PartialEq)]
pub struct Fragilities {
    /// The words.
    pub heading: Heading,
    /// One panel an intensity measure: (a) PGA, (b) PGV.
    pub panels: Vec<FragilityPanel>,
}

/// One intensity measure.
#[derive(Debug, Clone, PartialEq)]
pub struct FragilityPanel {
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// The thresholds, a colour each.
    pub thresholds: Vec<Threshold>,
}

/// One demand threshold.
#[derive(Debug, Clone, PartialEq)]
pub struct Threshold {
    /// Demand, peak |theta|/alpha.
    pub edp: f64,
    /// Capacities of all records, +infinity where the threshold was never
    /// reached; the ECDF divides by the length.
    pub sample: Vec<f64>,
    /// Fitted curves, a dash each.
    pub curves: Vec<Fitted>,
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
}

/// The constant c of Eq. 7 compared, against a benchmark.
#[derive(Debug, Clone, PartialEq)]
pub struct ByConstant {
    /// The words.
    pub heading: Heading,
    /// Kind of the intensity.
    pub intensity: Intensity,
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
    /// USFL7 by c.
    pub curves: Vec<ConstantCurve>,
}

/// One constant.
#[derive(Debug, Clone, PartialEq)]
pub struct ConstantCurve {
    /// The constant.
    pub c: f64,
    /// USFL7; none where Eq. 7 is not defined.
    pub curve: Option<Lognormal>,
}

impl Fragilities {
    /// The figure, with a sentence that says what one sees in it.
    #[must_use]
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `panel,im_kind,edp,curve,quantity,value`: the sample (`ecdf`), and
    /// the parameters of each fitted curve.
    fn csv(&self) -> String {
        let mut table =
            Table::headed("panel,im_kind,edp,curve,quantity,value");
        for (i, panel) in self.panels.iter().enumerate() {
            for threshold in &panel.thresholds {
                let mut row = |curve: &str, quantity: &str, value| {
                    table.row([
                        letter(i),
                        panel.intensity.name().into(),
                        number(threshold.edp),
                        curve.into(),
                        quantity.into(),
                        number(value),
                    ]);
                };
                for im in &threshold.sample {
                    row("ECDF", "im", *im);
                }
                for fit in &threshold.curves {
                    parameters(fit.curve.as_ref(), |quantity, value| {
                        row(fit.estimator.name(), quantity, value);
                    });
                }
            }
        }
        table.finish()
    }
}

impl ByConstant {
    /// The figure, with a sentence that says what one sees in it.
    #[must_use]
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, by_constant(self), self.csv(), reading)
    }

    /// `panel,title,im_kind,edp,curve,c,quantity,value`.
    fn csv(&self) -> String {
        let mut table =
            Table::headed("panel,title,im_kind,edp,curve,c,quantity,value");
        for (i, panel) in self.panels.iter().enumerate() {
            let mut row = |curve: &str, c: f64, quantity: &str, value| {
                table.row([
                    letter(i),
                    panel.title.clone(),
                    self.intensity.name().into(),
                    number(self.edp),
                    curve.into(),
                    number(c),
                    quantity.into(),
                    number(value),
                ]);
            };
            for im in &panel.sample {
                row("ECDF", f64::NAN, "im", *im);
            }
            parameters(panel.benchmark.as_ref(), |quantity, value| {
                row("SSFL", f64::NAN, quantity, value);
            });
            for fit in &panel.curves {
                parameters(fit.curve.as_ref(), |quantity, value| {
                    row("USFL7", fit.c, quantity, value);
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

const SIZE: (f64, f64) = (440.0, 290.0);

fn dash(estimator: Estimator) -> Dash {
    match estimator {
        Estimator::Usfl => Dash::Solid,
        Estimator::Ssfl => Dash::Dashed,
        Estimator::Usfl7 => Dash::Short,
    }
}

fn scene(figure: &Fragilities) -> Scene {
    let thresholds = || figure.panels.iter().flat_map(|p| &p.thresholds);
    let mut levels: Vec<f64> = thresholds().map(|t| t.edp).collect();
    levels.sort_by(f64::total_cmp);
    levels.dedup();
    let mut estimators: Vec<Estimator> =
        thresholds().flat_map(|t| &t.curves).map(|c| c.estimator).collect();
    estimators.sort();
    estimators.dedup();
    let mut legend: Vec<Entry> = levels
        .iter()
        .enumerate()
        .map(|(k, edp)| {
            let sample = Sample::Mark(marker(k), ink(k));
            Entry::new(sample, format!("ECDF, *θ̃* = {edp:.2}"))
        })
        .collect();
    for estimator in &estimators {
        let pen = Pen::new(Ink::Text, 1.2).dash(dash(*estimator));
        legend.push(Entry::new(Sample::Line(pen), estimator.name()));
    }
    let grid = Grid::new(figure.panels.len(), 2).plot(SIZE.0, SIZE.1);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let samples = shown.thresholds.iter().map(|t| t.sample.as_slice());
        let mut panel =
            axes(&mut scene, &grid, i, shown.intensity, end(samples));
        let missing = draw_panel(&mut panel, shown, &levels);
        for (k, words) in missing.iter().enumerate() {
            let down = 0.95 - 0.05 * k as f64;
            panel.note(words.as_str(), (0.985, down), Horizontal::Right);
        }
        let name = match shown.intensity {
            Intensity::Pga => "dimensionless PGA",
            Intensity::Pgv => "dimensionless PGV",
        };
        panel.finish(&common::panel_title(i, name), "");
    }
    scene
}

fn ink(threshold: usize) -> Ink {
    Ink::Series([0, 2, 3][threshold % 3])
}

fn marker(threshold: usize) -> Marker {
    [Marker::Dot, Marker::Square, Marker::Triangle][threshold % 3]
}

fn axes<'s>(
    scene: &'s mut Scene,
    grid: &Grid,
    panel: usize,
    intensity: Intensity,
    end: f64,
) -> Panel<'s> {
    let x = Axis::around(0.0, end, 7).label(common::intensity(intensity));
    let y = Axis::linear(0.0, 1.0, 5).label("probability of exceedance");
    Panel::new(scene, grid.frame(panel), x, y)
}

/// End of the intensity axis: where the last of the samples has 97 % of its
/// data, or its last finite datum.
fn end<'a>(samples: impl Iterator<Item = &'a [f64]>) -> f64 {
    let mut end = 1.0_f64;
    for sample in samples {
        let mut sorted = sample.to_vec();
        sorted.sort_by(f64::total_cmp);
        let most = (0.97 * sorted.len() as f64) as usize;
        let upper = &sorted[..sorted.len().min(most + 1)];
        let last = upper.iter().rev().find(|x| x.is_finite());
        end = end.max(last.copied().unwrap_or(1.0));
    }
    1.02 * end
}

/// Draws the curves; gives words for those that do not exist.
fn draw_panel(
    panel: &mut Panel<'_>,
    shown: &FragilityPanel,
    levels: &[f64],
) -> Vec<String> {
    let mut missing = Vec::new();
    for threshold in &shown.thresholds {
        let k = levels.iter().position(|l| *l == threshold.edp).unwrap_or(0);
        draw_sample(panel, &threshold.sample, marker(k), ink(k));
        for fit in &threshold.curves {
            match &fit.curve {
                Some(curve) => {
                    let pen = Pen::new(ink(k), 1.2).dash(dash(fit.estimator));
                    draw_curve(panel, curve, pen);
                }
                None => missing.push(format!(
                    "{} is not defined at *θ̃* = {:.2}",
                    fit.estimator.name(),
                    threshold.edp
                )),
            }
        }
    }
    missing
}

/// Dots of the ECDF.
fn draw_sample(
    panel: &mut Panel<'_>,
    sample: &[f64],
    marker: Marker,
    ink: Ink,
) {
    let mut sorted = sample.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len() as f64;
    let dots =
        sorted.iter().enumerate().map(|(i, x)| (*x, (i + 1) as f64 / n));
    panel.marks(dots, marker, 1.7, ink);
}

fn draw_curve(panel: &mut Panel<'_>, curve: &Lognormal, pen: Pen) {
    let (low, high) = panel.horizontal_range();
    let step = (high - low) / 300.0;
    let at = |i| step.mul_add(f64::from(i), low);
    let points = (0..=300).map(|i| (at(i), curve.cdf(at(i))));
    panel.line(points, pen);
}

fn by_constant(figure: &ByConstant) -> Scene {
    let mut constants: Vec<f64> =
        figure.panels.iter().flat_map(|p| &p.curves).map(|c| c.c).collect();
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
    let grid = Grid::new(figure.panels.len(), 2).plot(SIZE.0, SIZE.1);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    let reach =
        figure.panels.iter().flat_map(|p| p.benchmark.as_ref()).map(|f| {
            f.shift()
                + libm::exp(2.0_f64.mul_add(f.dispersion(), f.log_mean()))
        });
    let samples = figure.panels.iter().map(|p| p.sample.as_slice());
    let high = common::span(reach, true).map_or(1.0, |(_, high)| high);
    let end = end(samples).max(high);
    for (i, shown) in figure.panels.iter().enumerate() {
        let mut panel = axes(&mut scene, &grid, i, figure.intensity, end);
        draw_sample(&mut panel, &shown.sample, Marker::Dot, Ink::Muted);
        if let Some(curve) = &shown.benchmark {
            draw_curve(&mut panel, curve, benchmark);
        }
        let mut missing = Vec::new();
        for fit in &shown.curves {
            let k = constants.iter().position(|c| *c == fit.c).unwrap_or(0);
            match &fit.curve {
                Some(curve) => draw_curve(&mut panel, curve, pen(k)),
                None => missing.push(fit.c.to_string()),
            }
        }
        if !missing.is_empty() {
            let words =
                format!("not defined for *c* = {}", missing.join(", "));
            panel.note(words, (0.985, 0.95), Horizontal::Right);
        }
        let title = format!(
            "{}, *θ̃* = {:.2}",
            common::words(&shown.title),
            figure.edp
        );
        panel.finish(&common::panel_title(i, &title), "");
    }
    scene
}
