//! The excitation of the driver: pieces, each with a Taylor series.
//!
//! # Proof P11
//!
//! `gap_at_edges` and `gap_at_start` say how near |a|/g comes to the uplift
//! threshold of a block at rest. Its peaks lie at crests, at most one a piece
//! (`LONGEST_PHASE`), where a piece starts and |a| does not rise, and at the
//! end. Those of a record lie at its samples.

mod crest;
mod ground;
mod remainder;
mod shape;
mod stretch;

use crate::excitation::{Pulse, RecordIndex, ScaledRecord};
use crate::integrator::roots::first_descent;
use crate::integrator::taylor::value;
use crate::number::Real;
use crate::number::dispatch::Isa;
use crest::crest;
use shape::shape_series;
use stretch::Stretch;

pub(crate) use ground::Shaking;
pub(crate) use remainder::Remainder;
pub(crate) use stretch::pieces_of;

/// Longest step in units of 1/p at which the truncation error of the Taylor
/// orders in use is below rounding.
pub(crate) const LONGEST_STEP: f64 = 0.1;

/// Relative distance from the uplift threshold above which a sample is not
/// near it.
pub(crate) const NEAR_THRESHOLD: f64 = 1e-12;

/// Relative excess over the threshold, in units of roundoff, that counts as a
/// touch.
const TOUCH: f64 = 8.0;

/// Longest step in units of a pulse's own phase.
const LONGEST_PHASE: f64 = 0.25;

/// Pieces of a pulse that a rest scans one by one before it scans blocks of
/// them. Most pulses have fewer.
const WALKED: u64 = 128;

/// A place in the excitation: a piece and the time since its start, in units
/// of 1/p.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Moment<N> {
    pub piece: usize,
    pub offset: N,
}

impl<N: Real> Moment<N> {
    /// The first place of a piece that is not before this one.
    fn at(self, piece: usize) -> Self {
        let offset = if piece == self.piece { self.offset } else { N::zero() };
        Self { piece, offset }
    }
}

/// The lesser number; the second if they have no order.
fn lesser<N: Real>(a: N, b: N) -> N {
    if a < b { a } else { b }
}

/// Uplift of a block at rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Exceedance<N> {
    pub place: Moment<N>,
    /// Sign of the ground acceleration.
    pub positive: bool,
    /// True if the acceleration crosses the threshold there, false if it jumps
    /// above it.
    pub crossing: bool,
}

/// Scan of the excitation during a rest.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RestScan<N> {
    /// Number of pieces, or blocks of pieces, scanned.
    pub pieces: u64,
    /// Least relative distance of the peaks of |a/g| from the threshold, or a
    /// bound on it that is far above rounding. Peaks are crests, a start from
    /// which |a/g| falls, corners, constant stretches, and the end.
    pub nearest: N,
}

/// An excitation, cut into pieces on which it is smooth.
pub(crate) trait Forcing<N: Real, const F: usize> {
    /// Number of pieces.
    fn pieces(&self) -> usize;

    /// Start of a piece in s.
    fn start_s(&self, piece: usize) -> N;

    /// Length of a piece in units of 1/p.
    fn length(&self, piece: usize) -> N;

    /// Number of equal steps in which a piece is integrated.
    #[inline(always)]
    fn steps(&self) -> usize {
        1
    }

    /// Series of a/g about a place.
    fn series(&self, place: Moment<N>) -> [N; F];

    /// First place from `from` on at which |a/g| exceeds `threshold`, and the
    /// scan up to it.
    fn exceedance(
        &self,
        from: Moment<N>,
        threshold: N,
    ) -> (Option<Exceedance<N>>, RestScan<N>);

    /// Time (in 1/p) whose rounding shifts the whole excitation; zero if each
    /// place is measured from its own piece.
    fn span(&self) -> f64 {
        0.0
    }

    /// Bounds on the rest of the excitation from each piece on; `None` if they
    /// are not known.
    fn remainder(&self) -> Option<Remainder<'_, N>> {
        None
    }
}

