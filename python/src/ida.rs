//! Incremental dynamic analysis of a suite, and questions to its table.

use std::collections::BTreeMap;
use std::fs::File;
use std::path::{Path, PathBuf};

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use rocking::accelerogram::Accelerogram;
use rocking::capacity::{CapacityError, InversionRule, ResponseCurve};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Batch, Grid, Resurrections, curves};
use rocking::integrator::uplift_threshold;
use rocking::stop;
use rocking_exchange::ida::{self as tables, Curves, IdaRow};
use rocking_procedures::counts::RecordOutcome;
use rocking_procedures::ranking::{CandidateMeasure, Covariate};
use rocking_procedures::{
    Draws, FitOptions, ProcedureError, capacities, fit_levels, fit_outcomes,
    pivot_forces, rank, stripes, summarise_ida,
};
use rocking_records::intensity::{AtUplift, Intensity, IntensityMeasure};

use crate::files::refuse_at;
use crate::given::{ExcitationInput, Physics, block_of, suite_of};
use crate::measures::{MeasuredSuite, Member, members_of};
use crate::procedures::{Fit, answer};
use crate::work::{self, refuse};

/// Levels and how they are reached.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct GridInput {
    step_g: Option<f64>,
    step_im: Option<f64>,
    refine: Option<f64>,
    by: String,
    certify: bool,
    highest_im: f64,
    /// An intensity, or true and a multiple of the first overturning.
    resurrections: Option<(bool, f64)>,
}

/// The analysis of a block by levels.
fn analysis_of(
    block: (f64, f64),
    physics: &Physics,
    scan: &GridInput,
) -> PyResult<Analysis> {
    let block = block_of(block)?;
    let grid = match (scan.step_im, scan.step_g) {
        (Some(step), None) => Grid::Im { step },
        (None, Some(step_g)) => Grid::Pga { step_g },
        _ => return Err(refuse("expected one of step_g and step_im")),
    };
    Ok(Analysis {
        model: physics.model()?,
        overturning: physics.overturning()?,
        grid,
        adjust: scan.by.parse().map_err(refuse)?,
        refine: scan.refine,
        highest_im: scan.highest_im,
        resurrections: scan.resurrections.map(|own| match own {
            (true, to) => Resurrections::Multiple(to),
            (false, to) => Resurrections::To(to),
        }),
        certify: scan.certify,
        ..Analysis::paper(block, physics.restitution(&block)?)
    })
}

/// The table of an IDA, and unless it was read the run that made it: the
/// analysis, and the JSON of its summary.
#[pyclass(frozen, name = "IdaTable", module = "rocking._rocking")]
pub struct PyIdaTable {
    table: tables::IdaTable,
    run: Option<(Analysis, String)>,
}

/// IDA of every record; `known` has the codes of its remarks and its
/// earthquake.
#[pyfunction]
pub fn ida<'py>(
    py: Python<'py>,
    block: (f64, f64),
    records: Vec<ExcitationInput<'py>>,
    known: Vec<(String, String)>,
    physics: Physics,
    scan: GridInput,
    gravity: f64,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<PyIdaTable> {
    let analysis = analysis_of(block, &physics, &scan)?;
    let records = suite_of(records)?;
    let found = work::run(py, threads, progress, records.len(), |done| {
        let units = normalised(&records);
        let batch = Batch { progress: &|| done.tick(), ..Batch::default() };
        curves(&units, &[analysis], &batch)
    })?
    .map_err(refuse)?;
    let curves = found.into_iter().flatten().collect::<Vec<_>>();
    let about = ("none", crate::SOFTWARE);
    let named = records.iter().map(Accelerogram::name).zip(known);
    let known: BTreeMap<&str, (String, String)> = named.collect();
    let known = |record: &str| known.get(record).cloned().unwrap_or_default();
    let table =
        tables::IdaTable::of(&curves, &analysis, gravity, about, known);
    let summary = summarise_ida(&curves, &analysis);
    let summary = serde_json::to_string(&summary).map_err(refuse)?;
    Ok(PyIdaTable { table, run: Some((analysis, summary)) })
}

