//! Tiles: run, and held to their plan and their sum.

use std::fs;

use rocking::capacity::InversionRule;
use rocking::ida::{Batch, BracketEnd, IdaCurve, curves};
use rocking_records::intensity::Intensity;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::lognormal::{FitMethod, fit};
use rocking_statistics::resampling::Resampling;
use rocking_statistics::{ExtendedSample, Range};

use super::content::Content;
use super::plan::{REPLICATES, SweepBlock, SweepFolder, SweepPlan};
use crate::failure::{AtPlace as _, Failure, ensure};
use rocking::names::named;
use rocking_common::files::write_atomically;
use rocking_common::suites::inputs::sha256_hex;
use rocking_common::table::Table;

named! {
    /// Why a tile is not done.
    pub enum TileState: "state of a tile" {
        /// Not there.
        Missing = "missing",
        /// Of another plan, or by another build of the program.
        Foreign = "of another plan or another build of the program",
        /// Its bytes do not have the sum that it states.
        Damaged = "damaged: its sum is another",
    }
}

/// The last line of a tile's file.
fn footer(planned: &SweepFolder, tile: usize, body: &str) -> String {
    let (of, sum) = (source(planned), sha256_hex(body.as_bytes()));
    format!("{of} tile {tile} sha256 {sum}\n")
}

/// How it begins: the plan, and the program that made plan and tile.
fn source(planned: &SweepFolder) -> String {
    format!("# plan {} by {}", planned.hash, planned.plan.software)
}

/// The text of a tile's file without the last line, or why it is not done.
pub(super) fn read(
    planned: &SweepFolder,
    content: Content,
    tile: usize,
) -> Result<String, TileState> {
    use TileState::{Damaged, Foreign, Missing};
    let path = planned.tile_path(content, tile);
    let Ok(text) = fs::read_to_string(&path) else {
        // A file that exists but is not text was not written by this program.
        return Err(if path.exists() { Damaged } else { Missing });
    };
    let at = text.trim_end().rfind('\n').ok_or(Damaged)? + 1;
    let (body, last) = text.split_at(at);
    if last == footer(planned, tile, body) {
        return Ok(body.to_owned());
    }
    let of_plan = last.starts_with(&format!("{} ", source(planned)));
    let has_plan = last.starts_with("# plan ");
    Err(if has_plan && !of_plan { Foreign } else { Damaged })
}

/// The tiles of task `task` of `of` that are not done.
pub fn left(planned: &SweepFolder, (task, of): (usize, usize)) -> Vec<usize> {
    let kept = Content::kept(&planned.plan);
    let is_done =
        |tile| kept.iter().all(|what| read(planned, *what, tile).is_ok());
    let own = (task..planned.plan.tiles()).step_by(of);
    own.filter(|tile| !is_done(*tile)).collect()
}

/// Runs the tiles of task `task` of `of` that are not done, by the program
/// `software`; `done` receives each tile that was finished. A tile that is
/// stopped leaves no file.
///
/// # Errors
/// [`Failure`] for a plan of another build of the program, a record that is
/// another than planned, an analysis that cannot be done, and a tile that
/// cannot be written.
pub fn run(
    planned: &SweepFolder,
    software: &str,
    task_of: (usize, usize),
    done: &(dyn Fn(usize) + Sync),
) -> Result<(), Failure> {
    let plan = &planned.plan;
    ensure!(
        plan.software == software,
        "{}: a plan of {}: expected a plan of this program, {software}; \
         tiles of two builds may differ",
        planned.folder.display(),
        plan.software
    );
    let left = left(planned, task_of);
    if left.is_empty() {
        return Ok(());
    }
    let first = planned.records(0)?;
    for tile in left {
        let blocks = plan.blocks_of(tile);
        let analyses = blocks
            .iter()
            .map(|block| plan.analysis(block))
            .collect::<Result<Vec<_>, _>>()?;
        let mut all: Vec<TileBlock<'_>> =
            blocks.iter().map(TileBlock::new).collect();
        let mut from = 0;
        while from < plan.records.len() {
            let next = match from {
                0 => Vec::new(),
                _ => planned.records(from)?,
            };
            let records = if from == 0 { &first } else { &next };
            let found = curves(records, &analyses, &Batch::default())?;
            for (all, curves) in all.iter_mut().zip(&found) {
                for curve in curves {
                    all.add(plan, curve)?;
                }
            }
            from += records.len();
        }
        for content in Content::kept(plan) {
            let body = text(plan, content, &all);
            let text = footer(planned, tile, &body);
            write_atomically(&planned.tile_path(content, tile), body + &text)?;
        }
        done(tile);
    }
    Ok(())
}

/// Results of the curves of a block.
struct TileBlock<'a> {
    block: &'a SweepBlock,
    curves: Vec<TileCurve>,
    /// Cells of the levels, if the plan keeps them.
    levels: Vec<[String; 6]>,
}

/// Results of a curve.
struct TileCurve {
    record: String,
    /// From PGA/(g tan alpha) to p PGV/(g tan alpha).
    factor: f64,
    overturning_im: f64,
    analyses: u64,
    unresolved: usize,
    /// At the plan's demands.
    capacities: Vec<f64>,
}

impl<'a> TileBlock<'a> {
    fn new(block: &'a SweepBlock) -> Self {
        Self { block, curves: Vec::new(), levels: Vec::new() }
    }

