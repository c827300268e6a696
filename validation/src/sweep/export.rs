//! The fragilities of a finished sweep, for other programs.

use rocking::block::Block;
use rocking::integrator::Model;
use rocking::intensity::Intensity;
use rocking::statistics::Lognormal;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_exchange::{BlockFragility, Id, LimitState, unit_intensity};
use serde::Deserialize;

use super::content::Content;
use super::plan::Planned;
use super::tile;
use crate::failure::{At as _, Failure};

/// A row of a tile's fragilities; other columns are not read.
#[derive(Deserialize)]
struct Row {
    id: Id,
    alpha_rad: f64,
    p_rad_s: f64,
    eta: f64,
    im: Intensity,
    demand: f64,
    records: usize,
    reached: usize,
    shift: f64,
    median: Option<f64>,
    dispersion: Option<f64>,
}

/// The fragilities of all blocks in one intensity measure, in the order of
/// the plan: a limit state a demand.
///
/// # Errors
/// [`Failure`] for a tile that is not done, for a demand that the plan has
/// not, and for a block that some record never brings to a demand.
pub fn fragilities(
    planned: &Planned,
    intensity: Intensity,
    demands: &[f64],
) -> Result<Vec<BlockFragility>, Failure> {
    let plan = &planned.plan;
    let listed = |demands: &[f64]| {
        let words: Vec<String> = demands.iter().map(f64::to_string).collect();
        words.join(", ")
    };
    if let Some(found) = demands.iter().find(|d| !plan.demands.contains(d)) {
        return Err(Failure::input(format!(
            "demand {found}: expected some of {}, as planned",
            listed(&plan.demands)
        )));
    }
    let origin = format!(
        "sweep over {} records, {} at |theta|/alpha {}",
        plan.records.len(),
        intensity.words(),
        listed(demands),
    );
    let mut out: Vec<BlockFragility> = Vec::new();
    for tile in 0..plan.tiles.len() {
        let body = tile::body(planned, Content::Fragilities, tile)?;
        let path = planned.tile_path(Content::Fragilities, tile);
        let mut reader = csv::Reader::from_reader(body.as_bytes());
        for row in reader.deserialize() {
            let row: Row = row.at(path.display())?;
            if row.im != intensity || !demands.contains(&row.demand) {
                continue;
            }
            let block = Block::try_new(row.alpha_rad, row.p_rad_s)?;
            let state = limit_state(&row, &block)?;
            match out.last_mut().filter(|last| last.id == row.id) {
                Some(last) => last.limit_states.push(state),
                None => out.push(BlockFragility {
                    id: row.id,
                    block,
                    eta: Some(row.eta),
                    im: intensity.into(),
                    limit_states: vec![state],
                    origin: origin.clone(),
                }),
            }
        }
    }
    Ok(out)
}

/// The limit state of a row in the unit of the block's own intensity.
fn limit_state(row: &Row, block: &Block) -> Result<LimitState, Failure> {
    let (Some(median), Some(dispersion)) = (row.median, row.dispersion) else {
        return Err(Failure::input(format!(
            "{}: {} of {} records reach the demand {}: expected all, or a \
             demand that all of them reach",
            row.id, row.reached, row.records, row.demand
        )));
    };
    let log_mean = libm::log(median - row.shift);
    let law = Lognormal::try_new(row.shift, log_mean, dispersion)?;
    let (model, gravity) = (Model::Nonlinear, STANDARD_GRAVITY_M_S2);
    let unit = unit_intensity(row.im, block, model, gravity);
    let name = format!("demand_{}", row.demand).replace('.', "_");
    let name = name.parse().map_err(Failure::input)?;
    Ok(LimitState { name, fragility: law.scaled(unit)? })
}
