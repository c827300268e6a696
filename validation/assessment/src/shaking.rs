//! The page of a comparison with shaking-table tests.

mod charts;
mod words;

use std::collections::BTreeMap;

use maud::{Markup, PreEscaped, html};
use rocking::integrator::Model;
use rocking_common::table::columns::COMPARED_TESTS;
use rocking_common::table::{Table, number};
use rocking_draw::figures::{Chart, Layout};
use rocking_draw::grid::Grid;
use rocking_draw::page::inline;
use rocking_procedures::shaking::TestComparison;

pub use words::text;

use crate::{About, PAGE, bytes, data, document, provenance, table};

/// The name of its JSON.
const JSON: &str = "tests.json";
/// Room for words right of a figure of one panel, in px.
const EDGE_PX: f64 = 56.0;
/// The name of its CSV.
const CSV: &str = "tests.csv";

/// The files of a comparison, by their names.
///
/// # Errors
/// None in practice.
pub fn files(
    found: &TestComparison,
    about: &About,
) -> anyhow::Result<BTreeMap<String, Vec<u8>>> {
    let named = [
        (JSON, data::json(found, about)?),
        (CSV, csv(found)),
        (PAGE, page(found, about)),
    ];
    Ok(bytes(named.map(|(name, text)| (name.to_owned(), text))))
}

/// Each test, as CSV.
fn csv(found: &TestComparison) -> String {
    let mut table = Table::of(&COMPARED_TESTS);
    for test in &found.each {
        table.row([
            test.test.clone(),
            test.motion.clone(),
            number(test.pga_g),
            number(test.capacity_factor),
            test.overturns_at_level.to_string(),
            number(test.probability),
            test.overturned.to_string(),
        ]);
    }
    table.finish()
}

/// The page, beside which its other files lie.
pub fn page(found: &TestComparison, about: &About) -> String {
    let title =
        format!("A rigid block against {} shaking-table tests", found.tests);
    let introduction = html! {
        (words::counts(found)) " " (about.ground)
        " The block: " (words::block(found)) ". "
        (words::intervals(found))
    };
    let sections = html! {
        (fates(found))
        (fragility(found))
        (each(found))
        (repeats(found))
        (limits(found))
        (provenance(about, &[JSON, CSV]))
    };
    document(&title, &words::first(found), &introduction, &sections)
}

/// A figure with its number and its words.
fn figure(chart: Chart, number: u8, words: &str) -> Markup {
    let title = &chart.heading.title;
    let wide = chart.panels.len() > 1;
    // One panel is legible in the width of a phone.
    let grid = Grid::new(1, 1).plot(400.0, 300.0);
    let grid = (!wide).then_some(Grid { right: EDGE_PX, ..grid });
    let drawn = chart.laid_out(&Layout { grid, ..Layout::default() }, "");
    html! {
        figure.figure {
            figcaption {
                p.title { "Figure " (number) ". " (title) }
                p { (words) }
            }
            div class={ "scroll drawing" @if wide { " wide" } } role="region"
                aria-label={ (title) ", drawing" } tabindex="0"
            {
                (PreEscaped(inline(&drawn.svg())))
            }
        }
    }
}

fn fates(found: &TestComparison) -> Markup {
    let words = format!(
        "The predicted probability of each test comes from a fit that leaves \
         its motion out. Marks are tenths of the tests in ascending order of \
         this probability, with {} % intervals. Below the line the \
         prediction is too high, above it too low.",
        100.0 * found.level
    );
    html! {
        section {
            h2 { "Outcomes" }
            @if let Some(line) = words::rivals(found) { p { (line) } }
            (table(
                "The block and intensity measures as predictors",
                &words::predictors(found)
            ))
            p {
                "The block is judged by its first overturning: it overturns \
                 in a test at or above that level. A measure predicts \
                 overturning if its probability is above 0.5."
                @if let Some(line) = words::resurrected(found) {
                    " " (line)
                }
            }
            (figure(charts::reliability(found), 1, &words))
        }
    }
}

fn fragility(found: &TestComparison) -> Markup {
    html! {
        section {
            h2 { "Fragility" }
            p {
                @for one in &found.distributions {
                    (words::left_out(one)) " "
                }
            }
            (table(
                "Measured and computed fragilities",
                &words::fragilities(found)
            ))
            @for line in words::unfitted(found) { p { (line) } }
            (figure(
                charts::fragilities(found),
                2,
                "Both curves are fitted in the same way to the same tests: \
                 one to the measured outcomes, one to those of the block. \
                 Marks are shares of overturning in ten classes of equal \
                 numbers of tests."
            ))
            h3 { "Onset of rocking" }
            p { (words::below(found)) }
            (table(
                "Log-likelihood by the part that scatters",
                &words::onsets(found)
            ))
            p {
                "The first two are for the " (found.onset.tests)
                " tests above the onset, the last two for all tests. The \
                 larger one of each pair fits these outcomes better."
            }
        }
    }
}

fn each(found: &TestComparison) -> Markup {
    let lines = if found.alpha_is_fitted {
        "The line is the computed capacity."
    } else {
        "The unbroken line is the computed capacity, the broken one the \
         median of the measured capacity."
    };
    let by = charts::velocity(found).map_or("", |_| {
        " PGV/PGA grows with the period of the motion: a bias that changes \
         from left to right is one of the frequency content."
    });
    let words = format!(
        "{lines} The block overturns in the tests above the line at 1. A \
         filled mark below it and an open mark above it are wrong \
         predictions.{by}"
    );
    html! {
        section {
            h2 { "Each test" }
            (figure(charts::levels(found), 3, &words))
        }
    }
}

fn repeats(found: &TestComparison) -> Markup {
    let all = words::repeatability(found);
    html! {
        @if !all.is_empty() {
            section {
                h2 { "Repeatability of the tests" }
                ul { @for line in &all { li { (line) } } }
            }
        }
    }
}

fn limits(found: &TestComparison) -> Markup {
    let equation = match found.model {
        Model::Nonlinear => "Eq. 1",
        Model::Linearized => "Eq. 2",
    };
    html! {
        section {
            h2 { "Limits" }
            ul {
                li {
                    "These numbers are for this specimen, this table and \
                     these motions. By themselves they do not apply to \
                     another object."
                }
                li {
                    "The model is one rigid block in a plane (" (equation)
                    " of Lachanas, Vamvatsikos and Dimitrakopoulos) with a \
                     sharp base and a constant coefficient of restitution. \
                     The specimen may slide, twist, jump or rock on a rounded \
                     or uneven base."
                }
                li {
                    "The dispersion contains both the faults of the model \
                     and the scatter of the tests."
                }
                @if found.alpha_is_fitted {
                    li {
                        "The slenderness was fitted to the outcomes. Shares \
                         and dispersions of a block that was measured \
                         beforehand would not be better."
                    }
                }
            }
        }
    }
}

#[cfg(test)]
mod tests;
