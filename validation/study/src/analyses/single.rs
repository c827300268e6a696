//! Single records: which records are shown, at which level, and how far their
//! histories and curves are apart. The rules were fixed before any result.

use rayon::prelude::*;
use rocking::block::Block;
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking::excitation::NormalisedRecord;

use super::suite::{Deviation, ShownHistory, SingleRecords};
use crate::distributions::least;
use crate::estimates::mean;
use crate::facts::Facts;
use crate::runs::{DEMANDS, Setup, capacities};
use rocking_common::paper::{
    BLOCKS, FREQUENCIES_RAD_S, REFERENCE, SLENDERNESSES_RAD, position,
};

/// Interval at which histories are compared and drawn, in s.
pub const HISTORY_INTERVAL_S: f64 = 0.01;

/// Intensities PGA/(g tan alpha) at which histories of both suites are
/// compared: from just above uplift to the onset of overturning.
pub const LEVELS_IM: [f64; 4] = [1.25, 1.5, 2.0, 3.0];

/// Intensity, and rotation over slenderness that the smallest blocks must reach
/// there while they stand, for a record to be shown by itself. Its figures then show
/// motions and curves, not a fall.
const ROCKS: (f64, f64) = (1.5, 0.05);

/// The records that are shown by themselves: ranks 1/6, 3/6 and 5/6 of PGV/PGA among
/// the records under which the smallest block of every slenderness rocks
/// ([`ROCKS`]), or among all records if fewer than three qualify. The curves are
/// by block, then by record.
pub(super) fn shown_alone(
    curves: &[Vec<ResponseCurve>],
    records: &[Facts],
) -> [usize; 3] {
    let smallest = FREQUENCIES_RAD_S.len() - 1;
    let rocks = |record: usize| {
        (0..SLENDERNESSES_RAD.len()).all(|s| {
            let curve = &curves[position(smallest, s)][record];
            let demand = curve.edp_at(ROCKS.0);
            demand.is_some_and(|e| e.is_finite() && e >= ROCKS.1)
        })
    };
    let ratios: Vec<f64> =
        records.iter().map(|record| record.velocity_ratio_s).collect();
    by_rank_among(&ratios, rocks)
}

/// Histories of the `chosen` records by frequency parameter, and the distance
/// of all records' histories and curves from the reference slenderness.
pub(super) fn single_records(
    setup: &Setup,
    records: &[NormalisedRecord],
    curves: &[Vec<ResponseCurve>],
    chosen: [usize; 3],
) -> anyhow::Result<Vec<SingleRecords>> {
    let slendernesses = SLENDERNESSES_RAD.len();
    let blocks = BLOCKS.chunks(slendernesses);
    let all =
        blocks.zip(curves.chunks(slendernesses)).map(|(blocks, curves)| {
            let last = |curve: &ResponseCurve| match curve.overturning_im() {
                Some(_) => curve.last_im(),
                None => f64::INFINITY,
            };
            let standing = chosen.map(|record| -> Vec<f64> {
                curves.iter().map(|own| last(&own[record])).collect()
            });
            let im = common_level(&standing);
            let at_level = |im: f64| -> anyhow::Result<(Vec<_>, Vec<_>)> {
                let of_record = |record: usize| {
                    let normalised = &records[record];
                    let history = |block: &Block| {
                        setup.history(
                            *block,
                            normalised,
                            im,
                            HISTORY_INTERVAL_S,
                        )
                    };
                    let histories = blocks.iter().map(history);
                    let histories: Vec<ShownHistory> =
                        histories.collect::<Result<_, _>>()?;
                    let own = |s: usize| (&histories[s], &curves[s][record]);
                    let others =
                        (0..slendernesses).filter(|s| *s != REFERENCE);
                    let apart = others.map(|s| apart(own(s), own(REFERENCE)));
                    let apart = apart.collect::<anyhow::Result<Vec<_>>>()?;
                    let is_kept = chosen.contains(&record);
                    let kept = if is_kept { histories } else { Vec::new() };
                    Ok((kept, apart))
                };
                let all = (0..records.len()).into_par_iter().map(of_record);
                let all: Vec<_> = all.collect::<anyhow::Result<_>>()?;
                Ok(all.into_iter().unzip())
            };
            let (histories, apart) = at_level(im)?;
            let by_level = LEVELS_IM.map(|im| Ok(at_level(im)?.1)).into_iter();
            let by_level = by_level.collect::<anyhow::Result<_>>()?;
            let histories =
                chosen.map(|record| histories[record].clone()).into();
            Ok(SingleRecords { im, histories, apart, by_level })
        });
    all.collect()
}

fn apart(
    ((history, peak), curve): (&ShownHistory, &ResponseCurve),
    ((reference, its_peak), its_curve): (&ShownHistory, &ResponseCurve),
) -> anyhow::Result<Deviation> {
    let stand = peak.is_finite() && its_peak.is_finite();
    let when_standing = |x: f64| if stand { x } else { f64::NAN };
    let a = capacities(curve, &DEMANDS, InversionRule::Median)?;
    let b = capacities(its_curve, &DEMANDS, InversionRule::Median)?;
    Ok(Deviation {
        distance: when_standing(distance(history, reference)),
        peak_ratio: when_standing(peak / its_peak),
        mean_ln_im: mean_log_ratio(&a, &b),
    })
}

