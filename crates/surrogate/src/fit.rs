//! Coefficients by least squares, degrees by cross-validation.

use libm::{exp, log, sqrt};
use nalgebra::{DMatrix, DVector};
use rocking_statistics::Lognormal;
use serde::Serialize;

use super::model::{self, Degrees, Surface};
use super::{Fitted, SHIFT, SurrogateError};
use rocking_synthesis::SuiteKind;

/// Degrees that are tried.
const MOST: Degrees = Degrees { p: 8, alpha: 3 };

/// Share of the error that fewer terms may cost.
const SPARED: f64 = 0.1;

/// A surface that was tried.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct Choice {
    /// Its degrees.
    pub degrees: Degrees,
    /// Coefficients of each of its four surfaces.
    pub terms: usize,
    /// Root mean square of the largest difference in probability between a
    /// block's own fragility and the surface fitted without that block.
    pub error: f64,
}

/// One surface's coefficients, and its values at each block when fitted to
/// the others.
fn solve(matrix: &DMatrix<f64>, values: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let (q, r) = matrix.clone().qr().unpack();
    let values = DVector::from_column_slice(values);
    let turned = q.transpose() * &values;
    let solved = r.solve_upper_triangular(&turned);
    // Distinct blocks make columns that do not depend on each other.
    let own = solved.unwrap_or_else(|| DVector::zeros(matrix.ncols()));
    let fitted = matrix * &own;
    let without = (0..values.len())
        .map(|k| {
            let leverage = q.row(k).norm_squared();
            values[k] - (values[k] - fitted[k]) / (1.0 - leverage)
        })
        .collect();
    (own.iter().copied().collect(), without)
}

/// A suite's surfaces, and the squares of its errors block by block.
fn attempt(
    suite: SuiteKind,
    blocks: &[Fitted],
    degrees: Degrees,
) -> Result<(Surface, Vec<f64>), SurrogateError> {
    let own: Vec<&Fitted> =
        blocks.iter().filter(|b| b.suite == suite).collect();
    let terms = degrees.terms();
    let least = 2 * terms.len();
    if own.len() < least {
        return Err(SurrogateError::Few { found: own.len(), least });
    }
    let rows: Vec<f64> = own
        .iter()
        .flat_map(|b| model::terms((b.alpha_rad, b.p_rad_s), &terms))
        .collect();
    let matrix = DMatrix::from_row_slice(own.len(), terms.len(), &rows);
    let mus: Vec<f64> = own.iter().map(|b| log(b.median - SHIFT)).collect();
    let betas: Vec<f64> = own.iter().map(|b| log(b.dispersion)).collect();
    let (mu, mus) = solve(&matrix, &mus);
    let (beta, betas) = solve(&matrix, &betas);
    let mut squares = Vec::new();
    for (k, block) in own.iter().enumerate() {
        let found = Lognormal::try_new(SHIFT, mus[k], exp(betas[k]))?;
        let off = found.distance(&block.lognormal()?);
        let off = off.unwrap_or(f64::NAN);
        squares.push(off * off);
    }
    Ok((Surface { suite, terms, coefficients: [mu, beta] }, squares))
}

/// The surfaces of both suites, and all that were tried in the order of
/// their number of terms.
///
/// Each block's fragility is set against the surface fitted to the others
/// (leave one out). Of the degrees whose error is at most a tenth above the
/// least, those with the fewest terms are taken: with a thousand blocks each
/// further term improves the error by more than its chance, but not by what
/// anyone would see.
///
/// # Errors
/// [`SurrogateError`] for fewer blocks than a surface needs, or none of a
/// suite.
pub fn fit(
    blocks: &[Fitted],
) -> Result<(Vec<Surface>, Vec<Choice>), SurrogateError> {
    let mut tried = Vec::new();
    for p in 1..=MOST.p {
        for alpha in 0..=MOST.alpha.min(p) {
            let degrees = Degrees { p, alpha };
            let mut models = Vec::new();
            let mut squares = Vec::new();
            for suite in SuiteKind::ALL {
                let (model, own) = attempt(suite, blocks, degrees)?;
                models.push(model);
                squares.extend(own);
            }
            let sum = squares.iter().fold(0.0, |s, x| s + x);
            let error = sqrt(sum / squares.len() as f64);
            let terms = degrees.terms().len();
            let choice = Choice { degrees, terms, error };
            tried.push((choice, models));
        }
    }
    tried.sort_by(|(a, _), (b, _)| {
        a.terms.cmp(&b.terms).then(a.error.total_cmp(&b.error))
    });
    let choices: Vec<Choice> = tried.iter().map(|(c, _)| *c).collect();
    let least = choices.iter().map(|c| c.error).fold(f64::INFINITY, f64::min);
    let good = |c: &Choice| c.error <= (1.0 + SPARED) * least;
    let taken = tried.into_iter().find(|(c, _)| good(c));
    Ok((taken.map(|(_, models)| models).unwrap_or_default(), choices))
}
