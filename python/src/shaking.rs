//! A block against shaking-table tests.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::prelude::*;
use rocking::block::Restitution;
use rocking_procedures::Draws;
use rocking_procedures::shaking::{
    ShakingTest, Slenderness, TestOptions, compare_with_tests as procedure,
};
use rocking_procedures::shaking_table::TestTable;
use rocking_records::intensity::IntensityMeasure;
use rocking_records::{Processing, RemarkInput, Survey, remarks_together};

use crate::files::{Read, attributes, options, refuse_at, to_python};
use crate::given::{
    ExcitationInput, block_of, positive_gravity, record_of, restitution_of,
};
use crate::work::{self, refuse};

/// A test: its record, motion, fate, and what else is known of it.
type GivenTest<'py> =
    (ExcitationInput<'py>, String, String, BTreeMap<String, String>);

/// The tests of a table: records, motions and fates.
#[pyfunction]
pub fn read_tests<'py>(
    py: Python<'py>,
    path: PathBuf,
    fate: &str,
    dt: Option<f64>,
    units: Option<&str>,
    gravity: f64,
) -> PyResult<Vec<(Read<'py>, String, String)>> {
    let options = options(dt, units, gravity)?;
    let survey = work::alone(py, || Survey::read(&path, &options))?;
    let survey = survey.map_err(|e| refuse_at(&path, e))?;
    let together = work::on_all(py, || {
        let members = survey.members.iter().flatten();
        remarks_together(&members.map(RemarkInput::from).collect::<Vec<_>>())
    })?;
    let members = survey.members.iter().flatten();
    let known: Vec<_> = members.map(attributes).zip(together).collect();
    let path = path.display().to_string();
    let processing = Processing::default();
    let table = TestTable { path: &path, fate, processing };
    let tests = table.tests(survey.members).map_err(refuse)?;
    let tests = tests.iter().zip(known);
    let shown = tests.map(|(test, (known, remarks))| {
        let record = to_python(py, &test.record, known, &remarks);
        (record, test.motion.clone(), test.fate.to_string())
    });
    Ok(shown.collect())
}

/// The specimen, and the options of the comparison.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Comparing {
    block: Option<(f64, f64)>,
    p: Option<f64>,
    eta: Option<f64>,
    model: String,
    ims: Vec<String>,
    replicates: usize,
    seed: u64,
    gravity: f64,
}

impl Comparing {
    fn options(self) -> PyResult<TestOptions> {
        let slenderness = match (self.block, self.p) {
            (Some(block), None) => Slenderness::Given(block_of(block)?),
            (None, Some(p_rad_s)) => Slenderness::Fitted { p_rad_s },
            _ => return Err(refuse("block and p: expected one of them")),
        };
        let restitution = match (self.eta, slenderness) {
            (eta, Slenderness::Given(block)) => restitution_of(eta, &block),
            (Some(eta), _) => Restitution::constant(eta).map_err(refuse),
            (None, Slenderness::Fitted { .. }) => Err(refuse(
                "eta \"housner\": alpha is fitted: expected a number, or a \
                 block",
            )),
        };
        let measures = match self.ims.as_slice() {
            [] => Ok(IntensityMeasure::usual_of_tests()),
            given => given.iter().map(|name| name.parse()).collect(),
        };
        let (replicates, seed) = (self.replicates, self.seed);
        Ok(TestOptions {
            slenderness,
            restitution: restitution?,
            model: self.model.parse().map_err(refuse)?,
            gravity_m_s2: positive_gravity(self.gravity)?,
            measures: measures.map_err(refuse)?,
            draws: Draws { replicates, seed },
        })
    }
}

/// A block compared with tests, as JSON.
#[pyfunction]
pub fn compare_with_tests(
    py: Python<'_>,
    tests: Vec<GivenTest<'_>>,
    comparing: Comparing,
    threads: Option<usize>,
) -> PyResult<String> {
    let test = |(record, motion, fate, known): GivenTest<'_>| {
        Ok(ShakingTest {
            record: record_of(record)?,
            motion,
            fate: fate.parse().map_err(refuse)?,
            columns: ShakingTest::columns(&known),
        })
    };
    let tests = tests.into_iter().map(test);
    let tests = tests.collect::<PyResult<Vec<ShakingTest>>>()?;
    let options = comparing.options()?;
    let found =
        work::run(py, threads, None, 0, |_| procedure(&tests, &options))?;
    serde_json::to_string(&found.map_err(refuse)?).map_err(refuse)
}
