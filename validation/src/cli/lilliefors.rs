//! `rocking lilliefors`: the test of normality, and its critical values.

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args as ClapArgs};
use rocking::procedures::Shift;
use rocking::procedures::fit::ShiftError;
use rocking::statistics::lilliefors::{
    Assessment, Inapplicable, LillieforsError, Null, NullDistribution, Scale,
    ShiftedNull, Table, Verdict,
};
use rocking::statistics::normality::{
    Battery, Calibrated, anderson_darling, cramer_von_mises, shapiro_wilk,
};
use rocking::statistics::{ExtendedSample, Sample};
use serde_json::{Value, json};

use super::samples::SampleFile;
use super::{Failure, print, print_json, progress, with_threads};
use crate::files::Outputs;
use crate::table::Table as Csv;

/// Values of a simulated sample, at most: each thread holds one.
const MOST_VALUES: i64 = 10_000_000;
/// Replicates where none are asked for.
const REPLICATES: u64 = 1_000_000;
/// The same for sizes beyond the table.
const REPLICATES_BEYOND: u64 = 100_000;

/// Lilliefors' test of normality on a sample, or its critical values.
///
/// The p-value comes from the project's own Monte Carlo table (n = 4 to
/// 1000), or from a direct simulation when --replicates is given or n is
/// larger; then those of Anderson-Darling, Cramer-von Mises and Shapiro-Wilk
/// are simulated too, else they come from published approximations. A verdict is refused where the test does not apply: censored
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
        value_parser = known_shift,
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
    with_threads(args.threads, || {
        if let Some(path) = &args.write_table {
            write_table(path)
        } else if let Some(path) = &args.sample {
            test(args, &SampleFile::read(path)?)
        } else {
            critical_value(args, args.n.unwrap_or(0) as usize)
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
            "level": args.level,
            "critical_value": critical.value,
            "standard_error": critical.standard_error,
            "low": critical.low,
            "high": critical.high,
            "replicates": replicates,
            "seed": seed,
        });
        return print_json(out);
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
    let simulates = args.replicates.is_some()
        || args.shift == Some(Shift::Smallest)
        || is_beyond_table(whole.len());
    if !simulates && (args.seed.is_some() || args.threads.is_some()) {
        return Err(Failure::input(
            "--seed and --threads are not used without --replicates: the table answers",
        ));
    }
    let shift = args.shift.or(args.log.then_some(Shift::Given(0.0)));
    let (scale, sample) = match shift {
        None => (Scale::Linear, whole),
        Some(shift) => {
            let (shift, above) = shift.split(&file.censored()?)?;
            let scale = Scale::Logarithmic { shift };
            (scale, ExtendedSample::try_new(above.values())?)
        }
    };
    let (method, simulated) = simulated_null(args, &sample, file.values())?;
    let null = simulated
        .as_ref()
        .map_or(Null::Table(Table::embedded()), Null::Simulated);
    let assessment = Assessment::new(&sample, scale, args.level, null);
    if let Err(Inapplicable::Test(error @ LillieforsError::Level { .. })) =
        assessment.verdict
    {
        return Err(error.into());
    }
    let others = others(args, &assessment)?;
    if args.json {
        let out = to_json(&assessment, method, simulated.as_ref(), &others);
        return print_json(out);
    }
    print(&to_text(&assessment, &others))
}

/// A shift that Lilliefors' null knows: a third fitted parameter has another.
fn known_shift(text: &str) -> Result<Shift, String> {
    match text.parse().map_err(|e: ShiftError| e.to_string())? {
        Shift::Free => Err("expected a number, not negative, or `min`; \
             `rocking fragility choose` tests a fitted shift"
            .into()),
        shift => Ok(shift),
    }
}

fn is_beyond_table(n: usize) -> bool {
    Table::sizes().last().is_none_or(|&(last, _)| n > last)
}

/// The null distribution to simulate, if the table is not used, and how the
/// p-value comes about.
fn simulated_null(
    args: &Args,
    sample: &ExtendedSample,
    values: &[f64],
) -> Result<(&'static str, Option<NullDistribution>), Failure> {
    let (n, seed) = (sample.len(), args.seed.unwrap_or(0));
    if n < 4 || sample.censored() > 0 {
        return Ok(("none", None));
    }
    if args.shift == Some(Shift::Smallest) {
        let replicates = args.replicates.unwrap_or(REPLICATES_BEYOND);
        let null = ShiftedNull::smallest_value(values, replicates, seed)?;
        return Ok(("simulation, smallest value as shift", Some(null.null)));
    }
    let own = is_beyond_table(n).then_some(REPLICATES_BEYOND);
    let Some(replicates) = args.replicates.or(own) else {
        return Ok(("table", None));
    };
    let null = NullDistribution::simulate(n, replicates, seed)?;
    Ok(("simulation", Some(null)))
}

/// A test beside Lilliefors'.
struct Other {
    statistic: f64,
    p_value: f64,
    /// Interval of a simulated p-value, and the verdict.
    simulated: Option<(f64, f64, Verdict)>,
}

