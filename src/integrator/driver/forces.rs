//! Forces at the pivot: how much friction a motion needs, and whether the
//! block stays on the ground.
//!
//! The force at the pivot moves the centre of mass, which lies at distance R =
//! 3 g/(4 p^2) (a rectangle) from the pivot. With u = |theta|, phi = alpha -
//! u, primes for derivatives by p t, and f = s a/g,
//!
//! ```text
//! s H/(m g) = f + 3/4 [ u'' cos phi + u'^2 sin phi ]
//!   N/(m g) = 1 + 3/4 [ u'' sin phi - u'^2 cos phi ]
//! ```
//!
//! and u'' from the equation of motion (the geometry is not linearized with
//! Eq. 2). At uplift from rest H/N is the threshold: tan alpha. At rest H/N is
//! a/g, and N = m g. Impacts are impulses, which no finite force describes.

use crate::excitation::Excitation;
use crate::integrator::Scene;
use crate::integrator::driver::Driver;
use crate::integrator::dynamics::{Dynamics, Model, uplift_threshold};
use crate::integrator::forcing::{Forcing, Moment};
use crate::integrator::taylor::{TaylorSeries, value};
use crate::number::Real;
use crate::number::dispatch::Kernel;

/// R p^2/g of a rectangle.
const ARM: f64 = 0.75;

/// Parts of a step at whose ends the forces are evaluated.
const PARTS: usize = 4;

/// Narrowings of the place of an extreme within a step.
const NARROWINGS: usize = 40;

/// Friction and normal force that a run needs at the pivot.
///
/// Extremes over rest and flight, found on the polynomials of the steps. The
/// impulses of impacts are not forces.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Forces {
    /// Largest |H|/N: the block does not slide if the coefficient of friction
    /// is larger. Infinite if N is not positive.
    pub friction: f64,
    /// Time of the largest |H|/N, s; `None` at rest.
    pub friction_time_s: Option<f64>,
    /// Least N/(m g): the block leaves the ground if it is not positive.
    pub least_normal_over_weight: f64,
    /// Time of the least N/(m g), s; `None` at rest.
    pub least_normal_time_s: Option<f64>,
}

impl Forces {
    /// Forces before the first uplift of a scene. A block that is never
    /// released rests under every |a|/g up to the threshold.
    pub(crate) fn at_rest(scene: &Scene<'_>) -> Self {
        let pga_g = match scene.excitation {
            Excitation::Record(record) => {
                let samples = record.samples().iter();
                let most = samples.fold(0.0, |most: f64, x| most.max(x.abs()));
                most * record.amplitude().abs()
            }
            Excitation::Pulse(pulse) => pulse.pga_g(),
            Excitation::Free => 0.0,
        };
        Self {
            friction: pga_g.min(uplift_threshold(&scene.block, scene.model)),
            friction_time_s: None,
            least_normal_over_weight: 1.0,
            least_normal_time_s: None,
        }
    }

    #[inline(always)]
    fn see(&mut self, (horizontal, normal): (f64, f64), time_s: f64) {
        let friction = ratio(horizontal, normal);
        if friction > self.friction {
            self.friction = friction;
            self.friction_time_s = Some(time_s);
        }
        if normal < self.least_normal_over_weight {
            self.least_normal_over_weight = normal;
            self.least_normal_time_s = Some(time_s);
        }
    }
}

/// |H|/N; infinite if the ground would have to pull.
#[inline(always)]
fn ratio(horizontal: f64, normal: f64) -> f64 {
    if normal > 0.0 { horizontal.abs() / normal } else { f64::INFINITY }
}

