//! Records and suites from files.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use numpy::{IntoPyArray, PyArray1};
use pyo3::exceptions::PyFileNotFoundError;
use pyo3::prelude::*;
use rocking::accelerogram::Accelerogram;
use rocking_records::{
    Fallback, ReadOptions, RecordError, Remark, RemarkInput, Suite,
    SuiteMember, remarks, remarks_together,
};
use rocking_synthesis::{Pair, SynthesisError, ordinary, pulse};

use crate::given::{choose, remarked, unit};
use crate::work::{self, refuse};

/// Name, samples in g, interval in s, what the file says of itself, and what
/// is suspicious.
pub type Read<'py> = (
    String,
    Bound<'py, PyArray1<f64>>,
    f64,
    BTreeMap<String, String>,
    Vec<String>,
);

pub fn options(
    dt: Option<f64>,
    units: Option<&str>,
    gravity: f64,
) -> PyResult<ReadOptions> {
    let unit = units.map(unit).transpose()?;
    let rest = ReadOptions::default();
    Ok(ReadOptions { dt_s: dt, unit, gravity_m_s2: gravity, ..rest })
}

/// A missing path is `FileNotFoundError`, everything else `ValueError`.
pub fn refuse_at(path: &Path, error: impl std::fmt::Display) -> PyErr {
    if path.exists() {
        refuse(error)
    } else {
        PyFileNotFoundError::new_err(error.to_string())
    }
}

pub fn to_python<'py>(
    py: Python<'py>,
    record: &Accelerogram,
    attributes: BTreeMap<String, String>,
    remarks: &[Remark],
) -> Read<'py> {
    let samples = record.samples_g().to_vec().into_pyarray(py);
    let remarks = remarks.iter().map(remarked).collect();
    (record.name().to_owned(), samples, record.dt_s(), attributes, remarks)
}

/// One record.
#[pyfunction]
pub fn read_record<'py>(
    py: Python<'py>,
    path: PathBuf,
    dt: Option<f64>,
    units: Option<&str>,
    gravity: f64,
) -> PyResult<Read<'py>> {
    let options = options(dt, units, gravity)?;
    let read = || {
        let read = rocking_records::read_file(&path, &options)?;
        let found = remarks(&read.accelerogram);
        Ok::<_, RecordError>((read, found))
    };
    let (read, found) =
        work::alone(py, read)?.map_err(|e| refuse_at(&path, e))?;
    let mut attributes = BTreeMap::from([
        ("file".to_owned(), path.display().to_string()),
        ("format".to_owned(), read.format.name.to_owned()),
        ("units".to_owned(), read.unit.to_string()),
    ]);
    attributes.extend(read.channel.map(|text| ("channel".to_owned(), text)));
    attributes.extend(read.site.map(|text| ("site".to_owned(), text)));
    let record = &read.accelerogram;
    let remarks = [read.remarks, found].concat();
    Ok(to_python(py, record, attributes, &remarks))
}

/// What the index and the file say of a record.
pub fn attributes(member: &SuiteMember) -> BTreeMap<String, String> {
    let mut attributes = member.attributes_by_name();
    attributes.insert("file".to_owned(), member.file.clone());
    let event = member.event.clone();
    attributes.extend(event.map(|own| ("event".to_owned(), own)));
    attributes.insert("format".to_owned(), member.format.name.to_owned());
    attributes.insert("units".to_owned(), member.unit.to_string());
    for (key, text) in [("site", &member.site), ("pair", &member.pair)] {
        attributes.extend(text.clone().map(|text| (key.to_owned(), text)));
    }
    attributes
}

/// Name, what was set aside, the numbers of records whose files state no
/// interval and no unit, records.
type ReadSuite<'py> = (String, String, (usize, usize), Vec<Read<'py>>);

/// A suite; of pairs only the study component, unless `both`.
#[pyfunction]
pub fn read_suite<'py>(
    py: Python<'py>,
    path: PathBuf,
    dt: Option<f64>,
    units: Option<&str>,
    gravity: f64,
    both: bool,
    recursive: bool,
) -> PyResult<ReadSuite<'py>> {
    let options = ReadOptions { recursive, ..options(dt, units, gravity)? };
    let suite = work::alone(py, || Suite::read(&path, &options))?
        .map_err(|e| refuse_at(&path, e))?;
    let members = suite.members().iter();
    let members: Vec<_> =
        members.filter(|m| both || m.study_component).collect();
    let together = work::on_all(py, || {
        let all = members.iter().map(|member| RemarkInput::from(*member));
        remarks_together(&all.collect::<Vec<_>>())
    })?;
    let count = |is: fn(&Fallback) -> bool| {
        members.iter().filter(|member| is(&member.given)).count()
    };
    let given = (count(|given| given.dt), count(|given| given.unit));
    let records =
        members.into_iter().zip(&together).map(|(member, remarks)| {
            let known = attributes(member);
            to_python(py, &member.accelerogram, known, remarks)
        });
    let (name, aside) = (suite.name(), suite.set_aside().to_string());
    Ok((name.to_owned(), aside, given, records.collect()))
}

/// An embedded suite, as `read_suite` gives one from files.
#[pyfunction]
pub fn embedded_suite<'py>(
    py: Python<'py>,
    name: &str,
    both: bool,
) -> PyResult<Vec<Read<'py>>> {
    type Make = fn() -> Result<Vec<Pair>, SynthesisError>;
    let suites: [(&str, Make); 2] = [("ordinary", ordinary), ("pulse", pulse)];
    let make = choose("suite", name, &suites)?;
    let pairs = work::on_all(py, make)?.map_err(refuse)?;
    let mut records = Vec::new();
    for Pair { components, scenario, .. } in &pairs {
        let kept = if both { &components[..] } else { &components[..1] };
        for component in kept {
            let known = scenario.columns();
            let known = known.map(|(key, text)| (key.to_owned(), text));
            let mut attributes = BTreeMap::from(known);
            let pair = component.name().rsplit_once('-');
            attributes.extend(
                pair.map(|(pair, _)| ("pair".to_owned(), pair.to_owned())),
            );
            let remarks = remarks(component);
            records.push(to_python(py, component, attributes, &remarks));
        }
    }
    Ok(records)
}
