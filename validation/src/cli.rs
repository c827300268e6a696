//! The command line: one file a command, all of them `Args -> Result<(), Failure>`.

mod accept;
mod validate;

use std::io::{self, Write as _};
use std::num::NonZeroUsize;
use std::process::ExitCode;
use std::sync::mpsc;
use std::time::Duration;

use clap::{CommandFactory as _, FromArgMatches as _, Parser, Subcommand};

pub mod boxplot;
pub mod capacities;
pub mod compare;
pub mod completions;
pub mod diff;
pub mod excitation;
pub mod fragility;
pub mod ida;
pub mod lilliefors;
mod limit;
pub mod man;
pub mod measure;
mod names;
pub mod processing;
pub mod quantile;
pub mod rank;
pub mod reading;
pub mod records;
pub mod respond;
pub mod risk;
pub mod samples;
pub mod scene;
pub mod speed;
pub mod stripes;
pub mod study;
pub mod suite;
pub mod sweep;
pub mod table;
pub mod way;

/// Threads beyond which more only cost.
const MOST_THREADS_A_PROCESSOR: usize = 8;

/// Rocking of free-standing blocks under earthquakes, and its statistics.
#[derive(Parser)]
#[command(name = "rocking", version, max_term_width = 100)]
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
    Boxplot(boxplot::Args),
    Capacities(capacities::Args),
    Compare(compare::Args),
    Completions(completions::Args),
    Diff(diff::Args),
    Fragility(fragility::Args),
    Lilliefors(lilliefors::Args),
    Man(man::Args),
    Quantile(quantile::Args),
    Rank(Box<rank::Args>),
    Risk(risk::Args),
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

impl<E: std::error::Error> From<E> for Failure {
    fn from(error: E) -> Self {
        let mut message = error.to_string();
        let mut source = error.source();
        while let Some(inner) = source {
            let text = inner.to_string();
            if !message.contains(&text) {
                message = format!("{message}: {text}");
            }
            source = inner.source();
        }
        Self::input(message)
    }
}

/// Name and version of the program, for results.
pub const SOFTWARE: &str = concat!("rocking ", env!("CARGO_PKG_VERSION"));

/// Prints `text` on standard output; a closed pipe ends the program quietly.
///
/// # Errors
/// [`Failure`] when standard output cannot be written for another reason.
pub fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(e) if e.kind() == io::ErrorKind::BrokenPipe => {
            std::process::exit(0)
        }
        done => {
            done.map_err(|e| Failure::input(format!("standard output: {e}")))
        }
    }
}

/// Prints `value` as JSON, with the version of the program.
///
/// # Errors
/// As [`print()`].
pub fn print_json(mut value: serde_json::Value) -> Result<(), Failure> {
    if let Some(object) = value.as_object_mut() {
        object.insert("version".into(), env!("CARGO_PKG_VERSION").into());
    }
    print(&format!("{value:#}\n"))
}

/// Runs `work` on `threads` threads, or on as many as the machine has; more
/// than eight times as many are not used, and that is said.
///
/// # Errors
/// [`Failure`] for zero threads, or threads that cannot be started.
pub fn with_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> T + Send,
) -> Result<T, Failure> {
    if threads == Some(0) {
        return Err(Failure::input("--threads 0: expected at least 1"));
    }
    let processors =
        std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
    let most = MOST_THREADS_A_PROCESSOR * processors;
    if let Some(asked) = threads.filter(|asked| *asked > most) {
        eprintln!(
            "rocking: --threads {asked}: {most} are used, \
             {MOST_THREADS_A_PROCESSOR} for each of {processors} processors"
        );
    }
    let count = threads.unwrap_or(processors).min(most);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
    let pool = pool.map_err(|error| {
        Failure::input(format!("{count} threads cannot be started: {error}"))
    })?;
    Ok(pool.install(work))
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
        eprintln!("rocking: {} of {length} done", bar.position());
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
        let say = || eprintln!("rocking: {}", words());
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

/// The whole command line.
fn command() -> clap::Command {
    reading_negatives(Cli::command())
}

/// Parses the arguments, runs the command and gives the exit status.
#[must_use]
pub fn run() -> ExitCode {
    let matches = command().get_matches();
    let cli = Cli::from_arg_matches(&matches).unwrap_or_else(|e| e.exit());
    let outcome: Result<(), Failure> = match cli.command {
        Command::Accept(args) => accept::run(&args),
        Command::Respond(args) => respond::run(&args),
        Command::Ida(args) => ida::run(&args),
        Command::Records(args) => records::run(&args),
        Command::Boxplot(args) => boxplot::run(&args),
        Command::Capacities(args) => capacities::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Completions(args) => completions::run(&args, command()),
        Command::Diff(args) => diff::run(&args),
        Command::Fragility(args) => fragility::run(&args),
        Command::Lilliefors(args) => lilliefors::run(&args),
        Command::Man(args) => man::run(&args, command()),
        Command::Quantile(args) => quantile::run(&args),
        Command::Rank(args) => rank::run(&args),
        Command::Risk(args) => risk::run(&args),
        Command::Speed(args) => speed::run(&args),
        Command::Stripes(args) => stripes::run(&args),
        Command::Study(args) => study::run(&args),
        Command::Suite(args) => suite::run(&args),
        Command::Sweep(args) => sweep::run(&args),
        Command::Validate(args) => validate::run(&args),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("rocking: {}", failure.message);
            ExitCode::from(failure.status)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Duration, mpsc, saying};

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
