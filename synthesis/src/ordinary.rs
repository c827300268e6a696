//! Ordinary motions: a target spectrum for each component from published
//! relations, conditioned on the moments of recorded motions, then modulated
//! filtered noise that meets the target spectrum.

mod attenuation;
mod moments;
mod targets;
mod waves;

use rayon::prelude::*;
use rocking::record::AccelerogramError;

use crate::pair::{ORDINARY_SEED, Pair, Role, finished, stream_index};
use targets::Target;

/// Pairs of the suite.
const PAIRS: u64 = 86;

/// All pairs. The targets of the suite are drawn together, because they are
/// conditioned together; each motion then has streams of its own. A motion
/// with PGA of at most 0.14 g takes the noise of the next streams.
pub(super) fn suite() -> Result<Vec<Pair>, AccelerogramError> {
    let targets = targets::conditioned(ORDINARY_SEED, PAIRS);
    targets
        .into_par_iter()
        .panic_fuse()
        .enumerate()
        .map(|(i, Target { scenario, components })| {
            let pair = i as u64 + 1;
            let mut refused = 0;
            loop {
                let stream = |role: Role| stream_index(pair, refused, role);
                let samples = waves::pair(
                    ORDINARY_SEED,
                    scenario.mw,
                    &components,
                    stream,
                );
                if let Some(found) = finished("ordinary", pair, samples)? {
                    return Ok(Pair { components: found, scenario, refused });
                }
                refused += 1;
            }
        })
        .collect()
}

#[cfg(test)]
mod tests;