/// Number of steps in which a sample of `length` (in 1/p) is integrated.
pub(crate) fn steps_of(length: f64) -> usize {
    libm::ceil(length / LONGEST_STEP).max(1.0) as usize
}

/// A record: one piece for each interval between samples.
#[derive(Clone, Copy)]
pub(crate) struct RecordForcing<'a, N> {
    pub record: ScaledRecord<'a>,
    index: &'a RecordIndex,
    factor: N,
    length: N,
    /// One over the length of a piece.
    pub inverse: N,
    steps: usize,
}

impl<'a, N: Real> RecordForcing<'a, N> {
    pub fn new(
        record: ScaledRecord<'a>,
        index: &'a RecordIndex,
        frequency_rad_s: f64,
    ) -> Self {
        let length = N::from_f64(record.dt_s()) * N::from_f64(frequency_rad_s);
        Self {
            record,
            index,
            factor: record.factor(),
            length,
            inverse: N::one() / length,
            steps: steps_of(length.to_f64()),
        }
    }

    /// Length of a step in units of 1/p.
    pub fn step(&self) -> f64 {
        self.length.to_f64() / self.steps as f64
    }

    #[inline(always)]
    fn sample(&self, i: usize) -> N {
        N::from_f64(self.record.samples()[i]) * self.factor
    }
}

impl<N: Real> Forcing<N, 2> for RecordForcing<'_, N> {
    fn pieces(&self) -> usize {
        self.record.samples().len() - 1
    }

    fn start_s(&self, piece: usize) -> N {
        N::from_f64(piece as f64) * N::from_f64(self.record.dt_s())
    }

    #[inline(always)]
    fn length(&self, _piece: usize) -> N {
        self.length
    }

    #[inline(always)]
    fn steps(&self) -> usize {
        self.steps
    }

    #[inline(always)]
    fn series(&self, place: Moment<N>) -> [N; 2] {
        let here = self.sample(place.piece);
        let next = self.sample(place.piece + 1);
        let rate = (next - here) * self.inverse;
        [rate.mul_add(place.offset, here), rate]
    }

    fn exceedance(
        &self,
        from: Moment<N>,
        threshold: N,
    ) -> (Option<Exceedance<N>>, RestScan<N>) {
        let amplitude = self.record.amplitude().abs();
        let bound = threshold.to_f64() * (1.0 - 1e-14);
        let mut piece = from.piece;
        let (mut pieces, mut gap) = (0, self.gap_at_start(from, threshold));
        let mut found = None;
        while piece < self.pieces() && found.is_none() {
            pieces += 1;
            if let Some(next) = self.index.skip(piece, bound / amplitude) {
                piece = next;
                continue;
            }
            found = self.within(from.at(piece), threshold);
            gap = lesser(self.gap(piece, threshold), gap);
            piece += 1;
        }
        (found, RestScan { pieces, nearest: gap / threshold })
    }

    #[inline(always)]
    fn remainder(&self) -> Option<Remainder<'_, N>> {
        Some(Remainder::new(self.index, self.length, self.factor))
    }
}

