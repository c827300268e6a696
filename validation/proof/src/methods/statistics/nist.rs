//! NIST's univariate data sets.

use anyhow::Result;
use rocking_statistics::Sample;

use crate::methods::cells::Csv;
use crate::methods::method::{Context, Reply, WrongModel};

const UNIVARIATE: Csv = Csv::new("nist/univariate.csv");

/// Mean and standard deviation of a certified data set.
pub fn moments(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; set: String);
    let row = &UNIVARIATE.rows(&set)?[0];
    let values = row.list(4, ' ')?;
    let sample = Sample::try_new(&values)?;
    let n = values.len() as f64;
    // One pass, sum x^2 - (sum x)^2/n.
    let (sum, square) =
        values.iter().fold((0.0, 0.0), |(s, q), x| (s + x, q + x * x));
    let pass = square - sum * sum / n;
    let right = sample.sum_of_squares();
    let squares = context.or(WrongModel::SumOfSquares, pass, right);
    let divisor = context.or(WrongModel::OtherDivisor, n, n - 1.0);
    let deviation = (squares / divisor).sqrt();
    let quantities =
        [("mean", sample.mean()), ("standard-deviation", deviation)];
    row.put(answer, 1, &quantities)
}
