//! `rocking lilliefors`: the test of normality, and its critical values.

use std::path::{Path, PathBuf};

use clap::ArgGroup;
use rocking_procedures::{NormalityOptions, Shift, test_normality};
use rocking_statistics::lilliefors::{
    CriticalValue, LillieforsTable, NullDistribution,
};
use serde::Serialize;

use super::shared::{JsonArg, ThreadsArg};
use crate::failure::{Failure, bail};
use crate::input;
use crate::terminal::progress;
use rocking_common::files::Outputs;
use rocking_common::table::Table as Csv;
use rocking_exchange::sample::SampleFile;

/// Largest size of a simulated sample: each thread has one in memory.
const MOST_VALUES: i64 = 10_000_000;
/// Replicates by default.
const REPLICATES: u64 = 1_000_000;

/// Lilliefors' test of normality on a sample, or its critical values.
///
/// The p-value comes from the project's own Monte Carlo table, whose sizes end
/// at n = 1000 (`scaled table` above) and whose levels end at 0.99 and 0.0001
/// (`extrapolated` beyond), or from a direct simulation if --replicates is
/// given. The p-values of Anderson-Darling, Cramer-von Mises and Shapiro-Wilk
/// are then simulated, too; otherwise they come from published approximations.
/// There is no verdict if the test does not apply: censored values, values not
/// above the shift, values that do not vary, fewer than 4 values, fewer than
/// 80 % distinct ones.
#[derive(clap::Args)]
#[command(group = ArgGroup::new("mode").required(true)
    .args(["sample", "critical_values", "write_table"]))]
pub struct LillieforsCommand {
    /// Sample file: one value per line, `#` comments.
    #[arg(long, value_name = "FILE")]
    sample: Option<PathBuf>,
    /// Test the logarithms of the values.
    #[arg(long, conflicts_with_all = ["critical_values", "write_table"])]
    log: bool,
    /// Test the logarithms of the values minus this shift (implies --log).
    /// `min` uses the smallest value as the shift and leaves it out of the
    /// sample; the null distribution is simulated in the same way.
    #[arg(
        long,
        value_name = "X|min",
        conflicts_with_all = ["critical_values", "write_table"],
        allow_hyphen_values = true
    )]
    shift: Option<Shift>,
    /// Simulate the critical value of one size and level.
    #[arg(long, requires = "n")]
    critical_values: bool,
    /// Size of the samples.
    #[arg(
        long,
        conflicts_with_all = ["sample", "write_table"],
        value_parser = clap::value_parser!(u32).range(1..=MOST_VALUES),
    )]
    n: Option<u32>,
    /// Level of the test.
    #[arg(long, default_value_t = 0.05, conflicts_with = "write_table")]
    level: f64,
    /// Simulate this many samples (default: the table for a sample,
    /// 1000000 for critical values).
    #[arg(long, value_name = "N", conflicts_with = "write_table")]
    replicates: Option<u64>,
    /// Seed of the simulation.
    #[arg(long, value_name = "S", conflicts_with = "write_table")]
    seed: Option<u64>,
    #[command(flatten)]
    threads: ThreadsArg,
    /// Simulate the committed table again and write it to this file.
    #[arg(long, value_name = "FILE", conflicts_with = "json")]
    write_table: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking lilliefors`.
///
/// # Errors
/// [`Failure`] for input that is refused; a test that does not apply is a
/// result.
pub fn run_lilliefors(args: &LillieforsCommand) -> Result<(), Failure> {
    args.threads.run(|| {
        if let Some(path) = &args.write_table {
            write_table(path)
        } else if let Some(path) = &args.sample {
            test(args, &input::sample(path)?)
        } else {
            critical_value(args, args.n.unwrap_or(0) as usize)
        }
    })?
}

/// A simulated critical value.
#[derive(Serialize)]
struct Critical {
    n: usize,
    level: f64,
    replicates: u64,
    seed: u64,
    critical_value: CriticalValue,
}

fn critical_value(args: &LillieforsCommand, n: usize) -> Result<(), Failure> {
    let replicates = args.replicates.unwrap_or(REPLICATES);
    let (seed, level) = (args.seed.unwrap_or(0), args.level);
    let null = NullDistribution::simulate(n, replicates, seed)?;
    let critical_value = null.critical_value(level)?;
    let found = Critical { n, level, replicates, seed, critical_value };
    let sentence = "The critical value of samples of {n} values at level \
                    {level} is {critical_value}.";
    args.json.show(&[sentence], &found)
}

fn test(args: &LillieforsCommand, file: &SampleFile) -> Result<(), Failure> {
    let options = NormalityOptions {
        log_above: args.shift.or(args.log.then_some(Shift::Given(0.0))),
        level: args.level,
        replicates: args.replicates,
        seed: args.seed.unwrap_or(0),
    };
    input::records_as_unit(file);
    let found = test_normality(&file.censored()?, &options)?;
    let is_tabled = found.method.is_some() && found.replicates.is_none();
    if is_tabled && (args.seed.is_some() || args.threads.threads.is_some()) {
        bail!(
            "--seed and --threads are not used without --replicates: the \
             p-value is from the table"
        );
    }
    let sentences = [
        "Normality is {verdict} at level {level}: p = {p_value}.",
        "The test does not apply: {reason}.",
    ];
    args.json.show(&sentences, &found)
}

/// Simulates every size of `crates/statistics/src/lilliefors/table.csv` and writes it:
/// 3.4e8 samples, some minutes of one core.
///
/// # Errors
/// [`Failure`] if the file cannot be written.
fn write_table(path: &Path) -> Result<(), Failure> {
    let out = Outputs::default().open(path)?;
    let sizes = LillieforsTable::sizes();
    let progress = progress(sizes.len() as u64);
    let mut csv =
        Csv::headed("n,replicates,level,critical_value,standard_error");
    for (n, replicates) in sizes {
        let null = NullDistribution::simulate(n, replicates, 0)?;
        for level in LillieforsTable::LEVELS {
            let critical = null.critical_value(level)?;
            csv.row([
                n.to_string(),
                replicates.to_string(),
                level.to_string(),
                format!("{:.8}", critical.estimate.value()),
                format!("{:.1e}", critical.standard_error),
            ]);
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    Ok(out.write(csv.finish())?)
}
