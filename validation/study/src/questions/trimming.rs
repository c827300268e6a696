//! Does trimming bring Eq. 7 nearer to the sample?

use rayon::prelude::*;
use rocking_procedures::fragility::options::{CONSTANTS, Centre, Recipe};
use rocking_statistics::streams::{Streams, standard_normal};
use rocking_statistics::{ExtendedSample, Lognormal};

use super::answer::{self, Rows, StudyAnswer, TableCell, number, word};
use crate::estimates::mean;
use crate::fits::{MLE, trimmed};
use crate::normality::every;
use crate::results::StudyResults;
use rocking_common::paper::Intensity;
use rocking_common::words::{capital, percent};

/// Stride of the demand levels that enter.
const STRIDE: usize = 10;

/// Edges between the classes of skewness of ln(x - IM_R).
const EDGES: [f64; 3] = [-0.25, 0.25, 0.75];

/// Simulated samples of a shifted lognormal.
const DRAWS: u64 = 1000;

/// Kolmogorov distances of the trimmed and the untrimmed fragility; `None` for one
/// that is not defined.
type Distances = [Option<f64>; 2];

/// Trimmed against untrimmed: numbers of samples.
#[derive(Clone, Copy, Default)]
struct Outcomes {
    samples: usize,
    /// The trimmed fragility is nearer.
    nearer: usize,
    /// Only the trimmed fragility is defined.
    only: usize,
    /// The trimmed fragility is not defined.
    neither: usize,
}

pub(super) fn trimming_part(
    results: &StudyResults,
) -> anyhow::Result<StudyAnswer> {
    let mut table = Rows::default();
    let mut words = Vec::new();
    for (suite, found) in results.common() {
        let intensity = found.intensity;
        let rows: Vec<(usize, [Distances; 4])> = found
            .blocks
            .par_iter()
            .flat_map_iter(|block| {
                every(&block.samples, STRIDE).filter_map(|values| {
                    let sample = ExtendedSample::try_new(values).ok()?;
                    let class = class(skewness(values, block.shift)?);
                    Some((class, distances(&sample, block.shift, None)))
                })
            })
            .collect();
        let counts = count(&rows);
        let mut shares = Vec::new();
        for (class, by_constant) in counts.iter().enumerate() {
            let skewness = class_words(class);
            for (c, count) in CONSTANTS.into_iter().zip(by_constant) {
                let (suite, im) = (suite.kind.name(), intensity.name());
                let cells = count.cells(suite, im, &skewness, c);
                table.row_if(c == 0.25 || c == 1.0, cells);
            }
            let [low, .., high] = by_constant;
            if high.samples > 0 {
                shares.push(format!(
                    "{} for skewness {skewness} ({} samples; {} at c = 0.25)",
                    percent(high.share(), 0),
                    high.samples,
                    percent(low.share(), 0),
                ));
            }
        }
        if intensity == Intensity::Pga && !shares.is_empty() {
            words.push(format!(
                "{}, PGA, c = 1: trimming brings USFL7 nearer to the \
                 empirical fragility in {}.",
                capital(suite.kind.name()),
                shares.join(", ")
            ));
        }
    }
    let truth = simulated(results.ordinary.records.len())?;
    for (c, count) in CONSTANTS.into_iter().zip(truth) {
        let cells = count.cells("simulated", "shifted lognormal", "any", c);
        table.row(cells);
    }
    words.push(format!(
        "Where the truth is shifted lognormal (excess median 1, dispersion \
         0.6), trimming brings USFL7 nearer to it in {} of the samples at c \
         = 1 and in {} at c = 0.25.",
        percent(truth[3].share(), 0),
        percent(truth[0].share(), 0),
    ));
    Ok(table.answer("trimming", words.join(" ")))
}

impl Outcomes {
    fn add(&mut self, of: Distances) {
        self.samples += 1;
        match of {
            [Some(a), Some(b)] => self.nearer += usize::from(a < b),
            [Some(_), None] => self.only += 1,
            [None, _] => self.neither += 1,
        }
    }

    /// Share of the samples in which the trimmed fragility is nearer, or the only
    /// one.
    fn share(&self) -> f64 {
        (self.nearer + self.only) as f64 / self.samples as f64
    }

