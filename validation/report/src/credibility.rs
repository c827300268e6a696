//! How far to trust the study: comparison error against uncertainty where
//! the paper prints a number, and a credibility assessment with its gaps.

use rocking::block::{BlockError, Restitution};

use crate::evidence::{NOT_RUN, Proof};
use crate::words::{Factor, Words};
use rocking_common::findings::{Claim, Findings};
use rocking_common::paper::{
    BLOCKS, GRAVITY_M_S2, RESTITUTION, SLENDERNESSES_RAD, closed_form,
};
use rocking_common::table::PlainTable;
use rocking_common::words::rounded_text;
use rocking_statistics::Estimate;
use rocking_study::results::StudyResults;

/// Half width of a finding's 90 % interval in standard uncertainties.
const HALF_WIDTH: f64 = 1.644_853_627;

/// Standard uncertainties within which 95 % of the errors lie.
const COVERAGE: f64 = 1.959_963_985;

/// Half a unit of the last digit as a standard uncertainty.
const fn half_unit(unit: f64) -> Option<f64> {
    // A uniform error of half a unit: over the root of 3.
    Some(0.5 * unit / 1.732_050_807_568_877_2)
}

/// Claims that a ratio is 1.
const RATIOS: [&str; 4] =
    ["ratios-p1", "ratios-p3-p4", "ratios-at-demand", "adjustment-ratios"];

/// Those of responses on one stripe.
const CLOSED: [&str; 2] = ["ratios-p1", "ratios-p3-p4"];

/// The slenderness of the effect of these claims, in rad.
const STOCKIEST: f64 = SLENDERNESSES_RAD[SLENDERNESSES_RAD.len() - 1];

/// A number of ours beside the paper's.
#[derive(Clone)]
struct PaperNumber {
    quantity: String,
    ours: Estimate,
    paper: f64,
    /// Standard uncertainty by the paper's printed digits; none where the
    /// paper says it in words.
    rounding: Option<f64>,
    /// Whether records come in.
    records: bool,
    /// Ours once the closed form of small rotations is divided out, where
    /// there is one.
    without_closed_form: Option<f64>,
}

/// Numbers that the paper prints and no record enters.
///
/// # Errors
/// [`BlockError`] for a block out of range.
fn printed() -> Result<Vec<PaperNumber>, BlockError> {
    let one = |quantity: &str, ours: f64, paper: f64, unit: f64| PaperNumber {
        quantity: quantity.into(),
        ours: Estimate::exact(ours),
        paper,
        rounding: half_unit(unit),
        records: false,
        without_closed_form: None,
    };
    let stockiest = &BLOCKS[BLOCKS.len() - 1];
    let etas = [
        Restitution::housner(stockiest)?.velocity_ratio(),
        Restitution::housner(&BLOCKS[0])?.velocity_ratio(),
    ];
    let size = BLOCKS[0].dimensions(GRAVITY_M_S2)?;
    Ok(vec![
        one("half diagonal R for p = 1, m", size.half_diagonal_m, 7.358, 1e-3),
        one("width 2b for p = 1, alpha = 0.05, m", size.width_m, 0.735, 1e-3),
        one(
            "height 2h for p = 1, alpha = 0.05, m",
            size.height_m,
            14.697,
            1e-3,
        ),
        one("Housner's eta at alpha = 0.25", etas[0], 0.91, 1e-2),
        one("Housner's eta at alpha = 0.05", etas[1], 1.0, 1e-2),
        one(
            "energy loss per impact",
            1.0 - RESTITUTION * RESTITUTION,
            0.1536,
            1e-4,
        ),
    ])
}

/// Ratios that the paper says to be 1. Of responses of alpha = 0.25 over
/// those of 0.10 small rotations have a closed form.
fn ratios(claims: &[Claim]) -> Vec<PaperNumber> {
    let mut out = Vec::new();
    for claim in claims.iter().filter(|c| RATIOS.contains(&c.id.as_str())) {
        let known = CLOSED.contains(&claim.id.as_str());
        out.extend(
            claim.results.iter().map(|result| PaperNumber {
                quantity: format!("{} ({})", claim.measure, result.place()),
                ours: result.estimate,
                paper: 1.0,
                rounding: None,
                records: true,
                without_closed_form: known
                    .then(|| result.estimate.value() / closed_form(STOCKIEST)),
            }),
        );
    }
    out
}

/// Our numbers beside those that the paper prints.
///
/// # Errors
/// [`BlockError`] for a block out of range.
pub fn comparison(
    results: &StudyResults,
    claims: &[Claim],
) -> Result<PlainTable, BlockError> {
    let suites = results.suites();
    let shift = suites
        .iter()
        .map(|s| s.work.certainty.largest_shift)
        .fold(0.0, |a: f64, b| if b > a { b } else { a });
    let compared = [printed()?, ratios(claims)].concat();
    Ok(comparison_table(&compared, shift))
}

