//! Counter-based random streams by name and index.
//!
//! Every random number of the project is addressed: a *name* says what it is
//! for, a *seed* which repetition of the whole experiment, an *index* which
//! sample. The same address gives the same numbers on every machine and with
//! any number of threads.

mod normal;

pub use normal::{standard_normal, standard_normals};

use rand::rngs::ChaCha8Rng;
use rand::{Rng as _, SeedableRng as _};

/// The generator of one stream: `ChaCha` with 8 rounds.
#[derive(Debug)]
pub struct Stream(ChaCha8Rng);

impl Stream {
    /// The next word.
    #[inline]
    pub fn next_u64(&mut self) -> u64 {
        self.0.next_u64()
    }

    /// A number in [0, 1): a multiple of 2^-53, from one word.
    #[inline]
    pub fn uniform(&mut self) -> f64 {
        fraction(self.next_u64())
    }

    /// Fills in the next words, the bytes of each in little-endian order.
    fn fill(&mut self, words: &mut [[u8; 8]]) {
        self.0.fill_bytes(words.as_flattened_mut());
    }
}

/// A number in [0, 1): a multiple of 2^-53, from a word.
fn fraction(word: u64) -> f64 {
    (word >> 11) as f64 * (0.5 * f64::EPSILON)
}

/// A family of 2^64 independent random streams.
///
/// The 256-bit `ChaCha` key is derived from the name and the seed: FNV-1a
/// (64 bits) over the bytes of the name, then over the eight little-endian
/// bytes of the seed; the hash is the state of a SplitMix64 generator whose
/// next four outputs, little-endian, are the key. The stream number is the
/// index.
///
/// ```
/// use rocking_statistics::streams::Streams;
/// let streams = Streams::new("example", 0);
/// let (mut a, mut b) = (streams.stream(7), streams.stream(7));
/// assert_eq!(a.next_u64(), b.next_u64());
/// assert_ne!(a.next_u64(), streams.stream(8).next_u64());
/// ```
#[derive(Clone, Debug)]
pub struct Streams {
    key: [u8; 32],
}

impl Streams {
    /// The family of this name and seed.
    pub fn new(name: &str, seed: u64) -> Self {
        Self { key: key(name, seed) }
    }

    /// The stream of this index, at its beginning.
    #[inline]
    pub fn stream(&self, index: u64) -> Stream {
        let mut stream = ChaCha8Rng::from_seed(self.key);
        stream.set_stream(index);
        Stream(stream)
    }
}

/// A whole number below n, from one word: the high half of its product with
/// n (bias below n/2^64).
///
/// ```
/// use rocking_statistics::streams::{Streams, below};
/// assert!(below(&mut Streams::new("example", 0).stream(0), 7) < 7);
/// ```
pub fn below(stream: &mut Stream, n: usize) -> usize {
    ((u128::from(stream.next_u64()) * n as u128) >> 64) as usize
}

fn key(name: &str, seed: u64) -> [u8; 32] {
    let mut state = name.bytes().chain(seed.to_le_bytes()).fold(
        0xcbf2_9ce4_8422_2325_u64,
        |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3)
        },
    );
    let mut key = [0; 32];
    for word in key.as_chunks_mut::<8>().0 {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        *word = (z ^ (z >> 31)).to_le_bytes();
    }
    key
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn key_of_the_empty_name_and_seed_zero_is_splitmix_of_fnv() {
        // FNV-1a and SplitMix64 recomputed with Python integers.
        let first = u64::from_le_bytes(key("", 0)[..8].try_into().unwrap());
        assert_eq!(first, 0x5ba314b8cfda3b6b);
    }

    #[test]
    fn names_seeds_and_indices_give_different_streams() {
        let first = |name, seed, index| {
            Streams::new(name, seed).stream(index).next_u64()
        };
        let all = [
            first("a", 0, 0),
            first("a", 0, 1),
            first("a", 1, 0),
            first("b", 0, 0),
        ];
        let distinct: std::collections::BTreeSet<_> = all.iter().collect();
        assert_eq!(distinct.len(), all.len());
    }

    #[test]
    fn regresses_golden_stream() {
        let mut stream = Streams::new("golden", 0).stream(3);
        let words: Vec<u64> = (0..3).map(|_| stream.next_u64()).collect();
        let normals: Vec<f64> =
            (0..3).map(|_| standard_normal(&mut stream)).collect();
        assert_eq!(
            words,
            [14727504139145688472, 4717084770782290410, 5694641356309098044]
        );
        assert_eq!(
            normals,
            [-0.14051956583916592, -0.3558943289466587, -0.915832505669598]
        );
    }
}
