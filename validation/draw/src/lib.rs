//! Drawing in the house style: hairlines, sub-pixel coordinates, marked-up
//! text, one palette for light, dark, print and grey.
//!
//! A [`Scene`] is a list of shapes in pixels, built without failing;
//! [`Scene::svg`] writes them; plotters' coordinate system places each point.
//! Layout uses a table of text widths, never the machine's fonts, so the same
//! scene gives the same bytes everywhere.

pub mod axis;
pub mod colour;
pub mod figures;
pub mod geometry;
pub mod grid;
pub mod legend;
pub mod markup;
pub mod panel;
pub mod scene;
pub mod svg;
pub mod text;

pub use axis::Axis;
pub use colour::{Dash, Fill, Ink, Pen};
pub use geometry::{Point, Rect};
pub use grid::Grid;
pub use legend::{Entry, Sample};
pub use panel::{Marker, Panel};
pub use scene::Scene;
pub use text::{Caption, Horizontal, TextLine};

// `named!` derives it.
use serde as _;

#[cfg(test)]
mod tests;
