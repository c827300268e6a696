//! Curves that finished sweeps keep, for whoever would make them again.

use std::path::Path;
use std::sync::atomic::{AtomicU64, Ordering};

use csv::StringRecord;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{
    Analysis, Certification, FirstOverturning, IdaCurve, IdaPoint, Told,
};
use rocking::integrator::{Outcome, Side, uplift_threshold};

use super::content::Content;
use super::plan::Planned;
use super::tile::{self, State};
use super::{Flaw, SweepError};

/// Curves of finished sweeps, and how many analyses they saved.
#[derive(Debug, Default)]
pub struct Kept {
    sweeps: Vec<Sweep>,
    taken: AtomicU64,
    made: AtomicU64,
}

#[derive(Debug)]
struct Sweep {
    records: Vec<NormalisedRecord>,
    /// What was run of each block, and its curves by record.
    blocks: Vec<(Analysis, Vec<IdaCurve>)>,
}

impl Kept {
    /// Reads all rows of the sweeps in these folders.
    ///
    /// # Errors
    /// [`SweepError::Kept`] for a sweep that keeps no rows or is of another
    /// program than `software`, [`SweepError::Tile`] for a tile that is
    /// missing, of another plan, or damaged, and [`SweepError::Record`] for
    /// a record that is another than planned.
    pub fn read<P: AsRef<Path>>(
        folders: &[P],
        software: &str,
    ) -> Result<Self, SweepError> {
        let read = |folder: &P| Sweep::read(folder.as_ref(), software);
        let sweeps = folders.iter().map(read).collect::<Result<_, _>>()?;
        Ok(Self { sweeps, ..Self::default() })
    }

    /// The curves of `records` under `analysis`, where one sweep has all of
    /// them: of the same settings, and of records with the same name, interval
    /// and samples, bit by bit.
    ///
    /// A sweep does not keep margins, nor when and to which side a block
    /// overturned, nor the standing end of a bracket, nor which arithmetic
    /// told what: they are NaN, positive and empty.
    #[must_use]
    pub fn find(
        &self,
        analysis: &Analysis,
        records: &[NormalisedRecord],
    ) -> Option<Vec<IdaCurve>> {
        self.sweeps.iter().find_map(|sweep| sweep.find(analysis, records))
    }

    /// Counts analyses that were taken from sweeps, and those made.
    pub fn count(&self, taken: u64, made: u64) {
        self.taken.fetch_add(taken, Ordering::Relaxed);
        self.made.fetch_add(made, Ordering::Relaxed);
    }

    /// Analyses taken from sweeps, and those made.
    #[must_use]
    pub fn counts(&self) -> (u64, u64) {
        let [taken, made] = [&self.taken, &self.made];
        (taken.load(Ordering::Relaxed), made.load(Ordering::Relaxed))
    }
}

impl Sweep {
    fn read(folder: &Path, software: &str) -> Result<Self, SweepError> {
        let planned = Planned::read(folder)?;
        let refused = |flaw| SweepError::Kept { path: folder.into(), flaw };
        let plan = &planned.plan;
        if !plan.rows {
            return Err(refused(Flaw::NoRows));
        }
        if plan.software != software {
            let found = plan.software.clone();
            let expected = software.to_owned();
            return Err(refused(Flaw::Software { found, expected }));
        }
        let records: Vec<NormalisedRecord> =
            planned.records()?.iter().map(NormalisedRecord::new).collect();
        let mut blocks = Vec::with_capacity(plan.blocks.len());
        for tile in 0..plan.tiles.len() {
            let mut rows = Rows::open(&planned, Content::Rows, tile)?;
            let mut totals = Rows::open(&planned, Content::Capacities, tile)?;
            for block in plan.blocks_of(tile) {
                let analysis = plan.analysis(*block)?;
                let curves = records
                    .iter()
                    .map(|record| {
                        totals.curve(&mut rows, block, &analysis, record)
                    })
                    .collect::<Option<Vec<_>>>();
                let curves = curves.ok_or_else(|| SweepError::Tile {
                    path: planned.tile_path(Content::Rows, tile),
                    state: State::Damaged,
                })?;
                blocks.push((analysis, curves));
            }
        }
        Ok(Self { records, blocks })
    }

    fn find(
        &self,
        analysis: &Analysis,
        records: &[NormalisedRecord],
    ) -> Option<Vec<IdaCurve>> {
        let (_, curves) = self.blocks.iter().find(|b| b.0 == *analysis)?;
        let own = |record: &NormalisedRecord| {
            let at = self.records.iter().position(|own| same(own, record))?;
            Some(curves[at].clone())
        };
        records.iter().map(own).collect()
    }
}

