//! `rocking sweep design` and `fit`: the surrogate of `rocking fragility
//! --alpha --p`.

use std::collections::BTreeMap;
use std::path::PathBuf;

use serde::Serialize;

use crate::cli::Failure;
use crate::cli::show::show;
use rocking_common::files::Outputs;
use rocking_common::paper::SuiteKind;
use rocking_surrogate::{
    self as surrogate, Choice, Errors, Surrogate, SurrogateError,
};

/// Writes a table of blocks that fill the surrogate's range of p and alpha:
/// points of Halton's sequence in ln p and alpha.
#[derive(clap::Args)]
pub struct DesignArgs {
    /// Number of blocks.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1000,
        value_parser = clap::value_parser!(u64).range(1..=1_000_000)
    )]
    blocks: u64,
    /// Place of the first in the sequence, from 1.
    #[arg(
        long,
        value_name = "K",
        default_value_t = 1,
        value_parser = clap::value_parser!(u64).range(1..=1_000_000_000)
    )]
    first: u64,
    /// Where the table goes; `-` is standard output.
    #[arg(long, value_name = "FILE.csv", default_value = "-")]
    out: PathBuf,
}

/// Fits the surrogate to merged sweeps of both suites, and tells its error at
/// the blocks of other sweeps.
#[derive(clap::Args)]
pub struct FitArgs {
    /// Merged fragilities of the ordinary suite.
    #[arg(long, value_name = "FILE.csv")]
    ordinary: PathBuf,
    /// Merged fragilities of the pulse-type suite.
    #[arg(long, value_name = "FILE.csv")]
    pulse: PathBuf,
    /// The same of blocks that are not fitted to, ordinary suite.
    #[arg(long, value_name = "FILE.csv")]
    unseen_ordinary: PathBuf,
    /// The same of blocks that are not fitted to, pulse-type suite.
    #[arg(long, value_name = "FILE.csv")]
    unseen_pulse: PathBuf,
    /// Folder of design.csv, unseen.csv and coefficients.csv.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// The surfaces that were tried by leaving one block out, the one that was
/// taken, and its errors at blocks that it was not fitted to.
#[derive(Serialize)]
struct Found<'a> {
    choices: &'a [Choice],
    taken: Option<&'a Choice>,
    unseen: BTreeMap<SuiteKind, Errors>,
}

pub(super) fn design(args: &DesignArgs) -> Result<(), Failure> {
    let out = Outputs::default().open(&args.out)?;
    Ok(out.write(surrogate::design(args.first, args.blocks))?)
}

pub(super) fn fit(args: &FitArgs) -> Result<(), Failure> {
    let read = |ordinary, pulse| -> Result<_, SurrogateError> {
        let (a, b) = (SuiteKind::Ordinary, SuiteKind::PulseType);
        let mut blocks = surrogate::read_merged(a, ordinary)?;
        blocks.extend(surrogate::read_merged(b, pulse)?);
        // What is kept is what is fitted.
        let text = surrogate::table(&blocks);
        let kept = surrogate::read_table("blocks", &text)?;
        Ok((kept, text))
    };
    std::fs::create_dir_all(&args.out)?;
    let inputs = [
        &args.ordinary,
        &args.pulse,
        &args.unseen_ordinary,
        &args.unseen_pulse,
    ];
    let mut outputs = Outputs::of(inputs.map(PathBuf::clone).to_vec());
    let mut open = |name| outputs.open(&args.out.join(name));
    let files =
        [open("design.csv")?, open("unseen.csv")?, open("coefficients.csv")?];
    let (blocks, design) = read(&args.ordinary, &args.pulse)?;
    let (_, unseen) = read(&args.unseen_ordinary, &args.unseen_pulse)?;
    let (models, choices) = surrogate::fit(&blocks)?;
    let coefficients = Surrogate::coefficients(&models);
    let made = Surrogate::parse(&coefficients, &unseen)?;
    let own = models.first().map(|model| &model.terms);
    let taken = |choice: &&Choice| Some(&choice.degrees.terms()) == own;
    let found = Found {
        taken: choices.iter().find(taken),
        unseen: made.models.iter().map(|(m, e)| (m.suite, *e)).collect(),
        choices: &choices,
    };
    for (file, content) in
        files.into_iter().zip([design, unseen, coefficients])
    {
        file.write(content)?;
    }
    show(false, &found)
}