impl<N: Real> RecordForcing<'_, N> {
    /// Distance of |a/g| from the threshold at the first sample, if a block
    /// rests from there on and |a/g| does not rise; otherwise the threshold.
    fn gap_at_start(&self, from: Moment<N>, threshold: N) -> N {
        let is_start = from.piece == 0 && from.offset == N::zero();
        let [first, second] = [0, 1].map(|i| self.sample(i).abs());
        if is_start && !(second > first) {
            (first - threshold).abs()
        } else {
            threshold
        }
    }

    /// Distance of |a/g| from the threshold at the end of a piece; if it still
    /// rises there, at the end of the next.
    #[inline(always)]
    fn gap(&self, piece: usize, threshold: N) -> N {
        let peak = self.sample(piece + 1).abs();
        let near = (peak - threshold).abs();
        if near > threshold * N::from_f64(NEAR_THRESHOLD) {
            return near;
        }
        let next = piece + 2;
        let rises = next <= self.pieces() && self.sample(next).abs() > peak;
        if rises { (self.sample(next).abs() - threshold).abs() } else { near }
    }

    /// Exceedance within one interval, from an offset on.
    fn within(&self, from: Moment<N>, threshold: N) -> Option<Exceedance<N>> {
        let here = self.series(from)[0];
        if here.abs() > threshold {
            let positive = here > N::zero();
            // A crossing computed elsewhere may be off by rounding. From rest
            // the acceleration cannot be above the threshold inside an
            // interval unless it crossed it there.
            let crossing = from.offset > N::zero();
            return Some(Exceedance { place: from, positive, crossing });
        }
        let next = self.sample(from.piece + 1);
        if !(next.abs() > threshold) {
            return None;
        }
        let first = self.sample(from.piece);
        let positive = next > N::zero();
        let level = if positive { threshold } else { -threshold };
        let share = (level - first) / (next - first);
        let offset = share * self.length;
        let offset = if offset > from.offset { offset } else { from.offset };
        let place = Moment { piece: from.piece, offset };
        Some(Exceedance { place, positive, crossing: true })
    }
}

/// A pulse: equal pieces of each smooth stretch, made when they are needed.
pub(crate) struct PulseForcing<N> {
    stretches: Vec<Stretch<N>>,
    p: N,
    isa: Isa,
}

impl<N: Real> PulseForcing<N> {
    pub fn new(pulse: &Pulse, frequency_rad_s: f64, isa: Isa) -> Self {
        let p = N::from_f64(frequency_rad_s);
        Self { stretches: Stretch::all(pulse, frequency_rad_s), p, isa }
    }

    fn count(&self) -> usize {
        self.stretches.last().map_or(0, |stretch| stretch.end)
    }

    /// The stretch of a piece.
    fn of(&self, piece: usize) -> &Stretch<N> {
        let mut later = self.stretches.iter().rev();
        let found = later.find(|stretch| stretch.first <= piece);
        found.unwrap_or(&self.stretches[0])
    }
}

impl<N: Real, const F: usize> Forcing<N, F> for PulseForcing<N> {
    fn pieces(&self) -> usize {
        self.count()
    }

    fn start_s(&self, piece: usize) -> N {
        self.of(piece).start_s(piece)
    }

    fn length(&self, piece: usize) -> N {
        self.of(piece).length(self.p)
    }

    fn span(&self) -> f64 {
        let end_s = self.stretches.last().map_or(0.0, |stretch| stretch.end_s);
        end_s * self.p.to_f64()
    }

    fn series(&self, place: Moment<N>) -> [N; F] {
        let stretch = self.of(place.piece);
        let t = stretch.start_s(place.piece) + place.offset / self.p;
        shape_series(&stretch.shape, t, self.p)
    }

    fn exceedance(
        &self,
        from: Moment<N>,
        threshold: N,
    ) -> (Option<Exceedance<N>>, RestScan<N>) {
        let mut gap = threshold;
        let (mut found, mut pieces) = (None, 0);
        let mut piece = from.piece;
        while piece < self.count() && found.is_none() {
            if pieces >= WALKED {
                let stretch = self.of(piece);
                let (next, blocks) = stretch.quiet(piece, threshold);
                pieces += blocks;
                if next > piece {
                    if next == stretch.end {
                        gap = stretch.room(threshold, gap);
                    }
                    piece = next;
                    continue;
                }
            }
            pieces += 1;
            let place = from.at(piece);
            let series: [N; F] = self.series(place);
            if series[0].abs() > threshold {
                // At the very first instant the block lifts at once; after it
                // every pulse is continuous, and rounding cannot jump.
                let positive = series[0] > N::zero();
                let crossing = place.offset > N::zero() || piece > 0;
                found = Some(Exceedance { place, positive, crossing });
            } else {
                let left = self.of(piece).length(self.p) - place.offset;
                let crest = crest(&series, left, self.isa);
                if let Some((_, top)) = crest {
                    gap = lesser((top - threshold).abs(), gap);
                }
                gap =
                    lesser(self.gap_at_edges(place, &series, threshold), gap);
                found = self.crossing(place, &series, threshold, left, crest);
            }
            piece += 1;
        }
        if let Some(found) = &found {
            gap = lesser(self.beyond::<F>(found.place, threshold), gap);
        }
        (found, RestScan { pieces, nearest: gap / threshold })
    }
}

