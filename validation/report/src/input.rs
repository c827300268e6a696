//! The page of a study: its words, for [`super::page`].

use rocking::block::{BlockError, Restitution};
use rocking::integrator::Overturning;

use crate::answers;
use crate::basis::Basis;
use crate::credibility;
use crate::evidence::{self, NOT_RUN, Proof};
use crate::findings::{self, placed};
use crate::head;
use crate::head::Signatures;
use crate::ledger;
use crate::page::{Chapter, ReportInput};
use crate::scored;
use crate::timings::Timings;
use crate::verdicts;
use crate::words::words;
use rocking_common::findings::Findings;
use rocking_common::paper::{Arm, BLOCKS, GRAVITY_M_S2};
use rocking_common::table::PlainTable;
use rocking_common::words::capital;
use rocking_draw::figures::{Figure, Place};
use rocking_study::questions::Answer;
use rocking_study::results::Results;

/// Title of the page.
pub(super) const TITLE: &str = "The statistics of rocking";

/// What the page shows; `proof` are the results of the declared cases, if
/// they were handed in.
///
/// # Errors
/// Where a figure cannot be drawn.
pub(crate) fn input<'a>(
    results: &Results,
    figures: &'a [Figure],
    charts: &'a [Figure],
    basis: &Basis<'_>,
    questions: &[Answer],
    proof: Option<&Proof>,
    signatures: &Signatures,
) -> anyhow::Result<ReportInput<'a>> {
    let timings = Timings::kept()?;
    let words = words()?;
    let (found, recorded) = (basis.here, basis.recorded());
    // Of figures that both arms have, those of the paper's grid stand in the
    // annex.
    let both = results.plan.drawn().len() > 1;
    let (other, own): (Vec<&Figure>, Vec<&Figure>) = figures
        .iter()
        .partition(|f| both && f.heading.own_arm() == Some(Arm::A));
    let charts: Vec<&Figure> = charts.iter().collect();
    let rows = answers::rows(basis, &timings, proof, &own)?;
    let compared = || questions.iter().filter(|q| q.id == "suites");
    let work = basis.all().into_iter().flat_map(verdicts::work);
    let suites = Chapter {
        text: compared().map(|q| q.answer.clone()).collect(),
        figures: placed(&own, Place::Suites),
        ..Chapter::titled("suites", "Suites")
    };
    let by_block = Chapter {
        tables: compared().flat_map(|q| q.tables.clone()).collect(),
        figures: placed(&own, Place::SuitesByBlock),
        ..Chapter::titled(
            "suites-by-block",
            "Suites: motions, and capacities block by block",
        )
    };
    let beyond = Chapter {
        tables: questions
            .iter()
            .filter(|q| q.id != "suites")
            .flat_map(|q| answered(q, recorded))
            .collect(),
        figures: placed(&own, Place::Beyond),
        ..Chapter::titled("beyond", "Questions beyond the paper")
    };
    let claims = &found.claims;
    let (ledger, mut trust) = (
        ledger::table(proof.map(Proof::results), claims, figures)?,
        credibility::tables(results, claims, proof, recorded)?,
    );
    // The assessment is short; the comparison has a row for each result.
    let assessment = trust.split_off(trust.len().saturating_sub(1));
    let coverage = proof.map(Proof::coverage).transpose()?;
    let only = |id, title: &str, tables| Chapter {
        tables,
        ..Chapter::titled(id, title)
    };
    Ok(ReportInput {
        title: TITLE.into(),
        intro: vec![words.intro, answers::done(basis)],
        lab: false,
        head: [
            head::head(results, proof.is_some(), signatures),
            recorded.map(findings::kept).unwrap_or_default(),
            provenance(results),
        ]
        .concat(),
        signatures: signatures.shown(),
        answers: rows,
        otherwise: answers::otherwise(basis)?,
        scope: Chapter {
            text: words.scope,
            folded: vec![only(
                "criteria",
                "Acceptance criteria",
                vec![findings::criteria(found)],
            )],
            ..Chapter::titled("scope", "Scope")
        },
        first: placed(&own, Place::Answers),
        columns: findings::columns(basis),
        findings: findings::themes(basis, &own),
        identities: findings::identities(found),
        method: [
            words.method,
            vec![verdicts::trust(basis)],
            coverage.iter().map(|c| c.words()).collect(),
        ]
        .concat(),
        glossary: words.glossary,
        proof: format!(
            "{} {} {} (annex).",
            proof.map_or(NOT_RUN.into(), Proof::to_string),
            timings.accuracy(),
            capital(&basis.rounding())
        ),
        families: proof.map(evidence::shown).transpose()?.unwrap_or_default(),
        evidence: Chapter {
            figures: placed(&charts, Place::Proof),
            ..Chapter::default()
        },
        chapters: vec![
            Chapter {
                text: vec![timings.plain()],
                figures: placed(&charts, Place::Speed),
                folded: vec![only(
                    "settings",
                    "Which of our settings when",
                    vec![timings.settings()],
                )],
                ..Chapter::titled("speed", "Speed against error")
            },
            suites,
            Chapter {
                text: [
                    limits(results),
                    vec![format!(
                        "No test was compared with the model. It leaves out \
                         {}. {}.",
                        answers::LEFT_OUT,
                        answers::not_run(basis)
                    )],
                    assessment.iter().map(credibility::levels).collect(),
                ]
                .concat(),
                folded: vec![
                    Chapter {
                        list: words.deviations,
                        ..Chapter::titled(
                            "deviations",
                            "Deviations from the paper",
                        )
                    },
                    only(
                        "credibility",
                        "Credibility, after NASA-STD-7009B",
                        assessment,
                    ),
                    Chapter {
                        list: words.references,
                        ..Chapter::titled("references", "References")
                    },
                ],
                ..Chapter::titled("limits", "Limits and references")
            },
        ],
        files: PlainTable::default(),
        annexes: vec![
            Chapter {
                text: work.collect(),
                tables: vec![table_1()?],
                ..Chapter::titled("blocks", "The blocks")
            },
            Chapter {
                tables: evidence::checks(proof)?,
                figures: placed(&charts, Place::Checks),
                ..Chapter::titled(
                    "checks",
                    "Digits, pulses, critical values, similarity",
                )
            },
            only(
                "inference",
                "Coverage of the intervals",
                coverage.iter().map(|c| c.table()).collect(),
            ),
            Chapter {
                figures: other,
                ..Chapter::titled(
                    "paper-s-grid",
                    "Figures on the paper's grid (arm A)",
                )
            },
            beyond,
            by_block,
            only("comparison", "Comparison with printed numbers", trust),
            only(
                "speed-tried",
                "Speed: other tools, and settings tried",
                timings.tables(),
            ),
            Chapter {
                tables: vec![scored::codes_table(&scored::SETTINGS)?],
                figures: placed(&charts, Place::Others),
                ..Chapter::titled("others", "How do others do?")
            },
            only("requirements", "Requirements", vec![ledger]),
        ]
        .into_iter()
        .filter(|c| !(c.tables.is_empty() && c.figures.is_empty()))
        .collect(),
    })
}

