//! Many curves at once: their analyses in the slots of the pool, on all
//! threads.

use std::collections::BTreeMap;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};

use crate::excitation::NormalisedRecord;
use crate::ida::climb::{Aim, Climb};
use crate::ida::levels::Level;
use crate::ida::{
    Analysis, Batch, Grid, IdaCurve, IdaError, IdaPoint, curve_at,
};
use crate::integrator::class::Class;
use crate::integrator::pool;
use crate::integrator::{Response, Scene, WorkLimit, uplift_threshold};
use crate::number::dispatch::Isa;

/// One curve to be made.
#[derive(Clone, Copy)]
struct Job<'a> {
    /// Place among the results.
    index: usize,
    analysis: &'a Analysis,
    record: &'a NormalisedRecord,
    /// Guess of the work, to start long curves first.
    work: f64,
}

/// The curves of a class; without a class, each is made alone.
struct Queue<'a> {
    class: Option<Class>,
    book: Mutex<Book<'a>>,
}

/// What is to be made, what is being made, and what was.
struct Book<'a> {
    /// In the order of their start, the next one last.
    jobs: Vec<Job<'a>>,
    climbs: BTreeMap<usize, Active<'a>>,
    results: Vec<(usize, Result<IdaCurve, IdaError>)>,
}

/// A curve in the making, and how many of its analyses are being made.
struct Active<'a> {
    climb: Climb<'a>,
    out: u64,
}

/// An analysis in a slot.
struct Task<'a> {
    /// Place of its curve.
    index: usize,
    aim: Aim,
    level: Level<'a>,
}

/// Whoever watches the work, and whether the work was stopped.
struct Watch<'a> {
    batch: &'a Batch<'a>,
    stopped: AtomicBool,
}

impl Watch<'_> {
    /// Reports a curve.
    fn done(&self) {
        if (self.batch.progress)().is_break() {
            self.stopped.store(true, Ordering::Relaxed);
        }
    }

    fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

/// See [`crate::ida::curves`]. The lanes are compiled here, once.
pub(super) fn curves(
    records: &[NormalisedRecord],
    analyses: &[Analysis],
    batch: &Batch<'_>,
) -> Result<Vec<Vec<IdaCurve>>, IdaError> {
    let isa = batch.isa;
    let watch = Watch { batch, stopped: AtomicBool::new(false) };
    let queues = queues(records, analyses, isa);
    rayon::scope(|scope| {
        for _ in 0..rayon::current_num_threads() {
            scope.spawn(|_| {
                for queue in &queues {
                    queue.work(isa, &watch);
                }
            });
        }
    });
    if watch.is_stopped() {
        return Err(IdaError::Stopped);
    }
    let mut flat: Vec<_> = queues
        .into_iter()
        .flat_map(|queue| queue.open().results.split_off(0))
        .collect();
    flat.sort_by_key(|(index, _)| *index);
    let mut flat = flat.into_iter().map(|(_, result)| result);
    (0..analyses.len())
        .map(|_| flat.by_ref().take(records.len()).collect())
        .collect()
}

impl<'a> Queue<'a> {
    /// Makes curves until none is left to start, or the work is stopped.
    fn work(&self, isa: Isa, watch: &Watch<'_>) {
        if let Some(class) = self.class {
            let mut desk = Desk { queue: self, last: None, watch };
            pool::run(class, isa, &mut desk);
            return;
        }
        while !watch.is_stopped() {
            // Not within the loop's condition: it would hold the book.
            let job = self.open().jobs.pop();
            let Some(job) = job else { return };
            let result = curve_at(job.record, job.analysis, isa);
            self.open().results.push((job.index, result));
            watch.done();
        }
    }

    fn open(&self) -> MutexGuard<'_, Book<'a>> {
        self.book.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// A thread at a queue.
struct Desk<'q, 'a> {
    queue: &'q Queue<'a>,
    /// Curve of which it settled an analysis last.
    last: Option<usize>,
    watch: &'q Watch<'q>,
}

impl<'a> Book<'a> {
    /// The next analysis of a curve in the making, if it has one now.
    fn next(&mut self, index: usize, ahead: bool) -> Option<Task<'a>> {
        let active = self.climbs.get_mut(&index)?;
        match active.climb.next(ahead) {
            Ok(None) => None,
            Ok(Some((aim, level))) => {
                active.out += 1;
                Some(Task { index, aim, level })
            }
            Err(error) => {
                self.end(index, Err(error));
                None
            }
        }
    }

    /// The next analysis of whatever curve: of this one, of a new one, or
    /// ahead of those being made.
    fn take(
        &mut self,
        last: Option<usize>,
        ended: &mut u64,
    ) -> Option<Task<'a>> {
        let before = self.results.len();
        let found = last
            .and_then(|index| self.next(index, false))
            .or_else(|| self.start())
            .or_else(|| self.ahead());
        *ended = (self.results.len() - before) as u64;
        found
    }

