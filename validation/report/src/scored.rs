//! The page of a score: answers of a code beside certified ones.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use rocking_draw::colour;
use rocking_draw::figures::of_result::score_svg;
use rocking_draw::page::{POLICY, STYLE};
use rocking_score::{Explanation, Score, Value, Verdict, codes, reference};


/// The page of a score: one file, without scripts and network.
#[must_use]
pub fn page(score: &Score) -> String {
    let set = reference();
    let conditions: Vec<f64> = score
        .quantities
        .iter()
        .filter_map(|q| set.place(q.scene, q.quantity))
        .map(|place| set.items[place].condition)
        .collect();
    let svg = score_svg(score, &conditions, &codes());
    let title = "Score of a rocking code";
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta http-equiv="Content-Security-Policy" content=(POLICY);
                meta name="viewport"
                    content="width=device-width, initial-scale=1";
                title { (title) }
                style { (PreEscaped(STYLE)) (PreEscaped(colour::STYLE)) }
            }
            body {
                main {
                    h1 { (title) }
                    p {
                        "Answers to " (score.answered) " of " (score.asked)
                        " quantities of the reference data set, version "
                        (score.data_set) "."
                    }
                    h2 { "What is wrong with the code" }
                    (diagnosis(score))
                    h2 { "Digits" }
                    (levels(score))
                    figure {
                        (PreEscaped(svg))
                        figcaption {
                            "Digits are −log10 of the relative error, from 0 \
                             to what double precision can get: 15 less log10 \
                             of the condition number."
                        }
                    }
                    h2 { "Answers that lack digits" }
                    (lacking(score))
                }
            }
        }
    }
    .into_string()
        + "\n"
}

fn diagnosis(score: &Score) -> Markup {
    let found = &score.diagnosis;
    let scatter = found.scatter.map_or(String::new(), |s| format!("{s:.0e}"));
    html! {
        @match found.verdict {
            Verdict::None => p {
                "None of the known mistakes: the answers agree with the \
                 certified values within a relative scatter of " (scatter)
                " at a condition of 1."
            }
            Verdict::Unknown => p {
                "Something that is not among the known mistakes: no one of \
                 them, and no two that were tried together, explain the \
                 answers."
            }
            Verdict::TooFew => p { "Too few answers for a verdict." }
            Verdict::Known => {
                @if found.explanations.len() > 1 {
                    p {
                        "The answers given cannot tell these explanations \
                         apart:"
                    }
                }
                ul {
                    @for one in &found.explanations {
                        li { (explanation(one)) }
                    }
                }
                p { "Relative scatter about the explanation: " (scatter) "." }
            }
        }
    }
}

fn explanation(one: &Explanation) -> Markup {
    html! {
        @for mistake in &one.mistakes {
            b { (mistake.what) } " Look at: " (mistake.look_at) " "
        }
        @if let Some(factor) = one.factor {
            "The factor is " (format!("{factor:.6}")) ". "
        }
        "It explains " (one.explained) " of " (one.deviating)
        " answers that deviate or should."
    }
}

fn levels(score: &Score) -> Markup {
    let number =
        |x: Option<f64>| x.map_or("–".into(), |x| format!("{x:.1}"));
    let head = [
        "Level",
        "Numbers answered",
        "Median digits",
        "Fewest digits",
        "Share that attains all digits",
        "Fates right",
        "Fates wrong",
        "Fates missing",
        "Counts right",
        "Counts wrong",
    ];
    html! {
        div.scroll tabindex="0" {
            table {
                thead { tr { @for name in head { th { (name) } } } }
                tbody {
                    @for level in &score.levels {
                        tr {
                            th { (level.level) ", " (level.kind) }
                            td { (level.answered) " of " (level.asked) }
                            td { (number(level.median_digits)) }
                            td { (number(level.worst_digits)) }
                            td {
                                (level.attained_share.map_or(
                                    "–".into(),
                                    |share| format!("{:.0} %", 100.0 * share),
                                ))
                            }
                            td { (level.fates_right) }
                            td { (level.fates_wrong) }
                            td { (level.fates_missing) }
                            td { (level.counts_right) }
                            td { (level.counts_wrong) }
                        }
                    }
                }
            }
        }
    }
}

/// Lines of the table of answers that lack digits.
const MOST: usize = 40;

fn lacking(score: &Score) -> Markup {
    let text = |value: &Value| match value {
        Value::Fate(fate) => fate.clone(),
        Value::Count(n) => n.to_string(),
        Value::Number(x) => format!("{x:.9}"),
    };
    let mut rows: Vec<_> =
        score.quantities.iter().filter(|q| !q.attained).collect();
    let digits = |x: Option<f64>| x.unwrap_or(0.0);
    let lacks = |k: usize| {
        let q = rows[k];
        digits(q.digits) - q.attainable_digits.unwrap_or(15.0)
    };
    let mut order: Vec<usize> = (0..rows.len()).collect();
    order.sort_by(|a, b| lacks(*a).total_cmp(&lacks(*b)));
    let all = rows.len();
    rows = order.into_iter().take(MOST).map(|k| rows[k]).collect();
    let head =
        ["Scene", "Quantity", "Answer", "Certified", "Digits", "Attainable"];
    html! {
        @if all == 0 {
            p { "None: every answer has all digits that it can have." }
        } @else {
            p {
                (all) " answers; the " (rows.len()) " that lack most:"
            }
            div.scroll tabindex="0" {
                table {
                    thead { tr { @for name in head { th { (name) } } } }
                    tbody {
                        @for q in rows {
                            tr {
                                th { (q.scene) }
                                td { (q.quantity) }
                                td { (text(&q.value)) }
                                td { (text(q.certified)) }
                                td { (q.digits.map_or("–".into(),
                                    |x| format!("{x:.1}"))) }
                                td { (q.attainable_digits.map_or("–".into(),
                                    |x| format!("{x:.1}"))) }
                            }
                        }
                    }
                }
            }
        }
    }
}
