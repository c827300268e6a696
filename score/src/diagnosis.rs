//! Which mistake explains the answers of a code.
//!
//! Each hypothesis predicts every answer: the certified values (no mistake),
//! the values of a wrong model or of two at once, or the certified values
//! moved along one input's derivatives. What is left of an answer is judged
//! against a scatter `s sqrt(K)`, K the condition of the quantity, by the
//! heavy-tailed law of Cauchy, with the `s` that suits the hypothesis best.

use serde::Serialize;

use crate::answers::Answers;
use crate::reference::{INPUTS, Item, Value, reference};

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
/// Scatters that are tried: from the digits of the wrong models' values up.
const SCATTERS: std::ops::Range<i32> = -36..0;

/// What is wrong with a code.
#[derive(Clone, Debug, Serialize)]
pub struct Diagnosis {
    /// The verdict.
    pub verdict: Verdict,
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
pub enum Verdict {
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
struct Given {
    item: &'static Item,
    value: Value,
    condition: f64,
    /// Error of the answer over the certified value.
    error: f64,
}

/// Relative distance of two values, 1 at most; 1 where one has no value.
fn apart(item: &Item, a: &Value, b: Option<&Value>) -> f64 {
    match (a.number(), b.and_then(Value::number), item.value.number()) {
        (Some(a), Some(b), Some(unit)) => ((a - b) / unit).abs().min(1.0),
        _ => f64::from(u8::from(Some(a) != b)),
    }
}

/// What a hypothesis leaves of each answer, and what it moved.
struct Hypothesis {
    /// Distance of each answer from what is predicted.
    left: Vec<f64>,
    /// Distance of each prediction from the certified value.
    moved: Vec<f64>,
    scatter: f64,
    likelihood: f64,
}

impl Hypothesis {
    fn new(given: &[Given], left: Vec<f64>, moved: Vec<f64>) -> Self {
        let fit = |scatter: f64| {
            let terms = given.iter().zip(&left).map(|(given, left)| {
                let x = left / given.allowed(scatter);
                let own = given.value.number().map_or(0.0, |_| scatter.ln());
                -own - (x * x).ln_1p()
            });
            (scatter, terms.sum::<f64>())
        };
        let fits = SCATTERS.map(|k| fit(10_f64.powf(0.25 * f64::from(k))));
        let best = fits.max_by(|a, b| a.1.total_cmp(&b.1));
        let (scatter, likelihood) = best.unwrap_or((1.0, f64::NEG_INFINITY));
        Self { left, moved, scatter, likelihood }
    }

    /// Answers that deviate or should, and those that it explains.
    fn account(&self, given: &[Given]) -> (usize, usize) {
        let sizes = given.iter().zip(&self.left).zip(&self.moved);
        let deviating = sizes.filter_map(|((given, left), moved)| {
            let size = given.error.max(*moved);
            let limit = BEYOND * given.allowed(self.scatter);
            (size > limit).then_some(*left <= LEFT * size)
        });
        let all: Vec<bool> = deviating.collect();
        (all.len(), all.iter().filter(|good| **good).count())
    }

    fn explains(&self, given: &[Given]) -> bool {
        let (all, good) = self.account(given);
        let enough = good as f64 >= SHARE * all as f64;
        good >= 3 && enough && self.scatter <= COARSEST
    }
}

impl Given {
    fn allowed(&self, scatter: f64) -> f64 {
        scatter * self.condition.sqrt()
    }
}

/// The answers given, with their conditions; that of a fate or a count is the
/// largest of its scene.
fn given(answers: &Answers) -> Vec<Given> {
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
        Some(Given { item, value, condition, error })
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
        let (verdict, explanations) = (Verdict::TooFew, Vec::new());
        return Diagnosis { verdict, explanations, scatter: None };
    }
    let still = vec![0.0; given.len()];
    let errors = given.iter().map(|g| g.error).collect();
    let none = Hypothesis::new(&given, errors, still);
    let known = models(&given, withheld, none.likelihood + GAIN);
    let (explanations, scatter) = if known.is_empty() {
        inputs(&given, none.likelihood + GAIN)
    } else {
        known
    }
    .into_parts(&given);
    if !explanations.is_empty() {
        let verdict = Verdict::Known;
        return Diagnosis { verdict, explanations, scatter };
    }
    let right = given.iter().filter(|g| g.error <= g.allowed(RIGHT)).count();
    let agrees = right as f64 >= 0.95 * given.len() as f64;
    let verdict = if agrees { Verdict::None } else { Verdict::Unknown };
    Diagnosis { verdict, explanations, scatter: Some(none.scatter) }
}

/// Hypotheses that explain the answers, each with its names and its factor.
struct Found(Vec<(Vec<String>, Option<f64>, Hypothesis)>);

impl Found {
    fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    fn into_parts(self, given: &[Given]) -> (Vec<Explanation>, Option<f64>) {
        let scatter = self.0.first().map(|(_, _, first)| first.scatter);
        let explanations = self.0.into_iter().map(|(names, factor, one)| {
            let (deviating, explained) = one.account(given);
            let mistakes = names.iter().map(|name| mistake(name)).collect();
            Explanation { mistakes, factor, deviating, explained }
        });
        (explanations.collect(), scatter)
    }

