//! `rocking lilliefors`: the test of normality, and its critical values.

mod table;

use std::path::PathBuf;

use clap::{ArgGroup, Args as ClapArgs};
use rocking::statistics::lilliefors::{
    LillieforsError, NullDistribution, PValue, Statistic, Table, Verdict,
};
use rocking::statistics::normality::{
    Test, anderson_darling, cramer_von_mises, shapiro_wilk,
};
use rocking::statistics::{Sample, lognormal::shifted_finite};
use serde_json::json;

use super::samples::SampleFile;
use super::{Failure, print};
use crate::json;

/// Share of distinct values below which ties decide the test.
const DISTINCT: f64 = 0.8;
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
    #[arg(
        long,
        value_name = "X",
        conflicts_with_all = ["critical_values", "write_table"],
        allow_negative_numbers = true
    )]
    shift: Option<f64>,
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
    if let Some(path) = &args.write_table {
        return table::write(path);
    }
    if let Some(path) = &args.sample {
        return test(args, &SampleFile::read(path)?);
    }
    critical_value(args, args.n.unwrap_or(0))
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

/// What the null distribution says of a statistic.
struct Calibration {
    p: PValue,
    critical_value: Option<f64>,
    method: &'static str,
    replicates: Option<u64>,
}

fn calibrate(
    args: &Args,
    n: usize,
    d: f64,
) -> Result<Calibration, LillieforsError> {
    let beyond = Table::sizes().last().is_none_or(|&(last, _)| n > last);
    let Some(replicates) =
        args.replicates.or(beyond.then_some(REPLICATES_BEYOND))
    else {
        let table = Table::embedded();
        let critical = table.critical_value(n, args.level).ok();
        return Ok(Calibration {
            p: table.p_value(n, d)?,
            critical_value: critical.map(|(value, _)| value),
            method: "table",
            replicates: None,
        });
    };
    let seed = args.seed.unwrap_or(0);
    let null = NullDistribution::simulate(n, replicates, seed)?;
    Ok(Calibration {
        p: null.p_value(d),
        critical_value: null.critical_value(args.level).ok().map(|c| c.value),
        method: "simulation",
        replicates: Some(replicates),
    })
}

/// The values to be tested, or why there are none.
fn transformed(args: &Args, file: &SampleFile) -> Result<Sample, Reason> {
    let extended = file.extended()?;
    if extended.censored() > 0 {
        return Err(Reason::NotApplicable(format!(
            "{} of {} values are infinite",
            extended.censored(),
            extended.len()
        )));
    }
    if !args.log && args.shift.is_none() {
        return Ok(file.finite()?);
    }
    let shift = args.shift.unwrap_or(0.0);
    if !(shift >= 0.0 && shift.is_finite()) {
        return Err(Reason::Failure(Failure::input(format!(
            "--shift {shift}: expected a finite number, not negative"
        ))));
    }
    let logs = shifted_finite(&extended, shift)
        .map_err(|e| Reason::NotApplicable(e.to_string()))?;
    Sample::try_new(&logs).map_err(|e| Reason::NotApplicable(e.to_string()))
}

/// Why a test gave no verdict.
enum Reason {
    NotApplicable(String),
    Failure(Failure),
}

impl<E: Into<Failure>> From<E> for Reason {
    fn from(error: E) -> Self {
        Self::Failure(error.into())
    }
}

fn test(args: &Args, file: &SampleFile) -> Result<(), Failure> {
    if args.seed.is_some() && args.replicates.is_none() {
        return Err(Failure::input(
            "--seed is not used without --replicates: the table is given",
        ));
    }
    let n = file.values().len();
    let sample = match transformed(args, file) {
        Ok(sample) => sample,
        Err(Reason::NotApplicable(reason)) => {
            return report(args, n, None, Err(reason));
        }
        Err(Reason::Failure(failure)) => return Err(failure),
    };
    let tested = Statistic::try_new(&sample).map_err(|e| e.to_string());
    let tested = match tested {
        Ok(statistic) => Ok((statistic, calibrate(args, n, statistic.d)?)),
        Err(reason) => Err(reason),
    };
    report(args, n, Some(&sample), tested)
}

