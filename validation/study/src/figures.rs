//! The paper's figures, filled from the analyses.

mod distributions;
mod fragilities;
mod quantiles;
mod ratios;
mod single;
mod tested;

pub(crate) use ratios::adjusted_boxes;

use crate::inference::Resamples;
use crate::results::StudyResults;
use rocking_draw::figures::Figure;

/// Figures 1 to 18, in order; those of the grid's arms once for each arm
/// drawn. Bands are of these draws of the records.
///
/// # Errors
/// Where a curve cannot be read.
pub fn paper_figures(
    results: &StudyResults,
    draws: &Resamples,
) -> anyhow::Result<Vec<Figure>> {
    let drawn = results.plan.drawn();
    let mut out = vec![single::sketch()];
    let one = results.plan.common();
    out.push(single::motions(&results.ordinary, one, 2));
    out.push(single::motions(&results.pulse, one, 3));
    out.push(single::curves(&results.ordinary, one, 4)?);
    out.push(single::curves(&results.pulse, one, 5)?);
    let ordinary = &results.ordinary;
    for number in [6, 7] {
        for arm in &drawn {
            out.push(ratios::slendernesses(ordinary, *arm, number)?);
        }
    }
    for figure in
        [quantiles::slendernesses, ratios::adjusted, quantiles::adjusted]
    {
        for arm in &drawn {
            out.push(figure(ordinary, *arm)?);
        }
    }
    out.push(distributions::inverted(results, one)?);
    out.push(distributions::shares(results, 12)?);
    for arm in &drawn {
        out.push(tested::along(results, *arm)?);
    }
    out.push(distributions::shares(results, 14)?);
    for number in [15, 16, 17] {
        out.push(fragilities::thresholds(results, draws, one, number)?);
    }
    out.push(fragilities::constants(results, one)?);
    Ok(out)
}
