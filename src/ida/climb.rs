//! A curve in progress: the analyses that it still needs, in their order.
//!
//! Levels rise to the first overturning. If the analysis says so, its bracket
//! is bisected and levels above it are run. A rising level may be run before
//! the levels below it. Levels above the first overturning are then dropped,
//! so the curve is the same.

use std::collections::BTreeMap;

use crate::excitation::NormalisedRecord;
use crate::ida::levels::{ImLevel, ImLevels};
use crate::ida::{
    Analysis, FirstOverturning, IdaCurve, IdaError, IdaPoint,
    ResolutionCounts, Resurrections,
};

/// Purpose of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Aim {
    /// A rising level.
    Rising(u64),
    /// The middle of the bracket.
    Middle,
    /// A level above the first overturning.
    Above(u64),
}

/// A curve in progress.
pub(super) struct Climb<'a> {
    levels: ImLevels<'a>,
    stage: ClimbStage,
    onset: IdaPoint,
    points: Vec<IdaPoint>,
    overturning: Option<FirstOverturning>,
    middles: u64,
    above: BTreeMap<u64, IdaPoint>,
}

enum ClimbStage {
    /// Levels below `given` are handed out and levels below `due` are settled;
    /// points in `early` wait for lower levels, and levels without a point run
    /// once more when they are due; `again` if that level is `due`.
    Rising {
        given: u64,
        due: u64,
        early: BTreeMap<u64, Option<IdaPoint>>,
        again: bool,
    },
    /// The bracket; `asked` while its middle is being run.
    Bisecting {
        low: f64,
        high: IdaPoint,
        asked: bool,
    },
    /// Levels from `given` to the intensity `end` are left to run; `due`
    /// levels are handed out and not settled.
    Above {
        given: u64,
        end: f64,
        due: u64,
    },
    Done,
}

impl<'a> Climb<'a> {
    pub fn start(
        record: &'a NormalisedRecord,
        analysis: &'a Analysis,
    ) -> Result<Self, IdaError> {
        let levels = ImLevels::new(record, analysis)?;
        let onset = levels.onset();
        let first = levels.first();
        let early = BTreeMap::new();
        let mut climb = Self {
            levels,
            stage: ClimbStage::Rising {
                given: first,
                due: first,
                early,
                again: false,
            },
            onset,
            points: Vec::new(),
            overturning: None,
            middles: 0,
            above: BTreeMap::new(),
        };
        climb.rise();
        Ok(climb)
    }

    /// True when no level is left to run.
    pub fn is_done(&self) -> bool {
        matches!(self.stage, ClimbStage::Done)
    }

    /// The next level that is surely part of the curve, unless one is being
    /// run; with `ahead`, also a rising level above those being run.
    pub fn next(
        &mut self,
        ahead: bool,
    ) -> Result<Option<(Aim, ImLevel<'a>)>, IdaError> {
        let highest = self.levels.analysis.highest_im;
        match &mut self.stage {
            ClimbStage::Rising { given, due, again, .. } => {
                let level = if *again { *due } else { *given };
                let sure = level == *due;
                if !(sure || ahead) || self.levels.im(level) > highest {
                    return Ok(None);
                }
                let found = match self.levels.level(level) {
                    Ok(found) => found,
                    Err(error) if sure => return Err(error),
                    // Perhaps it is never reached.
                    Err(_) => return Ok(None),
                };
                *given = (*given).max(level + 1);
                *again = false;
                Ok(Some((Aim::Rising(level), found)))
            }
            ClimbStage::Bisecting { low, high, asked } => {
                if *asked {
                    return Ok(None);
                }
                *asked = true;
                let middle = 0.5 * (*low + high.im);
                Ok(Some((Aim::Middle, self.levels.at(middle)?)))
            }
            ClimbStage::Above { given, end, due } => {
                let level = *given;
                if !(self.levels.im(level) <= *end) {
                    return Ok(None);
                }
                *given += 1;
                *due += 1;
                let found = self.levels.level(level)?;
                Ok(Some((Aim::Above(level), found)))
            }
            ClimbStage::Done => Ok(None),
        }
    }

    /// Number of levels that may be run ahead of the lowest one not settled:
    /// few at first, because most of them may lie above the first overturning.
    pub fn reach(&self) -> u64 {
        match self.stage {
            ClimbStage::Rising { .. } => 2 + self.points.len() as u64 / 4,
            ClimbStage::Above { .. } => u64::MAX,
            ClimbStage::Bisecting { .. } | ClimbStage::Done => 0,
        }
    }

