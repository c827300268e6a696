//! Every figure from made-up numbers: bytes, form, size, layout.

mod made_up;
mod spare;
mod xml;

use super::Figure;
use crate::geometry::Rect;
use crate::markup;
use rocking_common::paper::Arm;

/// Bytes of an SVG that no figure should have.
const TOO_MANY: usize = 150_000;

/// The texts of a drawing with the rectangle that each fills, by the table of
/// widths.
fn texts(svg: &str) -> Vec<(&str, Rect)> {
    let value = |of: &str, name: &str| -> Option<f64> {
        let (_, rest) = of.split_once(&format!(" {name}=\""))?;
        rest.split('"').next()?.parse().ok()
    };
    let text = |text| {
        let (head, rest): (&str, &str) = str::split_once(text, '>')?;
        let (content, _) = rest.split_once("</text>")?;
        let size = value(head, "font-size")?;
        let width = format!(">{content}");
        let width = width.split('<').map(|part| {
            let (of, words) = part.split_once('>').unwrap_or(("", part));
            let words = words.replace("&lt;", "<").replace("&amp;", "&");
            let words = markup::escape(&words.replace('˜', ""));
            markup::width(&words, value(of, "font-size").unwrap_or(size))
        });
        let width: f64 = width.sum();
        let before = match head {
            _ if head.contains("\"middle\"") => width / 2.0,
            _ if head.contains("\"end\"") => width,
            _ => 0.0,
        };
        let (above, below) = (0.74 * size, 0.21 * size);
        let turned = head.split_once("translate(");
        let (left, right, top, bottom) = if let Some((_, at)) = turned {
            let (x, y) = at.split_once(')')?.0.split_once(' ')?;
            let (x, y): (f64, f64) = (x.parse().ok()?, y.parse().ok()?);
            (x - above, x + below, y + before - width, y + before)
        } else {
            let (x, y) = (value(head, "x")?, value(head, "y")?);
            (x - before, x - before + width, y - above, y + below)
        };
        Some((content, Rect { left, right, top, bottom }))
    };
    let found: Vec<_> = svg.split("<text").skip(1).map(text).collect();
    found.into_iter().collect::<Option<_>>().unwrap()
}

/// Made-up and spare figures, and those of the recorded suites.
fn all() -> Vec<Figure> {
    let kept = rocking_fixtures::text("recorded/figures.json");
    let kept: Vec<Figure> = serde_json::from_str(kept).unwrap();
    [made_up::all(), spare::all(), kept].concat()
}

/// Writes each demonstration figure where `ROCKING_FIGURES` says, to be
/// looked at.
#[test]
fn writes_them_to_be_looked_at() {
    let Ok(folder) = std::env::var("ROCKING_FIGURES") else { return };
    for figure in all() {
        let name = &figure.heading.name;
        let svg = figure.svg();
        std::fs::write(format!("{folder}/{name}.svg"), svg).unwrap();
    }
}

#[test]
fn same_bytes_twice_below_the_limit() {
    let (first, second) = (made_up::all(), made_up::all());
    assert!(first.len() > 5);
    for (a, b) in first.iter().zip(&second) {
        let svg = a.svg();
        assert_eq!(svg, b.svg());
        assert!(svg.len() < TOO_MANY, "{}", a.heading.name);
    }
}

#[test]
fn svg_is_well_formed_and_has_no_number_that_is_none() {
    for figure in all() {
        let svg = figure.svg();
        let name = &figure.heading.name;
        xml::check(&svg).unwrap_or_else(|e| panic!("{name}: {e}"));
        for word in ["NaN", "inf\"", "inf ", "-inf"] {
            assert!(!svg.contains(word), "{name} contains {word}");
        }
    }
}

#[test]
fn says_so_in_words_where_there_is_nothing_to_draw() {
    for figure in spare::all() {
        let svg = figure.svg();
        assert!(
            svg.contains("no data in this range"),
            "{}",
            figure.heading.name
        );
    }
}

#[test]
fn text_lies_inside_the_figure() {
    for figure in all() {
        let scene = figure.scene();
        let (width, height) = scene.size_px;
        for (text, e) in texts(&scene.finish()) {
            assert!(
                e.left >= 0.0
                    && e.top >= 0.0
                    && e.right <= f64::from(width)
                    && e.bottom <= f64::from(height),
                "{}: {text} at {e:?}",
                figure.heading.name,
            );
        }
    }
}

#[test]
fn text_does_not_lie_on_text() {
    let apart = |a: Rect, b: Rect| {
        a.right < b.left + 0.5
            || b.right < a.left + 0.5
            || a.bottom < b.top + 1.5
            || b.bottom < a.top + 1.5
    };
    for figure in all() {
        let svg = figure.svg();
        let texts = texts(&svg);
        for (i, (a, of_a)) in texts.iter().enumerate() {
            for (b, of_b) in &texts[i + 1..] {
                let name = &figure.heading.name;
                assert!(apart(*of_a, *of_b), "{name}: {a} on {b}");
            }
        }
    }
}

