//! Flags that show that results don't depend on how they are computed.

use clap::ValueEnum;
use rocking::number::dispatch::Isa;

use crate::failure::{Failure, bail};
use rocking_common::curves::Execution;

/// How curves are made; results are the same bits.
#[derive(Clone, Debug, clap::Args)]
pub struct WayArgs {
    /// Instruction set of the lanes.
    #[arg(long, value_parser = ["avx512", "avx2", "baseline"], hide = true)]
    isa: Option<String>,
    /// Chains in lanes, or one analysis at a time.
    #[arg(long, value_enum, hide = true)]
    engine: Option<EngineName>,
}

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
    pub fn way(&self) -> Result<Execution, Failure> {
        match (self.engine, &self.isa) {
            (Some(EngineName::Scalar), None) => Ok(Execution::OneByOne),
            (Some(EngineName::Scalar), Some(_)) => {
                bail!("--isa is for --engine lanes, not for scalar")
            }
            (_, None) => Ok(Execution::default()),
            (_, Some(level)) => {
                let all = Isa::available();
                let own = all.iter().find(|isa| isa.name() == *level);
                own.map(|isa| Execution::Lanes(*isa)).ok_or_else(|| {
                    let names: Vec<&str> =
                        all.iter().map(|isa| isa.name()).collect();
                    Failure::input(format!(
                        "--isa {level}: not on this machine, expected one of \
                         {}",
                        names.join(", ")
                    ))
                })
            }
        }
    }
}
