//! Maximum likelihood of normal values known exactly or by an interval.

use libm::{exp, log};

use super::FitError;
use crate::normal::{LN_SQRT_TWO_PI, cdf, ln_cdf, survival};
use crate::search::zero;

const STEPS: usize = 100;

/// An observation of a value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Observation {
    /// The value.
    Exact(f64),
    /// It lies between the first two, one of which may be infinite; the third
    /// is the number of such values.
    Interval(f64, f64, f64),
}

use Observation::{Exact, Interval};

/// The log-likelihood at (a, b) = (1/sigma, mu/sigma), its gradient and its
/// second derivatives (aa, ab, bb).
pub(crate) struct Point {
    pub(crate) value: f64,
    pub(crate) gradient: [f64; 2],
    pub(crate) curvature: [f64; 3],
}

impl Point {
    pub(crate) fn new(observations: &[Observation], a: f64, b: f64) -> Self {
        let mut point =
            Self { value: 0.0, gradient: [0.0; 2], curvature: [0.0; 3] };
        for observation in observations {
            match *observation {
                Exact(y) => point.add_exact(y, a, b),
                Interval(low, high, n) => point.add([low, high], n, a, b),
            }
        }
        point
    }

    fn add_exact(&mut self, y: f64, a: f64, b: f64) {
        let z = f64::mul_add(a, y, -b);
        self.value += log(a) - 0.5 * z * z - LN_SQRT_TWO_PI;
        self.gradient[0] += 1.0 / a - z * y;
        self.gradient[1] += z;
        self.curvature[0] -= f64::mul_add(y, y, 1.0 / (a * a));
        self.curvature[1] += y;
        self.curvature[2] -= 1.0;
    }

    fn add(&mut self, [low, high]: [f64; 2], count: f64, a: f64, b: f64) {
        let score = |y: f64| f64::mul_add(a, y, -b);
        let (z0, z1) = (score(low), score(high));
        let ln_p = if high == f64::INFINITY {
            ln_cdf(-z0)
        } else if low == f64::NEG_INFINITY {
            ln_cdf(z1)
        } else if z0 > 0.0 {
            log(survival(z0) - survival(z1))
        } else {
            log(cdf(z1) - cdf(z0))
        };
        // (phi/P, z phi/P) at an end; both vanish at infinity.
        let end = |y: f64, z: f64| {
            if y.is_infinite() {
                return (0.0, 0.0, 0.0);
            }
            let ratio = exp(-0.5 * z * z - LN_SQRT_TWO_PI - ln_p);
            (y, ratio, z * ratio)
        };
        let (y0, f0, g0) = end(low, z0);
        let (y1, f1, g1) = end(high, z1);
        let (da, db) = (y1 * f1 - y0 * f0, f0 - f1);
        self.value += count * ln_p;
        self.gradient[0] += count * da;
        self.gradient[1] += count * db;
        self.curvature[0] -= count * (y1 * y1 * g1 - y0 * y0 * g0 + da * da);
        self.curvature[1] += count * (y1 * g1 - y0 * g0 - da * db);
        self.curvature[2] -= count * (g1 - g0 + db * db);
    }
}

/// Mean and standard deviation that maximise the likelihood, and its
/// logarithm; from a rough centre and spread.
pub(super) fn maximise(
    observations: &[Observation],
    centre: f64,
    spread: f64,
) -> Result<(f64, f64, f64), FitError> {
    let (all, deviation) =
        maximise_together(&[(observations, centre)], spread)?;
    let (mean, value) = all[0];
    Ok((mean, deviation, value))
}

