//! Figures 11, 12 and 14: capacities, and shares of accepted levels.

use crate::distributions::SAMPLES;
use crate::estimates::three_quantiles;
use crate::normality::{BAND_REPLICATES, LEVEL, ends, over_critical};
use crate::results::StudyResults;
use crate::words::paper_heading;
use rocking_common::paper::{
    Arm, BLOCKS, FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, demands,
};
use rocking_common::table::number as cell;
use rocking_common::words::percent;
use rocking_draw::axis::{Axis, Tick};
use rocking_draw::colour::{Dash, Fill, Ink, Pen};
use rocking_draw::figures::common::{self, span};
use rocking_draw::figures::{
    Chart, ChartPanel, Figure, Layout, Look, Mark, Of, Series,
};
use rocking_draw::grid::Grid;
use rocking_draw::legend::{Entry, Sample};
use rocking_draw::panel::Marker;
use rocking_draw::text::Horizontal;

const RECORD: Pen = Pen::new(Ink::Muted, 0.35);
const SHIFT: Pen = Pen::new(Ink::Text, 0.9).dash(Dash::Dashed);
const ORIGINAL: Ink = Ink::Series(0);
const SHIFTED: Ink = Ink::Series(2);

/// Size of a panel of Figure 11, in px.
const SIZE_PX: (f64, f64) = (440.0, 220.0);

/// Figure 11: p = 1, alpha = 0.20.
pub(super) fn inverted(
    results: &StudyResults,
    arm: Arm,
) -> anyhow::Result<Figure> {
    let levels = demands();
    let mut panels = Vec::new();
    let mut onsets = Vec::new();
    let mut cut = 0;
    for intensity in [Intensity::Pga, Intensity::Pgv] {
        let block = results.ordinary.block(arm, intensity, (0, 3))?;
        onsets.push((three_quantiles(&block.samples[0])?, block.shift));
        let last = block.overturning();
        cut = last.iter().filter(|x| !x.is_finite()).count();
        let mut shown: Vec<(&str, Vec<f64>)> = Vec::new();
        for (record, facts) in results.ordinary.records.iter().enumerate() {
            let own = block.samples.iter().map(|s| s[record]).collect();
            shown.push((&facts.name, own));
        }
        let (low, high) = capacity_range(&shown, block.shift);
        let of = block.samples.iter().map(|s| three_quantiles(s));
        let of: Vec<[f64; 3]> = of.collect::<anyhow::Result<_>>()?;
        for (words, ink, less) in
            [("original", ORIGINAL, 0.0), ("shifted", SHIFTED, block.shift)]
        {
            // Capacities that do not exceed the shift lie at the edge.
            let at = |im: f64| if im - less > low { im - less } else { low };
            // The shifted curves are the same numbers minus the shift.
            let keyed = |one: Series, name: &str| {
                if less > 0.0 {
                    return one.keyed([]);
                }
                let (im, shift) = (intensity.name().into(), cell(block.shift));
                one.keyed([im, shift, name.into()])
            };
            let mut series = Vec::new();
            for (name, ims) in &shown {
                let y: Vec<f64> = ims.iter().map(|im| at(*im)).collect();
                let stands = y.iter().take_while(|y| y.is_finite()).count();
                if (1..y.len()).contains(&stands) {
                    let mark = Look::marks(Marker::Triangle, 3.2, Ink::Text);
                    let (x, y) = (levels[stands - 1], y[stands - 1]);
                    let end = Series::of(mark, vec![x], vec![y]);
                    series.push(end.keyed([]));
                }
                let one = Series::of(Look::line(RECORD), levels.clone(), y);
                series.push(keyed(one, name));
            }
            let look = Look {
                pen: Some(Pen::new(ink, 1.8)),
                ..Look::band(Fill::tint(ink, 30))
            };
            let median = of.iter().map(|q| at(q[1])).collect();
            let ends = of.iter().map(|q| (at(q[0]), at(q[2]))).collect();
            let one = Series::of(look, levels.clone(), median).with(ends);
            series.push(keyed(one, "median"));
            if less == 0.0 {
                let at = (0.0, block.shift);
                series.push(Series::note(Mark::Across(SHIFT), "", at));
            }
            let label = intensity.row().label;
            let minus = if less == 0.0 { "" } else { " − IM_{R}" };
            panels.push(ChartPanel::new(
                format!(
                    "{}, {words}: {}, {}, {} records",
                    intensity.name().to_uppercase(),
                    common::frequency(FREQUENCIES_RAD_S[0]),
                    common::slenderness(SLENDERNESSES_RAD[3]),
                    shown.len(),
                ),
                Axis::linear(0.0, 1.0, 5).label(common::DEMAND),
                Axis::logarithmic(low, high).label(format!("{label}{minus}")),
                series,
            ));
        }
    }
    let line = |ink, width| Sample::Line(Pen::new(ink, width));
    let band = |ink| Sample::Band(Fill::tint(ink, 30));
    let mut legend = vec![
        Entry::new(line(RECORD.ink, 0.7), "one record"),
        Entry::new(line(ORIGINAL, 1.8), "median, original"),
        Entry::new(band(ORIGINAL), "16 to 84 %"),
        Entry::new(line(SHIFTED, 1.8), "median, IM − IM_{R}"),
        Entry::new(band(SHIFTED), "16 to 84 %"),
        Entry::new(Sample::Line(SHIFT), "IM_{R}"),
    ];
    let mut ends = String::new();
    if cut > 0 {
        let mark = Sample::Mark(Marker::Triangle, Ink::Text);
        legend.push(Entry::new(mark, "ends: never overturned"));
        ends = format!(" {cut} records never overturn: their curves end.");
    }
    let heading = paper_heading(11, Some(arm));
    let layout = Layout {
        grid: Some(Grid::new(panels.len(), 2).plot(SIZE_PX.0, SIZE_PX.1)),
        legend,
        ..Layout::of(
            &["im", "shift", "record"],
            &[
                ("edp", Of::X),
                ("intensity", Of::Y),
                ("q16", Of::Low),
                ("q84", Of::High),
            ],
        )
    };
    let times =
        |(of, _): ([f64; 3], f64), less: f64| (of[2] - less) / (of[0] - less);
    let chart = Chart { heading, panels, columns: 2 };
    Ok(chart.thinned(SIZE_PX).laid_out(
        &layout,
        format!(
            "At the lowest demand the 84 % capacity is {:.2} times the 16 % \
             capacity for PGA, and {:.2} times for PGV. Above IM_R it is \
             {:.2} and {:.2} times.{ends}",
            times(onsets[0], 0.0),
            times(onsets[1], 0.0),
            times(onsets[0], onsets[0].1),
            times(onsets[1], onsets[1].1),
        ),
    ))
}

