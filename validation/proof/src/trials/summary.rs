//! Counts of findings.

use rocking::number::Real as _;

use super::compare::{CertificateReading, Finding, WideTruth};

/// The verdict of a finding on a certificate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Judgement {
    /// The run leaves its outcome open; true if its outcome is wrong.
    Unresolved(bool),
    /// The run is clear and the truth is not known.
    Undecided,
    /// The run is clear and its outcome is wrong.
    WrongAndClear,
    /// The run is clear and the error of its peak exceeds its estimate by this
    /// factor.
    Exceeded(f64),
    /// The run is clear and the error of its peak is this share of its
    /// estimate.
    Within(f64),
    /// The run is clear, and the block overturned.
    Right,
}

impl Judgement {
    /// Judges a finding.
    pub fn of(finding: &Finding, reading: CertificateReading) -> Self {
        let seen = &finding.seen;
        let wrong = match finding.truth {
            WideTruth::Stands { peak_ratio, .. } => {
                let lifts = peak_ratio.to_f64() > 0.0;
                Some(seen.overturned || lifts != (seen.peak_ratio > 0.0))
            }
            WideTruth::Overturned => Some(!seen.overturned),
            WideTruth::Undecided => None,
        };
        if !reading.is_clear(seen) {
            return Self::Unresolved(wrong == Some(true));
        }
        match wrong {
            None => Self::Undecided,
            Some(true) => Self::WrongAndClear,
            Some(false) => finding.error().map_or(Self::Right, |error| {
                let ratio = error / reading.estimate(seen);
                let held = ratio <= 1.0;
                if held { Self::Within(ratio) } else { Self::Exceeded(ratio) }
            }),
        }
    }

    /// True for a failure of the certificate.
    pub fn is_bad(&self) -> bool {
        matches!(self, Self::WrongAndClear | Self::Exceeded(_))
    }
}

/// Shares of the distribution of error over estimate, in tenths of a
/// percent.
pub const SHARES: [(&str, usize); 5] = [
    ("median-ratio", 500),
    ("ninth-decile-ratio", 900),
    ("last-percentile-ratio", 990),
    ("last-thousandth-ratio", 999),
    ("largest-ratio", 1000),
];

/// Many findings in numbers.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TrialSummary {
    /// Trials.
    pub runs: usize,
    /// Runs that are clear.
    pub clear: usize,
    /// Runs that leave their outcome open.
    pub unresolved: usize,
    /// Of those, runs with the wrong outcome.
    pub wrong_and_unresolved: usize,
    /// Clear runs whose true outcome is not known.
    pub undecided: usize,
    /// Clear runs with the wrong outcome.
    pub wrong_and_clear: usize,
    /// Clear runs whose error of the peak exceeds its estimate.
    pub exceeded: usize,
    /// Error of the peak over its estimate, of clear runs, in rising order.
    pub ratios: Vec<f64>,
}

impl TrialSummary {
    /// Counts findings.
    pub fn of(findings: &[Finding], reading: CertificateReading) -> Self {
        let mut all = Self { runs: findings.len(), ..Self::default() };
        for finding in findings {
            match Judgement::of(finding, reading) {
                Judgement::Unresolved(wrong) => {
                    all.unresolved += 1;
                    all.wrong_and_unresolved += usize::from(wrong);
                }
                Judgement::Undecided => all.undecided += 1,
                Judgement::WrongAndClear => all.wrong_and_clear += 1,
                Judgement::Exceeded(ratio) => {
                    all.exceeded += 1;
                    all.ratios.push(ratio);
                }
                Judgement::Within(ratio) => all.ratios.push(ratio),
                Judgement::Right => {}
            }
        }
        all.clear = all.runs - all.unresolved;
        all.ratios.sort_by(f64::total_cmp);
        all
    }

    /// Quantile of error over estimate, at a share in thousandths; not a
    /// number if there is none.
    pub fn ratio(&self, thousandths: usize) -> f64 {
        let last = self.ratios.len().saturating_sub(1);
        let at = (last * thousandths).div_ceil(1000);
        self.ratios.get(at).copied().unwrap_or(f64::NAN)
    }
}
