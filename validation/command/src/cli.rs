//! The command line: each command is a file here and a row of `entries`.

use std::process::ExitCode;

use clap::{Arg, ArgAction, ArgMatches, Args, Command};

use crate::failure::Failure;
use crate::terminal::{SOFTWARE, note};
use crate::threads::with_threads;

pub mod assess;
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
mod validate;
mod verify;
pub mod way;

/// The work of a command with the flags that were parsed.
type CommandWork = dyn Fn(&ArgMatches) -> Result<(), Failure>;

/// A command: what it is for, its name, its flags, and its work.
struct CommandEntry {
    group: &'static str,
    name: &'static str,
    with_flags: fn(Command) -> Command,
    run: Box<CommandWork>,
}

fn entry<C: Args + 'static>(
    group: &'static str,
    name: &'static str,
    run: fn(&C) -> Result<(), Failure>,
) -> CommandEntry {
    let run = move |matches: &ArgMatches| {
        run(&C::from_arg_matches(matches).unwrap_or_else(|e| e.exit()))
    };
    CommandEntry {
        group,
        name,
        with_flags: C::augment_args,
        run: Box::new(run),
    }
}

/// The commands, as `rocking --help` lists them.
fn entries() -> Vec<CommandEntry> {
    vec![
        entry("Analyse", "respond", respond::run_respond),
        entry("Analyse", "ida", ida::run_ida),
        entry("Analyse", "records", |args| {
            with_threads(None, || records::run_records(args)).flatten()
        }),
        entry("Analyse", "suite", suite::run_suite),
        entry("Analyse", "capacities", capacities::run_capacities),
        entry("Analyse", "sweep", sweep::run_sweep),
        entry("Decide", "assess", assess::run_assess),
        entry("Decide", "stripes", stripes::run_stripes),
        entry("Decide", "fragility", fragility::run_fragility),
        entry("Decide", "risk", risk::run_risk),
        entry("Decide", "rank", rank::run_rank),
        entry("Decide", "sample", sample::run_sample),
        entry("Decide", "compare", compare::run_compare),
        entry("Decide", "contrast", contrast::run_contrast),
        entry("Decide", "lilliefors", lilliefors::run_lilliefors),
        entry("Prove", "study", study::run_study),
        entry("Prove", "verify", |args| {
            with_threads(None, || verify::run_verify(args)).flatten()
        }),
        entry("Prove", "validate", validate::run_validate),
        entry("Prove", "score", score::run_score),
        entry("Prove", "diff", diff::run_diff),
        entry("Prove", "speed", |args| {
            with_threads(None, || speed::run_speed(args)).flatten()
        }),
        entry("Develop", "completions", completions::run_completions),
        entry("Develop", "man", man::run_man),
    ]
}

/// The same command, which reads `-1` behind an option as its value, and the
/// names of choices in upper or lower case.
fn reading_values(command: Command) -> Command {
    let read = |arg: Arg| {
        let takes_values = arg.get_action().takes_values();
        let reads = takes_values && !arg.is_allow_hyphen_values_set();
        let arg = arg.ignore_case(takes_values);
        if reads { arg.allow_negative_numbers(true) } else { arg }
    };
    command.mut_args(read).mut_subcommands(reading_values)
}

/// The same command, whose `--help` fits a screen: one paragraph an argument,
/// and no blank lines between them. The manual page has all.
fn on_a_screen(mut command: Command) -> Command {
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

/// The same command, whose help lists the subcommands by [`CommandEntry::group`].
fn grouped(command: Command) -> Command {
    let (mut list, mut before) = (String::new(), "");
    for CommandEntry { group, name, .. } in entries() {
        if group != before {
            let gap = if before.is_empty() { "" } else { "\n" };
            list += &format!("{gap}{group}:\n");
        }
        before = group;
        let found = command.find_subcommand(name);
        let about = found.and_then(Command::get_about);
        let about = about.map(ToString::to_string).unwrap_or_default();
        // The first clause.
        let about = about.split([':', ',', '.', '(']).next();
        let about = about.unwrap_or_default().trim_end();
        list += &format!("  {name:<13}{about}\n");
    }
    command.help_template(format!(
        "{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{list}\n\
         Options:\n{{options}}\n\n`rocking man COMMAND` prints the manual \
         page of a command.\n"
    ))
}

/// The whole command line.
fn command() -> Command {
    let commands = entries().into_iter();
    let commands = commands.map(|e| (e.with_flags)(Command::new(e.name)));
    reading_values(
        Command::new("rocking")
            // Printed behind the name.
            .version(SOFTWARE.strip_prefix("rocking ").unwrap_or(SOFTWARE))
            .about(
                "Rocking of free-standing blocks under earthquakes, and its \
                 statistics",
            )
            .max_term_width(100)
            .disable_help_subcommand(true)
            .subcommand_required(true)
            .arg_required_else_help(true)
            .subcommands(commands),
    )
}

/// Parses the arguments, runs the command and gives the exit status.
pub fn run() -> ExitCode {
    let matches = grouped(on_a_screen(command())).get_matches();
    let chosen = matches.subcommand().and_then(|(name, matches)| {
        let entry = entries().into_iter().find(|entry| entry.name == name)?;
        Some((entry.run)(matches))
    });
    match chosen.unwrap_or(Ok(())) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            note(&failure.message);
            ExitCode::from(failure.status)
        }
    }
}
