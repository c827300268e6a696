//! Fragilities as texts of other programs, and under a hazard curve.

use pyo3::prelude::*;
use rocking_exchange::{
    BlockFragility, ExchangeFormat, Id, LimitState, unit_intensity,
    unstated_origin,
};
use rocking_procedures::fragility::hazard::{
    Hazard, HazardMeasure, HazardOptions, Site,
};
use rocking_procedures::{
    BootstrapFits, DispersionRule, Draws, FitOptions,
    FragilityInput as ProcedureInput, ModelError, Shift, law_fragility,
    risk as procedure,
};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::Lognormal;

use crate::given::{block_of, positive_gravity, restitution_of};
use crate::procedures::{Fit, SampleInput, answer, clusters_of, sample_of};
use crate::work::{self, refuse};

/// The shift, log_mean and dispersion of a lognormal.
type LognormalInput = (f64, f64, f64);

fn lognormal(
    (shift, log_mean, dispersion): LognormalInput,
) -> PyResult<Lognormal> {
    Lognormal::try_new(shift, log_mean, dispersion).map_err(refuse)
}

/// Origin of a fragility, or the size of its sample.
#[derive(FromPyObject)]
pub enum OriginInput {
    Origin(String),
    Size(usize),
}

/// The fragilities of a block in the unit of their samples: name, law and
/// source of each limit state.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct FragilityInput {
    block: (f64, f64),
    limit_states: Vec<(String, LognormalInput, OriginInput)>,
    im: String,
    id: Option<String>,
    eta: Option<f64>,
    model: String,
    origin: Option<String>,
}

impl FragilityInput {
    /// The fragilities in the block's own measure, and the number of its
    /// units in one of the samples'.
    fn fragility(
        self,
        gravity: f64,
        model_error: ModelError,
    ) -> PyResult<(BlockFragility, f64)> {
        let gravity_m_s2 = positive_gravity(gravity)?;
        let im: IntensityMeasure = self.im.parse().map_err(refuse)?;
        let block = block_of(self.block)?;
        let model = self.model.parse().map_err(refuse)?;
        let factor = im.dimensionless().map_or(1.0, |own| {
            unit_intensity(own, &block, model, gravity_m_s2)
        });
        let im = im.of_block(block.frequency_rad_s());
        let (mut limit_states, mut origins) = (Vec::new(), Vec::new());
        for (name, law, source) in self.limit_states {
            let name: Id = name.parse().map_err(refuse)?;
            let fragility = lognormal(law)?.scaled(factor).map_err(refuse)?;
            limit_states.push(LimitState { name, fragility });
            origins.push(match source {
                OriginInput::Origin(words) => words,
                OriginInput::Size(n) => unstated_origin(n, &im),
            });
        }
        origins.dedup();
        let id = self.id.map_or_else(|| Id::of(&block), |id| id.parse());
        let found = BlockFragility {
            id: id.map_err(refuse)?,
            block,
            eta: self.eta,
            im,
            limit_states,
            origin: self.origin.unwrap_or_else(|| origins.join("; ")),
            model_error,
        };
        Ok((found, factor))
    }
}

/// Dispersion and bias of the model, as the command spells them.
pub type ModelErrorInput = (Option<String>, Option<String>);

/// The error of the model, `usual` if nothing is given.
pub fn model_error(
    (dispersion, bias): &ModelErrorInput,
    usual: ModelError,
) -> PyResult<ModelError> {
    let bias = bias.as_deref().map(ModelError::parse_bias).transpose();
    let bias = bias.map_err(|e| refuse(format!("model_bias: {e}")))?;
    let dispersion = dispersion.as_deref().map(ModelError::parse_dispersion);
    let dispersion = dispersion
        .transpose()
        .map_err(|e| refuse(format!("model_dispersion: {e}")))?;
    Ok(usual.or(bias, dispersion))
}

