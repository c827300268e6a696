//! The command line `rocking`.

use std::process::ExitCode;

fn main() -> ExitCode {
    rocking_cli::cli::run()
}
