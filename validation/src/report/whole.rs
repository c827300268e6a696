//! The study from suites to files.

use std::fmt::Write as _;

use indicatif::ProgressBar;
use rocking::integrator::Overturning;
use serde_json::{Value, json};

use super::evidence;
use super::evidence::Proof;
use super::input;
use super::output::{Files, laid_out};
use super::page;
use super::timings::Timings;
use crate::draw::figures::Figure as _;
use crate::draw::figures::data::{Arm, Table, number};
use crate::paper::{
    FREQUENCIES_RAD_S, REFERENCE, SLENDERNESSES_RAD, blocks, demands,
};
use crate::study::StudyError;
use crate::study::adjustment;
use crate::study::analyses::{Plan, SuiteResults};
use crate::study::claims;
use crate::study::distributions::of_suite;
use crate::study::figures::{Figure, Results};
use crate::study::findings::{Claim, Findings, ends, rounded, text};
use crate::study::normality::ends as band_ends;
use crate::study::overturning;
use crate::study::questions;
use crate::study::questions::Answer;
use crate::study::sensitivities::Varied;
use crate::suites::StudySuite;

/// A finished study.
pub struct Study {
    results: Results,
    figures: Vec<Figure>,
    claims: Vec<Claim>,
    findings: Findings,
    answers: Vec<Answer>,
}

impl Study {
    /// Runs everything: `suites` are the ordinary and the pulse-type one;
    /// `full` runs other choices on all blocks.
    ///
    /// # Errors
    /// [`StudyError`] where an analysis cannot be done.
    pub fn run(
        plan: Plan,
        suites: &[StudySuite; 2],
        full: bool,
        progress: &ProgressBar,
    ) -> Result<Self, StudyError> {
        let [first, second] = suites;
        let ordinary = plan.run(first, true, progress)?;
        let pulse = plan.run(second, false, progress)?;
        let common = plan.common();
        let mut distributions = of_suite(&ordinary, common)?;
        distributions.extend(of_suite(&pulse, common)?);
        let varied = plan.sensitivities(first, full)?;
        let results = Results { plan, ordinary, pulse, distributions, varied };
        let mut figures = results.figures()?;
        let mut answers = questions::all(&results, full)?;
        for answer in &mut answers {
            figures.append(&mut answer.figures);
        }
        let claims = claims::all(&results)?;
        let findings = findings(&results, &claims, &answers)?;
        Ok(Self { results, figures, claims, findings, answers })
    }

    /// The claims and what was found about them.
    #[must_use]
    pub fn claims(&self) -> &[Claim] {
        &self.claims
    }

    /// Text of `findings.json`.
    #[must_use]
    pub fn findings_text(&self) -> String {
        text(&self.findings)
    }

    /// The claims as a table for people.
    #[must_use]
    pub fn table(&self) -> String {
        let mut out = String::new();
        for claim in &self.claims {
            let arm = claim.arm.map(|arm| format!(", arm {}", arm.letter()));
            let suite = claim.suite.clone() + &arm.unwrap_or_default();
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "{:<13}  {:<34} {:<20} {:>10}  {}",
                claim.verdict.name(),
                claim.id,
                suite,
                rounded_text(claim.measured.value),
                claim.margin
            );
        }
        out
    }

    /// The report's files: `index.html`, numbers in `data/`, drawings in
    /// `figures/`. The page shows `proof`, the results of the declared cases,
    /// if they were handed in.
    ///
    /// # Errors
    /// [`StudyError`] where a figure cannot be drawn.
    pub fn files(&self, proof: Option<&Proof>) -> Result<Files, StudyError> {
        let mut files = Files::new();
        let timed = Timings::kept()?.figure();
        for figure in self.figures.iter().chain([&timed]) {
            let name = &figure.drawing.heading().name;
            let svg = figure.drawing.svg()?;
            files.insert(format!("{name}.svg"), svg.into_bytes());
            let csv = figure.drawing.csv();
            files.insert(format!("{name}.csv"), csv.into_bytes());
        }
        files.insert("table-01.csv".into(), table_1()?.into_bytes());
        let single = single_csv(&self.results);
        files.insert("single-records.csv".into(), single.into_bytes());
        let text = self.findings_text();
        files.insert("findings.json".into(), text.into_bytes());
        let charts = evidence::charts()?;
        for shown in &charts {
            let name = &shown.chart.heading.name;
            let svg = shown.chart.svg()?;
            files.insert(format!("{name}.svg"), svg.into_bytes());
            let csv = shown.chart.csv();
            files.insert(format!("{name}.csv"), csv.into_bytes());
        }
        files.extend(questions::files(&self.answers));
        let input = input::input(
            &self.results,
            &self.figures,
            &charts,
            &self.claims,
            &self.answers,
            proof,
        )?;
        files.insert("index.html".into(), page::page(&input).into_bytes());
        Ok(laid_out(files))
    }
}

