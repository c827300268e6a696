//! A probability from a count.

use rocking::statistics::{Proportion, normal};
use serde::Deserialize;

use super::cells::{number, refused, rows};
use crate::cases::WrongModel;
use crate::error::MethodError;
use crate::methods::method::{Answer, Context};

const FILE: &str = "fixtures/oracles/proportion.csv";
const CSV: &str =
    include_str!("../../../../../fixtures/oracles/proportion.csv");

const LEVEL: f64 = 0.95;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    /// Successes and trials.
    counts: Vec<(usize, usize)>,
    /// How many such probabilities are held at once.
    together: usize,
}

/// Wilson's interval, which is not exact.
fn wilson(share: f64, trials: usize, level: f64) -> (f64, f64) {
    let (z, n) = (normal::quantile(0.5 * (1.0 + level)), trials as f64);
    let middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let spread = share * (1.0 - share) / n + z * z / (4.0 * n * n);
    let half = z * spread.sqrt() / (1.0 + z * z / n);
    (middle - half, middle + half)
}

/// Exact intervals of probabilities, alone or of many at once.
pub(crate) fn intervals(context: &Context) -> Result<Answer, MethodError> {
    let input: Input = context.input()?;
    let mut answer = Answer::default();
    for (successes, trials) in input.counts {
        let one = Proportion::try_new(successes, trials).map_err(refused)?;
        let together = match context.wrong {
            Some(WrongModel::PointwiseIntervals) => 1,
            _ => input.together,
        };
        let all = vec![one; together];
        let band = Proportion::band(&all, LEVEL).map_err(refused)?;
        let first = band.first().copied();
        let mut ends = first.unwrap_or((f64::NAN, f64::NAN));
        if context.wrong == Some(WrongModel::WilsonInterval) {
            let level = 1.0 - (1.0 - LEVEL) / together as f64;
            ends = wilson(one.share(), trials, level);
        }
        let words = [successes, trials, input.together].map(|k| k.to_string());
        let wanted = rows(CSV, FILE, &words[0])?
            .into_iter()
            .find(|row| row[1] == words[1] && row[2] == words[2])
            .ok_or_else(|| MethodError::Reference {
                file: FILE,
                what: format!("no row `{}`", words.join(",")),
            })?;
        let wanted = [number(FILE, wanted[3])?, number(FILE, wanted[4])?];
        answer.put("low", [ends.0], [wanted[0]]);
        answer.put("high", [ends.1], [wanted[1]]);
    }
    Ok(answer)
}
