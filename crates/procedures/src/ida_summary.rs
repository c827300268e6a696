//! Summary of the curves of a suite.

use rocking::ida::{Analysis, IdaCurve, ResolutionCounts};
use rocking_statistics::ExtendedSample;

/// The curves of a suite, counted.
#[derive(Clone, Debug, Default, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct IdaSummary {
    /// Number of curves.
    pub records: usize,
    /// Analyses made, bisection included.
    pub analyses: u64,
    /// Curves that end in an overturning.
    pub overturned_curves: usize,
    /// Median first overturning intensity PGA/(g tan alpha), infinite if half
    /// of the curves stand; none for no curve.
    pub median_overturning_im: Option<f64>,
    /// Number of analyses that each arithmetic resolved.
    pub resolution: ResolutionCounts,
    /// Levels above a first overturning at which the block stands again; none
    /// if they were not sought.
    pub resurrections: Option<usize>,
    /// The curves, in order.
    pub curves: Vec<CurveSummary>,
}

/// One curve, counted.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct CurveSummary {
    /// The record.
    pub record: String,
    /// Levels that were run.
    pub levels: usize,
    /// First overturning intensity PGA/(g tan alpha); none if the block stands
    /// at every level.
    pub overturning_im: Option<f64>,
}

/// Counts the curves of a suite under one analysis, and takes the median of
/// their first overturning intensities, the curves that stand as infinite.
///
/// ```
/// use rocking::{Block, Restitution};
/// use rocking::excitation::NormalisedRecord;
/// use rocking::ida::{Analysis, Batch, Grid, curves};
/// use rocking_procedures::summarise_ida;
/// use rocking::accelerogram::Accelerogram;
/// let rise = (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
/// let record = Accelerogram::try_new("lobe", 0.01, rise.collect())?;
/// let records = [NormalisedRecord::new(&record)];
/// let block = Block::try_new(0.1, 3.0)?;
/// let analysis = Analysis {
///     grid: Grid::Im { step: 0.5 },
///     ..Analysis::paper(block, Restitution::constant(0.92)?)
/// };
/// let found = curves(&records, &[analysis], &Batch::default())?;
/// let summary = summarise_ida(&found[0], &analysis);
/// assert_eq!((summary.records, summary.overturned_curves), (1, 1));
/// let first = summary.curves[0].overturning_im;
/// assert_eq!(summary.median_overturning_im, first);
/// assert_eq!(summary.resurrections, None);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn summarise_ida(curves: &[IdaCurve], analysis: &Analysis) -> IdaSummary {
    let resurrections = analysis.resurrections.map(|_| 0);
    let mut summary = IdaSummary { resurrections, ..IdaSummary::default() };
    summary.add(curves);
    summary
}

impl IdaSummary {
    /// Counts more curves under the same analysis, as if all had been
    /// counted together.
    pub fn add(&mut self, curves: &[IdaCurve]) {
        let mut resurrections = 0;
        for curve in curves {
            let overturning_im = curve.overturning.map(|first| first.im());
            self.resolution.add(&curve.resolution);
            self.analyses += curve.analyses;
            self.overturned_curves += usize::from(overturning_im.is_some());
            resurrections += curve.resurrections();
            self.curves.push(CurveSummary {
                record: curve.record.clone(),
                levels: curve.points.len(),
                overturning_im,
            });
        }
        self.records = self.curves.len();
        self.resurrections =
            self.resurrections.map(|before| before + resurrections);
        let im = |c: &CurveSummary| c.overturning_im.unwrap_or(f64::INFINITY);
        let ims: Vec<f64> = self.curves.iter().map(im).collect();
        let ims = ExtendedSample::try_new(&ims).ok();
        self.median_overturning_im = ims.map(|ims| ims.quantile(0.5));
    }
}
