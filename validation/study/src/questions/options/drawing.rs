//! The figure of the options.

use rocking_procedures::fragility::options::{CONSTANTS, Centre, Recipe};
use rocking_statistics::QuantileType;
use rocking_statistics::lognormal::FitMethod;

use crate::fits::{MLE, trimmed};
use crate::words::heading;
use rocking_common::paper::{Arm, Intensity};
use rocking_common::words::range;
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Mark, Series,
};

/// One recipe over all blocks and thresholds.
pub(super) struct RecipeSummary {
    pub(super) recipe: Recipe,
    pub(super) intensity: Intensity,
    /// Share of the fits that are defined.
    pub(super) defined: f64,
    /// Median and largest Kolmogorov distance.
    pub(super) ks: f64,
    pub(super) largest: f64,
    /// Median area distance.
    pub(super) area: f64,
}

impl RecipeSummary {
    /// The summary of a recipe in an intensity measure.
    pub(super) fn find(
        all: &[Self],
        recipe: Recipe,
        im: Intensity,
    ) -> Option<&Self> {
        all.iter().find(|s| s.recipe == recipe && s.intensity == im)
    }
}

/// Median distance over blocks and demands against the constant of Eq. 7.
pub(super) fn figure(summaries: &[RecipeSummary], arm: Arm) -> Figure {
    let quantile_type = QuantileType::default();
    let panel = |intensity: Intensity| {
        let ks = |recipe: Recipe| {
            let found = RecipeSummary::find(summaries, recipe, intensity);
            found.map_or(f64::NAN, |s| s.ks)
        };
        let series = |label: &str, mark, y: Vec<f64>| {
            Series::new(label, mark, CONSTANTS.to_vec(), y)
        };
        let flat = |label: &str, recipe| {
            series(label, Mark::Line, vec![ks(recipe); CONSTANTS.len()])
        };
        let seven = |label: &str, method, centre| {
            let along = CONSTANTS
                .iter()
                .map(|c| ks(Recipe::Transformed { method, centre, c: *c }));
            series(label, Mark::LineAndPoints, along.collect())
        };
        let (fitted, sample) = (Centre::FittedMedian, Centre::SampleMedian);
        let lines = vec![
            flat("unshifted", Recipe::Unshifted(MLE)),
            flat("Option 1", Recipe::Shifted(MLE)),
            flat("Option 2", Recipe::Quantiles(quantile_type)),
            seven("Option 3, untrimmed", MLE, fitted),
            seven("Option 3, trimmed", trimmed(), fitted),
            seven(
                "Option 3, quantiles",
                FitMethod::Quantile(quantile_type),
                sample,
            ),
        ];
        let (_, most) = range(lines.iter().flat_map(|s| s.y.iter().copied()));
        let top = if most > 0.0 { 1.1 * most } else { 1.0 };
        ChartPanel {
            title: intensity.name().to_uppercase(),
            x: ChartAxis::linear("*c* of Eq. 7", (0.2, 1.05)),
            y: ChartAxis::linear("median Kolmogorov distance", (0.0, top)),
            series: lines,
        }
    };
    let panels = [Intensity::Pga, Intensity::Pgv].map(panel);
    let nearest = panels.each_ref().map(|panel| {
        let all = panel
            .series
            .iter()
            .flat_map(|s| s.y.iter().map(|y| (*y, s.label.as_str())));
        let least = all
            .filter(|(y, _)| y.is_finite())
            .min_by(|a, b| a.0.total_cmp(&b.0));
        least.map_or(String::new(), |(y, label)| {
            format!("for {} {label} lies nearest, at {y:.3}", panel.title)
        })
    });
    Chart {
        heading: heading("options").of(arm),
        panels: panels.into(),
        columns: 2,
    }
    .figure(format!(
        "By the median distance to the empirical fragility {}. The median \
         is over 15 blocks and demands 0.15, 0.35 and 1.00, if the option is \
         defined.",
        nearest.join(", ")
    ))
}
