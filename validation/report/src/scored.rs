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
    Code, CodeVerdict, Explanation, QuantityScore, Score, Value, codes,
    own_answers, reference, score,
};

/// The page of a score: one file, without scripts and network.
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
                            "Digits: −log10 of the relative error, between 0 \
                             and the most that double precision can give, \
                             which is 15 minus log10 of the condition number."
                        }
                    }
                    h2 { "Answers with missing digits" }
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

/// The scores of a code in one setting, a row for each level.
type LevelRows = Vec<Code>;

/// Median digits, the fewest and the most of any level.
fn extremes(code: &LevelRows) -> (f64, f64) {
    range(code.iter().map(|row| row.median_digits))
}

/// Number of wrong outcomes, and of all outcomes answered.
fn outcomes(code: &LevelRows) -> (usize, usize) {
    let sum = |of: fn(&Code) -> usize| code.iter().map(of).sum();
    (sum(|row| row.fates_wrong), sum(|row| row.fates_answered))
}

/// This program, then each known code in each setting; and the levels.
fn scored_codes() -> anyhow::Result<(Vec<LevelRows>, Vec<String>)> {
    let own = score(&own_answers().map_err(anyhow::Error::msg)?);
    let first = own.levels.iter().map(|level| Code {
        code: "rocking".into(),
        setting: "as shipped".into(),
        version: env!("CARGO_PKG_VERSION").into(),
        level: level.level,
        median_digits: level.median_digits.unwrap_or(f64::NAN),
        worst_digits: level.worst_digits.unwrap_or(f64::NAN),
        fates_wrong: level.fates_wrong,
        fates_answered: level.fates_right + level.fates_wrong,
    });
    let all: LevelRows = first.chain(codes()).collect();
    let same =
        |a: &Code, b: &Code| (&a.code, &a.setting) == (&b.code, &b.setting);
    let levels = own.levels.iter().map(|level| level.kind.clone()).collect();
    Ok((all.chunk_by(same).map(<[_]>::to_vec).collect(), levels))
}

/// Median digits of this program, and of known codes in these settings, level
/// by level.
///
/// # Errors
/// If our own answers are refused.
pub fn codes_table(settings: &[&str]) -> anyhow::Result<PlainTable> {
    let (mut codes, levels) = scored_codes()?;
    let explained = explained(settings, &codes);
    let own = codes.remove(0);
    codes.retain(|code| settings.contains(&code[0].setting.as_str()));
    let row = |code: &LevelRows| {
        let Code { code: name, version, setting, .. } = &code[0];
        let name = format!("{name} {version}");
        let (wrong, all) = outcomes(code);
        let digits = code.iter().map(|row| digits(Some(row.median_digits)));
        let first = [name.trim_end().into(), setting.clone()].into_iter();
        first.chain(digits).chain([format!("{wrong} of {all}")]).collect()
    };
    let names = ["code", "setting"].into_iter();
    let names = names.chain(levels.iter().map(String::as_str));
    let header: Vec<&str> = names.chain(["wrong outcomes"]).collect();
    Ok(PlainTable::new(
        "other-codes",
        "How do other codes compare?",
        format!(
            "Median digits of the answers of this program and of other codes \
             to the reference data set (fixtures/benchmark), by level of \
             difficulty. {explained}Double precision can give 14 to 15 digits \
             if a scene is well conditioned. Physics engines, OpenSees and \
             the penalty model (a block on springs and dampers) have no \
             linearized equation, so they answer 54 of 65 outcomes. \
             validation/peers lists the codes that could not be made to \
             rock, and why."
        ),
        &header,
        [own].iter().chain(&codes).map(row).collect(),
    ))
}

