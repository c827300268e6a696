//! What a plan must satisfy, when it is made and whenever it is read: its
//! folder is shared, so it is input like any other.

use std::collections::{BTreeMap, BTreeSet};

use rocking_common::suites::export;

use super::{LevelSteps, SCHEMA, SweepPlan};
use crate::failure::{AtPlace as _, Failure, bail, ensure};

impl SweepPlan {
    /// Refuses another form, and settings out of range.
    pub(super) fn check_settings(&self) -> Result<(), Failure> {
        let schema = self.schema;
        ensure!(schema == SCHEMA, "schema {schema}: expected {SCHEMA}");
        let (LevelSteps::StepIm(step) | LevelSteps::StepPgaG(step)) =
            self.levels;
        ensure!(
            step > 0.0 && step.is_finite(),
            "step {step}: expected a positive number"
        );
        ensure!(!self.demands.is_empty(), "no demands: expected one or more");
        let mut seen = BTreeSet::new();
        for demand in &self.demands {
            ensure!(
                *demand > 0.0 && *demand <= 1.0,
                "demand {demand}: expected a number above 0, at most 1"
            );
            ensure!(
                seen.insert(demand.to_string()),
                "demand {demand} comes again: expected each once"
            );
        }
        Ok(())
    }

    /// Refuses blocks out of range, blocks or names that come twice, and tiles
    /// without a block.
    pub(super) fn check_blocks(&self) -> Result<(), Failure> {
        let (mut ids, mut same) = (BTreeSet::new(), BTreeMap::new());
        for given in &self.blocks {
            let id = &given.id;
            self.analysis(given).at(id)?;
            ensure!(
                ids.insert(id),
                "two blocks are named {id}: expected different names"
            );
            if let Some(first) = same.insert(given.cells(), id) {
                bail!(
                    "{id} is the same block as {first}: expected each block, \
                     by its parameters and eta, once"
                );
            }
        }
        ensure!(
            !self.blocks.is_empty() && self.tile_blocks > 0,
            "{} blocks, {} a tile: expected one or more",
            self.blocks.len(),
            self.tile_blocks
        );
        Ok(())
    }

    /// Refuses records without a hash or a name for a file, and earthquakes
    /// that are not those of the records.
    pub(super) fn check_records(&self) -> Result<(), Failure> {
        let count = self.records.len();
        ensure!(
            count > 0 && [0, count].contains(&self.events.len()),
            "{count} records of {} earthquakes: expected records, and the \
             earthquake of each or of none",
            self.events.len()
        );
        let mut names = BTreeSet::new();
        for (name, hash) in &self.records {
            let hex = |c: u8| matches!(c, b'0'..=b'9' | b'a'..=b'f');
            let fits = export::is_file_name(name)
                && hash.len() == 64
                && hash.bytes().all(hex);
            ensure!(
                fits && names.insert(name),
                "record {name:?}, {hash:?}: expected a name of its own that a \
                 file can have, and a SHA-256"
            );
        }
        Ok(())
    }
}
