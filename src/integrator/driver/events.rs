//! Events within a step: the first impact or overturning, and the turning
//! points before it.

use crate::integrator::driver::Driver;
use crate::integrator::dynamics::Overturning;
use crate::integrator::forcing::{Forcing, Moment};
use crate::integrator::motion::BlockMotion;
use crate::integrator::roots::{SURELY, bends, first_descent};
use crate::integrator::taylor::{TaylorSeries, expand, size, size_at, value};
use crate::number::Real;
use crate::number::dispatch::{Isa, Kernel};

/// Pieces from a peak to the next early-termination test. A higher peak
/// follows most peaks, and the test costs as much as some ten steps.
const PATIENCE: usize = 160;

/// An event of a step, with the part of the step before it.
pub(super) enum Event<N> {
    None,
    Impact(N),
    Overturning(N),
}

impl<N: Real, G: Forcing<N, F>, const F: usize, const HARD: usize>
    Driver<N, G, F, HARD>
{
    /// First impact or overturning, in parts of the step: in (0, 1].
    #[inline(always)]
    pub(super) fn first_event<const LEN: usize>(
        &self,
        c: &[N; LEN],
    ) -> Event<N> {
        // Bound on |u - c_0 - c_1 x| / x over the step.
        let rest = size(&c[2..]);
        let (down, up) = (-(-c[1]).positive_part(), c[1].positive_part());
        let clear_of_base = is_clear_of_base([c[0], c[1]], down, rest);
        let clear_of_limit = c[0] + up + rest < self.dynamics.limit;
        if clear_of_base && clear_of_limit {
            return Event::None;
        }
        let impact = if clear_of_base {
            None
        } else {
            first_descent(c, N::one(), self.isa)
        };
        let overturning = if clear_of_limit {
            None
        } else {
            let mut gap = c.map(|x| -x);
            gap[0] = self.dynamics.limit - c[0];
            first_descent(&gap, N::one(), self.isa)
        };
        match (impact, overturning) {
            (None, None) => Event::None,
            (Some(x), None) => Event::Impact(x),
            (None, Some(x)) => Event::Overturning(x),
            (Some(i), Some(o)) if i < o => Event::Impact(i),
            (Some(_), Some(o)) => Event::Overturning(o),
        }
    }

    /// Raises the peak by the turning points in the part (0, `x`) of a step
    /// from a place, of some length.
    #[inline(always)]
    pub(super) fn turning_points<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
        x: N,
        step: (Moment<N>, N),
    ) {
        let TaylorSeries { c, v } = series;
        let rise = (c[1] * x).positive_part();
        let rest = size_at(&c[2..], x) * x * x;
        let may_rise = c[0] + rise + rest > self.record.peak;
        if may_rise && !(v[0].abs() > size_at(&v[1..], x) * x) {
            self.raise_by_turning(series, x, step);
        }
    }

    #[inline(never)]
    pub(super) fn raise_by_turning<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
        x: N,
        step: (Moment<N>, N),
    ) {
        let isa = self.isa;
        isa.run(TurningKernel { driver: self, series, x, step });
    }

    /// Counts a turning point at `u`, `tau` after a place, if it is the
    /// highest.
    pub fn raise_peak(&mut self, u: N, place: Moment<N>, tau: N) {
        if u > self.record.peak {
            self.record.work.turning_points += 1;
            self.record.peak = u;
            self.exit_from = place.piece.saturating_add(PATIENCE);
            let offset = place.offset + tau;
            let time_s = self.time_s(Moment { offset, ..place });
            self.record.peak_time_s = Some(time_s);
            self.screen = self.screen.map(|screen| screen.top(tau));
            for tracker in self.record.trackers() {
                tracker.peak(u.to_f64());
            }
        }
    }

    /// Margin of an overturning, over alpha: the next turning value of |theta|
    /// less the rotation that counts as overturned. If the block never turns,
    /// its velocity there.
    #[inline(never)]
    pub(super) fn margin_beyond<const SIZE: usize>(
        &self,
        from: Moment<N>,
        motion: BlockMotion<N>,
    ) -> f64 {
        self.isa.run(Beyond::<_, _, SIZE> { driver: self, from, motion })
    }
}

