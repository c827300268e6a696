//! The command line: one file a command, all of them `Args -> Result<(), Failure>`.

mod accept;
mod validate;

use std::io;
use std::num::NonZeroUsize;
use std::process::ExitCode;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, mpsc};
use std::time::Duration;

use clap::{
    Arg, ArgAction, CommandFactory as _, FromArgMatches as _, Parser,
    Subcommand,
};
use rocking::stop::{Stop, StopError};
use signal_hook::consts::SIGABRT;
use signal_hook::flag::register_conditional_shutdown;

pub mod blocks;
pub mod capacities;
pub mod compare;
pub mod completions;
pub mod diff;
pub mod excitation;
pub mod fragility;
pub mod ida;
pub mod input;
pub mod lilliefors;
mod limit;
pub mod man;
pub mod measure;
mod names;
pub mod processing;
pub mod rank;
pub mod reading;
pub mod records;
pub mod respond;
pub mod risk;
pub mod sample;
pub mod scene;
mod shared;
pub mod show;
pub mod speed;
pub mod stripes;
pub mod study;
pub mod suite;
pub mod sweep;
pub mod terminal;
pub mod way;

pub use terminal::{SOFTWARE, note, print, say};

/// Threads beyond which more only cost.
const MOST_THREADS_A_PROCESSOR: usize = 8;

/// The commands by what they are for, as `rocking --help` lists them.
const GROUPS: [(&str, &[&str]); 4] = [
    (
        "Analyse",
        &["respond", "ida", "records", "suite", "capacities", "sweep"],
    ),
    (
        "Decide",
        &[
            "stripes",
            "fragility",
            "risk",
            "rank",
            "sample",
            "compare",
            "lilliefors",
        ],
    ),
    ("Prove", &["study", "validate", "diff", "speed"]),
    ("Develop", &["accept", "completions", "man"]),
];

/// The commit of the sources; `unknown` outside a repository.
const COMMIT: &str = env!("ROCKING_COMMIT");

const VERSION: &str = concat!(
    env!("CARGO_PKG_VERSION"),
    " (commit ",
    env!("ROCKING_COMMIT"),
    ")"
);

/// Rocking of free-standing blocks under earthquakes, and its statistics.
#[derive(Parser)]
#[command(name = "rocking", version = VERSION, max_term_width = 100)]
#[command(disable_help_subcommand = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    Accept(accept::Args),
    Respond(Box<respond::Args>),
    Ida(Box<ida::Args>),
    Records(records::Args),
    Capacities(capacities::Args),
    Compare(compare::Args),
    Completions(completions::Args),
    Diff(diff::Args),
    Fragility(fragility::Args),
    Lilliefors(lilliefors::Args),
    Man(man::Args),
    Rank(Box<rank::Args>),
    Risk(risk::Args),
    Sample(sample::Args),
    Speed(speed::Args),
    Stripes(stripes::Args),
    Study(study::Args),
    Suite(suite::Args),
    Sweep(sweep::Args),
    /// Runs the declared cases and writes or checks their results.
    Validate(validate::Args),
}

/// A command that did not do what it was asked: what is printed, and the
/// exit status.
#[derive(Debug)]
pub struct Failure {
    /// One message for people, on standard error.
    pub message: String,
    /// 1 for a failed gate, 2 for bad usage or input.
    pub status: u8,
}

impl Failure {
    /// Bad usage or bad input: exit status 2.
    #[must_use]
    pub fn input(message: impl std::fmt::Display) -> Self {
        Self { message: message.to_string(), status: 2 }
    }

    /// A gate that failed: exit status 1.
    #[must_use]
    pub fn gate(message: impl std::fmt::Display) -> Self {
        Self { message: message.to_string(), status: 1 }
    }
}

impl<E: Into<anyhow::Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        let mut message = String::new();
        for source in error.into().chain().map(ToString::to_string) {
            if message.is_empty() {
                message = source;
            } else if !message.contains(&source) {
                message = format!("{message}: {source}");
            }
        }
        Self::input(message)
    }
}

/// Names the file or the flag of a refusal.
pub trait At<T> {
    /// Puts the file or the flag before the message.
    ///
    /// # Errors
    /// [`Failure`] where there was one.
    fn at(self, place: impl std::fmt::Display) -> Result<T, Failure>;
}

impl<T, E: Into<Failure>> At<T> for Result<T, E> {
    fn at(self, place: impl std::fmt::Display) -> Result<T, Failure> {
        self.map_err(|error| {
            let Failure { message, status } = error.into();
            Failure { message: format!("{place}: {message}"), status }
        })
    }
}

