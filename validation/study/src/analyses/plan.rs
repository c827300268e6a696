//! The plan of a study.

use crate::runs::Setup;
use rocking_common::findings::StudySettings;
use rocking_common::paper::Arm;

/// The plan of a study: its settings and grids.
#[derive(Clone, Debug)]
pub struct Plan {
    /// Settings of every analysis.
    pub setup: Setup,
    /// Grids in the order A, B, C.
    pub arms: Vec<Arm>,
    /// Whether other choices are run on all blocks.
    pub full: bool,
    /// Replicates of the bootstrap, [`REPLICATES`] in a study to keep.
    ///
    /// [`REPLICATES`]: crate::inference::REPLICATES
    pub replicates: usize,
}

impl Plan {
    /// The settings in the form of the findings.
    pub fn settings(&self) -> StudySettings {
        StudySettings {
            arms: self.arms.clone(),
            eta: self.setup.restitution.velocity_ratio(),
            overturning: self.setup.overturning,
            refinement_im: self.setup.tolerance,
            full: self.full,
        }
    }

    /// Grids from which figures are drawn: A and C, if they are run.
    pub fn drawn(&self) -> Vec<Arm> {
        let drawn = |arm: &&Arm| **arm != Arm::B;
        self.arms.iter().filter(drawn).copied().collect()
    }

    /// The grid that the single-record figures share: C if it is run, else the
    /// first.
    pub fn common(&self) -> Arm {
        match self.arms.as_slice() {
            arms if arms.contains(&Arm::C) => Arm::C,
            arms => arms.first().copied().unwrap_or(Arm::A),
        }
    }
}
