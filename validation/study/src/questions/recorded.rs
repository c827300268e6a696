//! Recorded motions whose licence allows copies: three stations of the Mw 7.1
//! Ridgecrest earthquake of 2019, raw, corrected by this program.

use std::io::Cursor;

use rocking::block::Block;
use rocking::excitation::{Excitation, ScaledRecord};
use rocking::integrator::{Model, Observe, Scene, respond};
use rocking_records::intensity::{Measures, Settings};
use rocking_records::{Processing, ReadOptions, Reading, Suite, SuiteError};

use super::answer::{Rows, StudyAnswer, number, word};
use crate::results::StudyResults;
use rocking_common::suites::inputs;

/// Corners of the high-pass, whose effect the table shows.
const CORNERS_HZ: [f64; 3] = [0.05, 0.1, 0.2];

/// The block: p in rad/s and alpha in rad.
const P_RAD_S: f64 = 2.0;
const ALPHA_RAD: f64 = 0.2;

/// The three pairs, as recorded.
///
/// # Errors
/// None in practice: the files are fixed.
pub fn ridgecrest() -> anyhow::Result<Suite> {
    let options = ReadOptions::default();
    let archive = Cursor::new(rocking_fixtures::RIDGECREST);
    let survey = inputs::visit_zip(
        "ridgecrest.zip",
        archive,
        &Reading::all(&options),
        Ok::<_, SuiteError>,
    )?;
    Ok(survey.into_suite()?)
}

pub(super) fn answer(results: &StudyResults) -> anyhow::Result<StudyAnswer> {
    let setup = &results.plan.setup;
    let suite = ridgecrest()?;
    let settings = Settings::default();
    let block = Block::try_new(ALPHA_RAD, P_RAD_S)?;
    let mut rows = Rows::default();
    let (mut overturned, mut analyses) = (0, 0);
    for corner_hz in CORNERS_HZ {
        let processing = Processing::try_new(true, Some(corner_hz))?;
        let suite = suite.clone().processed(&processing);
        for member in suite?.members() {
            let motion = &member.accelerogram;
            let measures = Measures::of(motion, &settings)?;
            let scene = Scene {
                block,
                restitution: setup.restitution,
                model: Model::Nonlinear,
                overturning: setup.overturning,
                excitation: Excitation::Record(ScaledRecord::by_factor(
                    motion, 1.0,
                )),
                initial_ratio: 0.0,
            };
            let outcome = respond(&scene, &Observe::default())?.outcome;
            analyses += 1;
            overturned += usize::from(outcome.is_overturned());
            rows.row(vec![
                ("record", word(motion.name().replace('_', " "))),
                ("corner_hz", number(corner_hz, 2)),
                ("pga_g", number(measures.pga_g, 3)),
                ("pgv_m_s", number(measures.pgv_m_s, 3)),
                ("pgd_m", number(measures.pgd_m, 3)),
                (
                    "arias_intensity_m_s",
                    number(measures.arias_intensity_m_s, 2),
                ),
                ("peak_over_alpha", number(outcome.edp(), 3)),
            ]);
        }
    }
    let words = format!(
        "The six horizontal components of three stations near the Mw 7.1 \
         Ridgecrest earthquake of 2019 overturn a block of alpha = \
         {ALPHA_RAD} rad and p = {P_RAD_S} rad/s in {overturned} of \
         {analyses} analyses, three corners of the high-pass each."
    );
    Ok(rows.answer("recorded", words))
}
