//! Incremental dynamic analysis of a suite, and its inversion.

use numpy::ndarray::Array2;
use numpy::{IntoPyArray, PyArray2, PyReadonlyArray1};
use pyo3::prelude::*;
use pyo3::types::PyDict;
use rayon::prelude::*;
use rocking::capacity::{CapacityError, InversionRule, ResponseCurve};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Batch, Grid, IdaCurve, IdaPoint, curves};
use rocking::integrator::Outcome;
use rocking::stop;

use crate::given::{Given, Physics, block_of, records_of, refuse};
use crate::work;

/// Levels and how they are reached.
#[derive(FromPyObject)]
pub struct Scan {
    #[pyo3(item)]
    step_g: Option<f64>,
    #[pyo3(item)]
    step_im: Option<f64>,
    #[pyo3(item)]
    refine: Option<f64>,
    #[pyo3(item)]
    by: String,
    #[pyo3(item)]
    certify: bool,
    #[pyo3(item)]
    highest_im: f64,
}

/// Place of a row's outcome among the names that the Python half has.
fn outcome(point: &IdaPoint, refined: bool) -> u8 {
    match point.outcome {
        _ if refined => 4,
        _ if !point.told.resolved => 3,
        Outcome::Overturned { .. } => 2,
        Outcome::Rocked { .. } => 1,
        Outcome::NoUplift => 0,
    }
}

/// IDA of every record: columns of all rows, and columns of all records.
#[pyfunction]
pub fn ida<'py>(
    py: Python<'py>,
    block: (f64, f64),
    records: Vec<Given<'py>>,
    physics: Physics,
    scan: Scan,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyDict>> {
    let block = block_of(block)?;
    let grid = match (scan.step_im, scan.step_g) {
        (Some(step), None) => Grid::Im { step },
        (None, Some(step_g)) => Grid::Pga { step_g },
        _ => return Err(refuse("expected one of step_g and step_im")),
    };
    let analysis = Analysis {
        model: physics.model()?,
        overturning: physics.overturning()?,
        grid,
        adjust: scan.by.parse().map_err(refuse)?,
        refine: scan.refine,
        highest_im: scan.highest_im,
        certify: scan.certify,
        ..Analysis::paper(block, physics.restitution(&block)?)
    };
    let records = records_of(records)?;
    let found = work::run(py, threads, progress, records.len(), |done| {
        let unit = |record| {
            stop::point();
            NormalisedRecord::new(record)
        };
        let units: Vec<_> =
            records.par_iter().panic_fuse().map(unit).collect();
        let batch = Batch { progress: &|| done.tick(), ..Batch::default() };
        curves(&units, &[analysis], &batch)
    })?
    .map_err(refuse)?;
    to_python(py, &found[0])
}

fn to_python<'py>(
    py: Python<'py>,
    curves: &[IdaCurve],
) -> PyResult<Bound<'py, PyDict>> {
    let mut rows: Vec<(&IdaPoint, bool)> = Vec::new();
    let mut sizes: Vec<i64> = Vec::new();
    for curve in curves {
        let before = rows.len();
        let scanned = std::iter::once(&curve.onset).chain(&curve.points);
        rows.extend(scanned.map(|point| (point, false)));
        let first = curve.overturning.as_ref();
        let refined = first.and_then(|first| first.refined.as_ref());
        rows.extend(refined.map(|point| (point, true)));
        sizes.push((rows.len() - before) as i64);
    }
    let out = PyDict::new(py);
    let column = |value: fn(&IdaPoint) -> f64| {
        let values = rows.iter().map(|(point, _)| value(point));
        values.collect::<Vec<f64>>().into_pyarray(py)
    };
    out.set_item("im", column(|point| point.im))?;
    out.set_item("pga_g", column(|point| point.pga_g))?;
    out.set_item("alpha", column(|point| point.slenderness_rad))?;
    out.set_item("edp", column(IdaPoint::edp))?;
    out.set_item("fate_margin", column(|point| point.fate_margin))?;
    let outcomes =
        rows.iter().map(|(point, refined)| outcome(point, *refined));
    out.set_item("outcome", outcomes.collect::<Vec<u8>>().into_pyarray(py))?;
    out.set_item("sizes", sizes.into_pyarray(py))?;
    let each = |value: fn(&IdaCurve) -> f64| {
        curves.iter().map(value).collect::<Vec<f64>>().into_pyarray(py)
    };
    out.set_item("record_pga_g", each(|curve| curve.record_pga_g))?;
    out.set_item("velocity_ratio_s", each(|curve| curve.velocity_ratio_s))?;
    let analyses: u64 = curves.iter().map(|curve| curve.analyses).sum();
    out.set_item("analyses", analyses)?;
    Ok(out)
}

