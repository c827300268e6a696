//! Drawing in the house style: hairlines, sub-pixel coordinates, marked-up
//! text, one palette for light, dark, print and grey.
//!
//! plotters draws, on a backend that records shapes and writes them as SVG
//! (`drawing`). Layout uses a table of text widths and never the machine's
//! fonts, so that the same figure has the same bytes everywhere.

pub mod axis;
mod canvas;
pub mod colour;
mod drawing;
pub mod figures;
mod geometry;
pub mod grid;
pub mod legend;
pub mod markup;
pub mod page;
pub mod panel;
pub mod text;

#[cfg(test)]
mod tests;
