//! Null distributions for a shift that was estimated from the same records.
//!
//! Lilliefors' table is valid for a shift known beforehand. An estimated one
//! moves D with the sample, so the null is simulated with the estimate
//! repeated.

use libm::{exp, log};

use super::{LillieforsError, NullDistribution};
use crate::sample::{mean, sum_of_squares};
use crate::streams::{Stream, Streams, standard_normal};
use crate::{QuantileType, Sample};

/// Draws in a row that may fall below their shift: a valid model has only a
/// few.
const REDRAWS: u64 = 100;

/// Replicates that show whether the model is valid, before the others are
/// drawn.
const PILOTS: u64 = 128;

/// Marks a draw that was given up, among counts that cannot reach it.
const GIVEN_UP: u64 = 1 << 40;

/// A null distribution of D with the shift estimated anew in every draw.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct ShiftedNull {
    /// The distribution of D.
    pub null: NullDistribution,
    /// Draws with a capacity not above their shift, drawn again.
    pub redrawn: u64,
}

impl ShiftedNull {
    /// Null for a shift that is the lowest onset of the suite, IM_R = min
    /// u_i, as for PGV (u_i = p PGV_i/PGA_i).
    ///
    /// Pairs (u*, x*) are drawn from ln u and ln(x - IM_R) jointly normal
    /// with the sample's means, standard deviations and correlation; IM_R* =
    /// min u*; D of ln(x* - IM_R*). A draw with some x* <= IM_R* is drawn
    /// again and counted.
    ///
    /// # Errors
    /// [`LillieforsError`] unless 0 < onset < capacity, finite, for each of
    /// at least 4 pairs that vary.
    pub fn lowest_onset(
        onsets: &[f64],
        capacities: &[f64],
        replicates: u64,
        seed: u64,
    ) -> Result<Self, LillieforsError> {
        let n = onsets.len().min(capacities.len());
        if n < 4 || onsets.len() != capacities.len() {
            return Err(LillieforsError::TooFew { found: n, least: 4 });
        }
        let shift = onsets.iter().copied().fold(f64::INFINITY, f64::min);
        for (i, (&onset, &capacity)) in
            onsets.iter().zip(capacities).enumerate()
        {
            let positive = onset > 0.0 && capacity > shift;
            if !(positive && capacity.is_finite() && onset < capacity) {
                let number = i + 1;
                return Err(LillieforsError::Pair { number, onset, capacity });
            }
        }
        let u: Vec<f64> = onsets.iter().map(|u| log(*u)).collect();
        let y: Vec<f64> = capacities.iter().map(|x| log(x - shift)).collect();
        let model = Joint::new(&u, &y)?;
        let streams =
            Streams::new(&format!("lilliefors, lowest onset, {n}"), seed);
        let draw = |stream: &mut Stream, values: &mut [f64]| {
            let mut redrawn = 0;
            while !model.draw(shift, stream, values) {
                redrawn += 1;
                if redrawn == REDRAWS {
                    return GIVEN_UP;
                }
            }
            redrawn
        };
        let run = |replicates| {
            let drawn =
                NullDistribution::of_draws(n, replicates, &streams, draw)?;
            match drawn.1 {
                GIVEN_UP.. => Err(LillieforsError::Redraws(REDRAWS)),
                _ => Ok(drawn),
            }
        };
        run(PILOTS)?;
        let (null, redrawn) = run(replicates)?;
        Ok(Self { null, redrawn })
    }

