//! The table of an incremental dynamic analysis as CSV: one row an analysis.

use std::collections::BTreeSet;
use std::io::Read;
use std::path::Path;

use rocking::capacity::{CapacityError, ResponseCurve};
use rocking::ida::{Adjust, Analysis, IdaCurve, IdaPoint};
use rocking::integrator::{Model, Order, Outcome, Overturning};
use rocking_records::intensity::Intensity;
use rocking_statistics::Clusters;

use crate::columns::IDA;
use crate::read::{Cells, FileError, Result, reader, rows};
use crate::table::Table;

/// Names of outcomes of an analysis.
const OUTCOMES: [&str; 5] =
    ["no-uplift", "rocked", "overturned", "overturned-refined", "unresolved"];

/// The outcome of the refined end of a bracket.
const REFINED: &str = OUTCOMES[3];

/// The settings of all rows of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Setting {
    /// Frequency parameter in rad/s.
    pub p_rad_s: f64,
    /// Coefficient of restitution.
    pub eta: f64,
    /// Equation of motion.
    pub model: Model,
    /// Order of the Taylor polynomial, if it was fixed. A table of a fixed
    /// order is written, for comparisons, but not read: its errors come from
    /// the order, not from chance, so it allows no statistics.
    pub order: Option<Order>,
    /// Overturning criterion.
    pub overturn: Overturning,
    /// How intensity is reached.
    pub by: Adjust,
    /// Gravity in m/s2.
    pub gravity_m_s2: f64,
    /// Processing of the records, in words.
    pub processing: String,
    /// Program, version and commit.
    pub software: String,
}

/// One analysis.
#[derive(Clone, Debug, PartialEq)]
pub struct IdaRow {
    /// The record.
    pub record: String,
    /// Slenderness angle in rad.
    pub alpha_rad: f64,
    /// PGA in g.
    pub pga_g: f64,
    /// PGV in m/s.
    pub pgv_m_s: f64,
    /// PGA/(g tan alpha).
    pub intensity_pga: f64,
    /// p PGV/(g tan alpha).
    pub intensity_pgv: f64,
    /// Peak |theta|/alpha; infinite if overturned.
    pub edp: f64,
    /// `no-uplift`, `rocked`, `overturned`, `overturned-refined` or
    /// `unresolved`.
    pub outcome: &'static str,
    /// Margin to the other outcome, in units of alpha.
    pub margin: f64,
    /// Codes of the remarks on the record.
    pub remarks: String,
    /// Earthquake of the record; empty if unknown.
    pub event: String,
}

/// The table of one analysis of a suite.
#[derive(Clone, Debug, PartialEq)]
pub struct IdaTable {
    /// Settings of all rows.
    pub setting: Setting,
    /// The rows, by record, then level.
    pub rows: Vec<IdaRow>,
    /// The first row of each record.
    starts: Vec<usize>,
}

/// The response curves of a table against an intensity measure.
#[derive(Clone, Debug)]
pub struct Curves {
    /// Records and their curves, in the order of the table.
    pub curves: Vec<(String, ResponseCurve)>,
    /// The records by earthquake, if the table states it.
    pub clusters: Clusters,
    /// IM_R: 1 for PGA, the lowest onset for another measure.
    pub im_r: f64,
    /// Rows past their record's first overturning, not used.
    pub after_overturning: usize,
    /// Whether the measure is the square of the curves' intensity, which stays
    /// linear in the acceleration.
    pub squared: bool,
}

impl Curves {
    /// The curves without their records, in the order of the table.
    pub fn into_curves(self) -> Vec<ResponseCurve> {
        self.curves.into_iter().map(|(_, curve)| curve).collect()
    }

    /// The curves against another measure, proportional to the intensity or to
    /// its square; `at_one` has its value at intensity 1 for each curve.
    ///
    /// # Errors
    /// [`CapacityError::Factor`] for a value that is not positive.
    pub fn against(
        mut self,
        at_one: &[f64],
        squared: bool,
    ) -> Result<Self, CapacityError> {
        for ((_, curve), &factor) in self.curves.iter_mut().zip(at_one) {
            let factor = if squared { factor.sqrt() } else { factor };
            *curve = curve.scaled(factor)?;
        }
        let onsets = self.curves.iter().map(|(_, curve)| curve.onset_im());
        self.im_r = onsets.fold(f64::INFINITY, f64::min);
        self.squared = squared;
        Ok(self)
    }

