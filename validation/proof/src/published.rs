//! Published laws of rocking, computed from motions. One function serves the
//! embedded suites and, through `examples/published.rs`, recorded ones.

use std::fmt;

use anyhow::{Context as _, Result, bail};
use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{self, Analysis, Batch, Grid};
use rocking::names::named;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::intensity::{Measures, Settings};
use rocking_statistics::{ExtendedSample, QuantileType};

use crate::cases::WrongModel;

named! {
    /// A law that a source states, or that follows from its argument.
    pub enum PublishedLaw: "published law" {
        /// Similar blocks have the same top displacement.
        EqualDisplacement = "equal-displacement",
        /// Of two similar blocks the larger is the more stable.
        ScaleEffect = "scale-effect",
        /// Overturning has a lower limit in velocity.
        VelocityLimit = "velocity-limit",
        /// Half of the motions overturn where Sa(2 pi/p) = g tan(alpha).
        EnergyEstimate = "energy-estimate",
    }
}

/// A statistic over the motions of a suite; all ratios.
#[derive(Clone, Debug, PartialEq)]
pub struct PublishedValue {
    /// The law.
    pub law: PublishedLaw,
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

impl fmt::Display for PublishedValue {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { law, quantity, p_rad_s, motions, value } = self;
        let law = law.name();
        write!(f, "{law},{quantity},{p_rad_s},{motions},{value:.4}")
    }
}

/// Statistics of the recorded suites, which are not in the project.
const RECORDED: &str = rocking_fixtures::text("comparison/published.csv");

/// Columns of `fixtures/comparison/published.csv`.
pub const HEADER: &str = "suite,law,quantity,p_rad_s,motions,value";

