//! Figures 1 to 5: the block, and single records.

use crate::analyses::no_arm;
use crate::analyses::{HISTORY_INTERVAL_S, SuiteResults};
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, SLENDERNESSES_RAD, position,
};
use rocking_draw::figures::Figure;
use rocking_draw::figures::{
    BlockSketch, Heading, Histories, History, HistoryPanel, IdaCurve,
    IdaCurves, IdaPanel,
};

pub(super) fn sketch() -> Figure {
    BlockSketch {
        heading: Heading::numbered(
            1,
            false,
            "The rocking block",
            "A rectangular block of width 2b and height 2h, rotated about one \
             base corner; R is half its diagonal and alpha the angle between \
             diagonal and side.",
            None,
        ),
        alpha_rad: 0.35,
        rotation_rad: 0.15,
    }
    .figure(
        "A block starts to rock when the ground acceleration exceeds g tan \
         alpha; at theta = alpha its weight no longer rights it."
            .into(),
    )
}

pub(super) fn histories(
    suite: &SuiteResults,
    arm: Arm,
    number: u32,
) -> Figure {
    let panels = suite
        .single
        .iter()
        .zip(FREQUENCIES_RAD_S)
        .flat_map(|(single, p_rad_s)| {
            suite.chosen.iter().zip(&single.histories).map(
                move |(record, histories)| HistoryPanel {
                    p_rad_s,
                    record: suite.records[*record].name.clone(),
                    im: single.im,
                    curves: histories
                        .iter()
                        .zip(SLENDERNESSES_RAD)
                        .map(|((ratio, overturned), alpha_rad)| {
                            history(alpha_rad, ratio, *overturned)
                        })
                        .collect(),
                },
            )
        })
        .collect();
    let title = format!(
        "Response histories under three {} motions at equal intensity",
        suite.kind
    );
    Histories {
        heading: Heading::numbered(
            number,
            false,
            title,
            "Rotation over slenderness against time, five slendernesses in \
             each panel; rows by frequency parameter, columns by record.",
            Some(arm),
        ),
        panels,
        columns: 3,
    }
    .thinned()
    .figure(apart_in_words(suite))
}

/// The history to rest.
fn history(alpha_rad: f64, ratio: &[f64], overturned: bool) -> History {
    let end = ratio.iter().rposition(|y| *y != 0.0).map_or(2, |i| i + 2);
    let ratio = ratio[..end.min(ratio.len())].to_vec();
    let time_s =
        (0..ratio.len()).map(|i| i as f64 * HISTORY_INTERVAL_S).collect();
    History { alpha_rad, time_s, ratio, overturned }
}

fn apart_in_words(suite: &SuiteResults) -> String {
    let by_frequency: Vec<String> = suite
        .single
        .iter()
        .zip(FREQUENCIES_RAD_S)
        .map(|(single, p)| {
            let distance = single.median_of(|a| a.distance);
            format!("{distance:.3} at p = {p}")
        })
        .collect();
    format!(
        "Over all {} records the median normalized distance of a history to \
         that of alpha = 0.10 is {}.",
        suite.records.len(),
        by_frequency.join(", ")
    )
}

pub(super) fn curves(
    suite: &SuiteResults,
    arm: Arm,
    number: u32,
) -> anyhow::Result<Figure> {
    let all = suite.curves(arm).ok_or_else(no_arm)?;
    let mut panels = Vec::new();
    for (frequency, p_rad_s) in FREQUENCIES_RAD_S.into_iter().enumerate() {
        for record in suite.chosen {
            let curves = SLENDERNESSES_RAD
                .iter()
                .enumerate()
                .map(|(slenderness, alpha_rad)| {
                    let block = position(frequency, slenderness);
                    let curve = &all[block][record];
                    let (im, edp): (Vec<f64>, Vec<f64>) =
                        curve.vertices().unzip();
                    IdaCurve {
                        alpha_rad: *alpha_rad,
                        im,
                        edp,
                        overturning_im: curve.overturning_im(),
                    }
                })
                .collect();
            panels.push(IdaPanel {
                p_rad_s,
                record: suite.records[record].name.clone(),
                curves,
            });
        }
    }
    let differences: Vec<String> = suite
        .single
        .iter()
        .zip(FREQUENCIES_RAD_S)
        .map(|(single, p)| {
            let apart = single.median_of(|a| a.mean_ln_im);
            format!("{:.2} % at p = {p}", 100.0 * apart)
        })
        .collect();
    Ok(IdaCurves {
        heading: Heading::numbered(
            number,
            false,
            format!(
                "IDA curves of three {} motions, five slendernesses",
                suite.kind
            ),
            "Peak rotation over slenderness against dimensionless intensity \
             up to first overturning; rows by frequency parameter, columns by \
             record.",
            Some(arm),
        ),
        panels,
        columns: 3,
    }
    .thinned()
    .figure(format!(
        "Over all {} records the intensity that reaches a given demand \
             differs from that of alpha = 0.10 by a median of {}.",
        suite.records.len(),
        differences.join(", ")
    )))
}