/// Runs `work` on `threads` threads (default: all processors). Caps the count
/// at eight per processor, with a note.
///
/// # Errors
/// [`Failure`] for zero threads, or threads that cannot be started.
pub fn with_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Failure> {
    let done = until(&Stop::default(), threads, work)?;
    done.ok_or_else(|| Failure::gate("the work was stopped"))
}

/// [`with_threads`], unless a stop ends the work before.
///
/// # Errors
/// As [`with_threads`].
pub fn until<T: Send>(
    stop: &Stop,
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<Option<T>, Failure> {
    if threads == Some(0) {
        return Err(Failure::input("--threads 0: expected at least 1"));
    }
    let processors =
        std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let most = MOST_THREADS_A_PROCESSOR * processors;
    if let Some(asked) = threads.filter(|asked| *asked > most) {
        note(&format!(
            "--threads {asked}: {most} are used, \
             {MOST_THREADS_A_PROCESSOR} for each of {processors} processors"
        ));
    }
    let count = threads.unwrap_or(processors).min(most);
    match stop.run(count, work) {
        Ok(result) => Ok(Some(result)),
        Err(StopError::Stopped) => Ok(None),
        Err(error) => Err(Failure::input(format!("{count} {error}"))),
    }
}

/// A progress bar of `length` steps, shown on a terminal only.
#[must_use]
pub fn progress(length: u64) -> indicatif::ProgressBar {
    use std::io::IsTerminal as _;
    if io::stderr().is_terminal() {
        indicatif::ProgressBar::new(length)
    } else {
        indicatif::ProgressBar::hidden()
    }
}

/// Interval of progress in a log.
const LOG_INTERVAL: Duration = Duration::from_secs(30);

/// Does `work`, and where there is no terminal to draw `bar` on, says on
/// standard error every half a minute how far it is.
pub fn logged<T>(bar: &indicatif::ProgressBar, work: impl FnOnce() -> T) -> T {
    use std::io::IsTerminal as _;
    if io::stderr().is_terminal() {
        return work();
    }
    let say = || {
        let length = bar.length().unwrap_or(0);
        note(&format!("{} of {length} done", bar.position()));
    };
    saying([LOG_INTERVAL, LOG_INTERVAL], &say, work)
}

/// Time after which one long analysis says how far it is.
const PATIENCE: Duration = Duration::from_secs(2);

/// Interval at which it says so on a terminal.
const TERMINAL_INTERVAL: Duration = Duration::from_millis(200);

/// Does `work`, and from two seconds on says on standard error how far it
/// is: on a terminal in a line that changes, elsewhere every half a minute.
pub fn patiently<T>(
    words: &(dyn Fn() -> String + Sync),
    work: impl FnOnce() -> T,
) -> T {
    use std::io::IsTerminal as _;
    if !io::stderr().is_terminal() {
        let say = || note(&words());
        return saying([PATIENCE, LOG_INTERVAL], &say, work);
    }
    let line = indicatif::ProgressBar::new_spinner();
    let say = || line.set_message(words());
    let result = saying([PATIENCE, TERMINAL_INTERVAL], &say, work);
    line.finish_and_clear();
    result
}

/// Does `work`, and says something after a first time and then at intervals
/// until it is done. Where no thread can be started, nothing is said.
fn saying<T>(
    [first, interval]: [Duration; 2],
    say: &(dyn Fn() + Sync),
    work: impl FnOnce() -> T,
) -> T {
    std::thread::scope(|scope| {
        let (done, waits) = mpsc::channel::<()>();
        let says =
            std::thread::Builder::new().spawn_scoped(scope, move || {
                let mut wait = first;
                while let Err(mpsc::RecvTimeoutError::Timeout) =
                    waits.recv_timeout(wait)
                {
                    say();
                    wait = interval;
                }
            });
        let result = work();
        drop((done, says));
        result
    })
}

/// The same command, which reads `-1` behind an option as its value.
fn reading_negatives(command: clap::Command) -> clap::Command {
    let read = |arg: clap::Arg| {
        let takes_values = arg.get_action().takes_values();
        let reads = takes_values && !arg.is_allow_hyphen_values_set();
        if reads { arg.allow_negative_numbers(true) } else { arg }
    };
    command.mut_args(read).mut_subcommands(reading_negatives)
}

/// The same command, whose `--help` fits a screen: one paragraph an argument,
/// and no blank lines between them. The manual page has all.
fn on_a_screen(mut command: clap::Command) -> clap::Command {
    const TEMPLATE: &str = "{about-with-newline}\n{before-help}\
        {usage-heading} {usage}\n\n{all-args}{after-help}";
    let long = command.get_long_about().map(ToString::to_string);
    if let Some((_, rest)) = long.as_deref().and_then(|l| l.split_once("\n\n"))
    {
        command = command.before_help(rest.to_owned());
    }
    let help = Arg::new("help").short('h').long("help").help("Print help");
    command
        .help_template(TEMPLATE)
        .disable_help_flag(true)
        .disable_help_subcommand(true)
        .arg(help.action(ArgAction::HelpShort))
        .mut_subcommands(on_a_screen)
}

/// The same command, whose help lists the subcommands in [`GROUPS`].
fn grouped(command: clap::Command) -> clap::Command {
    let mut list = String::new();
    for (group, names) in GROUPS {
        list += &format!("{group}:\n");
        for name in names {
            let found = command.find_subcommand(name);
            let about = found.and_then(clap::Command::get_about);
            let about = about.map(ToString::to_string).unwrap_or_default();
            // The first clause.
            let about = about.split([':', ',', '.', '(']).next();
            let about = about.unwrap_or_default().trim_end();
            list += &format!("  {name:<13}{about}\n");
        }
        list += "\n";
    }
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{list}\
         Options:\n{{options}}\n\n`rocking man COMMAND` prints the manual \
         page of a command.\n"
    ))
}

