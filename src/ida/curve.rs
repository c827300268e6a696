//! Curves of demand against intensity.

use crate::capacity::{CapacityError, ResponseCurve};
use crate::ida::{Resolution, ResolutionCounts};
use crate::integrator::Outcome;

/// One analysis of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct IdaPoint {
    /// Dimensionless intensity PGA/(g tan alpha).
    pub im: f64,
    /// Peak ground acceleration applied, multiples of gravity.
    pub pga_g: f64,
    /// Slenderness of the block analysed, rad.
    pub slenderness_rad: f64,
    /// Outcome of the run.
    pub outcome: Outcome,
    /// Margin to the other outcome.
    pub fate_margin: f64,
    /// Whether outcome and peak are resolved.
    pub resolution: Resolution,
}

impl IdaPoint {
    /// Peak |theta|/alpha; infinite when overturned.
    pub fn edp(&self) -> f64 {
        self.outcome.edp()
    }
}

/// The first overturning of a curve.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct FirstOverturning {
    /// Level of the grid that overturned first, IM.
    pub scanned_im: f64,
    /// Upper end of the bisected bracket, if there is one.
    pub refined: Option<IdaPoint>,
    /// Highest intensity below it found standing.
    pub standing_im: f64,
}

impl FirstOverturning {
    /// The overturning intensity: refined, or the level.
    pub fn im(&self) -> f64 {
        self.refined.map_or(self.scanned_im, |point| point.im)
    }
}

/// IDA curve of one record.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct IdaCurve {
    /// The record's name.
    pub record: String,
    /// PGA of the record as given, multiples of gravity.
    pub record_pga_g: f64,
    /// PGV/PGA of the record in s.
    pub velocity_ratio_s: f64,
    /// Onset of rocking: IM = 1, EDP = 0. It is known and needs no run.
    pub onset: IdaPoint,
    /// Analyses in rising intensity, the first overturned one last; levels
    /// at or below the uplift threshold are not run.
    pub points: Vec<IdaPoint>,
    /// First overturning, if there is one up to the highest level.
    pub overturning: Option<FirstOverturning>,
    /// Levels above the first overturning, if resurrections were sought.
    pub above: Vec<IdaPoint>,
    /// How many analyses each arithmetic resolved.
    pub resolution: ResolutionCounts,
    /// Analyses made, bisection included.
    pub analyses: u64,
}

/// Which end of its bracket counts as the first overturning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum BracketEnd {
    /// The level of the grid that overturned first.
    Scanned,
    /// The upper end of the bisected bracket if there is one, otherwise the
    /// level.
    Refined,
}

impl IdaCurve {
    /// The curve of demand (EDP) against intensity (IM = PGA/(g tan alpha)):
    /// the onset (1, 0), the standing analyses, and the first overturning.
    ///
    /// # Errors
    /// None for a curve that [`curve`](crate::ida::curve()) or
    /// [`curves`](crate::ida::curves) made; [`CapacityError`]
    /// for fields with other values.
    ///
    /// ```
    /// use rocking::{Block, Restitution};
    /// use rocking::capacity::InversionRule;
    /// use rocking::excitation::NormalisedRecord;
    /// use rocking::ida::{Analysis, BracketEnd, curve};
    /// use rocking::accelerogram::Accelerogram;
    /// let rise = (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
    /// let record = Accelerogram::try_new("lobe", 0.01, rise.collect())?;
    /// let block = Block::try_new(0.1, 3.0)?;
    /// let analysis = Analysis::paper(block, Restitution::constant(0.92)?);
    /// let ida = curve(&NormalisedRecord::new(&record), &analysis)?;
    /// let response = ida.response(BracketEnd::Scanned)?;
    /// assert_eq!(response.onset_im(), 1.0);
    /// // The intensity at which |theta| reaches half of alpha.
    /// let half = response.crossings(0.5)?.capacity(InversionRule::Median);
    /// assert!(half.im() > 1.0 && half.im() < ida.points.last().unwrap().im);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn response(
        &self,
        overturned: BracketEnd,
    ) -> Result<ResponseCurve, CapacityError> {
        let points = std::iter::once(&self.onset).chain(self.standing());
        let vertices: Vec<(f64, f64)> =
            points.map(|point| (point.im, point.edp())).collect();
        let overturning = self.overturning.map(|first| match overturned {
            BracketEnd::Scanned => first.scanned_im,
            BracketEnd::Refined => first.im(),
        });
        ResponseCurve::try_new(&vertices, overturning)
    }

    /// Intensities of `points`.
    pub fn ims(&self) -> Vec<f64> {
        self.points.iter().map(|point| point.im).collect()
    }

    /// Standing analyses, in rising intensity.
    pub fn standing(&self) -> impl Iterator<Item = &IdaPoint> {
        self.points.iter().filter(|point| !point.outcome.is_overturned())
    }

    /// Factor from PGA/(g tan alpha) to p PGV/(g tan alpha) for a block of
    /// frequency parameter p.
    pub fn velocity_factor(&self, frequency_rad_s: f64) -> f64 {
        frequency_rad_s * self.velocity_ratio_s
    }

    /// Levels above the first overturning at which the block stands again.
    pub fn resurrections(&self) -> usize {
        let stands = |point: &&IdaPoint| !point.outcome.is_overturned();
        self.above.iter().filter(stands).count()
    }
}
