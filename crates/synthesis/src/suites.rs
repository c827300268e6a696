//! The two suites: their parameters, and their pairs.

use rayon::prelude::*;

use crate::moments;
use crate::pair::{
    MOST_DRAWS, ORDINARY_SEED, PULSE_SEED, Pair, Role, SynthesisError,
    finished, stream_index,
};
use crate::targets::{self, Design, Target};
use crate::waves;

/// Ordinary motions. Earthquakes and distances follow the record list; of each
/// earthquake it has the number of pairs, the magnitude, and reverse faulting.
#[rustfmt::skip]
pub(super) const ORDINARY: Design = Design {
    name: "ordinary",
    seed: ORDINARY_SEED,
    earthquakes: &[
        (12, 6.69, true), (12, 7.62, true), (11, 6.93, true), (9, 6.53, false),
        (6, 6.61, true), (5, 6.36, true), (5, 6.54, false), (4, 7.28, false),
        (4, 6.9, false), (3, 7.01, true), (2, 6.76, true), (2, 7.51, false),
        (2, 6.3, false), (1, 6.95, false), (1, 7.36, true), (1, 6.5, true),
        (1, 6.8, true), (1, 7.35, true), (1, 7.14, false), (1, 7.37, false),
        (1, 7.13, false), (1, 6.8, true),
    ],
    distances_km: &[
        [0.0, 0.5], [0.1, 3.9], [0.25, 8.3], [0.5, 15.2], [0.75, 23.0],
        [0.9, 28.7], [1.0, 70.0],
    ],
    pulses: false,
    recorded: &moments::ORDINARY,
    medians: &moments::ORDINARY_MEDIANS,
};

/// Pulse-type motions. Earthquakes follow the record list; distances are
/// chosen.
#[rustfmt::skip]
pub(super) const PULSE: Design = Design {
    name: "pulse",
    seed: PULSE_SEED,
    earthquakes: &[
        (6, 6.53, false), (6, 6.93, true), (6, 6.69, true), (6, 7.62, true),
        (3, 6.9, false), (2, 6.54, false), (2, 7.01, true), (2, 7.28, false),
        (2, 7.51, false), (2, 7.14, false), (2, 6.3, false), (1, 6.61, true),
        (1, 7.35, true), (1, 6.9, false), (1, 6.69, false), (1, 7.9, false),
    ],
    distances_km: &[[0.0, 1.0], [1.0, 15.0]],
    pulses: true,
    recorded: &moments::PULSE,
    medians: &moments::PULSE_MEDIANS,
};

/// All pairs of a suite. Its targets are drawn together, because they are
/// conditioned together. Each motion then has its own streams; a motion with
/// PGA of at most 0.14 g is made again from the next streams.
pub(super) fn pairs(suite: &Design) -> Result<Vec<Pair>, SynthesisError> {
    let targets = targets::conditioned(suite)?;
    let made = |(i, target): (usize, &Target)| {
        let pair = i as u64 + 1;
        for refused in 0..MOST_DRAWS {
            let stream = |role: Role| stream_index(pair, refused, role);
            let samples = waves::pair(suite.seed, target, stream);
            if let Some(components) = finished(suite.name, pair, samples)? {
                let scenario = target.scenario;
                return Ok(Pair { components, scenario, refused });
            }
        }
        Err(SynthesisError::Weak { suite: suite.seed, pair })
    };
    targets.par_iter().panic_fuse().enumerate().map(made).collect()
}

#[cfg(test)]
pub mod tests;
