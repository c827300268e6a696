//! Standard normal variates with the same bits on every machine.
//!
//! The ziggurat of Marsaglia and Tsang (J. Stat. Software 5 (2000) 8) in
//! Doornik's variant with 256 layers. Crates that have it call the platform's
//! exponential and logarithm on its rare paths; here they are libm's.

use std::sync::LazyLock;

use libm::{erfc, exp, log};

use super::{Stream, fraction};

/// Layers, a power of two.
const LAYERS: usize = 256;
/// Where the lowest layer's rectangle ends and the tail begins.
const START: f64 = 3.654_152_885_361_009;
/// sqrt(pi/2).
const ROOT_HALF_PI: f64 = 1.253_314_137_315_500_3;

/// Edges x_0 > x_1 > .. of the layers and exp(-x^2/2) there; x_0 is the edge
/// of a rectangle as large as the lowest layer with its tail.
struct Ziggurat {
    edges: [f64; LAYERS + 1],
    heights: [f64; LAYERS + 1],
}

static ZIGGURAT: LazyLock<Ziggurat> = LazyLock::new(|| {
    let tail = ROOT_HALF_PI * erfc(START * std::f64::consts::FRAC_1_SQRT_2);
    let area = START * density(START) + tail;
    let mut edges = [0.0; LAYERS + 1];
    edges[0] = area / density(START);
    edges[1] = START;
    for i in 2..LAYERS {
        let height = area / edges[i - 1] + density(edges[i - 1]);
        edges[i] = (-2.0 * log(height)).sqrt();
    }
    Ziggurat { edges, heights: edges.map(density) }
});

/// The density without its constant.
fn density(x: f64) -> f64 {
    exp(-0.5 * x * x)
}

/// A standard normal variate from a stream.
///
/// ```
/// use rocking_statistics::streams::{Streams, standard_normal};
/// let mut stream = Streams::new("example", 0).stream(0);
/// let z: Vec<f64> = (0..3).map(|_| standard_normal(&mut stream)).collect();
/// assert!(z.iter().all(|z| z.abs() < 10.0));
/// ```
pub fn standard_normal(stream: &mut Stream) -> f64 {
    let first = stream.next_u64();
    ZIGGURAT.variate(first, || stream.next_u64())
}

/// Words that [`standard_normals`] draws at once, at most.
const AHEAD: usize = 64;

/// Fills in standard normal variates from a stream: the numbers that as many
/// calls of [`standard_normal`] give, in less time.
///
/// ```
/// use rocking_statistics::streams::{Streams, standard_normal, standard_normals};
/// let streams = Streams::new("example", 0);
/// let mut z = [0.0; 3];
/// standard_normals(&mut streams.stream(0), &mut z);
/// let mut stream = streams.stream(0);
/// assert_eq!(z, [(); 3].map(|()| standard_normal(&mut stream)));
/// ```
pub fn standard_normals(stream: &mut Stream, values: &mut [f64]) {
    let ziggurat = &*ZIGGURAT;
    let mut words = [[0; 8]; AHEAD];
    let mut left = values.iter_mut();
    while left.len() > 0 {
        // A variate takes a word or more: none of these stays unused.
        let drawn = &mut words[..left.len().min(AHEAD)];
        stream.fill(drawn);
        let mut drawn = drawn.iter().map(|word| u64::from_le_bytes(*word));
        while let Some(first) = drawn.next() {
            let next = || drawn.next().unwrap_or_else(|| stream.next_u64());
            if let Some(value) = left.next() {
                *value = ziggurat.variate(first, next);
            }
        }
    }
}

impl Ziggurat {
    /// A variate from a word, and from the next ones where it needs more.
    #[inline(always)]
    fn variate(&self, first: u64, next: impl FnMut() -> u64) -> f64 {
        let (layer, u) = Self::split(first);
        let x = u * self.edges[layer];
        if x.abs() < self.edges[layer + 1] {
            return x;
        }
        self.beside(first, next)
    }

    /// A layer, and a number in [-1, 1) from the bits that don't choose the
    /// layer, exactly.
    #[inline(always)]
    fn split(bits: u64) -> (usize, f64) {
        let u = (bits >> 12) as f64 * (2.0 * f64::EPSILON) - 1.0;
        (bits as usize % LAYERS, u)
    }

    /// A variate from a word that may lie beside the rectangle of its layer.
    #[cold]
    fn beside(&self, mut bits: u64, mut next: impl FnMut() -> u64) -> f64 {
        let Self { edges, heights } = self;
        loop {
            let (layer, u) = Self::split(bits);
            let x = u * edges[layer];
            if x.abs() < edges[layer + 1] {
                return x;
            }
            if layer == 0 {
                return tail(next, u < 0.0);
            }
            let rise = heights[layer + 1] - heights[layer];
            let height = heights[layer + 1] - rise * fraction(next());
            if height < density(x) {
                return x;
            }
            bits = next();
        }
    }
}

/// Beyond [`START`], by Marsaglia's method.
fn tail(mut next: impl FnMut() -> u64, negative: bool) -> f64 {
    // In (0, 1), with 52 bits.
    let mut open = || ((next() >> 12) as f64 + 0.5) * f64::EPSILON;
    loop {
        let x = log(open()) / START;
        let y = log(open());
        if -2.0 * y >= x * x {
            return if negative { x - START } else { START - x };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streams::Streams;

    /// Also if a word is rejected, and in the last of a draw.
    #[test]
    fn many_at_once_are_those_one_by_one() {
        let streams = Streams::new("test of many at once", 0);
        for n in (0..200).chain([4096]) {
            let (mut one, mut many) = (streams.stream(n), streams.stream(n));
            let mut values = vec![f64::NAN; n as usize];
            standard_normals(&mut many, &mut values);
            for value in values {
                assert_eq!(value, standard_normal(&mut one), "of {n}");
            }
            assert_eq!(many.next_u64(), one.next_u64(), "after {n}");
        }
    }

    #[test]
    fn layers_have_equal_areas() {
        let Ziggurat { edges, heights } = &*ZIGGURAT;
        let area = edges[0] * heights[1];
        for i in 1..LAYERS {
            let own = edges[i] * (heights[i + 1] - heights[i]);
            assert!((own / area - 1.0).abs() < 1e-11, "layer {i}: {own}");
        }
        assert_eq!((edges[LAYERS], heights[LAYERS]), (0.0, 1.0));
    }
}
