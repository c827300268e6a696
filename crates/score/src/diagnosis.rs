//! Which mistake explains the answers of a code.
//!
//! Each hypothesis predicts every answer: the certified values (no mistake),
//! the values of a wrong model or of two at once, or the certified values
//! moved along one input's derivatives. What is left of an answer is judged
//! against a scatter `s K^n`, K the condition of the quantity, by the
//! heavy-tailed law of Cauchy, with the `s` and the `n` (0, 1/2 or 1) that
//! suit the hypothesis best.

use serde::Serialize;

use crate::answers::Answers;
use crate::reference::{INPUTS, Item, SceneExcitation, Value, reference};

/// Fewest answers of which anything is said.
const FEWEST: usize = 12;
/// Gain in log-likelihood over no mistake that a mistake must bring.
const GAIN: f64 = 20.0;
/// Loss in log-likelihood within which two hypotheses are not told apart.
const TIE: f64 = 6.0;
/// Share of what deviates that a mistake must explain, or that must agree.
const SHARE: f64 = 0.9;
/// Largest part of a deviation that may be left where it is explained.
const LEFT: f64 = 0.4;
/// Scatters beyond which an answer deviates.
const BEYOND: f64 = 10.0;
/// Largest scatter of answers that are explained.
const COARSEST: f64 = 1e-2;
/// Relative error within which a right code answers, at a condition of 1.
const RIGHT: f64 = 1e-3;
/// Largest product of a factor less one and a condition for which an answer
/// moves along a straight line.
const STRAIGHT: f64 = 0.3;
/// Share of the answers that must agree so well where no mistake is found.
const AGREE: f64 = 0.99;
/// Scatters that are tried: from the digits of the wrong models' values up.
const SCATTERS: std::ops::Range<i32> = -36..0;
/// Powers of the condition with which the scatter may grow.
const POWERS: [f64; 3] = [0.0, 0.5, 1.0];

/// What is wrong with a code.
#[derive(Clone, Debug, Serialize)]
pub struct Diagnosis {
    /// The verdict.
    pub verdict: CodeVerdict,
    /// What explains the answers; several where the answers given cannot
    /// tell them apart.
    pub explanations: Vec<Explanation>,
    /// Relative scatter of the answers about the explanation, or about the
    /// certified values, at a condition of 1.
    pub scatter: Option<f64>,
}

/// The verdict on a code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum CodeVerdict {
    /// The answers are right within their scatter.
    None,
    /// One of the known mistakes explains the answers.
    Known,
    /// No known mistake explains the answers.
    Unknown,
    /// Too few answers for a verdict.
    TooFew,
}

/// One explanation of the answers.
#[derive(Clone, Debug, Serialize)]
pub struct Explanation {
    /// One mistake, or two that are made together.
    pub mistakes: Vec<Mistake>,
    /// Factor on the input at fault, where the mistake is one of an input
    /// and its size was found.
    pub factor: Option<f64>,
    /// Answers that deviate from the certified values, or should.
    pub deviating: usize,
    /// Those among them that the explanation accounts for.
    pub explained: usize,
}

/// A mistake.
#[derive(Clone, Debug, PartialEq, Eq, Serialize)]
pub struct Mistake {
    /// Its name.
    pub name: String,
    /// What it is.
    pub what: &'static str,
    /// What to look at.
    pub look_at: &'static str,
}

fn mistake(name: &str) -> Mistake {
    let about = reference().mistakes.get(name);
    let [what, look_at] = about.map_or(["", ""], |[a, b]| [a, b]);
    Mistake { name: name.to_owned(), what, look_at }
}

/// An answer, and how far it may scatter.
#[derive(Clone)]
struct Residual {
    item: &'static Item,
    value: Value,
    condition: f64,
    /// Error of the answer over the certified value.
    error: f64,
}

/// Relative distance of two values, 1 at most; 1 where one has no value.
///
/// Two counts beyond the certified one are alike: where a block rests too
/// soon, its impacts are infinitely many, and a code stops somewhere.
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

/// What a hypothesis leaves of each answer, and what it moved.
struct Hypothesis {
    /// Distance of each answer from what is predicted.
    left: Vec<f64>,
    /// Distance of each prediction from the certified value.
    moved: Vec<f64>,
    scatter: Scatter,
    likelihood: f64,
}

/// Scatter of answers: at a condition of 1, and the power of the condition
/// with which it grows.
#[derive(Clone, Copy)]
struct Scatter(f64, f64);

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

    /// That there is no mistake.
    fn none(given: &[Residual]) -> Self {
        let errors = given.iter().map(|g| g.error).collect();
        Self::new(given, errors, vec![0.0; given.len()])
    }

    /// Answers that deviate or should, and those that it explains.
    fn account(&self, given: &[Residual]) -> (usize, usize) {
        let sizes = given.iter().zip(&self.left).zip(&self.moved);
        let deviating = sizes.filter_map(|((given, left), moved)| {
            let size = given.error.max(*moved);
            let limit = BEYOND * given.allowed(self.scatter);
            (size > limit).then_some(*left <= LEFT * size)
        });
        let all: Vec<bool> = deviating.collect();
        (all.len(), all.iter().filter(|good| **good).count())
    }

    fn explains(&self, given: &[Residual]) -> bool {
        let (all, good) = self.account(given);
        let enough = good as f64 >= SHARE * all as f64;
        good >= 3 && enough && self.scatter.0 <= COARSEST
    }
}

