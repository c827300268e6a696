//! The certificate on random scenes.

use serde::Deserialize;

use super::memo::Memo;
use super::method::{Context, Reply};
use crate::trials::{
    CertificateReading, Finding, SHARES, Stratum, TrialSummary, findings,
};
use anyhow::{Context as _, Result};

/// Scenes of a stratum.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Scenes {
    /// Number of scenes.
    count: u64,
    /// Index of the first.
    first: u64,
}

impl Scenes {
    fn indices(&self) -> Result<Vec<u64>> {
        let Self { count, first } = *self;
        let end = first.checked_add(count);
        let end = end.with_context(|| format!("{count} from {first}"))?;
        Ok((first..end).collect())
    }
}

/// Findings by stratum and indices.
static FOUND: Memo<(Stratum, Vec<u64>), Finding> = Memo::new();

/// Wrong fates and exceeded estimates of runs whose certificate is clear.
pub fn certificate(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Stratum: `ordinary`, `extreme` or `grazing`.
        kind: Stratum,
        /// Which scenes.
        scenes: Scenes,
    }
    let key = (kind, scenes.indices()?);
    let make = |(kind, indices): &(_, Vec<_>)| Ok(findings(*kind, indices)?);
    let found = FOUND.get(key, make)?;
    let summary = TrialSummary::of(&found, CertificateReading(context.wrong));
    for (name, count) in [
        ("wrong-and-clear", summary.wrong_and_clear),
        ("estimates-exceeded", summary.exceeded),
    ] {
        answer.put(name, [count as f64], [0.0]);
    }
    let counts = [
        ("runs", summary.runs as f64),
        ("unresolved-share", summary.unresolved_share()),
        ("wrong-and-unresolved", summary.wrong_and_unresolved as f64),
        ("clear-and-undecided", summary.undecided as f64),
    ];
    let ratios = SHARES.map(|(name, share)| (name, summary.ratio(share)));
    for (name, value) in counts.into_iter().chain(ratios) {
        answer.see(name, [value]);
    }
    Ok(())
}
