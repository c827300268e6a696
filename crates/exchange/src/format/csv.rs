//! A table of all parameters with their units, for any program.

use super::{ExchangeFormat, Result, Texts};
use crate::columns::FRAGILITIES;
use crate::fragility::BlockFragility;
use crate::table::{Table, number, optional};

/// The format.
pub(super) static FORMAT: ExchangeFormat = ExchangeFormat {
    name: "csv",
    help: "All parameters, any measure",
    cells: "any program | all | a column",
    may_cross: true,
    texts,
    ..ExchangeFormat::BASE
};

fn texts(fragilities: &[BlockFragility]) -> Result<Texts> {
    let mut table = Table::of(&FRAGILITIES);
    for one in fragilities {
        for (state, total) in one.totals(1.0)? {
            let fragility = &state.fragility;
            table.row([
                one.id.to_string(),
                number(one.block.slenderness_rad()),
                number(one.block.frequency_rad_s()),
                optional(one.eta),
                state.name.to_string(),
                one.im.to_string(),
                one.im.unit().into(),
                number(fragility.shift()),
                number(fragility.median()),
                number(fragility.dispersion()),
                number(total.bias()),
                number(total.model_dispersion()),
                number(total.quantile(0.16)),
                number(total.median()),
                number(total.quantile(0.84)),
                one.origin.clone(),
            ]);
        }
    }
    Ok(Texts { main: table.finish(), beside: None })
}
