//! The embedded suites: synthetic ground motions from published stochastic
//! models, so that the study runs without any file.
//!
//! In plain words: the 44 pulse-type pairs are simulated by a published
//! near-fault model, and nothing of them was adjusted to records. The 86
//! ordinary pairs are simulated, too, but their levels are those of a recorded
//! suite: PGA, PGV, D5-75 and response spectra of the simulated suite are made
//! to have the mean and the dispersion that 86 recorded pairs of PEER's
//! database have. 32 such numbers are all that the program knows of those
//! records; no sample of a record is in it. Rocking responses were not used:
//! capacities and verdicts of the study test the suite.
//!
//! **Ordinary motions** are simulated as Zentner ("A procedure for simulating
//! synthetic accelerograms compatible with correlated and conditional
//! probabilistic response spectra", SDEE 63, 2014) proposes: a target response
//! spectrum is drawn for every component, then filtered noise that meets the
//! target.
//! - Published: median and scatter of the spectrum, for magnitude, distance,
//!   Vs30 and style of faulting, by Cauzzi, Faccioli, Vanini and Bianchini
//!   (BEE 13, 2015); correlation between periods by Baker and Jayaram
//!   (Earthquake Spectra 24, 2008) and between components by Baker and Cornell
//!   (BSSA 96, 2006, Eq. 7); D5-75 by Bommer, Stafford and Alarcon (BSSA 99,
//!   2009); the high-pass filter of Rezaeian and Der Kiureghian (EESD 37,
//!   2008, Eq. 9), whose corner depends on the magnitude.
//! - Conditioned: one affine transformation of the logarithms of each
//!   quantity over the whole suite gives the study components exactly the
//!   recorded mean and standard deviation of PGA, 13 spectral accelerations
//!   from 0.1 to 5 s, PGV and D5-75 (`ordinary/moments.rs`). Also from the
//!   recorded suite: the scatter of PGV about the spectrum and the
//!   correlation of D5-75 with spectrum and other component.
//! - Scenario: magnitudes, distances and share of reverse faulting follow the
//!   list of the recorded pairs. That list has no sites, so that Vs30 is ours:
//!   lognormal about 380 m/s.
//! - Chosen: 24 bands of white noise under a gamma-shaped envelope with a
//!   lognormal fluctuation of the amplitude (Yamamoto and Baker, BSSA 103,
//!   2013, scatter wavelet packets likewise), each through a filter of two
//!   oscillators. The amplitudes of the bands are corrected six times by what
//!   the response spectrum misses; the motion is then scaled to its PGV.
//!
//! The constants that are chosen were settled by moments of motions alone
//! (medians, dispersions, Arias intensity, peak factor and delay of five
//! frequency bands); 24 variants were tried. Capacities were measured for four
//! of them, the last among these, and chose none.
//!
//! **Pulse-type motions** follow Dabaghi and Der Kiureghian ("Stochastic
//! model for simulation of near-fault ground motions", EESD 46, 2017;
//! "Simulation of orthogonal horizontal components of near-fault ground
//! motion", EESD 47, 2018): the velocity pulse of Mavroeidis and Papageorgiou
//! (2003) without its residual displacement, plus a modulated, filtered noise
//! residual; 19 parameters, drawn from published regressions, among them the
//! pulse period on magnitude. The pair is then turned by a random angle,
//! because a recorded pair's axes are arbitrary. Scenarios are ours: Mw
//! uniform in 6.3 to 7.6, strike slip or reverse, Vs30 log-uniform in 200 to
//! 760 m/s, distance log-uniform in 1 to 15 km, 5 to 40 km of rupture towards
//! the site.
//!
//! As in the paper every component has PGA above 0.14 g: a pair that has not
//! is drawn again with the next stream.

#![deny(missing_docs)]

mod attenuation;
mod draws;
mod kind;
mod moments;
mod noise;
mod pair;
mod peaks;
mod pulse;
mod special;
mod suites;
mod targets;
mod waves;

pub use kind::SuiteKind;
pub use pair::{ORDINARY_SEED, PULSE_SEED, Pair, Scenario, SynthesisError};

/// The embedded suite of 86 ordinary pairs, named `ordinary-01-a`,
/// `ordinary-01-b` and so on.
///
/// ```
/// let pairs = rocking_synthesis::ordinary()?;
/// assert_eq!(pairs.len(), 86);
/// assert_eq!(pairs[0].components[1].name(), "ordinary-01-b");
/// # Ok::<(), rocking_synthesis::SynthesisError>(())
/// ```
///
/// # Errors
/// [`SynthesisError`]; none in practice: the suite is always the same.
pub fn ordinary() -> Result<Vec<Pair>, SynthesisError> {
    suites::pairs(&suites::ORDINARY)
}

/// The embedded suite of 44 pulse-type pairs, named `pulse-01-a`,
/// `pulse-01-b` and so on.
///
/// ```
/// let pairs = rocking_synthesis::pulse()?;
/// assert_eq!(pairs.len(), 44);
/// # Ok::<(), rocking_synthesis::SynthesisError>(())
/// ```
///
/// # Errors
/// [`SynthesisError`]; none in practice: the suite is always the same.
pub fn pulse() -> Result<Vec<Pair>, SynthesisError> {
    suites::pairs(&suites::PULSE)
}

#[cfg(test)]
mod tests;
