//! What happens within a step: the first impact or overturning, and the
//! turning points before it.

use crate::integrator::driver::Driver;
use crate::integrator::dynamics::Overturning;
use crate::integrator::forcing::{Forcing, Moment};
use crate::integrator::motion::BlockMotion;
use crate::integrator::roots::first_descent;
use crate::integrator::taylor::{TaylorSeries, value};
use crate::number::Real;
use crate::number::dispatch::{Isa, Kernel};

/// Pieces after a peak before it is asked whether what is left matters: most
/// peaks are followed by a higher one, and the answer costs as much as some
/// ten steps.
const PATIENCE: usize = 160;

/// What happened in a step, and after which part of it.
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
        let mut rest = N::zero();
        for k in (2..LEN).rev() {
            rest = rest + c[k].abs();
        }
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
        let mut rest = N::zero();
        for k in (2..LEN).rev() {
            rest = rest.mul_add(x, c[k].abs());
        }
        let rise = (c[1] * x).positive_part();
        if !(c[0] + rise + rest * x * x > self.record.peak) {
            return;
        }
        let mut variation = N::zero();
        for k in (1..LEN).rev() {
            variation = variation.mul_add(x, v[k].abs());
        }
        if v[0].abs() > variation * x {
            return;
        }
        self.raise_by_turning(series, x, step);
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

    #[inline(always)]
    pub(super) fn locate_turning_points<const LEN: usize>(
        &mut self,
        series: &TaylorSeries<N, LEN>,
        x: N,
        (place, length): (Moment<N>, N),
    ) {
        let isa = self.isa;
        let mut v = series.v;
        let mut from = N::zero();
        // At most LEN turning points lie in a step.
        for _ in 0..LEN {
            let Some((turn, rising)) = next_turning(&mut v, x - from, isa)
            else {
                return;
            };
            from = from + turn;
            if rising {
                let top = value(&series.c, from);
                self.raise_peak(top, place, from * length);
            }
        }
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

    /// How far an overturning is from none, over alpha: next turning value
    /// of |theta| beyond it, less the rotation that counts; if the block
    /// never turns, its velocity there.
    #[inline(never)]
    pub(super) fn margin_beyond<const SIZE: usize>(
        &self,
        from: Moment<N>,
        motion: BlockMotion<N>,
    ) -> f64 {
        self.isa.run(Beyond::<_, _, SIZE, _, _> { driver: self, from, motion })
    }

    #[inline(always)]
    pub(super) fn turning_beyond<const SIZE: usize>(
        &self,
        from: Moment<N>,
        motion: BlockMotion<N>,
    ) -> f64 {
        let BlockMotion { side, mut u, mut w } = motion;
        let never = (w / self.dynamics.alpha).to_f64();
        if self.dynamics.overturning == Overturning::HalfPi {
            return never;
        }
        let mut offset = from.offset;
        for piece in from.piece..self.forcing.pieces() {
            let left = self.forcing.length(piece) - offset;
            let f = self.oriented(Moment { piece, offset }, side, false);
            let drive = self.dynamics.drive(f);
            let series: TaylorSeries<N, SIZE> =
                self.expand((u, w), left, &drive);
            if let Some(x) = first_descent(&series.v, N::one(), self.isa) {
                return self.beyond(value(&series.c, x));
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

    pub(super) fn beyond(&self, u: N) -> f64 {
        ((u - self.dynamics.alpha) / self.dynamics.alpha).to_f64()
    }
}

/// Whether a polynomial that starts with c_0 + c_1 x surely stays above zero
/// to x = 1: c_1 x adds `down` at the lowest, the other terms at most `rest`
/// times x.
#[inline(always)]
fn is_clear_of_base<N: Real>(
    [start, slope]: [N; 2],
    down: N,
    rest: N,
) -> bool {
    start + down > rest || (start == N::zero() && slope > rest)
}

/// The margin of an overturning, compiled for each instruction-set level.
struct Beyond<'d, N, G, const SIZE: usize, const F: usize, const HARD: usize> {
    driver: &'d Driver<N, G, F, HARD>,
    from: Moment<N>,
    motion: BlockMotion<N>,
}

impl<N, G, const SIZE: usize, const F: usize, const HARD: usize> Kernel
    for Beyond<'_, N, G, SIZE, F, HARD>
where
    N: Real,
    G: Forcing<N, F>,
{
    type Output = f64;

    #[inline(always)]
    fn run(self) -> f64 {
        self.driver.turning_beyond::<SIZE>(self.from, self.motion)
    }
}

/// Turning points of a step, compiled for each instruction-set level.
struct TurningKernel<
    'd,
    N,
    G,
    const LEN: usize,
    const F: usize,
    const HARD: usize,
> {
    driver: &'d mut Driver<N, G, F, HARD>,
    series: &'d TaylorSeries<N, LEN>,
    x: N,
    step: (Moment<N>, N),
}

impl<N, G, const LEN: usize, const F: usize, const HARD: usize> Kernel
    for TurningKernel<'_, N, G, LEN, F, HARD>
where
    N: Real,
    G: Forcing<N, F>,
{
    type Output = ();

    #[inline(always)]
    fn run(self) {
        let Self { driver, series, x, step } = self;
        driver.locate_turning_points(series, x, step);
    }
}

/// The next turning point of a step of velocity `v` within `left`, and
/// whether the rotation rises before it; moves the origin of `v` there.
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
