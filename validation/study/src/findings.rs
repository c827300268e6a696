//! Everything that a study found, as [`Findings`].

use rocking_records::{AsideCount, SetAside};
use rocking_statistics::Proportion;

use crate::analyses::SuiteResults;
use crate::estimates;
use crate::figures::adjusted_boxes;
use crate::questions::{self, Answer};
use crate::results::Results;
use crate::runs::capacities_at;
use crate::sensitivities::Choice;
use crate::stripes::adjusted_split;
use rocking_common::findings::{
    Aside, Claim, Findings, Measured, Place, Quantity, Row, SCHEMA, Suite,
    Table, Topic, Unit,
};
use rocking_common::paper::{BLOCKS, FREQUENCIES_RAD_S, SLENDERNESSES_RAD};
use rocking_common::suites::earthquakes;
use rocking_draw::figures::Stripe;

/// All findings of a study.
///
/// # Errors
/// Where a number cannot be computed.
pub fn all(
    results: &Results,
    claims: Vec<Claim>,
    answers: &[Answer],
) -> anyhow::Result<Findings> {
    Ok(Findings {
        schema: SCHEMA,
        version: env!("CARGO_PKG_VERSION").into(),
        settings: results.plan.settings(),
        suites: results.suites().map(suite).into(),
        claims,
        tables: vec![
            shares(results),
            adjustment(results)?,
            overturning(results),
            resurrections(results),
            single(results),
            varied(results)?,
            uplift(results),
        ],
        questions: questions::findings(answers),
    })
}

/// A suite of a study, and the work on it.
fn suite(suite: &SuiteResults) -> Suite {
    let certainty = &suite.work.certainty;
    let name = |record: &usize| suite.records[*record].name.clone();
    Suite {
        kind: suite.kind,
        source: suite.source.to_string(),
        component_rule: suite.component_rule.clone(),
        records: suite.records.len(),
        earthquakes: earthquakes(&suite.clusters),
        sha256: suite.sha256.clone(),
        list: suite.list.clone(),
        shown_alone: suite.chosen.iter().map(name).collect(),
        remarks: suite.remarks.clone(),
        set_aside: set_aside(&suite.set_aside),
        analyses: suite.work.analyses,
        unresolved: certainty.unresolved,
        first_overturnings_reevaluated: certainty.reevaluated,
        largest_shift_if_flipped: certainty.largest_shift,
    }
}

/// What a suite set aside, by reason.
#[must_use]
pub fn set_aside(found: &SetAside) -> Vec<Aside> {
    let reason = |count: AsideCount<'_>| Aside {
        code: count.reason.code().into(),
        files: count.files,
        first: count.first.into(),
    };
    found.counts().into_iter().map(reason).collect()
}

fn quantity(name: &str, unit: Unit, words: &str) -> Quantity {
    Quantity { name: name.into(), unit, words: words.into() }
}

fn count(n: usize) -> Measured {
    Measured::exact(n as f64)
}

/// How many records uplift each block without being scaled.
fn uplift(results: &Results) -> Table {
    let row = |block| Row {
        at: Place::of(block),
        values: results
            .suites()
            .map(|suite| count(suite.uplift_unscaled(block)))
            .into(),
    };
    Table {
        topic: Topic::UpliftUnscaled,
        quantities: vec![
            quantity(
                "ordinary",
                Unit::Count,
                "ordinary records that move the block",
            ),
            quantity(
                "pulse_type",
                Unit::Count,
                "pulse-type records that move the block",
            ),
        ],
        rows: BLOCKS.iter().map(row).collect(),
    }
}

fn shares(results: &Results) -> Table {
    let mut rows = Vec::new();
    for d in &results.distributions {
        for block in &d.blocks {
            let (original, shifted) = block.shares();
            let values = [block.shift, original, shifted];
            rows.push(Row {
                at: Place {
                    suite: Some(d.kind),
                    arm: Some(d.arm),
                    intensity: Some(d.intensity),
                    p_rad_s: Some(block.p_rad_s),
                    alpha_rad: Some(block.alpha_rad),
                    ..Place::default()
                },
                values: values.map(Measured::exact).into(),
            });
        }
    }
    let share = "share of demand levels accepted as";
    let (plain, shifted) =
        (format!("{share} lognormal"), format!("{share} shifted lognormal"));
    Table {
        topic: Topic::AcceptedShares,
        quantities: vec![
            quantity("im_r", Unit::One, "shift IM_R"),
            quantity("original", Unit::Share, &plain),
            quantity("shifted", Unit::Share, &shifted),
        ],
        rows,
    }
}

fn resurrections(results: &Results) -> Table {
    let stripes = &results.ordinary.stripes;
    let rows = stripes.iter().map(|stripes| {
        let demands = stripes.demands.iter().flatten().flatten();
        let again = stripes.stands_again.iter().flatten().flatten();
        Row {
            at: Place { arm: Some(stripes.arm), ..Place::default() },
            values: vec![
                count(demands.filter(|d| d.is_infinite()).count()),
                count(again.filter(|again| **again).count()),
            ],
        }
    });
    Table {
        topic: Topic::Resurrections,
        quantities: vec![
            quantity("overturned", Unit::Count, "overturned on a stripe"),
            quantity(
                "stand_again",
                Unit::Count,
                "overturned on a stripe that stand at that intensity",
            ),
        ],
        rows: rows.collect(),
    }
}