impl Residual {
    /// How the value moves with an input; a release is no ground motion, of
    /// whose size one may be wrong.
    fn rate(&self, input: usize) -> f64 {
        let scene = reference().scene(self.item);
        let still = matches!(scene.excitation, SceneExcitation::Free);
        let size = INPUTS[input] == "size";
        if size && still { 0.0 } else { self.item.rates[input] }
    }

    fn allowed(&self, Scatter(scatter, power): Scatter) -> f64 {
        scatter * libm::pow(self.condition, power)
    }
}

/// The answers given, with their conditions; that of a fate or a count is the
/// largest of its scene.
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

/// Says which mistake explains the answers, if any; mistakes `withheld` are
/// not known.
#[must_use]
pub fn diagnose(answers: &Answers, withheld: &[&str]) -> Diagnosis {
    let given = given(answers);
    let numbers = given.iter().filter(|g| g.value.number().is_some());
    if numbers.count() < FEWEST {
        let (verdict, explanations) = (CodeVerdict::TooFew, Vec::new());
        return Diagnosis { verdict, explanations, scatter: None };
    }
    let none = Hypothesis::none(&given);
    let known = models(&given, withheld, none.likelihood + GAIN);
    let known = if known.is_empty() { inputs(&given) } else { known };
    if let Some((_, _, first)) = known.first() {
        let explanations = known.iter().map(|(names, factor, one)| {
            let (deviating, explained) = one.account(&given);
            let mistakes = names.iter().map(|name| mistake(name)).collect();
            Explanation { mistakes, factor: *factor, deviating, explained }
        });
        return Diagnosis {
            verdict: CodeVerdict::Known,
            explanations: explanations.collect(),
            scatter: Some(first.scatter.0),
        };
    }
    let right = given
        .iter()
        .filter(|g| g.error <= g.allowed(Scatter(RIGHT, 0.5)))
        .count();
    let agrees = right as f64 >= AGREE * given.len() as f64;
    let verdict =
        if agrees { CodeVerdict::None } else { CodeVerdict::Unknown };
    let scatter = Some(none.scatter.0);
    Diagnosis { verdict, explanations: Vec::new(), scatter }
}

/// A hypothesis with its names and its factor.
type Named = (Vec<String>, Option<f64>, Hypothesis);

/// The best of all: those that explain, and as few mistakes as explain.
fn best(mut all: Vec<Named>, given: &[Residual], least: f64) -> Vec<Named> {
    let best = all.iter().map(|(_, _, h)| h.likelihood);
    let best = best.fold(f64::NEG_INFINITY, f64::max);
    // Rivals must be clearly worse, whether or not they explain all.
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
        let of = |g: &Residual| g.item.wrong[model].clone();
        let left = given.iter().map(|g| {
            let predicted = of(g);
            apart(g.item, &g.value, predicted.as_ref())
        });
        let moved =
            given.iter().map(|g| apart(g.item, &g.item.value, of(g).as_ref()));
        let one = Hypothesis::new(given, left.collect(), moved.collect());
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
        // Where a straight line holds, which must be most of the answers.
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

/// The factor on an input that the answers say, less one: the weighted median.
fn factor_less_one(given: &[Residual], input: usize) -> Option<f64> {
    let says = given.iter().filter_map(|g| {
        let (x, c) = g.value.number().zip(g.item.value.number())?;
        let rate = g.rate(input);
        let says = (x - c) / c / rate;
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

/// The answers explained by a factor on one input, if they are.
fn input_off(given: &[Residual], input: usize, by: f64) -> Vec<Named> {
    let moved: Vec<f64> = given
        .iter()
        .map(|g| g.value.number().map_or(0.0, |_| g.rate(input) * by))
        .collect();
    let left = given.iter().zip(&moved).map(|(g, moved)| {
        let numbers = g.value.number().zip(g.item.value.number());
        numbers.map_or(g.error, |(x, c)| {
            // What is left of a straight line is of the second order.
            let bent = by * g.condition;
            let curved = bent * bent;
            (((x - c) / c - moved).abs() - curved).clamp(0.0, 1.0)
        })
    });
    let left = left.collect();
    let moved = moved.into_iter().map(|m| m.abs().min(1.0)).collect();
    let one = Hypothesis::new(given, left, moved);
    let names = vec![INPUTS[input].to_owned()];
    let least = Hypothesis::none(given).likelihood + GAIN;
    best(vec![(names, Some(1.0 + by), one)], given, least)
}