/// The records at a peak of 1 g.
fn normalised(records: &[Accelerogram]) -> Vec<NormalisedRecord> {
    let unit = |record| {
        stop::point();
        NormalisedRecord::new(record)
    };
    records.par_iter().panic_fuse().map(unit).collect()
}

/// Reads the table of an IDA.
#[pyfunction]
pub fn read_ida(py: Python<'_>, path: PathBuf) -> PyResult<PyIdaTable> {
    let file = File::open(&path).map_err(|error| {
        refuse_at(&path, format!("{}: {error}", path.display()))
    })?;
    let read = || tables::IdaTable::read(file, &path);
    let table = work::alone(py, read)?.map_err(refuse)?;
    Ok(PyIdaTable { table, run: None })
}

/// The table of a CSV text, for pickles: with the block, the physics, the
/// levels and the summary of the run that made it.
#[pyfunction]
pub fn ida_of_csv(
    text: &str,
    run: Option<((f64, f64), Physics, GridInput, String)>,
) -> PyResult<PyIdaTable> {
    let table = tables::IdaTable::read(text.as_bytes(), Path::new("CSV"));
    let run = run.map(|(block, physics, scan, summary)| {
        Ok::<_, PyErr>((analysis_of(block, &physics, &scan)?, summary))
    });
    Ok(PyIdaTable { table: table.map_err(refuse)?, run: run.transpose()? })
}

impl PyIdaTable {
    /// The analysis and the summary of the run.
    fn run(&self) -> PyResult<&(Analysis, String)> {
        self.run.as_ref().ok_or_else(|| {
            refuse("a table that was read: expected the result of `ida`")
        })
    }

    /// Rejects records that differ from the records of the table.
    fn of_suite<'a>(
        &self,
        suite: impl Iterator<Item = &'a Accelerogram>,
    ) -> PyResult<()> {
        let own: Vec<&str> = self.table.records().collect();
        let found: Vec<&str> = suite.map(Accelerogram::name).collect();
        if own.len() != found.len() {
            let (own, found) = (own.len(), found.len());
            return Err(refuse(format!(
                "{found} records: expected the {own} of the IDA"
            )));
        }
        let mut all = found.iter().zip(&own).zip(1..);
        match all.find(|((found, own), _)| found != own) {
            None => Ok(()),
            Some(((found, own), number)) => Err(refuse(format!(
                "record {number} of the suite is {found}: expected {own}, as \
                 in the IDA"
            ))),
        }
    }

    fn ground(
        &self,
        py: Python<'_>,
        suite: Vec<Member<'_>>,
        ims: &[IntensityMeasure],
    ) -> PyResult<MeasuredSuite> {
        let setting = &self.table.setting;
        let Some(alpha_rad) = self.table.alpha_rad() else {
            return Err(refuse("the records are not scaled: no measure"));
        };
        let block = block_of((alpha_rad, setting.p_rad_s))?;
        let pga_g = uplift_threshold(&block, setting.model);
        let (p_rad_s, gravity_m_s2) = (setting.p_rad_s, setting.gravity_m_s2);
        let uplift = AtUplift { pga_g, p_rad_s, gravity_m_s2 };
        let members = members_of(suite)?;
        self.of_suite(members.iter().map(|member| &member.0))?;
        MeasuredSuite::of(py, uplift, members, ims)
    }
}

#[pymethods]
impl PyIdaTable {
    /// The CSV text, with the bytes of `rocking ida`.
    fn csv(&self) -> String {
        self.table.csv()
    }

    /// The first row of each record.
    fn starts(&self) -> Vec<usize> {
        let sizes = self.table.by_record().map(<[IdaRow]>::len);
        let next = |next: &mut usize, size| {
            let start = *next;
            *next += size;
            Some(start)
        };
        sizes.scan(0, next).collect()
    }

