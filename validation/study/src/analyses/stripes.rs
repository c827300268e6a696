//! Runs at the stripes' levels.

use rayon::prelude::*;
use rocking::block::Block;
use rocking::capacity::ResponseCurve;
use rocking::excitation::NormalisedRecord;
use rocking::ida::Adjust;

use super::plan::Plan;
use super::suite::{ArmCurves, StripeDemands, SuiteResults};
use rocking_common::paper::{
    FREQUENCIES_RAD_S, LEAST_USABLE, REFERENCE, STRIPES, position,
};

impl Plan {
    /// One run a block, stripe and record; what an arm's scan makes of it
    /// is a matter of its first overturning.
    pub(super) fn stripes(
        &self,
        blocks: &[Block],
        records: &[NormalisedRecord],
        results: &SuiteResults,
    ) -> anyhow::Result<Vec<StripeDemands>> {
        let used = self.used_stripes(results);
        let scaling = Adjust::RecordScaling;
        let runs: Vec<Vec<Vec<f64>>> = blocks
            .iter()
            .map(|block| {
                on_levels(&used, records, |im, record| {
                    self.setup.demand(*block, record, im, scaling)
                })
            })
            .collect::<Result<_, _>>()?;
        let adjusted_runs: Vec<Vec<Vec<f64>>> = (0..FREQUENCIES_RAD_S.len())
            .map(|frequency| {
                let block = blocks[position(frequency, REFERENCE)];
                on_levels(&used, records, |im, record| {
                    let method = Adjust::SlendernessAdjustment;
                    self.setup.demand(block, record, im, method)
                })
            })
            .collect::<Result<_, _>>()?;
        let mut out = Vec::new();
        for ArmCurves { arm, curves: adjusted } in &results.adjusted {
            let Some(curves) = results.curves(*arm) else { continue };
            let apply = |runs: &[Vec<f64>], curves: &[ResponseCurve]| {
                used.iter()
                    .zip(runs)
                    .map(|(im, row)| {
                        row.iter()
                            .zip(curves)
                            .map(|(run, curve)| {
                                on_stripe(*im, curve.overturning_im(), *run)
                            })
                            .collect::<Vec<f64>>()
                    })
                    .collect::<Vec<_>>()
            };
            let demands: Vec<Vec<Vec<f64>>> =
                runs.iter().zip(curves).map(|(r, c)| apply(r, c)).collect();
            let adjusted = adjusted_runs
                .iter()
                .zip(adjusted)
                .map(|(r, c)| apply(r, c))
                .collect();
            // Overturned by the rule, yet finite by its own run.
            let stands_again = demands
                .iter()
                .zip(&runs)
                .map(|(demands, runs): (&Vec<Vec<f64>>, &Vec<Vec<f64>>)| {
                    let again = |d: &Vec<f64>, r: &Vec<f64>| {
                        d.iter()
                            .zip(r)
                            .map(|(d, r)| d.is_infinite() && r.is_finite())
                            .collect()
                    };
                    demands
                        .iter()
                        .zip(runs)
                        .map(|(d, r)| again(d, r))
                        .collect()
                })
                .collect();
            out.push(StripeDemands {
                arm: *arm,
                stands_again,
                demands,
                adjusted,
            });
        }
        Ok(out)
    }

    /// Stripes at which at least ten records stand in the reference block
    /// of some frequency parameter, in any arm drawn.
    fn used_stripes(&self, results: &SuiteResults) -> Vec<f64> {
        let stands = |im: f64| {
            self.drawn().iter().any(|arm| {
                let curves = results.curves(*arm).unwrap_or_default();
                (0..FREQUENCIES_RAD_S.len()).any(|frequency| {
                    let block = curves.get(position(frequency, REFERENCE));
                    let standing = block.map_or(0, |records| {
                        records
                            .iter()
                            .filter(|c| {
                                c.overturning_im().is_none_or(|o| im < o)
                            })
                            .count()
                    });
                    standing >= LEAST_USABLE
                })
            })
        };
        STRIPES.iter().copied().filter(|im| stands(*im)).collect()
    }
}

fn on_levels(
    levels: &[f64],
    records: &[NormalisedRecord],
    run: impl Fn(f64, &NormalisedRecord) -> anyhow::Result<f64> + Sync,
) -> anyhow::Result<Vec<Vec<f64>>> {
    levels
        .iter()
        .map(|im| records.par_iter().map(|r| run(*im, r)).collect())
        .collect()
}

/// Demand of a record on a stripe: infinite once the scan along rising
/// intensity overturned at or below the level, whatever a run there gives.
fn on_stripe(level: f64, overturning: Option<f64>, run: f64) -> f64 {
    match overturning {
        Some(first) if !(level < first) => f64::INFINITY,
        _ => run,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_overturned_below_does_not_stand_again() {
        assert_eq!(on_stripe(1.5, Some(1.6), 0.4), 0.4);
        assert_eq!(on_stripe(1.6, Some(1.6), 0.4), f64::INFINITY);
        assert_eq!(on_stripe(2.0, Some(1.6), 0.4), f64::INFINITY);
        assert_eq!(on_stripe(2.0, None, 0.4), 0.4);
    }
}
