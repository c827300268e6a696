//! Annexes of the page: folded on a screen, left out on paper.

use maud::{Markup, html};
use rocking::block::{BlockError, Restitution};

use super::chapter::{drawings, tables};
use super::content::Page;
use crate::basis::FindingSets;
use crate::evidence::{self, Proof};
use crate::law::LawCells;
use crate::ledger;
use crate::scored;
use rocking_common::paper::{BLOCKS, GRAVITY_M_S2};
use rocking_common::table::PlainTable;
use rocking_common::words::capital;
use rocking_draw::figures::{Figure, Place};
use rocking_study::questions::StudyAnswer;

/// Text, figures and tables under a heading.
#[derive(Default)]
pub(crate) struct Annex<'a> {
    /// Unique name, also the anchor.
    pub id: &'static str,
    /// The heading.
    pub title: &'static str,
    /// Paragraphs.
    text: Vec<String>,
    /// Figures.
    figures: Vec<&'a Figure>,
    /// Tables.
    pub tables: Vec<PlainTable>,
    /// Whether the tables are written as files, because no other file has
    /// their numbers.
    pub is_filed: bool,
}

impl<'a> Annex<'a> {
    fn new(
        id: &'static str,
        title: &'static str,
        tables: Vec<PlainTable>,
    ) -> Self {
        Self { id, title, tables, ..Self::default() }
    }

    fn with(self, figures: Vec<&'a Figure>) -> Self {
        Self { figures, ..self }
    }

    fn filed(self) -> Self {
        Self { is_filed: true, ..self }
    }

    /// What stands under the heading.
    pub fn body(&self) -> Markup {
        html! {
            @for words in &self.text { p { (words) } }
            (drawings(&self.figures))
            (tables(self.title, &self.tables))
        }
    }
}

/// The annexes that have something to show, in order.
///
/// # Errors
/// For kept files that cannot be read.
pub(crate) fn annexes<'a>(page: &Page<'a>) -> anyhow::Result<Vec<Annex<'a>>> {
    let Page { study, basis, proof, .. } = page;
    let claims = &basis.here.claims;
    let coverage = proof.map(Proof::coverage);
    let (compared, others): (Vec<&StudyAnswer>, Vec<&StudyAnswer>) =
        study.answers.iter().partition(|q| q.id == "suites");
    let on_grid = page.figures.iter();
    let on_grid = on_grid.filter(|f| page.is_on_the_papers_grid(f));
    let others =
        others.into_iter().flat_map(|question| answered(question, basis));
    let compared = compared.into_iter().flat_map(|q| q.tables.clone());
    let law = LawCells::kept()?;
    let requirements =
        ledger::table(proof.map(Proof::results), claims, page.figures)?;
    let mut all = vec![
        Annex {
            text: basis.work(),
            ..Annex::new("blocks", "The blocks", vec![table_1()?]).filed()
        },
        Annex::new(
            "checks",
            "Digits, pulses, similarity",
            evidence::checks(*proof),
        )
        .with(page.placed(Place::Checks)),
        Annex::new(
            "inference",
            "Coverage of the intervals",
            coverage.iter().map(|c| c.table()).collect(),
        ),
        Annex::new(
            "paper-s-grid",
            "Figures on the paper's grid (grid A)",
            Vec::new(),
        )
        .with(on_grid.collect()),
        Annex {
            text: basis.figures_here().into_iter().collect(),
            ..Annex::new(
                "beyond",
                "Questions beyond the paper",
                others.collect(),
            )
        }
        .with(page.placed(Place::Beyond)),
        Annex::new(
            "suites-by-block",
            "Suites: motions, and capacities block by block",
            compared.collect(),
        )
        .with(page.placed(Place::SuitesByBlock)),
        Annex {
            text: vec![law.formula()],
            ..Annex::new(
                "law-of-avgsa",
                "One curve: the law of AvgSA by suite",
                vec![law.table()?, law.parts()],
            )
            .filed()
        },
        Annex::new(
            "others",
            "How do other codes do?",
            vec![scored::codes_table(&scored::SETTINGS)?],
        )
        .with(page.placed(Place::Others))
        .filed(),
        Annex::new("requirements", "Requirements", vec![requirements]).filed(),
    ];
    all.retain(|one| !(one.tables.is_empty() && one.figures.is_empty()));
    Ok(all)
}

/// The tables of a question, with what the recorded suites answer.
fn answered(
    question: &StudyAnswer,
    basis: &FindingSets<'_>,
) -> Vec<PlainTable> {
    let mut tables = question.tables.clone();
    let other = basis.recorded().filter_map(|(name, found)| {
        let mut all = found.questions.iter();
        let kept = all.find(|kept| kept.id == question.id)?;
        let words = format!("\n{}: {}", capital(name), kept.answer);
        (kept.answer != question.answer).then_some(words)
    });
    let other: String = other.collect();
    if let Some(table) = tables.first_mut()
        && !other.is_empty()
    {
        table.reading = format!("Embedded: {}{other}", table.reading);
    }
    tables
}

/// Table 1, with the paper's gravity.
///
/// # Errors
/// None in practice: all blocks are in range.
fn table_1() -> Result<PlainTable, BlockError> {
    let rows = BLOCKS
        .iter()
        .map(|block| {
            let size = block.dimensions(GRAVITY_M_S2)?;
            let eta = Restitution::housner(block)?.velocity_ratio();
            Ok(vec![
                format!("{}", block.frequency_rad_s()),
                format!("{:.2}", block.slenderness_rad()),
                millimetres(size.width_m),
                millimetres(size.height_m),
                millimetres(size.half_diagonal_m),
                format!("{eta:.4}"),
            ])
        })
        .collect::<Result<Vec<Vec<String>>, BlockError>>()?;
    let header =
        ["p (rad/s)", "alpha (rad)", "2b (m)", "2h (m)", "R (m)", "eta"];
    Ok(PlainTable::new(
        "table-01",
        "Table 1. The 15 blocks",
        "Gravity 9.81 m/s2; eta is Housner's coefficient of \
                  restitution, which the study does not use.",
        &header,
        rows,
    ))
}

/// A length in m with three decimals, half a millimetre up as the paper
/// rounds it: `{:.3}` takes 7.3575 down, whose double lies below it.
fn millimetres(length_m: f64) -> String {
    format!("{:.3}", (1e3 * length_m).round() / 1e3)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn table_1_rounds_as_the_paper_does() {
        let rows = table_1().expect("table").rows;
        let radii: Vec<&str> = rows.iter().map(|r| r[4].as_str()).collect();
        assert_eq!(radii[..5], ["7.358"; 5]);
        assert_eq!(radii[5..10], ["0.818"; 5]);
        assert_eq!(radii[10..], ["0.460"; 5]);
        assert_eq!(rows[0][2..4], ["0.735", "14.697"]);
    }

    #[test]
    fn the_committed_table_1_is_of_this_program() {
        let table = table_1().expect("table");
        let kept = concat!(
            env!("CARGO_MANIFEST_DIR"),
            "/../../reports/data/table-01.csv"
        );
        let kept = std::fs::read_to_string(kept).expect("read");
        let rows = table.rows.iter().map(|row| row.join(","));
        assert!(kept.lines().skip(1).eq(rows), "{kept}");
    }
}
