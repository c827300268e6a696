//! Axes, clipping, text and the backend against values worked out by hand.

use crate::axis::{Axis, Tick};
use crate::canvas::{Canvas, style};
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::drawing::Drawing;
use crate::geometry::{Rect, clip, kept};
use crate::markup::{escape, fit, runs, width};
use crate::panel::{Marker, Panel};
use crate::text::{Horizontal, TEXT_PX};

fn labels(axis: &Axis) -> Vec<&str> {
    axis.ticks.iter().map(|t: &Tick| t.label.as_str()).collect()
}

#[test]
fn linear_ticks_are_round_and_have_a_true_minus() {
    let axis = Axis::linear(-1.0, 1.0, 4);
    assert_eq!(labels(&axis), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
    assert_eq!(Axis::around(0.3, 9.2, 5).range(), (0.0, 10.0));
    assert_eq!(labels(&Axis::linear(0.0, 30.0, 5)).len(), 7);
    let end = |axis: Axis| axis.ticks.last().map(|tick| tick.label.clone());
    assert_eq!(end(Axis::linear(10.0, 11.2, 6)).as_deref(), Some("11.2"));
    assert_eq!(end(Axis::around(0.5, 6.5, 5)).as_deref(), Some("7"));
    let small = Axis::linear(0.0, 2e-16, 4);
    assert!((small.ticks[1].at / 5e-17 - 1.0).abs() < 1e-12);
}

#[test]
fn axes_without_extent_are_widened() {
    for axis in [
        Axis::linear(2.0, 2.0, 5),
        Axis::around(0.0, 0.0, 5),
        Axis::linear(f64::NAN, 1.0, 5),
        Axis::logarithmic(-1.0, 0.0),
        Axis::logarithmic(3.0, 3.0),
        Axis::linear(f64::NEG_INFINITY, f64::INFINITY, 5),
        Axis::around(f64::MIN, f64::MAX, 5),
        Axis::linear(0.0, f64::MIN_POSITIVE, 5),
        Axis::around(1.0, 1.0 + f64::EPSILON, 5),
    ] {
        let (low, high) = axis.range();
        assert!(low < high && low.is_finite() && high.is_finite());
        assert!(!axis.ticks.is_empty() && axis.ticks.len() < 12);
    }
}

#[test]
fn logarithmic_ticks() {
    let axis = Axis::logarithmic(0.01, 1.0);
    assert_eq!(
        labels(&axis),
        ["0.01", "0.02", "0.05", "0.1", "0.2", "0.5", "1"]
    );
    let wide = Axis::logarithmic(1e-12, 1.0);
    assert!(labels(&wide).contains(&"10^{−12}"));
    assert!(wide.place(0.0).is_nan() && wide.place(-1.0).is_nan());
    assert!((wide.place(1e-6) - 0.5).abs() < 1e-12);
}

#[test]
fn clipping_keeps_what_is_inside_and_breaks_at_holes() {
    let line = [(-0.5, 0.5), (0.5, 0.5), (0.5, 1.5), (1.5, 1.5)];
    assert_eq!(clip(&line), [[(0.0, 0.5), (0.5, 0.5), (0.5, 1.0)]]);
    let hole =
        [(0.1, 0.1), (0.2, 0.2), (f64::NAN, 0.3), (0.4, 0.4), (0.5, 0.5)];
    assert_eq!(clip(&hole).len(), 2);
    assert!(clip(&[(0.1, 0.1), (f64::INFINITY, 0.1)]).is_empty());
    assert!(clip(&[(1.1, 0.0), (1.1, 0.9)]).is_empty());
}

#[test]
fn simplification_keeps_corners_and_drops_the_straight() {
    let line: Vec<_> = (0..100).map(|i| (f64::from(i), 0.0)).collect();
    let straight = kept(&line, 0.05);
    assert!(straight[0] && straight[99] && !straight[1..99].contains(&true));
    let corner = [(0.0, 0.0), (1.0, 0.1), (2.0, 0.0)];
    assert_eq!(kept(&corner, 0.05), [true; 3]);
    assert_eq!(kept(&corner, 0.2), [true, false, true]);
}

#[test]
fn markup_widths_and_escapes() {
    // Helvetica: "a" 556, "1" 556 thousandths.
    assert!((width("*a*", 10.0) - 5.56).abs() < 1e-9);
    assert!((width("a_{1}", 10.0) - 5.56 * 1.72).abs() < 1e-9);
    let name = "A*B_{c}\\d^e";
    let read: String =
        runs(&escape(name)).into_iter().map(|r| r.text).collect();
    assert_eq!(read, name);
    assert_eq!(fit("short", 10.0, 100.0), "short");
    let cut = fit(&"long ".repeat(30), 10.0, 100.0);
    assert!(cut.ends_with('…') && width(&cut, 10.0) <= 100.0);
}

/// The SVG of what a function draws, without its head.
fn svg(draw: impl FnOnce(&Canvas<'_>)) -> String {
    let words = ["small", "A < B", "\"quoted\" & more"];
    let mut drawing = Drawing::new(words, (100.0, 50.0));
    draw(&Canvas::on(&mut drawing));
    let svg = drawing.finish();
    assert!(svg.contains("A &lt; B") && svg.contains("&quot;quoted&quot;"));
    let (_, shapes) = svg.split_once("height=\"50\"/>\n").unwrap();
    shapes.strip_suffix("</svg>\n").unwrap().to_owned()
}

#[test]
fn writes_sub_pixel_coordinates_and_joins_lines_of_a_pen() {
    let pen = Pen::new(Ink::Text, 0.7);
    let shapes = svg(|on| {
        on.line(&[(1.0, 2.0), (1.5, 2.25), (11.5, 2.0)], pen);
        on.line(&[(0.0, 10.0), (5.0, 10.0)], pen);
        let corners = [(1.0, 1.0), (2.0, 1.0), (2.0, 2.0)];
        on.area(&corners, Fill::tint(Ink::Grid, 30));
        on.dot((3.0, 4.0), 1.5, Ink::Series(6));
    });
    assert_eq!(
        shapes,
        "<path class=\"l t\" stroke-width=\"0.7\" \
         d=\"M1 2l.5 .25 10-.25M0 10l5 0\"/>\n\
         <path class=\"g\" fill-opacity=\"0.3\" d=\"M1 1l1 0 0 1z\"/>\n\
         <path class=\"l r s1\" stroke-width=\"3\" d=\"M3 4h0\"/>\n"
    );
}

#[test]
fn an_ink_is_a_class_and_a_dash_an_array() {
    let pen = Pen::new(Ink::Series(1), 1.25).dash(Dash::DashDot);
    let shapes = svg(|on| {
        on.line(&[(0.0, 0.0), (5.0, 0.0)], pen);
        on.outline(&[(0.0, 0.0), (5.0, 0.0), (5.0, 5.0)], pen);
    });
    assert_eq!(
        shapes,
        "<path class=\"l s2\" stroke-width=\"1.25\" \
         stroke-dasharray=\"6 2 1.2 2\" d=\"M0 0l5 0M0 0l5 0 0 5z\"/>\n"
    );
}

#[test]
fn writes_scripts_and_italics_as_tspans_over_the_shapes() {
    let shapes = svg(|on| {
        let words = style(TEXT_PX, Ink::Text, Horizontal::Centre);
        on.text("*p* = 1 s^{−1}", (50.0, 20.0), words);
        on.dot((1.0, 1.0), 1.0, Ink::Text);
    });
    let text = "\n<text class=\"t\" x=\"50\" y=\"20\" \
                text-anchor=\"middle\" font-size=\"11\">\
                <tspan font-style=\"italic\">p</tspan> \
                = 1 s<tspan dy=\"-3.96\" font-size=\"7.92\">−1</tspan>\
                </text>\n";
    assert!(shapes.ends_with(text), "{shapes}");
}

/// A chart of 40 by 10 px with its upper left corner at (50, 2), and one tick
/// on each axis.
fn chart(draw: impl FnOnce(&mut Panel<'_>)) -> String {
    let tick = |at| vec![Tick { at, label: format!("*{at}*") }];
    let x = Axis::linear(0.0, 4.0, 5).with_ticks(tick(1.0)).label("x");
    let y = Axis::logarithmic(0.01, 1.0).with_ticks(tick(0.1));
    let frame = Rect { left: 50.0, top: 2.0, right: 90.0, bottom: 12.0 };
    svg(|on| {
        let mut panel = Panel::new(on, frame, (x, y), None);
        draw(&mut panel);
        panel.finish("title", "");
    })
}

#[test]
fn plotters_draws_a_chart_on_the_backend() {
    let line = Pen::new(Ink::Series(0), 1.0);
    let drawn = || {
        chart(|panel| {
            // From below the plot area through a hole to above it.
            let (hole, zero) = ((f64::NAN, 0.1), (1.0, 0.0));
            panel.line([(0.0, 1e-3), (2.0, 0.1), hole, zero], line);
            panel.line([(2.0, 0.1), (4.0, 10.0)], line);
            let band = [(0.0, 0.1, 1.0), (9.0, 0.1, 1.0)];
            panel.band(&band, Fill::solid(Ink::Muted));
            let marks = [(3.0, 0.1), (5.0, 0.1), (3.0, -1.0)];
            panel.marks(marks, (Marker::Dot, 1.0, Ink::Text));
        })
    };
    let svg = drawn();
    assert_eq!(svg, drawn());
    for part in [
        // The grid, then lines to the edge, the band and the mark inside.
        "<path class=\"l g\" stroke-width=\"0.6\" \
         d=\"M60 12l0-10M50 7l40 0\"/>\n\
         <path class=\"l s1\" stroke-width=\"1\" \
         d=\"M60 12l10-5M70 7l10-5\"/>\n\
         <path class=\"m\" d=\"M50 7l40.05 0 0-5-40.05 0z\"/>\n\
         <path class=\"l r t\" stroke-width=\"2\" d=\"M80 7h0\"/>\n",
        // A tick of the vertical axis.
        "M46.45 7l3.5 0",
    ] {
        assert!(svg.contains(part), "{part} in {svg}");
    }
}