    /// True if the level of an analysis is the lowest that is not settled, or
    /// one that is surely part of the curve.
    pub fn is_due(&self, aim: Aim) -> bool {
        match (&self.stage, aim) {
            (ClimbStage::Rising { due, .. }, Aim::Rising(level)) => {
                level == *due
            }
            (_, Aim::Rising(_)) => false,
            (_, Aim::Middle | Aim::Above(_)) => true,
        }
    }

    /// Runs a level that is not due once more when it is.
    pub fn postpone(&mut self, aim: Aim) {
        if let ClimbStage::Rising { early, .. } = &mut self.stage
            && let Aim::Rising(level) = aim
        {
            early.insert(level, None);
            self.rise();
        }
    }

    /// Takes a point.
    pub fn accept(&mut self, aim: Aim, point: IdaPoint) {
        match (&mut self.stage, aim) {
            (ClimbStage::Rising { early, .. }, Aim::Rising(level)) => {
                early.insert(level, Some(point));
                self.rise();
            }
            (ClimbStage::Bisecting { low, high, asked }, Aim::Middle) => {
                *asked = false;
                self.middles += 1;
                if point.outcome.is_overturned() {
                    *high = point;
                } else {
                    *low = point.im;
                }
                let (low, high) = (*low, *high);
                self.bisect(low, high);
            }
            (ClimbStage::Above { due, .. }, Aim::Above(level)) => {
                *due -= 1;
                self.above.insert(level, point);
                self.look_above();
            }
            // Run ahead, above the first overturning.
            _ => {}
        }
    }

    /// Takes the levels that are due, up to the first overturning.
    fn rise(&mut self) {
        let ClimbStage::Rising { due, early, again, .. } = &mut self.stage
        else {
            return;
        };
        while let Some(point) = early.remove(due) {
            let Some(point) = point else {
                *again = true;
                return;
            };
            *due += 1;
            let below = self.points.last().map_or(1.0, |point| point.im);
            self.points.push(point);
            if point.outcome.is_overturned() {
                self.overturning = Some(FirstOverturning {
                    scanned_im: point.im,
                    refined: None,
                    standing_im: below,
                });
                self.bisect(below, point);
                return;
            }
        }
        if self.levels.im(*due) > self.levels.analysis.highest_im {
            self.stage = ClimbStage::Done;
        }
    }

    /// Continues with a bracket: a standing intensity and an overturned point.
    fn bisect(&mut self, low: f64, high: IdaPoint) {
        if let Some(tolerance) = self.levels.analysis.refine {
            let middle = 0.5 * (low + high.im);
            let inside = middle > low && middle < high.im;
            if high.im - low > tolerance && inside {
                self.stage = ClimbStage::Bisecting { low, high, asked: false };
                return;
            }
            if let Some(overturning) = &mut self.overturning {
                overturning.refined = Some(high);
                overturning.standing_im = low;
            }
        }
        let resurrections = self.levels.analysis.resurrections;
        self.stage = match (self.overturning, resurrections) {
            (Some(first), Some(reach)) => ClimbStage::Above {
                given: self.levels.first() + self.points.len() as u64,
                end: match reach {
                    Resurrections::Multiple(times) => times * first.scanned_im,
                    Resurrections::To(im) => im,
                },
                due: 0,
            },
            _ => ClimbStage::Done,
        };
        self.look_above();
    }

    fn look_above(&mut self) {
        if let ClimbStage::Above { given, end, due: 0 } = self.stage
            && !(self.levels.im(given) <= end)
        {
            self.stage = ClimbStage::Done;
        }
    }

    /// The curve.
    pub fn finish(self) -> IdaCurve {
        let record = self.levels.record;
        let analyses = self.points.len() + self.above.len();
        let mut resolution = ResolutionCounts::default();
        let refined = self.overturning.and_then(|first| first.refined);
        let above = self.above.values();
        for point in self.points.iter().chain(&refined).chain(above) {
            resolution.count(point);
        }
        IdaCurve {
            record: record.name().to_owned(),
            record_pga_g: record.pga_g(),
            velocity_ratio_s: record.velocity_ratio_s(),
            onset: self.onset,
            points: self.points,
            overturning: self.overturning,
            above: self.above.into_values().collect(),
            resolution,
            analyses: analyses as u64 + self.middles,
        }
    }
}
