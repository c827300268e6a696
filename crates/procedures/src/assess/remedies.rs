//! What would help an object that does not meet the target.

use libm::{exp, log, pow};

use super::answers::Unknowns;
use super::ground::{AssessmentSuite, ObjectMotion, SEARCH};
use super::{
    Answer, AssessError, Damage, NamedFloor, Object, ObjectFacts,
    TargetVerdict,
};
use rocking::block::Block;
use rocking::ida::{Analysis, Batch, curves};
use rocking::names::named;
use rocking_records::floor::Floor;
use rocking_statistics::Estimate;

/// Period in s and damping ratio of the isolation.
const ISOLATION: (f64, f64) = (3.0, 0.15);

/// Largest factor of the slenderness that is sought.
const MOST: f64 = 4.0;

/// Number of sizes that are tried.
const TRIES: usize = 4;

/// How far beyond the target the next size aims.
const ENOUGH: f64 = 1.03;

/// Steps in which measures are given: sizes in m, and forces over weight.
const STEP: f64 = 0.01;

/// A measure that changes the return period of an object.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Remedy {
    /// The measure.
    pub measure: RemedyKind,
    /// Its size, in the unit that the measure names.
    pub size: f64,
    /// Mean return period of damage of the changed object in years; none if no
    /// size up to this one meets the target, and of a tie against uplift.
    pub return_period_years: Option<Estimate>,
    /// Whether it meets the target.
    pub target: Option<TargetVerdict>,
}

named! {
    /// The kind of a measure.
    pub enum RemedyKind: "measure" {
        /// A base that is wider across its shorter side, such as a plate that
        /// is fixed under the object; its width in m.
        WiderBase = "wider-base",
        /// A lower centre of mass over the same base, such as ballast: the
        /// block of twice its height. How much lower in m.
        LowerCentre = "lower-centre",
        /// Base isolation: a floor of one linear mode under the object, with
        /// 15 % damping; its period in s.
        Isolation = "isolation",
        /// A tie at the top that holds with a force and gives way beyond it;
        /// the force over the weight of the object. For small angles the
        /// object behaves as one with the tangent of its slenderness larger
        /// by twice this ratio, and equal p.
        Tie = "yielding-tie",
        /// A tie at the top that keeps the object from uplift in all motions
        /// that are not rarer than the target, by the moments about the pivot;
        /// the force over the weight of the object.
        NoUplift = "tie-against-uplift",
    }
}

/// One object, and the return period to which its value has to rise for the
/// low end of its interval to be the target.
struct RemedyGoal<'a> {
    facts: &'a ObjectFacts,
    unknowns: &'a Unknowns,
    shift: f64,
    target: f64,
    years: f64,
    low: f64,
    goal: f64,
}

/// A measure with its size, and the width and height of its block.
type Resized = (RemedyKind, f64, (f64, f64));