/// A number for people: four decimals, "none" where there is none.
#[must_use]
pub fn rounded_text(x: f64) -> String {
    if x.is_nan() { "none".into() } else { format!("{x:.4}") }
}

/// Table 1 as CSV.
fn table_1() -> Result<String, StudyError> {
    let printed = input::table_1()?;
    let header: Vec<&str> =
        printed.header.iter().map(String::as_str).collect();
    let mut table = Table::new(&header);
    for row in printed.rows {
        table.row(row);
    }
    Ok(table.finish())
}

/// Every record's histories and curves against those of alpha = 0.10.
fn single_csv(results: &Results) -> String {
    let mut table = Table::new(&[
        "suite",
        "record",
        "p_rad_s",
        "im_pga",
        "alpha_rad",
        "normalized_l2_distance",
        "peak_ratio",
        "mean_abs_ln_im_ratio",
    ]);
    let others: Vec<f64> = (0..SLENDERNESSES_RAD.len())
        .filter(|s| *s != REFERENCE)
        .map(|s| SLENDERNESSES_RAD[s])
        .collect();
    for suite in [&results.ordinary, &results.pulse] {
        for (single, p) in suite.single.iter().zip(FREQUENCIES_RAD_S) {
            for (record, apart) in suite.records.iter().zip(&single.apart) {
                for (alpha, a) in others.iter().zip(apart) {
                    table.row([
                        suite.kind.into(),
                        record.name.clone(),
                        number(p),
                        number(single.im),
                        number(*alpha),
                        number(a.distance),
                        number(a.peak_ratio),
                        number(a.mean_ln_im),
                    ]);
                }
            }
        }
    }
    table.finish()
}

fn findings(
    results: &Results,
    claims: &[Claim],
    answers: &[Answer],
) -> Result<Findings, StudyError> {
    let mut out = Findings::new();
    let claims = claims.iter().map(Claim::json).collect();
    out.insert("claims".into(), Value::Array(claims));
    out.insert("options".into(), options(&results.plan));
    out.insert("questions".into(), questions::json(answers));
    let suites = [&results.ordinary, &results.pulse].map(suite);
    out.insert("suites".into(), Value::Array(suites.into()));
    out.insert("figure_09".into(), adjustment::json(results)?);
    out.insert("uplift_unscaled".into(), uplift(results)?);
    out.insert("accepted_shares".into(), shares(results));
    out.insert("overturning".into(), overturning::json(results));
    out.insert("resurrections".into(), resurrections(results));
    out.insert("single_records".into(), single(results));
    out.insert("sensitivities".into(), varied(results)?);
    Ok(out)
}

fn options(plan: &Plan) -> Value {
    let arms: Vec<&str> = plan.arms.iter().map(|a| a.letter()).collect();
    let overturning = match plan.setup.overturning {
        Overturning::Alpha => "alpha",
        Overturning::HalfPi => "half-pi",
    };
    json!({
        "arms": arms,
        "eta": rounded(plan.setup.restitution.velocity_ratio()),
        "overturning": overturning,
        "refinement_im": rounded(plan.setup.tolerance),
        "version": env!("CARGO_PKG_VERSION"),
    })
}

