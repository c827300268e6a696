//! Errors of answers, with the condition of each.

use crate::answers::Answers;
use crate::reference::{INPUTS, Item, SceneExcitation, Value, reference};

/// Difference in log-likelihood up to which two hypotheses are not
/// distinguished.
pub(crate) const TIE: f64 = 6.0;
/// Share of the deviating answers that a mistake must explain.
pub(crate) const SHARE: f64 = 0.9;
/// Largest part of an explained deviation that may be left.
pub(crate) const LEFT: f64 = 0.4;
/// Multiple of the scatter beyond which an answer deviates.
pub(crate) const BEYOND: f64 = 10.0;
/// Largest scatter of explained answers.
pub(crate) const COARSEST: f64 = 1e-2;
/// Largest relative error of a right code, at a condition of 1.
pub(crate) const RIGHT: f64 = 1e-3;
/// Share of the answers that must have at most this error if no mistake is
/// found.
pub(crate) const AGREE: f64 = 0.99;
/// An answer with its error and its condition.
#[derive(Clone)]
pub(crate) struct Residual {
    pub(crate) item: &'static Item,
    pub(crate) value: Value,
    pub(crate) condition: f64,
    /// Error of the answer over the certified value, 1 at most.
    pub(crate) error: f64,
}

/// Relative distance of two values, 1 at most; 1 if the second is missing.
///
/// Two counts above the certified count have no distance: if a block comes to
/// rest too soon, its impacts are infinitely many, and a code stops somewhere.
pub(crate) fn apart(item: &Item, a: &Value, b: Option<&Value>) -> f64 {
    use Value::{Count, Number};
    match (a, b, &item.value) {
        (Number(a), Some(Number(b)), Number(unit)) => {
            ((a - b) / unit).abs().min(1.0)
        }
        (Count(a), Some(Count(b)), Count(due)) if a > due && b > due => 0.0,
        _ => f64::from(u8::from(Some(a) != b)),
    }
}

/// Scatter of answers: at a condition of 1, and the power of the condition
/// with which it grows.
#[derive(Clone, Copy)]
pub(crate) struct Scatter(pub(crate) f64, pub(crate) f64);

impl Residual {
    /// Derivative of the value by an input. A release has no ground motion
    /// whose size could be wrong.
    pub(crate) fn rate(&self, input: usize) -> f64 {
        let scene = reference().scene(self.item);
        let still = matches!(scene.excitation, SceneExcitation::Free);
        let size = INPUTS[input] == "size";
        if size && still { 0.0 } else { self.item.rates[input] }
    }

    pub(crate) fn allowed(&self, Scatter(scatter, power): Scatter) -> f64 {
        scatter * libm::pow(self.condition, power)
    }

    /// Error over the certified value with its sign, if it is a number.
    pub(crate) fn relative(&self) -> Option<f64> {
        let numbers = self.value.number().zip(self.item.value.number());
        numbers.map(|(x, c)| (x - c) / c)
    }

    /// Error over the certified value, without a limit if it is a number.
    pub(crate) fn full(&self) -> f64 {
        self.relative().map_or(self.error, f64::abs)
    }

    /// Largest relative error of a right answer.
    pub(crate) fn right(&self) -> f64 {
        self.allowed(Scatter(RIGHT, 0.5))
    }

    /// True if the error is larger.
    pub(crate) fn deviates(&self) -> bool {
        !(self.error <= self.right())
    }
}

/// The answers with their conditions. An outcome or a count has the largest
/// condition of its scene.
pub(crate) fn given(answers: &Answers) -> Vec<Residual> {
    let set = reference();
    let mut worst = vec![1.0_f64; set.scenes.len()];
    for item in &set.items {
        worst[item.scene] = worst[item.scene].max(item.condition);
    }
    let items = set.items.iter().enumerate();
    let found = items.filter_map(|(place, item)| {
        let value = answers.get(place)?.clone();
        let own = item.condition.max(1.0);
        let whole = value.number().is_none();
        let condition = if whole { worst[item.scene] } else { own };
        let error = apart(item, &value, Some(&item.value));
        Some(Residual { item, value, condition, error })
    });
    found.collect()
}
