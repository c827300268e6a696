//! What the deviating answers of a code have in common.

use std::collections::BTreeMap;

use rocking::named;
use rocking_exchange::table::digits;
use serde::Serialize;

use crate::reference::{Item, SceneExcitation, reference};
use crate::residual::{AGREE, BEYOND, LEFT, Residual, SHARE, Scatter, TIE};

/// Largest error of a coarse answer at a condition of 1: half a digit.
const HALF_A_DIGIT: f64 = 0.316;
/// Share of normal errors within a tenth of their median size.
const TENTH: f64 = 0.054;
/// Most groups in words.
const SHOWN: usize = 5;

named! {
    /// Property by which answers are grouped.
    pub enum GroupedBy: "property" {
        /// Kind of quantity: all times are one group.
        Dimension = "dimension",
        /// Quantity: the times of impacts are one group, as are rotations.
        Quantity = "quantity",
        /// Free motion, a pulse or samples.
        Motion = "motion",
        /// Kind of excitation: each kind of pulse is a group.
        Excitation = "excitation",
        /// Equation of motion.
        Equation = "equation",
        /// Scene.
        Scene = "scene",
    }
}

/// Answers by the name of their group.
type Groups<'a> = BTreeMap<String, Vec<&'a Residual>>;

impl GroupedBy {
    fn group(self, item: &Item) -> String {
        let scene = reference().scene(item);
        let quantity = item.quantity.as_str();
        let is_time = quantity.ends_with("_time_s");
        let first = quantity.split('_').next();
        let name = match (self, first, &scene.excitation) {
            (Self::Dimension, ..) if is_time => "times",
            (Self::Dimension | Self::Quantity, Some("theta"), _) => {
                "theta_K_rad"
            }
            (Self::Quantity, Some("impact"), _) if is_time => {
                "impact_K_time_s"
            }
            (Self::Dimension | Self::Quantity, ..) => quantity,
            (Self::Equation, ..) => scene.equation.name(),
            (Self::Scene, ..) => &scene.name,
            (Self::Excitation, _, SceneExcitation::Pulse(kind)) => {
                kind.name().name()
            }
            (_, _, SceneExcitation::Pulse(_)) => "pulse",
            (_, _, SceneExcitation::Free) => "free",
            (_, _, SceneExcitation::Samples { .. }) => "samples",
        };
        name.to_owned()
    }

    fn groups(self, given: &[Residual]) -> Groups<'_> {
        let mut groups = Groups::new();
        for one in given {
            groups.entry(self.group(one.item)).or_default().push(one);
        }
        groups
    }
}

/// Quantile of values, if there are any; the largest at a level of 1.
fn quantile(values: impl Iterator<Item = f64>, level: f64) -> Option<f64> {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let place = (level * sorted.len() as f64) as usize;
    sorted.get(place).or(sorted.last()).copied()
}

/// If an answer has a property; `None` if the property is not known.
type Property<'a> = &'a dyn Fn(&Residual) -> Option<bool>;

/// Gain in log-likelihood if groups have their own shares of answers with a
/// property instead of `share`. An own share costs half the logarithm of the
/// number of answers of the group (Schwarz 1978), and the choice of the group
/// the logarithm of the number of groups; a group has one if this pays.
fn gain(groups: &Groups<'_>, share: f64, has: Property<'_>) -> f64 {
    let choice = libm::log(groups.len() as f64);
    let gains = groups.values().map(|group| {
        let known: Vec<bool> = group.iter().filter_map(|g| has(g)).collect();
        let all = known.len() as f64;
        let part = known.iter().filter(|is| **is).count() as f64;
        let sizes = [(part, share), (all - part, 1.0 - share)].into_iter();
        let sizes = sizes.filter(|(count, _)| *count > 0.0);
        let sizes = sizes.map(|(n, share)| n * libm::log(n / all / share));
        let gain = sizes.sum::<f64>() - 0.5 * libm::log(all.max(1.0));
        (gain - choice).max(0.0)
    });
    gains.sum()
}

