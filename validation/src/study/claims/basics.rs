//! Section 2 and 3: the blocks, restitution, onset, criterion.

use rocking::block::Restitution;

use super::{
    Claim, Context, Measured, Results, SAME, StudyError, all_one,
    varied_ratios,
};
use crate::paper::{
    BLOCKS, GRAVITY_M_S2, RESTITUTION, Section, Shown, SuiteKind,
};
use crate::study::sensitivities::Choice;

/// Table 1 as printed, by frequency parameter: half diagonal, then widths
/// and heights by slenderness, in m.
const TABLE_1: [(f64, [f64; 5], [f64; 5]); 3] = [
    (
        7.358,
        [0.735, 1.469, 2.199, 2.923, 3.641],
        [14.697, 14.641, 14.550, 14.422, 14.258],
    ),
    (
        0.818,
        [0.082, 0.163, 0.244, 0.325, 0.405],
        [1.633, 1.627, 1.617, 1.602, 1.584],
    ),
    (
        0.460,
        [0.046, 0.092, 0.137, 0.183, 0.228],
        [0.919, 0.915, 0.909, 0.901, 0.891],
    ),
];

pub(super) fn all(results: &Results) -> Result<Vec<Claim>, StudyError> {
    let mut out = vec![table_1()?];
    out.extend(restitution()?);
    for suite in [&results.ordinary, &results.pulse] {
        let context = Context {
            section: Section::new(2, Shown::Text),
            suites: &[suite.kind],
            blocks: "p = 3, alpha = 0.10",
            arm: None,
        };
        let measured = Measured::exact(suite.onset_violations as f64);
        out.push(context.claim(
            "onset",
            "the uplift condition being exactly PGA > g tan alpha",
            "records that move at intensity 1, or do not at 1 + 1e-9",
            measured,
            "none",
            measured.within(0.0, 0.0),
            String::new(),
        ));
    }
    out.push(criterion(results)?);
    Ok(out)
}

fn table_1() -> Result<Claim, StudyError> {
    let mut worst: f64 = 0.0;
    for (frequency, (radius, widths, heights)) in
        TABLE_1.into_iter().enumerate()
    {
        for slenderness in 0..widths.len() {
            let block =
                &BLOCKS[crate::paper::position(frequency, slenderness)];
            let size = block.dimensions(GRAVITY_M_S2)?;
            for off in [
                size.half_diagonal_m - radius,
                size.width_m - widths[slenderness],
                size.height_m - heights[slenderness],
            ] {
                if !(off.abs() <= worst) {
                    worst = off.abs();
                }
            }
        }
    }
    let measured = Measured::exact(worst);
    let context = Context {
        section: Section::new(3, Shown::Table(1)),
        suites: &[],
        blocks: "all 15",
        arm: None,
    };
    // Half a unit of the last digit printed, and rounding.
    let limit = 0.000_501;
    Ok(context.claim(
        "table-1",
        "Geometric and dynamic characteristics of the 5x3 studied blocks",
        "largest difference to the printed dimensions, m",
        measured,
        "at most half a unit of the last digit, 0.0005 m",
        measured.below(limit),
        String::new(),
    ))
}

fn restitution() -> Result<Vec<Claim>, StudyError> {
    let context = Context {
        section: Section::new(3, Shown::Text),
        suites: &[],
        blocks: "all 15",
        arm: None,
    };
    let etas = BLOCKS
        .iter()
        .map(|b| Ok(Restitution::housner(b)?.velocity_ratio()))
        .collect::<Result<Vec<f64>, StudyError>>()?;
    let (low, high) = crate::words::range(etas.iter().copied());
    let housner = "Housner's coefficient of restitution varies within \
                   0.91 - 1.00";
    let [low, high] = [low, high].map(Measured::exact);
    let loss = Measured::exact(1.0 - RESTITUTION * RESTITUTION);
    Ok(vec![
        context.claim(
            "housner-least",
            housner,
            "least of the coefficients",
            low,
            "0.91 to two digits",
            low.within(0.905, 0.915),
            String::new(),
        ),
        context.claim(
            "housner-largest",
            housner,
            "largest of the coefficients",
            high,
            "1.00 to two digits",
            high.within(0.995, 1.0),
            String::new(),
        ),
        context.claim(
            "energy-loss",
            "an energy loss of 15.36% per impact",
            &format!("1 - eta^2 for eta = {RESTITUTION}"),
            loss,
            "15.36 % to four digits",
            loss.within(0.15355, 0.15365),
            String::new(),
        ),
    ])
}

fn criterion(results: &Results) -> Result<Claim, StudyError> {
    let mut cells = Vec::new();
    for varied in &results.varied {
        if varied.choice == Choice::OtherCriterion {
            for demand in [0.15, 0.35, 1.0] {
                cells.push(varied_ratios(results, varied, demand)?.ratios);
            }
        }
    }
    let cells = all_one(&cells, SAME);
    let context = Context {
        section: Section::new(2, Shown::Text),
        suites: &[SuiteKind::Ordinary],
        blocks: "p = 3, alpha = 0.10 and 0.20 at least",
        arm: Some(results.plan.common()),
    };
    Ok(context.claim(
        "criterion",
        "both options [pi/2, alpha] providing statistically identical \
         results",
        "median paired ratio of capacities at demands 0.15, 0.35, 1.00, \
         other criterion over the study's",
        cells.measured,
        "all within 5 % of 1",
        cells.verdict,
        cells.note(),
    ))
}