    /// The columns that differ by row.
    fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let rows = &self.table.rows;
        let out = PyDict::new(py);
        let texts = |text: fn(&IdaRow) -> &str| {
            rows.iter().map(text).collect::<Vec<&str>>()
        };
        let numbers = |value: fn(&IdaRow) -> f64| {
            rows.iter().map(value).collect::<Vec<f64>>().into_pyarray(py)
        };
        out.set_item("record", texts(|row| &row.record))?;
        out.set_item("alpha_rad", numbers(|row| row.alpha_rad))?;
        out.set_item("pga_g", numbers(|row| row.pga_g))?;
        out.set_item("pgv_m_s", numbers(|row| row.pgv_m_s))?;
        out.set_item("intensity_pga", numbers(|row| row.intensity_pga))?;
        out.set_item("intensity_pgv", numbers(|row| row.intensity_pgv))?;
        out.set_item("edp", numbers(|row| row.edp))?;
        out.set_item("outcome", texts(|row| row.outcome))?;
        out.set_item("margin", numbers(|row| row.margin))?;
        out.set_item("remarks", texts(|row| &row.remarks))?;
        out.set_item("event", texts(|row| &row.event))?;
        Ok(out)
    }

    /// What all rows share; no alpha if the slenderness is adjusted.
    fn setting<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let setting = &self.table.setting;
        let out = PyDict::new(py);
        out.set_item("alpha_rad", self.table.alpha_rad())?;
        out.set_item("p_rad_s", setting.p_rad_s)?;
        out.set_item("eta", setting.eta)?;
        out.set_item("model", setting.model.name())?;
        out.set_item("order", setting.order.map(|order| order.name()))?;
        out.set_item("overturn", setting.overturn.name())?;
        out.set_item("by", setting.by.name())?;
        out.set_item("gravity_m_s2", setting.gravity_m_s2)?;
        out.set_item("processing", &setting.processing)?;
        out.set_item("software", &setting.software)?;
        Ok(out)
    }

    /// The earthquakes of the records; none if they are not known.
    fn events(&self) -> Vec<&str> {
        self.table.events().unwrap_or_default()
    }

    /// The summary of the curves.
    fn summary(&self) -> PyResult<String> {
        Ok(self.run()?.1.clone())
    }

    /// The forces at the pivot in the analyses.
    fn pivot_forces(
        &self,
        py: Python<'_>,
        suite: Vec<ExcitationInput<'_>>,
        friction: Vec<f64>,
    ) -> PyResult<String> {
        let (analysis, _) = self.run()?;
        let records = suite_of(suite)?;
        self.of_suite(records.iter())?;
        // The onset was not run, and a refined end is no level.
        let run = |rows: &[IdaRow]| -> Vec<f64> {
            let levels = rows[1..].iter().filter(|row| !row.is_refined());
            levels.map(|row| row.intensity_pga).collect()
        };
        let ims: Vec<_> = self.table.by_record().map(run).collect();
        answer(py, || {
            pivot_forces(&normalised(&records), &ims, analysis, &friction)
        })
    }

    /// The curves against a measure; all but pga and pgv need the suite.
    fn against(
        &self,
        py: Python<'_>,
        im: &str,
        suite: Option<Vec<Member<'_>>>,
    ) -> PyResult<IdaCurves> {
        let measure: IntensityMeasure = im.parse().map_err(refuse)?;
        let measure = measure.of_block(self.table.setting.p_rad_s);
        if let Some(own) = measure.dimensionless() {
            return Ok(IdaCurves(self.table.curves(own).map_err(of_record)?));
        }
        let Some(suite) = suite else {
            let words = measure.words();
            return Err(refuse(format!("{words}: expected the suite")));
        };
        let ims = std::slice::from_ref(&measure);
        let ground = self.ground(py, suite, ims)?;
        let factors = ground.values(&measure, AtUplift::value)?;
        let curves = self.table.curves(Intensity::Pga).map_err(of_record)?;
        let curves = curves.against(&factors, measure.is_squared());
        Ok(IdaCurves(curves.map_err(refuse)?))
    }

    /// Intensity measures side by side; the usual ones if none is named.
    fn rank(
        &self,
        py: Python<'_>,
        suite: Vec<Member<'_>>,
        ims: Vec<String>,
        edp: f64,
        rule: &str,
        magnitude: Option<&str>,
        distance: Option<&str>,
        replicates: usize,
        seed: u64,
    ) -> PyResult<String> {
        let rule: InversionRule = rule.parse().map_err(refuse)?;
        let ims: Vec<IntensityMeasure> = match ims.as_slice() {
            [] => IntensityMeasure::usual(),
            some => some
                .iter()
                .map(|im| im.parse().map_err(refuse))
                .collect::<PyResult<_>>()?,
        };
        let p_rad_s = self.table.setting.p_rad_s;
        let own = ims.iter().map(|im| im.of_block(p_rad_s));
        let ims: Vec<IntensityMeasure> = own.collect();
        let curves = self.table.curves(Intensity::Pga).map_err(of_record)?;
        let found = capacities::intervals(&curves.into_curves(), edp, rule);
        let found = found.map_err(refuse)?;
        let ground = self.ground(py, suite, &ims)?;
        let candidate = |measure: &IntensityMeasure| {
            Ok(CandidateMeasure {
                im: measure.words(),
                at_uplift: ground.values(measure, AtUplift::value)?,
                squared: measure.is_squared(),
            })
        };
        let all = ims.iter().map(candidate).collect::<PyResult<Vec<_>>>()?;
        let column = |name: &str| ground.column(name);
        let magnitude = magnitude.map(column).transpose()?;
        let distance = distance.map(column).transpose()?;
        let magnitude = magnitude.map(Covariate::magnitude);
        let distance = distance.map(Covariate::ln_distance);
        let covariates: Vec<_> =
            magnitude.into_iter().chain(distance).collect();
        let draws = Draws { replicates, seed };
        let clusters = self.table.clusters();
        answer(py, || rank(&found, &all, &covariates, &clusters, draws))
    }
}

