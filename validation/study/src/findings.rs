//! The results of a study as [`Findings`].

use std::sync::LazyLock;

use rocking::block::Block;
use rocking_records::{AsideCount, SetAside};
use rocking_statistics::paired::Pairs;
use rocking_statistics::resampling::RecordRanks;
use rocking_statistics::{Estimate, Proportion, Range};
use serde::Deserialize;

use crate::analyses::{Deviation, StripeDemands, SuiteResults};
use crate::distributions::{BlockSamples, Distributions};
use crate::estimates;
use crate::figures::adjusted_boxes;
use crate::inference::{Resample, Resamples};
use crate::measures::ranks;
use crate::questions::{self, StudyAnswer};
use crate::results::StudyResults;
use crate::sensitivities::OtherChoice;
use crate::stripes::is_within;
use rocking_common::findings::{
    AsideFiles, Claim, Findings, FindingsTable, RowPlace, SCHEMA,
    SuiteSummary, TableRow, Topic,
};
use rocking_common::paper::{
    BLOCKS, FREQUENCIES_RAD_S, SLENDERNESSES_RAD, SuiteKind,
};
use rocking_common::suites::earthquakes;
use rocking_common::words::capital;

/// All findings of a study.
///
/// # Errors
/// If a number cannot be computed.
pub fn study_findings(
    results: &StudyResults,
    draws: &Resamples,
    claims: Vec<Claim>,
    answers: &[StudyAnswer],
) -> anyhow::Result<Findings> {
    let tables = [
        table(Topic::AcceptedShares, shares(results)),
        table(Topic::SlendernessAdjustment, adjustment(results)?),
        table(Topic::Overturning, overturning(results, draws)),
        table(Topic::Resurrections, resurrections(results)),
        table(Topic::SingleRecords, single(results)),
        table(Topic::Sensitivities, varied(results, draws)?),
        table(Topic::UpliftUnscaled, uplift(results)),
    ];
    Ok(Findings {
        schema: SCHEMA,
        version: env!("CARGO_PKG_VERSION").into(),
        settings: results.plan.settings(),
        suites: results
            .suites()
            .map(|own| suite(own, results.plan.replicates))
            .into(),
        claims,
        tables: tables.into(),
        questions: questions::findings(answers),
    })
}

/// The table of a topic with these rows. `tables.toml` declares its quantities.
fn table(topic: Topic, rows: Vec<TableRow>) -> FindingsTable {
    #[derive(Deserialize)]
    struct TableFile {
        table: Vec<FindingsTable>,
    }
    static FILE: LazyLock<TableFile> = LazyLock::new(|| {
        let file = toml::from_str(include_str!("tables.toml"));
        file.unwrap_or_else(|error| panic!("tables.toml: {error}"))
    });
    let declared = FILE.table.iter().find(|table| table.topic == topic);
    let quantities = declared.map_or(Vec::new(), |t| t.quantities.clone());
    FindingsTable { topic, quantities, rows }
}

/// A suite of a study, and the work on it.
fn suite(suite: &SuiteResults, replicates: usize) -> SuiteSummary {
    let certainty = &suite.work.certainty;
    let name = |record: &usize| suite.records[*record].name.clone();
    SuiteSummary {
        kind: suite.kind,
        source: suite.source.to_string(),
        component_rule: suite.component_rule.clone(),
        records: suite.records.len(),
        earthquakes: earthquakes(&suite.clusters),
        sha256: suite.sha256.clone(),
        list: suite.list.clone(),
        shown_alone: suite.chosen.iter().map(name).collect(),
        remarks: remarks(suite, replicates),
        set_aside: set_aside(&suite.set_aside),
        analyses: suite.work.analyses,
        unresolved: certainty.unresolved,
        first_overturnings_reevaluated: certainty.reevaluated,
        largest_shift_if_flipped: certainty.largest_shift,
    }
}

/// Remarks on the records of a suite and, for few earthquakes, on the intervals.
fn remarks(suite: &SuiteResults, replicates: usize) -> Option<String> {
    let on_intervals = suite.clusters.remark(replicates);
    let on_intervals = on_intervals.map(|own| capital(&own.to_string()) + ".");
    let all = suite.remarks.clone().into_iter().chain(on_intervals);
    all.reduce(|a, b| format!("{a} {b}"))
}