fn suite(suite: &SuiteResults) -> Value {
    let chosen: Vec<&str> = suite
        .chosen
        .iter()
        .map(|record| suite.records[*record].name.as_str())
        .collect();
    let certainty = &suite.work.certainty;
    let mut value = json!({
        "kind": suite.kind,
        "source": suite.source.to_string(),
        "component_rule": suite.component_rule,
        "records": suite.records.len(),
        "sha256": suite.sha256,
        "analyses": suite.work.analyses,
        "not_told_by_double_precision": certainty.unresolved,
        "first_overturnings_told_again": {
            "all": certainty.ends.all,
            "by_double": certainty.ends.double,
            "by_double_double": certainty.ends.double_double,
            "by_octuple": certainty.ends.octuple,
            "left_open": certainty.ends.undecided,
            "told_wrongly_in_double": certainty.ends.moved,
        },
        "largest_shift_if_flipped": rounded(certainty.largest_shift),
        "shown_alone": chosen,
    });
    if let Some(remarks) = &suite.remarks {
        value["remarks"] = remarks.clone().into();
    }
    value
}

/// How many records uplift each block without being scaled.
fn uplift(results: &Results) -> Result<Value, StudyError> {
    let rows: Vec<Value> = blocks()?
        .iter()
        .map(|block| {
            json!({
                "p_rad_s": rounded(block.frequency_rad_s()),
                "alpha_rad": rounded(block.slenderness_rad()),
                "ordinary": results.ordinary.uplift_unscaled(block),
                "pulse_type": results.pulse.uplift_unscaled(block),
            })
        })
        .collect();
    Ok(Value::Array(rows))
}

fn shares(results: &Results) -> Value {
    let mut rows = Vec::new();
    for d in &results.distributions {
        for block in &d.blocks {
            let (original, shifted) = block.shares();
            rows.push(json!({
                "suite": d.kind,
                "arm": d.arm.letter(),
                "im_kind": d.intensity.name(),
                "p_rad_s": rounded(block.p_rad_s),
                "alpha_rad": rounded(block.alpha_rad),
                "im_r": rounded(block.shift),
                "original": rounded(original),
                "original_null_band": ends(block.bands[0].as_ref().and_then(band_ends)),
                "shifted": rounded(shifted),
                "shifted_null_band": ends(block.bands[1].as_ref().and_then(band_ends)),
            }));
        }
    }
    json!({ "levels": demands().len(), "rows": rows })
}

fn resurrections(results: &Results) -> Value {
    let rows: Vec<Value> = results
        .ordinary
        .stripes
        .iter()
        .map(|stripes| {
            let total = |counts: &[Vec<usize>]| -> usize {
                counts.iter().flatten().sum()
            };
            json!({
                "arm": stripes.arm.letter(),
                "overturned": total(&stripes.overturned),
                "stand_again": total(&stripes.stand_again),
            })
        })
        .collect();
    Value::Array(rows)
}

fn single(results: &Results) -> Value {
    let mut rows = Vec::new();
    for suite in [&results.ordinary, &results.pulse] {
        for row in claims::single_rows(suite) {
            rows.push(json!({
                "suite": suite.kind,
                "p_rad_s": rounded(row.p_rad_s),
                "im_pga": rounded(row.im),
                "usable": row.usable,
                "median_distance": rounded(row.distance),
                "median_peak_ratio": rounded(row.peak_ratio),
                "median_ln_im": rounded(row.mean_ln_im),
            }));
        }
    }
    Value::Array(rows)
}

fn varied(results: &Results) -> Result<Value, StudyError> {
    let rows = results
        .varied
        .iter()
        .map(|v: &Varied| {
            let pairs = claims::varied_ratios(results, v, 1.0)?;
            let measured = claims::median(&pairs.ratios);
            Ok(json!({
                "choice": v.choice.name(),
                "p_rad_s": rounded(FREQUENCIES_RAD_S[v.frequency]),
                "alpha_rad":
                    rounded(SLENDERNESSES_RAD[v.slenderness]),
                "edp": 1.0,
                "usable": pairs.ratios.len(),
                "median_ratio": rounded(measured.value),
                "interval": ends(measured.interval),
            }))
        })
        .collect::<Result<Vec<Value>, StudyError>>()?;
    Ok(Value::Array(rows))
}

/// Arms in words, for the page.
#[must_use]
pub fn arm_words(arm: Arm) -> &'static str {
    match arm {
        Arm::A => "A: steps of 0.01 g",
        Arm::B => "B: steps of 0.01 g, first overturning bisected",
        Arm::C => "C: steps of 0.02 in intensity, bisected",
    }
}
