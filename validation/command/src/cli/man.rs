//! `rocking man`: manual pages.

use clap_mangen::Man;

use super::command;
use crate::failure::{Failure, bail};
use crate::terminal::print;

/// The manual page of the program, or of one of its commands, on standard
/// output.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking man > ~/.local/share/man/man1/rocking.1\n  \
    rocking man fragility | man -l -")]
pub struct ManCommand {
    /// A command, such as `ida`.
    #[arg(value_name = "COMMAND")]
    of: Option<String>,
}

/// Runs `rocking man`.
///
/// # Errors
/// [`Failure`] for a command that there is not, and when standard output
/// cannot be written.
pub fn run_man(args: &ManCommand) -> Result<(), Failure> {
    let mut command = command();
    // Names every command in full, as `rocking-ida`.
    command.build();
    if let Some(name) = &args.of {
        let Some(found) = command.find_subcommand(name).cloned() else {
            bail!(
                "man {name}: expected a command that `rocking --help` names"
            );
        };
        command = found;
    }
    let mut page = Vec::new();
    Man::new(command).render(&mut page)?;
    print(&String::from_utf8_lossy(&page))
}