    fn cells(
        &self,
        suite: &str,
        im: &str,
        skewness: &str,
        c: f64,
    ) -> Vec<(&'static str, TableCell)> {
        vec![
            ("suite", word(suite)),
            ("im", word(im)),
            ("skewness", word(skewness)),
            ("c", number(c, 2)),
            ("samples", answer::count(self.samples)),
            ("trimmed_is_nearer", answer::count(self.nearer)),
            ("only_trimmed_is_defined", answer::count(self.only)),
            ("neither_is_defined", answer::count(self.neither)),
            ("share_helped", number(self.share(), 3)),
        ]
    }
}

/// Outcomes by class of skewness, then by constant.
fn count(rows: &[(usize, [Distances; 4])]) -> [[Outcomes; 4]; 4] {
    let mut counts = [[Outcomes::default(); 4]; 4];
    for (class, each) in rows {
        for (count, of) in counts[*class].iter_mut().zip(each) {
            count.add(*of);
        }
    }
    counts
}

/// Distances by constant from the truth, or from the empirical fragility if no
/// truth is given.
fn distances(
    sample: &ExtendedSample,
    shift: f64,
    truth: Option<&Lognormal>,
) -> [Distances; 4] {
    CONSTANTS.map(|c| {
        let centre = Centre::FittedMedian;
        [trimmed(), MLE].map(|method| {
            let recipe = Recipe::Transformed { method, centre, c };
            let made = recipe.fragility(sample, shift).ok()?;
            match truth {
                None => Some(made.kolmogorov_distance(sample)),
                Some(truth) => made.distance(truth),
            }
        })
    })
}

/// Outcomes for samples of a shifted lognormal, judged by the truth.
fn simulated(n: usize) -> anyhow::Result<[Outcomes; 4]> {
    let streams = Streams::new("study/trimming", 0);
    let truth = Lognormal::try_new(1.0, 0.0, 0.6)?;
    let rows: Vec<(usize, [Distances; 4])> = (0..DRAWS)
        .into_par_iter()
        .filter_map(|index| {
            let mut stream = streams.stream(index);
            let values: Vec<f64> = (0..n)
                .map(|_| 1.0 + libm::exp(0.6 * standard_normal(&mut stream)))
                .collect();
            let sample = ExtendedSample::try_new(&values).ok()?;
            Some((0, distances(&sample, 1.0, Some(&truth))))
        })
        .collect();
    Ok(count(&rows)[0])
}

/// Skewness of ln(x - shift): third central moment over the cube of the
/// standard deviation (divisor n).
fn skewness(values: &[f64], shift: f64) -> Option<f64> {
    let logs: Vec<f64> = values.iter().map(|x| libm::log(x - shift)).collect();
    let centre = mean(logs.iter().copied());
    let off = || logs.iter().map(|y| y - centre);
    let square = mean(off().map(|d| d * d));
    let cube = mean(off().map(|d| d * d * d));
    let finite = logs.iter().all(|y| y.is_finite());
    (finite && square > 0.0).then(|| cube / (square * square.sqrt()))
}

fn class(skewness: f64) -> usize {
    EDGES.partition_point(|edge| *edge <= skewness)
}

fn class_words(class: usize) -> String {
    match class {
        0 => format!("below {}", EDGES[0]),
        k if k == EDGES.len() => format!("above {}", EDGES[k - 1]),
        k => format!("{} to {}", EDGES[k - 1], EDGES[k]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn skewness_is_the_textbook_s() {
        let logs: [f64; 4] = [0.0, 1.0, 2.0, 7.0];
        let values = logs.map(|y| 3.0 + libm::exp(y));
        let found = skewness(&values, 3.0).expect("skewness");
        // Deviations -2.5, -1.5, -0.5, 4.5: squares 29/4, cubes 72/4.
        let expected = 18.0 / (7.25 * 7.25_f64.sqrt());
        assert!((found - expected).abs() < 1e-12, "{found}");
        assert!(skewness(&values, 4.0).is_none());
        assert!(skewness(&[5.0, 5.0], 3.0).is_none());
        assert_eq!([-1.0, 0.0, 0.5, 2.0].map(class), [0, 1, 2, 3]);
    }

    #[test]
    fn trimming_helps_a_sample_with_a_long_right_tail() {
        let z = rocking_statistics::normal::quantile;
        let values: Vec<f64> = (0..86)
            .map(|i| {
                let x = libm::exp(0.6 * z((f64::from(i) + 0.5) / 86.0));
                1.0 + if i < 82 { x } else { 8.0 * x }
            })
            .collect();
        let sample = ExtendedSample::try_new(&values).expect("sample");
        let mut found = Outcomes::default();
        found.add(distances(&sample, 1.0, None)[3]);
        assert_eq!((found.samples, found.nearer + found.only), (1, 1));
    }
}
