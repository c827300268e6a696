//! Effects of other choices on the capacities: restitution, overturning
//! criterion and component.

use indicatif::ProgressBar;
use rocking::block::{Block, Restitution};
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking::excitation::NormalisedRecord;
use rocking::ida::Adjust;
use rocking::integrator::Overturning;
use rocking::names::named;

use crate::analyses::Plan;
use crate::runs::Setup;
use rocking_common::paper::{BLOCKS, position};
use rocking_common::suites::{StudyMotion, StudySuite};

named! {
    /// A choice other than the study's.
    pub enum OtherChoice: "choice" {
        /// Restitution 0.85.
        Eta085 = "eta-0.85",
        /// Restitution 0.97.
        Eta097 = "eta-0.97",
        /// Housner's restitution, which depends on the slenderness.
        Housner = "eta-housner",
        /// The other overturning criterion.
        OtherCriterion = "other-criterion",
        /// The other component of each pair, if there is one.
        OtherComponent = "other-component",
    }
}

impl OtherChoice {
    /// Positions of the slendernesses that are run. Without `--full` they are 0.10
    /// and 0.20, and for Housner's restitution also the extremes.
    fn slendernesses(self, full: bool) -> &'static [usize] {
        match self {
            _ if full => &[0, 1, 2, 3, 4],
            Self::Housner => &[0, 1, 3, 4],
            _ => &[1, 3],
        }
    }

    fn setup(self, mut setup: Setup, block: &Block) -> anyhow::Result<Setup> {
        match self {
            Self::Eta085 => setup.restitution = Restitution::constant(0.85)?,
            Self::Eta097 => setup.restitution = Restitution::constant(0.97)?,
            Self::Housner => setup.restitution = Restitution::housner(block)?,
            Self::OtherCriterion => {
                setup.overturning = match setup.overturning {
                    Overturning::Alpha => Overturning::HalfPi,
                    Overturning::HalfPi => Overturning::Alpha,
                }
            }
            Self::OtherComponent => {}
        }
        Ok(setup)
    }
}

/// Curves of one block under a choice, by record; `None` for a record without
/// its other component.
#[derive(Clone, Debug)]
pub struct Variant {
    /// The choice.
    pub choice: OtherChoice,
    /// Position of the frequency parameter.
    pub frequency: usize,
    /// Position of the slenderness.
    pub slenderness: usize,
    /// Curves by record, on the plan's common grid.
    pub curves: Vec<Option<ResponseCurve>>,
}

impl Variant {
    /// Capacities at demand 1 by the median point, by record; NaN without a
    /// curve.
    pub(crate) fn overturning(&self) -> anyhow::Result<Vec<f64>> {
        let of = |curve: &ResponseCurve| {
            Ok(curve.capacity(1.0, InversionRule::Median)?.im())
        };
        let curves = self.curves.iter().map(Option::as_ref);
        curves.map(|curve| curve.map_or(Ok(f64::NAN), of)).collect()
    }
}

impl Plan {
    /// Runs the other choices on a suite: for p = 3, or for all blocks.
    ///
    /// # Errors
    /// If an analysis fails.
    pub fn sensitivities(
        &self,
        suite: &StudySuite,
    ) -> anyhow::Result<Vec<Variant>> {
        let frequencies: &[usize] = if self.full { &[0, 1, 2] } else { &[1] };
        let progress = ProgressBar::hidden();
        let mut out = Vec::new();
        for choice in OtherChoice::ALL {
            let component = |motion: &StudyMotion| match choice {
                OtherChoice::OtherComponent => motion.other.clone(),
                _ => Some(motion.study.clone()),
            };
            let records: Vec<Option<NormalisedRecord>> = suite
                .motions
                .iter()
                .map(|m| component(m).as_ref().map(NormalisedRecord::new))
                .collect();
            let present: Vec<NormalisedRecord> =
                records.iter().flatten().cloned().collect();
            for &frequency in frequencies {
                for &slenderness in choice.slendernesses(self.full) {
                    let block = BLOCKS[position(frequency, slenderness)];
                    let setup = choice.setup(self.setup.clone(), &block)?;
                    let (arms, _) = setup.chains(
                        &[block],
                        &present,
                        &[self.common()],
                        Adjust::RecordScaling,
                        &progress,
                    )?;
                    let curves = arms.into_iter().flat_map(|a| a.curves);
                    let mut found = curves.flatten();
                    let all = records.iter().map(Option::as_ref);
                    let curves = all.map(|r| r.and_then(|_| found.next()));
                    let curves = curves.collect();
                    let own =
                        Variant { choice, frequency, slenderness, curves };
                    out.push(own);
                }
            }
        }
        Ok(out)
    }
}
