//! What the analyses of a table ask of the pivot: how many need more friction
//! than there is.

use std::path::PathBuf;

use rayon::prelude::*;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, IdaCurve, IdaError, forces_at};
use rocking::integrator::Forces;
use serde_json::{Value, json};

use rocking_common::table::{Table, columns::FORCES};

/// Forces at the pivot of every analysis.
#[derive(clap::Args)]
pub(super) struct ForcesArgs {
    /// Share of the analyses that need more friction |H|/N at the pivot than
    /// each of these coefficients. The model does not slide: above this share
    /// it says more than it knows. Each analysis is run once more, whole.
    #[arg(
        long,
        value_name = "MU,..",
        value_delimiter = ',',
        value_parser = coefficient
    )]
    friction: Vec<f64>,
    /// Table of the friction and the least normal force N/(m g) that each
    /// analysis needs.
    #[arg(long, value_name = "FILE.csv")]
    pub(super) forces: Option<PathBuf>,
}

fn coefficient(text: &str) -> Result<f64, String> {
    match text.trim().parse() {
        Ok(mu) if mu > 0.0 && f64::is_finite(mu) => Ok(mu),
        _ => Err("expected positive numbers, such as 0.3,0.5".to_owned()),
    }
}

/// The forces of every level of every curve up to its first overturning.
pub(super) struct Audit {
    friction: Vec<f64>,
    found: Vec<Vec<Forces>>,
}

impl ForcesArgs {
    /// Runs what is asked for: nothing, if nothing is.
    pub(super) fn audit(
        &self,
        records: &[NormalisedRecord],
        table: &[IdaCurve],
        analysis: &Analysis,
    ) -> Result<Option<Audit>, IdaError> {
        if self.friction.is_empty() && self.forces.is_none() {
            return Ok(None);
        }
        let pairs: Vec<_> = records.iter().zip(table).collect();
        let of = |(record, curve): &(&NormalisedRecord, &IdaCurve)| {
            let points = curve.points.iter();
            points.map(|point| forces_at(record, analysis, point.im)).collect()
        };
        let found = pairs.par_iter().map(of).collect::<Result<_, _>>()?;
        Ok(Some(Audit { friction: self.friction.clone(), found }))
    }
}

impl Audit {
    fn all(&self) -> impl Iterator<Item = &Forces> {
        self.found.iter().flatten()
    }

    fn count(&self) -> usize {
        self.all().count()
    }

    fn above(&self, mu: f64) -> usize {
        self.all().filter(|forces| forces.friction > mu).count()
    }

    fn friction(&self) -> f64 {
        self.all().fold(0.0, |most: f64, forces| most.max(forces.friction))
    }

    fn normal(&self) -> f64 {
        self.all().fold(1.0, |least: f64, forces| least.min(forces.normal))
    }

    /// Rows of the summary.
    pub(super) fn rows(&self) -> Vec<(String, String)> {
        let n = self.count();
        let share = |&mu: &f64| {
            let k = self.above(mu);
            let percent = 100.0 * k as f64 / n as f64;
            let words = format!("{percent:.2} % ({k} of {n} analyses)");
            (format!("need friction > {mu}"), words)
        };
        let mut rows: Vec<_> = self.friction.iter().map(share).collect();
        let most = format!("{:.4}", self.friction());
        rows.push(("largest friction".to_owned(), most));
        let least = format!("{:.4}", self.normal());
        rows.push(("least N/(m g)".to_owned(), least));
        rows
    }

    pub(super) fn json(&self) -> Value {
        let n = self.count();
        let shares = self.friction.iter().map(|&mu| {
            let k = self.above(mu);
            json!({ "friction": mu, "need_more": k,
                    "share": k as f64 / n as f64 })
        });
        json!({
            "analyses": n,
            "need": shares.collect::<Vec<_>>(),
            "largest_friction": self.friction(),
            "least_normal_over_weight": self.normal(),
        })
    }

    /// One row an analysis, by record, then level.
    pub(super) fn csv(&self, table: &[IdaCurve]) -> String {
        let mut out = Table::of(&FORCES);
        let time = |t: Option<f64>| t.map_or(String::new(), |t| t.to_string());
        for (curve, found) in table.iter().zip(&self.found) {
            for (point, forces) in curve.points.iter().zip(found) {
                out.row([
                    curve.record.clone(),
                    point.im.to_string(),
                    point.pga_g.to_string(),
                    point.edp().to_string(),
                    forces.friction.to_string(),
                    time(forces.friction_time_s),
                    forces.normal.to_string(),
                    time(forces.normal_time_s),
                ]);
            }
        }
        out.finish()
    }
}
