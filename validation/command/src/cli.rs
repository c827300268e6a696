//! The command line: one file a command, all of them `Args -> Result<(), Failure>`.

pub mod assess;
mod validate;

use std::process::ExitCode;

use clap::{
    Arg, ArgAction, CommandFactory as _, FromArgMatches as _, Parser,
    Subcommand,
};

use crate::failure::Failure;
use crate::terminal::{SOFTWARE, note};
use crate::threads::with_threads;

pub mod blocks;
pub mod capacities;
pub mod compare;
pub mod completions;
pub mod contrast;
pub mod diff;
pub mod excitation;
pub mod floors;
pub mod fragility;
pub mod ida;
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
pub mod score;
mod shared;
pub mod show;
pub mod speed;
pub mod stripes;
pub mod study;
pub mod suite;
pub mod sweep;
pub mod way;

/// The commands by what they are for, as `rocking --help` lists them.
const GROUPS: [(&str, &[&str]); 4] = [
    (
        "Analyse",
        &["respond", "ida", "records", "suite", "capacities", "sweep"],
    ),
    (
        "Decide",
        &[
            "assess",
            "stripes",
            "fragility",
            "risk",
            "rank",
            "sample",
            "compare",
            "contrast",
            "lilliefors",
        ],
    ),
    ("Prove", &["study", "validate", "score", "diff", "speed"]),
    ("Develop", &["completions", "man"]),
];

/// Rocking of free-standing blocks under earthquakes, and its statistics.
#[derive(Parser)]
#[command(name = "rocking", version = version(), max_term_width = 100)]
#[command(disable_help_subcommand = true)]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

/// What `--version` prints behind the name.
fn version() -> &'static str {
    SOFTWARE.strip_prefix("rocking ").unwrap_or(SOFTWARE)
}

#[derive(Subcommand)]
enum Command {
    Assess(Box<assess::Args>),
    Respond(Box<respond::Args>),
    Ida(Box<ida::Args>),
    Records(records::Args),
    Capacities(capacities::Args),
    Compare(compare::Args),
    Completions(completions::Args),
    Contrast(contrast::Args),
    Diff(diff::Args),
    Fragility(fragility::Args),
    Lilliefors(lilliefors::Args),
    Man(man::Args),
    Rank(Box<rank::Args>),
    Risk(risk::Args),
    Sample(sample::Args),
    Score(score::Args),
    Speed(speed::Args),
    Stripes(stripes::Args),
    Study(study::Args),
    Suite(suite::Args),
    Sweep(sweep::Args),
    /// Runs the declared cases and writes or checks their results.
    Validate(validate::Args),
}

/// The same command, which reads `-1` behind an option as its value, and the
/// names of choices in upper or lower case.
fn reading_values(command: clap::Command) -> clap::Command {
    let read = |arg: clap::Arg| {
        let takes_values = arg.get_action().takes_values();
        let reads = takes_values && !arg.is_allow_hyphen_values_set();
        let arg = arg.ignore_case(takes_values);
        if reads { arg.allow_negative_numbers(true) } else { arg }
    };
    command.mut_args(read).mut_subcommands(reading_values)
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

/// The whole command line.
fn command() -> clap::Command {
    reading_values(Cli::command())
}

/// Parses the arguments, runs the command and gives the exit status.
#[must_use]
pub fn run() -> ExitCode {
    let matches = grouped(on_a_screen(command())).get_matches();
    let cli = Cli::from_arg_matches(&matches).unwrap_or_else(|e| e.exit());
    let outcome: Result<(), Failure> = match cli.command {
        Command::Assess(args) => assess::run(&args),
        Command::Respond(args) => respond::run(&args),
        Command::Ida(args) => ida::run(&args),
        Command::Records(args) => {
            with_threads(None, || records::run(&args)).flatten()
        }
        Command::Capacities(args) => capacities::run(&args),
        Command::Compare(args) => compare::run(&args),
        Command::Completions(args) => completions::run(&args, command()),
        Command::Contrast(args) => contrast::run(&args),
        Command::Diff(args) => diff::run(&args),
        Command::Fragility(args) => fragility::run(&args),
        Command::Lilliefors(args) => lilliefors::run(&args),
        Command::Man(args) => man::run(&args, command()),
        Command::Rank(args) => rank::run(&args),
        Command::Risk(args) => risk::run(&args),
        Command::Sample(args) => sample::run(&args),
        Command::Score(args) => score::run(&args),
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
    use super::{GROUPS, command};

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
}
