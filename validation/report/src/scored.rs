//! The page of a score (the answers of a code against certified ones), and the
//! scores of known codes.

use std::collections::BTreeMap;

use maud::{DOCTYPE, Markup, PreEscaped, html};
use rocking_common::table::PlainTable;
use rocking_common::words::range;
use rocking_draw::colour::{Ink, Pen};
use rocking_draw::figures::of_result::score_svg;
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Layout, Mark, Of, Place,
    Series,
};
use rocking_draw::grid::Grid;
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

/// Settings of the known codes: as shipped, and the finest that was tried.
pub const SETTINGS: [&str; 2] = ["default", "best"];

/// A code in one setting, this program among them.
struct ScoredCode {
    code: String,
    version: String,
    setting: String,
    /// Median digits of each level, and the numbers of wrong and of all
    /// outcomes.
    medians: Vec<Option<f64>>,
    wrong: usize,
    outcomes: usize,
}

impl ScoredCode {
    /// The fewest median digits of any level.
    fn least(&self) -> f64 {
        let known = self.medians.iter().map(|m| m.unwrap_or(f64::NAN));
        range(known).0
    }
}

/// This program, then each known code in each setting; and the levels.
fn scored_codes() -> anyhow::Result<(Vec<ScoredCode>, Vec<String>)> {
    let own = score(&own_answers().map_err(anyhow::Error::msg)?);
    let levels = own.levels.iter();
    let wrong = levels.clone().map(|level| level.fates_wrong).sum();
    let right: usize = levels.clone().map(|level| level.fates_right).sum();
    let first = ScoredCode {
        code: "rocking".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        setting: "as shipped".into(),
        medians: levels.clone().map(|level| level.median_digits).collect(),
        wrong,
        outcomes: wrong + right,
    };
    let all = codes();
    let same =
        |a: &Code, b: &Code| (&a.code, &a.setting) == (&b.code, &b.setting);
    let others = all.chunk_by(same).map(|rows| ScoredCode {
        code: rows[0].code.clone(),
        version: rows[0].version.clone(),
        setting: rows[0].setting.clone(),
        medians: levels
            .clone()
            .map(|own| rows.iter().find(|row| row.level == own.level))
            .map(|row| Some(row?.median_digits))
            .collect(),
        wrong: rows.iter().map(|row| row.fates_wrong).sum(),
        outcomes: rows.iter().map(|row| row.fates_answered).sum(),
    });
    let kinds = levels.clone().map(|level| level.kind.clone()).collect();
    Ok(([first].into_iter().chain(others).collect(), kinds))
}

/// Median digits of this program, and of known codes in these settings, level
/// by level.
///
/// # Errors
/// If our own answers are refused.
pub fn codes_table(settings: &[&str]) -> anyhow::Result<PlainTable> {
    let (codes, levels) = scored_codes()?;
    let is_shown = |code: &&ScoredCode| {
        code.setting == codes[0].setting
            || settings.contains(&code.setting.as_str())
    };
    let row = |code: &ScoredCode| {
        let name = format!("{} {}", code.code, code.version);
        let mut cells = vec![name.trim_end().into(), code.setting.clone()];
        cells.extend(code.medians.iter().map(|median| digits(*median)));
        cells.push(format!("{} of {}", code.wrong, code.outcomes));
        cells
    };
    let names = ["code", "setting"].into_iter();
    let names = names.chain(levels.iter().map(String::as_str));
    let header: Vec<&str> = names.chain(["wrong outcomes"]).collect();
    Ok(PlainTable::new(
        "other-codes",
        "How do others do?",
        format!(
            "Median digits of the answers of this program and of other codes \
             to the reference data set (fixtures/benchmark), by level of \
             difficulty. {}Double precision can give 14 to 15 digits if a \
             scene is well conditioned. Physics engines, OpenSees and the \
             penalty model (a block on springs and dampers) have no \
             linearized equation, so they answer 54 outcomes of 65. \
             validation/peers lists the codes that could not be made to \
             rock, and why.",
            explained(settings, &codes)
        ),
        &header,
        codes.iter().filter(is_shown).map(row).collect(),
    ))
}

/// The meaning of each setting shown, and the codes with more wrong outcomes
/// in the finest setting than as shipped.
fn explained(settings: &[&str], codes: &[ScoredCode]) -> String {
    let mut out = String::new();
    for (setting, words) in [
        (SETTINGS[0], "as the code is shipped"),
        (SETTINGS[1], "the smallest steps and tightest tolerances tried"),
    ] {
        if settings.contains(&setting) {
            out += &format!("`{setting}`: {words}. ");
        }
    }
    for finest in codes.iter().filter(|code| code.setting == SETTINGS[1]) {
        let is_shipped = |other: &&ScoredCode| {
            (&*other.code, &*other.setting) == (&finest.code, SETTINGS[0])
        };
        let shipped = codes.iter().find(is_shipped);
        let shipped = shipped.map_or(0, |shipped| shipped.wrong);
        if finest.wrong > shipped {
            out += &format!(
                "With `best`, {} has {} wrong outcomes; as shipped, it has \
                 {shipped}. ",
                finest.code, finest.wrong
            );
        }
    }
    out
}

