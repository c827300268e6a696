//! What of fragilities is drawn.

use rocking::procedures::Sampled;
use rocking_draw::figures::of_suite::Fragility;

/// The fragilities with the bands of their draws at these intensities.
pub(in crate::cli) fn with_bands(
    mut all: Vec<Fragility>,
    sampled: &[Option<Sampled>],
    levels: &[f64],
) -> Vec<Fragility> {
    for (one, sampled) in all.iter_mut().zip(sampled) {
        let band = |sampled: &Sampled| sampled.band(&one.fitted, levels);
        one.band = sampled.as_ref().map(band);
    }
    all
}
