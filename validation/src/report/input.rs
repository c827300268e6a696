//! The page of a study: its words, for [`super::page`].

use rocking::block::{BlockError, Restitution};
use rocking::integrator::Overturning;

use super::evidence::{self, NOT_RUN, Proof};
use super::page::{Finding, ReportInput, ShownFigure};
use super::summary::summary;
use super::timings::Timings;
use super::{ReportError, credibility, ledger};
use crate::draw::figures::Figure;
use crate::findings::Claim;
use crate::paper::{BLOCKS, GRAVITY_M_S2};
use crate::study::figures::Results;
use crate::study::questions::Answer;
use crate::table::PlainTable;
use crate::words::rounded_text;

/// What the page shows; `proof` are the results of the declared cases, if
/// they were handed in.
///
/// # Errors
/// [`ReportError`] where a figure cannot be drawn.
pub fn input(
    results: &Results,
    figures: &[Figure],
    charts: &[Figure],
    claims: &[Claim],
    answers: &[Answer],
    proof: Option<&Proof>,
) -> Result<ReportInput, ReportError> {
    let timings = Timings::kept()?;
    let mut drawn: Vec<ShownFigure> =
        figures.iter().chain(charts).map(shown).collect();
    drawn.push(ShownFigure {
        number: "Speed".into(),
        ..shown(&timings.figure())
    });
    let names: Vec<&str> =
        figures.iter().map(|f| f.heading.name.as_str()).collect();
    Ok(ReportInput {
        title: "The statistics of rocking".into(),
        subtitle: "Statistical property parameterization of simple rocking \
                   block response, repeated from records to findings"
            .into(),
        summary: summary(results, claims, &timings, proof),
        findings: claims.iter().map(|c| finding(c, &names)).collect(),
        proof: proof.map_or(NOT_RUN.into(), Proof::to_string),
        families: proof.map(evidence::shown).transpose()?.unwrap_or_default(),
        tables: tables(answers, proof)?,
        figures: drawn,
        provenance: provenance(results),
        limits: limits(results),
        credibility: credibility(results, claims, &timings, proof)?,
    })
}

fn credibility(
    results: &Results,
    claims: &[Claim],
    timings: &Timings,
    proof: Option<&Proof>,
) -> Result<Vec<PlainTable>, ReportError> {
    let cases = proof.map(Proof::results);
    let mut tables = vec![ledger::table(cases, claims)?];
    tables.extend(credibility::tables(results, claims, proof));
    tables.extend(timings.tables());
    Ok(tables)
}

fn tables(
    answers: &[Answer],
    proof: Option<&Proof>,
) -> Result<Vec<PlainTable>, ReportError> {
    let mut tables = vec![table_1()?];
    tables.extend(proof.map(Proof::digits_table));
    for answer in answers {
        tables.extend(answer.tables.iter().cloned());
    }
    Ok(tables)
}

/// The figures among `names` that a claim is about: those of its section, in
/// its arm where there is one for each.
fn shown_by(claim: &Claim, names: &[&str]) -> Vec<String> {
    let mut out = Vec::new();
    for number in claim.section.figures() {
        let stem = format!("figure-{number:02}");
        let own = claim
            .arm
            .map(|arm| format!("{stem}-{}", arm.letter().to_lowercase()));
        let found = names
            .iter()
            .find(|name| own.as_deref() == Some(**name))
            .or_else(|| names.iter().find(|name| name.starts_with(&stem)));
        out.extend(found.map(|name| (*name).to_owned()));
    }
    out
}

/// What stands where no interval does.
fn no_interval(claim: &Claim) -> String {
    match (&claim.suites[..], claim.margin.as_str()) {
        ([], _) => "computed, not sampled",
        (_, "none") => "counted, all of them",
        _ => "none stated: the value alone decides",
    }
    .into()
}

fn suite_words(claim: &Claim) -> &str {
    match claim.suites[..] {
        [] => "no records",
        [suite] => suite.name(),
        _ => "both suites",
    }
}

