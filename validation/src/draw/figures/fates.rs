//! The map of fates over two parameters.

use super::Figure;
use super::data::{Fate, FateMap, FatePanel, Heading};
use super::{chart, common};
use crate::draw::{Entry, Fill, Ink, Panel, Sample, Scene};

impl Figure for FateMap {
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

/// Every fate with its fill and its words.
const FATES: [(Fate, Fill, &str); 5] = [
    (Fate::NoUplift, Fill::tint(Ink::Muted, 14), "no uplift"),
    (Fate::Rocked, Fill::tint(Ink::Series(3), 45), "rocked"),
    (
        Fate::OverturnedAfterImpact,
        Fill::tint(Ink::Series(2), 70),
        "overturned after impact",
    ),
    (
        Fate::OverturnedWithoutImpact,
        Fill::solid(Ink::Series(0)),
        "overturned without impact",
    ),
    (Fate::Unresolved, Fill::solid(Ink::Text), "unresolved"),
];

fn fill(fate: Fate) -> Fill {
    let of = |(f, fill, _): &(Fate, Fill, &str)| (*f == fate).then_some(*fill);
    FATES.iter().find_map(of).unwrap_or(Fill::solid(Ink::Text))
}

pub(super) fn scene(figure: &FateMap) -> Scene {
    let shown = |fate| figure.panels.iter().any(|p| p.fates.contains(&fate));
    let legend: Vec<Entry> = FATES
        .iter()
        .filter(|(fate, ..)| shown(*fate))
        .map(|(_, fill, words)| Entry::new(Sample::Band(*fill), *words))
        .collect();
    let grid = chart::grid(figure.panels.len(), figure.columns);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let x = chart::axis(&shown.x, ends(&shown.x_edges)).without_grid();
        let y = chart::axis(&shown.y, ends(&shown.y_edges)).without_grid();
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        draw_cells(&mut panel, shown);
        let title = if figure.panels.len() > 1 {
            common::panel_title(i, &shown.title)
        } else {
            shown.title.clone()
        };
        panel.finish(&title, "");
    }
    scene
}

fn ends(edges: &[f64]) -> impl Iterator<Item = f64> {
    edges.first().into_iter().chain(edges.last()).copied()
}

/// Cells, one rectangle for each run of the same fate in a row.
fn draw_cells(panel: &mut Panel<'_>, shown: &FatePanel) {
    let across = shown.x_edges.len().saturating_sub(1);
    if across == 0 {
        return;
    }
    for (fate, ..) in FATES {
        let rows = shown.fates.chunks(across).zip(shown.y_edges.windows(2));
        for (row, y) in rows {
            let mut first = 0;
            for run in row.chunk_by(|a, b| a == b) {
                let last = first + run.len();
                if run.first() == Some(&fate) {
                    let a = (shown.x_edges[first], y[0]);
                    let b = (shown.x_edges[last], y[1]);
                    panel.bar(a, b, fill(fate));
                }
                first = last;
            }
        }
    }
}
