//! What a method works with, and what it answers.

use std::collections::BTreeMap;

use anyhow::{Context as _, Result};
use rocking::integrator::{HistoryPoint, Observe};
use rocking_statistics::Clusters;
use serde::de::DeserializeOwned;

use crate::cases::Case;
use crate::engine;
use crate::scene::{CaseScene, Engine, Trace};

pub(super) use crate::cases::WrongModel;

/// Reads the fields of a case's input into variables of the same names.
macro_rules! input {
    ($context:expr; $($(#[$note:meta])* $field:ident: $type:ty),+ $(,)?) => {
        #[derive(serde::Deserialize)]
        #[serde(deny_unknown_fields)]
        struct Input {
            $($(#[$note])* $field: $type),+
        }
        let Input { $($field),+ } = $context.input()?;
    };
}

/// A method under its name in the files of cases.
pub type Method = (&'static str, fn(&Context, &mut Reply) -> Result<()>);

/// Numbers by name.
pub type Quantities = BTreeMap<String, Vec<f64>>;

/// What a method observed, and what it expected where the case names a
/// reference or an oracle instead of writing the values.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Reply {
    /// From the code under test.
    pub observed: Quantities,
    /// From outside it.
    pub expected: Quantities,
}

impl Reply {
    /// Adds to the lists of a quantity: what was observed, and what is
    /// expected of it.
    pub fn put(
        &mut self,
        name: &str,
        observed: impl IntoIterator<Item = f64>,
        expected: impl IntoIterator<Item = f64>,
    ) {
        self.see(name, observed);
        self.expected.entry(name.to_owned()).or_default().extend(expected);
    }

    /// Adds to what was observed of a quantity whose values the case writes.
    pub fn see(
        &mut self,
        name: &str,
        observed: impl IntoIterator<Item = f64>,
    ) {
        self.observed.entry(name.to_owned()).or_default().extend(observed);
    }

    /// Adds impacts, as many as are listed: times times `rate`, and under
    /// the name `speeds` the speeds before them over `unit`. A block that
    /// goes on where it should not shows in its fate.
    pub fn put_impacts(
        &mut self,
        speeds: &str,
        trace: &Trace,
        [rate, unit]: [f64; 2],
        listed: &[(f64, f64)],
    ) {
        let seen = trace.impacts.iter().take(listed.len());
        let (due, due_speeds): (Vec<f64>, Vec<f64>) =
            listed.iter().copied().unzip();
        let times = seen.clone().map(|impact| impact.time_s * rate);
        self.put("impact-times-p", times, due);
        let found = seen.map(|impact| impact.speed_before_rad_s / unit);
        self.put(speeds, found, due_speeds);
    }
}

/// The usual name of the speeds before impacts.
pub(super) const SPEEDS: &str = "impact-speeds";

/// Every pair from two lists, the first of them slowest.
pub(super) fn pairs<A: Copy, B: Copy>(a: &[A], b: &[B]) -> Vec<(A, B)> {
    a.iter().flat_map(|a| b.iter().map(|b| (*a, *b))).collect()
}

/// What a method works with.
pub struct Context<'a> {
    /// The case.
    pub case: &'a Case,
    /// What answers scenes: the core, or a wrong model.
    pub engine: &'a dyn Engine,
    /// The wrong model; the engine makes the mistake, or the method.
    pub wrong: Option<WrongModel>,
}

impl Context<'_> {
    /// The case's input.
    ///
    /// # Errors
    /// An error for missing, unknown or malformed keys.
    pub fn input<T: DeserializeOwned>(&self) -> Result<T> {
        input_of(self.case)
    }

    /// Whether this is the mistake that is made.
    pub(super) fn is(&self, wrong: WrongModel) -> bool {
        self.wrong == Some(wrong)
    }

    /// `mistaken` where this is the mistake that is made, else `right`.
    pub(super) fn or<T>(&self, wrong: WrongModel, mistaken: T, right: T) -> T {
        if self.is(wrong) { mistaken } else { right }
    }

    /// What is drawn anew: earthquakes, or records where these are mistaken
    /// for the unit.
    pub(super) fn drawn(&self, clusters: &Clusters) -> Clusters {
        match self.is(WrongModel::RecordsAsUnit) {
            true => Clusters::singletons(clusters.records()),
            false => clusters.clone(),
        }
    }

    /// The scene as the wrong model sees it, where that changes the input;
    /// for methods that run the core themselves.
    pub fn altered(&self, scene: &CaseScene) -> CaseScene {
        let own = |wrong: WrongModel| wrong.altered(scene);
        self.wrong.map_or_else(|| scene.clone(), own)
    }

    /// The state of a scene at an instant, by a history of that interval.
    pub(super) fn state(
        &self,
        scene: &CaseScene,
        time_s: f64,
    ) -> Result<HistoryPoint> {
        let observe = Observe {
            history_interval_s: Some(time_s),
            until_s: Some(1.5 * time_s),
            ..Observe::default()
        };
        let response = engine::respond(&self.altered(scene), &observe)?;
        // A run that has ended before says so by what cannot be compared.
        let (rotation_rad, velocity_rad_s) = (f64::NAN, f64::NAN);
        let missing = HistoryPoint { time_s, rotation_rad, velocity_rad_s };
        Ok(response.history.get(1).copied().unwrap_or(missing))
    }
}

pub(super) fn input_of<T: DeserializeOwned>(case: &Case) -> Result<T> {
    let table = toml::Value::Table(case.input.clone());
    table.try_into().context("input")
}
