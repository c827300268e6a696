//! The committed table of critical values, and p-values between them.

use std::sync::LazyLock;

use super::{LillieforsError, NullSource, Statistic};
use crate::{Estimate, Interval, Range, normal};

/// Written by `rocking lilliefors --write-table`.
const CSV: &str = include_str!("table.csv");

static TABLE: LazyLock<LillieforsTable> =
    LazyLock::new(|| LillieforsTable::parse(CSV));

/// Simulated critical values of D for n from 4 to 1000, and those of larger
/// n that follow from them.
///
/// Every n from 4 to 100 is simulated, and selected ones to 1000. Between
/// sizes sqrt(n) D is linear in 1/sqrt(n); between levels the normal score of
/// the level is a monotone cubic in D. Both interpolations together err less
/// than 0.6 % of p(1 - p) (1.2 % for n = 4, whose density has kinks), which
/// the interval of a p-value contains; this is checked by leaving levels and
/// sizes out, which errs four times as much. Above n = 1000 the line through n
/// = 100 and 1000 goes on: it errs less than 0.003 in p, up to n = 100,000.
#[derive(Clone, Debug)]
pub struct LillieforsTable {
    columns: Vec<LevelColumn>,
}

/// The critical values of one size, levels falling.
#[derive(Clone, Debug)]
struct LevelColumn {
    n: usize,
    replicates: f64,
    levels: Vec<f64>,
    values: Vec<f64>,
    errors: Vec<f64>,
}

/// A p-value of the table.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct TabledPValue {
    /// The value with its interval.
    pub estimate: Estimate,
    /// Whether it lies among the sizes and levels of the table.
    pub source: NullSource,
}