    /// Null for a shift that is the sample's own smallest value, which is
    /// then left out (its logarithm is minus infinity): D of the others.
    ///
    /// Samples are drawn from a lognormal of the dispersion beta = ln((q84 -
    /// q50)/(q50 - q16))/0.99446 of `values`, with their 16, 50 and 84 %
    /// quantiles: a common shift leaves it as it is, as their median leaves D.
    /// The dispersion above the smallest value would not do: it is half as
    /// large again, and the test would reject up to six times as often as its
    /// level says. With 45 and 87 values and beta = 0.1 to 1, a level of 5 %
    /// rejects 3 to 6.5 %. If the quantiles are as far apart below the median
    /// as above it, the limit of small dispersions is taken.
    ///
    /// # Errors
    /// [`LillieforsError`] for values that are not finite or do not vary, and
    /// for fewer than four above the smallest.
    pub fn smallest_value(
        values: &[f64],
        replicates: u64,
        seed: u64,
    ) -> Result<Self, LillieforsError> {
        let sample = Sample::try_new(values)
            .map_err(|_| LillieforsError::Degenerate)?;
        let least = sample.sorted().first().copied();
        let above = values.iter().filter(|x| Some(**x) > least).count();
        let dispersion = dispersion_of_any_shift(&sample)?;
        Self::with_dispersion(above + 1, dispersion, replicates, seed)
    }

    /// [`smallest_value`](Self::smallest_value) of samples of `n` values with
    /// a known dispersion.
    fn with_dispersion(
        n: usize,
        dispersion: f64,
        replicates: u64,
        seed: u64,
    ) -> Result<Self, LillieforsError> {
        let rest = n.saturating_sub(1);
        let streams =
            Streams::new(&format!("lilliefors, smallest value, {n}"), seed);
        let draw = |stream: &mut Stream, values: &mut [f64]| {
            let one = |stream: &mut Stream| {
                let z = standard_normal(stream);
                exp(dispersion * z)
            };
            let mut smallest = one(stream);
            for value in &mut *values {
                let x = one(stream);
                *value = x.max(smallest);
                smallest = x.min(smallest);
            }
            for value in values {
                *value = log(*value - smallest);
            }
            0
        };
        let (null, redrawn) =
            NullDistribution::of_draws(rest, replicates, &streams, draw)?;
        Ok(Self { null, redrawn })
    }
}

/// Dispersion of a shifted lognormal by its quantiles, whatever its shift.
fn dispersion_of_any_shift(sample: &Sample) -> Result<f64, LillieforsError> {
    /// Normal quantile of 84 %.
    const NORMAL_84: f64 = 0.994_457_883_209_753;
    /// As good as normal.
    const LEAST: f64 = 1e-3;
    let at = |p| QuantileType::default().quantile(sample, p);
    let quantiles = [at(0.16), at(0.5), at(0.84)];
    let [Ok(low), Ok(middle), Ok(high)] = quantiles else {
        return Err(LillieforsError::Degenerate);
    };
    let dispersion = log((high - middle) / (middle - low)) / NORMAL_84;
    if dispersion.is_finite() {
        Ok(dispersion.max(LEAST))
    } else {
        Err(LillieforsError::Degenerate)
    }
}

/// Two normal variables, u and y, with a correlation.
struct Joint {
    means: [f64; 2],
    deviations: [f64; 2],
    correlation: f64,
}

impl Joint {
    fn new(u: &[f64], y: &[f64]) -> Result<Self, LillieforsError> {
        let means = [u, y].map(mean);
        let squares = [u, y].map(sum_of_squares);
        let cross = u.iter().zip(y).fold(0.0, |sum, (u, y)| {
            f64::mul_add(u - means[0], y - means[1], sum)
        });
        let degrees = u.len() as f64 - 1.0;
        let correlation = cross / (squares[0] * squares[1]).sqrt();
        if !(squares.iter().all(|x| *x > 0.0) && correlation.is_finite()) {
            return Err(LillieforsError::Degenerate);
        }
        let deviations = squares.map(|square| (square / degrees).sqrt());
        let correlation = correlation.clamp(-1.0, 1.0);
        Ok(Self { means, deviations, correlation })
    }

