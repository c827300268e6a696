//! A hash of numbers, bit by bit.

use sha2::{Digest as _, Sha256};

/// SHA-256 over names and doubles, each as its eight bytes.
#[derive(Clone, Default)]
pub struct Bits(Sha256);

impl Bits {
    /// Takes numbers in. A zero has its sign; every not-a-number is the same.
    pub fn add(mut self, name: &str, numbers: &[f64]) -> Self {
        self.0.update(name);
        self.0.update((numbers.len() as u64).to_le_bytes());
        for x in numbers {
            let x = if x.is_nan() { f64::NAN } else { *x };
            self.0.update(x.to_bits().to_le_bytes());
        }
        self
    }

    /// The first 64 bits in hexadecimal.
    pub fn hex(self) -> String {
        let sum = self.0.finalize();
        sum[..8].iter().map(|byte| format!("{byte:02x}")).collect()
    }
}
