//! Figures 6, 7 and 9: paired ratios by stripe.

use rocking_statistics::paired::Pairs;
use rocking_statistics::{Boxplot, ExtendedSample, QuantileType};

use crate::analyses::{StripeDemands, SuiteResults};
use crate::estimates::median;
use crate::inference::least_counted;
use crate::stripes::adjusted_slenderness;
use crate::words::paper_heading;
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, LEAST_USABLE, REFERENCE, SLENDERNESSES_RAD,
    closed_form,
};
use rocking_common::words::{percent, range};
use rocking_draw::figures::Figure;
use rocking_draw::figures::{BoxPanel, Boxplots, Stripe};

/// Figure 6 (p = 1) or 7 (p = 3 and 4).
pub(super) fn slendernesses(
    suite: &SuiteResults,
    arm: Arm,
    number: u32,
) -> anyhow::Result<Figure> {
    let stripes = suite.stripes(arm)?;
    let frequencies: &[usize] = if number == 6 { &[0] } else { &[1, 2] };
    let mut panels = Vec::new();
    for frequency in frequencies {
        for (slenderness, alpha_rad) in
            SLENDERNESSES_RAD.into_iter().enumerate()
        {
            if slenderness != REFERENCE {
                let own = Some(slenderness);
                panels.push(BoxPanel {
                    p_rad_s: FREQUENCIES_RAD_S[*frequency],
                    alpha_rad,
                    stripes: boxes(suite, stripes, *frequency, own)?,
                });
            }
        }
    }
    let reading = medians_in_words(&panels);
    let heading = paper_heading(number, Some(arm));
    let ratio_label = "*r*_{α} = *θ̃*_{α} / *θ̃*_{0.10}".into();
    let boxes = Boxplots { ratio_label, panels };
    Ok(boxes.figure(&heading, reading))
}

/// Figure 9.
pub(super) fn adjusted(
    suite: &SuiteResults,
    arm: Arm,
) -> anyhow::Result<Figure> {
    let alpha_rad = SLENDERNESSES_RAD[REFERENCE];
    let panels: Vec<BoxPanel> = adjusted_boxes(suite, arm)?
        .into_iter()
        .map(|(p_rad_s, stripes)| BoxPanel { p_rad_s, alpha_rad, stripes })
        .collect();
    let reading = medians_in_words(&panels);
    let heading = paper_heading(9, Some(arm));
    let ratio_label = "*θ̃*_{adjusted} / *θ̃*_{scaled}".into();
    let boxes = Boxplots { ratio_label, panels };
    Ok(boxes.figure(&heading, reading))
}

/// Boxes of Figure 9 by frequency parameter.
pub(crate) fn adjusted_boxes(
    suite: &SuiteResults,
    arm: Arm,
) -> anyhow::Result<Vec<(f64, Vec<Stripe>)>> {
    let stripes = suite.stripes(arm)?;
    FREQUENCIES_RAD_S
        .into_iter()
        .enumerate()
        .map(|(frequency, p)| Ok((p, boxes(suite, stripes, frequency, None)?)))
        .collect()
}

/// Boxes of the stripes with at least ten usable ratios.
fn boxes(
    suite: &SuiteResults,
    stripes: &StripeDemands,
    frequency: usize,
    slenderness: Option<usize>,
) -> anyhow::Result<Vec<Stripe>> {
    let mut boxes = Vec::new();
    for (level, own, scaled) in stripes.compared(frequency, slenderness) {
        let ratios = Pairs::try_new(own, scaled)?.ratios;
        if ratios.len() < LEAST_USABLE {
            break;
        }
        let sample = ExtendedSample::try_new(&ratios)?;
        boxes.push(Stripe {
            level,
            usable: ratios.len(),
            records: own.len(),
            closed_form: Some(match slenderness {
                Some(s) => closed_form(SLENDERNESSES_RAD[s]),
                None => adjusted_form(suite, level, own, scaled),
            }),
            summary: Some(Boxplot::try_new(&sample, QuantileType::default())?),
        });
    }
    Ok(boxes)
}

/// Median of the closed form over the records with a usable ratio on a stripe of
/// Figure 9, each at its adjusted slenderness.
fn adjusted_form(
    suite: &SuiteResults,
    level: f64,
    adjusted: &[f64],
    scaled: &[f64],
) -> f64 {
    let stands = adjusted.iter().zip(scaled).zip(&suite.records);
    let expected: Vec<f64> = stands
        .filter(|((a, b), _)| a.is_finite() && b.is_finite())
        .map(|(_, r)| closed_form(adjusted_slenderness(r, level)))
        .collect();
    median(&expected).value()
}

fn medians_in_words(panels: &[BoxPanel]) -> String {
    let stripes = || panels.iter().flat_map(|p| &p.stripes);
    let medians =
        stripes().filter_map(|s| s.summary.as_ref()).map(|b| b.median);
    let (low, high) = range(medians);
    let (least, _) = range(stripes().map(Stripe::usable_share));
    // Only boxes with enough ratios count.
    let all = stripes().map(|s| s.records).max().unwrap_or(0);
    let counted = least_counted(all);
    let many = stripes().filter(|s| s.usable >= counted);
    let (_, off) = range(many.map(|s| {
        let of = s.closed_form.unwrap_or(1.0);
        let b = s.summary.as_ref();
        b.map_or(f64::NAN, |b| (b.median / of - 1.0).abs())
    }));
    format!(
        "Medians with exact 95 % intervals against the closed form (sin \
         alpha/alpha)/(sin 0.1/0.1), and boxplots as in the paper. Medians of \
         at least {counted} ratios are within {} of the closed form; all {} \
         medians are between {low:.3} and {high:.3}. Percentages on the \
         right: share of usable ratios, at least {}. Boxes of fewer than 20 \
         ratios have no notch.",
        percent(off, 2),
        stripes().count(),
        percent(least, 1)
    )
}
