//! What a chart draws: numbers, the cells that name them, and their look.

use crate::colour::{Dash, Fill, Ink, Pen};
use crate::geometry::Point;
use crate::markup;
use crate::panel::{Look, Marker};
use crate::text::Horizontal;
use serde::{Deserialize, Serialize};

/// What is drawn in one way: its numbers are the rows of the CSV.
///
/// An abscissa of +infinity is an overturned block: its line goes on level
/// from 1 to the end of the axis.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Legend in markup; the same label has the same colour in every panel,
    /// an empty one is drawn in grey and has no legend.
    pub label: String,
    /// The cells that name it in the CSV; none: it has no rows, since it
    /// shows numbers of other series again.
    pub keys: Vec<String>,
    /// How it is drawn.
    pub mark: Mark,
    /// Abscissas.
    #[serde(with = "numbers")]
    pub x: Vec<f64>,
    /// Ordinates.
    #[serde(with = "numbers")]
    pub y: Vec<f64>,
    /// Intervals of the ordinates, or of the abscissas with
    /// [`Mark::Quantiles`]; empty: none.
    #[serde(serialize_with = "numbers::ends")]
    #[serde(deserialize_with = "numbers::intervals")]
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub interval: Vec<(f64, f64)>,
}

impl Series {
    /// A series without intervals, which its label names in the CSV.
    pub fn new(
        label: impl Into<String>,
        mark: Mark,
        x: Vec<f64>,
        y: Vec<f64>,
    ) -> Self {
        let label = label.into();
        let keys = vec![markup::plain(&label)];
        Self { label, keys, mark, x, y, interval: Vec::new() }
    }

    /// A series with this look, without legend.
    pub fn of(look: Look, x: Vec<f64>, y: Vec<f64>) -> Self {
        Self::new("", Mark::Own(look), x, y)
    }

    /// What is no data, at a point: reference lines and words.
    pub fn note(mark: Mark, words: impl Into<String>, at: Point) -> Self {
        Self::new(words, mark, vec![at.0], vec![at.1]).keyed([])
    }

    /// The series with an entry in the legend.
    pub fn labelled(self, label: impl Into<String>) -> Self {
        Self { label: label.into(), ..self }
    }

    /// The series with these intervals.
    pub fn with(self, interval: Vec<(f64, f64)>) -> Self {
        Self { interval, ..self }
    }

    /// The series with these cells that name it in the CSV.
    pub fn keyed<const N: usize>(self, keys: [String; N]) -> Self {
        Self { keys: keys.into(), ..self }
    }

    /// Whether the legend shows how it is drawn.
    pub(super) fn has_sample(&self) -> bool {
        let Look { pen, marker, band, .. } = self.mark.look(Some(0), false);
        let drawn = pen.is_some() || marker.is_some() || band.is_some();
        drawn && !self.label.is_empty()
    }

    /// Its points.
    pub(super) fn points(&self) -> impl Iterator<Item = Point> {
        self.x.iter().zip(&self.y).map(|(x, y)| (*x, *y))
    }
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub enum Mark {
    /// A line, over a band where there are intervals.
    Line,
    /// A dashed line, such as a reference slope or a limit.
    Dashed,
    /// Marks alone, on bars where there are intervals.
    Points,
    /// Marks joined by a line.
    LineAndPoints,
    /// Marks joined by a dashed line.
    DashedAndPoints,
    /// A line, and two thin ones along the ends of the abscissas' intervals.
    Quantiles,
    /// As it says.
    Own(Look),
    /// A horizontal line through the whole panel.
    Across(Pen),
    /// A vertical line through the whole panel.
    Upright(Pen),
    /// The label, on a baseline at the point.
    Words(Horizontal),
    /// The label in the lower right-hand corner, above later ones.
    Corner,
    /// The label right of the panel, above earlier ones.
    Edge,
}

impl Mark {
    /// The look of the series with this rank in the legend, if it has one;
    /// `nested`: lines get much thinner from one to the next.
    pub(super) fn look(self, rank: Option<usize>, nested: bool) -> Look {
        let series = rank.unwrap_or(0);
        let mut usual = Pen::of_series(series);
        if nested && self == Self::Line {
            usual.width_px = (2.3 - 0.4 * series as f64).max(0.6);
        }
        let thin = Pen { width_px: 1.1, dash: Dash::Solid, ..usual };
        let grey = Pen::new(Ink::Muted, 0.9).dash(Dash::Dashed);
        let pen = match self {
            Self::Own(look) => return look,
            Self::Across(pen) | Self::Upright(pen) => return Look::line(pen),
            Self::Words(_) | Self::Corner | Self::Edge => {
                return Look::default();
            }
            Self::Quantiles => {
                let [pen, sides] = [1.15, 0.55].map(|share| {
                    Some(Pen { width_px: share * usual.width_px, ..usual })
                });
                return Look { pen, sides, ..Look::default() };
            }
            _ if rank.is_none() => grey,
            Self::Dashed | Self::DashedAndPoints => thin.dash(Dash::Dashed),
            Self::Points | Self::LineAndPoints => thin,
            _ => usual,
        };
        let line = matches!(self, Self::Line | Self::Dashed);
        let bar = Pen { width_px: 0.8, dash: Dash::Solid, ..pen };
        let marker = Marker::of_series(series);
        Look {
            pen: (self != Self::Points).then_some(pen),
            bars: (!line).then_some(bar),
            band: line.then_some(Fill::tint(pen.ink, 16)),
            marker: (!line).then_some((marker, 3.0, pen.ink)),
            ..Look::default()
        }
    }
}

/// Numbers in JSON, which tell infinity; the ends of intervals are lower,
/// upper, lower and so on.
mod numbers {
    use rocking_common::json::Extended;
    use serde::{Deserialize as _, Deserializer, Serializer};

    pub(super) fn serialize<S: Serializer>(
        values: &[f64],
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.collect_seq(values.iter().copied().map(Extended))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Vec<f64>, D::Error> {
        let kept = Vec::<Extended>::deserialize(from)?;
        Ok(kept.into_iter().map(|Extended(x)| x).collect())
    }

    pub(super) fn ends<S: Serializer>(
        intervals: &[(f64, f64)],
        to: S,
    ) -> Result<S::Ok, S::Error> {
        let ends = intervals.iter().flat_map(|(low, high)| [*low, *high]);
        serialize(&ends.collect::<Vec<_>>(), to)
    }

    pub(super) fn intervals<'de, D: Deserializer<'de>>(
        from: D,
    ) -> Result<Vec<(f64, f64)>, D::Error> {
        let ends = deserialize(from)?;
        Ok(ends.chunks_exact(2).map(|ends| (ends[0], ends[1])).collect())
    }
}