/// The rows of an IDA, as Python hands them back.
#[derive(FromPyObject)]
pub struct Rows<'py> {
    #[pyo3(item)]
    sizes: PyReadonlyArray1<'py, i64>,
    #[pyo3(item)]
    im: PyReadonlyArray1<'py, f64>,
    #[pyo3(item)]
    edp: PyReadonlyArray1<'py, f64>,
    #[pyo3(item)]
    outcome: PyReadonlyArray1<'py, u8>,
    /// Factor from PGA/(g tan alpha) to the intensity asked for.
    #[pyo3(item)]
    factor: PyReadonlyArray1<'py, f64>,
}

impl Rows<'_> {
    /// The curves: first overturning is the refined end of its bracket where
    /// there is one, else the first level that overturned.
    fn curves(&self) -> PyResult<Vec<ResponseCurve>> {
        let (im, edp) = (self.im.as_slice()?, self.edp.as_slice()?);
        let outcome = self.outcome.as_slice()?;
        let mut start = 0;
        let sizes = self.sizes.as_slice()?.iter().zip(self.factor.as_slice()?);
        sizes
            .map(|(size, factor)| {
                let end = start + *size as usize;
                let range = start..end;
                start = end;
                let rows = im.get(range.clone()).zip(edp.get(range.clone()));
                let ((im, edp), outcome) = rows
                    .zip(outcome.get(range))
                    .ok_or_else(|| refuse("sizes beyond the rows"))?;
                let fall = edp.iter().position(|x| x.is_infinite());
                let vertices = im.iter().copied().zip(edp.iter().copied());
                let vertices: Vec<(f64, f64)> =
                    vertices.take(fall.unwrap_or(im.len())).collect();
                let refined = outcome.iter().position(|code| *code == 4);
                let overturning = refined.or(fall).map(|i| im[i]);
                ResponseCurve::try_new(&vertices, overturning)
                    .and_then(|curve| curve.scaled(*factor))
                    .map_err(refuse)
            })
            .collect()
    }
}

/// Capacity of each record (column) at each level (row); infinite where the
/// record did not reach it.
#[pyfunction]
pub fn capacities<'py>(
    py: Python<'py>,
    rows: Rows<'py>,
    levels: Vec<f64>,
    rule: &str,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let rule: InversionRule = rule.parse().map_err(refuse)?;
    let curves = rows.curves()?;
    let at = |level: f64, curve: &ResponseCurve| {
        if level == f64::INFINITY {
            return Ok(curve.overturning_im().unwrap_or(f64::INFINITY));
        }
        Ok(curve.crossings(level)?.capacity(rule).im())
    };
    table(py, &levels, &curves, at)
}

/// Demand of each record (column) at each intensity (row); infinite where it
/// overturned.
#[pyfunction]
pub fn demands<'py>(
    py: Python<'py>,
    rows: Rows<'py>,
    ims: Vec<f64>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let curves = rows.curves()?;
    let numbered: Vec<_> = curves.iter().enumerate().collect();
    let at = |im: f64, (i, curve): &(usize, &ResponseCurve)| {
        let beyond = CapacityError::Beyond { number: i + 1, im };
        curve.edp_at(im).ok_or(beyond)
    };
    table(py, &ims, &numbered, at)
}

fn table<'py, T: Sync>(
    py: Python<'py>,
    rows: &[f64],
    columns: &[T],
    at: impl Fn(f64, &T) -> Result<f64, CapacityError> + Sync,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    let cells = || {
        let mut values = Vec::with_capacity(rows.len() * columns.len());
        for row in rows {
            for column in columns {
                stop::point();
                values.push(at(*row, column)?);
            }
        }
        Ok(values)
    };
    let values = work::on_numbers(py, rows.len() * columns.len(), cells)?;
    let values = values.map_err(|error: CapacityError| refuse(error))?;
    Array2::from_shape_vec((rows.len(), columns.len()), values)
        .map(|table| PyArray2::from_owned_array(py, table))
        .map_err(refuse)
}
