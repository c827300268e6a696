//! What the deviating answers of a code have in common.

use std::collections::BTreeMap;

use rocking_exchange::table::digits;

use crate::diagnosis::{AGREE, BEYOND, Residual, SHARE, Scatter, TIE};
use crate::reference::{Item, SceneExcitation, reference};

/// Largest error of a coarse answer at a condition of 1: half a digit.
const HALF_A_DIGIT: f64 = 0.316;
/// Share of normal errors within a tenth of their median size.
const TENTH: f64 = 0.054;

/// Answers by the name of their group.
type Groups<'a> = BTreeMap<String, Vec<&'a Residual>>;

/// Answers by quantity, by excitation and by equation.
fn groups(given: &[Residual]) -> [Groups<'_>; 3] {
    let mut all = <[Groups<'_>; 3]>::default();
    for one in given {
        for (groups, name) in all.iter_mut().zip(names(one.item)) {
            groups.entry(name).or_default().push(one);
        }
    }
    all
}

/// The names of the groups of an answer. The times of all impacts are one
/// group, for example.
fn names(item: &Item) -> [String; 3] {
    let scene = reference().scene(item);
    let parts = item.quantity.split('_').map(|part| {
        let is_number = part.parse::<u8>().is_ok();
        if is_number { "K" } else { part }
    });
    let excitation = match scene.excitation {
        SceneExcitation::Free => "free motion",
        SceneExcitation::Pulse(_) => "pulses",
        SceneExcitation::Samples { .. } => "samples",
    };
    [
        parts.collect::<Vec<_>>().join("_"),
        excitation.to_owned(),
        format!("{} equation", scene.equation.name()),
    ]
}

/// Quantile of values; the largest at a level of 1.
fn quantile(values: impl Iterator<Item = f64>, level: f64) -> f64 {
    let mut sorted: Vec<f64> = values.collect();
    sorted.sort_by(f64::total_cmp);
    let place = (level * sorted.len() as f64) as usize;
    *sorted.get(place).or(sorted.last()).unwrap_or(&f64::NAN)
}

/// Gain in log-likelihood if groups have their own shares of answers with a
/// property instead of `share`. An own share costs half the logarithm of the
/// number of answers of the group (Schwarz 1978), and the choice of the group
/// the logarithm of the number of groups; a group has one if this pays.
fn gain(
    groups: &Groups<'_>,
    share: f64,
    has: impl Fn(&Residual) -> Option<bool>,
) -> f64 {
    let choice = libm::log(groups.len() as f64);
    let gains = groups.values().map(|group| {
        let known: Vec<bool> = group.iter().filter_map(|g| has(g)).collect();
        let all = known.len() as f64;
        let part = known.iter().filter(|has| **has).count() as f64;
        let term = |n: f64, share: f64| {
            if n > 0.0 { n * libm::log(n / all / share) } else { 0.0 }
        };
        let gain = term(part, share) + term(all - part, 1.0 - share);
        (gain - 0.5 * libm::log(all.max(1.0)) - choice).max(0.0)
    });
    gains.sum()
}

/// The largest error of 99 % of the answers at a condition of 1, if they are
/// coarse: in no group are errors of one sign, or far smaller or larger than
/// in others. A mistake leaves answers right that it does not concern, and
/// moves the others in one direction. Less than half of the answers do not show
/// this.
pub(crate) fn within(given: &[Residual], power: f64) -> Option<f64> {
    let own = |one: &Residual| one.full() / one.allowed(Scatter(1.0, power));
    let number = |one: &Residual| one.relative().map(|_| own(one));
    let within = quantile(given.iter().map(own), AGREE);
    let median = quantile(given.iter().filter_map(number), 0.5);
    let near = median / BEYOND..median * BEYOND;
    let is_far = |one: &Residual| Some(!near.contains(&number(one)?));
    let is_more = |one: &Residual| Some(one.relative()? > 0.0);
    let is_alike = |groups: &Groups<'_>| {
        gain(groups, TENTH, is_far) <= TIE && gain(groups, 0.5, is_more) <= TIE
    };
    let is_coarse = within <= HALF_A_DIGIT
        && 2 * given.len() >= reference().items.len()
        && groups(given).iter().all(is_alike);
    is_coarse.then_some(within)
}

/// The factor between the answers of a group and the certified values: a
/// constant times 1, alpha, 1/alpha or the sign of the value. One exception in
/// ten deviations is allowed.
fn factor(group: &[&Residual], deviating: usize) -> Option<String> {
    ["", "alpha", "1/alpha", "their sign"].into_iter().find_map(|unit| {
        let ratio = |one: &&Residual| {
            let alpha = reference().scene(one.item).alpha_rad;
            let unit = match unit {
                "alpha" => alpha,
                "1/alpha" => 1.0 / alpha,
                "their sign" => one.item.value.number()?.signum(),
                _ => 1.0,
            };
            Some((1.0 + one.relative()?) / unit)
        };
        let constant = quantile(group.iter().filter_map(ratio), 0.5);
        let right = group.iter().filter(|one| {
            ratio(one)
                .is_some_and(|x| one.may_have((x / constant - 1.0).abs()))
        });
        let bad = group.len() - right.count();
        let holds = bad as f64 <= (1.0 - SHARE) * deviating as f64;
        let factor = match (&*digits(constant, 6), unit) {
            (constant, "") => constant.to_owned(),
            ("1", unit) => unit.to_owned(),
            (constant, unit) => format!("{constant} {unit}"),
        };
        (deviating >= 3 && holds).then_some(factor)
    })
}

/// What deviates, by the property that explains most: a sentence for each group
/// with deviating answers, and one for the other answers.
pub(crate) fn deviations(given: &[Residual]) -> Vec<String> {
    let off = given.iter().filter(|one| !one.may_have(one.error)).count();
    let share = off as f64 / given.len() as f64;
    let explained = |groups: &Groups<'_>| {
        gain(groups, share, |one| Some(!one.may_have(one.error)))
    };
    let all = groups(given);
    let best = all.iter().max_by(|a, b| explained(a).total_cmp(&explained(b)));
    let (mut out, mut others) = (Vec::new(), Vec::<&Residual>::new());
    for (name, group) in best.into_iter().flatten() {
        let off = group.iter().filter(|one| !one.may_have(one.error));
        let errors: Vec<f64> = off.map(|one| one.error).collect();
        let (all, off) = (group.len(), errors.len());
        match factor(group, off) {
            _ if off == 0 => others.extend(group),
            Some(factor) => out.push(format!(
                "{name}: the {all} answers are the certified values times \
                 {factor}."
            )),
            None => out.push(format!(
                "{name}: {off} of {all} answers deviate; median relative \
                 error {}.",
                digits(quantile(errors.into_iter(), 0.5), 2)
            )),
        }
    }
    if !others.is_empty() {
        let errors = others.iter().map(|one| one.error / one.condition);
        let digits = -libm::log10(errors.fold(1e-15, f64::max)).floor();
        out.push(format!(
            "The other {} answers agree to {digits} digits at a condition of 1.",
            others.len()
        ));
    }
    out
}
