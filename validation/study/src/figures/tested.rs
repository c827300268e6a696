//! Figure 13: the test along the demand, and histograms at one level.

use rocking_statistics::QuantileType;
use rocking_statistics::lilliefors::LillieforsTest;
use rocking_statistics::normal;

use crate::normality::over_critical;
use crate::results::StudyResults;
use crate::ties::critical_on_grid;
use crate::words::paper_heading;
use rocking_common::paper::{Arm, Intensity, demand_index, demands};
use rocking_common::table::number;
use rocking_common::words::percent;
use rocking_draw::axis::Axis;
use rocking_draw::colour::{Dash, Fill, Ink, Pen};
use rocking_draw::figures::common::{self, span};
use rocking_draw::figures::{
    Chart, ChartPanel, Figure, Layout, Look, Mark, Of, Series,
};
use rocking_draw::legend::{Entry, Sample};
use rocking_draw::panel::Marker;

/// Demand level of the histograms.
const EDP: f64 = 0.5;
const GRID: Ink = Ink::Series(1);
const LIMIT: Pen = Pen::new(Ink::Text, 0.8).dash(Dash::Dashed);

/// A histogram with the normal fitted to the same sample.
#[derive(Default)]
struct Histogram {
    /// Bin edges, rising; one more than the counts.
    edges: Vec<f64>,
    /// Data in each bin.
    counts: Vec<usize>,
    /// Mean of the fitted normal.
    mean: f64,
    /// Standard deviation of the fitted normal.
    deviation: f64,
}

impl Histogram {
    /// Bins of the width 2 IQR/n^(1/3) (Freedman and Diaconis, Zeitschrift
    /// fuer Wahrscheinlichkeitstheorie 57, 1981, 453-476), starting at the
    /// smallest datum; at most 100 bins. Data that are not finite are left out.
    ///
    /// `quartiles` are the sample's lower and upper quartile, `mean` and
    /// `deviation` the parameters of the fitted normal. A sample without spread
    /// gets one bin.
    fn freedman_diaconis(
        sample: &[f64],
        quartiles: (f64, f64),
        mean: f64,
        deviation: f64,
    ) -> Self {
        let mut data: Vec<f64> =
            sample.iter().copied().filter(|x| x.is_finite()).collect();
        data.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (data.first(), data.last()) else {
            return Self { mean, deviation, ..Self::default() };
        };
        let n = data.len() as f64;
        let width = 2.0 * (quartiles.1 - quartiles.0) / libm::cbrt(n);
        let bins = if width > 0.0 && high > low {
            ((high - low) / width).ceil().clamp(1.0, 100.0)
        } else {
            1.0
        };
        let (width, low) = if high > low {
            ((high - low) / bins, low)
        } else {
            (1.0, low - 0.5)
        };
        let bins = bins as usize;
        let edges: Vec<f64> =
            (0..=bins).map(|i| width.mul_add(i as f64, low)).collect();
        let mut counts = vec![0; bins];
        for x in data {
            let bin = edges[1..bins].partition_point(|e| *e <= x);
            counts[bin] += 1;
        }
        Self { edges, counts, mean, deviation }
    }

    /// The logarithms that were tested.
    fn of(test: &LillieforsTest) -> Self {
        let Some(logs) = &test.tested else { return Self::default() };
        let deviation =
            (logs.sum_of_squares() / (logs.len() as f64 - 1.0)).sqrt();
        let quartile =
            |p| QuantileType::default().quantile(logs, p).unwrap_or(f64::NAN);
        let quartiles = (quartile(0.25), quartile(0.75));
        let mean = logs.mean();
        Self::freedman_diaconis(logs.sorted(), quartiles, mean, deviation)
    }

    fn records(&self) -> usize {
        self.counts.iter().sum()
    }

    /// Records per bin by the fitted normal.
    fn density(&self, x: f64) -> f64 {
        let bin = match self.edges.as_slice() {
            [first, second, ..] => second - first,
            _ => 1.0,
        };
        let z = (x - self.mean) / self.deviation;
        normal::pdf(z) / self.deviation * (self.records() as f64 * bin)
    }

    /// Highest count of the histogram and of its normal.
    fn top(&self) -> f64 {
        let most = self.counts.iter().max().copied().unwrap_or(0) as f64;
        let peak = self.density(self.mean);
        let peak = if peak.is_finite() { peak } else { 0.0 };
        most.max(peak.min(2.0 * most)).max(1.0)
    }
}