impl<N: Real> PulseForcing<N> {
    /// First crossing of the threshold within `left` of a place, under the
    /// series of a/g there and its crest. A touch is no crossing; a crossing
    /// at the end belongs to the next piece.
    fn crossing<const F: usize>(
        &self,
        place: Moment<N>,
        series: &[N; F],
        threshold: N,
        left: N,
        crest: Option<(N, N)>,
    ) -> Option<Exceedance<N>> {
        let touch = -threshold * N::from_f64(TOUCH * N::ROUNDOFF);
        let mut first: Option<(N, bool)> = None;
        for positive in [true, false] {
            let mut gap = series.map(|x| if positive { -x } else { x });
            gap[0] = gap[0] + threshold;
            let Some(tau) = first_descent(&gap, left, self.isa) else {
                continue;
            };
            let passes = |at: N| value(&gap, at) < touch;
            let passes_on_top =
                crest.is_some_and(|(at, _)| at > tau && passes(at));
            if tau < left
                && (passes_on_top || passes(left))
                && first.is_none_or(|(best, _)| tau < best)
            {
                first = Some((tau, positive));
            }
        }
        first.map(|(tau, positive)| {
            let place = Moment { offset: place.offset + tau, ..place };
            Exceedance { place, positive, crossing: true }
        })
    }

    /// Largest excess of |a/g| over the threshold from a place at which it
    /// passes the threshold, searched until the excess is large.
    fn beyond<const F: usize>(&self, from: Moment<N>, threshold: N) -> N
    where
        Self: Forcing<N, F>,
    {
        let far = threshold * N::from_f64(NEAR_THRESHOLD);
        let mut place = from;
        let mut most = N::zero();
        while place.piece < self.of(from.piece).end {
            let series: [N; F] = self.series(place);
            let left = self.of(place.piece).length(self.p) - place.offset;
            let end = value(&series, left).abs();
            let top = crest(&series, left, self.isa).map(|(_, top)| top);
            for here in [Some(series[0].abs()), Some(end), top] {
                let over = here.map_or(N::zero(), |here| here - threshold);
                most = if over > most { over } else { most };
            }
            if most > far || top.is_some() {
                return most;
            }
            place = Moment { piece: place.piece + 1, offset: N::zero() };
        }
        most
    }

    /// Distance of |a/g| from the threshold at a place from which it does not
    /// rise, or at the end of the pulse, if it is near; otherwise the
    /// threshold. If |a/g| has a slope, rounding of the time of the place
    /// takes a share of the distance.
    fn gap_at_edges<const F: usize>(
        &self,
        place: Moment<N>,
        series: &[N; F],
        threshold: N,
    ) -> N
    where
        Self: Forcing<N, F>,
    {
        let length = self.of(place.piece).length(self.p);
        let ends = place.piece + 1 == self.count();
        let last: Option<[N; F]> =
            ends.then(|| self.series(Moment { offset: length, ..place }));
        let rises = |c: &[N; F]| {
            if c[0] < N::zero() { c[1] < N::zero() } else { c[1] > N::zero() }
        };
        let start = (!rises(series)).then_some(series);
        let span = N::from_f64(Forcing::<N, F>::span(self));
        let mut gap = threshold;
        for c in start.into_iter().chain(&last) {
            let near = (c[0].abs() - threshold).abs();
            if !(near > threshold * N::from_f64(NEAR_THRESHOLD)) {
                let share = N::one() + c[1].abs() * span / threshold;
                gap = lesser(near / share, gap);
            }
        }
        gap
    }
}
