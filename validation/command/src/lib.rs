//! The command `rocking`: one file a command, and the sweeps that only
//! commands make.

pub mod cli;
pub mod failure;
pub mod input;
pub mod sweep;
pub mod terminal;
pub mod threads;
