//! Flags that many commands share: each is declared here, once.

use std::path::PathBuf;

use rocking_common::files::{Output, Outputs};
use rocking_procedures::Draws;
use rocking_procedures::model_error::{ModelError, ModelErrorPart};
use serde::Serialize;

use super::show::{json, text};
use crate::failure::Failure;
use crate::terminal::{print, print_beside, say};
use crate::threads::with_threads;

/// The value of a flag that is positive and finite.
///
/// # Errors
/// The expectation, for any other text.
pub fn positive(text: &str) -> Result<f64, &'static str> {
    let number = text.trim().parse().ok().filter(|x: &f64| x.is_finite());
    number.filter(|x| *x > 0.0).ok_or("expected a positive number")
}

/// How a result is shown.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct JsonArg {
    /// Print JSON.
    #[arg(long)]
    pub json: bool,
}

impl JsonArg {
    /// Prints a result: as JSON, or as [`text`].
    ///
    /// # Errors
    /// As [`json`], [`text`] and [`print()`].
    pub fn show<T: Serialize>(
        self,
        sentences: &[&str],
        result: &T,
    ) -> Result<(), Failure> {
        let json = self.json.then(|| json(result));
        print(&json.unwrap_or_else(|| text(sentences, result))?)
    }

    /// Prints a result, unless an output takes standard output.
    ///
    /// # Errors
    /// As [`JsonArg::show`].
    pub fn show_beside<T: Serialize>(
        self,
        outputs: &Outputs,
        sentences: &[&str],
        result: &T,
    ) -> Result<(), Failure> {
        match outputs.take_standard_output() {
            true => Ok(()),
            false => self.show(sentences, result),
        }
    }

    /// Prints a summary beside files: as text on standard error, if an output
    /// takes standard output.
    ///
    /// # Errors
    /// As [`JsonArg::show`].
    pub fn summarise<T: Serialize>(
        self,
        outputs: &Outputs,
        sentences: &[&str],
        result: &T,
    ) -> Result<(), Failure> {
        match self.json && !outputs.take_standard_output() {
            true => say(&json(result)?),
            false => print_beside(outputs, &text(sentences, result)?),
        }
    }
}

/// A drawing of the result; a command says by `mut_arg` what is drawn.
#[derive(clap::Args, Clone, Debug)]
pub struct PlotArg {
    /// Draw the result.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
}

impl PlotArg {
    /// Opens the file, if one is given.
    ///
    /// # Errors
    /// As [`Outputs::open`].
    pub fn open(
        &self,
        outputs: &mut Outputs,
    ) -> Result<Option<Output>, Failure> {
        Ok(outputs.open_some(self.plot.as_ref())?)
    }
}

/// On how many threads a command works.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct ThreadsArg {
    /// Threads; the result does not depend on them [default: all].
    #[arg(long, value_name = "N")]
    pub threads: Option<usize>,
}

impl ThreadsArg {
    /// Does `work` on these threads.
    ///
    /// # Errors
    /// As [`with_threads`].
    pub fn run<T: Send>(
        self,
        work: impl FnOnce() -> T + Send,
    ) -> Result<T, Failure> {
        with_threads(self.threads, work)
    }
}

/// The bootstrap of a command that always takes one.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct BootstrapArgs {
    /// Number of bootstrap draws.
    #[arg(long, value_name = "N", default_value_t = 1000)]
    bootstrap: usize,
    /// Seed of the bootstrap.
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
}

impl BootstrapArgs {
    /// The draws.
    pub fn draws(self) -> Draws {
        Draws { replicates: self.bootstrap, seed: self.seed }
    }
}

/// The error of the model.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct ModelErrorArgs {
    /// Dispersion of the model, S or S,LOW,HIGH [default: 0.2,0,0.25].
    #[arg(long, value_name = "S", value_parser = ModelError::parse_dispersion)]
    model_dispersion: Option<ModelErrorPart>,
    /// Bias, B[,LOW,HIGH] or `fitted` [default: 1,0.77,1.3; assess fitted].
    #[arg(long, value_name = "B", value_parser = ModelError::parse_bias)]
    model_bias: Option<ModelErrorPart>,
}

impl ModelErrorArgs {
    /// The error; `usual` without a flag.
    pub fn or(self, usual: ModelError) -> ModelError {
        usual.or(self.model_bias, self.model_dispersion)
    }
}
