//! Ordinary motions: a target spectrum for each component from published
//! relations, conditioned on the moments of recorded motions, then modulated
//! filtered noise that meets the target spectrum.

mod attenuation;
mod moments;
mod targets;
mod waves;

use rayon::prelude::*;

use crate::pair::{
    Earthquake, MOST_DRAWS, ORDINARY_SEED, Pair, Role, SynthesisError,
    finished, stream_index,
};
use targets::Target;

/// The earthquakes of the record list: how many pairs the list has of each,
/// moment magnitude, and whether its faulting is reverse or oblique.
#[rustfmt::skip]
const EARTHQUAKES: [(usize, f64, bool); 22] = [
    (12, 6.69, true), (12, 7.62, true), (11, 6.93, true), (9, 6.53, false),
    (6, 6.61, true), (5, 6.36, true), (5, 6.54, false), (4, 7.28, false),
    (4, 6.9, false), (3, 7.01, true), (2, 6.76, true), (2, 7.51, false),
    (2, 6.3, false), (1, 6.95, false), (1, 7.36, true), (1, 6.5, true),
    (1, 6.8, true), (1, 7.35, true), (1, 7.14, false), (1, 7.37, false),
    (1, 7.13, false), (1, 6.8, true),
];

/// The earthquakes, in the order of the suite.
fn earthquakes() -> Vec<Earthquake> {
    let of = |(pairs, mw, reverse)| Earthquake { pairs, mw, reverse };
    EARTHQUAKES.map(of).to_vec()
}

/// All pairs. The targets of the suite are drawn together, because they are
/// conditioned together; each motion then has streams of its own. A motion
/// with PGA of at most 0.14 g takes the noise of the next streams.
pub(super) fn suite() -> Result<Vec<Pair>, SynthesisError> {
    let targets = targets::conditioned(ORDINARY_SEED, &earthquakes())?;
    targets
        .into_par_iter()
        .panic_fuse()
        .enumerate()
        .map(|(i, Target { scenario, components })| {
            let pair = i as u64 + 1;
            for refused in 0..MOST_DRAWS {
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
            }
            Err(SynthesisError::Weak { suite: ORDINARY_SEED, pair })
        })
        .collect()
}

#[cfg(test)]
mod tests;
