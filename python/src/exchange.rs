//! Fragilities as texts of other programs.

use pyo3::prelude::*;
use rocking::intensity::Intensity;
use rocking::statistics::Lognormal;
use rocking_exchange::{
    BlockFragility, Format, Id, LimitState, unit_intensity, unstated_origin,
};

use crate::given::{block_of, choose, positive_gravity, refuse};

/// The dimensionless fragility of a block: `law` is (shift, log_mean,
/// dispersion) of a sample of `n`.
#[derive(FromPyObject)]
pub struct Wanted {
    #[pyo3(item)]
    block: (f64, f64),
    #[pyo3(item)]
    law: (f64, f64, f64),
    #[pyo3(item)]
    n: usize,
    #[pyo3(item)]
    im: String,
    #[pyo3(item)]
    id: Option<String>,
    #[pyo3(item)]
    eta: Option<f64>,
    #[pyo3(item)]
    model: String,
    #[pyo3(item)]
    origin: Option<String>,
}

impl Wanted {
    fn fragility(
        self,
        name: &Id,
        gravity_m_s2: f64,
    ) -> PyResult<BlockFragility> {
        let intensity: Intensity = self.im.parse().map_err(refuse)?;
        let block = block_of(self.block)?;
        let model = self.model.parse().map_err(refuse)?;
        let factor = unit_intensity(intensity, &block, model, gravity_m_s2);
        let (shift, log_mean, dispersion) = self.law;
        let law = Lognormal::try_new(shift, log_mean, dispersion);
        let fragility = law.and_then(|f| f.scaled(factor)).map_err(refuse)?;
        let id = self.id.map_or_else(|| Id::of(&block), |id| id.parse());
        let (n, im) = (self.n, intensity.into());
        Ok(BlockFragility {
            id: id.map_err(refuse)?,
            block,
            eta: self.eta,
            origin: self.origin.unwrap_or_else(|| unstated_origin(n, &im)),
            im,
            limit_states: vec![LimitState { name: name.clone(), fragility }],
        })
    }
}

/// The text of a format, and where it has one that of a second file beside
/// it, with its extension.
#[pyfunction]
pub fn exchange(
    format: &str,
    blocks: Vec<Wanted>,
    limit_state: &str,
    gravity: f64,
) -> PyResult<(String, Option<(&'static str, String)>)> {
    let formats = Format::ALL.map(|f| (f.name(), f));
    let format = choose("format", format, &formats)?;
    let gravity_m_s2 = positive_gravity(gravity)?;
    let name: Id = limit_state.parse().map_err(refuse)?;
    let all = blocks.into_iter().map(|one| one.fragility(&name, gravity_m_s2));
    let all = all.collect::<PyResult<Vec<_>>>()?;
    let texts = format.texts(&all).map_err(refuse)?;
    Ok((texts.main, texts.beside))
}
