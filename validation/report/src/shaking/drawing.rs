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
/// Normal score up to which the widest fragility is drawn.
const LAST: f64 = 2.3;

/// Measured and computed fragility of a rock.
fn fragility(rock: usize, own: &DistributionComparison) -> ChartPanel {
    let error = ModelError::default().dispersion().value();
    let total = libm::hypot(own.computed_dispersion, error);
    let laws = [
        ("measured", own.measured_median, own.measured_dispersion),
        ("computed", own.computed_median, own.computed_dispersion),
        (
            "computed, with the dispersion of the model",
            own.computed_median,
            total,
        ),
    ];
    let ends = laws.map(|(_, median, s)| median * libm::exp(LAST * s));
    let last = ends.into_iter().fold(0.0, f64::max);
    let step = last / f64::from(STEPS);
    let x: Vec<f64> = (0..=STEPS).map(|k| step * f64::from(k)).collect();
    let curve = |(k, (label, median, dispersion))| {
        let law = Lognormal::try_new(0.0, libm::log(median), dispersion);
        let law = law.ok()?;
        let y = x.iter().map(|im| law.cdf(*im)).collect();
        let mark = Mark::Own(Look::line(Pen::of_series(k)));
        Some(Series::new(label, mark, x.clone(), y))
    };
    ChartPanel::new(
        format!("rock {rock}"),
        ChartAxis::linear("PGV (m/s)", (0.0, last)),
        ChartAxis::linear("probability of overturning", (0.0, 1.0)),
        laws.into_iter().enumerate().filter_map(curve).collect(),
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
    let names = TestMeasure::ALL.map(|m| m.name.to_owned());
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
        let figure = |words: [&str; 3], panels, reading| {
            let chart = Chart::of(words, panels);
            let place = Place::ShakingTable;
            let heading = Heading { place, ..chart.heading };
            Chart { heading, ..chart }.figure(reading)
        };
        let rocks = self.fitted.iter().zip(1..).filter_map(|(own, rock)| {
            Some(fragility(rock, TestMeasure::PGV.fragilities(own)?))
        });
        let dispersion = by_measure(
            self,
            "dispersion that the model leaves out",
            ChartAxis::linear("dispersion", None),
            ModelError::default().dispersion().ends(),
            |own| own.missing_dispersion,
        );
        let median = by_measure(
            self,
            "ratio of measured to computed median",
            ChartAxis::linear("ratio", None),
            ModelError::fitted().bias().ends(),
            |own| own.median_ratio,
        );
        vec![
            figure(
                [
                    "shaking-table-fragility",
                    "Measured and computed fragility of two rocks",
                    "Lognormals fitted to the measured and to the computed \
                     outcomes of each rock against PGV, and the computed one \
                     with the dispersion of the model.",
                ],
                rocks.collect(),
                "Lognormals fitted to the outcomes. PGV is as the authors \
                 state it.",
            ),
            figure(
                [
                    "shaking-table-error",
                    "Error of the model on the shaking table",
                    "Share of tests that overturned a rock against the \
                     predicted probability; dispersion that the model leaves \
                     out and ratio of medians, by intensity measure.",
                ],
                vec![self.reliability(), dispersion, median],
                "(a) Each mark is a tenth of the tests. Bars: 90 % intervals. \
                 Dashed in (b) and (c): the ranges that decisions assume for \
                 a fitted object.",
            ),
        ]
    }
}
