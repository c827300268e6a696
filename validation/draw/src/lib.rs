//! Drawing in the house style: hairlines, sub-pixel coordinates, marked-up
//! text, one palette for light, dark, print and grey.
//!
//! A `Drawing` is a list of shapes in pixels, built without failing;
//! `Drawing::svg` writes them.
//! Layout uses a table of text widths, never the machine's fonts, so the same
//! scene gives the same bytes everywhere.

pub mod axis;
pub mod colour;
pub mod figures;
mod geometry;
pub mod grid;
pub mod legend;
pub mod markup;
pub mod page;
pub mod panel;
mod scene;
mod svg;
pub mod text;

#[cfg(test)]
mod tests;
