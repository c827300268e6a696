//! A pair of components with its earthquake and site.

use rocking::accelerogram::{Accelerogram, AccelerogramError};
use thiserror::Error;

use crate::noise::{DT_S, settle};

/// Standard gravity, in m/s2.
pub(crate) const GRAVITY_M_S2: f64 = 9.80665;

/// Least peak ground acceleration of a component, in g.
pub(crate) const LEAST_PGA_G: f64 = 0.14;

/// The most draws of a pair before the suite is refused.
pub(crate) const MOST_DRAWS: u64 = 100;

/// Why a suite cannot be made.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SynthesisError {
    /// Samples that are not a valid record.
    #[error(transparent)]
    Record(#[from] AccelerogramError),
    /// No draw of a pair is strong enough.
    #[error(
        "streams {suite}, pair {pair}: no motion with PGA above 0.14 g in \
         {MOST_DRAWS} draws"
    )]
    Weak {
        /// Name of the streams.
        suite: &'static str,
        /// Number of the pair.
        pair: u64,
    },
}

/// Earthquake and site of one pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Scenario {
    /// Number of the earthquake in its suite, from 1.
    pub earthquake: u64,
    /// Moment magnitude.
    pub mw: f64,
    /// Distance to the rupture, in km.
    pub rrup_km: f64,
    /// Shear-wave velocity of the upper 30 m, in m/s.
    pub vs30_m_s: f64,
    /// Whether faulting is reverse; if not, it is strike slip.
    pub reverse: bool,
    /// Length of rupture towards the site, in km; zero for ordinary motions.
    pub towards_site_km: f64,
}

impl Scenario {
    /// Name of the earthquake, as an index has it.
    pub fn event(&self) -> String {
        format!("earthquake {:02}", self.earthquake)
    }

    /// Names and texts of its columns in an index.
    pub fn columns(&self) -> [(&'static str, String); 5] {
        let mechanism = if self.reverse { "reverse" } else { "strike slip" };
        [
            ("event", self.event()),
            ("mechanism", mechanism.to_owned()),
            ("mw", self.mw.to_string()),
            ("rrup_km", self.rrup_km.to_string()),
            ("vs30_m_s", self.vs30_m_s.to_string()),
        ]
    }
}

/// Two horizontal components with their earthquake and site.
#[derive(Clone, Debug, PartialEq)]
pub struct Pair {
    /// The components; the first is the one that the study uses.
    pub components: [Accelerogram; 2],
    /// Earthquake and site.
    pub scenario: Scenario,
    /// Number of draws that were refused before this one.
    pub refused: u64,
}

/// Purpose of a random stream.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Role {
    Earthquake,
    Scenario,
    Parameters,
    First,
    Second,
}

/// Name of the random streams of the ordinary suite.
pub const ORDINARY_SEED: &str = "rocking/synthesis/ordinary/4";

/// Name of the random streams of the pulse-type suite.
pub const PULSE_SEED: &str = "rocking/synthesis/pulse/3";

/// Number of the stream of a pair, an attempt and a purpose.
pub(crate) fn stream_index(pair: u64, attempt: u64, role: Role) -> u64 {
    pair << 32 | attempt << 3 | role as u64
}

/// Both components at rest at their ends, rounded and named; `None` if one has
/// PGA of at most 0.14 g.
pub(crate) fn finished(
    suite: &str,
    pair: u64,
    [a, b]: [Vec<f64>; 2],
) -> Result<Option<[Accelerogram; 2]>, AccelerogramError> {
    let component = |letter: char, mut samples_g: Vec<f64>| {
        settle(&mut samples_g);
        let name = format!("{suite}-{pair:02}-{letter}");
        Accelerogram::try_new(name, DT_S, samples_g)
    };
    let both = [component('a', a)?, component('b', b)?];
    let strong = both.iter().all(|one| one.pga_g() > LEAST_PGA_G);
    Ok(strong.then_some(both))
}
