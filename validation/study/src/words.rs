//! Words of the figures and of the answers, from `words.toml`.

use std::collections::BTreeMap;
use std::sync::LazyLock;

use rocking_common::paper::Arm;
use rocking_draw::figures::Heading;
use serde::Deserialize;

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StudyWords {
    /// Figures of the paper, by number.
    paper: BTreeMap<String, FigureWords>,
    /// Other figures, by name.
    beyond: BTreeMap<String, FigureWords>,
    /// Tables of the answers, by name.
    table: BTreeMap<String, TableWords>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FigureWords {
    title: String,
    description: String,
    #[serde(default)]
    caption: String,
}

/// Words of a table of an answer.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TableWords {
    /// The question, if only this table answers it.
    #[serde(default)]
    pub question: String,
    /// Title of the table.
    pub title: String,
    /// Explanation of the table.
    pub reading: String,
}

static WORDS: LazyLock<StudyWords> = LazyLock::new(|| {
    toml::from_str(include_str!("../words.toml"))
        .unwrap_or_else(|error| panic!("words.toml: {error}"))
});

/// The heading of a figure of the paper.
pub(crate) fn paper_heading(number: u32, arm: Option<Arm>) -> Heading {
    let FigureWords { title, description, .. } =
        &WORDS.paper[&number.to_string()];
    Heading::numbered(number, title, description, arm)
}

/// The heading of a figure beyond the paper.
pub(crate) fn heading(name: &str) -> Heading {
    let FigureWords { title, description, .. } = &WORDS.beyond[name];
    Heading::new(format!("figure-{name}"), title, description)
}

/// The caption of a figure, if it contains no number of the run.
pub(crate) fn caption(name: &str) -> &'static str {
    &WORDS.beyond[name].caption
}

/// The words of a table of an answer.
pub(crate) fn table_words(name: &str) -> &'static TableWords {
    &WORDS.table[name]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_figure_of_the_paper_has_words() {
        let titles: Vec<String> =
            (1..=18).map(|k| paper_heading(k, None).title).collect();
        assert_eq!(titles.len(), WORDS.paper.len());
        assert!(titles.iter().all(|title| !title.is_empty()));
    }
}