/// Files that a suite set aside, by reason.
pub fn set_aside(found: &SetAside) -> Vec<AsideFiles> {
    let reason = |count: AsideCount<'_>| AsideFiles {
        code: count.reason.code().into(),
        files: count.files,
        first: count.first.into(),
    };
    found.counts().into_iter().map(reason).collect()
}

/// A count, which is exact.
fn count(n: usize) -> Estimate {
    Estimate::exact(n as f64)
}

/// The row of a block of a suite, a grid and an intensity measure.
fn block_row(
    kind: SuiteKind,
    found: &Distributions,
    block: &BlockSamples,
    values: Vec<Estimate>,
) -> TableRow {
    let at = RowPlace {
        suite: Some(kind),
        arm: Some(found.arm),
        intensity: Some(found.intensity),
        p_rad_s: Some(block.p_rad_s),
        alpha_rad: Some(block.alpha_rad),
        ..RowPlace::default()
    };
    TableRow { at, values }
}

/// Number of records that uplift each block unscaled.
fn uplift(results: &StudyResults) -> Vec<TableRow> {
    let row = |block: &Block| {
        let threshold = libm::tan(block.slenderness_rad());
        let of = |suite: &SuiteResults| {
            let records = suite.records.iter();
            count(records.filter(|r| r.pga_g > threshold).count())
        };
        let values = results.suites().map(of).into();
        TableRow { at: RowPlace::of(block), values }
    };
    BLOCKS.iter().map(row).collect()
}

/// Shift and accepted shares of each block, suite, grid and measure.
fn shares(results: &StudyResults) -> Vec<TableRow> {
    let mut rows = Vec::new();
    for (suite, found) in results.all_distributions() {
        rows.extend(found.blocks.iter().map(|block| {
            let [original, shifted] = block.shares();
            let values = [block.shift, original, shifted];
            let values = values.map(Estimate::exact).into();
            block_row(suite.kind, found, block, values)
        }));
    }
    rows
}

/// Numbers of records that overturned on a stripe, and of those among them that
/// stand there again.
fn resurrections(results: &StudyResults) -> Vec<TableRow> {
    let row = |stripes: &StripeDemands| {
        let demands = stripes.demands.iter().flatten().flatten();
        let again = stripes.stands_again.iter().flatten().flatten();
        TableRow {
            at: RowPlace { arm: Some(stripes.arm), ..RowPlace::default() },
            values: vec![
                count(demands.filter(|d| d.is_infinite()).count()),
                count(again.filter(|again| **again).count()),
            ],
        }
    };
    results.ordinary.stripes.iter().map(row).collect()
}

/// The single-record comparison by suite and frequency parameter: medians
/// over records and slendernesses.
fn single(results: &StudyResults) -> Vec<TableRow> {
    let mut rows = Vec::new();
    for suite in results.suites() {
        for (single, p_rad_s) in suite.single.iter().zip(FREQUENCIES_RAD_S) {
            let stands = |a: &&Deviation| a.distance.is_finite();
            let usable = single.apart.iter().flatten().filter(stands).count();
            let values = [
                usable as f64,
                single.im,
                single.median_of(|a| a.distance),
                single.median_of(|a| a.peak_ratio),
                single.median_of(|a| a.mean_ln_im),
            ];
            let at = RowPlace {
                suite: Some(suite.kind),
                p_rad_s: Some(p_rad_s),
                ..RowPlace::default()
            };
            rows.push(TableRow {
                at,
                values: values.map(Estimate::exact).into(),
            });
        }
    }
    rows
}

/// Paired overturning capacities by choice and block, the choice over the
/// study's.
fn varied(
    results: &StudyResults,
    draws: &Resamples,
) -> anyhow::Result<Vec<TableRow>> {
    let mut rows = Vec::new();
    for (v, base) in results.varied(&OtherChoice::ALL)? {
        let ratios = ranks(&v.overturning()?, base.overturning(), 1.0);
        let at = RowPlace {
            choice: Some(v.choice.name().into()),
            p_rad_s: Some(FREQUENCIES_RAD_S[v.frequency]),
            alpha_rad: Some(SLENDERNESSES_RAD[v.slenderness]),
            edp: Some(1.0),
            ..RowPlace::default()
        };
        let used = count(ratios.records());
        let median = medians(draws, SuiteKind::Ordinary, &[ratios]);
        let values = [vec![used], median].concat();
        rows.push(TableRow { at, values });
    }
    Ok(rows)
}

