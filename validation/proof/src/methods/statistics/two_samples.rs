//! Two samples against each other.

use rocking::statistics::ExtendedSample;
use rocking::statistics::two_sample::kolmogorov_smirnov;

use super::cells::refused;
use crate::methods::method::{Answer, Context, MethodError, WrongModel};

/// Kolmogorov's and Smirnov's distance of every two of the samples, and its
/// p-value.
pub(crate) fn two_samples(context: &Context) -> Result<Answer, MethodError> {
    input!(context; samples: Vec<Vec<f64>>);
    let samples = samples
        .iter()
        .map(|values| ExtendedSample::try_new(values).map_err(refused))
        .collect::<Result<Vec<_>, _>>()?;
    let mut answer = Answer::default();
    for (i, a) in samples.iter().enumerate() {
        for b in &samples[i + 1..] {
            let found = kolmogorov_smirnov(a, b);
            let p = match context.wrong {
                Some(WrongModel::OneSideDoubled) => {
                    // The asymptotic tail of one side, doubled.
                    let (n, m) = (a.len() as f64, b.len() as f64);
                    let d = found.statistic;
                    2.0 * libm::exp(-2.0 * d * d * n * m / (n + m))
                }
                _ => found.p_value,
            };
            answer.see("distance", [found.statistic]);
            answer.see("p-value", [p]);
        }
    }
    Ok(answer)
}
