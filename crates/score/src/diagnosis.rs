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
use crate::deviations::{Deviations, within};
use crate::reference::{INPUTS, Value, reference};
use crate::residual::{
    AGREE, BEYOND, COARSEST, LEFT, Residual, SHARE, Scatter, TIE, apart, given,
};

/// The fewest numbers for a diagnosis.
const FEWEST: usize = 12;
/// Required gain in log-likelihood of a mistake over no mistake.
const GAIN: f64 = 20.0;
/// Largest product of a factor less one and a condition for which an answer
/// moves along a straight line.
const STRAIGHT: f64 = 0.3;
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
    /// Power of the condition with which the scatter grows.
    pub growth: Option<f64>,
    /// Largest relative error of 99 % of the answers of a coarse code, at a
    /// condition of 1.
    pub within: Option<f64>,
    /// What deviates if the verdict is [`CodeVerdict::Unknown`].
    pub deviations: Option<Deviations>,
}

impl Diagnosis {
    fn new(verdict: CodeVerdict, scatter: Option<Scatter>) -> Self {
        Self {
            verdict,
            explanations: Vec::new(),
            scatter: scatter.map(|scatter| scatter.0),
            growth: scatter.map(|scatter| scatter.1),
            within: None,
            deviations: None,
        }
    }

    /// What is coarse or deviates; no sentence for other verdicts.
    pub fn sentences(&self) -> Vec<String> {
        let coarse = self.within.map(|within| {
            let growth = match self.growth {
                Some(0.5) => " times the square root of the condition",
                Some(1.0) => " times the condition",
                _ => "",
            };
            let percent = digits(100.0 * within, 2);
            format!(
                "99 % of the answers are right within {percent} %{growth}; no \
                 quantity, excitation, equation or scene is an exception."
            )
        });
        let off = self.deviations.iter().flat_map(Deviations::sentences);
        coarse.into_iter().chain(off).collect()
    }
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

/// A hypothesis, by its distances from the answers and the certified values.
struct Hypothesis {
    /// Distance of each answer from its prediction.
    left: Vec<f64>,
    /// Distance of each prediction from the certified value.
    moved: Vec<f64>,
    scatter: Scatter,
    likelihood: f64,
}

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

/// Finds the mistake that explains the answers, if any; mistakes in `withheld`
/// are not considered.
pub fn diagnose(answers: &Answers, withheld: &[&str]) -> Diagnosis {
    let given = given(answers);
    let numbers = given.iter().filter(|g| g.value.number().is_some());
    if numbers.count() < FEWEST {
        return Diagnosis::new(CodeVerdict::TooFew, None);
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
        let known = Diagnosis::new(CodeVerdict::Known, Some(first.scatter));
        return Diagnosis { explanations: explanations.collect(), ..known };
    }
    let right = given.iter().filter(|g| !g.deviates()).count();
    if right as f64 >= AGREE * given.len() as f64 {
        return Diagnosis::new(CodeVerdict::None, Some(none.scatter));
    }
    let errors = given.iter().map(Residual::full).collect();
    let coarse = Hypothesis::new(&given, errors, Vec::new()).scatter;
    if let Some(within) = within(&given, coarse.1) {
        let coarse = Diagnosis::new(CodeVerdict::Coarse, Some(coarse));
        return Diagnosis { within: Some(within), ..coarse };
    }
    let unknown = Diagnosis::new(CodeVerdict::Unknown, Some(none.scatter));
    Diagnosis { deviations: Some(Deviations::new(&given)), ..unknown }
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

/// The hypothesis of a factor on one input, if it explains the answers.
fn input_off(given: &[Residual], input: usize, by: f64) -> Vec<Named> {
    let moved = given
        .iter()
        .map(|g| g.value.number().map_or(0.0, |_| g.rate(input) * by));
    let left = given.iter().zip(moved.clone()).map(|(g, moved)| {
        let numbers = g.value.number().zip(g.item.value.number());
        numbers.map_or(g.error, |(x, c)| {
            // The deviation from a straight line is of second order.
            let bent = by * g.condition;
            let curved = bent * bent;
            (((x - c) / c - moved).abs() - curved).clamp(0.0, 1.0)
        })
    });
    let left = left.collect();
    let moved = moved.map(|moved| moved.abs().min(1.0)).collect();
    let one = Hypothesis::new(given, left, moved);
    let names = vec![INPUTS[input].to_owned()];
    let least = Hypothesis::none(given).likelihood + GAIN;
    best(vec![(names, Some(1.0 + by), one)], given, least)
}
