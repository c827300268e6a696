//! A comparison with shaking-table tests in words. Each sentence is chosen by
//! a rule on the numbers, and is about these tests only.

use std::cmp::Ordering;

use rocking_common::words::rounded;
use rocking_procedures::shaking::{
    DistributionComparison, Predictor, TestComparison, UnfittedMeasure,
};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::Estimate;

use crate::words::{WordTable, numbered, short, symbol, three_digits};

/// Name of the block among predictors.
const BLOCK: &str = "the block";

/// An intensity measure without its unit, by its name.
pub(super) fn measure(name: &str) -> String {
    let known = name.parse::<IntensityMeasure>();
    known.map_or_else(|_| name.to_owned(), |im| symbol(&im))
}

/// A share in percent, with its interval.
fn share(estimate: &Estimate) -> String {
    estimate.text(" %", |x| rounded(100.0 * x, 3).to_string())
}

/// The level of the intervals in percent.
fn level(found: &TestComparison) -> String {
    format!("{} %", rounded(100.0 * found.level, 3))
}

/// Position of an interval relative to a number: below, around or above it;
/// `None` without an interval.
fn beside(estimate: &Estimate, x: f64) -> Option<Ordering> {
    let place = |(low, high): (f64, f64)| match () {
        () if high < x => Ordering::Less,
        () if low > x => Ordering::Greater,
        () => Ordering::Equal,
    };
    estimate.interval().map(|interval| place(interval.ends()))
}

/// The block with its slenderness.
pub(super) fn block(found: &TestComparison) -> String {
    let alpha = three_digits(&found.alpha_rad);
    let fitted = if found.alpha_is_fitted { ", fitted" } else { "" };
    format!(
        "alpha {alpha} rad{fitted}, p {} rad/s, coefficient of restitution \
         {}",
        short(found.p_rad_s),
        found.eta
    )
}

/// The bias of the capacities.
fn bias(found: &TestComparison) -> String {
    if found.alpha_is_fitted {
        return "Its slenderness was fitted to the same outcomes, so the \
                median of measured over computed capacity is 1: these tests \
                do not show a bias."
            .to_owned();
    }
    let ratio = &found.computed.median;
    let verdict = match beside(ratio, 1.0) {
        Some(Ordering::Equal) => ": no bias is seen.",
        Some(Ordering::Greater) => {
            ": the block overturns at lower levels than the specimen, which \
             is on the safe side."
        }
        Some(Ordering::Less) => {
            ": the block overturns at higher levels than the specimen, \
             which is unsafe."
        }
        None => ", without an interval.",
    };
    let shown = three_digits(ratio);
    format!(
        "The median of measured over computed capacity is {shown}{verdict}"
    )
}

/// Which dispersion the model leaves out of a fragility.
pub(super) fn left_out(one: &DistributionComparison) -> String {
    let missing = three_digits(&one.missing_dispersion);
    let missing = format!(
        ": the model leaves out a dispersion of {missing}, to be added by \
         squares."
    );
    let verdict = match beside(&one.dispersion_difference, 0.0) {
        Some(Ordering::Greater) => &missing,
        Some(Ordering::Less) => ": the computed one is wider.",
        Some(Ordering::Equal) => {
            ": the interval of their difference contains 0, so these tests \
             do not show that the model leaves out dispersion."
        }
        None => "; there is no interval.",
    };
    format!(
        "In {} the measured fragility has a dispersion of {}, the computed \
         one of {}{verdict}",
        measure(&one.im),
        short(one.measured_dispersion),
        short(one.computed_dispersion)
    )
}

/// In which measures the measured fragility is wider or narrower than the
/// computed one; nothing without measures.
fn widths(found: &TestComparison) -> String {
    let shown = |one: &DistributionComparison| {
        format!(
            "{} ({} against {})",
            measure(&one.im),
            short(one.measured_dispersion),
            short(one.computed_dispersion)
        )
    };
    let mut parts = Vec::new();
    for (place, words) in [
        (Some(Ordering::Greater), "larger"),
        (Some(Ordering::Equal), "no difference shown"),
        (Some(Ordering::Less), "smaller"),
        (None, "without an interval"),
    ] {
        let own = found.distributions.iter();
        let own =
            own.filter(|d| beside(&d.dispersion_difference, 0.0) == place);
        let own: Vec<String> = own.map(shown).collect();
        if !own.is_empty() {
            parts.push(format!("{words} in {}", own.join(", ")));
        }
    }
    if parts.is_empty() {
        return String::new();
    }
    format!(
        " Dispersion of the measured against the computed fragility: {}.",
        parts.join("; ")
    )
}