fn single(results: &Results) -> Table {
    let mut rows = Vec::new();
    for suite in results.suites() {
        for row in estimates::single_rows(suite) {
            let ratios = [row.distance, row.peak_ratio, row.mean_ln_im];
            let mut values = vec![count(row.usable)];
            values.push(Measured::exact(row.im));
            values.extend(ratios.map(Measured::exact));
            let at = Place {
                suite: Some(suite.kind),
                p_rad_s: Some(row.p_rad_s),
                ..Place::default()
            };
            rows.push(Row { at, values });
        }
    }
    Table {
        topic: Topic::SingleRecords,
        quantities: vec![
            quantity("usable", Unit::Count, "usable histories"),
            quantity(
                "im_pga",
                Unit::One,
                "PGA/(g tan alpha) of the histories",
            ),
            quantity(
                "median_distance",
                Unit::Distance,
                "median normalized distance of histories to alpha = 0.10",
            ),
            quantity(
                "median_peak_ratio",
                Unit::One,
                "median ratio of peaks to alpha = 0.10",
            ),
            quantity(
                "median_ln_im",
                Unit::Distance,
                "median |ln| of the ratio of intensities to alpha = 0.10",
            ),
        ],
        rows,
    }
}

fn varied(results: &Results) -> anyhow::Result<Table> {
    let mut rows = Vec::new();
    for (v, base) in results.varied(&Choice::ALL)? {
        let own = capacities_at(v.curves.iter().map(Option::as_ref), 1.0)?;
        let base = capacities_at(base.iter().map(Some), 1.0)?;
        let ratios = own.iter().zip(&base).map(|(own, base)| own / base);
        let ratios: Vec<f64> =
            ratios.filter(|x| x.is_finite() && *x > 0.0).collect();
        let at = Place {
            choice: Some(v.choice.name().into()),
            p_rad_s: Some(FREQUENCIES_RAD_S[v.frequency]),
            alpha_rad: Some(SLENDERNESSES_RAD[v.slenderness]),
            edp: Some(1.0),
            ..Place::default()
        };
        let ratio = estimates::median(&ratios);
        rows.push(Row { at, values: vec![count(ratios.len()), ratio] });
    }
    Ok(Table {
        topic: Topic::Sensitivities,
        quantities: vec![
            quantity("usable", Unit::Count, "usable pairs"),
            quantity(
                "median_ratio",
                Unit::One,
                "median ratio of capacities, this choice over the study's",
            ),
        ],
        rows,
    })
}

/// Figure 9, a row a box: usable count with its exact 95 % interval, and
/// median; the same apart by whether the adjusted slenderness is within the
/// paper's.
fn adjustment(results: &Results) -> anyhow::Result<Table> {
    let suite = &results.ordinary;
    let mut rows = Vec::new();
    for arm in results.plan.drawn() {
        let demands = suite.stripes(arm)?;
        for (frequency, (p_rad_s, stripes)) in
            adjusted_boxes(suite, arm)?.into_iter().enumerate()
        {
            let splits = adjusted_split(suite, demands, frequency)?;
            for (stripe, split) in stripes.iter().zip(splits) {
                let median = stripe.summary.as_ref().map(|b| b.median);
                let part =
                    |of: &[f64]| Measured::exact(estimates::median(of).value);
                rows.push(Row {
                    at: Place {
                        arm: Some(arm),
                        p_rad_s: Some(p_rad_s),
                        im_pga: Some(split.im),
                        ..Place::default()
                    },
                    values: vec![
                        count(stripe.records),
                        usable(stripe)?,
                        Measured::exact(median.unwrap_or(f64::NAN)),
                        part(&split.within),
                        part(&split.above),
                        count(split.above.len()),
                    ],
                });
            }
        }
    }
    Ok(Table {
        topic: Topic::SlendernessAdjustment,
        quantities: vec![
            quantity("records", Unit::Count, "records"),
            quantity("usable", Unit::Count, "usable ratios of demands"),
            quantity(
                "median",
                Unit::One,
                "median ratio of demands, adjusted over scaled",
            ),
            quantity(
                "median_alpha_to_0.25",
                Unit::One,
                "median ratio of demands where the adjusted alpha is 0.25 \
                 at most",
            ),
            quantity(
                "median_alpha_above_0.25",
                Unit::One,
                "median ratio of demands where the adjusted alpha is above \
                 0.25",
            ),
            quantity(
                "usable_alpha_above_0.25",
                Unit::Count,
                "usable ratios where the adjusted alpha is above 0.25",
            ),
        ],
        rows,
    })
}

/// Of as many records of the kind, how many would be usable.
fn usable(stripe: &Stripe) -> anyhow::Result<Measured> {
    let share = Proportion::try_new(stripe.usable, stripe.records)?;
    let (low, high) = share.interval(estimates::LEVEL)?;
    let n = stripe.records as f64;
    Ok(Measured {
        value: stripe.usable as f64,
        interval: Some((low * n, high * n)),
    })
}

/// Median overturning intensities, a row a block, suite and measure, in the
/// arm that figures share: the median intensity at demand 1.00 with its
/// order-statistic interval.
fn overturning(results: &Results) -> Table {
    let arm = results.plan.common();
    let mut rows = Vec::new();
    for d in results.distributions.iter().filter(|d| d.arm == arm) {
        for block in &d.blocks {
            rows.push(Row {
                at: Place {
                    suite: Some(d.kind),
                    arm: Some(d.arm),
                    intensity: Some(d.intensity),
                    p_rad_s: Some(block.p_rad_s),
                    alpha_rad: Some(block.alpha_rad),
                    ..Place::default()
                },
                values: vec![estimates::median(block.overturning())],
            });
        }
    }
    Table {
        topic: Topic::Overturning,
        quantities: vec![quantity(
            "median",
            Unit::One,
            "median overturning intensity",
        )],
        rows,
    }
}
