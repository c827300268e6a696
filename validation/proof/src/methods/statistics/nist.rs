//! NIST's univariate data sets.

use rocking::statistics::Sample;
use serde::Deserialize;

use super::cells::{number, refused, rows};
use crate::cases::WrongModel;
use crate::error::MethodError;
use crate::methods::method::{Answer, Context};

const FILE: &str = "fixtures/nist/univariate.csv";
const CSV: &str = include_str!("../../../../../fixtures/nist/univariate.csv");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    set: String,
}

/// Mean and standard deviation of a certified data set.
pub(crate) fn moments(context: &Context) -> Result<Answer, MethodError> {
    let input: Input = context.input()?;
    let rows = rows(CSV, FILE, &input.set)?;
    let [_, mean, deviation, _, values] = rows[0].as_slice() else {
        let what = format!("row `{}` has no five fields", input.set);
        return Err(MethodError::Reference { file: FILE, what });
    };
    let values: Vec<f64> = values
        .split(' ')
        .map(|v| number(FILE, v))
        .collect::<Result<_, _>>()?;
    let sample = Sample::try_new(&values).map_err(refused)?;
    let n = values.len() as f64;
    let squares = match context.wrong {
        // One pass, sum x^2 - (sum x)^2/n.
        Some(WrongModel::SumOfSquares) => {
            let (sum, square) =
                values.iter().fold((0.0, 0.0), |(s, q), x| (s + x, q + x * x));
            square - sum * sum / n
        }
        _ => sample.sum_of_squares(),
    };
    let divisor = match context.wrong {
        Some(WrongModel::OtherDivisor) => n,
        _ => n - 1.0,
    };
    let mut answer = Answer::default();
    let expected = vec![number(FILE, mean)?];
    answer.put("mean", [sample.mean()], expected);
    let observed = vec![(squares / divisor).sqrt()];
    let expected = vec![number(FILE, deviation)?];
    answer.put("standard-deviation", observed, expected);
    Ok(answer)
}