/// The sentences that come first: share of right fates, bias, dispersion,
/// what the model leaves out.
pub(super) fn first(found: &TestComparison) -> String {
    format!(
        "A rigid block predicts {} of the outcomes of {} shaking-table \
         tests. {} The scatter of the capacity that the model leaves out has \
         a dispersion of {}.{}",
        share(&found.computed.right),
        found.tests,
        bias(found),
        three_digits(&found.computed.dispersion),
        widths(found)
    )
}

/// The intervals in a sentence.
pub(super) fn intervals(found: &TestComparison) -> String {
    let mut text = format!(
        "Brackets give {} intervals, from {} draws of the {} motions, each \
         with all its tests.",
        level(found),
        found.replicates,
        found.motions
    );
    if let Some(remark) = &found.remark {
        text += &format!(" Note: {remark}.");
    }
    text
}

/// Whether the block predicts the outcomes better than intensity by itself.
pub(super) fn rivals(found: &TestComparison) -> Option<String> {
    let score = |one: &Predictor| one.log_score.value();
    let best =
        found.rivals.iter().min_by(|a, b| score(a).total_cmp(&score(b)))?;
    let im = measure(&best.predictor);
    let verdict = match score(&found.computed) < score(best) {
        true => {
            "the block predicts these outcomes better than any single \
             intensity measure"
        }
        false => &format!(
            "{im} by itself predicts these outcomes at least as well as the \
             block"
        ),
    };
    Some(format!(
        "By the mean log score {verdict}: {} for the block, {} for {im}, the \
         best measure. Smaller is better; each probability is from a fit \
         without the motion of its test.",
        three_digits(&found.computed.log_score),
        three_digits(&best.log_score),
    ))
}

/// Measures without a fit.
pub(super) fn unfitted(found: &TestComparison) -> Vec<String> {
    let line = |one: &UnfittedMeasure| {
        let fates = if one.computed { "computed" } else { "measured" };
        format!(
            "{}: the {fates} outcomes give no fit: {}.",
            measure(&one.im),
            one.reason
        )
    };
    found.unfitted.iter().map(line).collect()
}

/// How well tests repeat themselves.
pub(super) fn repeatability(found: &TestComparison) -> Vec<String> {
    let own = &found.repeatability;
    let (pairs, different) = (own.pairs, own.different);
    let (mixed, not_monotone) = (own.mixed_motions, own.not_monotone);
    let mut all = Vec::new();
    if pairs > 0 {
        all.push(format!(
            "{different} of {pairs} pairs of tests of one motion whose PGAs \
             differ by 5 % or less have different outcomes."
        ));
    }
    if mixed > 0 {
        all.push(format!(
            "{not_monotone} of {mixed} motions with both outcomes overturned \
             the specimen at a lower PGA than one that it survived."
        ));
    }
    if let Some(dispersion) = own.dispersion.map(short) {
        all.push(format!(
            "Within a motion the capacity has a dispersion of {dispersion}, \
             which is biased low, since each motion has its own median."
        ));
    }
    all
}

/// Tests at which the block survives above its first overturning.
pub(super) fn resurrected(found: &TestComparison) -> Option<String> {
    let own = &found.resurrected;
    if own.tests == 0 {
        return None;
    }
    let expected = own.expected.map_or(String::new(), |number| {
        format!(
            "; {} would be expected from the levels of their first \
             overturning",
            short(number)
        )
    });
    Some(format!(
        "In {} of the tests the block survives, but overturns at a lower \
         level of the same motion. {} of these tests overturned the \
         specimen{expected}. By the block at the level of the test, {} % of \
         all outcomes are right.",
        own.tests,
        own.overturned,
        short(100.0 * own.right_at_level)
    ))
}

