//! `rocking suite`: suites as files.

use std::path::PathBuf;

use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::SetAside;
use serde::Serialize;

use super::processing::{ProcessingArgs, words};
use super::reading::ReadArgs;
use super::show::text;
use crate::failure::Failure;
use crate::terminal::say;
use crate::threads::with_threads;
use rocking_common::files::OutputFolder;
use rocking_common::suites::export;
use rocking_common::suites::inputs::read_suite;
use rocking_common::suites::remarks::Remarks;

/// Suites of records as files.
#[derive(clap::Args)]
pub struct SuiteCommand {
    #[command(subcommand)]
    action: SuiteAction,
}

#[derive(clap::Subcommand)]
enum SuiteAction {
    Export(SuiteExportCommand),
}

/// Write suites as AT2 files with an index each: the embedded ones, or your
/// own. `--suite DIR/ordinary.csv` reads them back, bit for bit.
#[derive(clap::Args)]
struct SuiteExportCommand {
    /// A new folder, or an empty one.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Your own suite: folder, index or zip.
    #[arg(long, value_name = "PATH")]
    suite: Option<PathBuf>,
    #[command(flatten)]
    reading: ReadArgs,
    #[command(flatten)]
    processing: ProcessingArgs,
}

/// The files that were written.
#[derive(Serialize)]
struct SuiteFiles {
    suites: Vec<SuiteFile>,
    /// Files set aside of the user's suite.
    set_aside: Option<SetAside>,
}

#[derive(Serialize)]
struct SuiteFile {
    suite: String,
    records: usize,
    index: String,
}

/// Runs `rocking suite`.
///
/// # Errors
/// [`Failure`] for a suite that is refused, or a folder that is not empty.
pub fn run_suite(args: &SuiteCommand) -> Result<(), Failure> {
    let SuiteAction::Export(args) = &args.action;
    let mut files = Vec::new();
    let mut shown = SuiteFiles { suites: Vec::new(), set_aside: None };
    let mut add = |name: &str, rows: Vec<export::ExportRow<'_>>| {
        shown.suites.push(SuiteFile {
            suite: name.to_owned(),
            records: rows.len(),
            index: args.out.join(format!("{name}.csv")).display().to_string(),
        });
        files.extend(export::files(name, &rows)?);
        Ok::<(), Failure>(())
    };
    match &args.suite {
        Some(path) => {
            let processing = args.processing.processing()?;
            let options = args.reading.options(STANDARD_GRAVITY_M_S2);
            let suite = read_suite(path, options)?;
            let suite = suite.processed(&processing)?;
            args.reading.judge(suite.set_aside(), &Remarks::on(&suite))?;
            let done = words(&processing);
            add(suite.name(), export::members(&suite, done.as_deref()))?;
            shown.set_aside = Some(suite.set_aside().clone());
        }
        None => {
            let without = "--suite: the embedded suites need no correction";
            args.reading.refuse_unused(args.processing, without)?;
            let ordinary = with_threads(None, rocking_synthesis::ordinary)??;
            let pulse = with_threads(None, rocking_synthesis::pulse)??;
            add("ordinary", export::pairs(&ordinary))?;
            add("pulse", export::pairs(&pulse))?;
        }
    }
    let folder = OutputFolder::open_new(&args.out)?;
    let last = files.last().map_or(String::new(), |(name, _)| name.clone());
    let files = files.into_iter().map(|(path, text)| (path, text.into()));
    folder.write(&files.collect(), &[&last])?;
    let sentence = format!("The records are in {}.", args.out.display());
    say(&text(&sentence, &shown)?)
}