    /// The measure at an intensity of the curves.
    pub fn measured(&self, im: f64) -> f64 {
        if self.squared { im * im } else { im }
    }
}

impl IdaTable {
    /// The table of the curves of an analysis. The pair of texts is the
    /// processing of the records and the program; `known` gives the codes of
    /// the remarks on a record, and its earthquake, empty if unknown.
    pub fn of(
        curves: &[IdaCurve],
        analysis: &Analysis,
        gravity_m_s2: f64,
        (processing, software): (&str, &str),
        known: impl Fn(&str) -> (String, String),
    ) -> Self {
        let p_rad_s = analysis.block.frequency_rad_s();
        let setting = Setting {
            p_rad_s,
            eta: analysis.restitution.velocity_ratio(),
            model: analysis.model,
            order: analysis.order,
            overturn: analysis.overturning,
            by: analysis.adjust,
            gravity_m_s2,
            processing: processing.to_owned(),
            software: software.to_owned(),
        };
        let (mut rows, mut starts) = (Vec::new(), Vec::new());
        for curve in curves {
            starts.push(rows.len());
            let (remarks, event) = known(&curve.record);
            let factor = curve.velocity_factor(p_rad_s);
            let mut row = |point: &IdaPoint, outcome| {
                rows.push(IdaRow {
                    record: curve.record.clone(),
                    alpha_rad: point.slenderness_rad,
                    pga_g: point.pga_g,
                    pgv_m_s: point.pga_g
                        * curve.velocity_ratio_s
                        * gravity_m_s2,
                    intensity_pga: point.im,
                    intensity_pgv: point.im * factor,
                    edp: point.edp(),
                    outcome,
                    margin: point.fate_margin,
                    remarks: remarks.clone(),
                    event: event.clone(),
                });
            };
            row(&curve.onset, OUTCOMES[0]);
            for point in curve.points.iter().chain(&curve.above) {
                row(point, outcome(point));
            }
            let refined = curve.overturning.and_then(|first| first.refined);
            if let Some(point) = refined {
                row(&point, REFINED);
            }
        }
        Self { setting, rows, starts }
    }

    /// The CSV text.
    pub fn csv(&self) -> String {
        let s = &self.setting;
        let cell = |row: &IdaRow, column| match column {
            "record" => row.record.clone(),
            "alpha_rad" => row.alpha_rad.to_string(),
            "p_rad_s" => s.p_rad_s.to_string(),
            "pga_g" => row.pga_g.to_string(),
            "pgv_m_s" => row.pgv_m_s.to_string(),
            "intensity_pga" => row.intensity_pga.to_string(),
            "intensity_pgv" => row.intensity_pgv.to_string(),
            "edp" => row.edp.to_string(),
            "outcome" => row.outcome.to_owned(),
            "margin" => row.margin.to_string(),
            "remarks" => row.remarks.clone(),
            "event" => row.event.clone(),
            "eta" => s.eta.to_string(),
            "model" => s.model.to_string(),
            "order" => s.order.map_or(String::new(), |o| o.to_string()),
            "overturn" => s.overturn.to_string(),
            "by" => s.by.to_string(),
            "gravity_m_s2" => s.gravity_m_s2.to_string(),
            "processing" => s.processing.clone(),
            "software" => s.software.clone(),
            other => unreachable!("no cell for column {other}"),
        };
        let mut table = Table::of(&IDA);
        for row in &self.rows {
            table.row(IDA.columns.iter().map(|column| cell(row, column.name)));
        }
        table.finish()
    }