/// The tables of a question, with what the recorded suites answer.
fn answered(
    question: &Answer,
    recorded: Option<&Findings>,
) -> Vec<PlainTable> {
    let mut tables = question.tables.clone();
    let kept = recorded.iter().flat_map(|found| &found.questions);
    let kept = kept.into_iter().find(|q| q.id == question.id);
    if let (Some(kept), Some(table)) = (kept, tables.first_mut())
        && kept.answer != question.answer
    {
        table.reading = format!(
            "Embedded suites: {}\nRecorded suites: {}",
            table.reading, kept.answer
        );
    }
    tables
}

/// Table 1, with the paper's gravity.
///
/// # Errors
/// None in practice: all blocks are in range.
pub fn table_1() -> Result<PlainTable, BlockError> {
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

pub(super) fn provenance(results: &Results) -> Vec<(String, String)> {
    let setup = &results.plan.setup;
    let overturning = match setup.overturning {
        Overturning::Alpha => "|theta| reaches alpha",
        Overturning::HalfPi => "|theta| exceeds pi/2",
    };
    let refinement = format!("{} in dimensionless intensity", setup.tolerance);
    let arms = results.plan.arms.iter();
    let arms: Vec<&str> = arms.map(|arm| arm.words()).collect();
    let restitution = setup.restitution.velocity_ratio().to_string();
    let mut out = vec![
        ("Revisions".into(), head::revisions()),
        ("Restitution".into(), restitution),
        ("Overturning".into(), overturning.into()),
        ("Refinement".into(), refinement),
        ("Arms of the grid".into(), arms.join("; ")),
    ];
    for suite in results.suites() {
        let (records, rule) = (suite.records.len(), &suite.component_rule);
        out.push((
            format!("Suite, {}", suite.kind),
            format!("{records} records, component: {rule}"),
        ));
        if let Some(remarks) = &suite.remarks {
            let name = format!("Remarks on records, {}", suite.kind);
            out.push((name, remarks.clone()));
        }
        if !suite.set_aside.is_empty() {
            let name = format!("Set aside, {} suite", suite.kind);
            out.push((name, suite.set_aside.to_string()));
        }
    }
    out
}

pub(super) fn limits(results: &Results) -> Vec<String> {
    let mut out = vec![
        "The paper does not list its records; these suites are like its \
         suites, not the same."
            .into(),
    ];
    if results.embedded() {
        out.push(
            "The embedded suites are synthetic, from published relations; \
             they can show how the procedure works, not what recorded \
             motions do."
                .into(),
        );
    }
    out
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
}
