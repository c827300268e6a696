//! Section 5.3 as a table: Options 1, 2 and 3 for every block, intensity measure
//! and threshold.

mod drawing;

use rayon::prelude::*;
use rocking::block::Block;
use rocking::integrator::Model;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_exchange::{Pact, unit_intensity};
use rocking_procedures::fragility::options::{Centre, Recipe};
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::resampling::Resampling;
use rocking_statistics::{
    Clusters, Estimate, ExtendedSample, Lognormal, QuantileType, Range,
};

use self::drawing::RecipeSummary;
use super::answer::{Rows, StudyAnswer, TableCell, count, number, word};
use super::trimming;
use crate::distributions::BlockSamples;
use crate::estimates::{LEVEL, median};
use crate::fits::{BLOCK, MLE, THRESHOLDS, trimmed};
use crate::inference::estimate;
use crate::results::StudyResults;
use rocking_common::paper::{
    FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, demand_index,
};
use rocking_common::table::digits;
use rocking_common::words::range;

/// Draws of the bootstrap, by default and with `--full`.
const REPLICATES: [usize; 2] = [100, 1000];

/// One recipe for one block, measure and threshold.
struct RecipeFit<'a> {
    recipe: Recipe,
    intensity: Intensity,
    block: &'a BlockSamples,
    edp: f64,
    /// The fragility, or the reason why there is none.
    fragility: Result<Lognormal, String>,
    /// Kolmogorov and area distance to the empirical fragility.
    distances: [Estimate; 2],
    /// Number of bootstrap draws in which the recipe is defined.
    used: usize,
}

pub(super) fn answer(results: &StudyResults) -> anyhow::Result<StudyAnswer> {
    let full = results.plan.full;
    let arm = results.plan.common();
    let kind = results.ordinary.kind;
    let replicates = REPLICATES[usize::from(full)];
    // One set of draws for all blocks, measures and thresholds.
    let clusters = &results.ordinary.clusters;
    let draws: Vec<Vec<usize>> =
        Bootstrap::of_clusters("study/options", 0, clusters, replicates)
            .map(<[_]>::to_vec);
    let mut cells: Vec<(Intensity, &BlockSamples, f64)> = Vec::new();
    for (_, found) in results.common().filter(|(s, _)| s.kind == kind) {
        for block in &found.blocks {
            cells.extend(THRESHOLDS.map(|e| (found.intensity, block, e)));
        }
    }
    let entries: Vec<RecipeFit<'_>> = cells
        .par_iter()
        .map(|(intensity, block, edp)| {
            let paper = block.p_rad_s == FREQUENCIES_RAD_S[BLOCK.0]
                && block.alpha_rad == SLENDERNESSES_RAD[BLOCK.1];
            let areas = full || paper;
            entries(*intensity, block, *edp, (&draws, clusters), areas)
        })
        .collect::<Result<Vec<_>, _>>()?
        .into_iter()
        .flatten()
        .collect();
    let summaries = summaries(&entries);
    let mut table = Rows::default();
    for s in &summaries {
        table.row_if(
            s.recipe.option() != 3 || shown_constant(&s.recipe),
            vec![
                ("option", count(usize::from(s.recipe.option()))),
                ("recipe", word(s.recipe.to_string())),
                ("numbers_reported", reported(&s.recipe)),
                ("im", word(s.intensity.name())),
                ("defined_share", number(s.defined, 3)),
                ("median_ks", number(s.ks, 4)),
                ("largest_ks", number(s.largest, 4)),
                ("median_area", number(s.area, 4)),
            ],
        );
    }
    let mut answer = table.answer("options", words(&summaries));
    let reading = &mut answer.tables[0].reading;
    *reading = reading.replace("{replicates}", &replicates.to_string());
    answer.files.extend([
        ("options-by-block.csv".into(), by_block(&entries)),
        ("options-pact.csv".into(), pact(&entries)?),
    ]);
    answer.figures.push(drawing::figure(&summaries, arm));
    Ok(answer.beside(trimming::trimming_part(results)?))
}