    /// Fills in ln(x* - IM_R*) of one draw, with x* = IM_R + exp(y*), and
    /// says whether all of them exist.
    fn draw(
        &self,
        shift: f64,
        stream: &mut Stream,
        values: &mut [f64],
    ) -> bool {
        let rest = (1.0 - self.correlation * self.correlation).sqrt();
        let ([mean_u, mean_y], [sd_u, sd_y]) = (self.means, self.deviations);
        let mut lowest = f64::INFINITY;
        for value in &mut *values {
            let a = standard_normal(stream);
            let b = standard_normal(stream);
            lowest = lowest.min(mean_u + sd_u * a);
            let z = self.correlation * a + rest * b;
            *value = shift + exp(mean_y + sd_y * z);
        }
        let drawn_shift = exp(lowest);
        for value in &mut *values {
            *value -= drawn_shift;
        }
        if values.iter().any(|&excess| excess <= 0.0) {
            return false;
        }
        for value in values {
            *value = log(*value);
        }
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lilliefors::LillieforsTable;
    use crate::normal;

    fn points(n: u32) -> impl Iterator<Item = f64> {
        (1..=n).map(move |i| {
            normal::quantile((f64::from(i) - 0.5) / f64::from(n))
        })
    }

    #[test]
    fn a_shift_that_hardly_varies_gives_the_tabulated_null() {
        // Onsets all but equal and far below: the estimate carries nothing.
        let onsets: Vec<f64> = points(40).map(|z| exp(1e-6 * z)).collect();
        let capacities: Vec<f64> =
            points(40).map(|z| 1.0 + exp(0.2 * z)).collect();
        let shifted =
            ShiftedNull::lowest_onset(&onsets, &capacities, 40_000, 0)
                .unwrap();
        assert_eq!(shifted.redrawn, 0);
        let ours = shifted.null.critical_value(0.05).unwrap();
        let (table, _) =
            LillieforsTable::embedded().critical_value(40, 0.05).unwrap();
        let gap = (ours.estimate.value() - table).abs();
        assert!(gap < 4.0 * ours.standard_error, "{ours:?} {table}");
    }

    #[test]
    fn an_estimated_shift_moves_the_null() {
        // The smallest value as shift makes the left tail heavy: a larger D
        // than the table's is expected under the null.
        let null = ShiftedNull::with_dispersion(41, 0.5, 20_000, 0).unwrap();
        assert_eq!(null.null.n(), 40);
        let ours = null.null.critical_value(0.05).unwrap();
        let (table, _) =
            LillieforsTable::embedded().critical_value(40, 0.05).unwrap();
        assert!(
            (ours.estimate.value() - table).abs() > 4.0 * ours.standard_error
        );
    }

    #[test]
    fn what_the_model_cannot_hold_is_refused() {
        let refused = |u: &[f64], x: &[f64]| {
            ShiftedNull::lowest_onset(u, x, 1000, 0).unwrap_err()
        };
        let (u, x) = ([1.0, 2.0, 3.0, 4.0], [2.0, 3.0, 4.0, 5.0]);
        assert!(matches!(
            refused(&u, &[2.0, 1.5, 4.0, 5.0]),
            LillieforsError::Pair { number: 2, .. }
        ));
        assert!(matches!(
            refused(&u, &[2.0, 3.0, 4.0, f64::INFINITY]),
            LillieforsError::Pair { number: 4, .. }
        ));
        assert_eq!(refused(&[1.0; 4], &x), LillieforsError::Degenerate);
        assert_eq!(
            refused(&u[1..], &x[1..]),
            LillieforsError::TooFew { found: 3, least: 4 }
        );
        for values in [&[1.0; 50][..], &[1.0, 2.0, 3.0, 4.0]] {
            assert!(ShiftedNull::smallest_value(values, 1000, 0).is_err());
        }
    }

    #[test]
    fn the_dispersion_does_not_hang_on_the_shift() {
        for (beta, shift) in [(0.3, 0.0), (0.3, 7.0), (1.0, -2.0)] {
            let values: Vec<f64> =
                points(2001).map(|z| shift + exp(beta * z)).collect();
            let sample = Sample::try_new(&values).unwrap();
            let found = dispersion_of_any_shift(&sample).unwrap();
            assert!((found - beta).abs() < 2e-3 * beta, "{found}");
        }
        // A longer tail below than above.
        let values: Vec<f64> = points(101).map(|z| -exp(0.5 * z)).collect();
        let sample = Sample::try_new(&values).unwrap();
        assert_eq!(dispersion_of_any_shift(&sample).unwrap(), 1e-3);
    }
}