/// The mean and the logarithm of the likelihood of each group, and the one
/// standard deviation of all, that maximise the likelihood of all; from
/// rough centres and a spread.
///
/// In (1/sigma, mu_1/sigma, mu_2/sigma, ..) the log-likelihood is concave,
/// exact values or intervals, so that Newton's method with a halved step finds
/// its one maximum.
pub(super) fn maximise_together(
    groups: &[(&[Observation], f64)],
    spread: f64,
) -> Result<(Vec<(f64, f64)>, f64), FitError> {
    let standardised = |(observations, centre): &(&[Observation], f64)| {
        let standard = |y: f64| (y - centre) / spread;
        let all = observations.iter().map(|observation| match *observation {
            Exact(y) => Exact(standard(y)),
            Interval(low, high, count) => {
                Interval(standard(low), standard(high), count)
            }
        });
        all.collect::<Vec<_>>()
    };
    let standard: Vec<_> = groups.iter().map(standardised).collect();
    let points = |a: f64, b: &[f64]| {
        let pairs = standard.iter().zip(b);
        pairs.map(|(own, b)| Point::new(own, a, *b)).collect::<Vec<_>>()
    };
    let value =
        |all: &Vec<Point>| all.iter().fold(0.0, |sum, p| sum + p.value);
    let mut start = vec![0.0; groups.len() + 1];
    start[0] = 1.0;
    let steps = |here: &Vec<Point>| {
        let all: Vec<_> = (0..groups.len()).map(|j| step(here, j)).collect();
        let first = all.first().map_or(0.0, |step| step.0);
        std::iter::once(first).chain(all.iter().map(|step| step.1)).collect()
    };
    let at = |place: &[f64]| points(place[0], &place[1..]);
    let (place, here) = climb(start, at, value, steps)?;
    let (a, b) = (place[0], &place[1..]);
    let found = |(j, (own, centre)): (usize, &(&[Observation], f64))| {
        let exact = own.iter().filter(|o| matches!(o, Exact(_)));
        let scale = exact.count() as f64 * log(spread);
        (centre + spread * b[j] / a, here[j].value - scale)
    };
    Ok((groups.iter().enumerate().map(found).collect(), spread / a))
}

/// The place, from `start` on, of the one maximum of a concave log-likelihood,
/// and what `at` finds there: by Newton's method with a halved step. The first
/// number of a place is 1/sigma, which stays positive.
pub(crate) fn climb<T>(
    start: Vec<f64>,
    at: impl Fn(&[f64]) -> T,
    value: impl Fn(&T) -> f64,
    steps: impl Fn(&T) -> Vec<f64>,
) -> Result<(Vec<f64>, T), FitError> {
    let mut here = at(&start);
    let (mut place, mut last) = (start, f64::INFINITY);
    for _ in 0..STEPS {
        let step = steps(&here);
        if step.iter().any(|by| by.is_nan()) {
            break;
        }
        let rest = step.iter().zip(&place).skip(1);
        let size = rest.fold(0.0, |size: f64, (step_b, b)| {
            size.max(step[0].abs().max(step_b.abs()) / (place[0] + b.abs()))
        });
        // Newton's steps shrink until the rounding of narrow intervals.
        if size < 1e-13 || (size < 1e-7 && size >= last) {
            return Ok((place, here));
        }
        last = size;
        let mut share = 1.0;
        loop {
            let moved = place.iter().zip(&step);
            let next: Vec<f64> = moved.map(|(x, by)| x - share * by).collect();
            if next[0] > 0.0 {
                let found = at(&next);
                let (old, new) = (value(&here), value(&found));
                // At the maximum the value is the same after each step, to
                // rounding.
                if new >= old - 1e-13 * old.abs() {
                    (place, here) = (next, found);
                    break;
                }
            }
            share *= 0.5;
            if share.is_nan() || share < 1e-12 {
                return Err(FitError::NotConverged(STEPS));
            }
        }
    }
    Err(FitError::NotConverged(STEPS))
}

/// Newton's step of 1/sigma, and of mu/sigma of a group, the other groups'
/// eliminated.
fn step(all: &[Point], group: usize) -> (f64, f64) {
    let ([mut aa, ab, bb], [mut da, db]) =
        (all[group].curvature, all[group].gradient);
    for (_, other) in all.iter().enumerate().filter(|(j, _)| *j != group) {
        let ratio = other.curvature[1] / other.curvature[2];
        aa += other.curvature[0] - ratio * other.curvature[1];
        da += other.gradient[0] - ratio * other.gradient[1];
    }
    let determinant = aa * bb - ab * ab;
    ((bb * da - ab * db) / determinant, (aa * db - ab * da) / determinant)
}

