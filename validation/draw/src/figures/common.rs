//! What the figures share: names, inks by slenderness, scenes.

use super::heading::Heading;
use crate::canvas::Canvas;
use crate::colour::Ink;
use crate::drawing::Drawing;
use crate::geometry::Point;
use crate::grid::Grid;
use crate::legend::{self, Entry};
use crate::markup;
use rocking_common::paper::{Arm, SLENDERNESSES_RAD};

/// A drawing with the words of a heading, of a size in px.
pub(crate) fn drawing(
    heading: &Heading,
    size_px: Point,
    draw: impl FnOnce(&Canvas<'_>),
) -> Drawing {
    let arm = heading.arm.map(|arm| format!(" (grid {})", arm.name()));
    let motions = heading.motions.map(|m| format!(" ({} motions)", m.name()));
    let title = [Some(heading.title.clone()), arm, motions];
    let title: String = title.into_iter().flatten().collect();
    let words = [&heading.name, &title, &heading.description];
    let mut drawing = Drawing::new(words.map(String::as_str), size_px);
    draw(&Canvas::on(&mut drawing));
    drawing
}

/// A drawing with the grid's size, the legend drawn and room made for it.
pub(crate) fn panels(
    heading: &Heading,
    grid: Grid,
    legend: &[Entry],
    draw: impl FnOnce(&Canvas<'_>, Grid),
) -> Drawing {
    let (width_px, height_px) = grid.size();
    let head_px = legend::height(legend, width_px);
    let grid = Grid { head: grid.head + head_px, ..grid };
    drawing(heading, (width_px, height_px + head_px), |canvas| {
        legend::draw(canvas, legend, width_px);
        draw(canvas, grid);
    })
}

/// `p = 3 s^-1`.
pub fn frequency(p_rad_s: f64) -> String {
    format!("*p* = {p_rad_s} s^{{−1}}")
}

/// `alpha = 0.10 rad`.
pub fn slenderness(alpha_rad: f64) -> String {
    format!("*α* = {alpha_rad:.2} rad")
}

/// Peak rotation over slenderness, as an axis label.
pub const DEMAND: &str = "*θ̃* = max |*θ*(*t*)| / *α*";

/// The ink of one of the paper's slendernesses, the same in every figure.
pub fn ink(alpha_rad: f64) -> Ink {
    let place = SLENDERNESSES_RAD.iter().position(|a| *a == alpha_rad);
    Ink::Series(place.unwrap_or(0))
}

/// Smallest and largest finite value; positive ones only where `positive`.
pub fn span(
    values: impl IntoIterator<Item = f64>,
    positive: bool,
) -> Option<(f64, f64)> {
    let usable = |x: &f64| x.is_finite() && (!positive || *x > 0.0);
    values.into_iter().filter(usable).fold(None, |span, x| {
        let (low, high) = span.unwrap_or((x, x));
        Some((low.min(x), high.max(x)))
    })
}

/// The name of a record under a panel's title, cut to the panel's width.
pub fn record(name: &str, width_px: f64) -> String {
    markup::escape(&markup::fit(name, 10.0, width_px + 20.0))
}

/// A number for titles: two decimals, no trailing zeros.
pub fn short(x: f64) -> String {
    if !x.is_finite() {
        return String::from("unknown");
    }
    let text = format!("{x:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// Legend words for a grid.
pub fn arm_words(arm: Arm) -> &'static str {
    match arm {
        Arm::A => "grid A: 0.01 *g* steps",
        Arm::B => "grid B: 0.01 *g* steps, bisected",
        Arm::C => "grid C: equal dimensionless steps, bisected",
    }
}