    /// The best ones: those that explain, and as few mistakes as explain.
    fn of(
        mut all: Vec<(Vec<String>, Option<f64>, Hypothesis)>,
        given: &[Given],
        least: f64,
    ) -> Self {
        let best = all.iter().map(|(_, _, h)| h.likelihood);
        let best = best.fold(f64::NEG_INFINITY, f64::max);
        // Rivals must be clearly worse, whether or not they explain all.
        all.retain(|(_, _, h)| {
            h.likelihood > (best - TIE).max(least) && h.explains(given)
        });
        let fewest = all.iter().map(|(names, ..)| names.len()).min();
        all.retain(|(names, ..)| Some(names.len()) == fewest);
        Self(all)
    }
}

/// The wrong models that explain the answers.
fn models(given: &[Given], withheld: &[&str], least: f64) -> Found {
    let names = reference().models.iter().enumerate();
    let names = names.filter(|(_, name)| {
        !name.split('+').any(|name| withheld.contains(&name))
    });
    let all = names.map(|(model, name)| {
        let of = |g: &Given| g.item.wrong[model].clone();
        let left = given.iter().map(|g| {
            let predicted = of(g);
            apart(g.item, &g.value, predicted.as_ref())
        });
        let moved =
            given.iter().map(|g| apart(g.item, &g.item.value, of(g).as_ref()));
        let one = Hypothesis::new(given, left.collect(), moved.collect());
        (name.split('+').map(str::to_owned).collect(), None, one)
    });
    Found::of(all.collect(), given, least)
}

/// The inputs of which one factor explains the answers.
fn inputs(given: &[Given], least: f64) -> Found {
    let all = (0..INPUTS.len()).filter_map(|input| {
        let rate = |g: &Given| g.item.rates[input];
        // The weighted median of what each answer says of the factor.
        let mut says: Vec<(f64, f64)> = given
            .iter()
            .filter_map(|g| {
                let (x, c) = g.value.number().zip(g.item.value.number())?;
                let says = (x - c) / c / rate(g);
                let weight = rate(g).abs() / g.condition.sqrt();
                says.is_finite().then_some((says, weight))
            })
            .collect();
        says.sort_by(|a, b| a.0.total_cmp(&b.0));
        let half = 0.5 * says.iter().map(|s| s.1).sum::<f64>();
        let mut sum = 0.0;
        let middle = says.iter().find(|s| {
            sum += s.1;
            sum >= half
        });
        let by = middle?.0;
        let moved: Vec<f64> = given
            .iter()
            .map(|g| g.value.number().map_or(0.0, |_| rate(g) * by))
            .collect();
        let left = given.iter().zip(&moved).map(|(g, moved)| {
            let Some((x, c)) = g.value.number().zip(g.item.value.number())
            else {
                return g.error;
            };
            // What is left of a straight line: of the second order.
            let curved = (by * g.condition).powi(2);
            (((x - c) / c - moved).abs() - curved).clamp(0.0, 1.0)
        });
        let left = left.collect();
        let moved = moved.into_iter().map(|m| m.abs().min(1.0)).collect();
        let one = Hypothesis::new(given, left, moved);
        Some((vec![INPUTS[input].to_owned()], Some(1.0 + by), one))
    });
    Found::of(all.collect(), given, least)
}
