//! How far to trust the study: comparison error against uncertainty where
//! the paper prints a number, and a credibility assessment with its gaps.

use super::evidence::{NOT_RUN, Proof};
use crate::findings::Claim;
use crate::study::figures::Results;
use crate::table::PlainTable;
use crate::words::rounded_text;

/// Half width of a 95 % interval in standard uncertainties.
const COVERAGE: f64 = 1.959_963_985;

/// A number that the paper prints, or a ratio that it says to be 1.
struct Printed {
    /// Name of the claim that measures it.
    claim: &'static str,
    /// What the paper has.
    value: f64,
    /// Standard uncertainty of that by its printed digits; none where the
    /// paper says it in words.
    rounding: Option<f64>,
    /// Whether records come in.
    records: bool,
}

/// Half a unit of the last digit as a standard uncertainty.
const fn half_unit(unit: f64) -> Option<f64> {
    // A uniform error of half a unit: over the root of 3.
    Some(0.5 * unit / 1.732_050_807_568_877_2)
}

const PRINTED: [Printed; 9] = [
    Printed {
        claim: "table-1",
        value: 0.0,
        rounding: half_unit(1e-3),
        records: false,
    },
    Printed {
        claim: "housner-least",
        value: 0.91,
        rounding: half_unit(1e-2),
        records: false,
    },
    Printed {
        claim: "housner-largest",
        value: 1.0,
        rounding: half_unit(1e-2),
        records: false,
    },
    Printed {
        claim: "energy-loss",
        value: 0.1536,
        rounding: half_unit(1e-4),
        records: false,
    },
    Printed { claim: "criterion", value: 1.0, rounding: None, records: true },
    Printed { claim: "ratios-p1", value: 1.0, rounding: None, records: true },
    Printed {
        claim: "ratios-p3-p4",
        value: 1.0,
        rounding: None,
        records: true,
    },
    Printed {
        claim: "ratios-at-demand",
        value: 1.0,
        rounding: None,
        records: true,
    },
    Printed {
        claim: "adjustment-ratios",
        value: 1.0,
        rounding: None,
        records: true,
    },
];

/// Comparison errors, then the assessment.
#[must_use]
pub fn tables(
    results: &Results,
    claims: &[Claim],
    proof: Option<&Proof>,
) -> Vec<PlainTable> {
    let suites = [&results.ordinary, &results.pulse];
    let shift = suites
        .iter()
        .map(|s| s.work.certainty.largest_shift)
        .fold(0.0, |a: f64, b| if b > a { b } else { a });
    vec![comparison(claims, shift), assessment(results, proof)]
}

/// After ASME V&V 20: E = S - D and its uncertainty. `shift` is the largest
/// relative change that first overturnings told wrongly make.
fn comparison(claims: &[Claim], shift: f64) -> PlainTable {
    let mut rows = Vec::new();
    for printed in &PRINTED {
        for claim in claims.iter().filter(|c| c.name == printed.claim) {
            rows.push(row(claim, printed, shift));
        }
    }
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
    PlainTable {
        name: "comparison-error".into(),
        title: "Comparison error and uncertainty, after ASME V&V 20".into(),
        reading: "Where the paper prints a number, or says that a ratio is \
                  1. This compares computation with computation; nothing \
                  here is compared with an experiment, so it validates no \
                  model. With records, E holds the difference between these \
                  suites and the paper's, which are not listed there. u are \
                  standard uncertainties: of the numerics, by the open \
                  fates, at most; of the input, by the choice of records, \
                  from the 95 % interval over 3.92; of D, by its printed \
                  digits. Of several cells a claim keeps the worst, so its E \
                  is the largest of many. Other figures of the paper print \
                  no number that one could subtract."
            .into(),
        header: header.map(String::from).into(),
        rows,
    }
}

