//! Two samples against each other.

use anyhow::Result;
use rocking_statistics::ExtendedSample;
use rocking_statistics::two_sample::kolmogorov_smirnov;

use crate::methods::method::{Context, Reply, WrongModel};

/// Kolmogorov's and Smirnov's distance of every two of the samples, and its
/// p-value.
pub fn two_samples(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; samples: Vec<Vec<f64>>);
    let samples = samples
        .iter()
        .map(|values| ExtendedSample::try_new(values))
        .collect::<Result<Vec<_>, _>>()?;
    for (i, a) in samples.iter().enumerate() {
        for b in &samples[i + 1..] {
            let found = kolmogorov_smirnov(a, b);
            // The asymptotic tail of one side, doubled.
            let (n, m) = (a.len() as f64, b.len() as f64);
            let d = found.statistic;
            let doubled = 2.0 * libm::exp(-2.0 * d * d * n * m / (n + m));
            let p = found.p_value;
            let p = context.or(WrongModel::OneSideDoubled, doubled, p);
            answer.see("distance", [found.statistic]);
            answer.see("p-value", [p]);
        }
    }
    Ok(())
}
