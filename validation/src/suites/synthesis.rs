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

mod draws;
mod near_fault;
mod noise;
mod ordinary;
mod special;

use noise::{DT_S, settle};
use rocking::record::{Accelerogram, AccelerogramError};

/// Standard gravity, in m/s2.
const GRAVITY_M_S2: f64 = 9.80665;

/// Least peak ground acceleration of a component, in g.
const LEAST_PGA_G: f64 = 0.14;

/// Earthquake and site of one pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scenario {
    /// Moment magnitude.
    pub mw: f64,
    /// Distance to the rupture, in km.
    pub rrup_km: f64,
    /// Shear-wave velocity of the upper 30 m, in m/s.
    pub vs30_m_s: f64,
    /// Reverse faulting; strike slip otherwise.
    pub reverse: bool,
    /// Length of rupture towards the site, in km; zero for ordinary motions.
    pub towards_site_km: f64,
}

/// Two horizontal components and where they came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The components; the first is the one that the study uses.
    pub components: [Accelerogram; 2],
    /// Earthquake and site.
    pub scenario: Scenario,
    /// How many draws were refused before this one.
    pub refused: u64,
}

/// What a random stream is for.
#[derive(Clone, Copy, Debug)]
enum Role {
    Scenario,
    Parameters,
    First,
    Second,
}

/// Name of the random streams of the ordinary suite.
pub const ORDINARY_SEED: &str = "rocking/synthesis/ordinary/2";

/// Name of the random streams of the pulse-type suite.
pub const PULSE_SEED: &str = "rocking/synthesis/pulse/1";

/// The embedded suite of 86 ordinary pairs, named `ordinary-01-a`,
/// `ordinary-01-b` and so on.
///
/// # Errors
/// None in practice: samples are finite by construction.
pub fn ordinary() -> Result<Vec<Pair>, AccelerogramError> {
    ordinary::suite()
}

/// The embedded suite of 44 pulse-type pairs, named `pulse-01-a`,
/// `pulse-01-b` and so on.
///
/// # Errors
/// None in practice: samples are finite by construction.
pub fn pulse() -> Result<Vec<Pair>, AccelerogramError> {
    near_fault::suite()
}

/// Number of the stream of a pair, an attempt and a purpose.
fn stream_index(pair: u64, attempt: u64, role: Role) -> u64 {
    pair << 32 | attempt << 2 | role as u64
}

/// Both components at rest at their ends, rounded and named; `None` where
/// one has PGA of at most 0.14 g.
fn finished(
    suite: &str,
    pair: u64,
    [mut a, mut b]: [Vec<f64>; 2],
) -> Result<Option<[Accelerogram; 2]>, AccelerogramError> {
    settle(&mut a);
    settle(&mut b);
    let a = component(suite, pair, 'a', a)?;
    let b = component(suite, pair, 'b', b)?;
    let strong = a.pga_g() > LEAST_PGA_G && b.pga_g() > LEAST_PGA_G;
    Ok(strong.then_some([a, b]))
}

fn component(
    suite: &str,
    pair: u64,
    letter: char,
    samples_g: Vec<f64>,
) -> Result<Accelerogram, AccelerogramError> {
    Accelerogram::try_new(
        format!("{suite}-{pair:02}-{letter}"),
        DT_S,
        samples_g,
    )
}

#[cfg(test)]
mod tests;
