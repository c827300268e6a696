//! Intensity measures of records, as the JSON of their fields, and of the
//! records of a suite.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use rayon::prelude::*;
use rocking::accelerogram::Accelerogram;
use rocking::integrator::{Model, uplift_threshold};
use rocking_procedures::{CloudOptions, Draws, fit_cloud};
use rocking_records::intensity::velocity_pulse::{candidates, pulse};
use rocking_records::intensity::{
    AtUplift, IntensityError, IntensityMeasure, Measures, PairMeasures,
    Settings,
};
use rocking_statistics::Clusters;

use crate::given::{ExcitationInput, block_of, record_of, suite_of};
use crate::procedures::answer;
use crate::work::{self, refuse};

/// AvgSA of a record over the periods of a block, in g.
#[pyfunction]
pub fn average_sa(record: ExcitationInput<'_>, p_rad_s: f64) -> PyResult<f64> {
    let record = record_of(record)?;
    let im = IntensityMeasure::RockingSa(None).of_block(p_rad_s);
    let gravity_m_s2 = Settings::default().gravity_m_s2();
    let settings = Settings::of(gravity_m_s2, [&im]).map_err(refuse)?;
    let found = Measures::of(&record, &settings).map_err(refuse)?;
    let value = im.value(&found, settings.periods_s());
    value.ok_or_else(|| refuse(format!("p {p_rad_s}: expected 0.001 to 1000")))
}

/// The measures of one component, or a percentile of those of two over all
/// directions.
#[pyfunction]
pub fn intensity_measures(
    py: Python<'_>,
    record: ExcitationInput<'_>,
    second: Option<(ExcitationInput<'_>, f64)>,
    periods: Vec<f64>,
    damping: f64,
    gravity: f64,
) -> PyResult<String> {
    let first = record_of(record)?;
    let settings =
        Settings::try_new(gravity, damping, periods).map_err(refuse)?;
    let Some((second, percentile)) = second else {
        return answer(py, || Measures::of(&first, &settings));
    };
    let second = record_of(second)?;
    answer(py, || {
        let pair =
            PairMeasures::of(&first, &second, &settings, &[percentile])?;
        Ok::<_, IntensityError>(pair.rotd.into_iter().next())
    })
}

/// The velocity pulse of two components; `null` if there is none.
#[pyfunction]
pub fn velocity_pulse(
    py: Python<'_>,
    first: ExcitationInput<'_>,
    second: ExcitationInput<'_>,
    gravity: f64,
) -> PyResult<String> {
    let (first, second) = (record_of(first)?, record_of(second)?);
    answer(py, || {
        let found = candidates(&first, &second, gravity)?;
        Ok::<_, IntensityError>(pulse(&found).cloned())
    })
}

/// What else is known of a record.
type Known = BTreeMap<String, String>;

/// A record of a suite, and what else is known of it.
pub type Member<'py> = (ExcitationInput<'py>, Known);

/// The records of a suite, with what else is known of each.
pub fn members_of(
    suite: Vec<Member<'_>>,
) -> PyResult<Vec<(Accelerogram, Known)>> {
    let (given, known): (Vec<_>, Vec<_>) = suite.into_iter().unzip();
    Ok(suite_of(given)?.into_iter().zip(known).collect())
}

/// The records of a suite, unscaled and measured.
pub struct MeasuredSuite {
    uplift: AtUplift,
    periods_s: Vec<f64>,
    members: Vec<(String, Measures, Known)>,
}

/// A function of an [`AtUplift`].
type Value = fn(&AtUplift, &IntensityMeasure, &Measures, &[f64], f64) -> f64;

impl MeasuredSuite {
    /// Measures each record.
    pub fn of(
        py: Python<'_>,
        uplift: AtUplift,
        members: Vec<(Accelerogram, Known)>,
        ims: &[IntensityMeasure],
    ) -> PyResult<Self> {
        let settings =
            Settings::of(uplift.gravity_m_s2, ims).map_err(refuse)?;
        let measured = || {
            let one = |(record, known): (Accelerogram, _)| {
                let measures = Measures::of(&record, &settings)?;
                Ok((record.name().to_owned(), measures, known))
            };
            let all = members.into_par_iter().panic_fuse().map(one);
            all.collect::<Result<Vec<_>, IntensityError>>()
        };
        let members = work::on_all(py, measured)?.map_err(refuse)?;
        let periods_s = settings.periods_s().to_vec();
        Ok(Self { uplift, periods_s, members })
    }

    /// A value of each record.
    pub fn values(
        &self,
        measure: &IntensityMeasure,
        value: Value,
    ) -> PyResult<Vec<f64>> {
        let of = |(name, measures, known): &(String, _, _)| {
            let attribute = match measure {
                IntensityMeasure::Column(column) => cell(name, known, column)?,
                _ => f64::NAN,
            };
            let periods_s = &self.periods_s;
            Ok(value(&self.uplift, measure, measures, periods_s, attribute))
        };
        self.members.iter().map(of).collect()
    }

    /// An attribute of each record.
    pub fn column(&self, column: &str) -> PyResult<Vec<f64>> {
        let members = self.members.iter();
        members.map(|(name, _, known)| cell(name, known, column)).collect()
    }
}

/// The positive number that an attribute of a record is.
fn cell(record: &str, known: &Known, column: &str) -> PyResult<f64> {
    let found = known.get(column);
    let value = found.and_then(|text| text.trim().parse::<f64>().ok());
    value.filter(|x| *x > 0.0 && x.is_finite()).ok_or_else(|| {
        refuse(format!(
            "record {record}, attribute {column}: found {}: expected a \
             positive number",
            found.map_or("none".to_owned(), |text| format!("`{text}`"))
        ))
    })
}

/// A fragility of the peaks under the records of a suite.
#[pyfunction]
pub fn cloud(
    py: Python<'_>,
    block: (f64, f64),
    suite: Vec<Member<'_>>,
    peaks: Vec<f64>,
    events: Vec<String>,
    model: &str,
    gravity_m_s2: f64,
    im: &str,
    edp: Vec<f64>,
    shift: f64,
    replicates: usize,
    seed: u64,
) -> PyResult<String> {
    let block = block_of(block)?;
    let model: Model = model.parse().map_err(refuse)?;
    let measure: IntensityMeasure = im.parse().map_err(refuse)?;
    let pga_g = uplift_threshold(&block, model);
    let p_rad_s = block.frequency_rad_s();
    let uplift = AtUplift { pga_g, p_rad_s, gravity_m_s2 };
    let members = members_of(suite)?;
    let ims = std::slice::from_ref(&measure);
    let suite = MeasuredSuite::of(py, uplift, members, ims)?;
    let values = suite.values(&measure, AtUplift::unscaled)?;
    let pairs: Vec<_> = values.into_iter().zip(peaks).collect();
    let clusters = Clusters::of_events(&events, pairs.len());
    let draws = Draws { replicates, seed };
    let options = CloudOptions { edp, shift, draws };
    answer(py, || fit_cloud(&pairs, &clusters, &options))
}
