//! The summary of the page: the questions that a reader asks first, answered
//! in a sentence or two made from the numbers, and the study's questions,
//! answered by the verdicts on the claims.

use super::evidence::{NOT_RUN, Proof};
use super::page::Summary;
use super::timings::Timings;
use crate::findings::Claim;
use crate::paper::{Arm, Intensity, Verdict};
use crate::study::analyses::SuiteResults;
use crate::study::figures::Results;
use crate::words::{self, rounded_text};

/// The summary: what was asked, what was found, how far to trust it.
pub(super) fn summary(
    results: &Results,
    claims: &[Claim],
    timings: &Timings,
    proof: Option<&Proof>,
) -> Summary {
    let found = |suite: &SuiteResults| {
        let certainty = suite.work.certainty;
        let work = format!(
            "{} {} records, {} analyses",
            suite.records.len(),
            suite.kind,
            suite.work.analyses
        );
        if certainty.unresolved == 0 {
            return format!("{work}; double precision tells every one.");
        }
        let ends = certainty.ends;
        format!(
            "{work}. Of {} of them rounding in double precision may have \
             changed the peak or the fate: their motion is chaotic. {} of \
             these are first overturnings, on which capacities rest. All of \
             those were told again: {} by double precision, every decision \
             being assessed, {} by double-double, {} by octuple precision, \
             {} by none. Double precision had told {} of them wrongly; with \
             these and those that none told at the next level that \
             overturns, the 16, 50 and 84 % overturning intensities would \
             move by {} at most.",
            certainty.unresolved,
            ends.all,
            ends.double,
            ends.double_double,
            ends.octuple,
            ends.undecided,
            ends.moved,
            rounded_text(certainty.largest_shift)
        )
    };
    Summary {
        asked: "Can the slenderness of a rocking block be normalized out, \
                and are its capacities lognormal above the intensity of \
                uplift? Fifteen rigid blocks, p = 1, 3, 4 rad/s and alpha = \
                0.05 to 0.25 rad, were rocked to overturning by every record \
                of two suites."
            .into(),
        found: [
            first_answers(results, claims, timings, proof),
            by_claims(claims),
            vec![found(&results.ordinary), found(&results.pulse)],
        ]
        .concat(),
        trust: "Margins were fixed before any result was seen, but for those \
                whose note says otherwise and one more: the sharp onset for \
                PGA was first measured by the largest intensity at a rotation \
                of 0.005 alpha, which turned out to measure the block's size, \
                and is now measured by the onsets themselves, which for PGA \
                are 1 by definition. A verdict needs the whole interval on \
                one side of its margin; where there is no interval the value \
                alone decides, and that is said there. Verdicts hold for \
                these suites."
            .into(),
    }
}

/// Slenderness, distribution, accuracy, speed, and what was not checked.
fn first_answers(
    results: &Results,
    claims: &[Claim],
    timings: &Timings,
    proof: Option<&Proof>,
) -> Vec<String> {
    vec![
        slenderness(results, claims),
        distribution(results),
        accuracy(proof, timings),
        timings.plain(),
        not_checked(results),
    ]
}

/// The value of a claim, on the arm if it has arms; NaN where it was not
/// measured.
fn value(claims: &[Claim], id: &str, arm: Option<Arm>) -> f64 {
    let is = |c: &&Claim| c.name == id && (arm.is_none() || c.arm == arm);
    claims.iter().find(is).map_or(f64::NAN, |c| c.measured.value)
}

fn percent(share: f64) -> String {
    if share.is_nan() {
        "(not measured)".into()
    } else {
        words::percent(share, 1)
    }
}

