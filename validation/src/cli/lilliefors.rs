//! `rocking lilliefors`: the test of normality, and its critical values.

mod table;

use std::path::PathBuf;

use clap::{ArgGroup, Args as ClapArgs};
use rocking::statistics::lilliefors::{
    Assessment, Inapplicable, LillieforsError, Null, NullDistribution, Scale,
    ShiftedNull, Table, Verdict,
};
use rocking::statistics::lognormal::{FitMethod, fit};
use rocking::statistics::normality::{
    Test, anderson_darling, cramer_von_mises, shapiro_wilk,
};
use rocking::statistics::{ExtendedSample, Sample};
use serde_json::{Value, json};

use super::samples::{SampleFile, Shift};
use super::{Failure, print, with_threads};
use crate::json;

/// Replicates where none are asked for.
const REPLICATES: u64 = 1_000_000;
/// The same for sizes beyond the table.
const REPLICATES_BEYOND: u64 = 100_000;

/// Lilliefors' test of normality on a sample, or its critical values.
///
/// The p-value comes from the project's own Monte Carlo table (n = 4 to
/// 1000), or from a direct simulation when --replicates is given or n is
/// larger. A verdict is refused where the test does not apply: censored
/// values, values not above the shift, values that do not vary, fewer than
/// 4 values, fewer than 80 % distinct ones.
#[derive(ClapArgs)]
#[command(group = ArgGroup::new("mode").required(true)
    .args(["sample", "critical_values", "write_table"]))]
pub struct Args {
    /// Sample file: one value a line, `#` comments.
    #[arg(long, value_name = "FILE")]
    sample: Option<PathBuf>,
    /// Test the logarithms of the values.
    #[arg(long, conflicts_with_all = ["critical_values", "write_table"])]
    log: bool,
    /// Test the logarithms of the values above this shift (implies --log).
    /// `min` takes the smallest value and leaves it out; the null is then
    /// simulated with the smallest value taken from every draw.
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
    #[arg(long, conflicts_with_all = ["sample", "write_table"])]
    n: Option<usize>,
    /// Level of the test.
    #[arg(
        long,
        default_value_t = 0.05,
        conflicts_with = "write_table",
        allow_negative_numbers = true
    )]
    level: f64,
    /// Simulate this many samples (default: the table for a sample,
    /// 1000000 for critical values).
    #[arg(long, value_name = "N", conflicts_with = "write_table")]
    replicates: Option<u64>,
    /// Repetition of the simulation.
    #[arg(long, value_name = "S", conflicts_with = "write_table")]
    seed: Option<u64>,
    /// Threads of a simulation; the result doesn't depend on them [default:
    /// as many as the machine has].
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Simulate the committed table anew and write it to this file.
    #[arg(long, value_name = "FILE")]
    write_table: Option<PathBuf>,
    /// Print JSON.
    #[arg(long, conflicts_with = "write_table")]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for input that is refused; a test that does not apply is a
/// result.
pub fn run(args: &Args) -> Result<(), Failure> {
    if !(args.level > 0.0 && args.level < 1.0) {
        return Err(Failure::input(format!(
            "--level {}: expected a number between 0 and 1",
            args.level
        )));
    }
    let simulates = args.sample.is_none()
        || args.replicates.is_some()
        || args.shift == Some(Shift::Min);
    if !simulates && (args.seed.is_some() || args.threads.is_some()) {
        return Err(Failure::input(
            "--seed and --threads are not used without --replicates: the table answers",
        ));
    }
    with_threads(args.threads, || {
        if let Some(path) = &args.write_table {
            table::write(path)
        } else if let Some(path) = &args.sample {
            test(args, &SampleFile::read(path)?)
        } else {
            critical_value(args, args.n.unwrap_or(0))
        }
    })?
}

fn critical_value(args: &Args, n: usize) -> Result<(), Failure> {
    let replicates = args.replicates.unwrap_or(REPLICATES);
    let seed = args.seed.unwrap_or(0);
    let null = NullDistribution::simulate(n, replicates, seed)?;
    let critical = null.critical_value(args.level)?;
    if args.json {
        let out = json!({
            "n": n,
            "level": json::number(args.level),
            "critical_value": json::number(critical.value),
            "standard_error": json::number(critical.standard_error),
            "low": json::number(critical.low),
            "high": json::number(critical.high),
            "replicates": replicates,
            "seed": seed,
        });
        return print(&format!("{out:#}\n"));
    }
    print(&format!(
        "size                {n}\n\
         level               {}\n\
         critical value      {:.6}\n\
         standard error      {:.1e}\n\
         95 % interval       {:.6} .. {:.6}\n\
         replicates          {replicates}\n",
        args.level,
        critical.value,
        critical.standard_error,
        critical.low,
        critical.high,
    ))
}

fn test(args: &Args, file: &SampleFile) -> Result<(), Failure> {
    let whole = file.extended()?;
    let shift = args.shift.or(args.log.then_some(Shift::Given(0.0)));
    let (scale, sample) = match shift {
        None => (Scale::Linear, whole),
        Some(shift) => {
            let (shift, above) = shift.split(file.values());
            let scale = Scale::Logarithmic { shift };
            (scale, ExtendedSample::try_new(&above)?)
        }
    };
    let (method, simulated) = simulated_null(args, &sample, scale)?;
    let null = simulated
        .as_ref()
        .map_or(Null::Table(Table::embedded()), Null::Simulated);
    let assessment = Assessment::new(&sample, scale, args.level, null);
    if let Err(Inapplicable::Test(error @ LillieforsError::Level { .. })) =
        assessment.verdict
    {
        return Err(error.into());
    }
    if args.json {
        let out = to_json(&assessment, method, simulated.as_ref());
        return print(&format!("{out:#}\n"));
    }
    print(&to_text(&assessment))
}

