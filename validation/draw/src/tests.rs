//! Axes, clipping, text and the backend against values worked out by hand.

use crate::axis::Axis;
use crate::axis::Tick;
use crate::colour::{Fill, Ink, Pen};
use crate::geometry::Rect;
use crate::geometry::{clip, simplify};
use crate::markup::{escape, fit, runs, width};
use crate::scene::Drawing;
use crate::text::{Caption, Horizontal, TextLine};

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
    let frame = Rect { left: 0.0, top: 0.0, right: 10.0, bottom: 10.0 };
    let line = [(-5.0, 5.0), (5.0, 5.0), (5.0, 15.0), (15.0, 15.0)];
    assert_eq!(clip(&line, frame), [[(0.0, 5.0), (5.0, 5.0), (5.0, 10.0)]]);
    let hole =
        [(1.0, 1.0), (2.0, 2.0), (f64::NAN, 3.0), (4.0, 4.0), (5.0, 5.0)];
    assert_eq!(clip(&hole, frame).len(), 2);
    assert!(clip(&[(1.0, 1.0), (f64::INFINITY, 1.0)], frame).is_empty());
    assert!(clip(&[(11.0, 0.0), (11.0, 9.0)], frame).is_empty());
}

#[test]
fn simplification_keeps_corners_and_drops_the_straight() {
    let line: Vec<_> = (0..100).map(|i| (f64::from(i), 0.0)).collect();
    assert_eq!(simplify(&line, 0.05), [(0.0, 0.0), (99.0, 0.0)]);
    let corner = [(0.0, 0.0), (1.0, 0.1), (2.0, 0.0)];
    assert_eq!(simplify(&corner, 0.05).len(), 3);
    assert_eq!(simplify(&corner, 0.2).len(), 2);
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

fn scene() -> Drawing {
    let caption = Caption {
        name: "small".into(),
        title: "A < B".into(),
        description: "\"quoted\" & more".into(),
    };
    Drawing::new(caption, 100.0, 50.0)
}

#[test]
fn writes_sub_pixel_coordinates_and_joins_lines_of_a_pen() {
    let mut scene = scene();
    let pen = Pen::new(Ink::Text, 0.7);
    scene.line(&[(1.0, 2.0), (1.5, 2.25), (11.5, 2.0)], pen);
    scene.line(&[(0.0, 10.0), (5.0, 10.0)], pen);
    scene.area(
        &[(1.0, 1.0), (2.0, 1.0), (2.0, 2.0)],
        Fill::tint(Ink::Grid, 30),
    );
    scene.line(&[(f64::NAN, 10.0), (5.0, 10.0)], pen);
    let svg = scene.svg();
    let path = "<path class=\"l t\" stroke-width=\"0.7\" \
                d=\"M1 2l.5 .25 10-.25M0 10l5 0\"/>";
    assert!(svg.contains(path), "{svg}");
    let area = "<path class=\"g\" fill-opacity=\"0.3\" d=\"M1 1l1 0 0 1z\"/>";
    assert!(svg.contains(area), "{svg}");
    assert!(svg.contains("A &lt; B") && svg.contains("&quot;quoted&quot;"));
}

#[test]
fn writes_scripts_and_italics_as_tspans() {
    let mut scene = scene();
    let at = (50.0, 20.0);
    scene.text(TextLine::new("*p* = 1 s^{−1}", at, Horizontal::Centre));
    let svg = scene.svg();
    let text = "<text class=\"t\" x=\"50\" y=\"20\" text-anchor=\"middle\" \
                xml:space=\"preserve\"><tspan font-style=\"italic\">p</tspan> \
                = 1 s<tspan dy=\"-3.96\" font-size=\"7.92\">−1</tspan></text>";
    assert!(svg.contains(text), "{svg}");
}
