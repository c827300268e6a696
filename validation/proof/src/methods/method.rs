//! The input and the output of a method.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use anyhow::{Context as _, Result};
use rocking::integrator::{HistoryPoint, Observe};
use rocking_statistics::Clusters;
use rocking_synthesis::{Pair, SuiteKind};
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

/// The quantities that a method observed, and the expected values of those
/// that the case does not list.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Reply {
    /// From the code under test.
    pub observed: Quantities,
    /// From outside it.
    pub expected: Quantities,
}

impl Reply {
    /// Adds observed and expected values of a quantity.
    pub fn put(
        &mut self,
        name: &str,
        observed: impl IntoIterator<Item = f64>,
        expected: impl IntoIterator<Item = f64>,
    ) {
        self.see(name, observed);
        self.expected.entry(name.to_owned()).or_default().extend(expected);
    }

    /// Adds observed values of a quantity whose expected values the case
    /// lists.
    pub fn see(
        &mut self,
        name: &str,
        observed: impl IntoIterator<Item = f64>,
    ) {
        self.observed.entry(name.to_owned()).or_default().extend(observed);
    }

    /// Adds as many impacts as are listed: times times `rate`, and under the
    /// name `speeds` the speeds before them over `unit`. A surplus of impacts
    /// shows in the outcome.
    pub fn put_impacts(
        &mut self,
        speeds: &str,
        trace: &Trace,
        [rate, unit]: [f64; 2],
        listed: &[(f64, f64)],
    ) {
        let seen = trace.impacts.iter().take(listed.len());
        let times = seen.clone().map(|impact| impact.time_s * rate);
        self.put("impact-times-p", times, listed.iter().map(|i| i.0));
        let found = seen.map(|impact| impact.speed_before_rad_s / unit);
        self.put(speeds, found, listed.iter().map(|i| i.1));
    }
}

/// The usual name of the speeds before impacts.
pub(super) const SPEEDS: &str = "impact-speeds";

/// Every pair from two lists, in the order of the first list.
pub(super) fn pairs<A: Copy, B: Copy>(a: &[A], b: &[B]) -> Vec<(A, B)> {
    a.iter().flat_map(|a| b.iter().map(|b| (*a, *b))).collect()
}

/// The input of a method.
pub struct Context<'a> {
    /// The case.
    pub case: &'a Case,
    /// The engine: the core or a wrong model.
    pub engine: &'a dyn Engine,
    /// The wrong model; either the engine or the method makes its mistake.
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

    /// True for the mistake of this run.
    pub(super) fn is(&self, wrong: WrongModel) -> bool {
        self.wrong == Some(wrong)
    }

    /// `mistaken` for the mistake of this run, else `right`.
    pub(super) fn or<T>(&self, wrong: WrongModel, mistaken: T, right: T) -> T {
        if self.is(wrong) { mistaken } else { right }
    }

    /// The units of resampling: earthquakes, or records by mistake.
    pub(super) fn drawn(&self, clusters: &Clusters) -> Clusters {
        let records = Clusters::singletons(clusters.records());
        self.or(WrongModel::RecordsAsUnit, records, clusters.clone())
    }

    /// The scene with the mistake of a wrong model that alters the input; for
    /// methods that run the core themselves.
    pub fn altered(&self, scene: &CaseScene) -> CaseScene {
        self.wrong.map_or_else(|| scene.clone(), |own| own.altered(scene))
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
        // Nothing equals the state of a run that ended earlier.
        let [rotation_rad, velocity_rad_s] = [f64::NAN; 2];
        let missing = HistoryPoint { time_s, rotation_rad, velocity_rad_s };
        Ok(response.history.get(1).copied().unwrap_or(missing))
    }
}

pub(super) fn input_of<T: DeserializeOwned>(case: &Case) -> Result<T> {
    let table = toml::Value::Table(case.input.clone());
    table.try_into().context("input")
}

/// Lists by key: a wrong model that only reads them differently needs no run.
pub(super) struct Memo<K, T>(Mutex<BTreeMap<K, Arc<Vec<T>>>>);

impl<K: Ord, T> Memo<K, T> {
    /// With nothing in it.
    pub const fn new() -> Self {
        Self(Mutex::new(BTreeMap::new()))
    }

    /// The list of a key, from memory if it was made before. Nothing is locked
    /// while it is made: a thread that waits inside may take up another case.
    pub fn get(
        &self,
        key: K,
        make: impl FnOnce(&K) -> Result<Vec<T>>,
    ) -> Result<Arc<Vec<T>>> {
        let lock = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(found) = lock().get(&key) {
            return Ok(Arc::clone(found));
        }
        let found = Arc::new(make(&key)?);
        lock().insert(key, Arc::clone(&found));
        Ok(found)
    }
}

static SUITES: Memo<SuiteKind, Pair> = Memo::new();

/// The pairs of an embedded suite.
pub(super) fn suite(kind: SuiteKind) -> Result<Arc<Vec<Pair>>> {
    SUITES.get(kind, |kind| {
        Ok(match kind {
            SuiteKind::Ordinary => rocking_synthesis::ordinary(),
            SuiteKind::PulseType => rocking_synthesis::pulse(),
        }?)
    })
}