fn reported(recipe: &Recipe) -> TableCell {
    let parameters = recipe.parameters().map(|n| n.to_string());
    word(parameters.unwrap_or_else(|| "sample".into()))
}

fn shown_constant(recipe: &Recipe) -> bool {
    matches!(recipe, Recipe::Transformed { c, .. } if *c == 0.25 || *c == 1.0)
}

/// The fits of every recipe to a block's capacities at a demand.
fn entries<'a>(
    intensity: Intensity,
    block: &'a BlockSamples,
    edp: f64,
    (draws, clusters): (&[Vec<usize>], &Clusters),
    areas: bool,
) -> anyhow::Result<Vec<RecipeFit<'a>>> {
    let values = &block.samples[demand_index(edp)];
    let sample = ExtendedSample::try_new(values)?;
    let recipes = Recipe::all(QuantileType::default());
    // Distances of the fragilities of a draw to the benchmark, the empirical
    // fragility of the records.
    let mut drawn: Vec<[Vec<f64>; 2]> =
        recipes.iter().map(|_| [Vec::new(), Vec::new()]).collect();
    for draw in draws {
        let own: Vec<f64> = draw.iter().map(|i| values[*i]).collect();
        let own = ExtendedSample::try_new(&own)?;
        let made = Recipe::fragilities(&recipes, &own, block.shift);
        for (fragility, [ks, area]) in made.iter().zip(&mut drawn) {
            if let Ok(fragility) = fragility {
                ks.push(fragility.kolmogorov_distance(&sample));
                if areas {
                    area.extend(fragility.area_distance(&sample));
                }
            }
        }
    }
    let made = Recipe::fragilities(&recipes, &sample, block.shift);
    let all = recipes.into_iter().zip(made).zip(drawn);
    let one = all.map(|((recipe, fragility), drawn)| {
        let distances = fragility.as_ref().map_or([f64::NAN; 2], |f| {
            let area = f.area_distance(&sample);
            [f.kolmogorov_distance(&sample), area.unwrap_or(f64::NAN)]
        });
        let distances = [0, 1].map(|k| {
            let range = [Range::Share, Range::NotNegative][k];
            let how = (Resampling::Bootstrap, range, LEVEL);
            estimate(clusters, distances[k], &drawn[k], how)
        });
        RecipeFit {
            recipe,
            intensity,
            block,
            edp,
            fragility: fragility.map_err(|e| e.to_string()),
            distances,
            used: drawn[0].len(),
        }
    });
    Ok(one.collect())
}

fn summaries(entries: &[RecipeFit<'_>]) -> Vec<RecipeSummary> {
    let recipes = Recipe::all(QuantileType::default());
    let mut out = Vec::new();
    for intensity in [Intensity::Pga, Intensity::Pgv] {
        for recipe in &recipes {
            let is = |e: &&RecipeFit<'_>| {
                (e.recipe, e.intensity) == (*recipe, intensity)
            };
            let own = entries.iter().filter(is);
            let defined = own.clone().filter(|e| e.fragility.is_ok());
            let of = |k: usize| -> Vec<f64> {
                defined.clone().map(|e| e.distances[k].value()).collect()
            };
            let ks = of(0);
            out.push(RecipeSummary {
                recipe: *recipe,
                intensity,
                defined: ks.len() as f64 / own.count() as f64,
                ks: median(&ks).value(),
                largest: range(ks.into_iter()).1,
                area: median(&of(1)).value(),
            });
        }
    }
    out
}

