//! Figures 12 and 14: share of demand levels at which lognormality is
//! accepted, by block.

use super::common::{self, Slendernesses};
use super::heading::{Figure, Heading};
use crate::axis::{Axis, Tick};
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::panel::{Marker, Panel};
use crate::scene::Scene;
use crate::text::Horizontal;
use rocking_common::paper::{Arm, Intensity};
use rocking_common::table::{Table, number, optional};
use rocking_common::words::letter;

/// Share of the demand levels at which lognormality is accepted, by block.
#[derive(Debug, Clone, PartialEq)]
pub struct AcceptedShares {
    /// The words.
    pub heading: Heading,
    /// Kind of the intensity.
    pub intensity: Intensity,
    /// Share that a lognormal sample would give at the test's level (0.95).
    pub expected: f64,
    /// Number of demand levels.
    pub levels: usize,
    /// Panels row by row: a row a suite; original, then shifted.
    pub panels: Vec<SharePanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One suite, original or shifted.
#[derive(Debug, Clone, PartialEq)]
pub struct SharePanel {
    /// Suite as named in the panel's title: `ordinary`, `pulse-type`.
    pub suite: String,
    /// Number of records.
    pub records: usize,
    /// Whether IM_R was taken off before the test.
    pub shifted: bool,
    /// Every block, in each arm shown.
    pub shares: Vec<BlockShare>,
}

/// One block.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockShare {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Slenderness.
    pub alpha_rad: f64,
    /// Arm of the grid; the first arm's marks are filled, others open.
    pub arm: Arm,
    /// Accepted share of the levels, 0 to 1.
    pub share: f64,
    /// Central 95 % band of that share for lognormal samples whose levels
    /// are as dependent as these, where it was computed.
    pub null_band: Option<(f64, f64)>,
    /// Levels at which the test could be made.
    pub levels: usize,
}

impl AcceptedShares {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        Figure::new(&self.heading, scene(self), self.csv(), reading)
    }

    /// `panel,suite,records,im,sample,arm,p_rad_s,alpha_rad,share,`
    /// `null_low,null_high,levels`.
    fn csv(&self) -> String {
        let mut table = Table::headed(
            "panel,suite,records,im,sample,arm,p_rad_s,alpha_rad,share,null_low,null_high,levels",
        );
        for (i, panel) in self.panels.iter().enumerate() {
            for block in &panel.shares {
                let sample =
                    if panel.shifted { "shifted" } else { "original" };
                table.row([
                    letter(i),
                    panel.suite.clone(),
                    panel.records.to_string(),
                    self.intensity.name().into(),
                    sample.into(),
                    block.arm.letter().into(),
                    number(block.p_rad_s),
                    number(block.alpha_rad),
                    number(block.share),
                    optional(block.null_band.map(|b| b.0)),
                    optional(block.null_band.map(|b| b.1)),
                    block.levels.to_string(),
                ]);
            }
        }
        table.finish()
    }
}

const NULL_BAND: Fill = Fill::tint(Ink::Muted, 22);
const EXPECTED: Pen = Pen::new(Ink::Text, 0.8).dash(Dash::Dashed);

