//! Analyses at the levels of the stripes.

use rayon::prelude::*;
use rocking::block::Block;
use rocking::capacity::ResponseCurve;
use rocking::excitation::NormalisedRecord;
use rocking::ida::Adjust;

use super::suite::StripeDemands;
use crate::runs::{ArmCurves, Setup, curves_of};
use rocking_common::paper::{
    BLOCKS, FREQUENCIES_RAD_S, LEAST_USABLE, REFERENCE, STRIPES, position,
};

/// The block of the reference slenderness for each frequency parameter.
pub(super) fn references() -> [Block; FREQUENCIES_RAD_S.len()] {
    std::array::from_fn(|frequency| BLOCKS[position(frequency, REFERENCE)])
}

/// Numbers by block, then by stripe, then by record.
type OnStripes<T> = Vec<Vec<Vec<T>>>;

/// Demands on the stripes for every grid of `adjusted`. Each block, stripe and
/// record is run once; the first overturnings of a grid cut the runs.
pub(super) fn stripe_demands(
    setup: &Setup,
    records: &[NormalisedRecord],
    arms: &[ArmCurves],
    adjusted: &[ArmCurves],
) -> anyhow::Result<Vec<StripeDemands>> {
    let drawn: Vec<(&ArmCurves, &[Vec<ResponseCurve>])> = adjusted
        .iter()
        .map(|own| Ok((own, curves_of(arms, own.arm)?)))
        .collect::<anyhow::Result<_>>()?;
    let used: Vec<f64> = STRIPES
        .into_iter()
        .filter(|im| drawn.iter().any(|(_, own)| is_used(*im, own)))
        .collect();
    let run = |blocks: &[Block], adjust| -> anyhow::Result<OnStripes<f64>> {
        let on_stripe = |block: &Block, im: &f64| {
            let demand = |r| setup.demand(*block, r, *im, adjust);
            records.par_iter().map(demand).collect()
        };
        let on_block =
            |block| used.iter().map(|im| on_stripe(block, im)).collect();
        blocks.iter().map(on_block).collect()
    };
    let runs = run(&BLOCKS, Adjust::RecordScaling)?;
    let adjusted_runs = run(&references(), Adjust::SlendernessAdjustment)?;
    // Stripes rise, and overturned blocks increase: a grid uses the first ones.
    let cut = |runs: &OnStripes<f64>, curves: &[Vec<ResponseCurve>], n| {
        let of_block = |(runs, curves): (&Vec<Vec<f64>>, &Vec<_>)| {
            let of_stripe = |(im, runs): (&f64, &Vec<f64>)| {
                let each = runs.iter().zip(curves);
                let each = each.map(|(run, curve): (_, &ResponseCurve)| {
                    on_stripe(*im, curve.overturning_im(), *run)
                });
                each.collect()
            };
            used.iter().zip(runs).take(n).map(of_stripe).collect()
        };
        runs.iter().zip(curves).map(of_block).collect::<OnStripes<f64>>()
    };
    let of_arm = |(own, curves): (&ArmCurves, &[Vec<ResponseCurve>])| {
        let n = used.iter().filter(|im| is_used(**im, curves)).count();
        let demands = cut(&runs, curves, n);
        // Overturned by the rule, yet finite by its own run.
        let again = |(d, r): (&f64, &f64)| d.is_infinite() && r.is_finite();
        let blocks = demands.iter().zip(&runs).map(|(demands, runs)| {
            let stripes = demands.iter().zip(runs);
            stripes.map(|(d, r)| d.iter().zip(r).map(again).collect())
        });
        let stands_again = blocks.map(Iterator::collect).collect();
        let adjusted = cut(&adjusted_runs, &own.curves, n);
        StripeDemands { arm: own.arm, stands_again, demands, adjusted }
    };
    Ok(drawn.into_iter().map(of_arm).collect())
}

/// Whether at least ten records stand at a stripe in the reference block of
/// some frequency parameter.
fn is_used(im: f64, curves: &[Vec<ResponseCurve>]) -> bool {
    let stands =
        |c: &&ResponseCurve| c.overturning_im().is_none_or(|o| im < o);
    (0..FREQUENCIES_RAD_S.len()).any(|frequency| {
        let records = &curves[position(frequency, REFERENCE)];
        records.iter().filter(stands).count() >= LEAST_USABLE
    })
}

/// Demand of a record on a stripe: infinite once the scan along rising
/// intensity overturned at or below the level, even if the run there stands.
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
