//! How time and memory of many curves grow with records, samples and blocks.

use std::env::current_exe;
use std::fmt;
use std::process::Command;
use std::sync::atomic::{AtomicU64, Ordering};

use clap::ValueEnum;
use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Batch, Grid, for_each_curve};
use rocking::integrator::Overturning;
use rocking::record::Accelerogram;
use serde::{Deserialize, Serialize};

use super::SpeedError;
use super::cases::ETA;
use super::clock::{peak_memory_mib, process_s};

/// What grows.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize, ValueEnum,
)]
#[serde(rename_all = "kebab-case")]
pub enum Axis {
    /// Records of a suite, for one block.
    Records,
    /// Samples of one record, for 15 blocks at five levels, in whole runs.
    Samples,
    /// Blocks, under 8 records.
    Blocks,
}

impl Axis {
    /// All of them.
    pub const ALL: [Self; 3] = [Self::Records, Self::Samples, Self::Blocks];

    /// The sizes that are measured, in rising order; the first is none of
    /// it, for what the process takes anyway.
    #[must_use]
    pub fn sizes(self) -> [usize; 4] {
        match self {
            Self::Records => [0, 130, 1_300, 5_000],
            Self::Samples => [0, 10_000, 100_000, 1_000_000],
            Self::Blocks => [0, 15, 150, 1_500],
        }
    }
}

impl fmt::Display for Axis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Records => "records",
            Self::Samples => "samples",
            Self::Blocks => "blocks",
        })
    }
}

/// What a size takes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Point {
    /// What grows.
    pub axis: Axis,
    /// How many there are.
    pub size: usize,
    /// Analyses made.
    pub analyses: u64,
    /// Processor time of all threads for records and curves, in s.
    pub cpu_s: f64,
    /// Most memory that the process has held, in MiB, where the system says.
    pub peak_memory_mib: Option<f64>,
}

/// Exponents b of `cost = a size^b` between two neighbouring sizes.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Growth {
    /// Of the processor time.
    pub time: f64,
    /// Of the memory beyond that of size 0, where the system says.
    pub memory: Option<f64>,
}

/// The growth from `before` to `after`, both of one axis; `none` is its
/// size 0.
#[must_use]
pub fn growth(none: &Point, before: &Point, after: &Point) -> Growth {
    let sizes = libm::log(after.size as f64 / before.size as f64);
    let exponent = |from: f64, to: f64| libm::log(to / from) / sizes;
    let beyond =
        |point: &Point| Some(point.peak_memory_mib? - none.peak_memory_mib?);
    let memory = beyond(before).zip(beyond(after));
    Growth {
        time: exponent(before.cpu_s, after.cpu_s),
        memory: memory.map(|(from, to)| exponent(from, to)),
    }
}

/// Measures every size in a process of its own, for a process's peak of
/// memory never falls; `done` is called after each.
///
/// # Errors
/// [`SpeedError::Child`] where the program cannot be started once more, or
/// fails.
pub fn measure(done: &dyn Fn()) -> Result<Vec<Point>, SpeedError> {
    let child = |e: &dyn fmt::Display| SpeedError::Child(e.to_string());
    let program = current_exe().map_err(|e| child(&e))?;
    let mut points = Vec::new();
    for axis in Axis::ALL {
        for size in axis.sizes() {
            let found = Command::new(&program)
                .args(["speed", "--scale-point", &axis.to_string()])
                .args(["--size", &size.to_string()])
                .output()
                .map_err(|e| child(&e))?;
            if !found.status.success() {
                return Err(child(&String::from_utf8_lossy(&found.stderr)));
            }
            let point = serde_json::from_slice(&found.stdout);
            points.push(point.map_err(|e| child(&e))?);
            done();
        }
    }
    Ok(points)
}