/// s H/(m g) and N/(m g) at rotation u and velocity w under f.
#[inline(always)]
fn at_pivot<N: Real>(
    dynamics: &Dynamics<N>,
    (u, w): (f64, f64),
    f: f64,
) -> (f64, f64) {
    let phi = dynamics.alpha.to_f64() - u;
    let (sine, cosine) = libm::sincos(phi);
    let push = match dynamics.model {
        Model::Nonlinear => -sine - f * cosine,
        Model::Linearized => -phi - f,
    };
    let horizontal = f + ARM * (push * cosine + w * w * sine);
    let normal = 1.0 + ARM * (push * sine - w * w * cosine);
    (horizontal, normal)
}

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// Takes in the forces within the part (0, `x`) of a step of `length` from
    /// a place, under the series of f.
    #[inline(never)]
    pub(super) fn see_forces<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
        f: &[N; F],
        (x, length): (N, N),
        place: Moment<N>,
    ) {
        let Some(seen) = self.record.forces else { return };
        let start_s = self.time_s(place).to_f64();
        let dynamics = &self.dynamics;
        let step =
            ForceKernel { dynamics, series, f, x, length, start_s, seen };
        self.record.forces = Some(self.isa.run(step));
    }
}

/// Forces of a step, compiled for each instruction-set level.
struct ForceKernel<'d, N, const LEN: usize, const F: usize> {
    dynamics: &'d Dynamics<N>,
    series: &'d TaylorSeries<N, LEN>,
    f: &'d [N; F],
    x: N,
    length: N,
    start_s: f64,
    seen: Forces,
}

impl<N: Real, const LEN: usize, const F: usize> ForceKernel<'_, N, LEN, F> {
    #[inline(always)]
    fn at(&self, part: f64) -> (f64, f64) {
        let x = N::from_f64(part) * self.x;
        let TaylorSeries { c, v } = self.series;
        let (u, w) = (value(c, x), value(v, x));
        let f = value(self.f, x * self.length).to_f64();
        at_pivot(self.dynamics, (u.to_f64(), w.to_f64()), f)
    }
}

impl<N: Real, const LEN: usize, const F: usize> Kernel
    for ForceKernel<'_, N, LEN, F>
{
    type Output = Forces;

    #[inline(always)]
    fn run(self) -> Forces {
        let mut seen = self.seen;
        let span = (self.x * self.length).to_f64();
        let per_s = self.dynamics.p.to_f64();
        let time_s = |part: f64| self.start_s + part * span / per_s;
        let end = |k: usize| k as f64 / PARTS as f64;
        let mut found = [(0.0, 0.0); PARTS + 1];
        for (k, forces) in found.iter_mut().enumerate() {
            *forces = self.at(end(k));
            seen.see(*forces, time_s(end(k)));
        }
        for friction in [true, false] {
            let of = |forces: (f64, f64)| match friction {
                true => ratio(forces.0, forces.1),
                false => -forces.1,
            };
            for k in 1..PARTS {
                let best = match friction {
                    true => seen.friction,
                    false => -seen.least_normal_over_weight,
                };
                if crest([k - 1, k, k + 1].map(|k| of(found[k]))) > best {
                    let ends = (end(k - 1), end(k + 1));
                    let top = highest(ends, |part| of(self.at(part)));
                    seen.see(self.at(top), time_s(top));
                }
            }
        }
        seen
    }
}

/// A little more than the height of the parabola through three values if the
/// middle one is the highest, otherwise minus infinity.
#[inline(always)]
fn crest([before, here, after]: [f64; 3]) -> f64 {
    if !(here >= before && here >= after && here.is_finite()) {
        return f64::NEG_INFINITY;
    }
    let (slope, bend) = (after - before, 2.0 * here - before - after);
    let rise = if bend > 0.0 { slope * slope / (8.0 * bend) } else { 0.0 };
    here + 2.0 * rise
}

/// Place between two ends at which a function with one maximum is largest.
#[inline(always)]
fn highest((mut low, mut high): (f64, f64), of: impl Fn(f64) -> f64) -> f64 {
    for _ in 0..NARROWINGS {
        let third = (high - low) / 3.0;
        let (left, right) = (low + third, high - third);
        if of(left) < of(right) {
            low = left;
        } else {
            high = right;
        }
    }
    0.5 * (low + high)
}