/// Range of the capacities of all records, original and shifted. A twentieth of
/// the shifted ones may leave the panel at the bottom.
fn capacity_range(records: &[(&str, Vec<f64>)], shift: f64) -> (f64, f64) {
    let all = || records.iter().map(|(_, ims)| ims);
    let (_, high) = span(all().flatten().copied(), true).unwrap_or((1.0, 2.0));
    let mut above: Vec<f64> = all()
        .filter_map(|ims| Some(ims.first()? - shift))
        .filter(|x| *x > 0.0 && x.is_finite())
        .collect();
    above.sort_by(f64::total_cmp);
    let low = above.get(above.len() / 20).copied().unwrap_or(0.1 * high);
    (0.8 * low, 1.15 * high)
}

/// One block on one grid, in a panel of Figure 12 or 14.
struct Share {
    /// Position of the block among the fifteen.
    block: usize,
    arm: usize,
    /// Accepted share of the levels.
    accepted: f64,
    /// Central 95 % band of the accepted share for lognormal samples whose levels
    /// are equally dependent, if it was computed.
    band: Option<(f64, f64)>,
    /// Number of levels that could be tested.
    levels: usize,
}

const NULL_BAND: Fill = Fill::tint(Ink::Muted, 22);
const EXPECTED: Pen = Pen::new(Ink::Text, 0.8).dash(Dash::Dashed);
/// Columns of the CSV that name a mark.
const SHARE_KEYS: [&str; 8] = [
    "suite",
    "records",
    "im",
    "sample",
    "arm",
    "p_rad_s",
    "alpha_rad",
    "levels",
];
/// Marks of the grids.
const ARMS: [Marker; 3] = [Marker::Dot, Marker::OpenSquare, Marker::Plus];