impl LillieforsTable {
    /// The table that the project simulated.
    pub fn embedded() -> &'static Self {
        &TABLE
    }

    /// Levels at which critical values are tabulated, falling.
    pub const LEVELS: [f64; 32] = [
        0.99, 0.975, 0.95, 0.9, 0.85, 0.8, 0.75, 0.7, 0.6, 0.5, 0.4, 0.3,
        0.25, 0.2, 0.15, 0.1, 0.075, 0.05, 0.04, 0.03, 0.025, 0.02, 0.015,
        0.01, 0.0075, 0.005, 0.0025, 0.002, 0.001, 0.0005, 0.00025, 0.0001,
    ];

    /// Sizes that are simulated, with their numbers of replicates.
    pub fn sizes() -> Vec<(usize, u64)> {
        let selected = [150, 200, 300, 400, 600, 900, 1000];
        (4..=100)
            .chain(selected)
            .map(|n| match n {
                44 | 86 => (n, 40_000_000),
                10 | 20 | 30 | 50 | 100 => (n, 10_000_000),
                300 => (n, 4_000_000),
                150.. => (n, 1_000_000),
                _ => (n, 2_000_000),
            })
            .collect()
    }

    /// Reads rows `n,replicates,level,critical_value,standard_error`; a row
    /// that is no such row is left out, which the tests would see.
    fn parse(csv: &str) -> Self {
        let rows = csv.lines().filter_map(|line| {
            let fields = line.split(',').filter_map(|f| f.parse().ok());
            fields.collect::<Vec<f64>>().try_into().ok()
        });
        let rows: Vec<[f64; 5]> = rows.collect();
        let column = |own: &[[f64; 5]]| {
            let each = |k: usize| own.iter().map(|row| row[k]).collect();
            LevelColumn {
                n: own[0][0] as usize,
                replicates: own[0][1],
                levels: each(2),
                values: each(3),
                errors: each(4),
            }
        };
        let columns = rows.chunk_by(|a, b| a[0] == b[0]).map(column);
        Self { columns: columns.collect() }
    }

    /// Critical value and its standard error at a size and a tabulated or
    /// intermediate level.
    ///
    /// ```
    /// use rocking_statistics::lilliefors::LillieforsTable;
    /// let (value, error) = LillieforsTable::embedded().critical_value(86, 0.05)?;
    /// assert!((value - 0.09576).abs() < 5e-5 && error < 1.2e-5);
    /// # Ok::<(), rocking_statistics::lilliefors::LillieforsError>(())
    /// ```
    ///
    /// # Errors
    /// [`LillieforsError`] for n below 4, or outside the levels 0.0001 to
    /// 0.99.
    pub fn critical_value(
        &self,
        n: usize,
        level: f64,
    ) -> Result<(f64, f64), LillieforsError> {
        let column = self.column(n)?;
        let (high, low) =
            (column.levels[0], column.levels[column.levels.len() - 1]);
        if !(level >= low && level <= high) {
            return Err(LillieforsError::Level { level, low, high });
        }
        let i = column.levels.partition_point(|&l| l > level);
        if column.levels[i] == level {
            return Ok((column.values[i], column.errors[i]));
        }
        let scores = column.scores();
        let value =
            monotone_cubic(&scores, &column.values, -normal::quantile(level));
        Ok((value, column.errors[i - 1].max(column.errors[i])))
    }

    /// p-value of a statistic, with an interval that holds the Monte Carlo
    /// error of the table (95 %) and the error of interpolation. Beyond the
    /// levels 0.99 and 0.0001 the score goes on linearly, the interval is all
    /// beyond the level, and the source is [`NullSource::Extrapolated`].
    ///
    /// ```
    /// use rocking_statistics::lilliefors::{LillieforsTable, NullSource};
    /// let table = LillieforsTable::embedded();
    /// assert_eq!(table.p_value(86, 0.1)?.source, NullSource::Table);
    /// assert_eq!(table.p_value(86, 0.2)?.source, NullSource::Extrapolated);
    /// assert_eq!(table.p_value(2000, 0.02)?.source, NullSource::Scaled);
    /// # Ok::<(), rocking_statistics::lilliefors::LillieforsError>(())
    /// ```
    ///
    /// # Errors
    /// [`LillieforsError`] for n below 4, or a D that is not positive.
    pub fn p_value(
        &self,
        n: usize,
        d: f64,
    ) -> Result<TabledPValue, LillieforsError> {
        if d.is_nan() || d <= 0.0 {
            return Err(LillieforsError::Statistic(d));
        }
        let column = self.column(n)?;
        let ends = [0, column.values.len() - 1].map(|k| column.values[k]);
        let is_scaled = self.columns.last().is_some_and(|last| n > last.n);
        let source = match (ends[0] <= d && d <= ends[1], is_scaled) {
            (false, _) => NullSource::Extrapolated,
            (true, true) => NullSource::Scaled,
            (true, false) => NullSource::Table,
        };
        if d > ends[1] && d > Statistic::largest(n) {
            let none = Estimate::inside(0.0, Interval::rising(0.0, 0.0));
            return Ok(TabledPValue { estimate: none, source });
        }
        let score = monotone_cubic(&column.values, &column.scores(), d);
        let value = normal::cdf(-score);
        let spread = value * (1.0 - value);
        let half = f64::mul_add(
            normal::quantile(0.975),
            (spread / column.replicates).sqrt(),
            interpolation(n) * spread,
        );
        let (low, high) = match (d < ends[0], d > ends[1]) {
            (true, _) => (value.min(Self::LEVELS[0]), 1.0),
            (_, true) => (0.0, value.max(Self::LEVELS[31])),
            _ => (value - half, value + half),
        };
        let interval = Interval::rising(low, high).within(Range::Share);
        let estimate = Estimate::inside(value, interval);
        Ok(TabledPValue { estimate, source })
    }

    /// Mean of D of normal samples of n values, in probability: the integral
    /// of the critical value over the levels from 0 to 1.
    ///
    /// D of a sample less this mean is about 0 for a normal sample, and what
    /// is left is the distance of its distribution from the normal one.
    /// Between the tabulated levels it is integrated over normal scores from
    /// -6 to 6 by trapezoids; beyond the levels 0.99 and 0.0001 the score
    /// goes on linearly. n is 4 or more; the error is below 3e-5, from
    /// n = 10 on.
    ///
    /// ```
    /// use rocking_statistics::lilliefors::LillieforsTable;
    /// let mean = LillieforsTable::embedded().mean(86)?;
    /// assert!((mean - 0.06673).abs() < 1e-4);
    /// # Ok::<(), rocking_statistics::lilliefors::LillieforsError>(())
    /// ```
    ///
    /// # Errors
    /// [`LillieforsError`] for n below 4.
    pub fn mean(&self, n: usize) -> Result<f64, LillieforsError> {
        const STEPS: u32 = 240;
        const END: f64 = 6.0;
        let column = self.column(n)?;
        let scores = column.scores();
        let step = 2.0 * END / f64::from(STEPS);
        // Both densities at the ends are 6e-9: no half weights are needed.
        let sum = (0..=STEPS).fold(0.0, |sum, k| {
            let z = f64::mul_add(step, f64::from(k), -END);
            let d = monotone_cubic(&scores, &column.values, z);
            f64::mul_add(normal::pdf(z), d, sum)
        });
        Ok(step * sum)
    }

    /// The column of a size, interpolated if it is not there.
    fn column(&self, n: usize) -> Result<LevelColumn, LillieforsError> {
        let i = self.columns.partition_point(|column| column.n < n);
        let above = self.columns.get(i);
        if let Some(column) = above.filter(|column| column.n == n) {
            return Ok(column.clone());
        }
        let (below, above) = match above {
            _ if i == 0 => {
                return Err(LillieforsError::TooFew { found: n, least: 4 });
            }
            Some(above) => (&self.columns[i - 1], above),
            None => {
                let far = self.columns.partition_point(|c| c.n < 100);
                (&self.columns[far], &self.columns[i - 1])
            }
        };
        let root = |n: usize| (n as f64).sqrt();
        let (r0, r, r1) = (root(below.n), root(n), root(above.n));
        let share = (1.0 / r - 1.0 / r0) / (1.0 / r1 - 1.0 / r0);
        let mix = |a: &[f64], b: &[f64]| {
            let between = |(a, b): (&f64, &f64)| {
                f64::mul_add(share, r1 * b - r0 * a, r0 * a) / r
            };
            a.iter().zip(b).map(between).collect()
        };
        Ok(LevelColumn {
            n,
            replicates: below.replicates.min(above.replicates),
            levels: below.levels.clone(),
            values: mix(&below.values, &above.values),
            errors: mix(&below.errors, &above.errors),
        })
    }
}

