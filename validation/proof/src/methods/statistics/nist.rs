//! NIST's univariate data sets.

use rocking::statistics::Sample;

use super::cells::{Csv, csv, refused};
use crate::methods::method::{Answer, Context, MethodError, WrongModel};

const UNIVARIATE: Csv = csv!("nist/univariate.csv");

/// Mean and standard deviation of a certified data set.
pub(crate) fn moments(context: &Context) -> Result<Answer, MethodError> {
    input!(context; set: String);
    let row = &UNIVARIATE.rows(&set)?[0];
    let values = row.text(4).split(' ').map(str::parse);
    let values: Vec<f64> =
        values.collect::<Result<_, _>>().map_err(|error| {
            UNIVARIATE.lacks(format!("values of `{set}`: {error}"))
        })?;
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
    let divisor = context.or(WrongModel::OtherDivisor, n, n - 1.0);
    let mut answer = Answer::default();
    let deviation = (squares / divisor).sqrt();
    let quantities =
        [("mean", sample.mean()), ("standard-deviation", deviation)];
    row.put(&mut answer, 1, &quantities)?;
    Ok(answer)
}