fn finding(claim: &Claim, names: &[&str]) -> Finding {
    let arm = claim
        .arm
        .map_or(String::new(), |arm| format!(", arm {}", arm.letter()));
    let interval = claim.measured.interval;
    let interval = interval.map_or_else(
        || no_interval(claim),
        |(a, b)| format!("{} to {}, 95 %", rounded_text(a), rounded_text(b)),
    );
    Finding {
        id: claim.id.clone(),
        claim: claim.quote.clone(),
        source: format!("paper, section {}", claim.section),
        tested_on: format!("{}, {}{arm}", suite_words(claim), claim.blocks),
        measure: claim.measure.clone(),
        value: rounded_text(claim.measured.value),
        interval,
        margin: claim.margin.clone(),
        verdict: claim.verdict,
        figures: shown_by(claim, names),
        remark: claim.note.clone(),
    }
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
    Ok(PlainTable {
        name: "table-01".into(),
        title: "Table 1. The 15 blocks".into(),
        reading: "Gravity 9.81 m/s2; eta is Housner's coefficient of \
                  restitution, which the study does not use."
            .into(),
        header: header.map(String::from).into(),
        rows,
    })
}

/// A length in m with three decimals, half a millimetre up as the paper
/// rounds it: `{:.3}` takes 7.3575 down, whose double lies below it.
fn millimetres(length_m: f64) -> String {
    format!("{:.3}", (1e3 * length_m).round() / 1e3)
}

fn shown(figure: &Figure) -> ShownFigure {
    let heading = &figure.heading;
    let digits: String =
        heading.name.chars().filter(char::is_ascii_digit).collect();
    let number = digits.trim_start_matches('0');
    // Figures that both arms have end in the arm's letter.
    let both = heading.name.len() > "figure-00".len();
    let arm = heading
        .arm
        .filter(|_| both)
        .map_or(String::new(), |arm| format!(", arm {}", arm.letter()));
    ShownFigure {
        name: heading.name.clone(),
        number: if number.is_empty() {
            "Beyond the paper".into()
        } else {
            format!("Figure {number}{arm}")
        },
        title: heading.title.clone(),
        reading: figure.reading.clone(),
        svg: figure.svg(),
        csv: figure.csv.clone(),
        csv_path: format!("data/{}.csv", heading.name),
    }
}

fn provenance(results: &Results) -> Vec<(String, String)> {
    let setup = results.plan.setup;
    let mut out = vec![
        ("Version".into(), env!("CARGO_PKG_VERSION").into()),
        (
            "Restitution".into(),
            format!("{}", setup.restitution.velocity_ratio()),
        ),
        (
            "Overturning".into(),
            match setup.overturning {
                Overturning::Alpha => "|theta| reaches alpha".into(),
                Overturning::HalfPi => "|theta| exceeds pi/2".into(),
            },
        ),
        (
            "Refinement".into(),
            format!("{} in dimensionless intensity", setup.tolerance),
        ),
    ];
    for arm in &results.plan.arms {
        out.push(("Arm of the grid".into(), arm.words().into()));
    }
    for suite in [&results.ordinary, &results.pulse] {
        out.push((
            format!("Suite, {}", suite.kind),
            format!(
                "{}, {} records, component: {}, sha256 {}",
                suite.source,
                suite.records.len(),
                suite.component_rule,
                suite.sha256
            ),
        ));
        if let Some(remarks) = &suite.remarks {
            let name = format!("Remarks on records, {}", suite.kind);
            out.push((name, remarks.clone()));
        }
    }
    out
}

pub(super) fn limits(results: &Results) -> Vec<String> {
    let mut out = vec![
        "The block is planar, rigid and slides nowhere; the paper's model."
            .into(),
        "The paper does not list its records; these suites are like its \
         suites, not the same."
            .into(),
        "Percentages of accepted levels share records from level to level \
         and are not independent."
            .into(),
    ];
    if results.embedded() {
        out.push(
            "The embedded suites are synthetic, from published stochastic \
             models; they can show how the procedure works, not what \
             recorded motions do."
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