/// The kept statistics of a law under a recorded suite, `ordinary` or `pulse`.
///
/// # Errors
/// If the table is not of the expected form: it is compiled in.
pub fn recorded(
    law: PublishedLaw,
    suite: &str,
) -> Result<Vec<PublishedValue>> {
    let mut lines = RECORDED.lines();
    if lines.next() != Some(HEADER) {
        bail!("published.csv: expected the columns {HEADER}");
    }
    let mut kept = Vec::new();
    for line in lines {
        let cells: Vec<&str> = line.split(',').collect();
        let [of, name, quantity, p, motions, value] = cells[..] else {
            bail!("published.csv: expected six cells, found `{line}`");
        };
        if of == suite && name == law.name() {
            kept.push(PublishedValue {
                law,
                quantity: quantity.into(),
                p_rad_s: p.parse().context("p_rad_s")?,
                motions: motions.parse().context("motions")?,
                value: value.parse().context("value")?,
            });
        }
    }
    Ok(kept)
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

/// How blocks answer the motions of a suite. Restitution is 0.92; alpha is
/// 0.15 for displacements and 0.1 for overturning.
#[derive(Clone, Debug)]
pub struct PublishedResponses {
    /// Peak theta/alpha by level, size and motion.
    tilts: Vec<Vec<Vec<f64>>>,
    /// PGA/(g tan alpha) at the first overturning, by size and motion.
    overturning: Vec<Vec<f64>>,
    /// Undamped and with 5 % of damping, by motion, all over PGA: spectral
    /// acceleration at 2 pi/p by size, then PGV, in s.
    over_pga: [Vec<Vec<f64>>; 2],
}

impl PublishedResponses {
    /// Of the motions of a suite.
    ///
    /// # Errors
    /// For motions that cannot be analysed.
    pub fn of(motions: &[Accelerogram]) -> Result<Self> {
        let records: Vec<NormalisedRecord> =
            motions.iter().map(NormalisedRecord::new).collect();
        let tilts = |im: f64, p: f64| {
            let analysis = analysis(ALPHA, p)?;
            let one = |record| {
                anyhow::Ok(ida::demand_at(record, &analysis, im)?.edp())
            };
            records.iter().map(one).collect::<Result<Vec<f64>>>()
        };
        let level =
            |im: f64| SIMILAR_RAD_S.iter().map(|p| tilts(im, *p)).collect();
        let tilts: Result<Vec<_>> =
            LEVELS.iter().map(|im| level(*im)).collect();
        let grid = Grid::Im { step: 0.05 };
        let of_size =
            |p: &f64| anyhow::Ok(Analysis { grid, ..analysis(0.1, *p)? });
        let analyses: Result<Vec<Analysis>> =
            SIZES_RAD_S.iter().map(of_size).collect();
        let analyses = analyses?;
        let curves = ida::curves(&records, &analyses, &Batch::default())?;
        let im = |curve: ida::IdaCurve| {
            curve.overturning.map_or(f64::INFINITY, |first| first.im())
        };
        let row = |row: Vec<ida::IdaCurve>| row.into_iter().map(im).collect();
        let overturning = curves.into_iter().map(row).collect();
        let periods = SIZES_RAD_S.map(|p| 2.0 * std::f64::consts::PI / p);
        let measured = |damping| {
            let gravity = STANDARD_GRAVITY_M_S2;
            let with = Settings::try_new(gravity, damping, periods.to_vec())?;
            let one = |motion| {
                let of = Measures::of(motion, &with)?;
                let spectrum = of.spectral_acceleration_g.iter().copied();
                let all = spectrum.chain([of.pgv_m_s / gravity]);
                anyhow::Ok(all.map(|measure| measure / of.pga_g).collect())
            };
            motions.iter().map(one).collect::<Result<Vec<_>>>()
        };
        let over_pga = [measured(0.0)?, measured(0.05)?];
        Ok(Self { tilts: tilts?, overturning, over_pga })
    }

    /// The statistics of a law, or what a wrong model makes of them.
    ///
    /// # Errors
    /// For a suite without motions that count.
    pub fn statistics(
        &self,
        law: PublishedLaw,
        wrong: Option<WrongModel>,
    ) -> Result<Vec<PublishedValue>> {
        let mut found = Vec::new();
        let mut add = |quantity: String, p_rad_s, of: &[f64], value| {
            let motions = of.len();
            let one =
                PublishedValue { law, quantity, p_rad_s, motions, value };
            found.push(one);
        };
        if law == PublishedLaw::EqualDisplacement {
            for (im, tilts) in LEVELS.iter().zip(&self.tilts) {
                let [large, smaller @ ..] = tilts.as_slice() else { continue };
                for (p, small) in SIMILAR_RAD_S[1..].iter().zip(smaller) {
                    let pairs = small.iter().zip(large);
                    let count = |edp: &f64| *edp > 0.0 && *edp < CLOSE;
                    let pairs = pairs.filter(|(a, b)| count(a) && count(b));
                    let ratio = |(a, b): (&f64, &f64)| match wrong {
                        Some(WrongModel::TiltForDisplacement) => a / b,
                        _ => top(*a) / top(*b) / (p * p),
                    };
                    let all: Vec<f64> = pairs.map(ratio).collect();
                    for (name, share) in
                        [("low", 0.16), ("median", 0.5), ("high", 0.84)]
                    {
                        let value = quantile(&all, share)?;
                        add(format!("{name}-at-im-{im}"), *p, &all, value);
                    }
                }
            }
            return Ok(found);
        }
        let ims = |k: usize| match wrong {
            Some(WrongModel::UpliftForOverturning) => {
                vec![1.0; self.overturning[k].len()]
            }
            _ => self.overturning[k].clone(),
        };
        let mut tails = [f64::INFINITY, 0.0_f64];
        for (k, p) in SIZES_RAD_S.into_iter().enumerate() {
            let mut at = |name: &str, all: &[f64], value| {
                add(format!("{name}-at-p-{p}"), p, all, value);
            };
            let scaled = |damped: usize, measure: usize| -> Vec<f64> {
                let pairs = ims(k).into_iter().zip(&self.over_pga[damped]);
                pairs.map(|(im, motion)| im * motion[measure]).collect()
            };
            match law {
                PublishedLaw::EnergyEstimate => {
                    for (damped, name) in
                        ["undamped", "damped"].iter().enumerate()
                    {
                        let all = scaled(damped, k);
                        at(name, &all, quantile(&all, 0.5)?);
                    }
                }
                PublishedLaw::VelocityLimit => {
                    let pgv = scaled(0, SIZES_RAD_S.len());
                    let all: Vec<f64> = pgv.iter().map(|v| p * v).collect();
                    let tail = quantile(&all, 0.05)?;
                    tails = [tails[0].min(tail), tails[1].max(tail)];
                    at("least", &all, quantile(&all, 0.0)?);
                    at("tail", &all, tail);
                    at("median", &all, quantile(&all, 0.5)?);
                    add("tails".into(), p, &all, tails[1] / tails[0]);
                }
                _ if k == 0 => {}
                _ => {
                    let pairs = ims(k - 1).into_iter().zip(ims(k));
                    let all: Vec<f64> = pairs.map(|(a, b)| a / b).collect();
                    let more = all.iter().filter(|ratio| **ratio > 1.0);
                    let share = more.count() as f64 / all.len() as f64;
                    at("median", &all, quantile(&all, 0.5)?);
                    at("share", &all, share);
                }
            }
        }
        Ok(found)
    }
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
