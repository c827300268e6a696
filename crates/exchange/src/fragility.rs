//! A fragility of one block, in the unit of the ground motion.
//!
//! A fragility in PGA or PGV is dimensionless in the statistics. Other
//! programs need the PGA or PGV of one block, in their own units: OpenQuake
//! PGA in g and PGV in cm/s, pelicun and PACT in g and m/s.

use std::collections::BTreeSet;
use std::fmt;
use std::str::FromStr;

use deunicode::deunicode;
use rocking::block::Block;
use rocking::integrator::{Model, uplift_threshold};
use rocking::names::as_text;
use rocking_procedures::ModelError;
use rocking_procedures::fragility::total::TotalFragility;
use rocking_records::intensity::{Intensity, IntensityMeasure};
use rocking_statistics::Lognormal;
use rocking_statistics::lognormal::LognormalError;

use crate::table::number;

/// The most characters of a name in OpenQuake.
const LONGEST: usize = 75;

/// A name that every reader accepts: at most 75 ASCII letters, digits, `_` and
/// `:`. OpenQuake accepts no dot and no slash in a name, and pelicun splits
/// names at `-`.
///
/// ```
/// use rocking_exchange::Id;
/// assert!("BLOCK_p300_a015".parse::<Id>().is_ok());
/// assert!("BLOCK-p300-a015".parse::<Id>().is_err());
/// assert!("BLOCK/p3.0/a0.15".parse::<Id>().is_err());
/// ```
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Id(String);

as_text!(Id);

impl FromStr for Id {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let taken = |c: char| c.is_ascii_alphanumeric() || "_:".contains(c);
        if text.is_empty() || text.len() > LONGEST || !text.chars().all(taken)
        {
            return Err(format!(
                "found `{text}`: expected a name of at most {LONGEST} ASCII \
                 letters, digits, _ and :"
            ));
        }
        Ok(Self(text.to_owned()))
    }
}

impl fmt::Display for Id {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(&self.0)
    }
}

impl Id {
    /// The name of a block by its parameters, with all their digits, so that
    /// two blocks never share a name.
    ///
    /// ```
    /// use rocking::Block;
    /// use rocking_exchange::Id;
    /// let block = Block::try_new(0.15, 3.0)?;
    /// assert_eq!(Id::of(&block)?.to_string(), "block_a0_15_p3");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// A name that is too long because of the digits.
    pub fn of(block: &Block) -> Result<Self, String> {
        let digits = |x: f64| x.to_string().replace('.', "_");
        let alpha = digits(block.slenderness_rad());
        let p = digits(block.frequency_rad_s());
        format!("block_a{alpha}_p{p}").parse()
    }

    /// The name made of a text for people: the text itself if it is a name,
    /// else its transliteration, with one `_` for each run of other
    /// characters; `None` if nothing is left.
    ///
    /// ```
    /// use rocking_exchange::Id;
    /// let id = |label: &str| Id::of_label(label).map(|id| id.to_string());
    /// assert_eq!(id("Kouros_1").as_deref(), Some("Kouros_1"));
    /// assert_eq!(id("Étagère (1972.118)").as_deref(), Some("Etagere_1972_118"));
    /// assert_eq!(id("..."), None);
    /// ```
    pub fn of_label(label: &str) -> Option<Self> {
        if let Ok(id) = label.parse() {
            return Some(id);
        }
        let ascii = deunicode(label);
        let other = |c: char| !c.is_ascii_alphanumeric() && c != ':';
        let words = ascii.split(other).filter(|word| !word.is_empty());
        let mut name = words.collect::<Vec<_>>().join("_");
        name.truncate(LONGEST);
        name.trim_end_matches('_').parse().ok()
    }

    /// Names made of the labels of several objects: `object_` and the place of
    /// a label of which nothing is left.
    ///
    /// ```
    /// use rocking_exchange::Id;
    /// let ids = Id::of_labels(&["Kräter", "...", "Krater"]);
    /// let ids: Vec<String> = ids.iter().map(Id::to_string).collect();
    /// assert_eq!(ids, ["Krater_2", "object_2", "Krater"]);
    /// ```
    pub fn of_labels(labels: &[&str]) -> Vec<Self> {
        let of = |(label, place): (&&str, usize)| {
            let other = || Self(format!("object_{place}"));
            Self::of_label(label).unwrap_or_else(other)
        };
        let mut ids: Vec<Self> = labels.iter().zip(1..).map(of).collect();
        let (given, derived): (Vec<_>, Vec<_>) = labels
            .iter()
            .zip(&mut ids)
            .partition(|(label, id)| **label == id.0);
        let all = given.into_iter().chain(derived);
        Self::distinguish(all.map(|(_, id)| id));
        ids
    }

    /// Puts `_2`, `_3` behind the second and third of equal names.
    pub fn distinguish<'a>(ids: impl Iterator<Item = &'a mut Self>) {
        let mut taken = BTreeSet::new();
        for id in ids {
            let (own, mut count) = (id.clone(), 1);
            while !taken.insert(id.clone()) {
                count += 1;
                *id = Self(format!("{own:.60}_{count}"));
            }
        }
    }
}

