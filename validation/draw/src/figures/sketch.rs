//! Figure 1: the block and its symbols.

use std::f64::consts::{FRAC_PI_2, PI};

use super::common;
use super::heading::Heading;
use crate::canvas::{Canvas, style};
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::drawing::Drawing;
use crate::geometry::{Point, from};
use crate::text::Horizontal;
use rocking_common::table::{Table, number};

/// The block with its symbols, rotated about its right-hand pivot.
#[derive(Debug, Clone, PartialEq)]
pub struct BlockSketch {
    /// The words.
    pub heading: Heading,
    /// Slenderness of the drawn block (0.25 to 0.45 reads well).
    pub alpha_rad: f64,
    /// Drawn rotation, positive (0.1 to 0.25 reads well).
    pub rotation_rad: f64,
}

impl BlockSketch {
    /// `quantity,value,unit`.
    pub(super) fn csv(&self) -> String {
        let mut table = Table::new(&["quantity", "value", "unit"]);
        let rows =
            [("slenderness", self.alpha_rad), ("rotation", self.rotation_rad)];
        for (name, value) in rows {
            table.row([name.into(), number(value), "rad".into()]);
        }
        table.finish()
    }
}

const WIDTH: f64 = 460.0;
const HEIGHT: f64 = 430.0;
/// Half diagonal R in px.
const HALF_DIAGONAL: f64 = 158.0;
/// The pivot O'.
const PIVOT: Point = (268.0, 372.0);
const SIZE: f64 = 14.0;
const THIN: Pen = Pen::new(Ink::Text, 0.8);
/// From a corner to the end of its dimension.
const FINE: Pen = Pen::new(Ink::Muted, 0.6);

pub(super) fn scene(figure: &BlockSketch) -> Drawing {
    let alpha = figure.alpha_rad.clamp(0.1, 0.6);
    let theta = figure.rotation_rad.clamp(0.05, 0.35);
    let base = 2.0 * HALF_DIAGONAL * libm::sin(alpha);
    let height = 2.0 * HALF_DIAGONAL * libm::cos(alpha);
    common::drawing(&figure.heading, (WIDTH, HEIGHT), |on| {
        ground(on);
        let at_rest = corners(base, height, 0.0);
        on.outline(&at_rest, Pen::new(Ink::Muted, 0.8).dash(Dash::Dashed));
        let rotated = corners(base, height, theta);
        on.area(&rotated, Fill::tint(Ink::Series(0), 14));
        on.outline(&rotated, Pen::new(Ink::Series(0), 1.5));
        dimensions(on, &rotated);
        angles(on, alpha, theta);
        let left_pivot = from(PIVOT, -base, FRAC_PI_2);
        let pivots = [(PIVOT, "O′", 11.0), (left_pivot, "O", -11.0)];
        for (at, name, aside) in pivots {
            on.dot(at, 2.4, Ink::Text);
            word(on, name, (at.0 + aside, at.1 + 17.0));
        }
        // The ground's acceleration.
        let y = PIVOT.1 + 34.0;
        let (a, b) = ((WIDTH / 2.0 - 34.0, y), (WIDTH / 2.0 + 34.0, y));
        on.line(&[a, b], Pen::new(Ink::Series(2), 1.5));
        head(on, b, FRAC_PI_2, Ink::Series(2));
        word(on, "*ü*_{g}(*t*)", (b.0 + 30.0, y + 5.0));
    })
}

/// Corners of the block turned about its right-hand pivot.
fn corners(base: f64, height: f64, turn: f64) -> [Point; 4] {
    let left = from(PIVOT, -base, FRAC_PI_2 + turn);
    [left, from(left, height, turn), from(PIVOT, height, turn), PIVOT]
}

fn word(on: &Canvas<'_>, markup: &str, at: Point) {
    on.text(markup, at, style(SIZE, Ink::Text, Horizontal::Centre));
}

fn ground(on: &Canvas<'_>) {
    let (left, right, y) = (40.0, WIDTH - 40.0, PIVOT.1);
    on.line(&[(left, y), (right, y)], Pen::new(Ink::Text, 1.2));
    for k in 0..42 {
        let x = 9.0_f64.mul_add(f64::from(k), left + 4.0);
        on.line(&[(x, y), (x - 7.0, y + 7.0)], FINE);
    }
}

/// An arrow head at `tip`, coming along `angle` from the upward vertical.
fn head(on: &Canvas<'_>, tip: Point, angle: f64, ink: Ink) {
    let [a, b] = [-0.33, 0.33].map(|by| from(tip, -8.0, angle + by));
    on.area(&[tip, a, b], Fill::solid(ink));
}

/// 2b along the top, 2h along the left side, both outside the block, with
/// lines from its corners.
fn dimensions(on: &Canvas<'_>, block: &[Point; 4]) {
    let [low_left, top_left, top_right, _] = *block;
    let up = libm::atan2(top_left.0 - low_left.0, low_left.1 - top_left.1);
    let right = up + FRAC_PI_2;
    for (a, b, along, aside, [far, beyond, down], name) in [
        (top_left, top_right, right, up, [16.0, 10.0, 0.0], "2*b*"),
        (low_left, top_left, up, right, [-34.0, -16.0, 5.0], "2*h*"),
    ] {
        let [a, b] = [a, b].map(|corner| {
            on.line(&[corner, from(corner, 1.15 * far, aside)], FINE);
            from(corner, far, aside)
        });
        on.line(&[a, b], THIN);
        head(on, b, along, Ink::Text);
        head(on, a, along + PI, Ink::Text);
        let middle = (f64::midpoint(a.0, b.0), f64::midpoint(a.1, b.1));
        let (x, y) = from(middle, beyond, aside);
        word(on, name, (x, y + down));
    }
}

/// The half diagonal R to the centre of mass, alpha between it and the
/// block's side, theta between the vertical and that side.
fn angles(on: &Canvas<'_>, alpha: f64, theta: f64) {
    let centre = from(PIVOT, HALF_DIAGONAL, theta - alpha);
    on.line(&[PIVOT, centre], Pen::new(Ink::Series(1), 1.3));
    on.dot(centre, 3.2, Ink::Series(1));
    let half = from(PIVOT, 0.60 * HALF_DIAGONAL, theta - alpha);
    word(on, "*R*", (half.0 - 11.0, half.1 + 2.0));
    word(on, "c.m.", (centre.0 - 2.0, centre.1 - 9.0));
    let up = from(PIVOT, 1.36 * HALF_DIAGONAL, 0.0);
    on.line(&[PIVOT, up], Pen::new(Ink::Muted, 0.8).dash(Dash::DashDot));
    let arc = |radius: f64, a: f64, b: f64| -> Vec<Point> {
        let step = (b - a) / 24.0;
        let angle = |i| step.mul_add(f64::from(i), a);
        (0..=24).map(|i| from(PIVOT, radius, angle(i))).collect()
    };
    let radius = 0.46 * HALF_DIAGONAL;
    on.line(&arc(radius, theta - alpha, theta), THIN);
    let at = from(PIVOT, radius + 13.0, 0.5 * theta - 0.01);
    word(on, "*α*", (at.0, at.1 + 4.0));
    let radius = 1.18 * HALF_DIAGONAL;
    on.line(&arc(radius, 0.0, theta), THIN);
    let end = from(PIVOT, radius, theta);
    head(on, end, theta + FRAC_PI_2, Ink::Text);
    word(on, "*θ*", from(PIVOT, radius + 12.0, 0.5 * theta));
}
