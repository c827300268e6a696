//! Which mistake explains the answers of a code.
//!
//! Each hypothesis predicts every answer: the certified values (no mistake),
//! the values of a wrong model or of two at once, or the certified values
//! moved along the derivatives by one input. The rest of an answer is compared
//! with a scatter `s K^n`, where K is the condition of the quantity, by the
//! heavy-tailed Cauchy distribution, with the `s` and the `n` (0, 1/2 or 1)
//! that suit the hypothesis best.

use rocking_exchange::table::digits;
use serde::Serialize;

use crate::answers::Answers;
use crate::deviations::{deviations, within};
use crate::reference::{INPUTS, Item, SceneExcitation, Value, reference};

/// The fewest numbers for a diagnosis.
const FEWEST: usize = 12;
/// Required gain in log-likelihood of a mistake over no mistake.
const GAIN: f64 = 20.0;
/// Difference in log-likelihood up to which two hypotheses are not
/// distinguished.
pub(crate) const TIE: f64 = 6.0;
/// Share of the deviating answers that a mistake must explain.
pub(crate) const SHARE: f64 = 0.9;
/// Largest part of an explained deviation that may be left.
const LEFT: f64 = 0.4;
/// Multiple of the scatter beyond which an answer deviates.
pub(crate) const BEYOND: f64 = 10.0;
/// Largest scatter of explained answers.
const COARSEST: f64 = 1e-2;
/// Largest relative error of a right code, at a condition of 1.
const RIGHT: f64 = 1e-3;
/// Largest product of a factor less one and a condition for which an answer
/// moves along a straight line.
const STRAIGHT: f64 = 0.3;
/// Share of the answers that must have at most this error if no mistake is
/// found.
pub(crate) const AGREE: f64 = 0.99;
/// Scatters that are tried, from the precision of the wrong models' values up.
const SCATTERS: std::ops::Range<i32> = -36..0;
/// Powers of the condition with which the scatter may grow.
const POWERS: [f64; 3] = [0.0, 0.5, 1.0];

/// The diagnosis of a code.
#[derive(Clone, Debug, Serialize)]
pub struct Diagnosis {
    /// The verdict.
    pub verdict: CodeVerdict,
    /// The explanations; several if the answers cannot distinguish them.
    pub explanations: Vec<Explanation>,
    /// Relative scatter of the answers around the explanation, or around the
    /// certified values, at a condition of 1.
    pub scatter: Option<f64>,
    /// What is coarse or deviates; empty for other verdicts.
    pub remarks: Vec<String>,
}

/// The verdict on a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CodeVerdict {
    /// The answers are right within their scatter.
    None,
    /// One of the known mistakes explains the answers.
    Known,
    /// The answers are right within a scatter that is large.
    Coarse,
    /// No known mistake explains the answers.
    Unknown,
    /// Too few answers for a verdict.
    TooFew,
}

/// One explanation of the answers.
#[derive(Clone, Debug, Serialize)]
pub struct Explanation {
    /// One mistake, or two that occur together.
    pub mistakes: Vec<Mistake>,
    /// Factor on the input at fault, if the mistake is in an input and its
    /// size was found.
    pub factor: Option<f64>,
    /// Number of answers that deviate from the certified values, or should.
    pub deviating: usize,
    /// Number of these answers that the explanation predicts.
    pub explained: usize,
}

/// A mistake.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// Its name.
    pub name: String,
    /// Its description.
    pub what: &'static str,
    /// Advice on where to look.
    pub look_at: &'static str,
}

fn mistake(name: &str) -> Mistake {
    let about = reference().mistakes.get(name);
    let [what, look_at] = about.map_or(["", ""], |[a, b]| [a, b]);
    Mistake { name: name.to_owned(), what, look_at }
}

/// An answer with its error and its condition.
#[derive(Clone)]
pub(crate) struct Residual {
    pub(crate) item: &'static Item,
    value: Value,
    pub(crate) condition: f64,
    /// Error of the answer over the certified value, 1 at most.
    pub(crate) error: f64,
}

/// Relative distance of two values, 1 at most; 1 if the second is missing.
///
/// Two counts above the certified count have no distance: if a block comes to
/// rest too soon, its impacts are infinitely many, and a code stops somewhere.
fn apart(item: &Item, a: &Value, b: Option<&Value>) -> f64 {
    use Value::{Count, Number};
    match (a, b, &item.value) {
        (Number(a), Some(Number(b)), Number(unit)) => {
            ((a - b) / unit).abs().min(1.0)
        }
        (Count(a), Some(Count(b)), Count(due)) if a > due && b > due => 0.0,
        _ => f64::from(u8::from(Some(a) != b)),
    }
}

