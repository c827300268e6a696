//! `rocking fragility counts`: fits of how many records exceeded a level at
//! each intensity.

use std::borrow::Cow;
use std::io::Read;
use std::path::{Path, PathBuf};

use indexmap::IndexMap;
use rocking_procedures::counts::RecordOutcome;
use rocking_procedures::{
    BootstrapFits, CountsFragility, Draws, FragilityInput, ProcedureError,
    fit_outcomes, fit_stripes, sample_outcomes,
};
use rocking_statistics::Clusters;
use rocking_statistics::lognormal::Stripe;

use crate::cli::shared::{BootstrapArgs, JsonArg, PlotArg, ThreadsArg};
use crate::failure::{AtPlace as _, Failure};
use crate::input;
use rocking_common::files::Outputs;
use rocking_draw::figures::of_suite::fragilities_svg;
use rocking_exchange::FileError;
use rocking_exchange::columns::{COUNTS, OUTCOMES};
use rocking_exchange::read::{Cells, no_csv, reader, rows};

/// Fits a lognormal fragility to counts: how many of n records exceeded a
/// level, or overturned, at each intensity.
///
/// Maximum likelihood of binomial counts, with 95 % intervals. Counts do not
/// say whether stripes share records, so their intervals, from the likelihood,
/// take the stripes as independent. For the table that `rocking stripes
/// --counts` writes, the intervals are from a bootstrap, which draws records,
/// or earthquakes if the table states them. If a record was not run at every
/// intensity, the likelihood uses the two intensities between which each
/// record first exceeds the level.
#[derive(clap::Args)]
#[command(mut_arg("plot", |arg| arg.help(
    "Draw the fit with the shares that exceeded; for outcomes also its band"
)))]
pub(super) struct FragilityCountsCommand {
    /// Table of counts, columns intensity,exceeded,n, or of outcomes, columns
    /// intensity,record,exceeded and event if known; `-` is standard input.
    #[arg(long, value_name = "FILE.csv")]
    counts: PathBuf,
    /// Shift IM_R, not negative.
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    shift: f64,
    #[command(flatten)]
    bootstrap: BootstrapArgs,
    #[command(flatten)]
    plot: PlotArg,
    #[command(flatten)]
    threads: ThreadsArg,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking fragility counts`.
///
/// # Errors
/// [`Failure`] for a table that is refused.
pub(super) fn run_fragility_counts(
    args: &FragilityCountsCommand,
) -> Result<(), Failure> {
    let path = &args.counts;
    let mut outputs = Outputs::of(vec![path.clone()]);
    let plot = args.plot.open(&mut outputs)?;
    let counted = read(path)?;
    let draws = args.bootstrap.draws();
    let found = args.threads.run(|| counted.fit(args.shift, Some(draws)))?;
    let found = found.at(path.display())?;
    if let Some(out) = plot {
        out.write(args.threads.run(|| counted.svg(&found, draws))??)?;
    }
    let sentence = "The fragility has a median of {median} and, above a shift \
                    of {fitted.shift}, a dispersion of {dispersion}.";
    args.json.show_beside(&outputs, &[sentence], &found)
}

/// A table of stripes.
#[derive(Debug)]
pub enum CountTable {
    /// Only counts.
    Stripes(Vec<Stripe>),
    /// The outcome of each record.
    Records(Vec<RecordOutcome>, Clusters),
}

impl CountTable {
    /// The fit; draws are for outcomes of records.
    pub(super) fn fit(
        &self,
        shift: f64,
        draws: Option<Draws>,
    ) -> Result<CountsFragility, ProcedureError> {
        match self {
            Self::Stripes(stripes) => fit_stripes(stripes, shift),
            Self::Records(outcomes, clusters) => {
                fit_outcomes(outcomes, clusters, shift, draws)
            }
        }
    }

    /// The fits to draws of the records; `None` for counts.
    pub(super) fn sampled(
        &self,
        shift: f64,
        draws: Draws,
    ) -> Option<Result<BootstrapFits, ProcedureError>> {
        let Self::Records(outcomes, clusters) = self else { return None };
        Some(sample_outcomes(outcomes, clusters, shift, draws))
    }

    /// A fit with the shares that it is fitted to.
    fn svg(
        &self,
        found: &CountsFragility,
        draws: Draws,
    ) -> Result<String, Failure> {
        let fitted = found.fitted.into();
        let sampled = self.sampled(found.fitted.shift(), draws).transpose()?;
        let share =
            |one: &Stripe| (one.im, one.exceeded as f64 / one.n as f64);
        let stripes = self.stripes().unwrap_or_default();
        let points = stripes.iter().map(share).collect();
        let fit =
            FragilityInput { fragility: "fit".to_owned(), fitted, sampled };
        let words = ("intensity", "marks: shares of the records");
        Ok(fragilities_svg(&[fit], &[points], words))
    }

    /// The counts; `None` if a record was not run at every intensity.
    pub fn stripes(&self) -> Option<Cow<'_, [Stripe]>> {
        Some(match self {
            Self::Stripes(stripes) => Cow::Borrowed(stripes),
            Self::Records(all, _) => RecordOutcome::stripes(all)?.into(),
        })
    }
}

/// Reads a table of counts, or of outcomes.
///
/// # Errors
/// [`Failure`] for a file that cannot be read, and as [`parse`].
pub(super) fn read(path: &Path) -> Result<CountTable, Failure> {
    Ok(parse(input::open(path)?, path)?)
}

/// Reads the text of a table of counts, or of outcomes; `path` is its name in
/// messages.
///
/// # Errors
/// [`FileError`] with the line for another column and a cell of another form.
pub fn parse(from: impl Read, path: &Path) -> Result<CountTable, FileError> {
    let mut reader = reader(from, csv::Trim::All, Some(b'#'));
    let head = reader.headers().map_err(|e| no_csv(path, e))?;
    if head.iter().any(|column| column == "record") {
        return outcomes(path, &mut reader);
    }
    let stripe = |cells: Result<Cells<'_>, FileError>| {
        let cells = cells?;
        let finite = |im: &f64| im.is_finite();
        let count = |name| cells.parsed(name, |_: &u64| true, "a count");
        Ok(Stripe {
            im: cells.parsed("intensity", finite, "an intensity")?,
            exceeded: count("exceeded")?,
            n: count("n")?,
        })
    };
    let stripes = rows(&COUNTS, &mut reader, path)?.map(stripe);
    Ok(CountTable::Stripes(stripes.collect::<Result<_, FileError>>()?))
}

/// Reads a table of outcomes.
fn outcomes<R: Read>(
    path: &Path,
    reader: &mut csv::Reader<R>,
) -> Result<CountTable, FileError> {
    let mut events: IndexMap<String, String> = IndexMap::new();
    let mut all = Vec::new();
    for cells in rows(&OUTCOMES, reader, path)? {
        let cells = cells?;
        let (record, event) = (cells.name("record")?, cells.name("event")?);
        let first = events.first().map_or(event, |(_, first)| first.as_str());
        if first.is_empty() != event.is_empty() {
            let expected = "the earthquake of every record, or of none";
            return Err(cells.refuse("event", expected));
        }
        let entry = events.entry(record.to_owned());
        let place = entry.index();
        let own = entry.or_insert_with(|| event.to_owned());
        if own.as_str() != event {
            let expected = format!("{own}, as before");
            return Err(cells.refuse("event", expected));
        }
        let finite = |im: &f64| im.is_finite();
        let one = |count: &u32| *count <= 1;
        all.push(RecordOutcome {
            im: cells.parsed("intensity", finite, "an intensity")?,
            record: place,
            exceeded: cells.parsed("exceeded", one, "1 or 0")? == 1,
        });
    }
    let known = events.values().all(|event| !event.is_empty());
    let clusters = match known {
        true => Clusters::from_labels(events.values()),
        false => Clusters::singletons(events.len()),
    };
    Ok(CountTable::Records(all, clusters))
}
