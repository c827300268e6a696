//! Capacities, outcomes at the level and measures of the records of tests.

use rayon::prelude::*;

use super::{
    ComputedTests, ShakingError, ShakingTest, Slenderness, TestFate,
    TestOptions, TestResult,
};
use libm::{exp, log};
use rocking::block::Block;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Batch, Grid, REFINEMENT, curves, demand_at};
use rocking::integrator::{Extent, uplift_threshold};
use rocking_records::intensity::{IntensityMeasure, Measures, Settings};

/// Spacing of the levels, in units of the onset of rocking.
const STEP_IM: f64 = 0.1;

/// Slenderness from which a fit starts, and its ends, in rad.
const START: f64 = 0.1;
pub(super) const ENDS: [f64; 2] = [1e-3, 1.2];

/// Ends of a fit, in logarithms of the median and of alpha. Capacities jump
/// with alpha, and the median of 490 tests with them by as much.
const NEAR: f64 = 1e-3;

/// The tests of known outcome, normalised, with the values of their measures.
pub(super) struct TestRecords<'a> {
    tests: Vec<&'a ShakingTest>,
    unknown: usize,
    records: Vec<NormalisedRecord>,
    intensities: Vec<Vec<f64>>,
    options: &'a TestOptions,
}

impl<'a> TestRecords<'a> {
    pub fn new(
        tests: &'a [ShakingTest],
        options: &'a TestOptions,
    ) -> Result<Self, ShakingError> {
        let is_known = |test: &&ShakingTest| test.fate != TestFate::Unknown;
        let known: Vec<&ShakingTest> = tests.iter().filter(is_known).collect();
        let normalised = known.par_iter().panic_fuse();
        let records = normalised.map(|t| NormalisedRecord::new(&t.record));
        Ok(Self {
            records: records.collect(),
            intensities: intensities(&known, options)?,
            unknown: tests.len() - known.len(),
            tests: known,
            options,
        })
    }

    /// The numbers of the tests, with the outcomes at their levels.
    pub fn computed(&self) -> Result<ComputedTests<'a>, ShakingError> {
        let mut found = match self.options.slenderness {
            Slenderness::Given(block) => self.of_block(block)?,
            Slenderness::Fitted { p_rad_s } => self.fitted(p_rad_s)?,
        };
        let analysis = self.analysis(found.block);
        let threshold = uplift_threshold(&found.block, self.options.model);
        let fates = self.records.par_iter().panic_fuse().map(|record| {
            let im = record.pga_g() / threshold;
            let point = demand_at(record, &analysis, im)?;
            Ok(point.outcome.is_overturned())
        });
        let fates = fates.collect::<Result<Vec<bool>, ShakingError>>()?;
        for (test, fate) in found.tests.iter_mut().zip(fates) {
            test.overturns_at_level = fate;
        }
        Ok(found)
    }

    fn analysis(&self, block: Block) -> Analysis {
        Analysis {
            grid: Grid::Im { step: STEP_IM },
            refine: Some(REFINEMENT),
            model: self.options.model,
            extent: Extent::Outcome,
            ..Analysis::paper(block, self.options.restitution)
        }
    }

    /// The capacities of a block, without the outcomes at the level.
    fn of_block(
        &self,
        block: Block,
    ) -> Result<ComputedTests<'a>, ShakingError> {
        let analysis = self.analysis(block);
        let made = curves(&self.records, &[analysis], &Batch::default())?;
        let threshold = uplift_threshold(&block, self.options.model);
        let tests = self.tests.iter().zip(&self.intensities);
        let tests = tests.zip(made.iter().flatten());
        let tests = tests.map(|((test, intensities), curve)| {
            let last = curve.points.last().map_or(1.0, |point| point.im);
            let im = curve.overturning.map_or(last, |first| first.im());
            TestResult {
                test: test.record.name().to_owned(),
                motion: test.motion.clone(),
                pga_g: curve.record_pga_g,
                intensities: intensities.clone(),
                capacity_factor: im * threshold / curve.record_pga_g,
                overturns: curve.overturning.is_some(),
                overturns_at_level: false,
                probability: f64::NAN,
                overturned: test.fate == TestFate::Overturned,
            }
        });
        Ok(ComputedTests {
            tests: tests.collect(),
            unknown: self.unknown,
            block,
            fitted_slope: None,
            options: self.options,
        })
    }

    /// The capacities of the block whose median of measured over computed
    /// capacity is 1.
    fn fitted(&self, p_rad_s: f64) -> Result<ComputedTests<'a>, ShakingError> {
        let at = |ln_alpha: f64| {
            let block = Block::try_new(exp(ln_alpha), p_rad_s)?;
            let found = self.of_block(block)?;
            let ln_bias = log(found.bias()?);
            Ok::<_, ShakingError>((ln_alpha, ln_bias, found))
        };
        let ends = ENDS.map(log);
        let mut one = at(log(START))?;
        // The median falls almost in proportion as alpha rises; step slightly
        // beyond 1.
        let mut other = loop {
            let step = 1.2 * one.1 + NEAR.copysign(one.1);
            let next = (one.0 + step).clamp(ends[0], ends[1]);
            let next = at(next)?;
            if !(next.1 * one.1 > 0.0) {
                break next;
            }
            if ends.contains(&next.0) {
                return Err(ShakingError::Slenderness);
            }
            one = next;
        };
        // Regula falsi, every third step by halves: the median may jump.
        for step in 1.. {
            let nearest = one.1.abs().min(other.1.abs());
            let width = other.0 - one.0;
            if !(nearest > NEAR && width.abs() > NEAR) {
                break;
            }
            let share = match step % 3 {
                0 => 0.5,
                _ => one.1 / (one.1 - other.1),
            };
            let next = at(share.mul_add(width, one.0))?;
            if next.1 * one.1 > 0.0 {
                one = next;
            } else {
                other = next;
            }
        }
        let best = if one.1.abs() < other.1.abs() { one } else { other };
        let (ln_alpha, _, found) = best;
        let apart = log(1.05);
        let [below, above] = [at(ln_alpha - apart)?, at(ln_alpha + apart)?];
        let slope = (above.1 - below.1) / (above.0 - below.0);
        Ok(ComputedTests { fitted_slope: Some(slope), ..found })
    }
}

/// The values of the measures of each test.
fn intensities(
    tests: &[&ShakingTest],
    options: &TestOptions,
) -> Result<Vec<Vec<f64>>, ShakingError> {
    let settings = Settings::of(options.gravity_m_s2, &options.measures)?;
    let of = |test: &&ShakingTest| {
        let own = Measures::of(&test.record, &settings).map_err(|source| {
            let test = test.record.name().to_owned();
            ShakingError::Record { test, source }
        })?;
        let value = |im: &IntensityMeasure| match im {
            IntensityMeasure::Column(name) => {
                test.columns.get(name).copied().unwrap_or(f64::NAN)
            }
            im => im.value(&own, settings.periods_s()).unwrap_or(f64::NAN),
        };
        Ok(options.measures.iter().map(value).collect())
    };
    tests.par_iter().panic_fuse().map(of).collect()
}
