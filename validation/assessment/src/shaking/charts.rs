//! The figures of a comparison with shaking-table tests.

use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_draw::colour::{Dash, Ink, Pen};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Heading, Look, Mark, Series,
};
use rocking_draw::markup;
use rocking_draw::panel::Marker;
use rocking_procedures::shaking::{
    DistributionComparison, TestComparison, TestResult,
};
use rocking_statistics::Lognormal;

use super::words::measure;

/// Classes of equal numbers of tests in which shares are shown.
const CLASSES: usize = 10;

/// Steps in which a fragility is drawn.
const STEPS: u32 = 150;

/// Half width of a mark in px.
const MARK_PX: f64 = 3.0;

fn chart(heading: [&str; 3], panels: Vec<ChartPanel>) -> Chart {
    let [name, title, description] = heading;
    let columns = panels.len().min(3);
    let heading = Heading::new(name, title, description);
    Chart { heading, panels, columns }
}

/// Measured and computed fragilities of the same tests, with the shares that
/// overturned.
pub(super) fn fragilities(found: &TestComparison) -> Chart {
    let all = found.distributions.iter().enumerate();
    let panels = all.map(|(k, one)| fragility(found, one, k)).collect();
    chart(
        [
            "fragilities",
            "Measured and computed fragility",
            "Probability of overturning by intensity: lognormal \
             distributions fitted to the measured and to the computed fates \
             of the same tests, with the shares in classes of equal numbers \
             of tests.",
        ],
        panels,
    )
}

fn fragility(
    found: &TestComparison,
    one: &DistributionComparison,
    k: usize,
) -> ChartPanel {
    let im = |test: &TestResult| {
        test.intensities.get(k).copied().unwrap_or(f64::NAN)
    };
    let mut tests: Vec<&TestResult> = found.each.iter().collect();
    tests.sort_by(|a, b| im(a).total_cmp(&im(b)));
    let class = tests.len().div_ceil(CLASSES).max(1);
    let means = |of: &dyn Fn(&TestResult) -> f64| -> Vec<f64> {
        let mean = |class: &[&TestResult]| {
            class.iter().map(|test| of(test)).sum::<f64>() / class.len() as f64
        };
        tests.chunks(class).map(mean).collect()
    };
    let x = means(&|test| libm::log(im(test))).into_iter().map(libm::exp);
    let x: Vec<f64> = x.collect();
    let last = 1.15 * x.last().copied().unwrap_or(1.0);
    let step = last / f64::from(STEPS);
    let places: Vec<f64> = (0..=STEPS).map(|k| step * f64::from(k)).collect();
    let mut series = Vec::new();
    let mut draw = |label: &str,
                    pen: Pen,
                    marker: Marker,
                    [median, dispersion]: [f64; 2],
                    overturns: fn(&TestResult) -> bool| {
        let law = Lognormal::try_new(0.0, libm::log(median), dispersion);
        series.extend(law.ok().map(|law| {
            let y = places.iter().map(|im| law.cdf(*im)).collect();
            Series::new(label, Mark::Own(Look::line(pen)), places.clone(), y)
        }));
        let shares = means(&|test| f64::from(u8::from(overturns(test))));
        let marks = Mark::Own(Look::marks(marker, MARK_PX, pen.ink));
        let label = format!("{label}, share of a class");
        series.push(Series::new(label, marks, x.clone(), shares));
    };
    let law = [one.measured_median, one.measured_dispersion];
    let pen = Pen::of_series(0);
    draw("measured", pen, Marker::Dot, law, |test| test.overturned);
    let law = [one.computed_median, one.computed_dispersion];
    let pen = Pen::of_series(1).dash(Dash::Dashed);
    draw("computed", pen, Marker::OpenSquare, law, |test| {
        test.capacity_factor <= 1.0
    });
    let unit = &one.unit;
    let label = format!("{} ({unit})", markup::escape(&measure(&one.im)));
    ChartPanel::new(
        markup::escape(&measure(&one.im)),
        ChartAxis::linear(label, (0.0, last)),
        ChartAxis::linear("probability of overturning", (0.0, 1.0)),
        series,
    )
}