/// The largest error of 99 % of the answers at a condition of 1, if they are
/// coarse: in no group are errors of one sign, or far smaller or larger than
/// in others. A mistake leaves answers right that it does not concern, and
/// moves the others in one direction. Less than half of the answers do not show
/// this.
pub(crate) fn within(given: &[Residual], growth: f64) -> Option<f64> {
    let own = |one: &Residual| one.full() / one.allowed(Scatter(1.0, growth));
    let within = quantile(given.iter().map(own), AGREE)?;
    let numbers = given.iter().filter(|one| one.relative().is_some());
    let median = quantile(numbers.map(own), 0.5)?;
    let tests: [(f64, Property<'_>); 3] = [
        (TENTH, &|one| one.relative().map(|_| own(one) <= median / BEYOND)),
        (1.0 - AGREE, &|one| Some(own(one) >= median * BEYOND)),
        (0.5, &|one| Some(one.relative()? > 0.0)),
    ];
    let is_alike = |by: &GroupedBy| {
        let groups = by.groups(given);
        let mut tests = tests.iter();
        tests.all(|(share, has)| gain(&groups, *share, has) <= TIE)
    };
    let is_coarse = within <= HALF_A_DIGIT
        && 2 * given.len() >= reference().items.len()
        && GroupedBy::ALL.iter().all(is_alike);
    is_coarse.then_some(within)
}

named! {
    /// What a constant is multiplied by in a [`CommonFactor`].
    pub enum FactorKind: "factor" {
        /// 1.
        Constant = "constant",
        /// The slenderness of the scene, rad.
        Alpha = "alpha",
        /// The inverse of the slenderness.
        PerAlpha = "1/alpha",
        /// The frequency parameter of the scene, rad/s.
        P = "p",
        /// The inverse of the frequency parameter.
        PerP = "1/p",
        /// The inverse of the slenderness and of the frequency parameter.
        PerAlphaP = "1/(alpha p)",
        /// The sign of the certified value: the product is a magnitude.
        Sign = "sign",
    }
}

/// The factor between the answers of a group and the certified values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct CommonFactor {
    /// The constant.
    pub constant: f64,
    /// What it is multiplied by.
    pub kind: FactorKind,
}

impl FactorKind {
    /// The answer in multiples of the certified value and this kind.
    fn ratio(self, one: &Residual) -> Option<f64> {
        let scene = reference().scene(one.item);
        let (alpha, p) = (scene.alpha_rad, scene.p_rad_s);
        let unit = match self {
            Self::Constant => 1.0,
            Self::Alpha => alpha,
            Self::PerAlpha => 1.0 / alpha,
            Self::P => p,
            Self::PerP => 1.0 / p,
            Self::PerAlphaP => 1.0 / (alpha * p),
            Self::Sign => one.item.value.number()?.signum(),
        };
        Some((1.0 + one.relative()?) / unit)
    }
}

impl CommonFactor {
    /// The factor that moves the answers of a group, with one exception in ten
    /// deviations.
    fn find(group: &[&Residual]) -> Option<Self> {
        let off = group.iter().filter(|one| one.deviates()).count();
        let mut factors = FactorKind::ALL.into_iter().filter_map(|kind| {
            let ratios = group.iter().filter_map(|one| kind.ratio(one));
            Some(Self { constant: quantile(ratios, 0.5)?, kind })
        });
        factors.find(|factor| {
            let bad = group.iter().filter(|one| !factor.explains(one)).count();
            off >= 3 && bad as f64 <= (1.0 - SHARE) * off as f64
        })
    }

    fn explains(self, one: &Residual) -> bool {
        let ratio = self.kind.ratio(one).zip(one.relative());
        ratio.is_some_and(|(ratio, error)| {
            let left = (ratio / self.constant - 1.0).abs();
            left <= one.right()
                && (!one.deviates() || left <= LEFT * error.abs())
        })
    }
}

/// A group of answers of which some deviate.
#[derive(Clone, Debug, Serialize)]
pub struct GroupDeviation {
    /// The property by which answers are grouped.
    pub by: GroupedBy,
    /// Its value.
    pub group: String,
    /// Number of answers.
    pub answered: usize,
    /// Number of answers that deviate.
    pub deviating: usize,
    /// Median of the relative errors of the numbers that deviate.
    pub median_error: Option<f64>,
    /// Largest of these errors.
    pub largest_error: Option<f64>,
    /// The factor between answers and certified values, if there is one.
    pub factor: Option<CommonFactor>,
}

