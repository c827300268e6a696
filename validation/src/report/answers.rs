//! The study's questions, answered by the verdicts on the claims.

use crate::paper::Verdict;
use crate::study::claims::Claim;

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
        let figure = claim
            .section
            .split_once("Figure")
            .and_then(|(_, rest)| {
                let digits = |c: char| c.is_ascii_digit();
                rest.split(|c| !digits(c)).find(|part| !part.is_empty())
            })
            .and_then(|number| number.parse::<u32>().ok());
        match figure {
            Some(2..=5) => Self::Histories,
            Some(6..=10) => Self::Statistics,
            Some(11..=14) => Self::Distributions,
            Some(15..=18) => Self::Fragilities,
            _ if claim.section.starts_with('4') => Self::Statistics,
            _ => Self::Choices,
        }
    }
}

/// A sentence or two for each question, from the verdicts alone.
pub(super) fn answers(claims: &[Claim]) -> Vec<String> {
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
        let place = format!("{}{arm}", claim.suite);
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
    use super::{Claim, Question, Verdict, answers};
    use crate::study::claims::Measured;

    fn claim(section: &str, verdict: Verdict) -> Claim {
        Claim {
            id: "made-up".into(),
            section: section.into(),
            quote: "it drops out".into(),
            suite: "ordinary".into(),
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
            ("4, Figures 2 and 3", Question::Histories),
            ("4, Figures 6 and 7", Question::Statistics),
            ("4", Question::Statistics),
            ("5, Figure 11", Question::Distributions),
            ("5, Figure 15a", Question::Fragilities),
            ("3, Table 1", Question::Choices),
            ("5", Question::Choices),
        ] {
            let claim = claim(section, Verdict::Confirmed);
            assert_eq!(Question::of(&claim), question, "{section}");
        }
    }

    #[test]
    fn names_what_is_not_confirmed() {
        let claims = [
            claim("4, Figure 6", Verdict::Confirmed),
            claim("4, Figure 6", Verdict::NotConfirmed),
            claim("4, Figure 7", Verdict::Inconclusive),
        ];
        let found = answers(&claims);
        assert_eq!(found.len(), 1);
        assert!(found[0].ends_with(
            "1 of 3 claims are confirmed here; not confirmed: \
             \u{201c}it drops out\u{201d} (ordinary); open: \
             \u{201c}it drops out\u{201d} (ordinary)."
        ));
    }
}