/// Figure 12 (PGA) or 14 (PGV).
pub(super) fn shares(
    results: &StudyResults,
    number: u32,
) -> anyhow::Result<Figure> {
    let intensity = if number == 12 { Intensity::Pga } else { Intensity::Pgv };
    let drawn = results.plan.drawn();
    let common = results.plan.common();
    let levels = demands().len();
    let mut panels = Vec::new();
    let mut means = Vec::new();
    let mut fewest = usize::MAX;
    let mut is_banded = false;
    for suite in results.suites() {
        for (sample, sample_name) in SAMPLES.into_iter().enumerate() {
            let mut shares: Vec<Share> = Vec::new();
            for (arm, of) in drawn.iter().enumerate() {
                let found = suite.distributions(*of, intensity)?;
                for (block, one) in found.blocks.iter().enumerate() {
                    let tests = one.tests[sample].iter().map(over_critical);
                    let band = one.bands[sample].as_ref().and_then(ends);
                    is_banded |= band.is_some();
                    shares.push(Share {
                        block,
                        arm,
                        accepted: one.shares()[sample],
                        band,
                        levels: tests.filter(|d| d.is_finite()).count(),
                    });
                }
            }
            // The grid that the findings show first.
            let own = || shares.iter().filter(|s| drawn[s.arm] == common);
            let mean =
                own().fold(0.0, |s, b| s + b.accepted) / own().count() as f64;
            means.push(percent(mean, 1));
            let least = shares.iter().map(|s| s.levels).min();
            fewest = fewest.min(least.unwrap_or(0));
            let (name, records) = (suite.kind.name(), suite.records.len());
            let mut series = groups(&shares, levels);
            let expected = (0.0, 1.0 - LEVEL);
            series.push(Series::note(Mark::Across(EXPECTED), "", expected));
            for share in &shares {
                let block = BLOCKS[share.block];
                series.extend(mark_of(
                    share,
                    drawn.len(),
                    [
                        name.into(),
                        records.to_string(),
                        intensity.name().into(),
                        sample_name.into(),
                        drawn[share.arm].name().into(),
                        cell(block.frequency_rad_s()),
                        cell(block.slenderness_rad()),
                        share.levels.to_string(),
                    ],
                ));
            }
            let alphas = BLOCKS.map(|b| format!("{:.2}", b.slenderness_rad()));
            let percents = [0, 25, 50, 75, 100].map(|k: u32| Tick {
                at: f64::from(k) / 100.0,
                label: k.to_string(),
            });
            panels.push(ChartPanel::new(
                format!("{records} {name} records, {sample_name} sample"),
                Axis::named(&alphas).label("*α* (rad)"),
                Axis::linear(-0.04, 1.36, 5)
                    .with_ticks(percents.into())
                    .label("accepted levels (%)"),
                series,
            ));
        }
    }
    let marks = drawn.iter().zip(ARMS).map(|(arm, marker)| {
        let mark = Sample::Mark(marker, Ink::Text);
        Entry::new(mark, common::arm_words(*arm))
    });
    let mut legend: Vec<Entry> = marks.collect();
    legend.push(Entry::new(
        Sample::Line(EXPECTED),
        format!("expected for a lognormal: {}", percent(1.0 - LEVEL, 0)),
    ));
    if is_banded {
        let grid = common.name();
        let words = format!("95 % band of lognormal suites, grid {grid}");
        legend.push(Entry::new(Sample::Band(NULL_BAND), words));
    }
    let layout = Layout {
        grid: Some(Grid::new(panels.len(), 2).plot(440.0, 190.0)),
        legend,
        ..Layout::of(
            &SHARE_KEYS,
            &[
                ("share", Of::Y),
                ("null_low", Of::Low),
                ("null_high", Of::High),
            ],
        )
    };
    let rests = match fewest < levels {
        true => format!(
            "If a record never overturns, fewer levels can be tested: at \
             least {fewest}; the panels state the number."
        ),
        false => format!("All {levels} levels were tested for every block."),
    };
    let heading = paper_heading(number, None);
    Ok(Chart { heading, panels, columns: 2 }.laid_out(
        &layout,
        format!(
            "On grid {0} the mean accepted share is {1} (original) and {2} \
             (shifted) for ordinary records, {3} and {4} for pulse-type \
             records. {rests} The bands are for grid {0} too: they contain \
             95 % of {BAND_REPLICATES} lognormal suites with the same \
             dependence between levels.",
            common.name(),
            means[0],
            means[1],
            means[2],
            means[3],
        ),
    ))
}

/// A mark over its band.
fn mark_of(share: &Share, arms: usize, keys: [String; 8]) -> [Series; 2] {
    let aside = 0.34 * (share.arm as f64 - 0.5 * (arms - 1) as f64);
    let x = (share.block + 1) as f64 + aside;
    let y = share.accepted;
    let ink = Ink::Series(share.block % SLENDERNESSES_RAD.len());
    let band = Look::band(NULL_BAND);
    let mark = Look::marks(ARMS[share.arm], 3.6, ink);
    let ends: Vec<(f64, f64)> = share.band.into_iter().collect();
    [
        Series::of(band, vec![x - 0.15, x + 0.15], vec![y; 2])
            .with(ends.repeat(2))
            .keyed([]),
        Series::of(mark, vec![x], vec![y]).with(ends).keyed(keys),
    ]
}

/// Names of the frequency parameters over their blocks, the numbers of levels
/// that were tested there, and lines between them.
fn groups(shares: &[Share], all: usize) -> Vec<Series> {
    let mut notes = Vec::new();
    let of_each = SLENDERNESSES_RAD.len();
    for (k, p) in FREQUENCIES_RAD_S.into_iter().enumerate() {
        let middle = (k * of_each) as f64 + 0.5 * (of_each + 1) as f64;
        let own = || shares.iter().filter(|s| s.block / of_each == k);
        let least = own().map(|s| s.levels).min().unwrap_or(0);
        let words = match own().map(|s| s.levels).max().unwrap_or(0) {
            most if most == least => format!("{least} of {all} levels"),
            most => format!("{least} to {most} of {all} levels"),
        };
        let centred = Mark::Words(Horizontal::Centre);
        let p = common::frequency(p);
        notes.push(Series::note(centred, p, (middle, 1.24)));
        notes.push(Series::note(centred, words, (middle, 1.08)));
        if k + 1 < FREQUENCIES_RAD_S.len() {
            let between = Mark::Upright(Pen::new(Ink::Muted, 0.5));
            let x = ((k + 1) * of_each) as f64 + 0.5;
            notes.push(Series::note(between, "", (x, 0.0)));
        }
    }
    notes
}