fn row(claim: &Claim, printed: &Printed, shift: f64) -> Vec<String> {
    let value = claim.measured.value;
    // An error below the ninth digit is rounding.
    let error = value - printed.value;
    let error = if error.abs() < 1e-9 { 0.0 } else { error };
    let numerics = if printed.records { shift * value.abs() } else { 0.0 };
    let input =
        claim.measured.interval.map(|(a, b)| (b - a) / (2.0 * COVERAGE));
    let square = |x: f64| x * x;
    let together = (square(numerics)
        + square(input.unwrap_or(0.0))
        + square(printed.rounding.unwrap_or(0.0)))
    .sqrt();
    let ratio = if error == 0.0 { 0.0 } else { error.abs() / together };
    let says = if error.is_nan() {
        "nothing: no data"
    } else if ratio <= COVERAGE {
        "E within its uncertainty"
    } else if printed.records {
        "E beyond it: model, suite or procedure differ"
    } else {
        "E beyond it: they differ"
    };
    let optional = |x: Option<f64>, instead: &str| {
        x.map_or_else(|| instead.to_owned(), short)
    };
    let arm = claim
        .arm
        .map_or(String::new(), |arm| format!(", arm {}", arm.letter()));
    vec![
        format!(
            "{} ({}, {}{arm})",
            claim.measure,
            claim.suite_name(),
            claim.blocks
        ),
        rounded_text(value),
        format!("{}", printed.value),
        short(error),
        if printed.records { short(numerics) } else { "rounding".into() },
        optional(input, if printed.records { "not stated" } else { "exact" }),
        optional(printed.rounding, "in words"),
        if ratio.is_finite() { format!("{ratio:.1}") } else { "–".into() },
        says.into(),
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

/// After NASA-STD-7009B, by our own judgement: factor, level of 0 to 4,
/// evidence, gaps.
fn assessment(results: &Results, proof: Option<&Proof>) -> PlainTable {
    let input = if results.embedded() {
        [
            "Input pedigree",
            "1",
            "Synthetic suites from two published stochastic models, with \
             seeds and hashes under provenance.",
            "No recorded motion: these suites say how the procedure works, \
             not what earthquakes do.",
        ]
    } else {
        [
            "Input pedigree",
            "2",
            "Suites given by the user; files are checked, hashes under \
             provenance.",
            "Where the records come from, and how they were processed, is \
             the user's to say.",
        ]
    };
    let verification = if proof.is_some() {
        [
            "Verification",
            "3",
            "Closed forms, trajectories with 36 digits, order of \
             convergence, error estimates, invariants and wrong models that \
             must fail: the section on evidence.",
            "No one outside the project has repeated it. Other machines \
             than x86-64 Linux were not measured.",
        ]
    } else {
        ["Verification", "0", "Not run here.", NOT_RUN]
    };
    let rows = [
        [
            "Data pedigree",
            "2",
            "Reference values have their origin, generator, licence and \
             hash in fixtures/MANIFEST.toml; published tables where there \
             are some.",
            "Most of the high-precision references were computed for this \
             project; the paper's own data are not published.",
        ],
        verification,
        [
            "Validation",
            "1",
            "The conceptual model is that of the paper, and the paper's \
             claims are measured.",
            "No comparison with shaking-table tests. Sliding, bouncing, \
             vertical motion and flexible supports are outside the model.",
        ],
        input,
        [
            "Uncertainty characterization",
            "2",
            "Error estimates, and first overturnings told again where \
             double precision may not tell them, for the numerics; \
             intervals by order statistics and bootstrap for medians and \
             differences of them, Wilson's for shares of records.",
            "Shares of levels or blocks, which share their records, have \
             none. The uncertainty of the \
             coefficient of restitution is not propagated, only varied.",
        ],
        [
            "Results robustness",
            "2",
            "Other restitution, criterion, component, grid, null and \
             inversion, and one record less: sensitivities and the \
             questions beyond the paper.",
            "On all 15 blocks only with --full; one factor at a time, no \
             interactions.",
        ],
        [
            "Use history",
            "0",
            "None.",
            "Nobody has yet used these results for a decision and told.",
        ],
        [
            "Management of model and process",
            "2",
            "Versions, a changelog of results, one gate for every change, \
             results that regenerate to the same bytes.",
            "No formal process, no independent review.",
        ],
    ];
    let header = ["factor", "level", "evidence", "gaps"];
    PlainTable {
        name: "credibility-assessment".into(),
        title: "Credibility, after NASA-STD-7009B".into(),
        reading: "Levels from 0, insufficient evidence, to 4, by the \
                  project's own judgement; no one has certified them. The \
                  least of them bounds what the whole can be trusted for."
            .into(),
        header: header.map(String::from).into(),
        rows: rows.map(|row| row.map(String::from).into()).into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::findings::Measured;
    use crate::paper::{Section, Shown};
    use crate::paper::{SuiteKind, Verdict};

    fn claim(id: &str, value: f64, interval: Option<(f64, f64)>) -> Claim {
        Claim {
            id: id.into(),
            name: id.into(),
            section: Section::new(4, Shown::Text),
            quote: "q".into(),
            suites: vec![SuiteKind::Ordinary],
            blocks: "all 15".into(),
            arm: None,
            measure: "m".into(),
            measured: Measured { value, interval },
            margin: "none".into(),
            verdict: Verdict::Confirmed,
            note: String::new(),
        }
    }

    #[test]
    fn errors_are_set_against_their_uncertainty() {
        let claims = [
            claim("energy-loss", 0.1536, None),
            claim("housner-least", 0.908_186_921, None),
            // Standard uncertainty 0.01: E is three of them.
            claim("ratios-p1", 1.03, Some((1.010_400_36, 1.049_599_64))),
            claim("ratios-p3-p4", f64::NAN, None),
        ];
        let rows = comparison(&claims, 0.0).rows;
        assert_eq!(rows.len(), 4);
        let ends = |row: usize| (rows[row][7].as_str(), rows[row][8].as_str());
        // -0.0018 over 0.005/sqrt(3).
        assert_eq!(ends(0), ("0.6", "E within its uncertainty"));
        assert_eq!(ends(1), ("0.0", "E within its uncertainty"));
        assert_eq!(ends(2).0, "3.0");
        assert!(ends(2).1.starts_with("E beyond it"));
        assert_eq!(ends(3), ("–", "nothing: no data"));
        // Open fates widen what records give: sqrt(0.01^2 + 0.0309^2).
        let rows = comparison(&claims[2..3], 0.03).rows;
        assert_eq!(rows[0][7], "0.9");
    }
}
