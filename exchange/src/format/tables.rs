//! Tables of parameters: for PACT, and for any program.

use super::ExchangeError;
use crate::fragility::{BlockFragility, Id, unit};
use crate::intensity::Intensity;
use crate::table::{Table, number, optional};

/// Median and dispersion as FEMA P-58's PACT is told them by hand.
pub(super) fn pact(
    fragilities: &[BlockFragility],
    limit_state: &Id,
) -> Result<String, ExchangeError> {
    let mut table = Table::new(&[
        "id",
        "damage_state",
        "demand",
        "unit",
        "directional",
        "median",
        "dispersion",
    ]);
    for one in fragilities {
        let fragility = &one.fragility;
        if fragility.shift() > 0.0 {
            return Err(ExchangeError::Shifted { id: one.id.clone() });
        }
        table.row([
            one.id.to_string(),
            limit_state.to_string(),
            demand(one.intensity).into(),
            unit(one.intensity).into(),
            "yes".into(),
            number(fragility.median()),
            number(fragility.dispersion()),
        ]);
    }
    Ok(table.finish())
}

/// All parameters, with units.
pub(super) fn csv(fragilities: &[BlockFragility], limit_state: &Id) -> String {
    let mut table = Table::new(&[
        "id",
        "alpha_rad",
        "p_rad_s",
        "eta",
        "limit_state",
        "intensity",
        "unit",
        "shift",
        "median",
        "dispersion",
        "origin",
    ]);
    for one in fragilities {
        let fragility = &one.fragility;
        table.row([
            one.id.to_string(),
            number(one.block.slenderness_rad()),
            number(one.block.frequency_rad_s()),
            optional(one.eta),
            limit_state.to_string(),
            demand(one.intensity).into(),
            unit(one.intensity).into(),
            number(fragility.shift()),
            number(fragility.median()),
            number(fragility.dispersion()),
            one.origin.clone(),
        ]);
    }
    table.finish()
}

fn demand(intensity: Intensity) -> &'static str {
    match intensity {
        Intensity::Pga => "PGA",
        Intensity::Pgv => "PGV",
    }
}