/// Bound of the interpolation's error in p, in units of p(1 - p).
fn interpolation(n: usize) -> f64 {
    match n {
        4 => 0.012,
        5..=1000 => 0.006,
        _ => 0.03,
    }
}

impl LevelColumn {
    /// Normal scores of the levels, rising.
    fn scores(&self) -> Vec<f64> {
        self.levels.iter().map(|&level| -normal::quantile(level)).collect()
    }
}

/// Monotone cubic interpolation through rising x and y (slopes by the
/// harmonic mean of Fritsch and Butland, SIAM J. Sci. Stat. Comput. 5 (1984)
/// 300); linear beyond the ends.
fn monotone_cubic(x: &[f64], y: &[f64], at: f64) -> f64 {
    let last = x.len() - 1;
    let secant = |i: usize| (y[i + 1] - y[i]) / (x[i + 1] - x[i]);
    if at <= x[0] {
        return f64::mul_add(secant(0), at - x[0], y[0]);
    }
    if at >= x[last] {
        return f64::mul_add(secant(last - 1), at - x[last], y[last]);
    }
    let slope = |i: usize| {
        if i == 0 || i == last {
            return secant(i.min(last - 1));
        }
        let (h0, h1) = (x[i] - x[i - 1], x[i + 1] - x[i]);
        let (w0, w1) = (2.0 * h1 + h0, h1 + 2.0 * h0);
        (w0 + w1) / (w0 / secant(i - 1) + w1 / secant(i))
    };
    let i = x.partition_point(|&knot| knot <= at) - 1;
    let h = x[i + 1] - x[i];
    let t = (at - x[i]) / h;
    let rise = y[i + 1] - y[i];
    let (a, b) = (slope(i) * h - rise, rise - slope(i + 1) * h);
    y[i] + t * (rise + (1.0 - t) * (a * (1.0 - t) + b * t))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Error of an interpolated p at a known one, in units of p(1 - p), less
    /// four standard errors of the simulations behind it.
    fn excess(p: f64, known: f64, replicates: f64) -> f64 {
        let spread = known * (1.0 - known);
        let noise = 4.0 * 1.5 * (spread / replicates).sqrt();
        ((p - known).abs() - noise) / spread
    }

    #[test]
    fn levels_left_out_are_met_within_four_times_the_stated_error() {
        for column in &TABLE.columns {
            let scores = column.scores();
            for i in 1..column.values.len() - 1 {
                let without =
                    |all: &[f64]| [&all[..i], &all[i + 1..]].concat();
                let score = monotone_cubic(
                    &without(&column.values),
                    &without(&scores),
                    column.values[i],
                );
                let p = normal::cdf(-score);
                let error = excess(p, column.levels[i], column.replicates);
                let bound = 4.0 * interpolation(column.n);
                assert!(error < bound, "{}, {i}: {error}", column.n);
            }
        }
    }

    #[test]
    fn the_mean_has_the_sizes_of_the_table() {
        assert!(TABLE.mean(4).is_ok() && TABLE.mean(1001).is_ok());
        let too_few = LillieforsError::TooFew { found: 3, least: 4 };
        assert_eq!(TABLE.mean(3), Err(too_few));
    }

    #[test]
    fn sizes_left_out_are_met_within_four_times_the_stated_error() {
        for n in [150, 200, 300, 400, 600, 900] {
            let mut table = TABLE.clone();
            let i = table.columns.partition_point(|c| c.n < n);
            let known = table.columns.remove(i);
            for (value, level) in known.values.iter().zip(known.levels) {
                let p = table.p_value(n, *value).unwrap().estimate.value();
                let error = excess(p, level, known.replicates);
                let bound = 4.0 * interpolation(n);
                assert!(error < bound, "{n}, {level}: {error}");
            }
        }
    }
}