    /// Reads a table; `path` is its name in messages.
    ///
    /// # Errors
    /// [`FileError`] with file and line.
    pub fn read(from: impl Read, path: &Path) -> Result<Self, FileError> {
        let mut reader = reader(from, csv::Trim::None, None);
        let mut first: Option<(Cells<'_>, Setting)> = None;
        let (mut found, mut begin): (Vec<IdaRow>, _) =
            (Vec::new(), Vec::new());
        let mut seen = BTreeSet::new();
        for cells in rows(&IDA, &mut reader, path)? {
            let cells = cells?;
            let row = IdaRow::of(&cells)?;
            match &first {
                None => first = Some((cells.clone(), Setting::of(&cells)?)),
                Some((first, setting)) => setting.holds(&cells, first)?,
            }
            let starts = found.last().is_none_or(|b| b.record != row.record);
            if starts && !seen.insert(row.record.clone()) {
                return Err(cells.error(format_args!(
                    "record {} is repeated: expected its rows together",
                    row.record
                )));
            }
            match found.last() {
                Some(before) if !starts => row.follows(before, &cells)?,
                _ => begin.push(found.len()),
            }
            let first = found.first().map_or(&row, |first| first);
            if first.event.is_empty() != row.event.is_empty() {
                let expected = "the earthquake of every record, or of none";
                return Err(cells.refuse("event", expected));
            }
            found.push(row);
        }
        let (_, setting) = first.ok_or_else(|| {
            FileError::new(path, None, "no analysis in the file")
        })?;
        Ok(Self { setting, rows: found, starts: begin })
    }

    /// The rows of each record.
    pub fn by_record(&self) -> impl Iterator<Item = &[IdaRow]> {
        let ends = self.starts.iter().skip(1).copied();
        let ends = ends.chain([self.rows.len()]);
        let ranges = self.starts.iter().zip(ends);
        ranges.map(|(start, end)| &self.rows[*start..end])
    }

    /// The records, in the order of the table.
    pub fn records(&self) -> impl Iterator<Item = &str> {
        self.by_record().map(|rows| rows[0].record.as_str())
    }

    /// The earthquakes of the records, in the order of the table; `None` if
    /// the table does not state them.
    pub fn events(&self) -> Option<Vec<&str>> {
        let events = self.by_record().map(|rows| rows[0].event.as_str());
        events.map(|event| Some(event).filter(|e| !e.is_empty())).collect()
    }

    /// The records by earthquake, if the table states it.
    pub fn clusters(&self) -> Clusters {
        let records = || Clusters::singletons(self.records().count());
        self.events().map_or_else(records, Clusters::from_labels)
    }

    /// Slenderness angle in rad of the block; `None` if it is adjusted.
    pub fn alpha_rad(&self) -> Option<f64> {
        let first = self.rows.first().map(|row| row.alpha_rad);
        first.filter(|_| self.setting.by == Adjust::RecordScaling)
    }

    /// The curves against a measure; the error names the record.
    ///
    /// First overturning is the refined end of its bracket if there is one,
    /// else the first overturned row of the scan.
    ///
    /// # Errors
    /// [`CapacityError`] if the rows of a record make no curve.
    pub fn curves(
        &self,
        measure: Intensity,
    ) -> Result<Curves, (String, CapacityError)> {
        let im =
            |row: &IdaRow| measure.of(row.intensity_pga, row.intensity_pgv);
        let (mut curves, mut after_overturning) = (Vec::new(), 0);
        for rows in self.by_record() {
            let end = rows.iter().position(|row| row.edp == f64::INFINITY);
            let (standing, above) = rows.split_at(end.unwrap_or(rows.len()));
            let vertices: Vec<(f64, f64)> =
                standing.iter().map(|row| (im(row), row.edp)).collect();
            let refined = rows.iter().find(|row| row.is_refined());
            let overturning = refined.or(above.first()).map(im);
            let later = above.iter().skip(1).filter(|row| !row.is_refined());
            after_overturning += later.count();
            let record = rows[0].record.clone();
            match ResponseCurve::try_new(&vertices, overturning) {
                Ok(curve) => curves.push((record, curve)),
                Err(error) => return Err((record, error)),
            }
        }
        let onsets = curves.iter().map(|(_, curve)| curve.onset_im());
        let im_r = match measure {
            Intensity::Pga => 1.0,
            _ => onsets.fold(f64::INFINITY, f64::min),
        };
        let (clusters, squared) = (self.clusters(), false);
        Ok(Curves { curves, clusters, im_r, after_overturning, squared })
    }
}

/// The name of the outcome of an analysis.
fn outcome(point: &IdaPoint) -> &'static str {
    match point.outcome {
        _ if !point.resolution.resolved => OUTCOMES[4],
        Outcome::NoUplift => OUTCOMES[0],
        Outcome::Rocked { .. } => OUTCOMES[1],
        Outcome::Overturned { .. } => OUTCOMES[2],
    }
}

