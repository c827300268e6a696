//! The certificate on random scenes.

use serde::Deserialize;

use super::method::{Context, Memo, Reply};
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

/// Findings by stratum and indices.
static FOUND: Memo<(Stratum, Vec<u64>), Finding> = Memo::new();

/// Wrong outcomes and exceeded estimates of runs with a clear certificate.
pub fn certificate(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Stratum: `ordinary`, `extreme` or `grazing`.
        kind: Stratum,
        /// Which scenes.
        scenes: Scenes,
    }
    let Scenes { count, first } = scenes;
    let end = first.checked_add(count);
    let end = end.with_context(|| format!("{count} from {first}"))?;
    let key = (kind, (first..end).collect());
    let make = |(kind, indices): &(_, Vec<_>)| Ok(findings(*kind, indices)?);
    let found = FOUND.get(key, make)?;
    let summary = TrialSummary::of(&found, CertificateReading(context.wrong));
    for never in ["wrong-and-clear", "estimates-exceeded"] {
        answer.put(never, [], [0.0]);
    }
    let counts = [
        ("wrong-and-clear", summary.wrong_and_clear as f64),
        ("estimates-exceeded", summary.exceeded as f64),
        ("runs", summary.runs as f64),
        ("unresolved-share", summary.unresolved as f64 / summary.runs as f64),
        ("wrong-and-unresolved", summary.wrong_and_unresolved as f64),
        ("clear-and-undecided", summary.undecided as f64),
    ];
    let ratios = SHARES.map(|(name, share)| (name, summary.ratio(share)));
    for (name, value) in counts.into_iter().chain(ratios) {
        answer.see(name, [value]);
    }
    Ok(())
}