/// The text of a format, and the extension and text of a second file if the
/// format has one.
#[pyfunction]
pub fn exchange(
    format: &str,
    blocks: Vec<FragilityInput>,
    gravity: f64,
    error: ModelErrorInput,
) -> PyResult<(String, Option<(&'static str, String)>)> {
    let format = ExchangeFormat::named(format).map_err(refuse)?;
    let error = model_error(&error, ModelError::default())?;
    let all = blocks.into_iter().map(|one| one.fragility(gravity, error));
    let all = all.map(|one| Ok(one?.0)).collect::<PyResult<Vec<_>>>()?;
    let texts = format.texts(&all).map_err(refuse)?;
    Ok((texts.main, format.beside.zip(texts.beside)))
}

/// Longitude and latitude in degrees of a site, or its id.
#[derive(FromPyObject)]
pub enum SiteInput {
    Degrees((f64, f64)),
    Id(String),
}

/// A hazard curve as text: its place in messages, the text, the years of its
/// probabilities, and the site.
pub type HazardInput = (String, String, Option<f64>, Option<SiteInput>);

pub fn read((place, text, years, site): &HazardInput) -> PyResult<Hazard> {
    let site = site.as_ref().map(|site| match site {
        SiteInput::Degrees((lon, lat)) => Site::Degrees(*lon, *lat),
        SiteInput::Id(id) => Site::Id(id.clone()),
    });
    let options = HazardOptions { years: *years, site };
    Hazard::parse(place, text, &options).map_err(refuse)
}

/// The points of a hazard curve, its measure, the unit of its intensities, and
/// remarks on what was set aside.
type HazardOutput =
    (Vec<(f64, f64)>, Option<String>, &'static str, Vec<String>);

/// A hazard curve.
#[pyfunction]
pub fn hazard(written: HazardInput) -> PyResult<HazardOutput> {
    let found = read(&written)?;
    let remarks = found.remarks.iter().map(ToString::to_string).collect();
    let im = found.im.name();
    Ok((found.curve.points().to_vec(), im, found.unit(), remarks))
}

/// A fragility in the unit of a hazard curve, or those of a block.
#[derive(FromPyObject)]
pub enum RiskInput {
    Law(LognormalInput),
    Block(FragilityInput),
}

/// The samples of the levels, the place of a fragility's own, and how they
/// were fitted.
type RiskSample<'py> = Option<(Vec<SampleInput<'py>>, usize, Fit)>;

/// The fits to the draws of a sample; `None` for a shift that is not known.
fn sampled(
    py: Python<'_>,
    behind: RiskSample<'_>,
    draws: Option<Draws>,
) -> PyResult<Option<BootstrapFits>> {
    let Some((samples, place, fit)) = behind else { return Ok(None) };
    let rule: DispersionRule = fit.dispersion.parse().map_err(refuse)?;
    let options = fit.options()?;
    if !matches!(options.shift, Shift::Given(_)) {
        return Ok(None);
    }
    let clusters = samples.first().and_then(clusters_of);
    let samples = samples.iter().map(sample_of);
    let samples = samples.collect::<PyResult<Vec<_>>>()?;
    let band = Vec::new();
    let family = rule.family(&samples);
    let options = FitOptions { clusters, draws, band, family, ..options };
    let found = work::on_all(py, || options.sampled(&samples[place]))?;
    found.map_err(refuse)
}

/// Annual frequencies of named fragilities under a hazard curve.
#[pyfunction]
pub fn risk(
    py: Python<'_>,
    written: HazardInput,
    exposed: Vec<(String, RiskInput, Vec<RiskSample<'_>>)>,
    gravity: f64,
    years: f64,
    replicates: usize,
    seed: u64,
    error: ModelErrorInput,
) -> PyResult<String> {
    let hazard = read(&written)?;
    // A law is taken as it is, unless an error is given.
    let of_law = model_error(&error, ModelError::none())?;
    let error = model_error(&error, ModelError::default())?;
    let draws = (replicates > 0).then_some(Draws { replicates, seed });
    let mut all = Vec::new();
    for (name, one, behind) in exposed {
        let law_error = if behind.is_empty() { of_law } else { error };
        let mut behind = behind.into_iter();
        let mut drawn = || sampled(py, behind.next().flatten(), draws);
        let mut add = |name: String, own, error| {
            let own = ProcedureInput::with(name, own, &error).map_err(refuse);
            own.map(|own| all.push(own))
        };
        let block = match one {
            RiskInput::Law(law) => {
                add(name, (lognormal(law)?, drawn()?), law_error)?;
                continue;
            }
            RiskInput::Block(block) => block,
        };
        let (own, factor) = block.fragility(gravity, error)?;
        if hazard.im == HazardMeasure::Own || !hazard.im.is_of(&own.im) {
            let found = hazard.im.name();
            return Err(refuse(format!(
                "{name}: a fragility in {}, a hazard curve in {}: expected \
                 the same measure",
                own.im,
                found.as_deref().unwrap_or("a measure not stated"),
            )));
        }
        let one = own.limit_states.len() == 1;
        for state in own.limit_states {
            let unit = hazard.units_per_im_unit;
            let fitted = state.fragility.scaled(unit).map_err(refuse)?;
            let name = match one {
                true => name.clone(),
                false => format!("{name} {}", state.name),
            };
            let scaled = |all: BootstrapFits| all.scaled(factor)?.scaled(unit);
            let sampled = drawn()?.map(scaled).transpose().map_err(refuse)?;
            add(name, (fitted, sampled), error)?;
        }
    }
    answer(py, || procedure(&hazard, &all, years))
}

/// The fragility of a block by the law of AvgSA; without eta Housner's.
#[pyfunction]
pub fn law(
    py: Python<'_>,
    block: (f64, f64),
    eta: Option<f64>,
    edp: f64,
    error: ModelErrorInput,
) -> PyResult<String> {
    let block = block_of(block)?;
    let eta = restitution_of(eta, &block)?.velocity_ratio();
    let error = model_error(&error, ModelError::default())?;
    answer(py, || law_fragility(&block, eta, edp, error))
}
