//! What the page shows, as words and numbers already formatted.

use maud::Markup;
use rocking_common::findings::Tested;
use rocking_common::paper::Verdict;
use rocking_common::table::PlainTable;

use super::figures::ShownFigure;

/// A figure on the page: its number, its anchor and what it is called.
pub type Anchor = (u32, (String, String));

/// Everything the page shows, in its order. Text is plain unless a field
/// says otherwise; what is empty is left out.
#[derive(Debug, Clone, Default)]
pub struct ReportInput {
    /// Title of the page.
    pub title: String,
    /// One sentence under the title.
    pub subtitle: String,
    /// Name and value: the paper, the program, its input, the command.
    pub head: Vec<(String, String)>,
    /// What is signed for, and by whom or when if that was given.
    pub signatures: Vec<(String, Option<String>)>,
    /// The first thing read.
    pub answers: Answers,
    /// Suites of the columns of the answers and findings.
    pub columns: Vec<Column>,
    /// The findings by theme.
    pub findings: Vec<Theme>,
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
    pub evidence: Chapter,
    /// Further chapters in order: speed, suites, limits, provenance.
    pub chapters: Vec<Chapter>,
    /// Chapters that are folded on a screen and whole on paper.
    pub annexes: Vec<Chapter>,
}

/// The questions that a reader asks first, each with its answer.
#[derive(Debug, Clone, Default)]
pub struct Answers {
    /// The questions.
    pub rows: Vec<AnswerRow>,
    /// Drawings beside them.
    pub figures: Vec<ShownFigure>,
}

/// One question and its answer.
#[derive(Debug, Clone)]
pub struct AnswerRow {
    /// What is asked.
    pub question: String,
    /// The answer, fifteen words at most.
    pub answer: String,
    /// Size of the effect with its interval and unit.
    pub effect: String,
    /// What each column's suites say.
    pub columns: Vec<String>,
    /// Anchor and words of where it is shown.
    pub shown: Vec<(String, String)>,
}

/// Text, tables and figures under a heading.
#[derive(Debug, Clone, Default)]
pub struct Chapter {
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
    pub figures: Vec<ShownFigure>,
    /// Parts that are folded on a screen.
    pub folded: Vec<Chapter>,
}

/// Findings about one question.
#[derive(Debug, Clone)]
pub struct Theme {
    /// Unique name, also the anchor.
    pub id: &'static str,
    /// The question.
    pub question: String,
    /// What came out, a paragraph.
    pub paragraph: String,
    /// Its figures.
    pub figures: Vec<ShownFigure>,
    /// Further figures, folded on a screen.
    pub more: Vec<ShownFigure>,
    /// Claims about it.
    pub findings: Vec<Finding>,
}

/// One claim and what came out.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Unique name, also the anchor.
    pub id: String,
    /// The claim, as quoted.
    pub quote: String,
    /// The claim in plain words.
    pub plain: String,
    /// Where the claim stands: `section 4, Figure 6`.
    pub source: String,
    /// The paper's own criterion, where it states one.
    pub criterion: String,
    /// What counts as confirmed in practice.
    pub rule: String,
    /// What came out, by column.
    pub columns: Vec<Vec<Outcome>>,
    /// Anchors and numbers of the figures that show it.
    pub figures: Vec<(String, String)>,
    /// What was measured, and why the limits are what they are.
    pub measure: String,
    /// A remark, or nothing.
    pub remark: String,
}

/// What came out on a suite and arm.
#[derive(Debug, Clone)]
pub struct Outcome {
    /// The suite.
    pub suite: Tested,
    /// Suite and arm.
    pub place: String,
    /// The value with its interval.
    pub value: String,
    /// The verdict by the paper's own criterion, where it has one.
    pub by_criterion: Option<Verdict>,
    /// The verdict by practical equivalence.
    pub by_equivalence: Option<Verdict>,
    /// Whether it stands among the findings, or in the annex alone.
    pub first: bool,
    /// Cells, how the interval was made, records needed.
    pub remarks: Vec<String>,
}

/// Suites whose findings stand in one column.
#[derive(Debug, Clone)]
pub struct Column {
    /// `recorded suites`.
    pub name: String,
    /// How many records: `86 ordinary + 44 pulse-type`.
    pub suites: String,
    /// Number of results with each verdict.
    pub counts: [(Verdict, usize); 3],
}

/// Declared cases of one kind.
#[derive(Debug, Clone)]
pub struct Family {
    /// Name: `free-rocking`.
    pub name: String,
    /// Largest share of a tolerance that a number of the family uses.
    pub worst: String,
    /// Number of wrong models that the cases told from the right one.
    pub rejected: usize,
    /// The cases.
    pub cases: Vec<ShownCase>,
}

/// One declared case.
#[derive(Debug, Clone)]
pub struct ShownCase {
    /// Unique name.
    pub id: String,
    /// What is claimed.
    pub claim: String,
    /// Where the expected value comes from.
    pub source: String,
    /// The tolerance with its kind.
    pub tolerance: String,
    /// Why that tolerance.
    pub because: String,
    /// The largest error as a share of its tolerance, and of which quantity.
    pub worst: String,
    /// Wrong models that fail it.
    pub rejects: String,
    /// Whether it passed.
    pub passed: bool,
}

/// A section of the page.
pub(super) struct Part {
    pub id: &'static str,
    pub title: String,
    pub body: Markup,
}
