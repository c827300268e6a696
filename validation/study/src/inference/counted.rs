//! Cells that are counts of records.

use rocking::statistics::Proportion;

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
        }
    }

    /// Some of the cells.
    pub(super) fn select(&self, places: &[usize]) -> Self {
        let count = |k: &usize| self.counts.get(*k).copied();
        let counts = places.iter().filter_map(count).collect();
        let own = self.map(|row| places.iter().map(|k| row[*k]).collect());
        Self { counts, ..own }
    }
}
