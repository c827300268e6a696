//! What the page shows.

use maud::Markup;
use rocking_common::findings::{Findings, Theme};
use rocking_common::paper::{Arm, Verdict};
use rocking_common::table::PlainTable;
use rocking_draw::figures::Figure;

use crate::evidence::families::Family;

/// Everything the page shows, in its order. Text is plain unless a field
/// says otherwise; what is empty is left out.
#[derive(Debug, Clone, Default)]
pub struct ReportInput<'a> {
    /// Title of the page.
    pub title: String,
    /// What it is about and what was done, a paragraph each.
    pub intro: Vec<String>,
    /// Whether the page that recomputes lies beside this one.
    pub lab: bool,
    /// Name and value: the program, its input, the command.
    pub head: Vec<(String, String)>,
    /// What is signed for, and by whom or when if that was given.
    pub signatures: Vec<(String, Option<String>)>,
    /// The questions that a reader asks first, each with its answer.
    pub answers: Vec<AnswerRow>,
    /// Where other motions answer otherwise.
    pub otherwise: Option<String>,
    /// Drawings beside them.
    pub first: Vec<&'a Figure>,
    /// Scope, intended use and criteria.
    pub scope: Chapter<'a>,
    /// Suites of the columns of the findings: those of the run at hand stand
    /// last.
    pub columns: Vec<Column>,
    /// The findings by theme.
    pub findings: Vec<Shown<'a>>,
    /// Statements that are true by definition, or that are descriptions.
    pub identities: PlainTable,
    /// How the results come about, a paragraph each.
    pub method: Vec<String>,
    /// Terms and symbols, and what they mean.
    pub glossary: Vec<(String, String)>,
    /// Whose results of the declared cases these are, or that there are
    /// none.
    pub proof: String,
    /// Declared cases, family by family.
    pub families: Vec<Family>,
    /// Tables and figures of the proof.
    pub evidence: Chapter<'a>,
    /// Further chapters in order: speed, suites, limits, provenance.
    pub chapters: Vec<Chapter<'a>>,
    /// The data files beside the page, each with its hash.
    pub files: PlainTable,
    /// Chapters that are folded on a screen and left out on paper.
    pub annexes: Vec<Chapter<'a>>,
}

/// One question and its answer.
#[derive(Debug, Clone)]
pub struct AnswerRow {
    /// What is asked.
    pub question: String,
    /// The answer: a sentence of 25 words at most.
    pub answer: String,
    /// Its numbers, each with interval, unit and suite.
    pub effect: String,
    /// Anchor and words of where it is shown.
    pub shown: Vec<(String, String)>,
}

/// Text, tables and figures under a heading.
#[derive(Debug, Clone, Default)]
pub struct Chapter<'a> {
    /// Unique name, also the anchor.
    pub id: &'static str,
    /// The heading.
    pub title: String,
    /// Paragraphs.
    pub text: Vec<String>,
    /// Names and values.
    pub list: Vec<(String, String)>,
    /// Tables.
    pub tables: Vec<PlainTable>,
    /// Figures.
    pub figures: Vec<&'a Figure>,
    /// Parts that are folded on a screen.
    pub folded: Vec<Chapter<'a>>,
}

impl Chapter<'_> {
    /// A chapter with nothing in it yet.
    pub fn titled(id: &'static str, title: &str) -> Self {
        Self { id, title: title.into(), ..Self::default() }
    }
}

/// Findings about one question.
#[derive(Debug, Clone)]
pub struct Shown<'a> {
    /// What it is about.
    pub theme: Theme,
    /// What came out, a paragraph.
    pub paragraph: String,
    /// Its figures.
    pub figures: Vec<&'a Figure>,
    /// Further figures, folded on a screen.
    pub more: Vec<&'a Figure>,
}

/// Suites whose findings stand in one column.
#[derive(Debug, Clone)]
pub struct Column {
    /// `recorded suites`.
    pub name: &'static str,
    /// What came out on them.
    pub findings: Findings,
    /// The arm that stands among the findings.
    pub first: Arm,
    /// How many sentences of the paper have which verdict.
    pub score: Vec<(Verdict, usize)>,
}

/// A section of the page.
pub(super) struct Part {
    pub id: &'static str,
    pub title: String,
    pub body: Markup,
}