#[test]
fn a_kept_figure_is_drawn_as_before() {
    use super::{Chart, ChartAxis, ChartPanel, Mark, Series};
    let (axis, nan) = (|| ChartAxis::linear("", (0.0, 4.0)), f64::NAN);
    let (x, y) = (vec![1.0, 2.0, f64::INFINITY], vec![1.0, nan, 3.0]);
    let ends = vec![(0.5, 1.5), (nan, nan), (2.0, f64::INFINITY)];
    let line = Series::new("a", Mark::Line, x, y).with(ends);
    let panels = vec![ChartPanel::new("t", axis(), axis(), vec![line])];
    let heading = made_up::heading("kept", None);
    let gaps = Chart { heading, panels, columns: 1 }.figure("A gap.");
    let mut figures = made_up::all();
    figures.push(gaps);
    let mut kept = 0;
    for figure in &figures {
        // What is neither chart nor boxplots is not kept.
        let Ok(text) = serde_json::to_string(figure) else { continue };
        let back: Figure = serde_json::from_str(&text).unwrap();
        assert_eq!(back.svg(), figure.svg());
        assert_eq!(back.csv(), figure.csv());
        assert_eq!(back.reading, figure.reading);
        kept += 1;
    }
    assert_eq!(kept, figures.len() - 1);
}

#[test]
fn a_figure_of_other_motions_has_another_name() {
    use super::{Heading, Motions};
    let of = |motions| {
        let heading = Heading::numbered(6, "t", "d", Some(Arm::C));
        heading.of_motions(motions)
    };
    let both = [of(Motions::Recorded), of(Motions::Embedded)];
    let names = both.each_ref().map(|h| h.name.as_str());
    assert_eq!(names, ["figure-06-c-recorded", "figure-06-c"]);
    assert_eq!(both[0].label(), "Figure 6, grid C, recorded motions");
    assert!(both[0].is_beside(&both[1]));
    let others = [(6, Some(Arm::A)), (7, Some(Arm::C))];
    for (number, arm) in others {
        let other = Heading::numbered(number, "t", "d", arm);
        assert!(!other.is_beside(&both[0]), "{number}");
    }
    let beyond = made_up::heading("beyond", None);
    assert!(!beyond.is_beside(&beyond));
}

#[test]
fn csv_has_a_header_and_rows_of_its_length() {
    for figure in made_up::all() {
        let csv = figure.csv();
        let mut reader = csv::Reader::from_reader(csv.as_bytes());
        let width = reader.headers().unwrap().len();
        let rows = reader.records().map(|r| r.unwrap().len());
        let rows: Vec<usize> = rows.collect();
        assert!(!rows.is_empty(), "{}", figure.heading.name);
        assert!(rows.iter().all(|n| *n == width));
        assert!(csv.ends_with('\n') && !csv.contains("NaN"));
    }
}

#[test]
fn a_thinned_line_lies_within_a_tenth_of_a_pixel() {
    use super::{Chart, ChartAxis, ChartPanel, Mark, Series};
    let x: Vec<f64> = (0..3000).map(|k| 0.01 * f64::from(k)).collect();
    let wave = |t: &f64| libm::exp(-0.1 * t) * libm::sin(2.0 * t);
    let y: Vec<f64> = x.iter().map(wave).collect();
    let axis = |low, high| ChartAxis::linear("", (low, high));
    let mut line = Series::new("a", Mark::Line, x.clone(), y.clone());
    // The first of the points that cannot be drawn stays.
    line.x.extend([30.0, 30.1]);
    line.y.extend([f64::INFINITY; 2]);
    let (across, up) = (axis(0.0, 30.0), axis(-1.0, 1.0));
    let panels = vec![ChartPanel::new("", across, up, vec![line])];
    let heading = made_up::heading("thin", None);
    let chart = Chart { heading, panels, columns: 1 };
    let chart = chart.thinned((300.0, 200.0));
    let thin = &chart.panels[0].series[0];
    assert!(4 * thin.x.len() < x.len());
    assert_eq!(thin.x.last(), Some(&30.0));
    let mut at = 0;
    for (t, y) in x.iter().zip(&y) {
        while thin.x[at + 1] < *t {
            at += 1;
        }
        let (t0, t1) = (thin.x[at], thin.x[at + 1]);
        let (y0, y1) = (thin.y[at], thin.y[at + 1]);
        let rise = (y1 - y0) / (t1 - t0);
        let off = (y0 + rise * (t - t0) - y).abs() * 100.0;
        // In px, 300 of them for 30 s, 100 for 1.
        let px = off / (1.0 + (rise * 10.0) * (rise * 10.0)).sqrt();
        assert!(px < 0.1001, "{px}");
    }
}
