//! Single records: which are shown, at which level, and how far their
//! histories and curves are apart. The rules were fixed before any result.

use rayon::prelude::*;
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking::excitation::NormalisedRecord;

use super::suite::{Deviation, ShownHistory, SingleRecords};
use crate::facts::Facts;
use crate::runs::{Setup, capacities};
use rocking_common::paper::{
    BLOCKS, FREQUENCIES_RAD_S, REFERENCE, SLENDERNESSES_RAD, position,
};

/// Interval at which histories are compared and drawn, in s.
pub const HISTORY_INTERVAL_S: f64 = 0.01;

/// Intensities PGA/(g tan alpha) at which histories of both suites are
/// compared: from just above uplift to where blocks begin to overturn.
pub const LEVELS_IM: [f64; 4] = [1.25, 1.5, 2.0, 3.0];

/// What the smallest blocks must reach under a record that is shown alone,
/// standing: its figures then show motions and curves, not a fall. Intensity,
/// and rotation over slenderness there.
const ROCKS: (f64, f64) = (1.5, 0.05);

/// The records that are shown alone: those at ranks 1/6, 3/6 and 5/6 of
/// PGV/PGA among the records under which the smallest block of every
/// slenderness rocks ([`ROCKS`]), or among all if these are fewer than
/// three. The curves are by block, then by record.
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

/// Histories of the `chosen` records, and how far the histories and curves
/// of all records are apart, for one frequency parameter.
pub(super) fn single_records(
    setup: &Setup,
    frequency: usize,
    records: &[NormalisedRecord],
    curves: &[Vec<ResponseCurve>],
    chosen: [usize; 3],
) -> anyhow::Result<SingleRecords> {
    let of = |slenderness, record: usize| -> &ResponseCurve {
        &curves[position(frequency, slenderness)][record]
    };
    let last = |curve: &ResponseCurve| match curve.overturning_im() {
        Some(_) => curve.last_im(),
        None => f64::INFINITY,
    };
    let slendernesses = 0..SLENDERNESSES_RAD.len();
    let standing: Vec<Vec<f64>> = chosen
        .iter()
        .map(|r| slendernesses.clone().map(|s| last(of(s, *r))).collect())
        .collect();
    let im = common_level(&standing);
    let at_level = |record: usize, im: f64| -> anyhow::Result<_> {
        let histories: Vec<(Vec<f64>, f64)> = slendernesses
            .clone()
            .map(|s| {
                setup.history(
                    BLOCKS[position(frequency, s)],
                    &records[record],
                    im,
                    HISTORY_INTERVAL_S,
                )
            })
            .collect::<Result<_, _>>()?;
        let apart = slendernesses
            .clone()
            .filter(|s| *s != REFERENCE)
            .map(|s| {
                let (a, b) = (&histories[s], &histories[REFERENCE]);
                let curves = (of(s, record), of(REFERENCE, record));
                apart(a, b, curves)
            })
            .collect::<Result<Vec<Deviation>, _>>()?;
        Ok((histories, apart))
    };
    let all: Vec<(Vec<ShownHistory>, Vec<Deviation>)> = (0..records.len())
        .into_par_iter()
        .map(|record| {
            let (histories, apart) = at_level(record, im)?;
            let kept = if chosen.contains(&record) {
                histories
                    .into_iter()
                    .map(|(h, peak)| (h, peak.is_infinite()))
                    .collect()
            } else {
                Vec::new()
            };
            Ok((kept, apart))
        })
        .collect::<anyhow::Result<_>>()?;
    let by_level = LEVELS_IM
        .into_iter()
        .map(|im| {
            let apart = (0..records.len())
                .into_par_iter()
                .map(|record| Ok(at_level(record, im)?.1))
                .collect::<anyhow::Result<_>>()?;
            Ok((im, apart))
        })
        .collect::<anyhow::Result<_>>()?;
    let histories = chosen.iter().map(|r| all[*r].0.clone()).collect();
    let apart = all.into_iter().map(|(_, apart)| apart).collect();
    Ok(SingleRecords { im, histories, apart, by_level })
}
fn apart(
    compared: &(Vec<f64>, f64),
    reference: &(Vec<f64>, f64),
    curves: (&ResponseCurve, &ResponseCurve),
) -> anyhow::Result<Deviation> {
    let stand = compared.1.is_finite() && reference.1.is_finite();
    let when_standing = |x: f64| if stand { x } else { f64::NAN };
    // Demands 0.1, 0.2, ... 1.0.
    let levels: Vec<f64> = (1..=10).map(|k| f64::from(k) / 10.0).collect();
    let a = capacities(curves.0, &levels, InversionRule::Median)?;
    let b = capacities(curves.1, &levels, InversionRule::Median)?;
    Ok(Deviation {
        distance: when_standing(distance(&compared.0, &reference.0)),
        peak_ratio: when_standing(compared.1 / reference.1),
        mean_ln_im: mean_log_ratio(&a, &b),
    })
}

/// [`by_rank`] among the records that rock, or among all if these are fewer
/// than three.
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
/// of n values in rising order those numbered ceil(n/6), ceil(n/2) and
/// ceil(5n/6). Equal ratios keep their order.
fn by_rank(ratios: &[f64]) -> [usize; 3] {
    let mut order: Vec<usize> = (0..ratios.len()).collect();
    order.sort_by(|a, b| ratios[*a].total_cmp(&ratios[*b]));
    [1, 3, 5].map(|sixths| {
        let rank = (ratios.len() * sixths).div_ceil(6);
        order.get(rank.saturating_sub(1)).copied().unwrap_or(0)
    })
}

/// The largest grid intensity at which at least four of the five
/// slendernesses stand, for all records; the argument holds by record and
/// slenderness the last grid intensity before first overturning (infinite
/// where the block never overturned).
fn common_level(last_standing: &[Vec<f64>]) -> f64 {
    let mut least = f64::INFINITY;
    for record in last_standing {
        let mut levels = record.clone();
        levels.sort_by(f64::total_cmp);
        // The lowest one may have overturned.
        let second = levels.get(1).copied().unwrap_or(f64::INFINITY);
        if second < least {
            least = second;
        }
    }
    least
}

/// Normalized L2 distance of two histories of theta/alpha sampled at the
/// same equal intervals: the root of the integral of the squared difference
/// over that of the squared reference; the shorter one has come to rest and
/// continues as zero. NaN where the reference never moves.
fn distance(compared: &[f64], reference: &[f64]) -> f64 {
    let at = |history: &[f64], i| history.get(i).copied().unwrap_or(0.0);
    let length = compared.len().max(reference.len());
    let (mut apart, mut size) = (0.0, 0.0);
    for i in 0..length {
        let (a, b) = (at(compared, i), at(reference, i));
        apart += (a - b) * (a - b);
        size += b * b;
    }
    if size > 0.0 { f64::sqrt(apart / size) } else { f64::NAN }
}

/// Mean of |ln(a/b)| over the pairs in which both are finite; NaN where
/// there is none.
fn mean_log_ratio(a: &[f64], b: &[f64]) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for (x, y) in a.iter().zip(b) {
        if x.is_finite() && y.is_finite() {
            sum += libm::log(x / y).abs();
            count += 1.0;
        }
    }
    sum / count
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
