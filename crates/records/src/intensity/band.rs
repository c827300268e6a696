//! Periods that belong to a block.

use libm::{log, pow};

/// Number of periods.
const COUNT: usize = 12;

/// Shortest and longest period, in units of 2 pi/p.
const ENDS: (f64, f64) = (0.15, 1.0);

/// The periods at which spectral accelerations predict best whether a block
/// overturns: twelve in equal ratios from 0.15 to 1.0 times 2 pi/p, both ends
/// included, each rounded to four digits.
///
/// The band was chosen on 86 ordinary recorded motions
/// (`fixtures/law/law.py`).
///
/// ```
/// use rocking_records::intensity::RockingBand;
/// let band = RockingBand::try_new(3.0).expect("positive");
/// let periods_s = band.periods_s();
/// assert_eq!((periods_s[0], periods_s[11]), (0.3142, 2.094));
/// assert!(RockingBand::try_new(0.0).is_none());
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RockingBand {
    p_rad_s: f64,
    periods_s: [f64; COUNT],
}

impl RockingBand {
    /// The periods of a block with frequency parameter p in rad/s, from 1e-3
    /// to 1e3; `None` for any other number.
    pub fn try_new(p_rad_s: f64) -> Option<Self> {
        let (low, high) = ENDS;
        let periods_s = std::array::from_fn(|k| {
            let share = k as f64 / (COUNT - 1) as f64;
            let own = std::f64::consts::TAU / p_rad_s * low;
            rounded(own * pow(high / low, share))
        });
        let is_known = (1e-3..=1e3).contains(&p_rad_s);
        is_known.then_some(Self { p_rad_s, periods_s })
    }

    /// Frequency parameter of the block in rad/s.
    pub fn p_rad_s(&self) -> f64 {
        self.p_rad_s
    }

    /// The periods in s, rising.
    pub fn periods_s(&self) -> &[f64] {
        &self.periods_s
    }

    /// The ends of the band in words.
    pub(super) fn words() -> String {
        let (low, high) = ENDS;
        format!("{low} to {high} times 2 pi/p")
    }
}

/// The double nearest to the four leading digits of a positive number.
fn rounded(x: f64) -> f64 {
    let digits = 3 - (log(x) / std::f64::consts::LN_10).floor() as i32;
    let scale = libm::exp10(f64::from(digits.abs()));
    if digits < 0 {
        (x / scale).round() * scale
    } else {
        (x * scale).round() / scale
    }
}