/// The null distribution to simulate, if the table is not used, and how the
/// p-value comes about.
fn simulated_null(
    args: &Args,
    sample: &ExtendedSample,
    scale: Scale,
) -> Result<(&'static str, Option<NullDistribution>), Failure> {
    let (n, seed) = (sample.len(), args.seed.unwrap_or(0));
    if n < 4 || sample.censored() > 0 {
        return Ok(("none", None));
    }
    if let (Some(Shift::Min), Scale::Logarithmic { shift }) =
        (args.shift, scale)
    {
        let moment = fit(sample, shift, FitMethod::Moment);
        let Ok(moment) = moment else { return Ok(("none", None)) };
        let dispersion = moment.distribution.dispersion();
        let replicates = args.replicates.unwrap_or(REPLICATES_BEYOND);
        let null =
            ShiftedNull::smallest_value(n + 1, dispersion, replicates, seed)?;
        return Ok(("simulation, smallest value as shift", Some(null.null)));
    }
    let beyond = Table::sizes().last().is_none_or(|&(last, _)| n > last);
    let Some(replicates) =
        args.replicates.or(beyond.then_some(REPLICATES_BEYOND))
    else {
        return Ok(("table", None));
    };
    let null = NullDistribution::simulate(n, replicates, seed)?;
    Ok(("simulation", Some(null)))
}

/// Anderson-Darling, Cramer-von Mises and Shapiro-Wilk of the tested values.
fn others(assessment: &Assessment) -> [Option<Test>; 3] {
    [anderson_darling, cramer_von_mises, shapiro_wilk].map(|test| {
        assessment.tested.as_ref().and_then(|sample| test(sample).ok())
    })
}

fn verdict(assessment: &Assessment) -> (&'static str, Option<String>) {
    match assessment.verdict {
        Ok(Verdict::Rejected) => ("rejected", None),
        Ok(Verdict::NotRejected) => ("not-rejected", None),
        Ok(Verdict::Indeterminate) => ("indeterminate", None),
        Err(reason) => ("not-applicable", Some(reason.to_string())),
    }
}

fn to_json(
    assessment: &Assessment,
    method: &str,
    null: Option<&NullDistribution>,
) -> Value {
    let (statistic, p) = (assessment.statistic, assessment.p_value);
    let tested = assessment.tested.as_ref();
    let (verdict, reason) = verdict(assessment);
    let [ad, cvm, sw] = others(assessment);
    let number = json::optional;
    json!({
        "n": assessment.n,
        "distinct": tested.map(Sample::distinct),
        "largest_tie": tested.map(Sample::largest_tie),
        "statistic": number(statistic.map(|s| s.d)),
        "d_plus": number(statistic.map(|s| s.d_plus)),
        "d_minus": number(statistic.map(|s| s.d_minus)),
        "p_value": number(p.map(|p| p.value)),
        "p_low": number(p.map(|p| p.low)),
        "p_high": number(p.map(|p| p.high)),
        "critical_value": number(assessment.critical_value),
        "level": json::number(assessment.level),
        "verdict": verdict,
        "reason": reason,
        "method": p.map(|_| method),
        "replicates": p.and(null.map(|null| null.sorted().len())),
        "anderson_darling": number(ad.map(|t| t.statistic)),
        "anderson_darling_p_value": number(ad.map(|t| t.p_value)),
        "cramer_von_mises": number(cvm.map(|t| t.statistic)),
        "cramer_von_mises_p_value": number(cvm.map(|t| t.p_value)),
        "shapiro_wilk": number(sw.map(|t| t.statistic)),
        "shapiro_wilk_p_value": number(sw.map(|t| t.p_value)),
    })
}

fn to_text(assessment: &Assessment) -> String {
    let mut text = format!("values              {}", assessment.n);
    if let Some(tested) = &assessment.tested {
        text += &format!(", {} distinct", tested.distinct());
    }
    text += "\n";
    if let (Some(s), Some(p)) = (assessment.statistic, assessment.p_value) {
        text += &format!(
            "Lilliefors D        {:.6} (D+ {:.6}, D- {:.6})\n\
             p                   {:.5} ({:.5} .. {:.5})\n",
            s.d, s.d_plus, s.d_minus, p.value, p.low, p.high
        );
    }
    if let Some(critical) = assessment.critical_value {
        text += &format!(
            "critical value      {critical:.6} at level {}\n",
            assessment.level
        );
    }
    let names =
        ["Anderson-Darling A2", "Cramer-von Mises W2", "Shapiro-Wilk W"];
    for (name, test) in names.into_iter().zip(others(assessment)) {
        if let Some(t) = test {
            text += &format!(
                "{name:<20}{:.6} (p {:.5})\n",
                t.statistic, t.p_value
            );
        }
    }
    let (verdict, reason) = verdict(assessment);
    text += &format!("verdict             {verdict}");
    text += &reason.map_or(String::new(), |reason| format!(": {reason}"));
    text + "\n"
}
