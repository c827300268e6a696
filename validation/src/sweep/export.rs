//! The fragilities of a finished sweep, for other programs.

use csv::StringRecord;
use rocking::integrator::Model;
use rocking::intensity::Intensity;
use rocking::statistics::Lognormal;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_exchange::{BlockFragility, LimitState, unit_intensity};
use serde::Deserialize;

use super::SweepError;
use super::content::Content;
use super::plan::{Given, Planned};
use super::tile::{self, State};

/// A row of a tile's fragilities; other columns are not read.
#[derive(Deserialize)]
struct Row {
    im: Intensity,
    demand: f64,
    records: usize,
    reached: usize,
    shift: f64,
    median: Option<f64>,
    dispersion: Option<f64>,
}

/// The fragilities of all blocks in one intensity measure, in the order of
/// the plan: a limit state a demand, the demands ascending.
///
/// # Errors
/// [`SweepError::Tile`] for a tile that is not done, [`SweepError::Demand`]
/// for a demand that the plan has not, [`SweepError::Censored`] for a block
/// that some record never brings to a demand.
pub fn fragilities(
    planned: &Planned,
    intensity: Intensity,
    demands: &[f64],
) -> Result<Vec<BlockFragility>, SweepError> {
    let plan = &planned.plan;
    let mut demands = demands.to_vec();
    demands.sort_by(f64::total_cmp);
    demands.dedup();
    for demand in &demands {
        if !plan.demands.contains(demand) {
            let words: Vec<String> =
                plan.demands.iter().map(f64::to_string).collect();
            let (found, expected) = (*demand, words.join(", "));
            return Err(SweepError::Demand { found, expected });
        }
    }
    let of = demands.iter().map(|x| format!("|theta|/alpha {x}"));
    let origin = format!(
        "sweep over {} records, {} at {}, shift at uplift",
        plan.records.len(),
        intensity.words(),
        of.collect::<Vec<_>>().join(", "),
    );
    let mut out = Vec::new();
    for tile in 0..plan.tiles.len() {
        let content = Content::Fragilities;
        let (state, body) = tile::read(planned, content, tile);
        if state != State::Done {
            let path = planned.tile_path(content, tile);
            return Err(SweepError::Tile { path, state });
        }
        let damaged = |e: csv::Error| SweepError::Statistics(e.to_string());
        let mut reader = csv::Reader::from_reader(body.as_bytes());
        let header = reader.headers().map_err(damaged)?.clone();
        let records: Vec<StringRecord> =
            reader.records().collect::<Result<_, _>>().map_err(damaged)?;
        let blocks = plan.blocks_of(tile);
        let each = records.len() / blocks.len();
        for (given, rows) in blocks.iter().zip(records.chunks(each)) {
            let rows = rows.iter().map(|row| row.deserialize(Some(&header)));
            let rows: Vec<Row> =
                rows.collect::<Result<_, _>>().map_err(damaged)?;
            let states = demands.iter().map(|demand| {
                let own =
                    |row: &&Row| row.im == intensity && row.demand == *demand;
                let row = rows.iter().find(own).ok_or_else(|| {
                    let demand = format!("no demand {demand}");
                    SweepError::Statistics(format!("{}: {demand}", given.id))
                })?;
                state_of(given, row, intensity)
            });
            out.push(BlockFragility {
                id: given.id.clone(),
                block: given.block()?,
                eta: Some(given.eta),
                im: intensity.into(),
                limit_states: states.collect::<Result<_, SweepError>>()?,
                origin: origin.clone(),
            });
        }
    }
    Ok(out)
}

/// The limit state of a row in the unit of the block's own intensity.
fn state_of(
    given: &Given,
    row: &Row,
    intensity: Intensity,
) -> Result<LimitState, SweepError> {
    let (Some(median), Some(dispersion)) = (row.median, row.dispersion) else {
        return Err(SweepError::Censored {
            id: given.id.clone(),
            reached: row.reached,
            records: row.records,
            demand: row.demand,
        });
    };
    let log_mean = libm::log(median - row.shift);
    let law = Lognormal::try_new(row.shift, log_mean, dispersion)?;
    let gravity_m_s2 = STANDARD_GRAVITY_M_S2;
    let model = Model::Nonlinear;
    let unit = unit_intensity(intensity, &given.block()?, model, gravity_m_s2);
    // An angle of alpha is no way back.
    let name = match row.demand {
        1.0 => "overturning".to_owned(),
        demand => format!("theta_{demand}").replace('.', "_"),
    };
    let name = name.parse().map_err(SweepError::Name)?;
    Ok(LimitState { name, fragility: law.scaled(unit)? })
}
