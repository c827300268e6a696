//! Figure 13.

use super::Heading;
use crate::paper::Intensity;
use crate::table::{Table, number};

/// The test along the demand, with histograms at one level: a row a block.
#[derive(Debug, Clone, PartialEq)]
pub struct TestsAlongDemand {
    /// The words.
    pub heading: Heading,
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// Demand level of the histograms.
    pub edp: f64,
    /// The blocks.
    pub blocks: Vec<TestedBlock>,
}

/// One block: three panels.
#[derive(Debug, Clone, PartialEq)]
pub struct TestedBlock {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Slenderness.
    pub alpha_rad: f64,
    /// Demand levels, rising.
    pub edp: Vec<f64>,
    /// Lilliefors' D over its 5 % critical value, original sample: accepted
    /// up to 1.
    pub original: Vec<f64>,
    /// The same for the shifted sample.
    pub shifted: Vec<f64>,
    /// Histogram of ln IM.
    pub original_histogram: Histogram,
    /// Histogram of ln(IM - IM_R).
    pub shifted_histogram: Histogram,
}

/// A histogram with the normal fitted to the same sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Histogram {
    /// Bin edges, rising; one more than the counts.
    pub edges: Vec<f64>,
    /// Data in each bin.
    pub counts: Vec<usize>,
    /// Mean of the fitted normal.
    pub mean: f64,
    /// Standard deviation of the fitted normal.
    pub deviation: f64,
}

impl Histogram {
    /// Bins of the width 2 IQR/n^(1/3) (Freedman and Diaconis, Zeitschrift
    /// fuer Wahrscheinlichkeitstheorie 57, 1981, 453-476), starting at the
    /// smallest datum; at most 100. Data that are not finite are left out.
    ///
    /// `quartiles` are the sample's lower and upper quartile, `mean` and
    /// `deviation` those of the normal to be drawn. A sample without spread
    /// gets one bin.
    #[must_use]
    pub fn freedman_diaconis(
        sample: &[f64],
        quartiles: (f64, f64),
        mean: f64,
        deviation: f64,
    ) -> Self {
        let mut data: Vec<f64> =
            sample.iter().copied().filter(|x| x.is_finite()).collect();
        data.sort_by(f64::total_cmp);
        let (Some(&low), Some(&high)) = (data.first(), data.last()) else {
            let (edges, counts) = (Vec::new(), Vec::new());
            return Self { edges, counts, mean, deviation };
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
}

impl TestsAlongDemand {
    /// `alpha_rad,p_rad_s,im_kind,sample,quantity,at,value`, where `at` is
    /// the demand, or the bin's lower edge.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "alpha_rad",
            "p_rad_s",
            "im_kind",
            "sample",
            "quantity",
            "at",
            "value",
        ]);
        for block in &self.blocks {
            let mut row = |sample: &str, quantity: &str, at, value| {
                table.row([
                    number(block.alpha_rad),
                    number(block.p_rad_s),
                    self.intensity.name().into(),
                    sample.into(),
                    quantity.into(),
                    number(at),
                    number(value),
                ]);
            };
            for (sample, ratios, histogram) in [
                ("original", &block.original, &block.original_histogram),
                ("shifted", &block.shifted, &block.shifted_histogram),
            ] {
                for (edp, ratio) in block.edp.iter().zip(ratios) {
                    row(sample, "d_over_critical", *edp, *ratio);
                }
                for (edge, n) in histogram.edges.iter().zip(&histogram.counts)
                {
                    row(sample, "count_from", *edge, *n as f64);
                }
                if let Some(end) = histogram.edges.last() {
                    row(sample, "last_edge", *end, f64::NAN);
                }
                row(sample, "normal_mean", self.edp, histogram.mean);
                row(sample, "normal_sd", self.edp, histogram.deviation);
            }
        }
        table.finish()
    }
}
