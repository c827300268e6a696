//! A comparison with shaking-table tests in words. Each sentence is chosen
//! by a rule on the numbers, and speaks of these tests alone.

use rocking_common::words::{columns, rounded};
use rocking_procedures::shaking::{
    DistributionComparison, Predictor, TestComparison, UnfittedMeasure,
};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::{Estimate, Interval};

use crate::words::{short, symbol, three_digits};

/// What the block is called among predictors.
const BLOCK: &str = "the block";

/// An intensity measure without its unit, by its name.
pub(super) fn measure(name: &str) -> String {
    let known = name.parse::<IntensityMeasure>();
    known.map_or_else(|_| name.to_owned(), |im| symbol(&im))
}

/// A share in percent, with its interval.
pub(super) fn share(estimate: &Estimate) -> String {
    estimate.text(" %", |x| rounded(100.0 * x, 3).to_string())
}

/// The level of the intervals in percent.
fn level(found: &TestComparison) -> String {
    format!("{} %", rounded(100.0 * found.level, 3))
}

/// Where an interval lies beside a number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Beside {
    /// All of it below.
    Below,
    /// It holds the number.
    Holds,
    /// All of it above.
    Above,
    /// There is no interval.
    Unknown,
}

impl Beside {
    /// The place of an interval beside `x`.
    pub(super) fn of(estimate: &Estimate, x: f64) -> Self {
        let place = |interval: Interval| match interval {
            i if i.high() < x => Self::Below,
            i if i.low() > x => Self::Above,
            _ => Self::Holds,
        };
        estimate.interval().map_or(Self::Unknown, place)
    }
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
    let ratio = &found.computed.median;
    let shown = three_digits(ratio);
    if found.alpha_is_fitted {
        return "Its slenderness was fitted to the same fates, so that \
                measured over computed capacity has a median of 1: these \
                tests say nothing of a bias."
            .to_owned();
    }
    let median =
        format!("The median of measured over computed capacity is {shown}");
    match Beside::of(ratio, 1.0) {
        Beside::Holds => format!("{median}: no bias is seen."),
        Beside::Above => format!(
            "{median}: the block overturns at lower levels than the \
             specimen, which is on the safe side."
        ),
        Beside::Below => format!(
            "{median}: the block overturns at higher levels than the \
             specimen, which is unsafe."
        ),
        Beside::Unknown => format!("{median}, without an interval."),
    }
}

/// Which dispersion the model leaves out of a fragility.
pub(super) fn left_out(one: &DistributionComparison) -> String {
    let im = measure(&one.im);
    let (measured, computed) =
        (short(one.measured_dispersion), short(one.computed_dispersion));
    let found = format!(
        "In {im} the measured fragility has a dispersion of {measured}, the \
         computed one of {computed}"
    );
    let missing = three_digits(&one.missing_dispersion);
    match Beside::of(&one.dispersion_difference, 0.0) {
        Beside::Above => format!(
            "{found}: the model leaves out a dispersion of {missing}, which \
             adds by squares."
        ),
        Beside::Below => {
            format!("{found}: the computed one is the wider one.")
        }
        Beside::Holds => format!(
            "{found}: the interval of their difference holds 0, so that \
             these tests do not show that the model leaves out dispersion."
        ),
        Beside::Unknown => format!("{found}; there is no interval."),
    }
}

/// In which measures the measured fragility is wider or narrower than the
/// computed one.
fn widths(found: &TestComparison) -> Option<String> {
    let of = |place: Beside, words: &str| {
        let is = |one: &&DistributionComparison| {
            Beside::of(&one.dispersion_difference, 0.0) == place
        };
        let shown = |one: &DistributionComparison| {
            format!(
                "{} ({} against {})",
                measure(&one.im),
                short(one.measured_dispersion),
                short(one.computed_dispersion)
            )
        };
        let own = found.distributions.iter().filter(is).map(shown);
        let own: Vec<String> = own.collect();
        (!own.is_empty()).then(|| format!("{words} in {}", own.join(", ")))
    };
    let parts = [
        of(Beside::Above, "larger"),
        of(Beside::Holds, "no difference is shown"),
        of(Beside::Below, "smaller"),
        of(Beside::Unknown, "without an interval"),
    ];
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| {
        format!(
            "Dispersion of the measured against the computed fragility: {}.",
            parts.join("; ")
        )
    })
}