/// [`by_rank`] among the records that rock, or among all records if fewer than
/// three rock.
fn by_rank_among(ratios: &[f64], rocks: impl Fn(usize) -> bool) -> [usize; 3] {
    let mut records: Vec<usize> =
        (0..ratios.len()).filter(|record| rocks(*record)).collect();
    if records.len() < 3 {
        records = (0..ratios.len()).collect();
    }
    let own: Vec<f64> = records.iter().map(|r| ratios[*r]).collect();
    by_rank(&own).map(|place| records[place])
}

/// Positions of the records at ranks 1/6, 3/6 and 5/6 of `ratios` (PGV/PGA):
/// numbers ceil(n/6), ceil(n/2) and ceil(5n/6) of n values in rising order.
/// Equal ratios keep their order.
fn by_rank(ratios: &[f64]) -> [usize; 3] {
    let mut order: Vec<usize> = (0..ratios.len()).collect();
    order.sort_by(|a, b| ratios[*a].total_cmp(&ratios[*b]));
    [1, 3, 5].map(|sixths| {
        let rank = (ratios.len() * sixths).div_ceil(6);
        order.get(rank.saturating_sub(1)).copied().unwrap_or(0)
    })
}

/// The largest grid intensity at which at least four of the five
/// slendernesses stand under every record. The argument contains, by record and
/// slenderness, the last grid intensity before first overturning (infinite if
/// the block never overturned).
fn common_level(last_standing: &[Vec<f64>]) -> f64 {
    let second = |record: &Vec<f64>| {
        let mut levels = record.clone();
        levels.sort_by(f64::total_cmp);
        // The block at the lowest level may have overturned.
        levels.get(1).copied().unwrap_or(f64::INFINITY)
    };
    least(&last_standing.iter().map(second).collect::<Vec<f64>>())
}

/// Normalized L2 distance of two histories of theta/alpha sampled at the
/// same equal intervals: the root of the integral of the squared difference
/// over the integral of the squared reference. The shorter history has come to
/// rest and continues as zero. NaN if the reference never moves.
fn distance(compared: &[f64], reference: &[f64]) -> f64 {
    let length = compared.len().max(reference.len());
    let [a, b] = [compared, reference]
        .map(|own| own.iter().chain(std::iter::repeat(&0.0)).take(length));
    let size: f64 = b.clone().map(|b| b * b).sum();
    let apart: f64 = a.zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
    if size > 0.0 { f64::sqrt(apart / size) } else { f64::NAN }
}

/// Mean of |ln(a/b)| over the pairs in which both are finite; NaN without a
/// pair.
fn mean_log_ratio(a: &[f64], b: &[f64]) -> f64 {
    mean(a.iter().zip(b).map(|(x, y)| libm::log(x / y).abs()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ranks_of_the_suites_sizes() {
        // By hand: 86/6 = 14.3, 43, 71.7; 44/6 = 7.3, 22, 36.7.
        let rising = |n: u32| (0..n).map(f64::from).collect::<Vec<_>>();
        assert_eq!(by_rank(&rising(86)), [14, 42, 71]);
        assert_eq!(by_rank(&rising(44)), [7, 21, 36]);
        let falling: Vec<f64> = rising(86).into_iter().rev().collect();
        assert_eq!(by_rank(&falling), [71, 43, 14]);
    }

    #[test]
    fn records_that_do_not_rock_are_not_shown_alone() {
        let falling: Vec<f64> = (0..8).rev().map(f64::from).collect();
        // Of 1, 3, 5, 7 the last has the smallest ratio: ranks 1, 2 and 4.
        assert_eq!(by_rank_among(&falling, |r| r % 2 == 1), [7, 5, 1]);
        assert_eq!(by_rank_among(&falling, |r| r < 2), by_rank(&falling));
    }

    #[test]
    fn one_of_five_may_have_overturned_in_each_record() {
        let inf = f64::INFINITY;
        let level = common_level(&[
            vec![1.2, 3.0, 2.8, inf, inf],
            vec![2.4, 2.6, 2.5, 1.1, 9.0],
            vec![inf, inf, inf, inf, inf],
        ]);
        // Record by record the second lowest: 2.8, 2.4, never.
        assert_eq!(level, 2.4);
    }

    #[test]
    fn distance_of_scaled_and_opposite_histories() {
        let y = [0.0, 0.3, -0.4, 0.0];
        let twice: Vec<f64> = y.iter().map(|v| 2.0 * v).collect();
        let opposite: Vec<f64> = y.iter().map(|v| -v).collect();
        assert_eq!(distance(&y, &y), 0.0);
        assert_eq!(distance(&twice, &y), 1.0);
        assert_eq!(distance(&opposite, &y), 2.0);
        // A longer history is compared with rest.
        assert_eq!(distance(&[0.0, 0.3, -0.4, 0.0, 0.5], &y), 1.0);
        assert!(distance(&y, &[0.0]).is_nan());
    }

    #[test]
    fn log_ratio_leaves_censored_levels_out() {
        let inf = f64::INFINITY;
        let mean = mean_log_ratio(&[2.0, 1.0, inf], &[1.0, 4.0, 3.0]);
        assert!((mean - 1.5 * libm::log(2.0)).abs() < 1e-15);
        assert!(mean_log_ratio(&[inf], &[1.0]).is_nan());
    }
}
