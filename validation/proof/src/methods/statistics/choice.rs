//! Families of distributions beside each other, against SciPy and mpmath.

use rocking::statistics::ExtendedSample;
use rocking::statistics::choice::{Distribution, Model, candidate};
use rocking::statistics::lognormal::{FitMethod, fit};
use serde::Deserialize;

use super::cells::{number, refused, rows};
use crate::cases::WrongModel;
use crate::error::MethodError;
use crate::methods::method::{Answer, Context};

const CHOICE: &str = "fixtures/oracles/choice.csv";
const CHOICE_CSV: &str =
    include_str!("../../../../../fixtures/oracles/choice.csv");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    sample: Vec<f64>,
    /// The sample as the file names it.
    name: String,
}

/// Likelihood, criteria and distances of every family in the file.
pub(crate) fn choice(context: &Context) -> Result<Answer, MethodError> {
    let input: Input = context.input()?;
    let sample = ExtendedSample::try_new(&input.sample).map_err(refused)?;
    let mut answer = Answer::default();
    for row in rows(CHOICE_CSV, CHOICE, &input.name)? {
        let mut models = Model::ALL.into_iter();
        let model = models.find(|model| model.to_string() == row[1]);
        let model = model
            .ok_or_else(|| MethodError::Input(format!("model {}", row[1])))?;
        let mut found = candidate(&sample, 0.0, model).map_err(refused)?;
        if (context.wrong, model)
            == (Some(WrongModel::OtherDivisor), Model::Lognormal)
        {
            let other = fit(&sample, 0.0, FitMethod::Moment);
            let other = other.map_err(refused)?;
            let value = other.log_likelihood.unwrap_or(f64::NAN);
            found.aic += 2.0 * (found.log_likelihood - value);
            found.bic += 2.0 * (found.log_likelihood - value);
            found.log_likelihood = value;
        }
        let (kind, parameters) = match found.distribution {
            Distribution::Lognormal(own) => {
                ("", vec![own.log_mean(), own.dispersion()])
            }
            Distribution::Rival { fit, .. } => {
                ("", vec![fit.shape, fit.scale])
            }
            Distribution::ExtremeValue(own) => {
                ("extreme-", vec![own.location, own.scale, own.shape])
            }
            _ => ("", Vec::new()),
        };
        let place = |name: &str| format!("{kind}{name}");
        let mut values = vec![
            ("log-likelihood".into(), found.log_likelihood, row[5]),
            ("aic".into(), found.aic, row[6]),
            ("bic".into(), found.bic, row[7]),
            (place("kolmogorov"), found.kolmogorov, row[8]),
            (place("anderson-darling"), found.anderson_darling, row[9]),
        ];
        let columns = parameters.iter().zip(&row[2..]);
        values.extend(
            columns.map(|(own, text)| (place("parameters"), *own, *text)),
        );
        for (name, own, text) in values {
            answer.put(&name, [own], [number(CHOICE, text)?]);
        }
    }
    Ok(answer)
}
