//! Words of the page that no run changes, which `words.toml` has.

use anyhow::Context as _;
use serde::Deserialize;

const WORDS: &str = include_str!("../words.toml");

/// What the file has, in its order.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Words {
    /// What a rocking block is.
    pub intro: String,
    /// Scope, intended use, acceptance, a paragraph each.
    pub scope: Vec<String>,
    /// What is done otherwise than in the paper.
    pub deviations: Vec<(String, String)>,
    /// Numbers, and what is cited.
    pub references: Vec<(String, String)>,
    /// How the results come about, a paragraph each.
    pub method: Vec<String>,
    /// Terms, and what they mean.
    pub glossary: Vec<(String, String)>,
    /// The factors of the credibility assessment.
    pub assessment: Vec<Factor>,
    /// The row of verification, where cases were run.
    pub verified: Factor,
    /// The row of the input, where the user gave the suites.
    pub given: Factor,
}

/// A factor of the credibility assessment.
#[derive(Clone, Deserialize)]
pub struct Factor {
    /// `Verification`.
    pub name: String,
    /// Level of 0 to 4.
    pub level: String,
    /// Evidence for it.
    pub evidence: String,
    /// What is missing.
    pub gaps: String,
}

/// The words.
///
/// # Errors
/// Where the file has other keys.
pub fn words() -> anyhow::Result<Words> {
    toml::from_str(WORDS).context("words.toml")
}