/// Whether two records have the same name and bits.
fn same(a: &NormalisedRecord, b: &NormalisedRecord) -> bool {
    let bits = |x: f64, y: f64| x.to_bits() == y.to_bits();
    a.name() == b.name()
        && bits(a.dt_s(), b.dt_s())
        && bits(a.pga_g(), b.pga_g())
        && bits(a.velocity_ratio_s(), b.velocity_ratio_s())
        && a.samples().len() == b.samples().len()
        && a.samples().iter().zip(b.samples()).all(|(x, y)| bits(*x, *y))
}

/// Rows of a tile, one after the other.
struct Rows {
    columns: Vec<String>,
    rows: Vec<StringRecord>,
    /// The next row.
    at: usize,
}

impl Rows {
    fn open(
        planned: &Planned,
        content: Content,
        tile: usize,
    ) -> Result<Self, SweepError> {
        let (state, body) = tile::read(planned, content, tile);
        let path = || planned.tile_path(content, tile);
        if state != State::Done {
            return Err(SweepError::Tile { path: path(), state });
        }
        let damaged =
            |_| SweepError::Tile { path: path(), state: State::Damaged };
        let rows: Vec<StringRecord> =
            csv::Reader::from_reader(body.as_bytes())
                .into_records()
                .collect::<Result<_, _>>()
                .map_err(damaged)?;
        let columns = content.columns(&planned.plan);
        let columns = columns.into_iter().map(|(name, _)| name).collect();
        Ok(Self { columns, rows, at: 0 })
    }

    fn cell<'r>(&self, row: &'r StringRecord, name: &str) -> Option<&'r str> {
        row.get(self.columns.iter().position(|column| column == name)?)
    }

    fn number(&self, row: &StringRecord, name: &str) -> Option<f64> {
        self.cell(row, name)?.parse().ok()
    }

    /// Whether the next row is of this block and record.
    fn is_next(&self, row: &StringRecord, block: &[f64; 3], of: &str) -> bool {
        let names = ["alpha_rad", "p_rad_s", "eta"];
        let own = names.map(|name| self.number(row, name));
        own == block.map(Some) && self.cell(row, "record") == Some(of)
    }

    /// The next curve, whose totals are the next row of this table; none
    /// where the tables hold another one.
    fn curve(
        &mut self,
        rows: &mut Rows,
        block: &[f64; 3],
        analysis: &Analysis,
        record: &NormalisedRecord,
    ) -> Option<IdaCurve> {
        let totals = self.rows.get(self.at)?;
        if !self.is_next(totals, block, record.name()) {
            return None;
        }
        let analyses = self.cell(totals, "analyses")?.parse().ok()?;
        self.at += 1;
        let point = |im, pga_g, outcome, fate_margin, resolved| IdaPoint {
            im,
            pga_g,
            slenderness_rad: analysis.block.slenderness_rad(),
            outcome,
            fate_margin,
            told: Told {
                by: None,
                resolved,
                moved: false,
                for_inputs: resolved,
            },
        };
        let mut points: Vec<IdaPoint> = Vec::new();
        let mut refined = None;
        while let Some(row) = rows.rows.get(rows.at) {
            let im = rows.number(row, "im")?;
            let rises = points.last().is_none_or(|last| im > last.im);
            let is_end = rows.cell(row, "refined")? == "true";
            if !rows.is_next(row, block, record.name()) || !(rises || is_end) {
                break;
            }
            let edp = rows.number(row, "edp")?;
            let outcome = match edp {
                f64::INFINITY => Outcome::Overturned {
                    time_s: f64::NAN,
                    side: Side::Positive,
                },
                0.0 => Outcome::NoUplift,
                _ => Outcome::Rocked { peak_ratio: edp },
            };
            let resolved = rows.cell(row, "resolved")? == "true";
            let pga_g = rows.number(row, "pga_g")?;
            let made = point(im, pga_g, outcome, f64::NAN, resolved);
            rows.at += 1;
            if is_end {
                refined = Some(made);
                break;
            }
            points.push(made);
        }
        let threshold = uplift_threshold(&analysis.block, analysis.model);
        let last = points.last().copied();
        let overturned = last.filter(|last| last.outcome.is_overturned());
        Some(IdaCurve {
            record: record.name().to_owned(),
            record_pga_g: record.pga_g(),
            velocity_ratio_s: record.velocity_ratio_s(),
            onset: point(1.0, threshold, Outcome::NoUplift, 0.0, true),
            points,
            overturning: overturned.map(|last| FirstOverturning {
                scanned_im: last.im,
                refined,
                standing_im: f64::NAN,
            }),
            above: Vec::new(),
            certification: Certification::default(),
            analyses,
        })
    }
}