/// One size, in this process: `motions` are repeated as often as needed.
///
/// # Errors
/// [`SpeedError`] for a record that cannot be analysed.
pub fn point(
    axis: Axis,
    size: usize,
    motions: &[Accelerogram],
) -> Result<Point, SpeedError> {
    let begin = process_s();
    let again = |n: usize| motions.iter().cycle().take(n);
    let middle = Block::try_new(0.15, 3.0)?;
    let (records, blocks) = match axis {
        Axis::Records => {
            (again(size).map(NormalisedRecord::new).collect(), vec![middle])
        }
        Axis::Samples => (long(motions, size)?, spread(15)?),
        Axis::Blocks => {
            (again(8).map(NormalisedRecord::new).collect(), spread(size)?)
        }
    };
    let restitution = Restitution::constant(ETA)?;
    let paper = |block: Block| Analysis::paper(block, restitution);
    // By this criterion a run goes on when its peak is known: a long record
    // would otherwise cost less than its length.
    let whole = |analysis: Analysis| Analysis {
        overturning: Overturning::HalfPi,
        grid: Grid::Im { step: 1.0 },
        highest_im: 6.0,
        ..analysis
    };
    let analyses: Vec<_> = blocks
        .into_iter()
        .map(paper)
        .map(|analysis| match axis {
            Axis::Samples => whole(analysis),
            Axis::Records | Axis::Blocks => analysis,
        })
        .collect();
    let count = AtomicU64::new(0);
    for_each_curve(&records, &analyses, &Batch::default(), &|_, _, curve| {
        count.fetch_add(curve.analyses, Ordering::Relaxed);
    })?;
    Ok(Point {
        axis,
        size,
        analyses: count.into_inner(),
        cpu_s: process_s() - begin,
        peak_memory_mib: peak_memory_mib(),
    })
}

/// One record of that many samples: `motions` one after another, at the
/// interval of the first.
fn long(
    motions: &[Accelerogram],
    samples: usize,
) -> Result<Vec<NormalisedRecord>, SpeedError> {
    let Some(first) = motions.first().filter(|_| samples > 0) else {
        return Ok(Vec::new());
    };
    let all = motions.iter().cycle().flat_map(|m| m.samples_g());
    let all = all.copied().take(samples).collect();
    let record = Accelerogram::try_new("long", first.dt_s(), all)?;
    Ok(vec![NormalisedRecord::new(&record)])
}

/// Blocks evenly spread over p = 1 to 5 rad/s and alpha = 0.05 to 0.30 rad,
/// by the additive recurrence of the plastic number.
fn spread(count: usize) -> Result<Vec<Block>, SpeedError> {
    const PLASTIC: f64 = 1.324_717_957_244_746;
    let turn = |k: usize, power: f64| (k as f64 * power).fract();
    (1..=count)
        .map(|k| {
            let alpha = 0.25f64.mul_add(turn(k, 1.0 / PLASTIC), 0.05);
            let p = 4.0f64.mul_add(turn(k, 1.0 / (PLASTIC * PLASTIC)), 1.0);
            Ok(Block::try_new(alpha, p)?)
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn growth_is_the_exponent_of_what_grows() {
        let at = |size, cpu_s, memory| Point {
            axis: Axis::Records,
            size,
            analyses: 0,
            cpu_s,
            peak_memory_mib: Some(memory),
        };
        let none = at(0, 0.0, 5.0);
        let (few, many) = (at(10, 2.0, 6.0), at(1000, 200.0, 15.0));
        let found = growth(&none, &few, &many);
        assert!((found.time - 1.0).abs() < 1e-12);
        assert!((found.memory.unwrap() - 0.5).abs() < 1e-12);
    }

    #[test]
    fn every_size_of_an_axis_makes_what_it_says() {
        let samples = (0..400).map(|k| 0.3 * libm::sin(f64::from(k) * 0.1));
        let motion =
            Accelerogram::try_new("wave", 0.01, samples.collect()).unwrap();
        let motions = [motion];
        for axis in Axis::ALL {
            let none = point(axis, 0, &motions).unwrap();
            assert_eq!(none.analyses, 0, "{axis}");
            assert!(point(axis, 30, &motions).unwrap().analyses > 0);
        }
        let record = &long(&motions, 1000).unwrap()[0];
        assert_eq!(record.samples().len(), 1000);
        let blocks = spread(1500).unwrap();
        let half = blocks.iter().filter(|b| b.frequency_rad_s() < 3.0).count();
        assert!((745..=755).contains(&half), "{half}");
    }
}
