//! Many curves at once: their analyses in the slots of the pool, on all
//! threads.
//!
//! `ida::curves` sorts the curves by class. Each thread calls `pool::run`,
//! class after class. `climb` has the analyses that a curve still needs;
//! `levels` makes the scene of a level and the point of its response. The pool
//! has 128 slots in 16 groups of eight lanes. A sweep steps all groups
//! (`LaneGroup::step`). Lanes that surely meet no event (`free_of_events`)
//! move on to the next sample of their record; `park` queues the
//! others. When enough lanes wait (`WaitKind::worth`), `LaneBatch::gather`
//! takes up to eight, `solve` makes their steps, `land` propagates the rough
//! estimate over their impacts, and `Pool::scatter` puts them back. The driver
//! makes the steps that a batch cannot (`Slot::advance`). `Desk::settle` hands
//! the response to its `Climb`. If p dt exceeds 0.1, or the machine has no
//! wide instructions, `ida::curve` runs the levels one by one.

use std::collections::BTreeMap;
use std::fmt;
use std::sync::{Mutex, MutexGuard, OnceLock, PoisonError};

use crate::excitation::NormalisedRecord;
use crate::ida::climb::{Aim, Climb};
use crate::ida::levels::ImLevel;
use crate::ida::{Analysis, IdaCurve, IdaError, IdaPoint, curve_at};
use crate::integrator::class::Class;
use crate::integrator::pool;
use crate::integrator::{
    Extent, Response, Scene, WorkLimit, uplift_threshold,
};
use crate::number::dispatch::Isa;

/// Options of [`curves`]. Default: the best instruction-set level of the
/// machine, no progress callback.
#[derive(Clone, Copy)]
pub struct Batch<'a> {
    /// Instruction-set level. It changes only the speed.
    pub isa: Isa,
    /// Called after each curve, from any thread.
    pub progress: &'a (dyn Fn() + Sync),
}

impl Default for Batch<'_> {
    fn default() -> Self {
        Self { isa: Isa::best(), progress: &|| () }
    }
}

impl fmt::Debug for Batch<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Batch").field("isa", &self.isa).finish()
    }
}

/// IDA of every record under every analysis: `result[a][r]`, in parallel
/// over curves, the same for any number of threads. A
/// [`Stop`](crate::stop::Stop) ends it before.
///
/// # Errors
/// The first error in the order of analyses and records.
///
/// ```
/// use rocking::{Block, Restitution};
/// use rocking::excitation::NormalisedRecord;
/// use rocking::ida::{Analysis, Batch, curves};
/// use rocking::accelerogram::Accelerogram;
/// let samples = (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
/// let record = Accelerogram::try_new("lobe", 0.01, samples.collect())?;
/// let records = [NormalisedRecord::new(&record)];
/// let restitution = Restitution::constant(0.92)?;
/// let block = Block::try_new(0.1, 3.0)?;
/// let analyses = [Analysis::paper(block, restitution)];
/// let all = curves(&records, &analyses, &Batch::default())?;
/// assert!(all[0][0].overturning.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn curves(
    records: &[NormalisedRecord],
    analyses: &[Analysis],
    batch: &Batch<'_>,
) -> Result<Vec<Vec<IdaCurve>>, IdaError> {
    let cells = || (0..records.len()).map(|_| OnceLock::new()).collect();
    let all: Vec<Vec<OnceLock<IdaCurve>>> =
        analyses.iter().map(|_| cells()).collect();
    for_each_curve(records, analyses, batch, &|a, r, curve| {
        // Each cell is filled once.
        let _ = all[a][r].set(curve);
    })?;
    let row = |cells: Vec<OnceLock<IdaCurve>>| {
        cells.into_iter().filter_map(OnceLock::into_inner).collect()
    };
    Ok(all.into_iter().map(row).collect())
}