/// A hypothesis, by its distances from the answers and the certified values.
struct Hypothesis {
    /// Distance of each answer from its prediction.
    left: Vec<f64>,
    /// Distance of each prediction from the certified value.
    moved: Vec<f64>,
    scatter: Scatter,
    likelihood: f64,
}

/// Scatter of answers: at a condition of 1, and the power of the condition
/// with which it grows.
#[derive(Clone, Copy)]
pub(crate) struct Scatter(pub(crate) f64, pub(crate) f64);

impl Hypothesis {
    fn new(given: &[Residual], left: Vec<f64>, moved: Vec<f64>) -> Self {
        let numbers = given.iter().filter(|g| g.value.number().is_some());
        let ln_conditions = numbers.clone().map(|g| libm::log(g.condition));
        let (count, sum) =
            (numbers.count() as f64, ln_conditions.sum::<f64>());
        let fits = POWERS.into_iter().flat_map(|power| {
            let own = |(g, left): (&Residual, &f64)| {
                left / g.allowed(Scatter(1.0, power))
            };
            let own: Vec<f64> = given.iter().zip(&left).map(own).collect();
            SCATTERS.map(move |k| {
                let scatter = libm::exp10(0.25 * f64::from(k));
                // The sum of logarithms as the logarithm of products.
                let tails = own.chunks(8).map(|some| {
                    let square = |x: &f64| (x / scatter) * (x / scatter);
                    libm::log(some.iter().map(|x| 1.0 + square(x)).product())
                });
                let sizes = count * libm::log(scatter) + power * sum;
                (Scatter(scatter, power), -sizes - tails.sum::<f64>())
            })
        });
        let best = fits.max_by(|a, b| a.1.total_cmp(&b.1));
        let worst = (Scatter(1.0, 0.0), f64::NEG_INFINITY);
        let (scatter, likelihood) = best.unwrap_or(worst);
        Self { left, moved, scatter, likelihood }
    }

    /// The hypothesis of no mistake.
    fn none(given: &[Residual]) -> Self {
        let errors = given.iter().map(|g| g.error).collect();
        Self::new(given, errors, vec![0.0; given.len()])
    }

    /// Number of answers that deviate or should, and of those that it
    /// explains.
    fn account(&self, given: &[Residual]) -> (usize, usize) {
        let sizes = given.iter().zip(&self.left).zip(&self.moved);
        let deviating = sizes.filter_map(|((given, left), moved)| {
            let size = given.error.max(*moved);
            let limit = BEYOND * given.allowed(self.scatter);
            (size > limit).then_some(*left <= LEFT * size)
        });
        let all = deviating.clone().count();
        (all, deviating.filter(|good| *good).count())
    }

    fn explains(&self, given: &[Residual]) -> bool {
        let (all, good) = self.account(given);
        let enough = good as f64 >= SHARE * all as f64;
        good >= 3 && enough && self.scatter.0 <= COARSEST
    }
}

