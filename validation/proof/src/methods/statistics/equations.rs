//! Eqs. 5 to 7.

use libm::{exp, log};
use rocking::fragility::{c_max, eq5, eq6, eq7};

use super::cells::{Csv, csv, refused};
use crate::methods::method::{Answer, Context, MethodError, WrongModel};

const FRAGILITY: Csv = csv!("oracles/fragility.csv");

/// Eq. 7 over constants against 50 digits; Eqs. 5 and 6 of the shifted
/// lognormal that Eq. 7 is about; its limit and its end.
pub(crate) fn transforms(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        /// Median as it stands in the file.
        median: String,
    }
    let mut answer = Answer::default();
    for row in FRAGILITY.rows(&median)? {
        let [median, beta, shift, c, expected] = row.numbers(0)?;
        let value = match context.wrong {
            Some(WrongModel::Equation7AsPrinted) => {
                let up = median * exp(c * beta) - shift;
                let down = median * exp(-c * beta) - shift;
                log(up / down) / (2.0 * c)
            }
            Some(WrongModel::DeltaMethod) => beta * median / (median - shift),
            _ => eq7(median, beta, shift, c).map_err(refused)?,
        };
        answer.put("eq7", [value], [expected]);
        // The median and quantiles of a shifted lognormal with this excess.
        let excess = median - shift;
        let low = shift + excess * exp(-expected);
        let high = shift + excess * exp(expected);
        let mu = eq5(median, shift).map_err(refused)?;
        answer.put("eq5", [mu], [log(excess)]);
        let six = eq6(low, high, shift).map_err(refused)?;
        answer.put("eq6", [six], [expected]);
        let end = c_max(median, beta, shift).map_err(refused)?;
        // Just below its end Eq. 7 is large, at it there is none.
        if end.is_finite() {
            let beyond = match context.wrong {
                Some(WrongModel::Clamped) => Ok(0.0),
                _ => eq7(median, beta, shift, end),
            };
            let refused = f64::from(u8::from(beyond.is_err()));
            answer.put("refused-at-its-end", [refused], [1.0]);
        }
    }
    Ok(answer)
}
