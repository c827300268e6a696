//! Section 4, Figures 6, 7 and 9: paired ratios on the stripes.

use rocking::statistics::paired::Pairs;

use super::{
    Cells, Claim, Context, Measured, Results, SAME, StudyError, all_one, away,
    median,
};
use crate::paper::{
    Arm, FREQUENCIES_RAD_S, LEAST_USABLE, REFERENCE, SLENDERNESSES_RAD,
    Section, Shown, SuiteKind,
};
use crate::study::figures::{adjusted_split, demand_boxes, of_arm, pairs};

/// Ratios of the stripes with enough of them, from the lowest on.
fn usable(
    results: &Results,
    arm: Arm,
    frequency: usize,
    slenderness: Option<usize>,
) -> Result<Vec<Pairs>, StudyError> {
    let Some(stripes) = of_arm(&results.ordinary, arm) else {
        return Ok(Vec::new());
    };
    Ok(pairs(stripes, frequency, slenderness)?
        .into_iter()
        .map(|(_, pairs)| pairs)
        .take_while(|pairs| pairs.ratios.len() >= LEAST_USABLE)
        .collect())
}

pub(super) fn all(
    results: &Results,
    arm: Arm,
) -> Result<Vec<Claim>, StudyError> {
    let suites = &[SuiteKind::Ordinary];
    let mut lowest = Vec::new();
    let mut cells = [Vec::new(), Vec::new()];
    let mut rises = 0_usize;
    let (mut beyond, mut all) = (0_usize, 0_usize);
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for slenderness in 0..SLENDERNESSES_RAD.len() {
            if slenderness == REFERENCE {
                continue;
            }
            let pairs = usable(results, arm, frequency, Some(slenderness))?;
            rises += pairs
                .windows(2)
                .filter(|w| w[1].ratios.len() > w[0].ratios.len())
                .count();
            for (i, pairs) in pairs.into_iter().enumerate() {
                if frequency == 0 && slenderness == 4 && i == 0 {
                    lowest = pairs.ratios;
                } else {
                    cells[frequency.min(1)].push(pairs.ratios);
                }
            }
            for stripe in
                demand_boxes(&results.ordinary, arm, frequency, slenderness)?
            {
                all += stripe.usable;
                beyond += stripe.summary.map_or(0, |b| b.outliers.len());
            }
        }
    }
    let context =
        |section, blocks| Context { section, suites, blocks, arm: Some(arm) };
    let cell = |id: &str, section, blocks, quote: &str, cells: Cells| {
        context(section, blocks).claim(
            id,
            quote,
            "median paired ratio of demands to alpha = 0.10 on a stripe",
            cells.measured,
            "all within 5 % of 1",
            cells.verdict,
            cells.note(),
        )
    };
    let lowest = median(&lowest);
    let outliers = Measured::exact(beyond as f64 / all as f64);
    let falling = Measured::exact(rises as f64);
    let mut adjusted = Vec::new();
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for pairs in usable(results, arm, frequency, None)? {
            adjusted.push(pairs.ratios);
        }
    }
    let adjusted = all_one(&adjusted, SAME);
    let (mut within, mut above) = (Vec::new(), Vec::new());
    if let Some(stripes) = of_arm(&results.ordinary, arm) {
        for frequency in 0..FREQUENCIES_RAD_S.len() {
            for split in adjusted_split(&results.ordinary, stripes, frequency)?
            {
                within.push(split.within);
                above.push(split.above);
            }
        }
    }
    let scope = |id: &str, quote: &str, part: &str, cells: &[Vec<f64>]| {
        let cells = all_one(cells, SAME);
        let mut note = cells.note();
        note += "; the margin was set with the measure, after the other \
                 results were seen";
        context(Section::new(6, Shown::Figure(9)), "alpha = 0.10").claim(
            id,
            quote,
            &format!(
                "median paired ratio of demands, adjusted over scaled, on a \
                 stripe, of the records whose adjusted alpha is {part}"
            ),
            cells.measured,
            "all within 5 % of 1",
            cells.verdict,
            note,
        )
    };
    let [first, others] = cells;
    Ok(vec![
        cell(
            "ratios-p1",
            Section::new(4, Shown::Figure(6)),
            "p = 1, all but alpha = 0.25 on the lowest stripe",
            "the median conforms to 1.0 with 95% confidence for most of the \
             blocks and IM levels",
            all_one(&first, SAME),
        ),
        context(Section::new(4, Shown::Figure(6)), "p = 1, alpha = 0.25").claim(
            "ratios-p1-exception",
            "The only exception regards the block with alpha = 0.25 rad in \
             the lowest IM-stripe",
            "|median ratio - 1| on the lowest stripe",
            away(lowest),
            "above 0",
            away(lowest).above(0.0),
            String::new(),
        ),
        cell(
            "ratios-p3-p4",
            Section::new(4, Shown::Figure(7)),
            "p = 3 and 4",
            "The same tendency is observed for the blocks with p = 3 or 4",
            all_one(&others, SAME),
        ),
        context(Section::new(4, Shown::Figures(6, 7)), "all 15").claim(
            "few-outliers",
            "these are clearly the exception and not the rule",
            "share of the ratios beyond the whiskers",
            outliers,
            "below 10 %",
            outliers.below(0.10),
            String::new(),
        ),
        context(Section::new(4, Shown::Figures(6, 7)), "all 15").claim(
            "usable-falls",
            "the decreasing percentage of usable ratios with increasing \
             intensity",
            "stripes with more usable ratios than the one below",
            falling,
            "none",
            falling.within(0.0, 0.0),
            String::new(),
        ),
        context(Section::new(4, Shown::Figure(9)), "alpha = 0.10").claim(
            "adjustment-ratios",
            "for all the values of p the two approaches yield practically \
             identical results",
            "median paired ratio of demands, adjusted over scaled, on a \
             stripe",
            adjusted.measured,
            "all within 5 % of 1",
            adjusted.verdict,
            adjusted.note(),
        ),
        scope(
            "scope-slender",
            "This normalization is shown to work efficiently for the \
             relatively slender rocking blocks (alpha <= 0.25 rad)",
            "0.25 at most",
            &within,
        ),
        scope(
            "scope-stockier",
            "extension to stockier blocks seems probable",
            "above 0.25",
            &above,
        ),
    ])
}
