//! `rocking completions`: what a shell needs to complete commands and flags.

use clap_complete::{Shell, generate};

use super::command;
use crate::failure::Failure;
use crate::terminal::print;

/// Completions of commands and flags for a shell, on standard output.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking completions bash > ~/.local/share/bash-completion/completions/rocking\n  \
    rocking completions zsh > ~/.zfunc/_rocking\n  \
    rocking completions fish > ~/.config/fish/completions/rocking.fish")]
pub struct CompletionsCommand {
    /// The shell.
    #[arg(value_name = "SHELL")]
    shell: Shell,
}

/// Runs `rocking completions`.
///
/// # Errors
/// [`Failure`] when standard output cannot be written.
pub fn run_completions(args: &CompletionsCommand) -> Result<(), Failure> {
    let mut text = Vec::new();
    generate(args.shell, &mut command(), "rocking", &mut text);
    print(&String::from_utf8_lossy(&text))
}
