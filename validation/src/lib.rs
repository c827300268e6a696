//! The command `rocking`: one file a command, and the sweeps that only
//! commands make.

pub mod cli;
pub mod sweep;
