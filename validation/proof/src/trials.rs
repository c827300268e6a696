//! Random scenes that test the certificate of a run: a run in double precision
//! against wider arithmetic from the same doubles.
//!
//! The address of a scene, its stratum and its index, determines it. Gravity
//! is 1 in all scenes, so that accelerations are multiples of it and no
//! quotient rounds them again.

mod compare;
mod draw;
mod ends;
mod grazing;
mod random;
mod records;
mod search;
mod summary;

pub use compare::{
    CertificateReading, DoubleRun, Finding, Trial, WideTruth, compare,
};
pub use summary::{Judgement, SHARES, TrialSummary};

use rayon::prelude::*;
use rocking_statistics::streams::Streams;

use crate::scene::{EngineError, EngineResult};
pub(crate) use compare::{WORK, truth};
pub(crate) use draw::Draw;
use rocking::names::named;
pub(crate) use search::moved;

named! {
    /// A population of scenes.
    #[derive(PartialOrd, Ord)]
    pub enum Stratum: "stratum" {
        /// Blocks and ground motions of the study and around it.
        Ordinary = "ordinary",
        /// Blocks, records and pulses at the limits of valid input.
        Extreme = "extreme",
        /// Scenes in which a discrete decision is taken within rounding.
        Grazing = "grazing",
        /// Scenes whose end of observation is a decision.
        Ending = "ending",
        /// Scenes whose ground acceleration has its peak at the threshold of
        /// uplift.
        Touching = "touching",
        /// Scenes whose first hop after rest grazes the base.
        FirstHop = "first-hop",
    }
}

/// The scene of an address.
///
/// None if the stratum needs a grazing scene and no drawn scene can be made to
/// graze.
///
/// # Errors
/// [`EngineError`] if a run of the search is refused.
///
/// ```
/// use rocking_proof::trials::{Stratum, trial};
/// let trial = trial(Stratum::Ordinary, 0)?.unwrap();
/// assert!(trial.name.starts_with("ordinary:0 "));
/// # Ok::<(), rocking_proof::scene::EngineError>(())
/// ```
pub fn trial(stratum: Stratum, index: u64) -> EngineResult<Option<Trial>> {
    let name = format!("trials {}", stratum.name());
    let mut draw = Draw(Streams::new(&name, 0).stream(index));
    let found = match stratum {
        Stratum::Ordinary => Some(random::ordinary(&mut draw)),
        Stratum::Extreme => Some(random::extreme(&mut draw)),
        Stratum::Grazing => grazing::grazing(&mut draw, index)?,
        Stratum::Ending => ends::ending(&mut draw, index)?,
        Stratum::Touching => ends::touching(&mut draw, index),
        Stratum::FirstHop => grazing::first_hop(&mut draw)?,
    };
    Ok(found.map(|(kind, scene)| Trial {
        name: format!("{}:{index} {kind}", stratum.name()),
        scene,
    }))
}

/// Findings on the scenes of these indices, in their order, without scenes
/// that could not be made to graze and scenes that exceed the work limit in
/// some arithmetic.
///
/// # Errors
/// [`EngineError`] of the first scene refused for another reason.
pub fn findings(
    stratum: Stratum,
    indices: &[u64],
) -> EngineResult<Vec<Finding>> {
    let finding = |index: &u64| {
        let trial = trial(stratum, *index);
        match trial.and_then(|trial| trial.as_ref().map(compare).transpose()) {
            Err(EngineError::Work(_)) => None,
            found => found.transpose(),
        }
    };
    indices.par_iter().filter_map(finding).collect()
}
