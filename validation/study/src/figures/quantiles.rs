//! Figures 8 and 10: quantiles of the demand given the intensity.

use rayon::prelude::*;
use rocking::capacity::ResponseCurve;

use crate::analyses::SuiteResults;
use crate::analyses::no_arm;
use crate::estimates::three_quantiles;
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, REFERENCE, SLENDERNESSES_RAD, position,
};
use rocking_common::words::{percent, range};
use rocking_draw::figures::Figure;
use rocking_draw::figures::{
    Heading, QuantileGroup, QuantilePanel, Quantiles,
};

/// Most points of a line.
const MOST_POINTS: usize = 160;

/// Figure 8: a row a frequency parameter, a column an arm.
pub(super) fn slendernesses(
    suite: &SuiteResults,
    arms: &[Arm],
) -> anyhow::Result<Figure> {
    let mut by_arm = Vec::new();
    for arm in arms {
        let curves = suite.curves(*arm).ok_or_else(no_arm)?;
        by_arm.push(panels(|frequency| {
            SLENDERNESSES_RAD
                .iter()
                .enumerate()
                .map(|(slenderness, alpha)| {
                    let label = format!("*α* = {alpha:.2} rad");
                    group(label, &curves[position(frequency, slenderness)])
                })
                .collect()
        })?);
    }
    let words = spread_in_words(arms, &by_arm);
    let mut panels = Vec::new();
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for (arm, own) in arms.iter().zip(&by_arm) {
            let note = format!("arm {}", arm.letter());
            panels.push(QuantilePanel { note, ..own[frequency].clone() });
        }
    }
    Ok(Quantiles {
        heading: Heading::numbered(
            8,
            false,
            "16/50/84 % demand given intensity, five slendernesses",
            "Three quantile curves for each slenderness; a row a frequency \
             parameter, a column an arm of the grid, both on the same \
             scale; a curve ends where its quantile is overturned.",
            None,
        ),
        panels,
        columns: arms.len(),
    }
    .figure(words))
}

/// Intensity at which the median is overturning.
fn median_overturns(group: &QuantileGroup) -> Option<f64> {
    let at = group.quantiles[1].iter().position(|q| q.is_infinite())?;
    Some(group.im[at])
}

/// How far the slendernesses are apart where the median overturns.
fn spread_in_words(arms: &[Arm], by_arm: &[Vec<QuantilePanel>]) -> String {
    let mut out = Vec::new();
    for (arm, panels) in arms.iter().zip(by_arm) {
        let spreads: Vec<String> = panels
            .iter()
            .map(|panel| {
                let first = |g| median_overturns(g).unwrap_or(f64::NAN);
                let (low, high) = range(panel.groups.iter().map(first));
                format!(
                    "{} at p = {}",
                    percent(high / low - 1.0, 1),
                    panel.p_rad_s
                )
            })
            .collect();
        out.push(format!(
            "On arm {} the five medians overturn within {} of one another.",
            arm.letter(),
            spreads.join(", ")
        ));
    }
    out.join(" ")
}

pub(super) fn adjusted(
    suite: &SuiteResults,
    arm: Arm,
) -> anyhow::Result<Figure> {
    let curves = suite.curves(arm).ok_or_else(no_arm)?;
    let adjusted = suite.adjusted.iter().find(|a| a.arm == arm);
    let panels = panels(|frequency| {
        let scaled = &curves[position(frequency, REFERENCE)];
        let mut groups = vec![group("scaled records".into(), scaled)?];
        if let Some(adjusted) = adjusted {
            groups.push(group(
                "adjusted slenderness".into(),
                &adjusted.curves[frequency],
            )?);
        }
        Ok(groups)
    })?;
    let words = overturning_in_words(&panels);
    Ok(Quantiles {
        heading: Heading::numbered(
            10,
            true,
            "16/50/84 % demand given intensity: scaled records \
                        and adjusted slenderness",
            "Three quantile curves for each procedure, one panel a frequency \
             parameter; alpha = 0.10 for the scaled records.",
            Some(arm),
        ),
        panels,
        columns: 3,
    }
    .figure(format!(
        "The median demand becomes overturning {words}, by procedure."
    )))
}

fn panels(
    groups: impl Fn(usize) -> anyhow::Result<Vec<QuantileGroup>>,
) -> anyhow::Result<Vec<QuantilePanel>> {
    FREQUENCIES_RAD_S
        .into_iter()
        .enumerate()
        .map(|(frequency, p_rad_s)| {
            let groups = groups(frequency)?;
            Ok(QuantilePanel { p_rad_s, note: String::new(), groups })
        })
        .collect()
}

/// Quantiles at the levels that the scan ran, up to the first at which the
/// 16 % quantile has overturned; evenly thinned where there are many.
pub(crate) fn group(
    label: String,
    curves: &[ResponseCurve],
) -> anyhow::Result<QuantileGroup> {
    // All curves of a block share their levels; the longest has them all.
    let mut levels: Vec<f64> = Vec::new();
    for curve in curves {
        let own: Vec<f64> = curve.vertices().map(|(im, _)| im).collect();
        if own.len() > levels.len() {
            levels = own;
        }
    }
    let overturned_at = |im: f64| {
        let gone = |c: &&ResponseCurve| {
            c.overturning_im().is_some_and(|first| first <= im)
        };
        curves.iter().filter(gone).count()
    };
    let most = (0.84 * curves.len() as f64).ceil() as usize;
    let end = levels.partition_point(|im| overturned_at(*im) <= most);
    levels.truncate(end + 1);
    let stride = levels.len().div_ceil(MOST_POINTS).max(1);
    let im: Vec<f64> = levels.iter().copied().step_by(stride).collect();
    let at: Vec<[f64; 3]> = im
        .par_iter()
        .map(|im| three(curves, *im))
        .collect::<Result<_, _>>()?;
    let of = |i: usize| at.iter().map(|q| q[i]).collect();
    Ok(QuantileGroup { label, im, quantiles: [0, 1, 2].map(of) })
}

/// 16, 50 and 84 % quantile of the demand at an intensity; overturned
/// counts as infinite.
pub(crate) fn three(
    curves: &[ResponseCurve],
    im: f64,
) -> anyhow::Result<[f64; 3]> {
    // Between the last standing level and a refined overturning the curve
    // says nothing; the block stands there.
    let demands: Vec<f64> = curves
        .iter()
        .map(|c| {
            let last = || c.vertices().last().map_or(0.0, |(_, e)| e);
            c.edp_at(im).unwrap_or_else(last)
        })
        .collect();
    three_quantiles(&demands)
}

fn overturning_in_words(panels: &[QuantilePanel]) -> String {
    let by_panel: Vec<String> = panels
        .iter()
        .map(|panel| {
            let firsts: Vec<String> = panel
                .groups
                .iter()
                .map(|g| {
                    let at = median_overturns(g);
                    at.map_or("never".into(), |im| format!("{im:.2}"))
                })
                .collect();
            format!("at {} for p = {}", firsts.join(", "), panel.p_rad_s)
        })
        .collect();
    by_panel.join("; ")
}