/// Lets the program end with status 2 where it would abort: what aborts it is
/// an allocation that fails, after the runtime has said so.
fn abort_is_a_refusal() {
    let always = Arc::new(AtomicBool::new(true));
    // Where no handler can be set, the status is that of an abort.
    let _ = register_conditional_shutdown(SIGABRT, 2, always);
}

/// The whole command line.
fn command() -> clap::Command {
    reading_negatives(Cli::command())
}

/// Parses the arguments, runs the command and gives the exit status.
#[must_use]
pub fn run() -> ExitCode {
    abort_is_a_refusal();
    let matches = grouped(on_a_screen(command())).get_matches();
    let cli = Cli::from_arg_matches(&matches).unwrap_or_else(|e| e.exit());
    let outcome: Result<(), Failure> = match cli.command {
        Command::Accept(args) => {
            with_threads(None, || accept::run(&args)).flatten()
        }
        Command::Respond(args) => respond::run(&args),
        Command::Ida(args) => ida::run(&args),
        Command::Records(args) => records::run(&args),
        Command::Capacities(args) => capacities::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Completions(args) => completions::run(&args, command()),
        Command::Diff(args) => diff::run(&args),
        Command::Fragility(args) => fragility::run(&args),
        Command::Lilliefors(args) => lilliefors::run(&args),
        Command::Man(args) => man::run(&args, command()),
        Command::Rank(args) => rank::run(&args),
        Command::Risk(args) => risk::run(&args),
        Command::Sample(args) => sample::run(&args),
        Command::Speed(args) => {
            with_threads(None, || speed::run(&args)).flatten()
        }
        Command::Stripes(args) => stripes::run(&args),
        Command::Study(args) => study::run(&args),
        Command::Suite(args) => suite::run(&args),
        Command::Sweep(args) => sweep::run(&args),
        Command::Validate(args) => {
            with_threads(None, || validate::run(&args)).flatten()
        }
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            note(&failure.message);
            ExitCode::from(failure.status)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, GROUPS, command, mpsc, saying};

    #[test]
    fn every_command_is_in_one_group() {
        let mut listed: Vec<&str> =
            GROUPS.iter().flat_map(|(_, names)| *names).copied().collect();
        listed.sort_unstable();
        let command = command();
        let known = command.get_subcommands().map(clap::Command::get_name);
        let mut known: Vec<&str> = known.collect();
        known.sort_unstable();
        assert_eq!(listed, known);
    }

    #[test]
    fn long_work_says_so_until_it_is_done() {
        let (says, hears) = mpsc::channel();
        let say = || says.send(()).unwrap();
        let short = Duration::from_millis(1);
        let result = saying([short, short], &say, || {
            // It goes on until it has been spoken of twice.
            hears.recv().unwrap();
            hears.recv().unwrap();
            7
        });
        assert_eq!(result, 7);
        let long = Duration::from_secs(3600);
        saying([long, long], &|| panic!("nothing was long"), || ());
    }
}
