//! Figures 12 and 14: share of demand levels at which lognormality is
//! accepted, by block.

use super::Figure;
use super::common;
use super::common::Slendernesses;
use super::data::{AcceptedShares, Heading, SharePanel};
use crate::draw::axis::Tick;
use crate::draw::{
    Axis, Dash, Entry, Fill, Grid, Horizontal, Ink, Marker, Panel, Pen,
    Sample, Scene,
};
use crate::paper::Arm;

impl Figure for AcceptedShares {
    fn heading(&self) -> &Heading {
        &self.heading
    }

    fn scene(&self) -> Scene {
        scene(self)
    }

    fn csv(&self) -> String {
        self.csv()
    }
}

const NULL_BAND: Fill = Fill::tint(Ink::Muted, 22);
const EXPECTED: Pen = Pen::new(Ink::Text, 0.8).dash(Dash::Dashed);

pub(super) fn scene(figure: &AcceptedShares) -> Scene {
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
    if shares().any(|s| s.null_band.is_some()) {
        let words = "95 % band of a lognormal sample";
        legend.push(Entry::new(Sample::Band(NULL_BAND), words));
    }
    let grid = Grid::new(figure.panels.len(), figure.columns);
    let grid = grid.plot(440.0, 210.0);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let ticks = blocks
            .iter()
            .enumerate()
            .map(|(k, b)| Tick {
                at: (k + 1) as f64,
                label: format!("{:.2}", b.1),
            })
            .collect();
        let x = Axis::named(&vec![String::new(); blocks.len()])
            .with_ticks(ticks)
            .label("*α* (rad)");
        let tens = (0..=5)
            .map(|k| Tick {
                at: 20.0 * f64::from(k),
                label: (20 * k).to_string(),
            })
            .collect();
        let y = Axis::linear(0.0, 114.0, 5)
            .with_ticks(tens)
            .label("accepted levels (%)");
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        groups(&mut panel, &blocks);
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
fn groups(panel: &mut Panel<'_>, blocks: &[(f64, f64)]) {
    let mut first = 0;
    for (k, block) in blocks.iter().enumerate() {
        let last = blocks.get(k + 1).is_none_or(|b| b.0 != block.0);
        if !last {
            continue;
        }
        let middle = f64::midpoint((first + 1) as f64, (k + 1) as f64);
        panel.words_at(
            (middle, 104.5),
            common::frequency(block.0),
            Horizontal::Centre,
        );
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