/// A fault of the curve of a record.
fn of_record((record, error): (String, CapacityError)) -> PyErr {
    refuse(format!("record {record}: {error}"))
}

/// The curves of a table against one intensity measure.
#[pyclass(frozen, module = "rocking._rocking")]
pub struct IdaCurves(Curves);

impl IdaCurves {
    fn all(&self) -> Vec<ResponseCurve> {
        self.0.clone().into_curves()
    }

    /// The curves, unless their measure is the square of theirs.
    fn linear(&self) -> PyResult<Vec<ResponseCurve>> {
        if self.0.squared {
            return Err(refuse(
                "a measure that grows with the square of the acceleration: \
                 expected another",
            ));
        }
        Ok(self.all())
    }
}

#[pymethods]
impl IdaCurves {
    /// Capacity of each record (column) at each level (row), infinite if the
    /// record did not reach it, and the limits of those.
    fn capacities<'py>(
        &self,
        py: Python<'py>,
        levels: Vec<f64>,
        rule: &str,
    ) -> PyResult<[Bound<'py, PyArray2<f64>>; 2]> {
        let rule: InversionRule = rule.parse().map_err(refuse)?;
        let curves = self.all();
        let shape = (levels.len(), curves.len());
        let cells = || {
            let (mut values, mut limits) = (Vec::new(), Vec::new());
            for level in &levels {
                stop::point();
                for (low, high) in
                    capacities::intervals(&curves, *level, rule)?
                {
                    let reached = high.is_finite();
                    let limit = self.0.measured(low);
                    values.push(self.0.measured(high));
                    limits.push(if reached { f64::NAN } else { limit });
                }
            }
            Ok::<_, ProcedureError>([values, limits])
        };
        let found = work::on_numbers(py, shape.0 * shape.1, cells)?;
        let [values, limits] = found.map_err(refuse)?;
        Ok([table(py, shape, values)?, table(py, shape, limits)?])
    }

    /// Demand of each record (column) at each intensity (row); infinite if it
    /// overturned.
    fn demands<'py>(
        &self,
        py: Python<'py>,
        ims: Vec<f64>,
    ) -> PyResult<Bound<'py, PyArray2<f64>>> {
        let curves = self.linear()?;
        let shape = (ims.len(), curves.len());
        let cells = || {
            let mut values = Vec::with_capacity(shape.0 * shape.1);
            for &im in &ims {
                stop::point();
                for (i, curve) in curves.iter().enumerate() {
                    let beyond = CapacityError::Beyond { number: i + 1, im };
                    values.push(curve.edp_at(im).ok_or(beyond)?);
                }
            }
            Ok::<_, CapacityError>(values)
        };
        let values = work::on_numbers(py, shape.0 * shape.1, cells)?;
        table(py, shape, values.map_err(refuse)?)
    }

    /// Quantiles of the capacities at each level.
    fn levels(
        &self,
        py: Python<'_>,
        levels: Vec<f64>,
        rule: &str,
    ) -> PyResult<String> {
        let rule: InversionRule = rule.parse().map_err(refuse)?;
        let measured = |im| self.0.measured(im);
        answer(py, || capacities::levels(&self.all(), &levels, rule, measured))
    }

    /// The crossings of one record at each level.
    fn crossings(
        &self,
        py: Python<'_>,
        record: &str,
        levels: Vec<f64>,
    ) -> PyResult<String> {
        let own = self.0.curves.iter().find(|(name, _)| name == record);
        let (_, curve) = own.ok_or_else(|| {
            refuse(format!("record {record}: expected one of the IDA"))
        })?;
        let measured = |im| self.0.measured(im);
        answer(py, || capacities::crossings(curve, &levels, measured))
    }

    /// A fit of the capacities at each level.
    fn fit(
        &self,
        py: Python<'_>,
        levels: Vec<f64>,
        rule: &str,
        options: Fit,
    ) -> PyResult<String> {
        let rule: InversionRule = rule.parse().map_err(refuse)?;
        let dispersion = options.dispersion.parse().map_err(refuse)?;
        let (curves, options) = (self.linear()?, options.options()?);
        let clusters = Some(self.0.clusters.clone());
        let options = FitOptions { clusters, ..options };
        answer(py, || fit_levels(&curves, &levels, rule, dispersion, &options))
    }

    /// A fit of which records exceed a level at given intensities.
    fn fit_stripes(
        &self,
        py: Python<'_>,
        ims: Vec<f64>,
        edp: f64,
        shift: f64,
        replicates: usize,
        seed: u64,
    ) -> PyResult<String> {
        let outcomes = RecordOutcome::from_curves(&self.linear()?, &ims, edp);
        let outcomes = outcomes.map_err(refuse)?;
        let draws = Some(Draws { replicates, seed });
        let clusters = &self.0.clusters;
        answer(py, || fit_outcomes(&outcomes, clusters, shift, draws))
    }

    /// Responses at given intensities.
    fn stripes(
        &self,
        py: Python<'_>,
        ims: Vec<f64>,
        edp: Option<f64>,
    ) -> PyResult<String> {
        let curves = self.linear()?;
        answer(py, || stripes(&curves, &ims, edp))
    }
}

/// A table of these rows and columns.
pub fn table(
    py: Python<'_>,
    shape: (usize, usize),
    values: Vec<f64>,
) -> PyResult<Bound<'_, PyArray2<f64>>> {
    Array2::from_shape_vec(shape, values)
        .map(|table| PyArray2::from_owned_array(py, table))
        .map_err(refuse)
}
