//! Power of a design against simulated suites whose truth is known.

use libm::sqrt;
use rayon::prelude::*;
use rocking_common::findings::LEVEL;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::confidence::Confidence;
use rocking_statistics::power::Power;
use rocking_statistics::streams::{Streams, standard_normal};

use anyhow::Result;

use super::inference::SHARED;
use super::truths::SuiteShape;
use crate::methods::cells::{Csv, csv};
use crate::methods::method::{Context, Reply, WrongModel};

const VALUES: Csv = csv!("oracles/power.csv");

/// Replicates of a suite.
const REPLICATES: usize = 400;

/// Power of the mean of a suite that lies so many standard errors from a
/// limit: the mean of its probability, and the median of its multiple, over
/// simulated suites.
pub fn power(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context; like: SuiteShape, trials: u64, }
    let clusters = like.clusters();
    let drawn = context.drawn(&clusters);
    let sizes = (0..clusters.count()).map(|g| clusters.members(g).len());
    let variance = sizes.fold(0.0, |sum, size| {
        let size = size as f64;
        sum + size * size * (SHARED + (1.0 - SHARED) / size)
    });
    let error = sqrt(variance) / clusters.records() as f64;
    let level = context.or(WrongModel::OtherInterval, LEVEL, 0.95);
    let streams = Streams::new(&context.case.id, 0);
    let suite = |index: u64| -> Vec<f64> {
        let mut stream = streams.stream(index);
        let mut values = vec![0.0; clusters.records()];
        for event in 0..clusters.count() {
            let shared = sqrt(SHARED) * standard_normal(&mut stream);
            for record in clusters.members(event) {
                let own = standard_normal(&mut stream);
                values[*record] = shared + sqrt(1.0 - SHARED) * own;
            }
        }
        values
    };
    let found = |index: u64, distance: f64| -> Option<Power> {
        let values = suite(index);
        let mean = |places: &[usize]| {
            let sum = places.iter().fold(0.0, |sum, i| sum + values[*i]);
            sum / places.len() as f64
        };
        let point = mean(&(0..values.len()).collect::<Vec<usize>>());
        let name = format!("power/{index}");
        let draws = Bootstrap::of_clusters(&name, 0, &drawn, REPLICATES);
        let replicates: Vec<f64> =
            (0..REPLICATES as u64).map(|i| mean(&draws.draw(i))).collect();
        let known = Confidence::new(point, &replicates, &[])?;
        let ends = known.interval(drawn.half_width(level))?.interval;
        let deviations = drawn.deviations(point, &replicates);
        let limit = distance.mul_add(error, point);
        let own = (point, ends.low(), ends.high());
        let student = drawn.student_over_normal(level);
        Some(Power::of_measure(own, student, &deviations, |_, high| {
            high < limit
        }))
    };
    let name = match like {
        SuiteShape::Ordinary => "ordinary",
        SuiteShape::Pulse => "pulse-type",
    };
    for row in VALUES.rows(name)? {
        let distance = row.number(1)?;
        let all = (0..trials).into_par_iter().panic_fuse();
        let all: Vec<Power> =
            all.filter_map(|index| found(index, distance)).collect();
        let sum = all.iter().fold(0.0, |sum, power| sum + power.probability);
        let mut times: Vec<f64> = all.iter().map(|p| p.times).collect();
        times.sort_by(f64::total_cmp);
        let middle = times.get(times.len() / 2).copied();
        let quantities = [
            ("probability", sum / all.len() as f64),
            ("times", middle.unwrap_or(f64::NAN)),
        ];
        row.put(answer, 2, &quantities)?;
    }
    Ok(())
}
