//! Repeatability of tests.

use super::Repeatability;
use super::fates::Fates;
use rocking_statistics::lognormal::dispersion_within;

/// Tests of one motion repeat each other up to this ratio of their PGA.
const SAME: f64 = 1.05;

/// The repeatability of tests at these PGA.
pub(super) fn repeatability(pga_g: &[f64], fates: &Fates) -> Repeatability {
    let mut found = Repeatability::default();
    let mut groups = Vec::new();
    for motion in 0..fates.motions.count() {
        let tests = fates.motions.members(motion).iter();
        let own: Vec<(f64, bool)> =
            tests.map(|i| (pga_g[*i], fates.overturned[*i])).collect();
        for (k, (a, fate)) in own.iter().enumerate() {
            for (b, other) in &own[..k] {
                if a.max(*b) <= SAME * a.min(*b) {
                    found.pairs += 1;
                    found.different += usize::from(fate != other);
                }
            }
        }
        let of = |fate: bool| own.iter().filter(move |one| one.1 == fate);
        let first = of(true).map(|one| one.0).fold(f64::INFINITY, f64::min);
        let last = of(false).map(|one| one.0).fold(0.0, f64::max);
        if first.is_finite() && last > 0.0 {
            found.mixed_motions += 1;
            found.not_monotone += usize::from(first < last);
            groups.push(own);
        }
    }
    found.dispersion = dispersion_within(&groups);
    found
}