impl Residual {
    /// Derivative of the value by an input. A release has no ground motion
    /// whose size could be wrong.
    fn rate(&self, input: usize) -> f64 {
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

    /// True if a right answer may have this relative error.
    pub(crate) fn may_have(&self, error: f64) -> bool {
        error <= self.allowed(Scatter(RIGHT, 0.5))
    }
}

/// The answers with their conditions. An outcome or a count has the largest
/// condition of its scene.
fn given(answers: &Answers) -> Vec<Residual> {
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

/// Finds the mistake that explains the answers, if any; mistakes in `withheld`
/// are not considered.
pub fn diagnose(answers: &Answers, withheld: &[&str]) -> Diagnosis {
    let given = given(answers);
    let numbers = given.iter().filter(|g| g.value.number().is_some());
    let mut found = Diagnosis {
        verdict: CodeVerdict::TooFew,
        explanations: Vec::new(),
        scatter: None,
        remarks: Vec::new(),
    };
    if numbers.count() < FEWEST {
        return found;
    }
    let none = Hypothesis::none(&given);
    let known = models(&given, withheld, none.likelihood + GAIN);
    let known = if known.is_empty() { inputs(&given) } else { known };
    found.scatter = Some(known.first().map_or(&none, |k| &k.2).scatter.0);
    let right = given.iter().filter(|g| g.may_have(g.error)).count();
    let errors = given.iter().map(Residual::full).collect();
    let full = Hypothesis::new(&given, errors, Vec::new());
    if !known.is_empty() {
        found.verdict = CodeVerdict::Known;
        let explanations = known.iter().map(|(names, factor, one)| {
            let (deviating, explained) = one.account(&given);
            let mistakes = names.iter().map(|name| mistake(name)).collect();
            Explanation { mistakes, factor: *factor, deviating, explained }
        });
        found.explanations = explanations.collect();
    } else if right as f64 >= AGREE * given.len() as f64 {
        found.verdict = CodeVerdict::None;
    } else if let Some(within) = within(&given, full.scatter.1) {
        found.verdict = CodeVerdict::Coarse;
        found.remarks.push(format!(
            "99 % of the answers are right within {} % at a condition of 1; \
             no quantity, excitation or equation is an exception.",
            digits(100.0 * within, 2)
        ));
    } else {
        found.verdict = CodeVerdict::Unknown;
        found.remarks = deviations(&given);
    }
    found
}

/// A hypothesis with its names and its factor.
type Named = (Vec<String>, Option<f64>, Hypothesis);

/// The best hypotheses: those that explain the answers with the fewest
/// mistakes.
fn best(mut all: Vec<Named>, given: &[Residual], least: f64) -> Vec<Named> {
    let best = all.iter().map(|(_, _, h)| h.likelihood);
    let best = best.fold(f64::NEG_INFINITY, f64::max);
    // Rivals must be clearly worse, even if they do not explain the answers.
    all.retain(|(_, _, h)| {
        h.likelihood > (best - TIE).max(least) && h.explains(given)
    });
    let fewest = all.iter().map(|(names, ..)| names.len()).min();
    all.retain(|(names, ..)| Some(names.len()) == fewest);
    all
}

/// The wrong models that explain the answers.
fn models(given: &[Residual], withheld: &[&str], least: f64) -> Vec<Named> {
    let names = reference().models.iter().enumerate();
    let names = names.filter(|(_, name)| {
        !name.split('+').any(|name| withheld.contains(&name))
    });
    let all = names.map(|(model, name)| {
        let off = |g: &Residual, value: &Value| {
            apart(g.item, value, g.item.wrong[model].as_ref())
        };
        let left = given.iter().map(|g| off(g, &g.value)).collect();
        let moved = given.iter().map(|g| off(g, &g.item.value)).collect();
        let one = Hypothesis::new(given, left, moved);
        (name.split('+').map(str::to_owned).collect(), None, one)
    });
    best(all.collect(), given, least)
}

/// The inputs of which one factor explains the answers.
fn inputs(all: &[Residual]) -> Vec<Named> {
    let found = (0..INPUTS.len()).flat_map(|input| {
        let Some(by) = factor_less_one(all, input) else {
            return Vec::new();
        };
        // Most answers must move along a straight line.
        let holds = |g: &&Residual| by.abs() * g.condition < STRAIGHT;
        let given: Vec<Residual> = all.iter().filter(holds).cloned().collect();
        if 2 * given.len() < all.len() {
            return Vec::new();
        }
        input_off(&given, input, by)
    });
    let mut found: Vec<_> = found.collect();
    found.sort_by(|a, b| b.2.likelihood.total_cmp(&a.2.likelihood));
    found.truncate(1);
    found
}

/// The factor on an input by the answers, less one: a weighted median.
fn factor_less_one(given: &[Residual], input: usize) -> Option<f64> {
    let says = given.iter().filter_map(|g| {
        let rate = g.rate(input);
        let says = g.relative()? / rate;
        says.is_finite().then_some((says, rate.abs() / g.condition))
    });
    let mut says: Vec<(f64, f64)> = says.collect();
    says.sort_by(|a, b| a.0.total_cmp(&b.0));
    let half = 0.5 * says.iter().map(|s| s.1).sum::<f64>();
    let mut sum = 0.0;
    let middle = says.iter().find(|s| {
        sum += s.1;
        sum >= half
    });
    Some(middle?.0).filter(|by| *by != 0.0)
}

/// The hypothesis of a factor on one input, if it explains the answers.
fn input_off(given: &[Residual], input: usize, by: f64) -> Vec<Named> {
    let moved = given
        .iter()
        .map(|g| g.value.number().map_or(0.0, |_| g.rate(input) * by));
    let left = given.iter().zip(moved.clone()).map(|(g, moved)| {
        g.relative().map_or(g.error, |error| {
            // The deviation from a straight line is of second order.
            let bent = by * g.condition;
            let curved = bent * bent;
            ((error - moved).abs() - curved).clamp(0.0, 1.0)
        })
    });
    let left = left.collect();
    let moved = moved.map(|moved| moved.abs().min(1.0)).collect();
    let one = Hypothesis::new(given, left, moved);
    let names = vec![INPUTS[input].to_owned()];
    let least = Hypothesis::none(given).likelihood + GAIN;
    best(vec![(names, Some(1.0 + by), one)], given, least)
}
