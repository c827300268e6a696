//! Flags that show that results don't depend on how they are computed.

use clap::ValueEnum;
use rocking::number::dispatch::Isa;

use super::names::named;
use crate::failure::{Failure, bail};
use rocking_common::curves::Execution;

/// How curves are made; results are the same bits.
#[derive(Clone, Copy, Debug, clap::Args)]
pub struct WayArgs {
    /// Instruction set of the lanes.
    #[arg(
        long,
        value_parser = named(LEVELS, |level| level, [""; 3]),
        hide = true
    )]
    isa: Option<&'static str>,
    /// Chains in lanes, or one analysis at a time.
    #[arg(long, value_enum, hide = true)]
    engine: Option<EngineName>,
}

const LEVELS: [&str; 3] = ["avx512", "avx2", "baseline"];

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum EngineName {
    Lanes,
    Scalar,
}

impl WayArgs {
    /// The execution of these flags.
    ///
    /// # Errors
    /// [`Failure`] for an instruction set that this machine has not, or one
    /// for an engine that doesn't take it.
    pub fn way(self) -> Result<Execution, Failure> {
        match (self.engine, self.isa) {
            (Some(EngineName::Scalar), None) => Ok(Execution::OneByOne),
            (Some(EngineName::Scalar), Some(_)) => {
                bail!("--isa is for --engine lanes, not for scalar")
            }
            (_, None) => Ok(Execution::default()),
            (_, Some(level)) => isa(level).map(Execution::Lanes),
        }
    }
}

fn isa(name: &str) -> Result<Isa, Failure> {
    let available = Isa::available();
    if let Some(isa) = available.iter().find(|isa| isa.name() == name) {
        return Ok(*isa);
    }
    let names: Vec<&str> = available.iter().map(|i| i.name()).collect();
    let names = names.join(", ");
    bail!("--isa {name}: not on this machine, expected one of {names}")
}
