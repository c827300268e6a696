//! Can overturning be predicted from p and alpha alone? The surface that ships is
//! set against blocks that it was not fitted to, and against the study's own.

use rocking::statistics::ExtendedSample;

use super::answer::{Answer, Rows, number, word};
use crate::fits::Fits;
use crate::kept::Kept;
use crate::results::Results;
use rocking::integrator::Overturning;
use rocking_common::paper::{Intensity, SuiteKind, demand_index};
use rocking_draw::colour::{Ink, Pen};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Look, Mark, Series,
};
use rocking_draw::panel::Marker;
use rocking_surrogate::{
    FREQUENCY_RANGE_RAD_S, Fitted, RESTITUTION, Recorded, SHIFT, Surrogate,
};

const QUESTION: &str = "Can overturning be predicted from p and alpha alone, without an analysis?";

/// Slendernesses of the lines in the figure.
const LINES_RAD: [f64; 3] = [0.05, 0.25, 0.60];

/// Points of a line.
const POINTS: usize = 60;

/// Overturning of the study's own blocks, where its last arm has it.
fn own(results: &Results) -> Vec<Fitted> {
    let mut out = Vec::new();
    let Some(arm) = results.plan.arms.last() else { return out };
    for suite in SuiteKind::BOTH {
        let found = results.distributions(suite, *arm, Intensity::Pga);
        for block in found.iter().flat_map(|d| &d.blocks) {
            let sample = &block.samples[demand_index(1.0)];
            let sample = ExtendedSample::try_new(sample).ok();
            let Some(fit) = sample.and_then(|s| Fits::new(&s, SHIFT).ssfl)
            else {
                continue;
            };
            out.push(Fitted {
                suite,
                alpha_rad: block.alpha_rad,
                p_rad_s: block.p_rad_s,
                median: fit.median(),
                median_low: f64::NAN,
                median_high: f64::NAN,
                dispersion: fit.dispersion(),
                dispersion_low: f64::NAN,
                dispersion_high: f64::NAN,
            });
        }
    }
    out
}

pub(super) fn answer(results: &Results) -> anyhow::Result<Answer> {
    let surrogate = Surrogate::embedded()?;
    let own = own(results);
    let mut table = Rows::default();
    for (blocks, of) in [("study", &own), ("unseen", &surrogate.unseen)] {
        for (model, _) in &surrogate.models {
            for block in of.iter().filter(|b| b.suite == model.suite) {
                let found = model.at(block.alpha_rad, block.p_rad_s)?;
                let off =
                    found.distance(&block.lognormal()?).unwrap_or(f64::NAN);
                let (own, fitted) = (block.dispersion, found.dispersion());
                table.row_if(
                    blocks == "study",
                    vec![
                        ("suite", word(model.suite.name())),
                        ("blocks", word(blocks)),
                        ("p_rad_s", number(block.p_rad_s, 2)),
                        ("alpha_rad", number(block.alpha_rad, 2)),
                        ("median_by_analyses", number(block.median, 3)),
                        ("median_low", number(block.median_low, 3)),
                        ("median_high", number(block.median_high, 3)),
                        ("median_by_surface", number(found.median(), 3)),
                        ("dispersion_by_analyses", number(own, 3)),
                        ("dispersion_by_surface", number(fitted, 3)),
                        ("difference_in_probability", number(off, 3)),
                    ],
                );
            }
        }
    }
    let answer = table.answer(
        "surface",
        QUESTION,
        words(results, &surrogate, &own)?,
        "Overturning by a surface over p and alpha, and by analyses",
        "Intensity is PGA/(g tan alpha); the dispersion is that above the \
         uplift at 1; the difference is the largest one of the two \
         fragilities. Shown are the study's own blocks; intervals are of 95 \
         %, from resampled records.",
    );
    Ok(Answer { figures: vec![figure(&surrogate)?], ..answer })
}