/// The sentences that come first: share of right fates, bias, dispersion,
/// what the model leaves out.
pub(super) fn first(found: &TestComparison) -> String {
    let text = format!(
        "A rigid block gets {} of the fates of {} shaking-table tests right. \
         {} What the model leaves out scatters the capacity by a dispersion \
         of {}.",
        share(&found.computed.right),
        found.tests,
        bias(found),
        three_digits(&found.computed.dispersion),
    );
    widths(found).map_or(text.clone(), |widths| format!("{text} {widths}"))
}

/// The intervals in a sentence.
pub(super) fn intervals(found: &TestComparison) -> String {
    let mut text = format!(
        "Brackets hold {} intervals: {} draws of the {} motions, each with \
         all its tests.",
        level(found),
        found.replicates,
        found.motions
    );
    if let Some(remark) = &found.remark {
        text += &format!(" Note: {remark}.");
    }
    text
}

/// Whether the block predicts the fates better than intensity alone.
pub(super) fn rivals(found: &TestComparison) -> Option<String> {
    let score = |one: &Predictor| one.log_score.value();
    let best =
        found.rivals.iter().min_by(|a, b| score(a).total_cmp(&score(b)))?;
    let (own, other) = (score(&found.computed), score(best));
    let verdict = if own < other {
        "the block predicts these fates better than each intensity measure \
         alone"
            .to_owned()
    } else {
        format!(
            "{} alone predicts these fates as well as the block or better",
            measure(&best.predictor)
        )
    };
    Some(format!(
        "By the mean log score {verdict}: {} for the block, {} for {}, the \
         best measure. Small is good; each probability is of a fit without \
         the motion of its test.",
        three_digits(&found.computed.log_score),
        three_digits(&best.log_score),
        measure(&best.predictor),
    ))
}

/// Measures without a fit.
pub(super) fn unfitted(found: &TestComparison) -> Vec<String> {
    let line = |one: &UnfittedMeasure| {
        let fates = if one.computed { "computed" } else { "measured" };
        format!(
            "{}: the {fates} fates give no fit: {}.",
            measure(&one.im),
            one.reason
        )
    };
    found.unfitted.iter().map(line).collect()
}

/// How well tests repeat themselves.
pub(super) fn repeatability(found: &TestComparison) -> Vec<String> {
    let own = &found.repeatability;
    let mut all = Vec::new();
    if own.pairs > 0 {
        all.push(format!(
            "{} of {} pairs of tests of one motion whose PGA differ by 5 % \
             or less have different fates.",
            own.different, own.pairs
        ));
    }
    if own.mixed_motions > 0 {
        all.push(format!(
            "{} of {} motions with both fates overturned the specimen at a \
             lower PGA than one at which it stood.",
            own.not_monotone, own.mixed_motions
        ));
    }
    if let Some(dispersion) = own.dispersion {
        all.push(format!(
            "Within a motion the capacity has a dispersion of {}, which is \
             biased low: each motion has a median of its own.",
            short(dispersion)
        ));
    }
    all
}

/// Tests at which the block stands above its first overturning.
pub(super) fn resurrected(found: &TestComparison) -> Option<String> {
    let own = &found.resurrected;
    if own.tests == 0 {
        return None;
    }
    let expected = own.expected.map_or(String::new(), |number| {
        format!(
            "; by the levels of their first overturning {} were to be \
             expected",
            short(number)
        )
    });
    Some(format!(
        "In {} of the tests the block stands, but overturns at a lower level \
         of the same motion. {} of these tests overturned the specimen{expected}. \
         If the block at the level of the test decides, {} % of all fates \
         are right.",
        own.tests,
        own.overturned,
        short(100.0 * own.right_at_level)
    ))
}