fn slenderness(results: &Results, claims: &[Claim]) -> String {
    let pulse = value(claims, "one-curve-pulse", None);
    let ordinary = pulse + value(claims, "curves-ordinary-worse", None);
    let by_arm = |id: &str, text: &dyn Fn(f64) -> String| {
        let each: Vec<String> = results
            .plan
            .drawn()
            .into_iter()
            .map(|arm| {
                let found = text(value(claims, id, Some(arm)));
                format!("{found} on arm {}", arm.letter())
            })
            .collect();
        each.join(", ")
    };
    let ratio = |x: f64| format!("{x:.3}");
    format!(
        "Is the slenderness normalized out? Under one pulse-type motion \
         nearly: the IDA curves of the five slendernesses are {} apart in \
         intensity at equal demand (median over records); under one ordinary \
         motion less so, {}. In the statistics of the ordinary suite their \
         median intensities at demands 0.1 to 1.0 differ by {} at most, and \
         of the median paired ratios of responses the one farthest from 1 is \
         {} for p = 1 and {} for p = 3 and 4. Adjusting the slenderness \
         instead of scaling the records moves the medians by {} at most. \
         With Housner's restitution it is not normalized out: overturning \
         intensities of alpha = 0.25 and 0.05 differ by {}.",
        percent(pulse),
        percent(ordinary),
        by_arm("quantiles-coincide", &percent),
        by_arm("ratios-p1", &ratio),
        by_arm("ratios-p3-p4", &ratio),
        by_arm("adjustment-quantiles", &percent),
        percent(value(claims, "housner-breaks", None)),
    )
}

/// Mean accepted shares over the blocks.
fn distribution(results: &Results) -> String {
    let arm = results.plan.common();
    let mut parts = Vec::new();
    for suite in [&results.ordinary, &results.pulse] {
        for (intensity, name) in
            [(Intensity::Pga, "PGA"), (Intensity::Pgv, "PGV")]
        {
            let Some(d) = results.distributions(suite.kind, arm, intensity)
            else {
                continue;
            };
            let mean = |of: fn((f64, f64)) -> f64| {
                let sum = d.blocks.iter().fold(0.0, |s, b| s + of(b.shares()));
                sum / d.blocks.len() as f64
            };
            parts.push(format!(
                "{} for {name}, {} ({} unshifted)",
                percent(mean(|s| s.1)),
                suite.kind,
                percent(mean(|s| s.0)),
            ));
        }
    }
    format!(
        "Is rocking fragility shifted lognormal? At the 5 % level the \
         Lilliefors test accepts a shifted lognormal at this share of the \
         demand levels, mean over the 15 blocks, arm {}: {}. Accepting is \
         weak evidence with so few records; the power of the test is among \
         the tables.",
        arm.letter(),
        parts.join("; ")
    )
}

fn accuracy(proof: Option<&Proof>, timings: &Timings) -> String {
    let cases = proof.map_or(NOT_RUN.into(), Proof::to_string);
    format!("How accurate is the integrator? {} {cases}", timings.accuracy())
}

pub(super) fn not_checked(results: &Results) -> String {
    let records = if results.embedded() {
        "recorded earthquakes (these suites are synthetic), "
    } else {
        ""
    };
    format!(
        "What was not checked? The model against experiments, {records}\
         sliding, bouncing, vertical motion and flexible supports, and other \
         machines than x86-64 Linux."
    )
}

/// What a reader asks first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Question {
    Histories,
    Statistics,
    Distributions,
    Fragilities,
    Choices,
}

impl Question {
    const ALL: [Self; 5] = [
        Self::Histories,
        Self::Statistics,
        Self::Distributions,
        Self::Fragilities,
        Self::Choices,
    ];

    fn words(self) -> &'static str {
        match self {
            Self::Histories => {
                "Does the slenderness drop out under a single motion \
                 (Figures 2 to 5)?"
            }
            Self::Statistics => {
                "Does it drop out of the statistics, and do scaled records \
                 and adjusted slenderness agree (Figures 6 to 10)?"
            }
            Self::Distributions => {
                "Are capacities lognormal above a shift (Figures 11 to 14)?"
            }
            Self::Fragilities => {
                "Do Eqs. 5 to 7 give the fragility (Figures 15 to 18)?"
            }
            Self::Choices => {
                "Are the model and its choices as the paper says (blocks, \
                 uplift, criterion, resurrections, component, inversion)?"
            }
        }
    }

    /// By the figure that a claim is about, or its section.
    fn of(claim: &Claim) -> Self {
        match claim.section.figures().first() {
            Some(2..=5) => Self::Histories,
            Some(6..=10) => Self::Statistics,
            Some(11..=14) => Self::Distributions,
            Some(15..=18) => Self::Fragilities,
            _ if claim.section.number == 4 => Self::Statistics,
            _ => Self::Choices,
        }
    }
}

