//! Random numbers of several laws from one stream.

use rocking_statistics::streams::{Stream, below, standard_normal};

/// A stream of random numbers.
pub(crate) struct Draw(pub Stream);

impl Draw {
    /// Uniform in [low, high).
    pub fn uniform(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.0.uniform()
    }

    /// Uniform in the logarithm.
    pub fn log(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.uniform(libm::log(low), libm::log(high)))
    }

    /// A whole number in [low, high], uniform in the logarithm.
    pub fn count(&mut self, low: usize, high: usize) -> usize {
        let drawn = self.log(low as f64, high as f64 + 1.0);
        (drawn as usize).clamp(low, high)
    }

    /// True with this probability.
    pub fn chance(&mut self, probability: f64) -> bool {
        self.uniform(0.0, 1.0) < probability
    }

    /// One of a list.
    pub fn one_of<T: Copy>(&mut self, list: &[T]) -> T {
        list[self.below(list.len())]
    }

    /// A whole number below n.
    pub fn below(&mut self, n: usize) -> usize {
        below(&mut self.0, n)
    }

    /// A standard normal number.
    pub fn normal(&mut self) -> f64 {
        standard_normal(&mut self.0)
    }

    /// 1 or -1.
    pub fn sign(&mut self) -> f64 {
        self.one_of(&[1.0, -1.0])
    }
}