fn words(summaries: &[RecipeSummary]) -> String {
    let of = |recipe: Recipe, intensity| {
        let found = RecipeSummary::find(summaries, recipe, intensity);
        found.map_or_else(String::new, |s| {
            let lost = 100.0 * (1.0 - s.defined);
            match s.defined < 1.0 {
                true => format!("{:.3}, undefined for {lost:.0} %", s.ks),
                false => format!("{:.3}", s.ks),
            }
        })
    };
    let centre = Centre::FittedMedian;
    let seven = |method, c| Recipe::Transformed { method, centre, c };
    [Intensity::Pga, Intensity::Pgv]
        .map(|im| {
            format!(
                "{}, median distance to the empirical fragility: Option 1 {}, \
                 Option 2 {}, Option 3 trimmed {} (c = 1) and {} (c = 0.25), \
                 untrimmed {} (c = 1) and {} (c = 0.25), unshifted {}.",
                im.name().to_uppercase(),
                of(Recipe::Shifted(MLE), im),
                of(Recipe::Quantiles(QuantileType::default()), im),
                of(seven(trimmed(), 1.0), im),
                of(seven(trimmed(), 0.25), im),
                of(seven(MLE, 1.0), im),
                of(seven(MLE, 0.25), im),
                of(Recipe::Unshifted(MLE), im),
            )
        })
        .join(" ")
}

/// Every recipe of every block, with its parameters and distances.
fn by_block(entries: &[RecipeFit<'_>]) -> String {
    let mut table = Rows::default();
    for e in entries {
        let (fragility, [ks, area]) = (e.fragility.as_ref(), e.distances);
        let of = |f: fn(&Lognormal) -> f64| six(fragility.map_or(f64::NAN, f));
        table.row(vec![
            ("im", word(e.intensity.name())),
            ("p_rad_s", number(e.block.p_rad_s, 0)),
            ("alpha_rad", number(e.block.alpha_rad, 0)),
            ("edp", number(e.edp, 0)),
            ("im_r", six(e.block.shift)),
            ("option", word(e.recipe.option().to_string())),
            ("recipe", word(e.recipe.to_string())),
            ("numbers_reported", reported(&e.recipe)),
            ("ln_median", of(Lognormal::log_mean)),
            ("dispersion", of(Lognormal::dispersion)),
            ("shift", of(Lognormal::shift)),
            ("ks_distance", six(ks.value())),
            ("ks_low", six(ks.ends().0)),
            ("ks_high", six(ks.ends().1)),
            ("area_distance", six(area.value())),
            ("area_low", six(area.ends().0)),
            ("area_high", six(area.ends().1)),
            ("draws_used", word(e.used.to_string())),
            (
                "undefined_because",
                word(fragility.err().cloned().unwrap_or_default()),
            ),
        ]);
    }
    table.csv()
}

/// Six digits: more than 86 records support.
fn six(x: f64) -> TableCell {
    word(digits(x, 6))
}

/// Median and dispersion of the unshifted lognormal for FEMA P-58's tool PACT,
/// dimensionless and in physical units.
fn pact(entries: &[RecipeFit<'_>]) -> anyhow::Result<String> {
    let mut table = Rows::default();
    for e in entries {
        let (Recipe::Unshifted(method), Ok(fragility)) =
            (e.recipe, &e.fragility)
        else {
            continue;
        };
        let block = Block::try_new(e.block.alpha_rad, e.block.p_rad_s)?;
        let (model, gravity) = (Model::Nonlinear, STANDARD_GRAVITY_M_S2);
        let unit = unit_intensity(e.intensity, &block, model, gravity);
        let own = fragility.scaled(unit)?;
        let Some(pact) = Pact::of(e.intensity, &own) else { continue };
        table.row(vec![
            ("p_rad_s", number(e.block.p_rad_s, 0)),
            ("alpha_rad", number(e.block.alpha_rad, 0)),
            ("edp", number(e.edp, 0)),
            ("fit", word(method.to_string())),
            ("demand", word(pact.demand)),
            ("median_dimensionless", six(fragility.median())),
            ("median", six(pact.median)),
            ("unit", word(pact.unit)),
            ("dispersion", six(pact.dispersion)),
        ]);
    }
    Ok(table.csv())
}