impl AssessmentSuite<'_> {
    /// Measures for an object that does not meet the target; `intervals` are
    /// its intensities of damage above `shift`.
    ///
    /// # Errors
    /// A changed object that cannot be analysed.
    pub(super) fn remedies(
        &self,
        facts: &ObjectFacts,
        intervals: &[(f64, f64)],
        shift: f64,
        answer: &Answer,
        unknowns: &Unknowns,
    ) -> Result<Vec<Remedy>, AssessError> {
        let Some((target, own)) =
            self.options.target_years.zip(answer.return_period_years())
        else {
            return Ok(Vec::new());
        };
        let low = own.interval().map_or(own.value(), |own| own.low());
        if low >= target {
            return Ok(Vec::new());
        }
        let years = own.value();
        let goal = target * years / low;
        let case =
            RemedyGoal { facts, unknowns, shift, target, years, low, goal };
        // The factor on the capacity that reaches the goal, for a first size.
        let scaled = |k: f64| match answer.fitted.scaled(k) {
            Ok(other) => self.years(&other),
            Err(_) => f64::INFINITY,
        };
        let factor = least(|k| scaled(k) >= goal);
        let mut found = vec![
            self.resized(
                &case,
                factor,
                |f, k| f.width_m * k,
                |f, x| {
                    let width_m = up(x);
                    (RemedyKind::WiderBase, width_m, (width_m, f.height_m))
                },
            )?,
            self.resized(
                &case,
                factor,
                |f, k| 0.5 * f.height_m / k,
                |f, x| {
                    let by_m = up(0.5 * f.height_m - x);
                    let size = (f.width_m, f.height_m - 2.0 * by_m);
                    (RemedyKind::LowerCentre, by_m, size)
                },
            )?,
            self.isolated(&case)?,
        ];
        if facts.damage == Damage::Overturning {
            found.push(self.tied(&case, factor, intervals)?);
        }
        found.push(self.held(&case));
        Ok(found)
    }

    /// A change of a size that meets the target, close to the least one. `size`
    /// is the changed size at a factor of the slenderness, `rounded` the
    /// measure with that size, rounded to the safe side, and the width and
    /// height of its block.
    fn resized(
        &self,
        case: &RemedyGoal<'_>,
        factor: f64,
        size: impl Fn(&ObjectFacts, f64) -> f64,
        rounded: impl Fn(&ObjectFacts, f64) -> Resized,
    ) -> Result<Remedy, AssessError> {
        let facts = case.facts;
        let gravity = self.options.gravity_m_s2;
        let moved = self.under(&facts.object);
        let steepest = facts.object.friction.unwrap_or(1.0).min(1.0);
        let most = (steepest / facts.uplift_pga_g).min(MOST);
        let block = |(width_m, height_m)| {
            Block::from_dimensions(width_m, height_m, gravity)
        };
        let changed = |block: Block| Object { block, ..facts.object.clone() };
        let mut k = factor;
        for attempt in 0..TRIES {
            if !(k < most) {
                break;
            }
            let (measure, size, sizes) = rounded(facts, size(facts, k));
            // A size of a few cm may round to no block at all.
            let Ok(block) = block(sizes) else { break };
            let other = changed(block);
            let mut analysis = self.of_damage(&other, other.restitution);
            if attempt == 0 {
                analysis.refine = Some(SEARCH);
            }
            let (values, shift) = self.of(&other, moved, &analysis)?;
            if attempt == 0 {
                // The first size only tells how far the next one has to go.
                let fit = self.fit(&values, shift);
                let fit = fit.map_err(|source| facts.refused(source))?.fitted;
                let total = case.unknowns.total(fit);
                let years = total.map_or(f64::NAN, |own| self.years(&own));
                let times = ENOUGH * case.goal / case.years;
                k = secant(k, years / case.years, times);
                continue;
            }
            let kind = (measure, size);
            let remedy = self.remedy(case, kind, &values, shift)?;
            if remedy.target == Some(TargetVerdict::Meets) {
                return Ok(remedy);
            }
            let low = remedy.return_period_years.and_then(|own| own.low());
            let low = low.unwrap_or(f64::NAN) / case.low;
            k = secant(k, low, ENOUGH * case.target / case.low);
        }
        let (measure, size, _) = rounded(facts, size(facts, most));
        Ok(Remedy { measure, size, return_period_years: None, target: None })
    }

    fn isolated(&self, case: &RemedyGoal<'_>) -> Result<Remedy, AssessError> {
        let (period_s, damping) = ISOLATION;
        let object = &case.facts.object;
        let name = "isolation".to_owned();
        let floor = Floor::try_new(period_s, damping, 1.0);
        let floor = floor.map_err(|source| AssessError::Floor {
            record: String::new(),
            floor: name.clone(),
            source,
        })?;
        let under = NamedFloor { name, floor };
        let floors: Vec<_> = object.floor.iter().chain([&under]).collect();
        let moved = ObjectMotion::new(self.records, &floors)?;
        let other = Object { floor: Some(under.clone()), ..object.clone() };
        let analysis = self.of_damage(&other, other.restitution);
        let (values, shift) = self.of(&other, &moved, &analysis)?;
        let kind = (RemedyKind::Isolation, period_s);
        self.remedy(case, kind, &values, shift)
    }

    /// A yielding tie; `intervals` are the intensities of damage without it.
    fn tied(
        &self,
        case: &RemedyGoal<'_>,
        factor: f64,
        intervals: &[(f64, f64)],
    ) -> Result<Remedy, AssessError> {
        let slope = case.facts.uplift_pga_g;
        let mut force_over_weight = up(0.5 * (factor - 1.0) * slope);
        loop {
            let kind = (RemedyKind::Tie, force_over_weight);
            let k = 1.0 + 2.0 * force_over_weight / slope;
            let times = |(low, high): &(f64, f64)| (low * k, high * k);
            let values: Vec<_> = intervals.iter().map(times).collect();
            let remedy = self.remedy(case, kind, &values, case.shift * k)?;
            if remedy.target == Some(TargetVerdict::Meets) || !(k < MOST) {
                return Ok(remedy);
            }
            force_over_weight += STEP;
        }
    }

    /// A tie against uplift, from the mean annual frequency of uplift over the
    /// records.
    fn held(&self, case: &RemedyGoal<'_>) -> Remedy {
        let uplifts = self.uplifts(case.facts);
        let frequency = |k: f64| {
            let curve = self.options.hazard.map(|hazard| &hazard.curve);
            let of = |im: &f64| {
                let curve = curve?;
                let (first, _) = curve.ends();
                curve.frequency((im * k).max(first.0))
            };
            let sum: f64 = uplifts.iter().filter_map(of).sum();
            sum / uplifts.len() as f64
        };
        let k = least(|k| frequency(k) <= case.target.recip());
        let size = up(0.5 * (k - 1.0) * case.facts.uplift_pga_g);
        let measure = RemedyKind::NoUplift;
        Remedy { measure, size, return_period_years: None, target: None }
    }

    fn remedy(
        &self,
        case: &RemedyGoal<'_>,
        (measure, size): (RemedyKind, f64),
        values: &[(f64, f64)],
        shift: f64,
    ) -> Result<Remedy, AssessError> {
        let id = &case.facts.object.id;
        let own = self.drawn(id, values, shift, self.clusters, case.unknowns);
        let own = own.map_err(|source| case.facts.refused(source))?;
        let years = self.exposed(&own).map(|own| own.return_period_years());
        let target = years.and_then(|own| self.verdict(own));
        Ok(Remedy { measure, size, return_period_years: years, target })
    }

    /// Intensities of damage of an object on a motion, and the shift.
    fn of(
        &self,
        object: &Object,
        moved: &ObjectMotion,
        analysis: &Analysis,
    ) -> Result<(Vec<(f64, f64)>, f64), AssessError> {
        let gravity = self.options.gravity_m_s2;
        let facts = ObjectFacts::of(object, &[], gravity)?;
        let found = curves(&moved.normalised, &[*analysis], &Batch::default());
        let made: Vec<_> = found?.into_iter().flatten().collect();
        let values = self.intervals(&facts, moved, &made)?;
        Ok((values, self.shift(&facts)))
    }
}

/// The factor of the slenderness at which the return period is `wanted` times
/// as long, where it is `found` times as long at the factor `k`.
fn secant(k: f64, found: f64, wanted: f64) -> f64 {
    let power = (log(found) / log(k)).max(0.5);
    pow(wanted, power.recip())
}

/// Rounded up to a step.
fn up(x: f64) -> f64 {
    (x / STEP - 1e-9).ceil() * STEP
}

/// The least number above 1 from which on something holds, by bisection; it
/// holds at the end, [`MOST`] to the fifth, if anywhere.
fn least(holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, 5.0 * log(MOST));
    if holds(1.0) {
        return 1.0;
    }
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if holds(exp(middle)) {
            high = middle;
        } else {
            low = middle;
        }
    }
    exp(high)
}

#[cfg(test)]
mod tests {
    use super::up;

    #[test]
    fn sizes_are_rounded_up_to_a_whole_step() {
        for (x, expected) in
            [(0.5, 0.5), (0.501, 0.51), (0.509, 0.51), (0.0, 0.0)]
        {
            assert!((up(x) - expected).abs() < 1e-12, "{x}");
        }
    }
}
