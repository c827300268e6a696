//! Cells that are counts of records.

use rocking_statistics::Proportion;

use super::draws::{Replicated, Scheme};

impl Replicated {
    /// Probabilities from counts of records.
    #[must_use]
    pub fn counted(counts: Vec<Proportion>) -> Self {
        Self {
            scheme: Scheme::Counted,
            points: counts.iter().map(|count| count.share()).collect(),
            replicates: Vec::new(),
            without_one: Vec::new(),
            halves: Vec::new(),
            counts,
            samples: Vec::new(),
        }
    }
}