/// After ASME V&V 20: E = S - D and its uncertainty. `shift` is the largest
/// relative change that wrong first overturnings make.
fn comparison_table(compared: &[PaperNumber], shift: f64) -> PlainTable {
    let rows = compared.iter().map(|one| row(one, shift)).collect();
    let header = [
        "quantity",
        "S, here",
        "D, the paper",
        "E = S - D",
        "u of the numerics",
        "u of the input",
        "u of D",
        "|E| / u",
        "what it says",
    ];
    PlainTable::new(
        "comparison-error",
        "Comparison error and uncertainty, after ASME V&V 20",
        "Where the paper prints a number, or says that a ratio is \
                  1. This compares computation with computation; nothing \
                  here is compared with an experiment, so it validates no \
                  model. With records, E holds the difference between these \
                  suites and the paper's, which are not listed there. u are \
                  standard uncertainties: of the numerics, by the open \
                  fates, at most; of the input, by the choice of records, \
                  from the 90 % interval over 3.29; of D, by its printed \
                  digits. Other \
                  figures of the paper print no number that one could \
                  subtract. Where a small rotation has a closed form, \
                  sin(alpha)/alpha over that of the reference, E is also \
                  given with it divided out.",
        &header,
        rows,
    )
}

fn row(one: &PaperNumber, shift: f64) -> Vec<String> {
    let value = one.ours.value();
    // An error below the ninth digit is rounding.
    let error = value - one.paper;
    let error = if error.abs() < 1e-9 { 0.0 } else { error };
    let numerics = if one.records { shift * value.abs() } else { 0.0 };
    let input = one.ours.interval();
    let input = input.map(|i| (i.high() - i.low()) / (2.0 * HALF_WIDTH));
    let square = |x: f64| x * x;
    let together = (square(numerics)
        + square(input.unwrap_or(0.0))
        + square(one.rounding.unwrap_or(0.0)))
    .sqrt();
    let ratio = if error == 0.0 { 0.0 } else { error.abs() / together };
    let left = one.without_closed_form.map(|ours| ours - one.paper);
    let says = if error.is_nan() {
        "nothing: no data".to_owned()
    } else if ratio <= COVERAGE {
        "E within its uncertainty".into()
    } else if let Some(left) = left {
        let rest = match left.abs() <= COVERAGE * together {
            true => "within its uncertainty",
            false => "beyond it too: model, suite or procedure differ",
        };
        let left = short(left);
        format!("E beyond it; {left} after sin(alpha)/alpha, {rest}")
    } else if one.records {
        "E beyond it: model, suite or procedure differ".into()
    } else {
        "E beyond it: they differ".into()
    };
    let optional = |x: Option<f64>, instead: &str| {
        x.map_or_else(|| instead.to_owned(), short)
    };
    vec![
        one.quantity.clone(),
        rounded_text(value),
        format!("{}", one.paper),
        short(error),
        if one.records { short(numerics) } else { "rounding".into() },
        optional(input, if one.records { "not stated" } else { "exact" }),
        optional(one.rounding, "in words"),
        if ratio.is_finite() { format!("{ratio:.1}") } else { "–".into() },
        says,
    ]
}

fn short(x: f64) -> String {
    if x.is_nan() {
        "none".into()
    } else if x == 0.0 {
        "0".into()
    } else if x.abs() < 1e-4 {
        format!("{x:.0e}")
    } else {
        format!("{x:.4}")
    }
}

/// Evidence and gap of the input of a run on embedded suites, beside which
/// results of recorded ones may be kept.
fn synthetic(recorded: Option<&Findings>) -> (String, &'static str) {
    let own = "Synthetic suites from published relations, adjusted to \
               moments of PEER's motions, with seeds and hashes under \
               provenance";
    let Some(recorded) = recorded else {
        return (
            format!("{own}."),
            "No recorded motion: these suites say how the procedure works, \
             not what earthquakes do.",
        );
    };
    let suites: Vec<String> = recorded
        .suites
        .iter()
        .map(|s| format!("{} {}", s.records, s.kind))
        .collect();
    (
        format!(
            "{own}; beside them results of {} recorded motions, whose names \
             and hashes are kept.",
            suites.join(" and ")
        ),
        "The recorded motions are not part of this run and may not be passed \
         on: only who has them can repeat their results.",
    )
}

/// After NASA-STD-7009B, by our own judgement.
pub struct Credibility(Vec<Factor>);

/// The assessment of a study.
pub fn assessment(
    results: &StudyResults,
    proof: Option<&Proof>,
    recorded: Option<&Findings>,
    words: &Words,
) -> Credibility {
    let factor = |name: &str, level: &str, evidence: String, gaps: &str| {
        let (name, level, gaps) = (name.into(), level.into(), gaps.into());
        Factor { name, level, evidence, gaps }
    };
    let mut factors = words.assessment.clone();
    let verification =
        |evidence, gaps| factor("Verification", "0", evidence, gaps);
    factors.insert(
        1,
        match proof {
            Some(proof) if proof.failed() == 0 => words.verified.clone(),
            Some(proof) => verification(
                format!(
                    "{} of {} declared cases fail.",
                    proof.failed(),
                    proof.results().len()
                ),
                "The annex has the cases that fail.",
            ),
            None => verification("Not run here.".into(), NOT_RUN),
        },
    );
    let input = if results.embedded() {
        let (evidence, gaps) = synthetic(recorded);
        factor("Input pedigree", "1", evidence, gaps)
    } else {
        words.given.clone()
    };
    factors.insert(3, input);
    Credibility(factors)
}

