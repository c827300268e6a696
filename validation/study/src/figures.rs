//! The paper's figures, made from the analyses.

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

/// Figures 1 to 18, in order; those that depend on the grid once for each drawn
/// grid. Bands use these draws of the records.
///
/// # Errors
/// If a curve cannot be read.
pub fn paper_figures(
    results: &StudyResults,
    draws: &Resamples,
) -> anyhow::Result<Vec<Figure>> {
    let drawn = results.plan.drawn();
    let (one, ordinary) = (results.plan.common(), &results.ordinary);
    let mut out = vec![
        single::sketch(),
        single::motions(ordinary, one, 2),
        single::motions(&results.pulse, one, 3),
        single::curves(ordinary, one, 4)?,
        single::curves(&results.pulse, one, 5)?,
    ];
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
