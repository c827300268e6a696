//! `rocking suite`: suites as files.

use std::path::PathBuf;

use rocking::units::STANDARD_GRAVITY_M_S2;

use super::processing::{RecordArgs, words};
use crate::failure::Failure;
use crate::terminal::say;
use crate::threads::with_threads;
use rocking_common::files::OutputFolder;
use rocking_common::suites::export;
use rocking_common::suites::inputs::read_suite;
use rocking_common::suites::remarks::Remarks;
use rocking_common::words::columns;

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

/// Write suites as AT2 files, each suite with an index: the embedded ones, or
/// your own. `--suite DIR/ordinary.csv` reads them back, bit for bit.
#[derive(clap::Args)]
struct SuiteExportCommand {
    /// A new folder, or an empty one.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
    /// Your own suite: folder, index or zip.
    #[arg(long, value_name = "PATH")]
    suite: Option<PathBuf>,
    #[command(flatten)]
    input: RecordArgs,
}

/// Runs `rocking suite`.
///
/// # Errors
/// [`Failure`] for a suite that is refused, or a folder that is not empty.
pub fn run_suite(args: &SuiteCommand) -> Result<(), Failure> {
    let SuiteAction::Export(args) = &args.action;
    let mut files = Vec::new();
    let mut rows =
        vec![["Suite", "Records", "Index"].map(String::from).into()];
    let mut aside = String::new();
    let mut add = |name: &str, members: Vec<export::ExportRow<'_>>| {
        let index = args.out.join(format!("{name}.csv"));
        let records = members.len().to_string();
        rows.push(vec![name.into(), records, index.display().to_string()]);
        files.extend(export::files(name, &members)?);
        Ok::<(), Failure>(())
    };
    match &args.suite {
        Some(path) => {
            let processing = args.input.processing()?;
            let options = args.input.reading.options(STANDARD_GRAVITY_M_S2);
            let suite = read_suite(path, options)?;
            let suite = suite.processed(&processing)?;
            args.input
                .reading
                .judge(suite.set_aside(), &Remarks::on(&suite))?;
            let done = words(&processing);
            add(suite.name(), export::members(&suite, done.as_deref()))?;
            if !suite.set_aside().is_empty() {
                aside = format!("Files set aside: {}\n", suite.set_aside());
            }
        }
        None => {
            let without = "--suite: the embedded suites need no correction";
            args.input.refuse_unused(without)?;
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
    let (out, table) = (args.out.display(), columns(&rows, |k| k == 1));
    say(&format!("The records are in {out}.\n{aside}\n{table}"))
}