/// The original or the shifted sample of a block.
struct SampleTests {
    name: &'static str,
    /// The tested quantity, as an axis label.
    label: &'static str,
    ink: Ink,
    marker: Marker,
    /// Lilliefors' D over its 5 % critical value at each demand.
    ratios: Vec<f64>,
    /// The 5 % critical value for overturnings on the grid of 0.01 g, over the
    /// table's value.
    on_grid: Option<f64>,
    histogram: Histogram,
}

impl SampleTests {
    fn original(tests: &[LillieforsTest]) -> Self {
        Self {
            name: "original",
            label: "ln IM",
            ink: Ink::Series(0),
            marker: Marker::Dot,
            ratios: tests.iter().map(over_critical).collect(),
            on_grid: None,
            histogram: Histogram::of(&tests[demand_index(EDP)]),
        }
    }

    fn shifted(tests: &[LillieforsTest], on_grid: Option<f64>) -> Self {
        Self {
            name: "shifted",
            label: "ln(IM − IM_{R})",
            ink: Ink::Series(2),
            marker: Marker::Square,
            on_grid,
            ..Self::original(tests)
        }
    }

    fn keys(&self, block: (f64, f64), quantity: &str) -> [String; 5] {
        [
            number(block.0),
            number(block.1),
            Intensity::Pga.name().into(),
            self.name.into(),
            quantity.into(),
        ]
    }

    /// The test along the demand.
    fn tests(&self, block: (f64, f64)) -> [Series; 3] {
        let (x, y) = (demands(), &self.ratios);
        let line = Look::line(Pen::new(self.ink, 0.9));
        let marks = Look::marks(self.marker, 1.7, self.ink);
        let every = (x.len() / 40).max(1);
        let few = |v: &[f64]| v.iter().copied().step_by(every).collect();
        let grid: Vec<f64> = self.on_grid.into_iter().collect();
        let diamond = Look::marks(Marker::Diamond, 4.0, GRID);
        [
            Series::of(line, x.clone(), y.clone())
                .keyed(self.keys(block, "d_over_critical")),
            Series::of(marks, few(&x), few(y)).keyed([]),
            Series::of(diamond, vec![1.0; grid.len()], grid)
                .keyed(self.keys(block, "grid_critical_over_critical")),
        ]
    }

    /// The histogram at one demand, with the fitted normal.
    fn bars(&self, block: (f64, f64), top: f64) -> ChartPanel {
        let h = &self.histogram;
        let (low, high) =
            span(h.edges.iter().copied(), false).unwrap_or((0.0, 1.0));
        let margin = 0.08 * (high - low);
        let x = Axis::around(low - margin, high + margin, 6).label(self.label);
        let (start, end) = x.range();
        let step = (end - start) / 160.0;
        let along = (0..=160).map(|i| step.mul_add(f64::from(i), start));
        let along: Vec<f64> = along.collect();
        let density = along.iter().map(|x| h.density(*x)).collect();
        let bins = Look {
            pen: Some(Pen::new(self.ink, 0.8)),
            bins: Some(Fill::tint(self.ink, 30)),
            ..Look::default()
        };
        let counts = h.counts.iter().map(|n| *n as f64).chain([f64::NAN]);
        let bars = Series::of(bins, h.edges.clone(), counts.collect());
        let mut series = vec![bars.keyed(self.keys(block, "count_from"))];
        // The normal is drawn from its two numbers.
        for (name, value) in
            [("normal_mean", h.mean), ("normal_sd", h.deviation)]
        {
            let one = Series::of(Look::default(), vec![EDP], vec![value]);
            series.push(one.keyed(self.keys(block, name)));
        }
        if h.deviation > 0.0 {
            let look = Look::line(Pen::new(Ink::Text, 1.1));
            series.push(Series::of(look, along, density).keyed([]));
        }
        let (label, edp) = (self.label, common::short(EDP));
        let title = format!("{label} at *θ̃* = {edp}\n{} records", h.records());
        let y = Axis::around(0.0, 1.05 * top, 5).label("records");
        ChartPanel::new(title, x, y, series)
    }
}