fn words(
    results: &Results,
    surrogate: &Surrogate,
    own: &[Fitted],
) -> anyhow::Result<String> {
    let mut out = Vec::new();
    for (model, errors) in &surrogate.models {
        let records = surrogate.sampling(model.suite)?.median;
        out.push(format!(
            "{} motions, {} unseen blocks: the surface of {} coefficients has \
             an error of {:.1} % rms ({:.1} % at most) in the median, {:.1} % \
             ({:.1} %) in the dispersion, {:.3} ({:.3}) in probability. The \
             records alone leave ±{:.0} % of a block's median open: the \
             surface misses it by {} (rms).",
            rocking_common::words::capital(model.suite.name()),
            errors.blocks,
            model.terms.len(),
            100.0 * errors.median.rms,
            100.0 * errors.median.largest,
            100.0 * errors.dispersion.rms,
            100.0 * errors.dispersion.largest,
            errors.probability.rms,
            errors.probability.largest,
            100.0 * records,
            beside(errors.median.rms, records),
        ));
    }
    let setup = &results.plan.setup;
    let fitted = setup.restitution.velocity_ratio() == RESTITUTION
        && setup.overturning == Overturning::Alpha;
    let suites = match (results.embedded(), fitted) {
        (true, true) => "embedded suites, to which the surface is fitted",
        (true, false) => {
            "embedded suites, with another restitution or criterion than \
             those of the surface"
        }
        (false, true) => {
            "suites of this run, which the surface does not know: it is \
             fitted to the embedded ones"
        }
        (false, false) => {
            "suites of this run, with another restitution or criterion than \
             those of the surface, which is fitted to the embedded suites"
        }
    };
    for (model, _) in &surrogate.models {
        let errors = model.errors(own)?;
        if errors.blocks > 0 {
            out.push(format!(
                "At the study's {} blocks under {} motions ({suites}): {:.1} \
                 % rms ({:.1} % at most) in the median, {}; {:.3} ({:.3}) in \
                 probability.",
                errors.blocks,
                model.suite,
                100.0 * errors.median.rms,
                100.0 * errors.median.largest,
                beside(
                    errors.median.rms,
                    surrogate.sampling(model.suite)?.median,
                ),
                errors.probability.rms,
                errors.probability.largest,
            ));
        }
    }
    if results.embedded() && Kept::of(&results.plan.settings())?.is_some() {
        let kept = Recorded::kept()?;
        for (model, _) in &surrogate.models {
            let errors = model.to_recorded(&kept)?;
            out.push(format!(
                "Against the kept quantiles of {} blocks under recorded {} \
                 motions: {:.1} % rms ({:.1} % at most) in the median, \
                 {:.3} ({:.3}) in probability, the sampling of those records \
                 included.",
                errors.blocks,
                model.suite,
                100.0 * errors.median.rms,
                100.0 * errors.median.largest,
                errors.probability.rms,
                errors.probability.largest,
            ));
        }
    }
    out.push(format!(
        "The surface is of the embedded suites, eta = {RESTITUTION} and its \
         range alone."
    ));
    Ok(out.join(" "))
}

/// An error set beside what the choice of records leaves open.
fn beside(error: f64, records: f64) -> String {
    format!("{:.2} times what the records leave open", error / records)
}