fn scene(figure: &AcceptedShares) -> Scene {
    let shares = || figure.panels.iter().flat_map(|p| &p.shares);
    let inks = Slendernesses::new(shares().map(|s| s.alpha_rad));
    let mut arms: Vec<Arm> = shares().map(|s| s.arm).collect();
    arms.sort();
    arms.dedup();
    let mut blocks: Vec<(f64, f64)> =
        shares().map(|s| (s.p_rad_s, s.alpha_rad)).collect();
    blocks.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
    blocks.dedup();
    let mut legend = Vec::new();
    for (k, arm) in arms.iter().enumerate() {
        let mark = Sample::Mark(marker(k), Ink::Text);
        legend.push(Entry::new(mark, common::arm_words(*arm)));
    }
    let percent = common::short(100.0 * figure.expected);
    legend.push(Entry::new(
        Sample::Line(EXPECTED),
        format!("expected of a lognormal: {percent} %"),
    ));
    let banded =
        |a: &&Arm| shares().any(|s| s.arm == **a && s.null_band.is_some());
    let banded: Vec<&str> =
        arms.iter().filter(banded).map(|a| a.letter()).collect();
    if !banded.is_empty() {
        let arms = banded.join(" and ");
        let words = format!("95 % band of lognormal suites, arm {arms}");
        legend.push(Entry::new(Sample::Band(NULL_BAND), words));
    }
    let grid = Grid::new(figure.panels.len(), figure.columns);
    let grid = grid.plot(440.0, 230.0);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let names = blocks.iter().map(|b| format!("{:.2}", b.1));
        let names: Vec<String> = names.collect();
        let x = Axis::named(&names).label("*α* (rad)");
        let tens = [0, 20, 40, 60, 80, 100]
            .map(|k| Tick { at: f64::from(k), label: k.to_string() });
        let y = Axis::linear(0.0, 128.0, 5)
            .with_ticks(tens.into())
            .label("accepted levels (%)");
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        groups(&mut panel, &blocks, shown, figure.levels);
        panel.horizontal(100.0 * figure.expected, EXPECTED);
        draw_shares(&mut panel, shown, &blocks, &arms, &inks);
        let title = format!(
            "{} {} records, {} sample",
            shown.records,
            common::words(&shown.suite),
            if shown.shifted { "shifted" } else { "original" },
        );
        panel.finish(&common::panel_title(i, &title), "");
    }
    scene
}

fn marker(arm: usize) -> Marker {
    match arm {
        0 => Marker::Dot,
        1 => Marker::OpenSquare,
        _ => Marker::Plus,
    }
}

/// Names of the frequency parameters over their blocks, and lines between.
fn groups(
    panel: &mut Panel<'_>,
    blocks: &[(f64, f64)],
    shown: &SharePanel,
    all: usize,
) {
    let mut first = 0;
    for (k, block) in blocks.iter().enumerate() {
        let last = blocks.get(k + 1).is_none_or(|b| b.0 != block.0);
        if !last {
            continue;
        }
        let middle = f64::midpoint((first + 1) as f64, (k + 1) as f64);
        let p = common::frequency(block.0);
        panel.words_at((middle, 117.5), p, Horizontal::Centre);
        let own = || shown.shares.iter().filter(|s| s.p_rad_s == block.0);
        let least = own().map(|s| s.levels).min().unwrap_or(0);
        let words = match own().map(|s| s.levels).max().unwrap_or(0) {
            most if most == least => format!("{least} of {all} levels"),
            most => format!("{least} to {most} of {all} levels"),
        };
        panel.words_at((middle, 105.5), words, Horizontal::Centre);
        if k + 1 < blocks.len() {
            let pen = Pen::new(Ink::Muted, 0.5);
            panel.vertical((k + 1) as f64 + 0.5, pen);
        }
        first = k + 1;
    }
}

fn draw_shares(
    panel: &mut Panel<'_>,
    shown: &SharePanel,
    blocks: &[(f64, f64)],
    arms: &[Arm],
    inks: &Slendernesses,
) {
    for share in &shown.shares {
        let place = (share.p_rad_s, share.alpha_rad);
        let Some(block) = blocks.iter().position(|b| *b == place) else {
            continue;
        };
        let arm = arms.iter().position(|a| *a == share.arm).unwrap_or(0);
        let aside = 0.34 * (arm as f64 - 0.5 * (arms.len() - 1) as f64);
        let x = (block + 1) as f64 + aside;
        if let Some((low, high)) = share.null_band {
            let (low, high) = (100.0 * low, 100.0 * high);
            panel.bar((x - 0.15, low), (x + 0.15, high), NULL_BAND);
        }
        let ink = Ink::Series(inks.series(share.alpha_rad));
        let y = 100.0 * share.share;
        panel.line([(x, 0.0), (x, y)], Pen::new(ink, 0.8));
        panel.marks([(x, y)], marker(arm), 3.2, ink);
    }
}