/// The meaning of each setting shown, and the codes with more wrong outcomes
/// in the finest setting than as shipped.
fn explained(settings: &[&str], codes: &[LevelRows]) -> String {
    let mut out = String::new();
    for (setting, words) in SETTINGS.into_iter().zip([
        "as the code is shipped",
        "the smallest steps and tightest tolerances tried",
    ]) {
        if settings.contains(&setting) {
            out += &format!("`{setting}`: {words}. ");
        }
    }
    let wrong = |name: &str, setting| {
        let is = |own: &&LevelRows| {
            (own[0].code.as_str(), own[0].setting.as_str()) == (name, setting)
        };
        codes.iter().find(is).map_or(0, |own| outcomes(own).0)
    };
    for code in codes.chunk_by(|a, b| a[0].code == b[0].code) {
        let name = &code[0][0].code;
        let [shipped, finest] = SETTINGS.map(|setting| wrong(name, setting));
        if finest > shipped {
            out += &format!(
                "With `best`, {name} has {finest} wrong outcomes; as shipped, \
                 it has {shipped}. "
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
    let finest = codes.iter().filter(|code| code[0].setting == SETTINGS[1]);
    let ranks: BTreeMap<String, (f64, f64)> =
        finest.map(|own| (own[0].code.clone(), extremes(own))).collect();
    // This program first, then the codes by their finest setting.
    codes[1..].sort_by(|a, b| {
        let rank = |code: &LevelRows| ranks[&code[0].code].0;
        rank(b).total_cmp(&rank(a))
    });
    let many = ranks.values().filter(|(least, _)| *least >= MANY).count();
    let few = ranks.values().filter(|(least, _)| *least < MANY);
    let most = range(few.map(|(_, most)| *most)).1;
    let reading = format!(
        "Each mark is the median number of correct digits over the scenes of \
         one level of difficulty. With the finest settings tried (`best`), \
         {many} of {} other codes reach {MANY} digits or more on every level; \
         the rest reach at most {most:.1} on any. `default`: as shipped. \
         `rocking` is this program.",
        ranks.len()
    );
    let mut series = Vec::new();
    for (k, code) in codes.iter().enumerate() {
        // The first row is the highest.
        let row = (codes.len() - k) as f64;
        let line = Mark::Across(Pen::new(Ink::Grid, 0.8));
        series.push(Series::note(line, "", (f64::NAN, row)));
        for (own, level) in code.iter().zip(&levels) {
            // Beside each other, not on each other.
            let y = row + APART * (3.0 - f64::from(own.level));
            let mark = Series::new(
                level,
                Mark::Points,
                vec![own.median_digits],
                vec![y],
            );
            let keys = [&own.code, &own.setting, level].map(String::clone);
            series.push(mark.keyed(keys));
        }
    }
    let name =
        |code: &LevelRows| format!("{}, {}", code[0].code, code[0].setting);
    let panel = ChartPanel::new(
        "",
        ChartAxis::linear("median number of correct digits", (0.0, 15.5)),
        ChartAxis::named(codes.iter().rev().map(name).collect()),
        series,
    );
    let chart = Chart::of(
        [
            "codes",
            "Digits by level of difficulty, this program and other codes",
            "Rows of marks, a row for each code and setting: median number of \
             correct digits on each of five levels of scenes, from free \
             rocking to hard cases.",
        ],
        vec![panel],
    );
    let heading = Heading { place: Place::Others, ..chart.heading };
    let grid = Grid::new(1, 1).plot(560.0, ROW_PX * codes.len() as f64);
    let grid = Some(Grid { left: NAMES_PX, ..grid });
    let keys = ["code", "setting", "level"];
    let layout = Layout::of(&keys, &[("median_digits", Of::X)]);
    let layout = Layout { grid, ..layout };
    Ok(Chart { heading, ..chart }.laid_out(&layout, reading))
}

/// Digits that only a code without a model error has.
const MANY: f64 = 10.0;
/// Distance of neighbouring levels within a row.
const APART: f64 = 0.15;
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
                "The cause is not among the known mistakes: no single one, and \
                 no pair that was tried, explains the answers."
            }
            CodeVerdict::Coarse => p {
                "None of the known mistakes: the answers are right, but coarse."
            }
            CodeVerdict::TooFew => p { "Too few answers for a verdict." }
            CodeVerdict::Known => {
                @if found.explanations.len() > 1 {
                    p {
                        "These answers fit each of the following \
                         explanations:"
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
        @for remark in &found.remarks { p { (remark) } }
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

/// A number of digits; a dash if there is none.
fn digits(x: Option<f64>) -> String {
    x.map_or("–".into(), |x| format!("{x:.1}"))
}

/// A column: its head, and its cell of a row.
type ScoreColumn<'a, T> = (&'a str, &'a dyn Fn(&T) -> String);

/// A table of rows.
fn by_columns<T>(
    [name, title, reading]: [&str; 3],
    rows: &[T],
    columns: &[ScoreColumn<'_, T>],
) -> PlainTable {
    let header: Vec<&str> = columns.iter().map(|(head, _)| *head).collect();
    let row = |row| columns.iter().map(|(_, cell)| cell(row)).collect();
    let rows = rows.iter().map(row).collect();
    PlainTable::new(name, title, reading, &header, rows)
}

fn levels(score: &Score) -> Markup {
    let percent = |share| format!("{:.0} %", 100.0 * share);
    let words = ["levels", "Digits", "Digits, outcomes and counts by level."];
    table::untitled(&by_columns(
        words,
        &score.levels,
        &[
            ("Level", &|l| format!("{}, {}", l.level, l.kind)),
            ("Numbers answered", &|l| {
                format!("{} of {}", l.answered, l.asked)
            }),
            ("Median digits", &|l| digits(l.median_digits)),
            ("Fewest digits", &|l| digits(l.worst_digits)),
            ("Share with all attainable digits", &|l| {
                l.attained_share.map_or("–".into(), percent)
            }),
            ("Outcomes right", &|l| l.fates_right.to_string()),
            ("Outcomes wrong", &|l| l.fates_wrong.to_string()),
            ("Outcomes missing", &|l| l.fates_missing.to_string()),
            ("Counts right", &|l| l.counts_right.to_string()),
            ("Counts wrong", &|l| l.counts_wrong.to_string()),
        ],
    ))
}

/// Most lines of the table of answers with missing digits.
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
    if all.is_empty() {
        return html! {
            p { "None: every answer has all attainable digits." }
        };
    }
    let shown = all.len().min(MOST);
    let reading =
        format!("{} answers; the {shown} that lack the most:", all.len());
    table::untitled(&by_columns(
        ["lacking", "Answers with missing digits", &reading],
        &all[..shown],
        &[
            ("Scene", &|q| q.scene.to_string()),
            ("Quantity", &|q| q.quantity.to_string()),
            ("Answer", &|q| text(&q.value)),
            ("Certified", &|q| text(q.certified)),
            ("Digits", &|q| digits(q.digits)),
            ("Attainable", &|q| digits(q.attainable_digits)),
        ],
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
    fn a_page_says_what_deviates() {
        let mut answers = own_answers().unwrap();
        for (place, item) in reference().items.iter().enumerate() {
            if item.quantity == "peak_ratio" {
                let x = answers.get(place).and_then(Value::number).unwrap();
                answers.set(place, Some(Value::Number(2.0 * x)));
            }
        }
        let page = page(&score(&answers));
        let words = "peak_ratio: the 30 answers are the certified values \
                     times 2.";
        assert!(page.contains(words), "{page}");
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
