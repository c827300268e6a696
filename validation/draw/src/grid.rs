//! Panels in rows and columns, with room for titles, axes and a legend.

use crate::geometry::{Point, Rect};
use serde::{Deserialize, Serialize};

/// Sizes of a grid of equal panels, in px.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Grid {
    /// Number of panels.
    pub panels: usize,
    /// Panels in a row.
    pub columns: usize,
    /// Width of a panel's plotting area.
    pub width: f64,
    /// Height of a panel's plotting area.
    pub height: f64,
    /// Room left of a plotting area, for ticks and the label.
    pub left: f64,
    /// Room right of it.
    pub right: f64,
    /// Room above it, for the title.
    pub above: f64,
    /// Room below it, for ticks and the label.
    pub below: f64,
    /// Room at the head of the figure, for the legend.
    pub head: f64,
}

impl Grid {
    /// The house's sizes: three panels in a row make 1080 px.
    pub fn new(panels: usize, columns: usize) -> Self {
        Self {
            panels: panels.max(1),
            columns: columns.clamp(1, panels.max(1)),
            width: 288.0,
            height: 222.0,
            left: 56.0,
            right: 16.0,
            above: 26.0,
            below: 46.0,
            head: 10.0,
        }
    }

    /// The same with other plotting areas.
    pub fn plot(self, width: f64, height: f64) -> Self {
        Self { width, height, ..self }
    }

    /// Width and height of the whole figure.
    pub(crate) fn size(&self) -> Point {
        let rows = self.panels.div_ceil(self.columns) as f64;
        let down = self.above + self.height + self.below;
        let across = self.left + self.width + self.right;
        (self.columns as f64 * across, rows.mul_add(down, self.head))
    }

    /// Plotting area of a panel, counted row by row.
    pub(crate) fn frame(&self, panel: usize) -> Rect {
        let (row, column) = (panel / self.columns, panel % self.columns);
        let across = self.left + self.width + self.right;
        let down = self.above + self.height + self.below;
        let left = (column as f64).mul_add(across, self.left);
        let top = (row as f64).mul_add(down, self.head + self.above);
        Rect { left, top, right: left + self.width, bottom: top + self.height }
    }
}