/// The fragilities of one block, one for each limit state.
#[derive(Clone, Debug, PartialEq)]
pub struct BlockFragility {
    /// Its name.
    pub id: Id,
    /// The block.
    pub block: Block,
    /// Coefficient of restitution, if known.
    pub eta: Option<f64>,
    /// The intensity measure of the ground motion.
    pub im: IntensityMeasure,
    /// Limit states in the order of rising damage.
    pub limit_states: Vec<LimitState>,
    /// Origin of the fragilities, in words.
    pub origin: String,
    /// The error of the model, which files state beside the scatter of the
    /// records.
    pub model_error: ModelError,
}

/// A limit state with its total.
pub(crate) type StateTotal<'a> = (&'a LimitState, TotalFragility);

impl BlockFragility {
    /// The limit states with their totals, in a unit of which the block's own
    /// unit has `units`.
    pub(crate) fn totals(
        &self,
        units: f64,
    ) -> Result<Vec<StateTotal<'_>>, LognormalError> {
        let states = self.limit_states.iter();
        let totals = states.map(|state| {
            let own = self.model_error.total(state.fragility)?;
            Ok((state, if units == 1.0 { own } else { own.scaled(units)? }))
        });
        totals.collect()
    }

    /// The origin of the fragilities and, if there is an error of the model,
    /// the parts: the law of the records and this error.
    pub(crate) fn described(&self) -> String {
        if self.model_error.is_none() {
            return self.origin.clone();
        }
        let part = |state: &LimitState| {
            let law = &state.fragility;
            let [median, beta, shift] =
                [law.median(), law.dispersion(), law.shift()].map(number);
            let unit = self.im.unit();
            let name = &state.name;
            format!(
                "{name}: median {median} {unit}, dispersion {beta} above \
                 {shift} {unit}"
            )
        };
        let parts: Vec<_> = self.limit_states.iter().map(part).collect();
        format!(
            "{}; {}; parts: records, {}; and {}",
            self.origin,
            self.id,
            parts.join(", "),
            self.model_error
        )
    }
}

/// A degree of damage, and how probable it is.
#[derive(Clone, Debug, PartialEq)]
pub struct LimitState {
    /// Its name.
    pub name: Id,
    /// Probability of reaching it, by the scatter of the records only, in the
    /// unit of the block's intensity measure: g for PGA, m/s for PGV.
    pub fragility: Lognormal,
}

/// Number of steps in the score at which two curves are compared.
const STEPS: i32 = 1000;

/// Largest score at which two curves are compared.
const LARGEST_SCORE: f64 = 8.0;

/// The intensity at which the probability of `next`, a state of greater
/// damage, exceeds the probability of `own` most; `None` if it exceeds it by
/// `tolerance` or less.
pub(crate) fn crossed_by(
    own: &TotalFragility,
    next: &TotalFragility,
    tolerance: f64,
) -> Option<f64> {
    let step = LARGEST_SCORE / f64::from(STEPS);
    let all = [own, next].into_iter().flat_map(|law| {
        (-STEPS..=STEPS).map(move |k| law.at_score(f64::from(k) * step))
    });
    let above = |im: f64| next.cdf(im) - own.cdf(im);
    let worst = all.max_by(|a, b| above(*a).total_cmp(&above(*b)))?;
    (above(worst) > tolerance).then_some(worst)
}

/// The PGA in g or the PGV in m/s at a dimensionless intensity of 1: tan
/// alpha, or g tan alpha/p; Eq. 2 has alpha instead of tan alpha.
///
/// ```
/// use rocking::Block;
/// use rocking::integrator::Model;
/// use rocking_records::intensity::Intensity;
/// use rocking_exchange::unit_intensity;
/// let block = Block::try_new(0.15, 3.0)?;
/// let pgv = unit_intensity(Intensity::Pgv, &block, Model::Nonlinear, 9.81);
/// assert!((pgv - 9.81 * 0.151_135_218_058 / 3.0).abs() < 1e-11);
/// # Ok::<(), rocking::block::BlockError>(())
/// ```
pub fn unit_intensity(
    intensity: Intensity,
    block: &Block,
    model: Model,
    gravity_m_s2: f64,
) -> f64 {
    let threshold_g = uplift_threshold(block, model);
    let velocity_m_s = threshold_g * gravity_m_s2 / block.frequency_rad_s();
    intensity.of(threshold_g, velocity_m_s)
}

/// The origin of a fragility if only the size and the measure of its sample
/// are known.
///
/// ```
/// use rocking_records::intensity::IntensityMeasure;
/// use rocking_exchange::unstated_origin;
/// let words = unstated_origin(86, &IntensityMeasure::PGA);
/// assert!(words.starts_with("86 capacities in PGA/(g tan alpha)"));
/// ```
pub fn unstated_origin(capacities: usize, im: &IntensityMeasure) -> String {
    let measure = im.words();
    format!("{capacities} capacities in {measure}, response level not stated")
}
