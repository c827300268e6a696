//! Published laws of rocking, computed from motions: of the embedded suites
//! and, through `examples/published.rs`, of recorded ones.

use anyhow::Result;
use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{self, Analysis, Batch, Grid, IdaCurve};
use rocking::names::named;
use rocking_statistics::{ExtendedSample, QuantileType};
use rocking_synthesis::SuiteKind;

use super::cells::Csv;
use super::method::{Context, Reply, WrongModel, suite};

named! {
    /// A law that a source states.
    pub enum PublishedLaw: "published law" {
        /// Similar blocks have the same top displacement.
        EqualDisplacement = "equal-displacement",
        /// Overturning has a lower limit in velocity.
        VelocityLimit = "velocity-limit",
    }
}

/// A statistic over the motions of a suite; all ratios.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedValue {
    /// Name of the statistic.
    pub quantity: String,
    /// Frequency parameter in rad/s; of the smaller block, where two are
    /// compared.
    pub p_rad_s: f64,
    /// Motions that count.
    pub motions: usize,
    /// The statistic.
    pub value: f64,
}

/// Sizes brought to overturning: each block is four times the next.
const SIZES_RAD_S: [f64; 3] = [1.5, 3.0, 6.0];

/// Sizes whose displacements are compared, the largest first.
const SIMILAR_RAD_S: [f64; 4] = [1.0, 2.0, 3.0, 4.0];

/// PGA/(g tan alpha) at which displacements are compared.
const LEVELS: [f64; 3] = [1.25, 1.5, 2.0];

/// Slenderness of the blocks whose displacements are compared, in rad.
const ALPHA: f64 = 0.15;

/// theta/alpha from which a block is close to overturning.
const CLOSE: f64 = 0.3;

/// The statistics of a law under motions, or their values by a wrong model.
/// Restitution is 0.92; alpha is 0.15 for displacements and 0.1 for
/// overturning.
///
/// # Errors
/// An error for motions that cannot be analysed, or if none of them counts.
pub fn statistics(
    law: PublishedLaw,
    motions: &[Accelerogram],
    wrong: Option<WrongModel>,
) -> Result<Vec<PublishedValue>> {
    let records: Vec<NormalisedRecord> =
        motions.iter().map(NormalisedRecord::new).collect();
    match law {
        PublishedLaw::EqualDisplacement => displacements(&records, wrong),
        PublishedLaw::VelocityLimit => {
            let of = |own: &Accelerogram| own.pgv_g_s() / own.pga_g();
            let pgv_over_pga_s: Vec<f64> = motions.iter().map(of).collect();
            velocities(&records, &pgv_over_pga_s, wrong)
        }
    }
}

/// Ratios of the displacements of similar blocks.
fn displacements(
    records: &[NormalisedRecord],
    wrong: Option<WrongModel>,
) -> Result<Vec<PublishedValue>> {
    let mut found = Vec::new();
    for im in LEVELS {
        let tilts = |p: f64| {
            let analysis = analysis(ALPHA, p)?;
            let one = |record| {
                anyhow::Ok(ida::demand_at(record, &analysis, im)?.edp())
            };
            records.iter().map(one).collect::<Result<Vec<f64>>>()
        };
        let large = tilts(SIMILAR_RAD_S[0])?;
        for p in SIMILAR_RAD_S.into_iter().skip(1) {
            let count = |edp: &f64| *edp > 0.0 && *edp < CLOSE;
            let pairs = tilts(p)?.into_iter().zip(&large);
            let pairs = pairs.filter(|(a, b)| count(a) && count(b));
            let ratio = |(a, b): (f64, &f64)| match wrong {
                Some(WrongModel::TiltForDisplacement) => a / b,
                _ => top(a) / top(*b) / (p * p),
            };
            let all: Vec<f64> = pairs.map(ratio).collect();
            for (name, share) in
                [("low", 0.16), ("median", 0.5), ("high", 0.84)]
            {
                found.push(PublishedValue {
                    quantity: format!("{name}-at-im-{im}"),
                    p_rad_s: p,
                    motions: all.len(),
                    value: quantile(&all, share)?,
                });
            }
        }
    }
    Ok(found)
}

/// p PGV/(g tan alpha) at the first overturning, with the ratio of the
/// largest to the smallest lower tail of the sizes so far.
fn velocities(
    records: &[NormalisedRecord],
    pgv_over_pga_s: &[f64],
    wrong: Option<WrongModel>,
) -> Result<Vec<PublishedValue>> {
    let mut found = Vec::new();
    let mut tails = [f64::INFINITY, 0.0_f64];
    let grid = Grid::Im { step: 0.05 };
    for p in SIZES_RAD_S {
        let analysis = Analysis { grid, ..analysis(0.1, p)? };
        let first = |curve: &IdaCurve| {
            curve.overturning.map_or(f64::INFINITY, |first| first.im())
        };
        let ims: Vec<f64> = match wrong {
            Some(WrongModel::UpliftForOverturning) => vec![1.0; records.len()],
            _ => ida::curves(records, &[analysis], &Batch::default())?
                .iter()
                .flatten()
                .map(first)
                .collect(),
        };
        let all = ims.iter().zip(pgv_over_pga_s);
        let all: Vec<f64> = all.map(|(im, pgv)| p * (im * pgv)).collect();
        let tail = quantile(&all, 0.05)?;
        tails = [tails[0].min(tail), tails[1].max(tail)];
        for (quantity, value) in [
            (format!("least-at-p-{p}"), quantile(&all, 0.0)?),
            (format!("tail-at-p-{p}"), tail),
            (format!("median-at-p-{p}"), quantile(&all, 0.5)?),
            ("tails".to_owned(), tails[1] / tails[0]),
        ] {
            let (p_rad_s, motions) = (p, all.len());
            found.push(PublishedValue { quantity, p_rad_s, motions, value });
        }
    }
    Ok(found)
}

fn quantile(values: &[f64], share: f64) -> Result<f64> {
    let sample = ExtendedSample::try_new(values)?;
    Ok(QuantileType::default().extended_quantile(&sample, share)?)
}

fn analysis(alpha: f64, p: f64) -> Result<Analysis> {
    let block = Block::try_new(alpha, p)?;
    Ok(Analysis::paper(block, Restitution::constant(0.92)?))
}

/// Displacement of the top over 2 R, by geometry; R = 3 g/(4 p^2).
fn top(edp: f64) -> f64 {
    libm::sin(ALPHA) - libm::sin(ALPHA - edp * ALPHA)
}

/// Statistics of the recorded suites, which are not in the project.
const RECORDED: Csv = Csv::new("comparison/published.csv");

/// The statistics of a law that the case bounds: of the embedded suites,
/// ordinary and pulse-type, then of the recorded ones.
pub fn laws(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context; law: PublishedLaw }
    let mut found = Vec::new();
    for kind in SuiteKind::ALL {
        let suite = suite(kind)?;
        let first = suite.iter().map(|pair| pair.components[0].clone());
        let motions: Vec<Accelerogram> = first.collect();
        let all = statistics(law, &motions, context.wrong)?;
        found.extend(all.into_iter().map(|own| (own.quantity, own.value)));
    }
    for suite in ["ordinary", "pulse"] {
        for row in RECORDED.rows(suite)? {
            if row.text(1) == law.name() {
                found.push((row.text(2).to_owned(), row.number(5)?));
            }
        }
    }
    for (name, value) in found {
        if context.case.tolerance.bounds.contains_key(&name) {
            // The ratio by the law, if it gives a number.
            answer.put(&name, [value], [1.0]);
        }
    }
    Ok(())
}