/// Figure 13: p = 3, alpha = 0.05 and 0.20, PGA; a row for each block.
pub(super) fn along(
    results: &StudyResults,
    arm: Arm,
) -> anyhow::Result<Figure> {
    let mut blocks = Vec::new();
    let mut words = Vec::new();
    for slenderness in [0, 3] {
        let block =
            results.ordinary.block(arm, Intensity::Pga, (1, slenderness))?;
        words.push(format!(
            "{} and {} at alpha = {:.2}",
            percent(block.shares()[0], 1),
            percent(block.shares()[1], 1),
            block.alpha_rad
        ));
        let on_grid =
            (arm == Arm::A).then(|| critical_on_grid(block)).flatten();
        let halves = [
            SampleTests::original(&block.tests[0]),
            SampleTests::shifted(&block.tests[1], on_grid),
        ];
        blocks.push(((block.alpha_rad, block.p_rad_s), halves));
    }
    // The same scale for all blocks: they are compared.
    let halves = || blocks.iter().flat_map(|(_, halves)| halves);
    let top = halves().map(|h| h.histogram.top()).fold(1.0, f64::max);
    let ratios = halves().flat_map(|h| h.ratios.iter().chain(&h.on_grid));
    let (_, high) = span(ratios.copied(), true).unwrap_or((0.0, 1.5));
    let mut panels = Vec::new();
    for (block, halves) in &blocks {
        let mut series =
            vec![Series::note(Mark::Across(LIMIT), "", (0.0, 1.0))];
        series.extend(halves.iter().flat_map(|h| h.tests(*block)));
        panels.push(ChartPanel::new(
            format!(
                "{}, {}\nIM = {}",
                common::frequency(block.1),
                common::slenderness(block.0),
                Intensity::Pga.row().label
            ),
            Axis::linear(0.0, 1.0, 5).label(common::DEMAND),
            Axis::around(0.0, (1.05 * high).clamp(1.4, 12.0), 6)
                .label("*D* / *D*_{5 %}"),
            series,
        ));
        panels.extend(halves.iter().map(|h| h.bars(*block, top)));
    }
    let line =
        |k, marker| Sample::LineAndMark(Pen::new(Ink::Series(k), 1.1), marker);
    let mut legend = vec![
        Entry::new(line(0, Marker::Dot), "original sample"),
        Entry::new(line(2, Marker::Square), "shifted sample"),
        Entry::new(Sample::Line(LIMIT), "5 % critical value"),
        Entry::new(Sample::Line(Pen::new(Ink::Text, 1.1)), "fitted normal"),
    ];
    let mut diamond = "";
    if halves().any(|h| h.on_grid.is_some()) {
        let mark = Sample::Mark(Marker::Diamond, GRID);
        let on_grid = "shifted, 5 % on the 0.01 *g* grid at overturning";
        legend.push(Entry::new(mark, on_grid));
        diamond = " The diamond is the 5 % critical value of a shifted \
                   lognormal whose overturnings lie on the 0.01 g grid.";
    }
    let layout = Layout {
        legend,
        ..Layout::of(
            &["alpha_rad", "p_rad_s", "im", "sample", "quantity"],
            &[("at", Of::X), ("value", Of::Y)],
        )
    };
    let heading = paper_heading(13, Some(arm));
    Ok(Chart { heading, panels, columns: 3 }.laid_out(
        &layout,
        format!(
            "Of the levels of the original and the shifted sample, the test \
             accepts {}.{diamond}",
            words.join(", "),
        ),
    ))
}

#[cfg(test)]
mod tests {
    use super::Histogram;

    #[test]
    fn histogram_counts_every_finite_datum_once() {
        let sample = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, f64::INFINITY];
        let h = Histogram::freedman_diaconis(&sample, (1.75, 5.25), 3.5, 2.4);
        // 2 * 3.5 / 8^(1/3) = 3.5; (7 - 0) / 3.5 = 2 bins.
        assert_eq!(h.edges, [0.0, 3.5, 7.0]);
        assert_eq!(h.counts, [4, 4]);
        let same =
            Histogram::freedman_diaconis(&[2.0; 5], (2.0, 2.0), 2.0, 0.0);
        assert_eq!((same.edges.len(), same.counts), (2, vec![5]));
        let none = Histogram::freedman_diaconis(&[], (0.0, 0.0), 0.0, 0.0);
        assert!(none.edges.is_empty() && none.counts.is_empty());
    }
}