/// Tests below the onset of rocking.
pub(super) fn below(found: &TestComparison) -> String {
    let own = &found.onset;
    format!(
        "The block begins to rock at {} g. {} tests have a PGA at or below \
         it; {} of them overturned the specimen.",
        short(own.onset_g),
        own.below,
        own.overturned_below
    )
}

/// The block and the measures.
pub(super) fn predictors(found: &TestComparison) -> WordTable {
    let heads = [
        "Predictor",
        &format!("Outcomes predicted ({})", level(found)),
        "Median: measured over computed capacity, or intensity",
        "Dispersion",
        "Area under the ROC curve",
        "Mean log score",
        "Log-likelihood",
    ];
    let row = |one: &Predictor| {
        // The block is not a measure.
        let im = one.predictor.parse::<IntensityMeasure>();
        let unit = im.as_ref().map_or("", IntensityMeasure::unit);
        let gap = if unit.is_empty() { "" } else { " " };
        vec![
            im.map_or_else(|_| BLOCK.to_owned(), |im| symbol(&im)),
            share(&one.right),
            one.median.text(&format!("{gap}{unit}"), short),
            three_digits(&one.dispersion),
            three_digits(&one.auc),
            three_digits(&one.log_score),
            rounded(one.log_likelihood, 4).to_string(),
        ]
    };
    let all = std::iter::once(&found.computed).chain(&found.rivals);
    (heads.map(str::to_owned).into(), all.map(row).collect())
}

/// The measured and computed fragilities.
pub(super) fn fragilities(found: &TestComparison) -> WordTable {
    let heads = [
        "Intensity measure",
        "Measured median",
        "Computed median",
        "Ratio of the medians",
        "Measured dispersion",
        "Computed dispersion",
        "Difference of the dispersions",
        "Dispersion left out by the model",
    ];
    let row = |one: &DistributionComparison| {
        vec![
            measure(&one.im),
            format!("{} {}", short(one.measured_median), one.unit),
            format!("{} {}", short(one.computed_median), one.unit),
            three_digits(&one.median_ratio),
            short(one.measured_dispersion),
            short(one.computed_dispersion),
            three_digits(&one.dispersion_difference),
            three_digits(&one.missing_dispersion),
        ]
    };
    let rows = found.distributions.iter().map(row).collect();
    (heads.map(str::to_owned).into(), rows)
}

/// Log-likelihoods of four fits, by what they say of the onset.
pub(super) fn onsets(found: &TestComparison) -> WordTable {
    let own = &found.onset;
    let rows = [
        ("scatter on the whole computed capacity", own.whole),
        ("scatter on the part above the onset", own.above),
        ("fragility in PGA from 0", own.pga_unshifted),
        ("fragility in PGA from the onset", own.pga_shifted),
    ];
    let rows = rows.map(|(fit, x)| {
        let shown =
            x.map_or("no fit".to_owned(), |x| rounded(x, 4).to_string());
        vec![fit.to_owned(), shown]
    });
    (["Fit", "Log-likelihood"].map(str::to_owned).into(), rows.into())
}

/// The text for the terminal.
pub fn text(found: &TestComparison) -> String {
    let mut lines = vec![
        first(found),
        String::new(),
        format!("Block: {}.", block(found)),
        counts(found),
        String::new(),
        numbered(&predictors(found)),
    ];
    lines.extend(rivals(found));
    lines.extend(found.distributions.iter().map(left_out));
    lines.extend(unfitted(found));
    lines.extend(repeatability(found));
    lines.push(below(found));
    lines.extend(resurrected(found));
    lines.push(intervals(found));
    lines.join("\n") + "\n"
}

/// The tests in sentences.
pub(super) fn counts(found: &TestComparison) -> String {
    let (unknown, never) = (found.unknown, found.never_overturned);
    let mut text = format!(
        "{} tests of {} motions; {} overturned the specimen.",
        found.tests, found.motions, found.overturned
    );
    if unknown > 0 {
        text += &format!(
            " {unknown} more have an unknown outcome and are left \
                      out."
        );
    }
    if never > 0 {
        text += &format!(
            " In {never} of the tests the motion does not overturn the block \
             at any level that was run; the last level counts as their \
             capacity."
        );
    }
    text
}