/// As [`curves`], but passes each curve to `sink(a, r, curve)` as soon as it
/// is finished, so memory does not grow with finished curves.
///
/// `sink` is called once for each analysis `a` and record `r`, from any
/// thread and in any order; the curves are the same for any number of
/// threads.
///
/// # Errors
/// As [`curves`]. `sink` has then received some of the curves.
///
/// ```
/// use std::sync::atomic::{AtomicUsize, Ordering};
/// use rocking::{Block, Restitution};
/// use rocking::excitation::NormalisedRecord;
/// use rocking::ida::{Analysis, Batch, for_each_curve};
/// use rocking::accelerogram::Accelerogram;
/// let samples = (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
/// let record = Accelerogram::try_new("lobe", 0.01, samples.collect())?;
/// let restitution = Restitution::constant(0.92)?;
/// let analyses = [0.1, 0.12].map(|alpha| {
///     Analysis::paper(Block::try_new(alpha, 3.0).unwrap(), restitution)
/// });
/// let overturned = AtomicUsize::new(0);
/// for_each_curve(
///     &[NormalisedRecord::new(&record)],
///     &analyses,
///     &Batch::default(),
///     &|_, _, curve| {
///         let one = usize::from(curve.overturning.is_some());
///         overturned.fetch_add(one, Ordering::Relaxed);
///     },
/// )?;
/// assert_eq!(overturned.into_inner(), 2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn for_each_curve(
    records: &[NormalisedRecord],
    analyses: &[Analysis],
    batch: &Batch<'_>,
    sink: &(dyn Fn(usize, usize, IdaCurve) + Sync),
) -> Result<(), IdaError> {
    let isa = batch.isa;
    let watch =
        Watch { batch, records: records.len(), sink, error: Mutex::new(None) };
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
    let first = watch.error.into_inner();
    let first = first.unwrap_or_else(PoisonError::into_inner);
    first.map_or(Ok(()), |(_, error)| Err(error))
}

/// One curve to make.
#[derive(Clone, Copy)]
struct CurveJob<'a> {
    /// Place among the results.
    index: usize,
    analysis: &'a Analysis,
    record: &'a NormalisedRecord,
    /// Guess of the work, to start long curves first.
    work: f64,
}

/// The curves of a class. Curves without a class are made one by one.
struct CurveQueue<'a> {
    class: Option<Class>,
    book: Mutex<Book<'a>>,
}

/// Curves that wait, curves in progress, and finished curves.
struct Book<'a> {
    /// In the order of their start, the next one last.
    jobs: Vec<CurveJob<'a>>,
    climbs: BTreeMap<usize, Active<'a>>,
    /// Finished curves, until the thread that finished them hands them over.
    finished: Vec<(usize, Result<IdaCurve, IdaError>)>,
}

/// A curve in progress, and the number of its levels that are being run.
struct Active<'a> {
    climb: Climb<'a>,
    out: u64,
}

/// An analysis in a slot.
struct Task<'a> {
    /// Place of its curve.
    index: usize,
    aim: Aim,
    level: ImLevel<'a>,
}

/// Receiver of finished curves, of progress and of the first error.
struct Watch<'a> {
    batch: &'a Batch<'a>,
    records: usize,
    sink: &'a (dyn Fn(usize, usize, IdaCurve) + Sync),
    /// The first error in the order of the curves.
    error: Mutex<Option<(usize, IdaError)>>,
}

impl Watch<'_> {
    /// Hands a curve to the sink and reports progress.
    fn done(&self, (index, result): (usize, Result<IdaCurve, IdaError>)) {
        match result {
            Ok(curve) => {
                (self.sink)(index / self.records, index % self.records, curve);
            }
            Err(error) => {
                let mut first = open(&self.error);
                if first.as_ref().is_none_or(|(before, _)| index < *before) {
                    *first = Some((index, error));
                }
            }
        }
        (self.batch.progress)();
    }
}

/// Locks a mutex. Data of a thread that panicked are whole.
fn open<T>(mutex: &Mutex<T>) -> MutexGuard<'_, T> {
    mutex.lock().unwrap_or_else(PoisonError::into_inner)
}

impl<'a> CurveQueue<'a> {
    /// Makes curves until none is left to start.
    fn work(&self, isa: Isa, watch: &Watch<'_>) {
        if let Some(class) = self.class {
            let mut desk = Desk { queue: self, last: None, watch };
            pool::run(class, isa, &mut desk);
            return;
        }
        loop {
            // Not within a condition: it would hold the book.
            let job = open(&self.book).jobs.pop();
            let Some(job) = job else { return };
            let result = curve_at(job.record, job.analysis, isa);
            watch.done((job.index, result));
        }
    }
}

/// A thread at a queue.
struct Desk<'q, 'a> {
    queue: &'q CurveQueue<'a>,
    /// Curve of the analysis settled last.
    last: Option<usize>,
    watch: &'q Watch<'q>,
}

impl<'a> Book<'a> {
    /// The next analysis of a curve in progress, if it has one now.
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