/// A sentence or two for each question, from the verdicts alone.
fn by_claims(claims: &[Claim]) -> Vec<String> {
    Question::ALL
        .into_iter()
        .filter_map(|question| {
            let own: Vec<&Claim> = claims
                .iter()
                .filter(|claim| Question::of(claim) == question)
                .collect();
            (!own.is_empty()).then(|| answer(question, &own))
        })
        .collect()
}

fn answer(question: Question, claims: &[&Claim]) -> String {
    let having = |verdict: Verdict| -> Vec<&Claim> {
        claims.iter().copied().filter(|c| c.verdict == verdict).collect()
    };
    let confirmed = having(Verdict::Confirmed).len();
    let mut text = format!(
        "{} {confirmed} of {} claims are confirmed here",
        question.words(),
        claims.len()
    );
    for (verdict, words) in [
        (Verdict::NotConfirmed, "not confirmed"),
        (Verdict::Inconclusive, "open"),
    ] {
        let named = having(verdict);
        if !named.is_empty() {
            text += &format!("; {words}: {}", names(&named));
        }
    }
    text + "."
}

/// Claims by their words, each with the suites and arms it was tested on.
fn names(claims: &[&Claim]) -> String {
    let mut seen: Vec<(&str, Vec<String>)> = Vec::new();
    for claim in claims {
        let arm = claim
            .arm
            .map_or(String::new(), |arm| format!(", arm {}", arm.letter()));
        let place = format!("{}{arm}", claim.suite_name());
        match seen.iter_mut().find(|(quote, _)| *quote == claim.quote) {
            Some((_, places)) => places.push(place),
            None => seen.push((&claim.quote, vec![place])),
        }
    }
    let each: Vec<String> = seen
        .into_iter()
        .map(|(quote, places)| {
            format!("\u{201c}{quote}\u{201d} ({})", places.join("; "))
        })
        .collect();
    each.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::findings::Measured;
    use crate::paper::SuiteKind;
    use crate::paper::{Section, Shown};

    #[test]
    fn what_was_not_measured_is_said() {
        assert_eq!(percent(value(&[], "absent", None)), "(not measured)");
        assert_eq!(percent(0.0978), "9.8 %");
    }

    fn claim(section: Section, verdict: Verdict) -> Claim {
        Claim {
            id: "made-up".into(),
            name: "made-up".into(),
            section,
            quote: "it drops out".into(),
            suites: vec![SuiteKind::Ordinary],
            blocks: "all 15".into(),
            arm: None,
            measure: "a measure".into(),
            measured: Measured { value: 1.0, interval: None },
            margin: "none".into(),
            verdict,
            note: String::new(),
        }
    }

    #[test]
    fn puts_claims_to_the_questions_of_their_figures() {
        for (section, question) in [
            (Section::new(4, Shown::Figures(2, 3)), Question::Histories),
            (Section::new(4, Shown::Figures(6, 7)), Question::Statistics),
            (Section::new(4, Shown::Text), Question::Statistics),
            (Section::new(5, Shown::Figure(11)), Question::Distributions),
            (Section::new(5, Shown::Panel(15, 'a')), Question::Fragilities),
            (Section::new(3, Shown::Table(1)), Question::Choices),
            (Section::new(5, Shown::Text), Question::Choices),
        ] {
            let claim = claim(section, Verdict::Confirmed);
            assert_eq!(Question::of(&claim), question, "{section}");
        }
    }

    #[test]
    fn names_what_is_not_confirmed() {
        let claims = [
            claim(Section::new(4, Shown::Figure(6)), Verdict::Confirmed),
            claim(Section::new(4, Shown::Figure(6)), Verdict::NotConfirmed),
            claim(Section::new(4, Shown::Figure(7)), Verdict::Inconclusive),
        ];
        let found = by_claims(&claims);
        assert_eq!(found.len(), 1);
        assert!(found[0].ends_with(
            "1 of 3 claims are confirmed here; not confirmed: \
             \u{201c}it drops out\u{201d} (ordinary); open: \
             \u{201c}it drops out\u{201d} (ordinary)."
        ));
    }
}
