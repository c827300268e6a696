//! Figures of the tests.

use rocking_draw::colour::{Dash, Ink, Pen};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Look, Mark, Place, Series,
};
use rocking_procedures::ModelError;
use rocking_procedures::shaking::DistributionComparison;
use rocking_statistics::{Estimate, Lognormal};

use super::{RockTests, TestMeasure};

/// Steps in which a fragility is drawn.
const STEPS: u32 = 120;
/// The ordinate up to which fragilities are drawn, of the wider one, as a
/// normal score.
const LAST: f64 = 2.3;

/// A lognormal from 0 to `last`.
fn curve(
    label: &str,
    pen: Pen,
    (median, dispersion): (f64, f64),
    last: f64,
) -> Option<Series> {
    let law = Lognormal::try_new(0.0, libm::log(median), dispersion).ok()?;
    let step = last / f64::from(STEPS);
    let x: Vec<f64> = (0..=STEPS).map(|k| step * f64::from(k)).collect();
    let y = x.iter().map(|im| law.cdf(*im)).collect();
    Some(Series::new(label, Mark::Own(Look::line(pen)), x, y))
}

/// Measured and computed fragility of a rock.
fn fragility(rock: usize, own: &DistributionComparison) -> ChartPanel {
    let error = ModelError::default().dispersion().value();
    let total = libm::hypot(own.computed_dispersion, error);
    let laws = [
        ("measured", (own.measured_median, own.measured_dispersion)),
        ("computed", (own.computed_median, own.computed_dispersion)),
        (
            "computed, with the dispersion of the model",
            (own.computed_median, total),
        ),
    ];
    let end = |(median, s): (f64, f64)| median * libm::exp(LAST * s);
    let last = laws.iter().map(|(_, law)| end(*law)).fold(0.0, f64::max);
    let curves = laws.iter().enumerate().filter_map(|(k, (label, law))| {
        curve(label, Pen::of_series(k), *law, last)
    });
    ChartPanel::new(
        format!("rock {rock}"),
        ChartAxis::linear("PGV (m/s)", (0.0, last)),
        ChartAxis::linear("probability of overturning", (0.0, 1.0)),
        curves.collect(),
    )
}

/// Estimates of both rocks, measure by measure.
fn by_measure(
    found: &RockTests,
    title: &str,
    y: ChartAxis,
    limits: (f64, f64),
    of: impl Fn(&DistributionComparison) -> Estimate,
) -> ChartPanel {
    let names = TestMeasure::ALL.map(|m| m.names()[0].to_owned());
    let edges = [limits.0, limits.1].map(|at| {
        let pen = Pen::new(Ink::Muted, 1.0).dash(Dash::Dashed);
        Series::note(Mark::Across(pen), "", (f64::NAN, at))
    });
    let rocks = (0..2).map(|k| {
        let all = TestMeasure::ALL.iter().enumerate().filter_map(|(at, m)| {
            // Beside each other, not on each other.
            let x = at as f64 + 0.9 + 0.2 * k as f64;
            Some((x, of(m.fragilities(&found.fitted[k])?)))
        });
        let (x, own): (Vec<f64>, Vec<Estimate>) = all.unzip();
        let y = own.iter().map(Estimate::value).collect();
        let ends = own.iter().map(Estimate::ends).collect();
        Series::new(format!("rock {}", k + 1), Mark::Points, x, y).with(ends)
    });
    let series = edges.into_iter().chain(rocks).collect();
    ChartPanel::new(title, ChartAxis::named(names.into()), y, series)
}

impl RockTests {
    /// Predicted and observed shares.
    fn reliability(&self) -> ChartPanel {
        let pen = Pen::new(Ink::Muted, 1.0).dash(Dash::Dashed);
        let ends = vec![0.0, 1.0];
        let even = Series::of(Look::line(pen), ends.clone(), ends);
        let rocks = self.fitted.iter().zip(1..).map(|(own, rock)| {
            let classes = || own.reliability.iter();
            let x = classes().map(|c| c.predicted).collect();
            let y = classes().map(|c| c.observed.value()).collect();
            let ends = classes().map(|c| c.observed.ends()).collect();
            Series::new(format!("rock {rock}"), Mark::Points, x, y).with(ends)
        });
        ChartPanel::new(
            "reliability",
            ChartAxis::linear("predicted probability", (0.0, 1.0)),
            ChartAxis::linear("share that overturned", (0.0, 1.0)),
            [even].into_iter().chain(rocks).collect(),
        )
    }

    /// The figures.
    pub fn figures(&self) -> Vec<Figure> {
        let rocks = self.fitted.iter().zip(1..).filter_map(|(own, rock)| {
            Some(fragility(rock, TestMeasure::Pgv.fragilities(own)?))
        });
        let figure = |name: &str,
                      title,
                      description,
                      panels: Vec<ChartPanel>,
                      reading: &str| {
            let heading = Heading::new(name, title, description);
            let heading = Heading { place: Place::ShakingTable, ..heading };
            let columns = panels.len().min(3);
            let chart = Chart { heading, panels, columns };
            chart.figure(reading)
        };
        let usual = ModelError::default();
        let fitted = ModelError::fitted();
        let dispersion = by_measure(
            self,
            "dispersion that the model leaves out",
            ChartAxis::linear("dispersion", None),
            usual.dispersion().ends(),
            |own| own.missing_dispersion,
        );
        let median = by_measure(
            self,
            "measured over computed median",
            ChartAxis::linear("ratio", None),
            fitted.bias().ends(),
            |own| own.median_ratio,
        );
        vec![
            figure(
                "shaking-table-fragility",
                "Measured and computed fragility of two rocks",
                "Lognormals fitted to the measured and to the computed fates \
                 of each rock against PGV, and the computed one with the \
                 dispersion of the model.",
                rocks.collect(),
                "Lognormals fitted to the fates. PGV is as the authors state \
                 it.",
            ),
            figure(
                "shaking-table-error",
                "Error of the model on the shaking table",
                "Share of tests that overturned a rock against the predicted \
                 probability; dispersion that the model leaves out and ratio \
                 of medians, by intensity measure.",
                vec![self.reliability(), dispersion, median],
                "(a) Each mark is a tenth of the tests. Bars: 90 % intervals. \
                 Dashed in (b) and (c): ranges that decisions take for a \
                 fitted object.",
            ),
        ]
    }
}