/// A positive number.
fn positive(cells: &Cells<'_>, column: &str) -> Result<f64> {
    let fits = |x: &f64| *x > 0.0 && x.is_finite();
    cells.parsed(column, fits, "a positive number")
}

impl Setting {
    fn of(cells: &Cells<'_>) -> Result<Self> {
        let of = "a name that this program writes";
        let share = |x: &f64| (0.0..=1.0).contains(x);
        if !cells.text("order").is_empty() {
            let expected = "an empty cell: only a table without a fixed order \
                            is read, from `rocking ida` without --order";
            return Err(cells.refuse("order", expected));
        }
        Ok(Self {
            p_rad_s: positive(cells, "p_rad_s")?,
            eta: cells.parsed("eta", share, "a number from 0 to 1")?,
            model: cells.parsed("model", |_| true, of)?,
            order: None,
            overturn: cells.parsed("overturn", |_| true, of)?,
            by: cells.parsed("by", |_| true, of)?,
            gravity_m_s2: positive(cells, "gravity_m_s2")?,
            processing: cells.text("processing").to_owned(),
            software: cells.text("software").to_owned(),
        })
    }

    /// Refuses a row of another analysis.
    fn holds(&self, cells: &Cells<'_>, first: &Cells<'_>) -> Result<()> {
        let alpha = (self.by == Adjust::RecordScaling).then_some("alpha_rad");
        let last = IDA.columns[IDA.place("eta")..].iter().map(|own| own.name);
        for name in alpha.into_iter().chain(["p_rad_s"]).chain(last) {
            let (found, expected) = (cells.text(name), first.text(name));
            if found != expected {
                return Err(cells.error(format_args!(
                    "{name} is {found}: expected {expected}, as on the first \
                     row: a table of one analysis"
                )));
            }
        }
        Ok(())
    }
}

impl IdaRow {
    /// Whether it is the refined end of the bracket of a first overturning.
    pub fn is_refined(&self) -> bool {
        self.outcome == REFINED
    }

    /// Refuses a row that is not the next one of the record of `before`:
    /// levels rise, and a refined first overturning ends them.
    fn follows(&self, before: &Self, cells: &Cells<'_>) -> Result<()> {
        let rises = self.intensity_pga > before.intensity_pga;
        if (rises || self.is_refined()) && !before.is_refined() {
            return Ok(());
        }
        Err(cells.error(format_args!(
            "record {}: intensity_pga {} after {}: expected rising levels, a \
             refined overturning last; do two records share the name?",
            self.record, self.intensity_pga, before.intensity_pga
        )))
    }

    fn of(cells: &Cells<'_>) -> Result<Self> {
        let not_negative = |column| {
            let expected = "a number, not negative, or inf";
            cells.parsed(column, |x: &f64| *x >= 0.0, expected)
        };
        let is_it = |name: &&str| *name == cells.text("outcome");
        let outcome = OUTCOMES.into_iter().find(is_it);
        let outcome = outcome.ok_or_else(|| {
            let outcomes = "no-uplift, rocked, overturned, \
                            overturned-refined or unresolved";
            cells.refuse("outcome", outcomes)
        })?;
        let edp = not_negative("edp")?;
        if outcome.starts_with("overturned") != edp.is_infinite()
            && outcome != OUTCOMES[4]
        {
            let expected = "inf where overturned, and only there";
            return Err(cells.refuse("edp", expected));
        }
        Ok(Self {
            record: cells.name("record")?.to_owned(),
            alpha_rad: positive(cells, "alpha_rad")?,
            pga_g: not_negative("pga_g")?,
            pgv_m_s: not_negative("pgv_m_s")?,
            intensity_pga: not_negative("intensity_pga")?,
            intensity_pgv: not_negative("intensity_pgv")?,
            edp,
            outcome,
            margin: cells.parsed("margin", |_| true, "a number")?,
            remarks: cells.text("remarks").to_owned(),
            event: cells.name("event")?.to_owned(),
        })
    }
}

#[cfg(test)]
mod tests;
