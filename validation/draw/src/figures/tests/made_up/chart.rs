//! A chart of every mark.

use super::heading;
use crate::axis::Axis;
use crate::colour::{Fill, Ink, Pen};
use crate::figures::*;
use crate::text::Horizontal;

/// Every mark over linear, logarithmic and named axes.
pub fn chart() -> Chart {
    let x: Vec<f64> = (1..=20).map(f64::from).collect();
    let series = |(k, (label, mark)): (usize, (&str, Mark))| {
        let y = x.iter().map(|x| (1.0 + k as f64) * (1.0 + 0.1 * x));
        let y: Vec<f64> = y.collect();
        let ends = y.iter().map(|y| (0.9 * y, 1.2 * y)).collect();
        Series::new(label, mark, x.clone(), y).with(ends)
    };
    let line = Some(Pen::new(Ink::Text, 0.8));
    let marks = [
        ("band", Mark::Line),
        ("dashed", Mark::Dashed),
        ("points", Mark::Points),
        ("joined", Mark::LineAndPoints),
        ("dashed and joined", Mark::DashedAndPoints),
        ("", Mark::Own(Look { pen: line, ..Look::default() })),
    ];
    let marks = || marks.into_iter().enumerate().map(series);
    let pen = Pen::new(Ink::Muted, 0.6);
    let note = |mark, words| Series::note(mark, words, (4.0, 3.0));
    let bins = Look {
        pen: line,
        bins: Some(Fill::tint(Ink::Text, 30)),
        ..Look::default()
    };
    let bins = Series::of(bins, vec![1.0, 2.0, 3.0], vec![4.0, 2.0, 0.0]);
    let notes = [
        bins,
        note(Mark::Across(pen), ""),
        note(Mark::Upright(pen), ""),
        note(Mark::Corner, "above"),
        note(Mark::Corner, "below"),
        note(Mark::Edge, "50 %"),
        note(Mark::Edge, "16 %"),
    ];
    let fallen = Series::new(
        "quantiles",
        Mark::Quantiles,
        vec![0.1, 0.5, f64::INFINITY],
        vec![1.0, 2.0, 3.0],
    );
    let ends = [(0.1, 0.2), (0.3, f64::INFINITY), (0.6, f64::INFINITY)];
    let words = Mark::Words(Horizontal::Left);
    let names = ["option 1", "option 2", "option 3"].map(String::from);
    let linear = |label: &str| ChartAxis::linear(label, None::<(f64, f64)>);
    let log = |label: &str| ChartAxis::logarithmic(label, (0.5, 50.0));
    let panels = vec![
        ChartPanel::new("linear\nbelow it", linear("*x*"), linear("*y*"), {
            marks().chain(notes).collect()
        }),
        ChartPanel::new(
            "logarithmic",
            log("*x* (s)").with_second(1e3, "*x* (ms)"),
            log("*y*"),
            marks().collect(),
        ),
        ChartPanel::new(
            "named",
            ChartAxis::named(names.into()),
            linear("power"),
            marks().take(3).collect(),
        ),
        ChartPanel::new(
            "overturned",
            Axis::linear(0.0, 1.08, 5).label("demand"),
            Axis::linear(0.0, 4.0, 5).label("intensity"),
            vec![
                fallen.with(ends.into()),
                Series::note(words, "word", (0.6, 3.5)),
            ],
        ),
    ];
    let heading = heading("figure-marks", None);
    Chart { heading, panels, columns: 2 }
}
