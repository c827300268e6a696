//! The paper's claims, each with its measure and the margin that was fixed
//! before any result was seen.

mod basics;
mod fragilities;
mod lognormality;
mod stages;
mod stripes;

use rocking::capacity::InversionRule;
use rocking::statistics::ExtendedSample;
use rocking::statistics::bootstrap::{Bootstrap, estimate};
use rocking::statistics::boxplot::median_interval;
use rocking::statistics::paired::Pairs;

use super::StudyError;
use super::analyses::{Apart, SuiteResults};
use super::figures::{Results, median_of};
use super::runs::capacities;
use super::sensitivities::Varied;
use crate::findings::{Claim, Measured, suffix};
use crate::paper::{
    Arm, FREQUENCIES_RAD_S, Section, SuiteKind, Verdict, position,
};

/// Level of all intervals.
const LEVEL: f64 = 0.95;

/// Replicates of a bootstrap.
const REPLICATES: usize = 2000;

/// Equal within this share counts as the same.
const SAME: f64 = 0.05;

/// Standard normal quantile of 97.5 %.
const NORMAL_975: f64 = 1.959_963_984_540_054;

/// Wilson's 95 % interval of a share: `count` of `of` records, which are
/// independent of each other.
#[must_use]
pub fn wilson(count: usize, of: usize) -> (f64, f64) {
    let (n, z2) = (of as f64, NORMAL_975 * NORMAL_975);
    let share = count as f64 / n;
    let middle = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let spread = share * (1.0 - share) / n + z2 / (4.0 * n * n);
    let half = NORMAL_975 * spread.sqrt() / (1.0 + z2 / n);
    (middle - half, middle + half)
}

/// All claims, in the paper's order.
///
/// # Errors
/// [`StudyError`] where a measure cannot be computed.
pub fn all(results: &Results) -> Result<Vec<Claim>, StudyError> {
    let mut out = basics::all(results)?;
    out.extend(stages::all(results)?);
    out.extend(lognormality::all(results)?);
    out.extend(fragilities::all(results)?);
    Ok(out)
}

/// What does not change from one claim to the next.
struct Context<'a> {
    section: Section,
    suites: &'a [SuiteKind],
    blocks: &'a str,
    arm: Option<Arm>,
}

impl Context<'_> {
    /// A claim measured here.
    #[expect(clippy::too_many_arguments, reason = "all of them are words")]
    fn claim(
        &self,
        id: &str,
        quote: &str,
        measure: &str,
        measured: Measured,
        margin: &str,
        verdict: Verdict,
        note: String,
    ) -> Claim {
        Claim {
            id: format!("{id}{}", suffix(self.suites, self.arm)),
            name: id.into(),
            section: self.section,
            quote: quote.into(),
            suites: self.suites.to_vec(),
            blocks: self.blocks.into(),
            arm: self.arm,
            measure: measure.into(),
            measured,
            margin: margin.into(),
            verdict,
            note,
        }
    }
}

/// Median with its exact order-statistic interval.
#[must_use]
pub fn median(values: &[f64]) -> Measured {
    let finite: Vec<f64> =
        values.iter().copied().filter(|x| x.is_finite()).collect();
    let Ok(sample) = ExtendedSample::try_new(&finite) else {
        return Measured::exact(f64::NAN);
    };
    let sorted = sample.sorted();
    let n = sorted.len();
    Measured {
        value: 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]),
        interval: median_interval(&sample, LEVEL).map(|i| (i.low, i.high)),
    }
}

/// Distance of a median from 1, with the interval's.
fn away(m: Measured) -> Measured {
    let off = |x: f64| (x - 1.0).abs();
    let interval = m.interval.map(|(a, b)| {
        let (a_off, b_off) = (off(a), off(b));
        let high = if a_off > b_off { a_off } else { b_off };
        let low = if a_off > b_off { b_off } else { a_off };
        (if a <= 1.0 && b >= 1.0 { 0.0 } else { low }, high)
    });
    Measured { value: off(m.value), interval }
}

fn middle(values: &[f64]) -> f64 {
    median(values).value
}

/// Difference of two samples' medians, a minus b, with the percentile
/// interval of a bootstrap that draws from each sample on its own.
fn difference(name: &str, a: &[f64], b: &[f64]) -> Measured {
    let draw = |side: &str, x: &[f64]| {
        let name = format!("study/{name}/{side}");
        Bootstrap::new(&name, 0, x.len(), REPLICATES).map(|places| {
            middle(&places.iter().map(|i| x[*i]).collect::<Vec<f64>>())
        })
    };
    let value = middle(a) - middle(b);
    let replicates: Vec<f64> =
        draw("a", a).iter().zip(draw("b", b)).map(|(a, b)| a - b).collect();
    let interval =
        estimate(value, &replicates, LEVEL).map(|e| (e.low, e.high));
    Measured { value, interval }
}

