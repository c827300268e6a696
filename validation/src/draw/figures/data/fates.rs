//! The map of fates over two parameters.

use super::{Axis, Heading};
use crate::table::{Table, number};

/// Fates over a grid of two parameters.
#[derive(Debug, Clone, PartialEq)]
pub struct FateMap {
    /// The words.
    pub heading: Heading,
    /// Panels row by row.
    pub panels: Vec<FatePanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One map.
#[derive(Debug, Clone, PartialEq)]
pub struct FatePanel {
    /// Title in markup.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Cell edges along x, rising (geometric on a logarithmic axis).
    pub x_edges: Vec<f64>,
    /// Cell edges along y, rising.
    pub y_edges: Vec<f64>,
    /// Fates, row by row from the lowest y.
    pub fates: Vec<Fate>,
}

/// Fate of one run.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    /// Never left its base.
    NoUplift,
    /// Rocked and stood.
    Rocked,
    /// Overturned with no impact before.
    OverturnedWithoutImpact,
    /// Overturned after one impact or more.
    OverturnedAfterImpact,
    /// Too close to the edge for double precision.
    Unresolved,
}

impl Fate {
    /// Plain name for tables.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::NoUplift => "no-uplift",
            Self::Rocked => "rocked",
            Self::OverturnedWithoutImpact => "overturned-without-impact",
            Self::OverturnedAfterImpact => "overturned-after-impact",
            Self::Unresolved => "unresolved",
        }
    }
}

impl FateMap {
    /// `panel,x_low,x_high,y_low,y_high,fate`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table = Table::new(&[
            "panel", "x_low", "x_high", "y_low", "y_high", "fate",
        ]);
        for (i, panel) in self.panels.iter().enumerate() {
            let across = panel.x_edges.len().saturating_sub(1).max(1);
            for (k, fate) in panel.fates.iter().enumerate() {
                let edge = |edges: &[f64], at: usize| {
                    number(edges.get(at).copied().unwrap_or(f64::NAN))
                };
                table.row([
                    super::letter(i),
                    edge(&panel.x_edges, k % across),
                    edge(&panel.x_edges, k % across + 1),
                    edge(&panel.y_edges, k / across),
                    edge(&panel.y_edges, k / across + 1),
                    fate.name().into(),
                ]);
            }
        }
        table.finish()
    }
}
