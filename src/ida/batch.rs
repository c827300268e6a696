//! Many curves at once: chains in the lanes of the pool, on all threads.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use crate::excitation::NormalisedRecord;
use crate::ida::{Analysis, Climb, Grid, IdaCurve, IdaError, Level, curve};
use crate::integrator::pool::{self, Class};
use crate::integrator::{Observe, Response, Scene, check, uplift_threshold};
use crate::number::dispatch::Isa;

/// One curve to be made.
#[derive(Clone, Copy)]
struct Job {
    /// Place among the results.
    index: usize,
    analysis: usize,
    record: usize,
    /// Guess of the work, to start long chains first.
    work: f64,
}

/// Chains that share a pool; without a class, each runs alone.
struct Queue {
    class: Option<Class>,
    jobs: Vec<Job>,
    taken: AtomicUsize,
}

impl Queue {
    fn take(&self) -> Option<Job> {
        let place = self.taken.fetch_add(1, Ordering::Relaxed);
        self.jobs.get(place).copied()
    }
}

/// [`crate::ida::curves`] at an instruction-set level.
pub(super) fn curves(
    records: &[NormalisedRecord],
    analyses: &[Analysis],
    isa: Isa,
    done: &(impl Fn() + Sync),
) -> Result<Vec<Vec<IdaCurve>>, IdaError> {
    let queues = queues(records, analyses);
    let results = Mutex::new(Vec::new());
    let work = || {
        let mut own = Vec::new();
        for queue in &queues {
            let mut keep = |index: usize, result| {
                own.push((index, result));
                done();
            };
            let Some(class) = queue.class else {
                while let Some(job) = queue.take() {
                    let (record, analysis) =
                        (&records[job.record], &analyses[job.analysis]);
                    keep(job.index, curve(record, analysis));
                }
                continue;
            };
            let take = || {
                let job = queue.take()?;
                let (record, analysis) =
                    (&records[job.record], &analyses[job.analysis]);
                Some(Chain {
                    index: job.index,
                    climb: Climb::start(record, analysis),
                    level: None,
                })
            };
            pool::run(class, isa, take, |chain: Chain<'_>| {
                keep(chain.index, chain.climb.and_then(Climb::finish));
            });
        }
        if let Ok(mut results) = results.lock() {
            results.append(&mut own);
        }
    };
    rayon::scope(|scope| {
        for _ in 0..rayon::current_num_threads() {
            scope.spawn(|_| work());
        }
    });
    let mut flat = results.into_inner().unwrap_or_default();
    flat.sort_by_key(|(index, _)| *index);
    let mut flat = flat.into_iter().map(|(_, result)| result);
    (0..analyses.len())
        .map(|_| flat.by_ref().take(records.len()).collect())
        .collect()
}

/// Chains by class, the longest first.
fn queues(records: &[NormalisedRecord], analyses: &[Analysis]) -> Vec<Queue> {
    let mut jobs = Vec::new();
    for (a, analysis) in analyses.iter().enumerate() {
        for (r, record) in records.iter().enumerate() {
            let p = analysis.block.frequency_rad_s();
            let class = Class::of(analysis.model, record.dt_s() * p);
            let (index, work) = (jobs.len(), work(record, analysis));
            jobs.push((class, Job { index, analysis: a, record: r, work }));
        }
    }
    let mut classes: Vec<Option<Class>> =
        jobs.iter().map(|(class, _)| *class).collect();
    classes.sort();
    classes.dedup();
    classes
        .into_iter()
        .map(|class| {
            let mut jobs: Vec<Job> = jobs
                .iter()
                .filter(|(other, _)| *other == class)
                .map(|(_, job)| *job)
                .collect();
            jobs.sort_by(|a, b| b.work.total_cmp(&a.work));
            Queue { class, jobs, taken: AtomicUsize::new(0) }
        })
        .collect()
}

/// Samples times a guess of the levels, for a block overturns at an
/// intensity that falls with p PGV/PGA.
fn work(record: &NormalisedRecord, analysis: &Analysis) -> f64 {
    let p = analysis.block.frequency_rad_s();
    let levels = match analysis.grid {
        Grid::Pga { step_g } => {
            uplift_threshold(&analysis.block, analysis.model) / step_g
        }
        Grid::Im { step } => 1.0 / step,
    };
    let reach = 1.0 / (p * record.velocity_ratio_s());
    record.samples().len() as f64 * levels * reach
}

/// A curve climbing in a lane.
struct Chain<'a> {
    index: usize,
    climb: Result<Climb<'a>, IdaError>,
    level: Option<Level<'a>>,
}

impl<'a> Chain<'a> {
    fn advance(&self) -> Result<Option<Level<'a>>, IdaError> {
        let Ok(climb) = &self.climb else { return Ok(None) };
        let Some(level) = climb.next_level()? else { return Ok(None) };
        check(&level.scene, &Observe::default())?;
        Ok(Some(level))
    }
}

impl<'a> pool::Chain<'a> for Chain<'a> {
    fn next(&mut self) -> Option<Scene<'a>> {
        match self.advance() {
            Ok(level) => self.level = level,
            Err(error) => {
                self.climb = Err(error);
                return None;
            }
        }
        self.level.map(|level| level.scene)
    }

    fn settle(&mut self, response: &Response) {
        let (Ok(climb), Some(level)) = (&mut self.climb, &self.level) else {
            return;
        };
        if let Err(error) = climb.settle(level, response) {
            self.climb = Err(error);
        }
    }
}
