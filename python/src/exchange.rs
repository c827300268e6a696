//! Fragilities as texts of other programs.

use pyo3::prelude::*;
use rocking::intensity::Intensity;
use rocking::statistics::Lognormal;
use rocking_exchange::{
    BlockFragility, Format, Id, LimitState, unit_intensity, unstated_origin,
};

use crate::given::{block_of, choose, positive_gravity, refuse};

/// What a fragility does not say of itself.
#[derive(FromPyObject)]
pub struct Wanted {
    #[pyo3(item)]
    block: (f64, f64),
    #[pyo3(item)]
    im: String,
    #[pyo3(item)]
    id: Option<String>,
    #[pyo3(item)]
    limit_state: String,
    #[pyo3(item)]
    model: String,
    #[pyo3(item)]
    gravity: f64,
    #[pyo3(item)]
    origin: Option<String>,
}

/// The text of a format, and that of a second file beside it, where the
/// format has one. `law` is (shift, log_mean, beta) of a sample of `n`.
#[pyfunction]
pub fn exchange(
    format: &str,
    law: (f64, f64, f64),
    n: usize,
    wanted: Wanted,
) -> PyResult<(String, Option<String>)> {
    let formats = [Format::Nrml, Format::Pelicun].map(|f| (f.name(), f));
    let format = choose("format", format, &formats)?;
    let intensity: Intensity = wanted.im.parse().map_err(refuse)?;
    let block = block_of(wanted.block)?;
    let gravity_m_s2 = positive_gravity(wanted.gravity)?;
    let model = wanted.model.parse().map_err(refuse)?;
    let factor = unit_intensity(intensity, &block, model, gravity_m_s2);
    let fragility = Lognormal::try_new(law.0, law.1, law.2).map_err(refuse)?;
    let id = wanted.id.map_or_else(|| Id::of(&block), |id| id.parse());
    let state = LimitState {
        name: wanted.limit_state.parse().map_err(refuse)?,
        fragility: fragility.scaled(factor).map_err(refuse)?,
    };
    let im = intensity.into();
    let origin =
        wanted.origin.unwrap_or_else(|| unstated_origin(n, &im));
    let one = BlockFragility {
        id: id.map_err(refuse)?,
        block,
        eta: None,
        im,
        limit_states: vec![state],
        origin,
    };
    let texts = format.texts(&[one]).map_err(refuse)?;
    Ok((texts.main, texts.beside.map(|(_, text)| text)))
}