fn figure(surrogate: &Surrogate) -> anyhow::Result<Figure> {
    let (low, high) = FREQUENCY_RANGE_RAD_S;
    let axis = || ChartAxis::logarithmic("*p* (rad/s)", (low, high));
    let places: Vec<f64> = (0..=POINTS)
        .map(|k| {
            let share = k as f64 / POINTS as f64;
            let p = low * libm::exp(libm::log(high / low) * share);
            p.min(high)
        })
        .collect();
    let kinds = [
        ("median", "median *PGA*/(*g* tan *α*)", (1.0, 12.0)),
        ("dispersion", "dispersion above uplift", (0.4, 1.2)),
    ];
    let mut panels = Vec::new();
    for (kind, (name, label, ends)) in kinds.into_iter().enumerate() {
        let of = |b: &Fitted| [b.median, b.dispersion][kind];
        for (model, _) in &surrogate.models {
            let mut series = Vec::new();
            for alpha in LINES_RAD {
                let line = places
                    .iter()
                    .map(|p| {
                        let found = model.at(alpha, *p)?;
                        let both = [found.median(), found.dispersion()];
                        Ok(both[kind])
                    })
                    .collect::<anyhow::Result<Vec<f64>>>()?;
                series.push(Series::new(
                    format!("surface, *α* = {alpha:.2} rad"),
                    Mark::Line,
                    places.clone(),
                    line,
                ));
            }
            let blocks: Vec<&Fitted> = surrogate
                .unseen
                .iter()
                .filter(|b| b.suite == model.suite)
                .collect();
            series.push(Series::new(
                "100 unseen blocks, by analyses",
                Mark::Points,
                blocks.iter().map(|b| b.p_rad_s).collect(),
                blocks.iter().map(|b| of(b)).collect(),
            ));
            panels.push(ChartPanel {
                title: format!("{}: {name}", model.suite),
                x: axis(),
                y: ChartAxis::logarithmic(label, ends),
                series,
            });
        }
    }
    for (model, _) in &surrogate.models {
        panels.push(errors(surrogate, model.suite, axis())?);
    }
    let heading = Heading::new(
        "figure-surface",
        "Overturning by a surface over p and alpha",
        "Above, the median overturning intensity against p for three \
         slendernesses, with 100 blocks to which the surface was not fitted; \
         in the middle the dispersion; below, the relative error of the \
         median at those blocks; ordinary and pulse-type suites.",
    );
    Ok(Chart { heading, panels, columns: 2 }.figure(
        "Lines are the surface, marks are analyses of blocks that it was not \
         fitted to; below is what lies between them, with the 95 % interval \
         of each block's own median.",
    ))
}

/// Relative error of the median at the unseen blocks, in %; the bars are the
/// intervals of their own medians, turned about the error.
fn errors(
    surrogate: &Surrogate,
    suite: SuiteKind,
    axis: ChartAxis,
) -> anyhow::Result<ChartPanel> {
    let (mut x, mut y, mut interval) = (Vec::new(), Vec::new(), Vec::new());
    for (model, _) in surrogate.models.iter().filter(|m| m.0.suite == suite) {
        for block in surrogate.unseen.iter().filter(|b| b.suite == suite) {
            let found = model.at(block.alpha_rad, block.p_rad_s)?.median();
            let off = |own: f64| 100.0 * (found / own - 1.0);
            x.push(block.p_rad_s);
            y.push(off(block.median));
            interval.push((off(block.median_high), off(block.median_low)));
        }
    }
    let (low, high) = FREQUENCY_RANGE_RAD_S;
    let bars = Some(Pen::new(Ink::Muted, 0.4));
    let look = Look { bars, ..Look::marks(Marker::Dot, 2.2, Ink::Series(0)) };
    Ok(ChartPanel {
        title: format!("{suite}: error of the median"),
        x: axis,
        y: ChartAxis::linear("surface − analyses (%)", (-30.0, 30.0)),
        series: vec![
            Series::new("", Mark::Dashed, vec![low, high], vec![0.0, 0.0]),
            Series::of(look, x, y)
                .with(interval)
                .labelled("error, with the records' 95 %")
                .keyed(["error".into()]),
        ],
    })
}

#[cfg(test)]
mod tests {
    use super::beside;

    #[test]
    fn an_error_is_set_beside_the_records_by_its_number() {
        // 10.9 % of ±10 % is not small.
        let large = beside(0.109, 0.10);
        assert!(large.starts_with("1.09 times"), "{large}");
        assert!(!large.contains("small"));
        assert!(beside(0.009, 0.10).starts_with("0.09 times"));
    }
}