    fn start(&mut self) -> Option<Task<'a>> {
        while let Some(Job { index, analysis, record, .. }) = self.jobs.pop() {
            let climb = match Climb::start(record, analysis) {
                Ok(climb) => climb,
                Err(error) => {
                    self.results.push((index, Err(error)));
                    continue;
                }
            };
            if climb.is_done() {
                self.results.push((index, Ok(climb.finish())));
                continue;
            }
            self.climbs.insert(index, Active { climb, out: 0 });
            let task = self.next(index, false);
            if task.is_some() {
                return task;
            }
        }
        None
    }

    /// An analysis of the curve that is furthest from being filled.
    fn ahead(&mut self) -> Option<Task<'a>> {
        let mut order: Vec<(u64, usize)> = self
            .climbs
            .iter()
            .filter(|(_, active)| active.out < active.climb.reach())
            .map(|(index, active)| (active.out, *index))
            .collect();
        order.sort_unstable();
        order.into_iter().find_map(|(_, index)| self.next(index, true))
    }

    fn settle(
        &mut self,
        Task { index, aim, .. }: &Task<'_>,
        point: Result<IdaPoint, IdaError>,
    ) -> bool {
        // Ahead of an overturning that has ended the curve.
        let Some(active) = self.climbs.get_mut(index) else { return false };
        active.out -= 1;
        match point {
            Ok(point) => active.climb.accept(*aim, point),
            Err(error) => {
                self.end(*index, Err(error));
                return true;
            }
        }
        if !active.climb.is_done() {
            return false;
        }
        if let Some(active) = self.climbs.remove(index) {
            self.results.push((*index, Ok(active.climb.finish())));
        }
        true
    }

    fn end(&mut self, index: usize, result: Result<IdaCurve, IdaError>) {
        self.climbs.remove(&index);
        self.results.push((index, result));
    }
}

impl<'a> pool::Source<'a> for Desk<'_, 'a> {
    type Task = Task<'a>;

    fn take(&mut self) -> Option<(Task<'a>, Scene<'a>, WorkLimit)> {
        if self.watch.is_stopped() {
            return None;
        }
        let mut ended = 0;
        let task = self.queue.open().take(self.last, &mut ended);
        for _ in 0..ended {
            self.watch.done();
        }
        task.map(|task| {
            let (scene, limit) = (task.level.scene, task.level.work_limit);
            (task, scene, limit)
        })
    }

    fn settle(&mut self, task: Task<'a>, response: Option<&Response>) {
        self.last = Some(task.index);
        let point = match response {
            Some(response) => task.level.point(response),
            // Alone, it says where it passes its limit.
            None => task.level.run(Isa::best()),
        };
        if self.queue.open().settle(&task, point) {
            self.watch.done();
        }
    }
}

/// Curves by class, the longest started first.
fn queues<'a>(
    records: &'a [NormalisedRecord],
    analyses: &'a [Analysis],
    isa: Isa,
) -> Vec<Queue<'a>> {
    let mut classes: BTreeMap<Option<Class>, Vec<Job<'a>>> = BTreeMap::new();
    let mut index = 0;
    for analysis in analyses {
        for record in records {
            let p = analysis.block.frequency_rad_s();
            let length = record.dt_s() * p;
            let class = pool::class_of(analysis.model, length, analysis.order)
                .filter(|_| isa.is_wide());
            let work = work(record, analysis);
            let job = Job { index, analysis, record, work };
            classes.entry(class).or_default().push(job);
            index += 1;
        }
    }
    classes
        .into_iter()
        .map(|(class, mut jobs)| {
            jobs.sort_by(|a, b| a.work.total_cmp(&b.work));
            let (climbs, results) = (BTreeMap::new(), Vec::new());
            let book = Mutex::new(Book { jobs, climbs, results });
            Queue { class, book }
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