/// Half of the 95 % quantile of chi-squared with one degree of freedom.
pub(super) const DROP: f64 = 1.920_729_410_347_062;
/// A log limit beyond this counts as infinite.
const FARTHEST: f64 = 30.0;

/// Limits of the 95 % likelihood interval of the mean and of the standard
/// deviation at whose maximum the log-likelihood is `top`; open if the profile
/// does not fall by 1.92.
///
/// In (1/sigma, mu/sigma), where the log-likelihood is concave, a standard
/// deviation is a line and a mean a ray, so that either profile falls on both
/// sides of its maximum.
pub(super) fn profile_limits(
    observations: &[Observation],
    (mean, deviation, top): (f64, f64, f64),
) -> [crate::Interval; 2] {
    let of_mean = |mu: f64| {
        let start = 1.0 / (deviation + (mu - mean).abs());
        highest(observations, start, |a| (a, mu * a), (1.0, mu))
    };
    let of_ln_deviation = |ln: f64| {
        let a = exp(-ln);
        highest(observations, mean * a, |b| (a, b), (0.0, 1.0))
    };
    // The rounding of the log-likelihood.
    let near = 4.0 * f64::EPSILON * top.abs().max(1.0);
    let end = |from: f64, first: f64, value: &dyn Fn(f64) -> f64| {
        // Almost linear in the distance from the maximum.
        let drop = |by: f64| {
            let drop = top - value(from + by.copysign(first));
            drop.max(0.0).sqrt() - DROP.sqrt()
        };
        let (mut inside, mut step) = ((0.0, -DROP.sqrt()), first.abs());
        while inside.0 + step < FARTHEST {
            let next = (inside.0 + step, drop(inside.0 + step));
            if next.1 > 0.0 {
                let by = zero(drop, inside, next, near);
                return from + by.copysign(first);
            }
            (inside, step) = (next, 1.5 * step);
        }
        f64::INFINITY.copysign(first)
    };
    let step = 0.1 * deviation;
    let ln = log(deviation);
    let closed = |end: f64| if end.is_finite() { exp(end) } else { end };
    let [low, high] = [-0.1, 0.1].map(|step| end(ln, step, &of_ln_deviation));
    // Ends on either side of the maximum.
    [
        crate::Interval::rising(
            end(mean, -step, &of_mean),
            end(mean, step, &of_mean),
        ),
        crate::Interval::rising(closed(low), closed(high)),
    ]
}

/// The highest log-likelihood on a line through (1/sigma, mu/sigma), by
/// Newton's method from `start` with a halved step.
fn highest(
    observations: &[Observation],
    start: f64,
    place: impl Fn(f64) -> (f64, f64),
    (along_a, along_b): (f64, f64),
) -> f64 {
    let at = |t: f64| {
        let (a, b) = place(t);
        Point::new(observations, a, b)
    };
    let mut t = start;
    let mut here = at(t);
    for _ in 0..STEPS {
        let slope = along_a * here.gradient[0] + along_b * here.gradient[1];
        let [aa, ab, bb] = here.curvature;
        let bend = along_a * along_a * aa
            + 2.0 * along_a * along_b * ab
            + along_b * along_b * bb;
        let mut step = -slope / bend;
        if !(step.abs() > 1e-10 * t.abs()) {
            break;
        }
        loop {
            let next = t + step;
            if place(next).0 > 0.0 {
                let point = at(next);
                if point.value >= here.value {
                    (t, here) = (next, point);
                    break;
                }
            }
            step *= 0.5;
            if !(step.abs() > 1e-10 * t.abs()) {
                return here.value;
            }
        }
    }
    here.value
}
