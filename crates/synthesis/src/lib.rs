//! The embedded suites: synthetic ground motions from published stochastic
//! models, so that the study runs without any file.
//!
//! In plain words: each suite has the earthquakes of a recorded suite, with as
//! many pairs of each, and is adjusted to four moments of its motions: PGA,
//! PGV, D5-75 and response spectrum have the recorded mean and dispersion, and
//! the recorded correlation with PGA and with PGV. Seven ratios to PGA have
//! the recorded medians. The program contains 152 such numbers of the records,
//! and no sample of a record. Rocking responses were not used in this
//! adjustment, so capacities and verdicts are an independent test of the
//! suites.
//!
//! **Targets.** For every component a target is drawn: PGA, spectral
//! accelerations at 15 periods from 0.1 to 10 s, PGV and D5-75, as Zentner ("A
//! procedure for simulating synthetic accelerograms compatible with correlated
//! and conditional probabilistic response spectra", SDEE 63, 2014) proposes.
//! - Published: median and scatter, between earthquakes and within, for
//!   magnitude, distance, Vs30 and style of faulting, by Cauzzi, Faccioli,
//!   Vanini and Bianchini (BEE 13, 2015); correlation between periods by Baker
//!   and Jayaram (Earthquake Spectra 24, 2008), of PGV with them by Bradley
//!   (Earthquake Spectra 28, 2012), and between components by Baker and
//!   Cornell (BSSA 96, 2006, Eq. 7); D5-75 by Bommer, Stafford and Alarcon
//!   (BSSA 99, 2009).
//! - Conditioned: an affine transformation of the logarithms over the whole
//!   suite gives the study components exactly the recorded moments
//!   (`moments.rs`). Also from the recorded suite: the correlation of D5-75
//!   with the spectrum and with the other component.
//! - Bent: at a given PGA, recorded PGV and spectral accelerations are skewed.
//!   A few are far below the others but not above, because the amplification
//!   by an oscillator is limited. Lognormal targets exceed this limit, and a
//!   motion can only meet them with a larger PGA: average spectral
//!   acceleration over PGA would be low by 4 to 7 % in the mean and by up to
//!   21 % in the median. A quadratic function of normal scores therefore gives
//!   seven ratios to PGA their recorded medians: PGV, and mean spectral
//!   accelerations of six neighbouring periods.
//! - Scenario: earthquakes, and distances of ordinary motions, follow the
//!   lists of the recorded pairs. The lists have no sites, so that Vs30 is our
//!   choice: lognormal around 380 m/s. Distances of pulse-type motions are
//!   also chosen, log-uniform in 1 to 15 km, with 5 to 40 km of rupture
//!   towards the site.
//!
//! **Velocity pulses** of the pulse-type suite follow Dabaghi and Der
//! Kiureghian ("Stochastic model for simulation of near-fault ground motions",
//! EESD 46, 2017; "Simulation of orthogonal horizontal components of
//! near-fault ground motion", EESD 47, 2018): the pulse of Mavroeidis and
//! Papageorgiou (2003) without its residual displacement, its parameters drawn
//! from published regressions, among them the period on magnitude. It makes a
//! random angle with the components, because a recorded pair's axes are
//! arbitrary. The target is the root of the sum of squares of pulse and other
//! waves.
//!
//! **Motions** (`waves.rs`) are white noise in 24 bands under a gamma-shaped
//! envelope with a lognormal fluctuation (Yamamoto and Baker, BSSA 103, 2013,
//! scatter wavelet packets likewise). Its frequency content falls with time
//! (Rezaeian and Der Kiureghian, EESD 39, 2010). Filters are passed forwards
//! and backwards, so that no band is late. The high-pass filter is by Rezaeian
//! and Der Kiureghian (EESD 37, 2008, Eq. 9); its corner depends on the
//! magnitude. Each band is cut into packets in time, and the amplitudes of the
//! packets and of the pulse are corrected eight times, by least squares,
//! towards the target. If the target contradicts itself, most often at periods
//! above 3 s, the motion keeps a difference.
//!
//! The other constants were chosen only by moments of motions, which
//! `cargo run -p rocking-synthesis --example motions` prints.
//!
//! As in the paper every component has PGA above 0.14 g: other pairs are drawn
//! again with the next stream, at most a hundred times.

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
/// [`SynthesisError`], but never in practice: the suite is always the same.
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
/// [`SynthesisError`], but never in practice: the suite is always the same.
pub fn pulse() -> Result<Vec<Pair>, SynthesisError> {
    suites::pairs(&suites::PULSE)
}

#[cfg(test)]
mod tests;