/// Medians that should all be 1: the worst one, and the verdict over all.
struct Cells {
    measured: Measured,
    verdict: Verdict,
    /// Number of cells, and of those whose interval does not contain 1.
    counts: (usize, usize),
}

/// Confirmed if every cell's interval lies within 1 -+ `margin`, not
/// confirmed if one lies wholly outside.
fn all_one(cells: &[Vec<f64>], margin: f64) -> Cells {
    let medians: Vec<Measured> = cells
        .iter()
        .filter(|c| c.len() >= crate::paper::LEAST_USABLE)
        .map(|c| median(c))
        .collect();
    let verdicts: Vec<Verdict> =
        medians.iter().map(|m| m.within(1.0 - margin, 1.0 + margin)).collect();
    let verdict = if verdicts.contains(&Verdict::NotConfirmed) {
        Verdict::NotConfirmed
    } else if verdicts.is_empty() || verdicts.contains(&Verdict::Inconclusive)
    {
        Verdict::Inconclusive
    } else {
        Verdict::Confirmed
    };
    let mut measured = Measured::exact(f64::NAN);
    for m in &medians {
        let off = |m: &Measured| (m.value - 1.0).abs();
        if measured.value.is_nan() || off(m) > off(&measured) {
            measured = *m;
        }
    }
    let excludes =
        |m: &&Measured| m.interval.is_some_and(|(a, b)| a > 1.0 || b < 1.0);
    let excluding = medians.iter().filter(excludes).count();
    Cells { measured, verdict, counts: (medians.len(), excluding) }
}

impl Cells {
    fn note(&self) -> String {
        format!(
            "worst of {} cells; the intervals of {} exclude 1",
            self.counts.0, self.counts.1
        )
    }
}

/// One frequency parameter of a suite's single-record comparison, medians
/// over records and slendernesses.
#[derive(Clone, Copy, Debug)]
pub struct SingleRow {
    /// Frequency parameter.
    pub p_rad_s: f64,
    /// Level of the histories.
    pub im: f64,
    /// Number of pairs of histories in which both blocks stand.
    pub usable: usize,
    /// Normalized L2 distance.
    pub distance: f64,
    /// Ratio of the peaks.
    pub peak_ratio: f64,
    /// Mean |ln| of the ratio of intensities at equal demand.
    pub mean_ln_im: f64,
}

/// The single-record comparison by frequency parameter.
#[must_use]
pub fn single_rows(suite: &SuiteResults) -> Vec<SingleRow> {
    suite
        .single
        .iter()
        .zip(FREQUENCIES_RAD_S)
        .map(|(single, p_rad_s)| {
            let stands = |a: &&Apart| a.distance.is_finite();
            SingleRow {
                p_rad_s,
                im: single.im,
                usable: single.apart.iter().flatten().filter(stands).count(),
                distance: median_of(single, |a| a.distance),
                peak_ratio: median_of(single, |a| a.peak_ratio),
                mean_ln_im: median_of(single, |a| a.mean_ln_im),
            }
        })
        .collect()
}

/// Paired capacities at a demand: another choice over the study's.
///
/// # Errors
/// [`StudyError`] where a curve cannot be inverted.
pub fn varied_ratios(
    results: &Results,
    varied: &Varied,
    demand: f64,
) -> Result<Pairs, StudyError> {
    let curves = results.ordinary.curves(results.plan.common());
    let base = &curves.ok_or(StudyError::NoArm)?
        [position(varied.frequency, varied.slenderness)];
    let (mut a, mut b) = (Vec::new(), Vec::new());
    for (curve, base) in varied.curves.iter().zip(base) {
        if let Some(curve) = curve {
            a.extend(capacities(curve, &[demand], InversionRule::Median)?);
            b.extend(capacities(base, &[demand], InversionRule::Median)?);
        }
    }
    Ok(Pairs::try_new(&a, &b)?)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wilson_agrees_with_its_closed_ends_and_r() {
        // At 0 of n the upper end is z^2/(n + z^2).
        let (low, high) = wilson(0, 20);
        assert!(low.abs() < 1e-15 && (high - 0.161_125_158).abs() < 1e-8);
        // R 4: prop.test(5, 10, correct = FALSE).
        let (low, high) = wilson(5, 10);
        assert!((low - 0.236_593_1).abs() < 1e-7, "{low}");
        assert!((high - 0.763_406_9).abs() < 1e-7, "{high}");
    }
}
