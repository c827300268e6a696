//! Standard normal variates with the same bits on every machine.
//!
//! The ziggurat of Marsaglia and Tsang (J. Stat. Software 5 (2000) 8) in
//! Doornik's variant with 256 layers. Crates that have it call the platform's
//! exponential and logarithm on its rare paths; here they are libm's.

use std::sync::LazyLock;

use libm::{erfc, exp, log};

use super::Stream;

/// Layers, a power of two.
const LAYERS: usize = 256;
/// Where the lowest layer's rectangle ends and the tail begins.
const START: f64 = 3.654_152_885_361_009;
/// sqrt(pi/2).
const ROOT_HALF_PI: f64 = 1.253_314_137_315_500_3;

/// Edges x_0 > x_1 > .. of the layers and exp(-x^2/2) there; x_0 is that of
/// a rectangle as large as the lowest layer with its tail.
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

/// A number in (0, 1) with 52 bits.
fn open(stream: &mut Stream) -> f64 {
    ((stream.next_u64() >> 12) as f64 + 0.5) * f64::EPSILON
}

/// A standard normal variate from a stream.
///
/// ```
/// use rocking::streams::{Streams, standard_normal};
/// let mut stream = Streams::new("example", 0).stream(0);
/// let z: Vec<f64> = (0..3).map(|_| standard_normal(&mut stream)).collect();
/// assert!(z.iter().all(|z| z.abs() < 10.0));
/// ```
#[must_use]
pub fn standard_normal(stream: &mut Stream) -> f64 {
    let Ziggurat { edges, heights } = &*ZIGGURAT;
    loop {
        let bits = stream.next_u64();
        let layer = bits as usize % LAYERS;
        // In [-1, 1), from the bits that don't choose the layer, exactly.
        let u = (bits >> 12) as f64 * (2.0 * f64::EPSILON) - 1.0;
        let x = u * edges[layer];
        if x.abs() < edges[layer + 1] {
            return x;
        }
        if layer == 0 {
            return tail(stream, u < 0.0);
        }
        let rise = heights[layer + 1] - heights[layer];
        let height = heights[layer + 1] - rise * stream.uniform();
        if height < density(x) {
            return x;
        }
    }
}

/// Beyond [`START`], by Marsaglia's method.
fn tail(stream: &mut Stream, negative: bool) -> f64 {
    loop {
        let x = log(open(stream)) / START;
        let y = log(open(stream));
        if -2.0 * y >= x * x {
            return if negative { x - START } else { START - x };
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
