//! Bare steps: a lower bound on the time of the lanes.

use crate::block::Block;
use crate::integrator::taylor::total;
use crate::number::dispatch::{Isa, WithSimd};
use crate::number::lanes::{Lanes, Simd, WIDTH};

/// Lanes of eight that are stepped in turn.
const GROUPS: usize = 16;

/// Free flights by Eq. 1 in lanes, in steps of order 8 written by hand,
/// without a search for events and without a test of the truncation error. A
/// benchmark compares the time of [`curves`](crate::ida::curves) with that of
/// these flights.
///
/// ```
/// use rocking::Block;
/// use rocking::integrator::BareSteps;
/// use rocking::number::dispatch::Isa;
/// let block = Block::try_new(0.2, 1.0)?;
/// let ground = [0.0; 501];
/// let bare = BareSteps { block, samples: &ground, step: 1e-3, ratio: 0.5 };
/// if let Some([u, w]) = bare.fly(Isa::best(), 1) {
///     // Energy: w^2/2 + cos(alpha - u) stays.
///     let energy = 0.5 * w * w + libm::cos(0.2 - u);
///     assert!((energy - libm::cos(0.1)).abs() < 1e-15);
/// }
/// # Ok::<(), rocking::block::BlockError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct BareSteps<'a> {
    /// The block.
    pub block: Block,
    /// Ground acceleration, multiples of gravity; one step a sample.
    pub samples: &'a [f64],
    /// Length of a step, in 1/p.
    pub step: f64,
    /// Rotation over the slenderness angle at which the block is released.
    pub ratio: f64,
}

impl BareSteps<'_> {
    /// Rotation (rad) and velocity (rad, per 1/p) at the end of the last of
    /// `flights` flights through the samples, each of [`Self::LANES`] blocks;
    /// `None` if lanes are not faster than single numbers.
    pub fn fly(&self, isa: Isa, flights: u32) -> Option<[f64; 2]> {
        isa.run_wide(Bare { of: *self, flights })
    }

    /// Blocks in the lanes.
    pub const LANES: usize = GROUPS * WIDTH;
}

/// Some flights.
struct Bare<'a> {
    of: BareSteps<'a>,
    flights: u32,
}

impl WithSimd for Bare<'_> {
    type Output = [f64; 2];

    #[inline(always)]
    fn run<V: Simd>(self) -> [f64; 2] {
        let alpha = self.of.block.slenderness_rad();
        let released = BareGroup {
            u: Lanes::splat(self.of.ratio * alpha),
            w: Lanes::splat(0.0),
            here: Lanes::splat(self.of.samples[0]),
            amplitude: Lanes::splat(1.0),
            step: Lanes::splat(self.of.step),
            sine: Lanes::splat(libm::sin(alpha)),
            cosine: Lanes::splat(libm::cos(alpha)),
            next: [1; WIDTH],
        };
        let mut groups = [released; GROUPS];
        for _ in 0..self.flights {
            groups = [released; GROUPS];
            for _ in 1..self.of.samples.len() {
                for group in &mut groups {
                    group.step::<V>(self.of.samples);
                }
            }
        }
        [groups[0].u[0], groups[0].w[0]]
    }
}

/// Motion and constants of eight blocks.
#[derive(Clone, Copy)]
struct BareGroup {
    u: Lanes,
    w: Lanes,
    here: Lanes,
    amplitude: Lanes,
    step: Lanes,
    sine: Lanes,
    cosine: Lanes,
    /// Sample at the end of the step.
    next: [usize; WIDTH],
}

/// Code for each order: compilers do not unroll such loops.
macro_rules! orders {
    ($k:ident: $($order:literal)* => $body:block) => {$({
        let $k: usize = $order;
        $body
    })*};
}

impl BareGroup {
    /// One step. With d = u - u_0, u'' = G cos d + H sin d; `s` and `q` are
    /// the series of sin d and 1 - cos d.
    #[inline(always)]
    fn step<V: Simd>(&mut self, samples: &[f64]) {
        let mut places = [&f64::NAN; WIDTH];
        for (place, next) in places.iter_mut().zip(self.next) {
            *place = samples.get(next).unwrap_or(&f64::NAN);
        }
        let ahead = V::gather(places) * V::load(&self.amplitude);
        let (u, w, f) =
            (V::load(&self.u), V::load(&self.w), V::load(&self.here));
        let (h, rise) = (V::load(&self.step), ahead - f);
        let (sine, cosine) = u.sin_cos_small();
        let (across, along) = (V::load(&self.sine), V::load(&self.cosine));
        let sine_0 = (-cosine).mul_add(across, sine * along);
        let cosine_0 = sine.mul_add(across, cosine * along);
        let g = [(-f).mul_add(cosine_0, sine_0), -(rise * cosine_0)];
        let odd = [f.mul_add(sine_0, cosine_0), rise * sine_0];
        let [mut c, mut v, mut s, mut q] = [[V::zero(); 9]; 4];
        (c[0], c[1]) = (u, w * h);
        (v[0], v[1]) = (w, g[0] * h);
        s[1] = c[1];
        let mut part = h;
        orders!(k: 1 2 3 4 5 6 7 => {
            let mut force = g[1];
            if k > 1 {
                let (mut sum, mut fall) = (V::zero(), v[k - 2] * s[1]);
                for j in 2..k {
                    sum = v[k - 1 - j].mul_add(q[j], sum);
                    fall = v[k - 1 - j].mul_add(s[j], fall);
                }
                s[k] = (-sum).mul_add(part, c[k]);
                q[k] = fall * part;
                force = (-g[1]).mul_add(q[k - 1], odd[1] * s[k - 1]);
                force = (-g[0]).mul_add(q[k], force);
            }
            part = h * V::ratio(1, k as i32 + 1);
            v[k + 1] = odd[0].mul_add(s[k], force) * part;
            c[k + 1] = v[k] * part;
        });
        total(&c).store(&mut self.u);
        total(&v).store(&mut self.w);
        ahead.store(&mut self.here);
        for next in &mut self.next {
            *next += 1;
        }
    }
}