/// Predicted against observed shares, with intervals.
pub(super) fn reliability(found: &TestComparison) -> Chart {
    let classes = found.reliability.iter();
    let x = classes.clone().map(|class| class.predicted).collect();
    let y = classes.clone().map(|class| class.observed.value()).collect();
    let ends = classes.map(|class| class.observed.ends()).collect();
    let right = Pen::new(Ink::Muted, 1.0).dash(Dash::Dashed);
    let line = Series::of(Look::line(right), vec![0.0, 1.0], vec![0.0, 1.0]);
    let points = Series::new("a tenth of the tests", Mark::Points, x, y);
    let panel = ChartPanel::new(
        "",
        ChartAxis::linear("predicted probability", (0.0, 1.0)),
        ChartAxis::linear("share that overturned", (0.0, 1.0)),
        vec![line.labelled("predicted = observed"), points.with(ends)],
    );
    chart(
        [
            "reliability",
            "Predicted and observed shares",
            "Share of the tests that overturned the specimen against the \
             predicted probability, by tenths of the tests.",
        ],
        vec![panel],
    )
}

/// Place of PGV among the intensities, if it is one of them.
pub(super) fn velocity(found: &TestComparison) -> Option<usize> {
    found.distributions.iter().position(|one| one.im == "pgv")
}

/// Level of each test over its computed capacity, by PGV/PGA, or by PGA if PGV
/// is not among the measures.
pub(super) fn levels(found: &TestComparison) -> Chart {
    let velocity = velocity(found);
    let label = velocity.map_or("PGA (g)", |_| "PGV / PGA (s)");
    let x = |test: &TestResult| match velocity {
        None => test.pga_g,
        Some(k) => {
            let pgv_m_s = test.intensities.get(k).copied();
            let pga_m_s2 = STANDARD_GRAVITY_M_S2 * test.pga_g;
            pgv_m_s.unwrap_or(f64::NAN) / pga_m_s2
        }
    };
    let mut series = Vec::new();
    for (fell, words, marker) in [
        (false, "stood", Marker::OpenSquare),
        (true, "overturned", Marker::Dot),
    ] {
        let tests = found.each.iter().filter(|t| t.overturned == fell);
        let at = |test: &TestResult| (x(test), 1.0 / test.capacity_factor);
        let (x, y) = tests.map(at).unzip();
        let ink = Ink::Series(usize::from(fell));
        let marks = Look::marks(marker, MARK_PX, ink);
        let own = Series::of(marks, x, y).labelled(words);
        series.push(own.keyed([words.to_owned()]));
    }
    let mut lines = vec![("computed", 1.0, Pen::new(Ink::Text, 1.2))];
    if !found.alpha_is_fitted {
        let dashed = Pen::new(Ink::Muted, 1.2).dash(Dash::Dashed);
        lines.push(("measured", found.computed.median.value(), dashed));
    }
    // Words at the edge are placed above earlier ones.
    lines.sort_by(|a, b| a.1.total_cmp(&b.1));
    for (words, y, pen) in lines {
        series.push(Series::note(Mark::Across(pen), "", (f64::NAN, y)));
        series.push(Series::note(Mark::Edge, words, (f64::NAN, y)));
    }
    let panel = ChartPanel::new(
        "",
        ChartAxis::logarithmic(label, None::<(f64, f64)>),
        ChartAxis::logarithmic(
            "level of the test / computed capacity",
            None::<(f64, f64)>,
        ),
        series,
    );
    chart(
        [
            "levels",
            "Each test",
            "Level of each test over the level at which the block first \
             overturns, against PGV/PGA of the motion.",
        ],
        vec![panel],
    )
}