    /// The next analysis: of the last curve, of a new one, or ahead of the
    /// curves in progress.
    fn take(&mut self, last: Option<usize>) -> Option<Task<'a>> {
        last.and_then(|index| self.next(index, false))
            .or_else(|| self.start())
            .or_else(|| self.ahead())
    }

    fn start(&mut self) -> Option<Task<'a>> {
        while let Some(job) = self.jobs.pop() {
            let index = job.index;
            match Climb::start(job.record, job.analysis) {
                Ok(climb) if !climb.is_done() => {
                    self.climbs.insert(index, Active { climb, out: 0 });
                    let task = self.next(index, false);
                    if task.is_some() {
                        return task;
                    }
                }
                done => self.finished.push((index, done.map(Climb::finish))),
            }
        }
        None
    }

    /// An analysis of the curve with the fewest analyses in progress.
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

    fn is_due(&self, Task { index, aim, .. }: &Task<'_>) -> bool {
        let active = self.climbs.get(index);
        active.is_some_and(|active| active.climb.is_due(*aim))
    }

    fn postpone(&mut self, Task { index, aim, .. }: &Task<'_>) {
        if let Some(active) = self.climbs.get_mut(index) {
            active.out -= 1;
            active.climb.postpone(*aim);
        }
    }

    fn settle(
        &mut self,
        Task { index, aim, .. }: &Task<'_>,
        point: Result<IdaPoint, IdaError>,
    ) {
        // Ahead of an overturning that has ended the curve.
        let Some(active) = self.climbs.get_mut(index) else { return };
        active.out -= 1;
        match point {
            Ok(point) => active.climb.accept(*aim, point),
            Err(error) => return self.end(*index, Err(error)),
        }
        if active.climb.is_done()
            && let Some(active) = self.climbs.remove(index)
        {
            self.finished.push((*index, Ok(active.climb.finish())));
        }
    }

    fn end(&mut self, index: usize, result: Result<IdaCurve, IdaError>) {
        self.climbs.remove(&index);
        self.finished.push((index, result));
    }
}

impl<'a> Desk<'_, 'a> {
    /// Works on the book, then hands over the curves that are finished.
    fn with_book<T>(&self, work: impl FnOnce(&mut Book<'a>) -> T) -> T {
        let mut book = open(&self.queue.book);
        let found = work(&mut book);
        let finished = std::mem::take(&mut book.finished);
        drop(book);
        for curve in finished {
            self.watch.done(curve);
        }
        found
    }
}

impl<'a> pool::SceneSource<'a> for Desk<'_, 'a> {
    type Task = Task<'a>;

    fn take(&mut self) -> Option<(Task<'a>, Scene<'a>, Extent, WorkLimit)> {
        let last = self.last;
        let task = self.with_book(|book| book.take(last));
        task.map(|task| {
            let ImLevel { scene, of, .. } = task.level;
            let Analysis { extent, work_limit, .. } = *of.analysis;
            (task, scene, extent, work_limit)
        })
    }

    fn settle(&mut self, task: Task<'a>, response: Option<&Response>) {
        self.last = Some(task.index);
        let point = match response {
            Some(response) if task.level.is_clear(response) => {
                task.level.point(response)
            }
            // Most levels ahead of the curve are never part of it.
            Some(_) if !self.with_book(|book| book.is_due(&task)) => {
                return self.with_book(|book| book.postpone(&task));
            }
            Some(response) => task.level.point(response),
            // A run alone says when it passes its limit.
            None => task.level.run(Isa::best()),
        };
        self.with_book(|book| book.settle(&task, point));
    }
}

/// Curves by class, the longest started first.
fn queues<'a>(
    records: &'a [NormalisedRecord],
    analyses: &'a [Analysis],
    isa: Isa,
) -> Vec<CurveQueue<'a>> {
    let mut classes: BTreeMap<Option<Class>, Vec<CurveJob<'a>>> =
        BTreeMap::new();
    let pairs =
        |analysis| records.iter().map(move |record| (analysis, record));
    let pairs = analyses.iter().flat_map(pairs);
    for (index, (analysis, record)) in pairs.enumerate() {
        let length = record.dt_s() * analysis.block.frequency_rad_s();
        let class = pool::class_of(analysis.model, length, analysis.order)
            .filter(|_| isa.is_wide());
        let work = work(record, analysis);
        let job = CurveJob { index, analysis, record, work };
        classes.entry(class).or_default().push(job);
    }
    classes
        .into_iter()
        .map(|(class, mut jobs)| {
            jobs.sort_by(|a, b| a.work.total_cmp(&b.work));
            let (climbs, finished) = (BTreeMap::new(), Vec::new());
            let book = Mutex::new(Book { jobs, climbs, finished });
            CurveQueue { class, book }
        })
        .collect()
}

/// Samples times a guess of the levels, for a block overturns at an
/// intensity that falls with p PGV/PGA.
fn work(record: &NormalisedRecord, analysis: &Analysis) -> f64 {
    let p = analysis.block.frequency_rad_s();
    let threshold = uplift_threshold(&analysis.block, analysis.model);
    let step_im = analysis.grid.step_im(threshold);
    let reach = 1.0 / (p * record.velocity_ratio_s());
    record.samples().len() as f64 * reach / step_im
}
