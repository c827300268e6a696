//! Which records the single-record figures show, and at which level: rules
//! fixed before any result.

/// Positions of the records at ranks 1/6, 3/6 and 5/6 of `ratios` (PGV/PGA):
/// of n values in rising order those numbered ceil(n/6), ceil(n/2) and
/// ceil(5n/6). Equal ratios keep their order.
#[must_use]
pub fn by_rank(ratios: &[f64]) -> [usize; 3] {
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
#[must_use]
pub fn common_level(last_standing: &[Vec<f64>]) -> f64 {
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
}