/// The figure of that table: a row for each code and setting, a mark for each
/// level.
///
/// # Errors
/// If our own answers are refused.
pub fn codes_figure() -> anyhow::Result<Figure> {
    let (mut codes, levels) = scored_codes()?;
    // This program first, then each code by its finest setting.
    let finest = |code: &str| {
        let of = codes.iter().filter(|other| other.code == code);
        range(of.map(ScoredCode::least)).1
    };
    let ranks: BTreeMap<String, f64> =
        codes.iter().map(|c| (c.code.clone(), finest(&c.code))).collect();
    codes[1..].sort_by(|a, b| {
        let by_rank = ranks[&b.code].total_cmp(&ranks[&a.code]);
        by_rank.then_with(|| (&a.code, &a.setting).cmp(&(&b.code, &b.setting)))
    });
    let is_finest = |code: &&ScoredCode| code.setting == SETTINGS[1];
    let (many, few): (Vec<_>, Vec<_>) =
        codes.iter().filter(is_finest).partition(|c| c.least() >= MANY);
    let medians = few.iter().flat_map(|code| &code.medians);
    let most = range(medians.filter_map(|median| *median)).1;
    let reading = format!(
        "Each mark is the median number of correct digits over the scenes of \
         one level of difficulty. With the finest settings tried (`best`), \
         {} of {} other codes reach {MANY} digits or more on every level; \
         the rest reach at most {most:.1} on any. `default`: as shipped.",
        many.len(),
        many.len() + few.len()
    );
    // The first row is the highest.
    let row = |k: usize| (codes.len() - k) as f64;
    let line = Pen::new(Ink::Grid, 0.8);
    let lines = (0..codes.len())
        .map(|k| Series::note(Mark::Across(line), "", (f64::NAN, row(k))));
    let marks = codes.iter().enumerate().flat_map(|(k, code)| {
        let medians = code.medians.iter().enumerate();
        medians.zip(&levels).map(move |((level, median), name)| {
            // Beside each other, not on each other.
            let y = row(k) + APART * (1.0 - level as f64 / 2.0);
            let x = median.unwrap_or(f64::NAN);
            let keys = [&code.code, &code.setting, name].map(String::clone);
            Series::new(name, Mark::Points, vec![x], vec![y]).keyed(keys)
        })
    });
    let name = |code: &ScoredCode| format!("{}, {}", code.code, code.setting);
    let panel = ChartPanel::new(
        "",
        ChartAxis::linear("median of correct digits", (0.0, 15.5)),
        ChartAxis::named(codes.iter().rev().map(name).collect()),
        lines.chain(marks).collect(),
    );
    let heading = Heading {
        place: Place::Others,
        ..Heading::new(
            "codes",
            "Digits by level of difficulty, this program and other codes",
            "Rows of marks, a row for each code and setting: median number \
             of correct digits on each of five levels of scenes, from free \
             rocking to hard cases.",
        )
    };
    let grid = Grid::new(1, 1).plot(560.0, ROW_PX * codes.len() as f64);
    let grid = Some(Grid { left: NAMES_PX, ..grid });
    let keys = ["code", "setting", "level"];
    let layout = Layout::of(&keys, &[("median_digits", Of::X)]);
    let layout = Layout { grid, ..layout };
    let chart = Chart { heading, panels: vec![panel], columns: 1 };
    Ok(chart.laid_out(&layout, reading))
}

/// Digits that only a code without a model error has.
const MANY: f64 = 10.0;
/// Distance of the first and the third level within a row.
const APART: f64 = 0.3;
/// Height of a row, and room for the names of rows, in px.
const ROW_PX: f64 = 22.0;
const NAMES_PX: f64 = 124.0;

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
    use std::fs;

    use super::*;

    /// Writes the figure where `ROCKING_FIGURES` says, to be looked at.
    #[test]
    fn every_median_of_the_table_is_drawn() {
        let figure = codes_figure().unwrap();
        let svg = figure.svg();
        if let Ok(folder) = std::env::var("ROCKING_FIGURES") {
            fs::write(format!("{folder}/codes.svg"), svg).unwrap();
        }
        let rows = codes_table(&SETTINGS).unwrap().rows.len();
        assert_eq!(figure.csv().lines().count(), 1 + 5 * rows);
        assert!(!figure.reading.contains("inf"), "{}", figure.reading);
    }

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
            let words = format!("With `best`, {code} has");
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
