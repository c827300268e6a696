//! `rocking completions`: what a shell needs to complete commands and flags.

use clap::{Args as ClapArgs, Command};
use clap_complete::{Shell, generate};

use crate::failure::Failure;
use crate::terminal::print;

/// Completions of commands and flags for a shell, on standard output.
#[derive(ClapArgs)]
#[command(after_help = "Examples:\n  \
    rocking completions bash > ~/.local/share/bash-completion/completions/rocking\n  \
    rocking completions zsh > ~/.zfunc/_rocking\n  \
    rocking completions fish > ~/.config/fish/completions/rocking.fish")]
pub struct Args {
    /// The shell.
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] when standard output cannot be written.
pub fn run(args: &Args, mut command: Command) -> Result<(), Failure> {
    let mut text = Vec::new();
    generate(args.shell, &mut command, "rocking", &mut text);
    print(&String::from_utf8_lossy(&text))
}