/// Medians of values by record, with their 95 % intervals by earthquake.
fn medians(
    draws: &Resamples,
    suite: SuiteKind,
    values: &[RecordRanks],
) -> Vec<Estimate> {
    let of = |draw: Resample<'_>| -> Vec<f64> {
        let counts = draw.of(suite);
        values.iter().map(|own| own.median(counts)).collect()
    };
    let found = draws.smooth(suite.into(), &of);
    let limits = (Range::NotNegative, estimates::LEVEL);
    draws.estimates(suite.into(), limits, &found)
}

/// Figure 9, a row for each box: usable count with its exact 95 % interval, and
/// median; also the medians of the adjusted slendernesses within the paper's and
/// above.
fn adjustment(results: &StudyResults) -> anyhow::Result<Vec<TableRow>> {
    let suite = &results.ordinary;
    let mut rows = Vec::new();
    for arm in results.plan.drawn() {
        let boxes = adjusted_boxes(suite, arm)?.into_iter().enumerate();
        for (frequency, (p_rad_s, stripes)) in boxes {
            let pairs = suite.stripes(arm)?.compared(frequency, None);
            for (stripe, (im, adjusted, scaled)) in stripes.iter().zip(pairs) {
                let part = |within: bool| {
                    let both = adjusted.iter().zip(scaled).zip(&suite.records);
                    let own = both.filter(|(_, r)| is_within(r, im) == within);
                    let (a, b): (Vec<f64>, Vec<f64>) =
                        own.map(|((a, b), _)| (*a, *b)).unzip();
                    anyhow::Ok(Pairs::try_new(&a, &b)?.ratios)
                };
                let (within, above) = (part(true)?, part(false)?);
                let median = |of: &[f64]| {
                    Estimate::exact(estimates::median(of).value())
                };
                let all = stripe.summary.as_ref().map(|b| b.median);
                let at = RowPlace {
                    arm: Some(arm),
                    p_rad_s: Some(p_rad_s),
                    im_pga: Some(im),
                    ..RowPlace::default()
                };
                let values = vec![
                    count(stripe.records),
                    usable(suite, adjusted, scaled)?,
                    Estimate::exact(all.unwrap_or(f64::NAN)),
                    median(&within),
                    median(&above),
                    count(above.len()),
                ];
                rows.push(TableRow { at, values });
            }
        }
    }
    Ok(rows)
}

/// Number of usable ratios of demands, with its exact interval by the effective
/// number of records.
fn usable(
    suite: &SuiteResults,
    adjusted: &[f64],
    scaled: &[f64],
) -> anyhow::Result<Estimate> {
    let both = adjusted.iter().zip(scaled);
    let is_usable = |(a, b): (&f64, &f64)| a.is_finite() && b.is_finite();
    let held: Vec<bool> = both.map(is_usable).collect();
    let share = Proportion::of_clusters(&held, &suite.clusters)?;
    let n = held.len() as f64;
    let interval = share.interval(estimates::LEVEL)?.map(|p| p * n);
    let usable = held.iter().filter(|held| **held).count() as f64;
    Ok(Estimate::try_new(usable, interval, Range::NotNegative)?)
}

/// Median overturning intensities of each block, suite and measure, on the grid
/// that figures share.
fn overturning(results: &StudyResults, draws: &Resamples) -> Vec<TableRow> {
    let mut rows = Vec::new();
    for (suite, found) in results.common() {
        let blocks = found.blocks.iter();
        let ranks: Vec<RecordRanks> =
            blocks.map(|b| RecordRanks::new(b.overturning())).collect();
        let medians = medians(draws, suite.kind, &ranks);
        let blocks = found.blocks.iter().zip(medians);
        rows.extend(blocks.map(|(block, median)| {
            block_row(suite.kind, found, block, vec![median])
        }));
    }
    rows
}
