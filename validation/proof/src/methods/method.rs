//! What a method works with, and what it answers.

use std::collections::BTreeMap;

use rocking::integrator::{HistoryPoint, Observe};
use serde::de::DeserializeOwned;

use crate::cases::Case;
use crate::engine;
use crate::scene::{Engine, Scene};

pub(super) use crate::cases::WrongModel;
pub(super) use crate::error::MethodError;

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

/// Numbers by name.
pub type Quantities = BTreeMap<String, Vec<f64>>;

/// What a method observed, and what it expected where the case names a
/// reference or an oracle instead of writing the values.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Answer {
    /// From the code under test.
    pub observed: Quantities,
    /// From outside it.
    pub expected: Quantities,
}

impl Answer {
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
    /// [`MethodError::Input`] for missing, unknown or malformed keys.
    pub fn input<T: DeserializeOwned>(&self) -> Result<T, MethodError> {
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

    /// The scene as the wrong model sees it, where that changes the input;
    /// for methods that run the core themselves.
    #[must_use]
    pub fn altered(&self, scene: &Scene) -> Scene {
        let mut scene = scene.clone();
        if let Some(wrong) = self.wrong {
            wrong.alter(&mut scene);
        }
        scene
    }

    /// The state of a scene at an instant, by a history of that interval.
    pub(super) fn state(
        &self,
        scene: &Scene,
        time_s: f64,
    ) -> Result<HistoryPoint, MethodError> {
        let observe = Observe {
            history_interval_s: Some(time_s),
            until_s: Some(1.5 * time_s),
            ..Observe::default()
        };
        let response = engine::respond(&self.altered(scene), &observe)?;
        // A run that has ended before says so by what cannot be compared.
        let missing = HistoryPoint {
            time_s,
            rotation_rad: f64::NAN,
            velocity_rad_s: f64::NAN,
        };
        Ok(response.history.get(1).copied().unwrap_or(missing))
    }
}

pub(super) fn input_of<T: DeserializeOwned>(
    case: &Case,
) -> Result<T, MethodError> {
    let table = toml::Value::Table(case.input.clone());
    table.try_into().map_err(|e| MethodError::Input(e.to_string()))
}
