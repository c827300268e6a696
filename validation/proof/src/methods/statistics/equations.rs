//! Eqs. 5 to 7.

use anyhow::Result;
use libm::{exp, log};
use rocking_procedures::fragility::{c_max, eq5, eq6, eq7};

use crate::methods::cells::Csv;
use crate::methods::method::{Context, Reply, WrongModel};

const FRAGILITY: Csv = Csv::new("oracles/fragility.csv");

/// Eq. 7 over constants against 50 digits; Eqs. 5 and 6 of the shifted
/// lognormal that Eq. 7 is about; its limit and its end.
pub fn transforms(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Median as it stands in the file.
        median: String,
    }
    for row in FRAGILITY.rows(&median)? {
        let [median, beta, shift, c, expected] = row.numbers(0)?;
        let value = match context.wrong {
            Some(WrongModel::Equation7AsPrinted) => {
                let up = median * exp(c * beta) - shift;
                let down = median * exp(-c * beta) - shift;
                log(up / down) / (2.0 * c)
            }
            Some(WrongModel::DeltaMethod) => beta * median / (median - shift),
            _ => eq7(median, beta, shift, c)?,
        };
        answer.put("eq7", [value], [expected]);
        // The median and quantiles of a shifted lognormal with this excess.
        let excess = median - shift;
        let low = shift + excess * exp(-expected);
        let high = shift + excess * exp(expected);
        let mu = eq5(median, shift)?;
        answer.put("eq5", [mu], [log(excess)]);
        let six = eq6(low, high, shift)?;
        answer.put("eq6", [six], [expected]);
        let end = c_max(median, beta, shift)?;
        // Just below its end Eq. 7 is large, at it there is none.
        if end.is_finite() {
            let beyond = eq7(median, beta, shift, end).is_err();
            let refused = context.or(WrongModel::Clamped, false, beyond);
            let refused = f64::from(refused);
            answer.put("refused-at-its-end", [refused], [1.0]);
        }
    }
    Ok(())
}
