//! What the analyses of a table ask of the pivot: how many need more friction
//! than there is.

use std::path::PathBuf;

use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, IdaCurve, IdaError};
use rocking_procedures::{PivotForces, pivot_forces};

use crate::cli::shared::positive;
use rocking_common::table::{Table, columns::FORCES};

/// Forces at the pivot of every analysis.
#[derive(clap::Args)]
pub(super) struct ForcesArgs {
    /// Share of the analyses that need more friction |H|/N at the pivot than
    /// each of these coefficients. The model does not slide, so its results
    /// are not valid for these analyses. Each analysis is run again in full.
    #[arg(
        long,
        value_name = "MU,..",
        value_delimiter = ',',
        value_parser = positive
    )]
    friction: Vec<f64>,
    /// Table of the friction and the least normal force N/(m g) that each
    /// analysis needs.
    #[arg(long, value_name = "FILE.csv")]
    pub(super) forces: Option<PathBuf>,
}

impl ForcesArgs {
    /// Computes the forces if a flag requests them.
    pub(super) fn pivot(
        &self,
        records: &[NormalisedRecord],
        table: &[IdaCurve],
        analysis: &Analysis,
    ) -> Result<Option<PivotForces>, IdaError> {
        if self.friction.is_empty() && self.forces.is_none() {
            return Ok(None);
        }
        let ims: Vec<_> = table.iter().map(IdaCurve::ims).collect();
        pivot_forces(records, &ims, analysis, &self.friction).map(Some)
    }
}

/// One row an analysis, by record, then level.
pub(super) fn csv(pivot: &PivotForces, table: &[IdaCurve]) -> String {
    let mut out = Table::of(&FORCES);
    let time = |t: Option<f64>| t.map_or(String::new(), |t| t.to_string());
    for (curve, found) in table.iter().zip(&pivot.curves) {
        for (point, forces) in curve.points.iter().zip(found) {
            out.row([
                curve.record.clone(),
                point.im.to_string(),
                point.pga_g.to_string(),
                point.edp().to_string(),
                forces.friction.to_string(),
                time(forces.friction_time_s),
                forces.least_normal_over_weight.to_string(),
                time(forces.least_normal_time_s),
            ]);
        }
    }
    out.finish()
}
