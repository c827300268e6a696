//! Families of distributions beside each other, against SciPy and mpmath.

use anyhow::{Result, anyhow};
use rocking::statistics::ExtendedSample;
use rocking::statistics::choice::{Distribution, Model, candidate};
use rocking::statistics::lognormal::{FitMethod, fit};

use crate::methods::cells::{Csv, csv};
use crate::methods::method::{Answer, Context, WrongModel};

const CHOICE: Csv = csv!("oracles/choice.csv");

/// Likelihood, criteria and distances of every family in the file.
pub fn choice(context: &Context, answer: &mut Answer) -> Result<()> {
    input! { context;
        sample: Vec<f64>,
        /// The sample as the file names it.
        name: String,
    }
    let sample = ExtendedSample::try_new(&sample)?;
    for row in CHOICE.rows(&name)? {
        let mut models = Model::ALL.into_iter();
        let model = models.find(|model| model.to_string() == row.text(1));
        let model = model.ok_or_else(|| anyhow!("model {}", row.text(1)))?;
        let mut found = candidate(&sample, 0.0, model)?;
        if (context.wrong, model)
            == (Some(WrongModel::OtherDivisor), Model::Lognormal)
        {
            let other = fit(&sample, 0.0, FitMethod::Moment);
            let other = other?;
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
        let quantities = [
            ("log-likelihood", found.log_likelihood),
            ("aic", found.aic),
            ("bic", found.bic),
            (&place("kolmogorov"), found.kolmogorov),
            (&place("anderson-darling"), found.anderson_darling),
        ];
        row.put(answer, 5, &quantities)?;
        let name = place("parameters");
        let parameters: Vec<_> =
            parameters.iter().map(|own| (name.as_str(), *own)).collect();
        row.put(answer, 2, &parameters)?;
    }
    Ok(())
}
