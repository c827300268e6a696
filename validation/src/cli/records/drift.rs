//! Displacements that a drifting baseline makes.

use rocking::intensity::{IntensityError, Measures};

/// Code of the remark.
pub(super) const CODE: &str = "drift";

/// A peak ground displacement above this, in m, is remarked where nothing
/// filtered slow drifts out: the largest that processed records of
/// earthquakes have are of 4 m or so, permanent offsets aside.
const LARGEST_PGD_M: f64 = 5.0;

/// What makes the displacement implausible, if it is; `baseline` says what
/// was done to the record where slow drifts were not filtered out.
pub(super) fn remark(
    found: &Result<Measures, IntensityError>,
    baseline: Option<&str>,
) -> Option<String> {
    let (pgd_m, baseline) = (found.as_ref().ok()?.pgd_m, baseline?);
    (!(pgd_m <= LARGEST_PGD_M))
        .then(|| format!("PGD {pgd_m:.1} m: {baseline}; see --high-pass"))
}
