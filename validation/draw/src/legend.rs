//! One legend for all panels, above them.

use crate::canvas::{Canvas, style};
use crate::colour::{Fill, Ink, Pen};
use crate::markup;
use crate::panel::{Look, Marker};
use crate::text::{Horizontal, TEXT_PX};
use serde::{Deserialize, Serialize};

const SAMPLE_PX: f64 = 26.0;
const GAP_PX: f64 = 6.0;
const BETWEEN_PX: f64 = 18.0;
const ROW_PX: f64 = 18.0;

/// What stands before a legend's words.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Sample {
    /// A line.
    Line(Pen),
    /// A mark.
    Mark(Marker, Ink),
    /// A mark on a line.
    LineAndMark(Pen, Marker),
    /// A filled band.
    Band(Fill),
    /// What a series looks like.
    Of(Look),
}

/// One entry.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Entry {
    /// The sample.
    pub sample: Sample,
    /// Its words, in [`markup`].
    pub label: String,
}

impl Entry {
    /// An entry.
    pub fn new(sample: Sample, label: impl Into<String>) -> Self {
        Self { sample, label: label.into() }
    }

    fn width(&self) -> f64 {
        // A tenth more, for viewers whose font is wider than Helvetica.
        1.1_f64
            .mul_add(markup::width(&self.label, TEXT_PX), SAMPLE_PX + GAP_PX)
    }
}

/// Entries row by row, so that each row fits the width of a drawing.
fn rows(mut rest: &[Entry], width_px: f64) -> Vec<&[Entry]> {
    let mut rows = Vec::new();
    while !rest.is_empty() {
        let mut used = BETWEEN_PX;
        let fitting = rest.iter().take_while(|entry| {
            used += entry.width() + BETWEEN_PX;
            used <= width_px
        });
        let (row, after) = rest.split_at(fitting.count().max(1));
        rows.push(row);
        rest = after;
    }
    rows
}

/// Room that the legend takes at this width.
pub fn height(entries: &[Entry], width_px: f64) -> f64 {
    let rows = rows(entries, width_px).len();
    if rows == 0 { 0.0 } else { (rows as f64).mul_add(ROW_PX, 8.0) }
}

/// Draws the legend centred at the head of a drawing of this width.
pub(crate) fn draw(canvas: &Canvas<'_>, entries: &[Entry], width_px: f64) {
    let words = style(TEXT_PX, Ink::Text, Horizontal::Left);
    for (i, row) in rows(entries, width_px).into_iter().enumerate() {
        let between = BETWEEN_PX * (row.len() - 1) as f64;
        let total = row.iter().fold(between, |sum, e| sum + e.width());
        let mut x = (width_px - total) / 2.0;
        let y = (i as f64).mul_add(ROW_PX, 16.0);
        for entry in row {
            draw_sample(canvas, entry.sample, x, y);
            let at = (x + SAMPLE_PX + GAP_PX, y + 0.36 * TEXT_PX);
            canvas.text(&entry.label, at, words.clone());
            x += entry.width() + BETWEEN_PX;
        }
    }
}

fn draw_sample(canvas: &Canvas<'_>, sample: Sample, x: f64, y: f64) {
    let look = match sample {
        Sample::Line(pen) => Look::line(pen),
        Sample::Mark(marker, ink) => Look::marks(marker, 3.2, ink),
        Sample::LineAndMark(pen, marker) => {
            Look { marker: Some((marker, 3.0, pen.ink)), ..Look::line(pen) }
        }
        Sample::Band(fill) => Look::band(fill),
        Sample::Of(look) => look,
    };
    if let Some(fill) = look.band {
        let (l, r, t, b) = (x + 5.0, x + SAMPLE_PX - 5.0, y - 5.0, y + 5.0);
        let corners = [(l, t), (r, t), (r, b), (l, b)];
        canvas.area(&corners, fill);
        canvas.outline(&corners, Pen::new(Ink::Muted, 0.4));
    }
    for (up, pen) in [(4.0, look.sides), (0.0, look.pen), (-4.0, look.sides)] {
        if let Some(pen) = pen {
            canvas.line(&[(x, y - up), (x + SAMPLE_PX, y - up)], pen);
        }
    }
    if let Some((marker, _, ink)) = look.marker {
        marker.draw(canvas, (x + SAMPLE_PX / 2.0, y), 3.2, ink);
    }
}