impl Other {
    fn simulated(test: Calibrated, level: f64) -> Self {
        let p = test.p_value;
        let verdict = p.verdict(level);
        Self {
            statistic: test.statistic,
            p_value: p.value,
            simulated: Some((p.low, p.high, verdict)),
        }
    }
}

/// Anderson-Darling, Cramer-von Mises and Shapiro-Wilk of the tested values:
/// simulated with --replicates, unless the shift is the sample's own or the
/// sample is larger than Shapiro and Wilk's test takes.
fn others(
    args: &Args,
    assessment: &Assessment,
) -> Result<[Option<Other>; 3], Failure> {
    let none = [None, None, None];
    let Some(tested) = &assessment.tested else { return Ok(none) };
    let given = args.shift != Some(Shift::Smallest)
        && (4..=Battery::MOST_VALUES).contains(&tested.len());
    if let Some(replicates) = args.replicates.filter(|_| given) {
        let seed = args.seed.unwrap_or(0);
        let battery = Battery::simulate(tested.len(), replicates, seed)?;
        return Ok(battery.assess(tested).map_or(none, |tests| {
            tests.map(|test| Some(Other::simulated(test, args.level)))
        }));
    }
    Ok([anderson_darling, cramer_von_mises, shapiro_wilk].map(|test| {
        let test = test(tested).ok()?;
        let (statistic, p_value) = (test.statistic, test.p_value);
        Some(Other { statistic, p_value, simulated: None })
    }))
}

fn name(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Rejected => "rejected",
        Verdict::NotRejected => "not-rejected",
        Verdict::Indeterminate => "indeterminate",
    }
}

fn verdict(assessment: &Assessment) -> (&'static str, Option<String>) {
    match assessment.verdict {
        Ok(verdict) => (name(verdict), None),
        Err(reason) => ("not-applicable", Some(reason.to_string())),
    }
}

fn to_json(
    assessment: &Assessment,
    method: &str,
    null: Option<&NullDistribution>,
    others: &[Option<Other>; 3],
) -> Value {
    let (statistic, p) = (assessment.statistic, assessment.p_value);
    let tested = assessment.tested.as_ref();
    let (verdict, reason) = verdict(assessment);
    let mut out = json!({
        "n": assessment.n,
        "distinct": tested.map(Sample::distinct),
        "largest_tie": tested.map(Sample::largest_tie),
        "statistic": statistic.map(|s| s.d),
        "d_plus": statistic.map(|s| s.d_plus),
        "d_minus": statistic.map(|s| s.d_minus),
        "p_value": p.map(|p| p.value),
        "p_low": p.map(|p| p.low),
        "p_high": p.map(|p| p.high),
        "critical_value": assessment.critical_value,
        "level": assessment.level,
        "verdict": verdict,
        "reason": reason,
        "method": p.map(|_| method),
        "replicates": p.and(null.map(|null| null.sorted().len())),
    });
    let keys = ["anderson_darling", "cramer_von_mises", "shapiro_wilk"];
    for (key, test) in keys.into_iter().zip(others) {
        let test = test.as_ref();
        let simulated = test.and_then(|t| t.simulated);
        out[key] = json!(test.map(|t| t.statistic));
        out[format!("{key}_p_value")] = json!(test.map(|t| t.p_value));
        out[format!("{key}_p_low")] = json!(simulated.map(|s| s.0));
        out[format!("{key}_p_high")] = json!(simulated.map(|s| s.1));
        out[format!("{key}_verdict")] = json!(simulated.map(|s| name(s.2)));
    }
    out
}

fn to_text(assessment: &Assessment, others: &[Option<Other>; 3]) -> String {
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
    for (title, test) in names.into_iter().zip(others) {
        let Some(t) = test else { continue };
        let p = t.simulated.map_or(String::new(), |(low, high, verdict)| {
            format!(", {low:.5} .. {high:.5}: {}", name(verdict))
        });
        text += &format!(
            "{title:<20}{:.6} (p {:.5}{p})\n",
            t.statistic, t.p_value
        );
    }
    let (verdict, reason) = verdict(assessment);
    text += &format!("verdict             {verdict}");
    text += &reason.map_or(String::new(), |reason| format!(": {reason}"));
    text + "\n"
}

/// Simulates every size of `fixtures/lilliefors/table.csv` and writes it:
/// 3.4e8 samples, some minutes of one core.
///
/// # Errors
/// [`Failure`] if the file cannot be written.
fn write_table(path: &Path) -> Result<(), Failure> {
    let out = Outputs::default().open(path)?;
    let sizes = Table::sizes();
    let progress = progress(sizes.len() as u64);
    let mut csv =
        Csv::headed("n,replicates,level,critical_value,standard_error");
    for (n, replicates) in sizes {
        let null = NullDistribution::simulate(n, replicates, 0)?;
        for level in Table::LEVELS {
            let critical = null.critical_value(level)?;
            csv.row([
                n.to_string(),
                replicates.to_string(),
                level.to_string(),
                format!("{:.8}", critical.value),
                format!("{:.1e}", critical.standard_error),
            ]);
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    Ok(out.write(csv.finish())?)
}
