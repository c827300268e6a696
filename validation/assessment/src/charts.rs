//! The drawings of an assessment.

use rocking_draw::colour::{Fill, Ink, Pen};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Heading, Look, Mark, Series,
};
use rocking_draw::markup;
use rocking_draw::panel::Marker;
use rocking_procedures::StripeResponses;
use rocking_procedures::assess::{Assessment, ObjectAssessment};

use crate::words::measure;

/// Fragility, response and, under a hazard curve, risk by intensity.
pub(crate) fn curves(
    found: &Assessment,
    one: &ObjectAssessment,
    k: usize,
) -> Chart {
    let axis = format!("{} ({})", measure(found), found.unit);
    let mut panels = vec![fragility(one, &axis), response(one)];
    panels.extend(risk(one, &axis));
    let columns = panels.len();
    let heading = Heading::new(
        format!("object-{k}"),
        format!("Curves of {}", markup::escape(&one.facts.object.label)),
        "Fragility, response and risk of one object.",
    );
    Chart { heading, panels, columns }
}

fn fragility(one: &ObjectAssessment, axis: &str) -> ChartPanel {
    let band = one.band.iter().flat_map(|b| &b.points);
    let last = one.answer.fitted.quantile(0.98);
    let band: Vec<_> = band.filter(|p| p.intensity <= last).collect();
    let x: Vec<f64> = band.iter().map(|p| p.intensity).collect();
    let y = band.iter().map(|p| p.probability.value()).collect();
    let ends = band.iter().map(|p| p.probability.ends()).collect();
    let n = one.by_record.len() as f64;
    let damaged = one.by_record.iter().filter(|r| r.damages).map(|r| r.im);
    let damaged: Vec<f64> = damaged.filter(|im| *im <= last).collect();
    let place = (0..damaged.len()).map(|k| (k as f64 + 0.5) / n).collect();
    let dots = Look::marks(Marker::of_series(0), 2.0, Ink::Muted);
    ChartPanel::new(
        "Probability of damage",
        ChartAxis::linear(axis, (0.0, last)),
        ChartAxis::linear("probability", (0.0, 1.0)),
        vec![
            Series::new("fit and 95 % band", Mark::Line, x, y).with(ends),
            Series::of(dots, damaged, place),
        ],
    )
}

fn response(one: &ObjectAssessment) -> ChartPanel {
    let quantile = |name: &str, of: fn(&StripeResponses) -> f64| {
        let y = one.ida.iter().map(|s| s.intensity).collect();
        Series::new(name, Mark::Line, one.ida.iter().map(of).collect(), y)
    };
    ChartPanel::new(
        "Rotation",
        ChartAxis::linear("largest rotation / alpha", (0.0, 1.2)),
        ChartAxis::linear(
            match one.facts.object.floor {
                None => "PGA (g)",
                Some(_) => "peak acceleration of the floor (g)",
            },
            None::<(f64, f64)>,
        ),
        vec![
            quantile("16 %", |s| s.edp16),
            quantile("50 %", |s| s.edp50),
            quantile("84 %", |s| s.edp84),
        ],
    )
}

fn risk(one: &ObjectAssessment, axis: &str) -> Option<ChartPanel> {
    let last = one.contributions.last()?;
    let parts = one.contributions.iter().map(|c| c.annual_frequency);
    let total: f64 = parts.clone().sum();
    let parts: Vec<f64> = parts.map(|c| 100.0 * c / total).collect();
    let edges = one.contributions.iter().map(|c| c.from_im);
    let edges: Vec<f64> = edges.chain([last.to_im]).collect();
    let look = Look {
        bins: Some(Fill::tint(Ink::Series(1), 30)),
        pen: Some(Pen::new(Ink::Series(1), 0.8)),
        ..Look::default()
    };
    let most = parts.iter().copied().fold(0.0, f64::max);
    Some(ChartPanel::new(
        "Where the risk comes from",
        ChartAxis::logarithmic(axis, Some((edges[0], last.to_im))),
        ChartAxis::linear("% of the annual frequency", (0.0, 1.1 * most)),
        vec![Series::of(look, edges, parts)],
    ))
}