/// What happened below the onset of rocking.
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

pub(super) fn predictor_heads(found: &TestComparison) -> Vec<String> {
    let level = level(found);
    [
        "Predictor".to_owned(),
        format!("Fates right ({level})"),
        "Median: measured over computed capacity, or intensity".to_owned(),
        "Dispersion".to_owned(),
        "Area under the ROC curve".to_owned(),
        "Mean log score".to_owned(),
        "Log-likelihood".to_owned(),
    ]
    .into()
}

/// The block and the measures, cell by cell.
pub(super) fn predictors(found: &TestComparison) -> Vec<Vec<String>> {
    let row = |(name, unit, one): (String, &str, &Predictor)| {
        let gap = if unit.is_empty() { "" } else { " " };
        vec![
            name,
            share(&one.right),
            one.median.text(&format!("{gap}{unit}"), short),
            three_digits(&one.dispersion),
            three_digits(&one.auc),
            three_digits(&one.log_score),
            rounded(one.log_likelihood, 4).to_string(),
        ]
    };
    let own = (BLOCK.to_owned(), "", &found.computed);
    let rivals = found.rivals.iter().map(|one| {
        let im = one.predictor.parse::<IntensityMeasure>();
        let unit = im.map_or("", |im| im.unit());
        (measure(&one.predictor), unit, one)
    });
    std::iter::once(own).chain(rivals).map(row).collect()
}

pub(super) fn fragility_heads() -> Vec<String> {
    [
        "Intensity measure",
        "Measured median",
        "Computed median",
        "Ratio of the medians",
        "Measured dispersion",
        "Computed dispersion",
        "Difference of the dispersions",
        "Dispersion left out by the model",
    ]
    .map(str::to_owned)
    .into()
}

/// The fragilities, cell by cell.
pub(super) fn fragilities(found: &TestComparison) -> Vec<Vec<String>> {
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
    found.distributions.iter().map(row).collect()
}

/// Log-likelihoods of four fits, by what they say of the onset.
pub(super) fn onsets(found: &TestComparison) -> Vec<Vec<String>> {
    let own = &found.onset;
    let shown = |x: Option<f64>| match x {
        Some(x) => rounded(x, 4).to_string(),
        None => "no fit".to_owned(),
    };
    let row = |what: &str, x| vec![what.to_owned(), shown(x)];
    vec![
        row("scatter on the whole computed capacity", own.whole),
        row("scatter on the part above the onset", own.above),
        row("fragility in PGA from 0", own.pga_unshifted),
        row("fragility in PGA from the onset", own.pga_shifted),
    ]
}

/// What the terminal shows.
pub(super) fn text(found: &TestComparison) -> String {
    let mut text = format!("{}\n\n", first(found));
    text += &format!("Block: {}.\n", block(found));
    text += &format!("{}\n\n", counts(found));
    let heads = predictor_heads(found);
    for (k, head) in heads.iter().enumerate() {
        text += &format!("[{}] {head}\n", k + 1);
    }
    text += &format!("\n{}\n", columns(&predictors(found), |_| false));
    let other = found.distributions.iter().map(left_out);
    let last = [Some(below(found)), resurrected(found)];
    let all = rivals(found).into_iter().chain(other);
    let all = all.chain(unfitted(found)).chain(repeatability(found));
    for line in all.chain(last.into_iter().flatten()) {
        text += &format!("{line}\n");
    }
    text + &intervals(found) + "\n"
}

/// The tests in a sentence.
pub(super) fn counts(found: &TestComparison) -> String {
    let mut text = format!(
        "{} tests of {} motions; {} overturned the specimen.",
        found.tests, found.motions, found.overturned
    );
    if found.unknown > 0 {
        text += &format!(
            " {} more have an unknown fate and are left out.",
            found.unknown
        );
    }
    if found.never_overturned > 0 {
        text += &format!(
            " In {} of the tests the motion does not overturn the block at \
             any level that was run; the last level counts as their capacity.",
            found.never_overturned
        );
    }
    text
}