impl GroupDeviation {
    fn new(by: GroupedBy, group: &str, all: &[&Residual]) -> Self {
        let off = || all.iter().filter(|one| one.deviates());
        let error = |level| {
            let errors = off().filter_map(|one| one.relative());
            quantile(errors.map(f64::abs), level)
        };
        Self {
            by,
            group: group.to_owned(),
            answered: all.len(),
            deviating: off().count(),
            median_error: error(0.5),
            largest_error: error(1.0),
            factor: CommonFactor::find(all),
        }
    }

    fn share(&self) -> f64 {
        self.deviating as f64 / self.answered as f64
    }

    fn words(&self) -> String {
        use FactorKind::{Constant, Sign};
        let Self { by, group, answered, deviating, .. } = self;
        let by = match by {
            GroupedBy::Dimension | GroupedBy::Quantity => String::new(),
            _ => format!("{by} "),
        };
        if let Some(CommonFactor { constant, kind }) = self.factor {
            let factor = match (digits(constant, 6), kind) {
                (constant, Constant) => constant,
                (one, Sign) if one == "1" => "their sign".into(),
                (one, kind) if one == "1" => kind.to_string(),
                (constant, kind) => format!("{constant} {kind}"),
            };
            return format!(
                "{by}{group}: the {answered} answers are the certified values \
                 times {factor}."
            );
        }
        let errors = self.median_error.zip(self.largest_error);
        let errors = errors.map_or(String::new(), |(median, largest)| {
            let [median, largest] = [median, largest].map(|x| digits(x, 2));
            format!("; median relative error {median}, largest {largest}")
        });
        format!(
            "{by}{group}: {deviating} of {answered} answers deviate{errors}."
        )
    }
}

/// Answers that deviate for an unknown reason.
#[derive(Clone, Debug, Serialize)]
pub struct Deviations {
    /// The groups with deviating answers, by the property that explains most,
    /// then by the others except the scene; the largest shares first.
    pub groups: Vec<GroupDeviation>,
    /// Number of answers in groups without deviating answers, by the property
    /// that explains most.
    pub others: usize,
    /// Digits to which these answers agree with the certified values at a
    /// condition of 1, 15 at most.
    pub others_digits: f64,
}

impl Deviations {
    pub(crate) fn new(given: &[Residual]) -> Self {
        let off = given.iter().filter(|one| one.deviates()).count();
        let share = off as f64 / given.len() as f64;
        let mut all = GroupedBy::ALL.map(|by| (by, by.groups(given)));
        all.sort_by_cached_key(|(_, groups)| {
            let gain = gain(groups, share, &|one| Some(one.deviates()));
            // Numbers that are not negative have the order of their bits.
            std::cmp::Reverse(gain.to_bits())
        });
        let groups = all.iter().flat_map(|(by, groups)| {
            let new = |(name, all): (&String, &Vec<_>)| {
                GroupDeviation::new(*by, name, all)
            };
            let mut groups: Vec<_> = groups.iter().map(new).collect();
            // Scenes are many.
            let shown = all[0].0 == *by || *by != GroupedBy::Scene;
            groups.retain(|one| shown && one.deviating > 0);
            groups.sort_by(|a, b| b.share().total_cmp(&a.share()));
            groups
        });
        let groups = groups.collect();
        let others = all[0].1.values();
        let others = others.filter(|all| !all.iter().any(|g| g.deviates()));
        let errors = others.flatten().map(|one| one.error / one.condition);
        let worst = errors.clone().fold(1e-15, f64::max);
        let (others, others_digits) = (errors.count(), -libm::log10(worst));
        Self { groups, others, others_digits }
    }

    /// The deviations in words, a sentence for each of the first groups by the
    /// property that explains most.
    pub fn sentences(&self) -> Vec<String> {
        let is_first = |one: &&GroupDeviation| one.by == self.groups[0].by;
        let first = self.groups.iter().filter(is_first);
        let mut out: Vec<_> = first.map(GroupDeviation::words).collect();
        let further = out.len().saturating_sub(SHOWN);
        out.truncate(SHOWN);
        let further = (further > 0)
            .then(|| format!("Number of further groups: {further}."));
        let (others, digits) = (self.others, self.others_digits.floor());
        let others = (others > 0).then(|| {
            format!(
                "The other {others} answers agree to {digits} digits at a \
                 condition of 1."
            )
        });
        out.extend(further.into_iter().chain(others));
        out
    }
}
