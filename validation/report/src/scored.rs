//! The page of a score, answers of a code beside certified ones, and the
//! scores of known codes.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use rocking_common::table::PlainTable;
use rocking_draw::figures::of_result::{codes_chart, score_svg};
use rocking_draw::figures::{Chart, Figure, Heading, Place};
use rocking_draw::page::head;
use rocking_score::{
    Code, Explanation, Score, Value, Verdict, codes, own_answers, reference,
    score,
};

/// The page of a score: one file, without scripts and network.
#[must_use]
pub fn page(scored: &Score) -> String {
    let set = reference();
    let conditions: Vec<f64> = scored
        .quantities
        .iter()
        .filter_map(|q| set.place(q.scene, q.quantity))
        .map(|place| set.items[place].condition)
        .collect();
    let svg = score_svg(scored, &conditions, &codes());
    let title = "Score of a rocking code";
    html! {
        (DOCTYPE)
        html lang="en" {
            (head(title))
            body {
                main {
                    h1 { (title) }
                    p {
                        "Answers to " (scored.answered) " of " (scored.asked)
                        " quantities of the reference data set, version "
                        (scored.data_set) "."
                    }
                    h2 { "What is wrong with the code" }
                    (diagnosis(scored))
                    h2 { "Digits" }
                    (levels(scored))
                    figure {
                        div.scroll.drawing.wide role="region"
                            aria-label="Digits against difficulty" tabindex="0" {
                            (PreEscaped(svg))
                        }
                        figcaption {
                            "Digits are −log10 of the relative error, from 0 \
                             to what double precision can get: 15 less log10 \
                             of the condition number."
                        }
                    }
                    h2 { "Answers that lack digits" }
                    (lacking(scored))
                }
            }
        }
    }
    .into_string()
        + "\n"
}

/// Settings of the known codes.
pub const SETTINGS: [&str; 2] = ["default", "best"];

/// Medians of each level of known codes in these settings.
#[must_use]
pub fn codes_table(settings: &[&str]) -> PlainTable {
    let mut codes = codes();
    codes.retain(|code| settings.contains(&code.setting.as_str()));
    let same =
        |a: &Code, b: &Code| (&a.code, &a.setting) == (&b.code, &b.setting);
    let row = |levels: &[Code]| {
        let Code { code, setting, version, .. } = &levels[0];
        let median = |level| levels.iter().find(|c| c.level == level);
        let sum = |f: fn(&Code) -> usize| levels.iter().map(f).sum::<usize>();
        let (wrong, of) = (sum(|c| c.fates_wrong), sum(|c| c.fates_answered));
        let name = format!("{code} {version}").trim_end().to_owned();
        let mut cells = vec![name, setting.clone()];
        cells.extend((1..=5).map(|level| {
            median(level)
                .map_or("–".into(), |c| format!("{:.1}", c.median_digits))
        }));
        cells.push(format!("{wrong} of {of}"));
        cells
    };
    PlainTable::new(
        "other-codes",
        "How do others do?",
        "Median digits of the answers of other codes to the reference data \
         set (fixtures/benchmark), level by level; `default` is a code as \
         it is shipped, `best` the best settings found. Double precision gives 14 to 15 digits where a \
         scene is well conditioned. What could not be made to rock, and why, \
         stands in validation/peers.",
        &[
            "code",
            "setting",
            "free rocking",
            "pulse without impact",
            "pulse with impacts",
            "record",
            "hard",
            "wrong fates",
        ],
        codes.chunk_by(same).map(row).collect(),
    )
}

/// The figure of that table.
///
/// # Errors
/// Where our own answers are refused.
pub fn codes_figure() -> anyhow::Result<Figure> {
    let own = score(&own_answers().map_err(anyhow::Error::msg)?);
    let codes = codes();
    let chart = codes_chart(&own, &codes);
    let heading = Heading { place: Place::Others, ..chart.heading };
    let best: Vec<&Code> =
        codes.iter().filter(|code| code.setting == SETTINGS[1]).collect();
    let by_code = best.chunk_by(|a, b| a.code == b.code);
    let right = |code: &&[&Code]| code.iter().all(|c| c.median_digits >= MANY);
    let (many, few): (Vec<_>, Vec<_>) = by_code.partition(right);
    let few = few.into_iter().flatten().map(|code| code.median_digits);
    let most = few.fold(0.0, f64::max);
    Ok(Chart { heading, ..chart }.figure(format!(
        "With the best settings, {} of {} codes have a median of {MANY} digits \
         or more on every level; the others have at most {most:.1} on any.",
        many.len(),
        best.chunk_by(|a, b| a.code == b.code).count()
    )))
}

/// Digits that only a code without a model error has.
const MANY: f64 = 10.0;

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
