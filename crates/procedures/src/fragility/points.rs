//! A fragility as points between which a reader interpolates.

use libm::exp;
use thiserror::Error;

use super::total::{Parts, TotalFragility};
use rocking_statistics::normal;
use rocking_statistics::search::narrow;

/// Intervals tried before a tolerance is called too small.
const MOST_INTERVALS: u32 = 1 << 14;

/// Halvings in the search of the largest error of a chord, which is flat
/// there: 20 of them give it to about 1e-11 of its value.
const HALVINGS: u32 = 20;

/// A tolerance out of range.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("tolerance {0} in probability: expected a number from 1e-8 to 0.1")]
pub struct PointsError(f64);

/// Points (x, F(x)) of a fragility, dense enough that straight lines between
/// them differ from F by at most a tolerance in probability.
///
/// `fragility` above shift r, a total above 0, x in its unit; `tolerance` t
/// from 1e-8 to 0.1. The first point is (r, 0), the last has probability 1,
/// and both coordinates rise strictly. Between the scores of t/4 and 1 - t/4
/// the points lie at equal steps of the normal score of F on either side of
/// the mode, which is a point too: so F is convex or concave between two
/// points, and the error of a chord is greatest where F has its slope.
///
/// ```
/// use rocking_procedures::fragility::points::points;
/// use rocking_statistics::Lognormal;
/// let fragility = Lognormal::try_new(1.0, 0.4, 0.7)?;
/// let found = points(fragility, 5e-4)?;
/// assert_eq!(found[0], (1.0, 0.0));
/// assert_eq!(found[found.len() - 1].1, 1.0);
/// assert!(found.len() < 100);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`PointsError`] for a tolerance out of range.
pub fn points(
    fragility: impl Into<TotalFragility>,
    tolerance: f64,
) -> Result<Vec<(f64, f64)>, PointsError> {
    let fragility = &fragility.into().parts();
    let refused = PointsError(tolerance);
    if !(1e-8..=0.1).contains(&tolerance) {
        return Err(refused);
    }
    let last = -normal::quantile(0.25 * tolerance);
    let mode = fragility.mode_score().clamp(-last, last);
    let mut intervals = 8;
    while intervals <= MOST_INTERVALS {
        let found = at_equal_scores(fragility, (mode, last), intervals);
        if hold(fragility, &found, tolerance) {
            return Ok(found);
        }
        // A quarter more: close to the least number that will do.
        intervals += intervals / 4;
    }
    Err(refused)
}

/// Points at about `intervals` equal steps up to the score `last` on either
/// side, with the mode.
fn at_equal_scores(
    fragility: &Parts,
    (mode, last): (f64, f64),
    intervals: u32,
) -> Vec<(f64, f64)> {
    let place = |z: f64| (fragility.at_score(z), normal::cdf(z));
    let step = 2.0 * last / f64::from(intervals);
    let shift = fragility.total.closed().map_or(0.0, |law| law.shift());
    let mut found = vec![(shift, 0.0)];
    let mut add = |(x, p): (f64, f64)| {
        // Two scores may be closer than the resolution of doubles.
        if found.last().is_none_or(|before| x > before.0 && p > before.1) {
            found.push((x, p));
        }
    };
    for (from, to) in [(-last, mode), (mode, last)] {
        let count = ((to - from) / step).ceil();
        for k in 0..count as u32 {
            add(place(from + (to - from) * f64::from(k) / count));
        }
    }
    add((place(last).0, 1.0));
    found
}

/// Whether F differs by at most a tolerance from straight lines between the
/// points, which F crosses no inflection between; it is 1 beyond the last.
fn hold(fragility: &Parts, points: &[(f64, f64)], tolerance: f64) -> bool {
    let end = points[points.len() - 1];
    let line_holds = |pair: &[(f64, f64)]| {
        let ((a, p), (b, q)) = (pair[0], pair[1]);
        let slope = (q - p) / (b - a);
        let error =
            |x: f64| (fragility.cdf(x) - slope.mul_add(x - a, p)).abs();
        let steeper = |x: f64| exp(fragility.ln_pdf(x)) > slope;
        // The density rises or falls throughout: bisect for the slope.
        let at_the_low_end = steeper(a);
        let mut halvings = 0..HALVINGS;
        let goes_on = |_, _| halvings.next().is_some();
        let (low, _) = narrow(a, b, goes_on, |x| steeper(x) == at_the_low_end);
        error(low) <= tolerance && error(b) <= tolerance
    };
    fragility.survival(end.0) <= tolerance && points.windows(2).all(line_holds)
}

#[cfg(test)]
mod tests {
    use rocking_statistics::Lognormal;

    use super::*;

    /// Largest difference to linear interpolation at many intensities.
    fn difference(fragility: &TotalFragility, points: &[(f64, f64)]) -> f64 {
        let end = points[points.len() - 1].0;
        (0..=20_000).map(|k| 1.2 * end * f64::from(k) / 2e4).fold(
            0.0,
            |worst: f64, x| {
                let after = points.partition_point(|point| point.0 <= x);
                let read = match after {
                    0 => 0.0,
                    n if n == points.len() => 1.0,
                    n => {
                        let ((a, p), (b, q)) = (points[n - 1], points[n]);
                        p + (q - p) * (x - a) / (b - a)
                    }
                };
                worst.max((fragility.cdf(x) - read).abs())
            },
        )
    }

    #[test]
    fn straight_lines_hold_the_tolerance_and_not_much_more() {
        for (shift, beta, s) in [
            (0.0, 0.4, 0.0),
            (0.15, 0.713, 0.0),
            (1.0, 0.2, 0.0),
            (1.0, 1.5, 0.0),
            (0.3, 4.5, 0.0),
            (0.0, 0.4, 0.2),
            (0.15, 0.713, 0.2),
            (1.0, 1.5, 0.05),
        ] {
            let records = Lognormal::try_new(shift, -0.3, beta).unwrap();
            let fragility = TotalFragility::try_new(records, 1.1, s).unwrap();
            let finest = if s > 0.0 { 2 } else { 3 };
            for tolerance in [1e-2, 5e-4, 1e-5].into_iter().take(finest) {
                let found = points(fragility, tolerance).unwrap();
                let error = difference(&fragility, &found);
                assert!(error <= tolerance, "{shift} {beta}: {error:e}");
                let rising = found
                    .windows(2)
                    .all(|w| w[0].0 < w[1].0 && w[0].1 < w[1].1);
                assert!(rising);
                // Three points in four of them do not do.
                let fewer: Vec<(f64, f64)> =
                    found.iter().copied().step_by(4).collect();
                assert!(difference(&fragility, &fewer) > tolerance);
            }
        }
    }

    #[test]
    fn a_tolerance_out_of_range_is_refused() {
        let fragility = Lognormal::try_new(1.0, 0.0, 0.5).unwrap();
        for tolerance in [0.0, -1e-3, 1e-9, 0.2, f64::NAN] {
            assert!(points(fragility, tolerance).is_err());
        }
    }
}
