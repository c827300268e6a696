//! The page of a score, answers of a code beside certified ones, and the
//! scores of known codes.

use maud::{DOCTYPE, Markup, PreEscaped, html};
use rocking_common::table::PlainTable;
use rocking_draw::figures::of_result::{codes_chart, score_svg};
use rocking_draw::figures::{Chart, Figure, Heading, Place};
use rocking_draw::page::{head, table};
use rocking_score::{
    Code, CodeVerdict, Explanation, LevelScore, QuantityScore, Score, Value,
    codes, own_answers, reference, score,
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

/// Medians of each level of this program, and of known codes in these
/// settings.
///
/// # Errors
/// Where our own answers are refused.
pub fn codes_table(settings: &[&str]) -> anyhow::Result<PlainTable> {
    let own = score(&own_answers().map_err(anyhow::Error::msg)?);
    let [wrong, right] = [
        own.levels.iter().map(|level| level.fates_wrong).sum::<usize>(),
        own.levels.iter().map(|level| level.fates_right).sum(),
    ];
    let medians = own.levels.iter().map(|level| digits(level.median_digits));
    let name = format!("rocking {}", env!("CARGO_PKG_VERSION"));
    let first = [name, "as shipped".into()].into_iter().chain(medians);
    let first: Vec<String> =
        first.chain([format!("{wrong} of {}", wrong + right)]).collect();
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
        cells.extend(
            (1..=5)
                .map(|level| digits(median(level).map(|c| c.median_digits))),
        );
        cells.push(format!("{wrong} of {of}"));
        cells
    };
    let others = codes.chunk_by(same).map(row);
    Ok(PlainTable::new(
        "other-codes",
        "How do others do?",
        format!(
            "Median digits of the answers of this program and of other codes \
             to the reference data set (fixtures/benchmark), level by level. {} Double \
             precision gives 14 to 15 digits where a scene is well \
             conditioned. validation/peers lists the codes that could not be \
             made to rock, and why.",
            meant(settings)
        ),
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
        [first].into_iter().chain(others).collect(),
    ))
}

/// What the shown settings are, and which codes the finest do not serve.
fn meant(settings: &[&str]) -> String {
    let mut out = Vec::new();
    if settings.contains(&SETTINGS[0]) {
        out.push("`default`: a code as it is shipped.".to_owned());
    }
    if settings.contains(&SETTINGS[1]) {
        out.push(
            "`best`: a code with the smallest steps and tightest tolerances \
             that were tried."
                .into(),
        );
    }
    let wrong = |name: &str, setting: &str| -> usize {
        let of = |c: &Code| c.code == name && c.setting == setting;
        let own = codes().into_iter().filter(of);
        own.map(|c| c.fates_wrong).sum()
    };
    let all = codes();
    let names = all.chunk_by(|a, b| a.code == b.code).map(|c| &c[0].code);
    for name in names {
        let [shipped, finest] = SETTINGS.map(|setting| wrong(name, setting));
        if finest > shipped {
            out.push(format!(
                "With these {name} has {finest} wrong fates, as shipped \
                 {shipped}."
            ));
        }
    }
    out.join(" ")
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
        "With the finest settings tried, {} of {} codes have a median of {MANY} digits \
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
            CodeVerdict::None => p {
                "None of the known mistakes: the answers agree with the \
                 certified values within a relative scatter of " (scatter)
                " at a condition of 1."
            }
            CodeVerdict::Unknown => p {
                "Something that is not among the known mistakes: no one of \
                 them, and no two that were tried together, explain the \
                 answers."
            }
            CodeVerdict::TooFew => p { "Too few answers for a verdict." }
            CodeVerdict::Known => {
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

/// A number of digits, where there is one.
fn digits(x: Option<f64>) -> String {
    x.map_or("–".into(), |x| format!("{x:.1}"))
}

fn levels(score: &Score) -> Markup {
    let percent = |share| format!("{:.0} %", 100.0 * share);
    let row = |level: &LevelScore| {
        let mut cells = vec![
            format!("{}, {}", level.level, level.kind),
            format!("{} of {}", level.answered, level.asked),
            digits(level.median_digits),
            digits(level.worst_digits),
            level.attained_share.map_or("–".into(), percent),
        ];
        let counts = [
            level.fates_right,
            level.fates_wrong,
            level.fates_missing,
            level.counts_right,
            level.counts_wrong,
        ];
        cells.extend(counts.map(|count| count.to_string()));
        cells
    };
    table::untitled(&PlainTable::new(
        "levels",
        "Digits",
        "Digits, fates and counts, level by level.",
        &[
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
        ],
        score.levels.iter().map(row).collect(),
    ))
}

/// Lines of the table of answers that lack digits.
const MOST: usize = 40;

fn lacking(score: &Score) -> Markup {
    let text = |value: &Value| match value {
        Value::Fate(fate) => fate.clone(),
        Value::Count(n) => n.to_string(),
        Value::Number(x) => format!("{x:.9}"),
    };
    let lacks = |q: &QuantityScore| {
        q.digits.unwrap_or(0.0) - q.attainable_digits.unwrap_or(15.0)
    };
    let mut all: Vec<_> =
        score.quantities.iter().filter(|q| !q.attained).collect();
    all.sort_by(|a, b| lacks(a).total_cmp(&lacks(b)));
    let row = |q: &&QuantityScore| {
        vec![
            q.scene.to_string(),
            q.quantity.to_string(),
            text(&q.value),
            text(q.certified),
            digits(q.digits),
            digits(q.attainable_digits),
        ]
    };
    if all.is_empty() {
        return html! {
            p { "None: every answer has all digits that it can have." }
        };
    }
    let shown = all.len().min(MOST);
    let header =
        ["Scene", "Quantity", "Answer", "Certified", "Digits", "Attainable"];
    table::untitled(&PlainTable::new(
        "lacking",
        "Answers that lack digits",
        format!("{} answers; the {shown} that lack most:", all.len()),
        &header,
        all[..shown].iter().map(row).collect(),
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_code_that_fine_settings_do_not_serve_is_named() {
        let table = codes_table(&SETTINGS).unwrap();
        let wrong = |row: &Vec<String>| -> usize {
            let cell = row.last().unwrap();
            cell.split(' ').next().unwrap().parse().unwrap()
        };
        // This program is among them.
        let own = format!("rocking {}", env!("CARGO_PKG_VERSION"));
        assert_eq!(table.rows[0][0], own);
        assert_eq!(table.rows[0].len(), table.header.len());
        let mut named = 0;
        for row in table.rows.iter().filter(|row| row[1] == "best") {
            let is = |other: &&Vec<String>| {
                other[0] == row[0] && other[1] == "default"
            };
            let shipped = wrong(table.rows.iter().find(is).expect("both"));
            let code = row[0].split(' ').next().unwrap();
            let words = format!("With these {code} has");
            let worse = wrong(row) > shipped;
            assert_eq!(table.reading.contains(&words), worse, "{code}");
            named += usize::from(worse);
        }
        assert!(named > 0, "{}", table.reading);
        // Settings that are not shown are not explained.
        assert!(
            !codes_table(&["best"]).unwrap().reading.contains("`default`")
        );
    }
}