/// True if a polynomial that starts with c_0 + c_1 x surely stays above zero
/// up to x = 1. The least value of c_1 x is `down`; the other terms are at
/// most `rest` times x.
#[inline(always)]
fn is_clear_of_base<N: Real>(
    [start, slope]: [N; 2],
    down: N,
    rest: N,
) -> bool {
    start + down > rest || (start == N::zero() && slope > rest)
}

/// The margin of an overturning, compiled for each instruction-set level.
struct Beyond<D, N, const SIZE: usize> {
    driver: D,
    from: Moment<N>,
    motion: BlockMotion<N>,
}

impl<N, G, const SIZE: usize, const F: usize, const HARD: usize> Kernel
    for Beyond<&Driver<N, G, F, HARD>, N, SIZE>
where
    N: Real,
    G: Forcing<N, F>,
{
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        let Self { driver, from, motion } = self;
        let BlockMotion { side, mut u, mut w } = motion;
        let alpha = driver.dynamics.alpha;
        let never = (w / alpha).to_f64();
        if driver.dynamics.overturning == Overturning::HalfPi {
            return never;
        }
        let mut offset = from.offset;
        for piece in from.piece..driver.forcing.pieces() {
            let left = driver.forcing.length(piece) - offset;
            let place = Moment { piece, offset };
            let drive = driver.drive(place, (side, u), false);
            let series: TaylorSeries<N, SIZE> =
                expand(driver.dynamics.model, (u, w), left, &drive);
            if let Some(x) = first_descent(&series.v, N::one(), driver.isa) {
                return ((value(&series.c, x) - alpha) / alpha).to_f64();
            }
            (u, w) = series.end();
            if !(u < N::right_angle()) {
                return never;
            }
            offset = N::zero();
        }
        // Beyond the saddle and moving outwards, nothing turns it back.
        never
    }
}

/// Turning points of a step, compiled for each instruction-set level.
struct TurningKernel<'d, D, N, const LEN: usize> {
    driver: D,
    series: &'d TaylorSeries<N, LEN>,
    x: N,
    step: (Moment<N>, N),
}

impl<N, G, const LEN: usize, const F: usize, const HARD: usize> Kernel
    for TurningKernel<'_, &mut Driver<N, G, F, HARD>, N, LEN>
where
    N: Real,
    G: Forcing<N, F>,
{
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { driver, series, x, step: (place, length) } = self;
        let mut v = series.v;
        let mut from = N::zero();
        // At most LEN turning points lie in a step.
        for _ in 0..LEN {
            let next = next_turning(&mut v, x - from, driver.isa);
            let Some((turn, rising)) = next else { return };
            from = from + turn;
            if rising {
                let top = value(&series.c, from);
                driver.raise_peak(top, place, from * length);
            }
        }
    }
}

/// The next turning point, within `left`, of a step of velocity `v`, and
/// whether the rotation rises before it. Moves the origin of `v` there.
#[inline(always)]
pub(super) fn next_turning<N: Real, const LEN: usize>(
    v: &mut [N; LEN],
    left: N,
    isa: Isa,
) -> Option<(N, bool)> {
    let first = v.iter().find(|x| **x != N::zero())?;
    let rising = *first > N::zero();
    if !rising {
        *v = v.map(|x| -x);
    }
    let turn = first_descent(v, left, isa)?;
    if !(turn < left) {
        return None;
    }
    // A velocity that surely rises or falls has no other root.
    let (steep, _) = bends(v, N::one());
    if v[1].abs() + steep * N::from_f64(SURELY) > N::zero() {
        *v = [N::zero(); LEN];
        return Some((turn, rising));
    }
    if !rising {
        *v = v.map(|x| -x);
    }
    shift(v, turn);
    // The root itself: exactly zero, so that deflation applies.
    v[0] = N::zero();
    Some((turn, rising))
}

/// Moves the origin of the polynomial `c` to `by`.
fn shift<N: Real>(c: &mut [N], by: N) {
    for round in 0..c.len() {
        for k in (round..c.len() - 1).rev() {
            c[k] = c[k + 1].mul_add(by, c[k]);
        }
    }
}

#[cfg(test)]
mod tests;