    fn add(
        &mut self,
        plan: &SweepPlan,
        curve: &IdaCurve,
    ) -> Result<(), Failure> {
        let response = curve.response(BracketEnd::Refined).at(&curve.record)?;
        let at = |demand: &f64| {
            let found = response.capacity(*demand, InversionRule::Median);
            Ok(found.at(&curve.record)?.im())
        };
        let capacities: Result<Vec<f64>, Failure> =
            plan.demands.iter().map(at).collect();
        let points = curve.points.iter();
        let overturning_im = curve.overturning.map(|o| o.im());
        self.curves.push(TileCurve {
            record: curve.record.clone(),
            factor: curve.velocity_factor(self.block.p_rad_s),
            overturning_im: overturning_im.unwrap_or(f64::INFINITY),
            analyses: curve.analyses,
            unresolved: points.filter(|p| !p.resolution.resolved).count(),
            capacities: capacities?,
        });
        if plan.rows {
            let refined = curve.overturning.and_then(|o| o.refined);
            let scanned = curve.points.iter().map(|point| (point, false));
            for (point, refined) in
                scanned.chain(refined.iter().map(|point| (point, true)))
            {
                self.levels.push([
                    curve.record.clone(),
                    point.im.to_string(),
                    point.pga_g.to_string(),
                    point.edp().to_string(),
                    refined.to_string(),
                    point.resolution.resolved.to_string(),
                ]);
            }
        }
        Ok(())
    }
}

/// The text of a tile's file without its last line.
fn text(plan: &SweepPlan, content: Content, all: &[TileBlock<'_>]) -> String {
    let header = content.columns(plan);
    let header: Vec<&str> = header.iter().map(String::as_str).collect();
    let mut table = Table::with_schema(&header);
    for found in all {
        let parameters = found.block.cells();
        let mut row = |cells: &[String]| {
            let own = [found.block.id.to_string()].into_iter();
            let own = own.chain(parameters.clone());
            table.row(own.chain(cells.iter().cloned()));
        };
        match content {
            Content::Rows => found.levels.iter().for_each(|cells| row(cells)),
            Content::Capacities => {
                for curve in &found.curves {
                    let mut cells = vec![
                        curve.record.clone(),
                        curve.factor.to_string(),
                        curve.overturning_im.to_string(),
                        curve.analyses.to_string(),
                        curve.unresolved.to_string(),
                    ];
                    let own = curve.capacities.iter();
                    cells.extend(own.map(ToString::to_string));
                    row(&cells);
                }
            }
            Content::Fragilities => {
                let curves = &found.curves;
                let open: usize = curves.iter().map(|c| c.unresolved).sum();
                for im in Intensity::ALL {
                    let factors: Vec<f64> =
                        curves.iter().map(|c| im.of(1.0, c.factor)).collect();
                    for (k, demand) in plan.demands.iter().enumerate() {
                        let sample: Vec<f64> = curves
                            .iter()
                            .zip(&factors)
                            .map(|(curve, x)| curve.capacities[k] * x)
                            .collect();
                        let mut cells = vec![
                            im.to_string(),
                            demand.to_string(),
                            sample.len().to_string(),
                        ];
                        let own =
                            fragility(plan, &parameters, &sample, &factors);
                        cells.extend(own);
                        cells.push(open.to_string());
                        row(&cells);
                    }
                }
            }
        }
    }
    table.finish()
}

/// Values reached, shift, and the median and dispersion of the shifted
/// lognormal by maximum likelihood with their 95 % intervals of the bootstrap,
/// of earthquakes if the plan has them; empty if some record never reaches the
/// demand.
fn fragility(
    plan: &SweepPlan,
    name: &[String; 3],
    sample: &[f64],
    onsets: &[f64],
) -> Vec<String> {
    let least = |of: &mut dyn Iterator<Item = f64>| {
        of.fold(f64::INFINITY, |m, x| if x < m { x } else { m })
    };
    let shift = least(&mut onsets.iter().copied());
    let reached = sample.iter().filter(|x| x.is_finite()).count();
    let of = |values: &[f64], shift: f64| -> Option<[f64; 2]> {
        let sample = ExtendedSample::try_new(values).ok()?;
        let fitted = fit(&sample, shift, FitMethod::MaximumLikelihood).ok()?;
        let lognormal = fitted.distribution;
        Some([lognormal.median(), lognormal.dispersion()])
    };
    // A shift that is the least onset leaves the least capacity above it.
    let found = of(sample, shift);
    // Streams are named by the block, not by the tile.
    let stream = format!("sweep/{}", name.join("/"));
    let clusters = plan.clusters();
    let draws = Bootstrap::of_clusters(&stream, 0, &clusters, REPLICATES);
    let replicates: Vec<Option<[f64; 2]>> = draws.map(|places| {
        let values: Vec<f64> = places.iter().map(|i| sample[*i]).collect();
        of(&values, least(&mut places.iter().map(|i| onsets[*i])))
    });
    let interval = |k: usize| -> [f64; 2] {
        let of = |found: &Option<[f64; 2]>| found.map_or(f64::NAN, |x| x[k]);
        let values: Vec<f64> = replicates.iter().map(of).collect();
        let (how, range) = (Resampling::Bootstrap, Range::NotNegative);
        let ends = clusters.estimate(of(&found), &values, how, range, 0.95);
        ends.map_or([f64::NAN; 2], |found| found.estimate.ends().into())
    };
    let found = found.unwrap_or([f64::NAN; 2]);
    let numbers = [shift, found[0], found[1]].into_iter();
    let numbers = numbers.chain(interval(0)).chain(interval(1));
    let reached = [reached.to_string()].into_iter();
    reached.chain(numbers.map(rocking_common::table::number)).collect()
}