fn report(
    args: &Args,
    n: usize,
    sample: Option<&Sample>,
    tested: Result<(Statistic, Calibration), String>,
) -> Result<(), Failure> {
    let distinct = sample.map(Sample::distinct);
    let (verdict, reason) = match (&tested, distinct) {
        (Err(reason), _) => ("not-applicable", Some(reason.clone())),
        (Ok(_), Some(distinct)) if (distinct as f64) < DISTINCT * n as f64 => {
            let reason = format!("ties: {distinct} distinct values of {n}");
            ("not-applicable", Some(reason))
        }
        (Ok((_, calibration)), _) => (verdict(&calibration.p, args), None),
    };
    let tested = tested.ok();
    let statistic = tested.as_ref().map(|t| t.0);
    let calibration = tested.as_ref().map(|t| &t.1);
    let p = calibration.map(|c| c.p);
    let other = |f: fn(&Sample) -> Result<Test, LillieforsError>| {
        sample.and_then(|sample| f(sample).ok())
    };
    let (ad, cvm, sw) = (
        other(anderson_darling),
        other(cramer_von_mises),
        other(shapiro_wilk),
    );
    if args.json {
        let number = json::optional;
        let out = json!({
            "n": n,
            "distinct": distinct,
            "largest_tie": sample.map(Sample::largest_tie),
            "statistic": number(statistic.map(|s| s.d)),
            "d_plus": number(statistic.map(|s| s.d_plus)),
            "d_minus": number(statistic.map(|s| s.d_minus)),
            "p_value": number(p.map(|p| p.value)),
            "p_low": number(p.map(|p| p.low)),
            "p_high": number(p.map(|p| p.high)),
            "critical_value":
                number(calibration.and_then(|c| c.critical_value)),
            "level": json::number(args.level),
            "verdict": verdict,
            "reason": reason,
            "method": calibration.map(|c| c.method),
            "replicates": calibration.and_then(|c| c.replicates),
            "anderson_darling": number(ad.map(|t| t.statistic)),
            "anderson_darling_p_value": number(ad.map(|t| t.p_value)),
            "cramer_von_mises": number(cvm.map(|t| t.statistic)),
            "cramer_von_mises_p_value": number(cvm.map(|t| t.p_value)),
            "shapiro_wilk": number(sw.map(|t| t.statistic)),
            "shapiro_wilk_p_value": number(sw.map(|t| t.p_value)),
        });
        return print(&format!("{out:#}\n"));
    }
    let mut text = format!("values              {n}");
    text += &distinct.map_or(String::new(), |d| format!(", {d} distinct"));
    text += "\n";
    if let (Some(s), Some(p)) = (statistic, p) {
        text += &format!(
            "Lilliefors D        {:.6} (D+ {:.6}, D- {:.6})\n\
             p                   {:.5} ({:.5} .. {:.5})\n",
            s.d, s.d_plus, s.d_minus, p.value, p.low, p.high
        );
    }
    if let Some(critical) = calibration.and_then(|c| c.critical_value) {
        text += &format!(
            "critical value      {critical:.6} at level {}\n",
            args.level
        );
    }
    for (name, test) in [
        ("Anderson-Darling A2", ad),
        ("Cramer-von Mises W2", cvm),
        ("Shapiro-Wilk W", sw),
    ] {
        if let Some(t) = test {
            text += &format!(
                "{name:<20}{:.6} (p {:.5})\n",
                t.statistic, t.p_value
            );
        }
    }
    text += &format!("verdict             {verdict}");
    text += &reason.map_or(String::new(), |reason| format!(": {reason}"));
    print(&(text + "\n"))
}

fn verdict(p: &PValue, args: &Args) -> &'static str {
    match p.verdict(args.level) {
        Verdict::Rejected => "rejected",
        Verdict::NotRejected => "not-rejected",
        Verdict::Indeterminate => "indeterminate",
    }
}