impl Credibility {
    /// The levels, in a sentence.
    pub fn levels(&self) -> String {
        let all: Vec<String> = self
            .0
            .iter()
            .map(|one| format!("{} {}", one.name.to_lowercase(), one.level))
            .collect();
        format!(
            "Credibility after NASA-STD-7009B, from 0 (insufficient evidence) \
             to 4, by the project's own judgement: {}. The reasons follow.",
            all.join(", ")
        )
    }

    /// The factors, a row each.
    pub fn table(&self) -> PlainTable {
        let row = |one: &Factor| {
            let Factor { name, level, evidence, gaps } = one.clone();
            vec![name, level, evidence, gaps]
        };
        PlainTable::new(
            "credibility-assessment",
            "Credibility, after NASA-STD-7009B",
            "Levels from 0, insufficient evidence, to 4, by the \
             project's own judgement; no one has certified them. The \
             least of them bounds what the whole can be trusted for.",
            &["factor", "level", "evidence", "gaps"],
            self.0.iter().map(row).collect(),
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking_statistics::{Interval, Range};

    fn estimate(value: f64, ends: Option<(f64, f64)>) -> Estimate {
        ends.map_or(Estimate::exact(value), |(low, high)| {
            let interval = Interval::try_new(low, high).unwrap();
            Estimate::try_new(value, interval, Range::Real).unwrap()
        })
    }

    #[test]
    fn errors_are_set_against_their_uncertainty() {
        let one = |value, paper, interval, rounding| PaperNumber {
            quantity: "q".into(),
            ours: estimate(value, interval),
            paper,
            rounding,
            records: interval.is_some() || rounding.is_none(),
            without_closed_form: None,
        };
        let compared = [
            one(0.1536, 0.1536, None, half_unit(1e-4)),
            one(0.908_186_921, 0.91, None, half_unit(1e-2)),
            // Standard uncertainty 0.01: E is three of them.
            one(1.03, 1.0, Some((1.013_551_463_7, 1.046_448_536_3)), None),
            one(f64::NAN, 1.0, None, None),
        ];
        let rows = comparison_table(&compared, 0.0).rows;
        let ends = |row: usize| (rows[row][7].as_str(), rows[row][8].as_str());
        assert_eq!(ends(0), ("0.0", "E within its uncertainty"));
        // -0.0018 over 0.005/sqrt(3).
        assert_eq!(ends(1), ("0.6", "E within its uncertainty"));
        assert_eq!(ends(2).0, "3.0");
        assert!(ends(2).1.starts_with("E beyond it"));
        assert_eq!(ends(3), ("–", "nothing: no data"));
        // Open fates widen what records give: sqrt(0.01^2 + 0.0309^2).
        let rows = comparison_table(&compared[2..3], 0.03).rows;
        assert_eq!(rows[0][7], "0.9");
    }

    #[test]
    fn a_known_bias_is_named_and_what_it_leaves_is_judged() {
        // Standard uncertainty 0.001; 0.9866 is 13 of them from 1.
        let says = |left| {
            let one = PaperNumber {
                quantity: "q".into(),
                ours: estimate(0.9866, Some((0.984_955_146, 0.988_244_854))),
                paper: 1.0,
                rounding: None,
                records: true,
                without_closed_form: left,
            };
            comparison_table(&[one], 0.0).rows[0][8].clone()
        };
        let unknown = "E beyond it: model, suite or procedure differ";
        assert_eq!(says(None), unknown);
        let known = says(Some(1.0002));
        assert!(known.contains("0.0002 after sin(alpha)/alpha, within"));
        assert!(!known.contains("differ"), "{known}");
        let other = says(Some(0.99));
        assert!(other.contains("-0.0100 after sin(alpha)/alpha, beyond"));
        assert!(other.ends_with("model, suite or procedure differ"));
    }

    #[test]
    fn recorded_results_beside_a_synthetic_run_are_shown() {
        let recorded = crate::basis::recorded();
        let (evidence, gap) = synthetic(Some(&recorded));
        assert!(evidence.contains("86 ordinary and 44 pulse-type recorded"));
        assert!(!gap.contains("No recorded motion"), "{gap}");
        let (evidence, gap) = synthetic(None);
        assert!(!evidence.contains("recorded"), "{evidence}");
        assert!(gap.starts_with("No recorded motion"), "{gap}");
    }

    #[test]
    fn numbers_that_the_paper_prints_are_met() {
        for row in comparison_table(&printed().unwrap(), 0.0).rows {
            assert_eq!(row[8], "E within its uncertainty", "{row:?}");
        }
    }
}
