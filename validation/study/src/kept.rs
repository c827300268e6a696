//! StudyResults of recorded suites that an earlier run found and that are kept:
//! the recorded motions may not be passed on. A run on the embedded suites
//! shows them beside its own results if both runs have the same settings.

use anyhow::Context as _;
use rocking_common::findings::{Findings, StudySettings};

/// Findings of the recorded suites: values, intervals, verdicts, record names
/// and hashes, and no sample of a record. The file's own words say how it is
/// made.
const FINDINGS: &str = rocking_fixtures::text("recorded/findings.json");

/// Figures of the recorded suites: peaks, capacities and statistics of them
/// as they are drawn, and no sample of a record.
const FIGURES: &str = rocking_fixtures::text("recorded/figures.json");

/// The kept results, for a run that has their settings.
#[derive(Clone, Debug)]
pub struct KeptResults {
    findings: Findings,
}

impl KeptResults {
    /// The kept results, if these are their settings.
    ///
    /// # Errors
    /// What the reader found instead of findings of this schema.
    ///
    /// ```
    /// use rocking_study::kept::{self, KeptResults};
    /// # fn main() -> anyhow::Result<()> {
    /// let mut settings = kept::settings()?;
    /// assert!(KeptResults::of(&settings)?.is_some());
    /// settings.eta = 0.90;
    /// assert!(KeptResults::of(&settings)?.is_none());
    /// # Ok(())
    /// # }
    /// ```
    pub fn of(settings: &StudySettings) -> anyhow::Result<Option<Self>> {
        let findings = findings()?;
        let same = findings.settings == *settings;
        Ok(same.then_some(Self { findings }))
    }

    /// What was found.
    #[must_use]
    pub fn findings(&self) -> &Findings {
        &self.findings
    }

    /// The figures, as JSON.
    #[must_use]
    pub fn figures(&self) -> &'static str {
        FIGURES
    }
}

/// The settings of the kept results.
///
/// # Errors
/// As [`KeptResults::of`].
pub fn settings() -> anyhow::Result<StudySettings> {
    Ok(findings()?.settings)
}

fn findings() -> anyhow::Result<Findings> {
    Findings::parse(FINDINGS)
        .map_err(anyhow::Error::msg)
        .context("fixtures/recorded/findings.json")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::integrator::Overturning;
    use rocking_common::paper::Arm;

    #[test]
    fn any_other_setting_leaves_the_kept_results_out() {
        let own = settings().expect("settings");
        let is_kept = |change: &dyn Fn(&mut StudySettings)| {
            let mut other = own.clone();
            change(&mut other);
            KeptResults::of(&other).expect("findings").is_some()
        };
        assert!(is_kept(&|_| ()));
        assert!(!is_kept(&|s| s.eta = 0.90));
        assert!(!is_kept(&|s| s.eta = f64::NAN));
        assert!(!is_kept(&|s| s.overturning = Overturning::HalfPi));
        assert!(!is_kept(&|s| s.refinement_im = 1e-3));
        assert!(!is_kept(&|s| s.arms = vec![Arm::A]));
        assert!(!is_kept(&|s| s.full = true));
    }
}
