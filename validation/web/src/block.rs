//! A block that the reader chooses.

use std::collections::BTreeMap;
use std::error::Error;
use std::mem::take;

use rocking::accelerogram::Accelerogram;
use rocking::excitation::{
    NormalisedRecord, Pulse, PulseName, PulseParameter, ScaledRecord,
};
use rocking::ida::{self, Analysis, BracketEnd, Grid};
use rocking::integrator::{
    CertifiedFate, Certify, Extent, Model, Response, Solver, certify,
    uplift_threshold,
};
use rocking::units::{AccelerationUnit, STANDARD_GRAVITY_M_S2};
use rocking::{Block, Excitation, Observe, Restitution, respond};
use rocking_procedures::{LawFragility, ModelError, law_fragility};
use rocking_records::intensity::{Measures, Settings};
use rocking_records::{ReadOptions, read_all};
use serde::{Deserialize, Serialize};

use crate::bits::Bits;

type Answer<T> = Result<T, Box<dyn Error>>;

/// A block by its two parameters, or by its lengths.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(untagged, deny_unknown_fields)]
pub enum LabBlock {
    Parameters { alpha_rad: f64, p_rad_s: f64 },
    Lengths { width_m: f64, height_m: f64 },
}

impl LabBlock {
    fn block(&self) -> Answer<Block> {
        Ok(match *self {
            Self::Parameters { alpha_rad, p_rad_s } => {
                Block::try_new(alpha_rad, p_rad_s)?
            }
            Self::Lengths { width_m: b, height_m: h } => {
                Block::from_dimensions(b, h, STANDARD_GRAVITY_M_S2)?
            }
        })
    }
}

/// The ground motion before scaling.
#[derive(Clone, Debug, Deserialize)]
pub struct LabGround {
    kind: String,
    samples_g: Option<Vec<f64>>,
    #[serde(flatten)]
    numbers: BTreeMap<String, f64>,
}

/// A record file from a page, with its interval and unit if known.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LabFile {
    name: String,
    text: String,
    dt_s: Option<f64>,
    unit: Option<String>,
}

/// A component of a record.
#[derive(Serialize)]
pub struct LabComponent {
    name: String,
    dt_s: f64,
    pga_g: f64,
    samples_g: Vec<f64>,
}

impl LabComponent {
    fn of(motion: &Accelerogram) -> Self {
        Self {
            name: motion.name().to_owned(),
            dt_s: motion.dt_s(),
            pga_g: motion.pga_g(),
            samples_g: motion.samples_g().to_vec(),
        }
    }
}

/// The components of a file, by the readers of the core.
pub fn read(file: &LabFile) -> Answer<Vec<LabComponent>> {
    let unit = file.unit.as_deref().map(|unit| {
        AccelerationUnit::parse(unit).ok_or_else(|| format!("unit {unit}"))
    });
    let unit = unit.transpose()?;
    let options =
        ReadOptions { dt_s: file.dt_s, unit, ..ReadOptions::default() };
    let records = read_all(&file.name, file.text.as_bytes(), &options)?;
    Ok(records.iter().map(|r| LabComponent::of(&r.accelerogram)).collect())
}

/// A block, its ground motion and the intensity.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LabScene {
    block: LabBlock,
    eta: f64,
    ground: LabGround,
    /// PGA/(g tan alpha); none leaves a record unscaled.
    intensity: Option<f64>,
}

enum LabMotion {
    Pulse(Pulse),
    Record(NormalisedRecord),
}

/// The embedded pulse-type motions, first components: those of the study.
pub fn motions() -> Answer<Vec<LabComponent>> {
    let pairs = rocking_synthesis::pulse()?.into_iter();
    Ok(pairs.map(|pair| LabComponent::of(&pair.components[0])).collect())
}

impl LabGround {
    fn motion(&self) -> Answer<LabMotion> {
        let kind = self.kind.as_str();
        let mut numbers = self.numbers.clone();
        let mut number = |key: &str| {
            let value = numbers.remove(key);
            value.ok_or_else(|| format!("{kind}: no number {key}"))
        };
        let motion = match (kind, self.samples_g.clone()) {
            ("record", Some(samples_g)) => {
                let dt_s = number("dt_s")?;
                let own = Accelerogram::try_new("ground", dt_s, samples_g)?;
                LabMotion::Record(NormalisedRecord::new(&own))
            }
            (_, Some(_)) => {
                return Err(format!("{kind}: unknown samples_g").into());
            }
            (_, None) => {
                let name = match kind {
                    "ricker" => PulseName::RickerSymmetric,
                    kind => kind.parse()?,
                };
                let pulse = name.kind(|parameter| match parameter {
                    PulseParameter::Amplitude | PulseParameter::Velocity => {
                        Ok(1.0)
                    }
                    PulseParameter::Cycles => Ok(2.0),
                    _ => number(&parameter.name().replace('-', "_")),
                })?;
                LabMotion::Pulse(Pulse::try_new(pulse)?)
            }
        };
        match numbers.into_keys().next() {
            Some(key) => Err(format!("{kind}: unknown {key}").into()),
            None => Ok(motion),
        }
    }
}

/// A response and its certificate.
#[derive(Serialize)]
pub struct LabResponse {
    alpha_rad: f64,
    p_rad_s: f64,
    width_m: f64,
    height_m: f64,
    pga_g: f64,
    bits: String,
    response: Response,
    certified: CertifiedFate,
    interval_s: f64,
    /// Rotation over alpha, and acceleration of the ground over g, at each
    /// interval.
    ratio: Vec<f64>,
    ground_g: Vec<f64>,
}

/// An IDA curve.
#[derive(Serialize)]
pub struct LabCurve {
    /// Intensity and demand (peak |theta|/alpha) of each standing analysis.
    points: Vec<[f64; 2]>,
    /// Intensity of the first overturning, bisected.
    overturning: Option<f64>,
    analyses: u64,
    bits: String,
}

/// A row of outcomes for each frequency parameter.
#[derive(Serialize)]
pub struct FateGrid {
    rows: Vec<Vec<&'static str>>,
    peaks: Vec<Vec<f64>>,
    bits: String,
}

impl LabScene {
    /// Runs `work` on the scene of a block at an intensity.
    fn at<T>(
        &self,
        block: Block,
        motion: &LabMotion,
        intensity: Option<f64>,
        work: impl FnOnce(&rocking::Scene<'_>, f64) -> Answer<T>,
    ) -> Answer<T> {
        let restitution = Restitution::constant(self.eta)?;
        let onset_g = uplift_threshold(&block, Model::Nonlinear);
        let pga_g = intensity.map(|intensity| intensity * onset_g);
        let pulse;
        let (excitation, pga_g) = match motion {
            LabMotion::Pulse(unit) => {
                let pga_g = pga_g.ok_or("a pulse needs an intensity")?;
                pulse = unit.with_pga(pga_g)?;
                (Excitation::Pulse(&pulse), pga_g)
            }
            LabMotion::Record(record) => {
                let pga_g = pga_g.unwrap_or(record.pga_g());
                let scaled = ScaledRecord::to_pga(record, pga_g);
                (Excitation::Record(scaled), pga_g)
            }
        };
        let scene = rocking::Scene::new(block, restitution, excitation);
        work(&scene, pga_g)
    }

    /// The response of the block, with its outcome in sufficient precision.
    pub fn response(&self) -> Answer<LabResponse> {
        let block = self.block.block()?;
        let motion = self.ground.motion()?;
        let lengths = block.dimensions(STANDARD_GRAVITY_M_S2)?;
        self.at(block, &motion, self.intensity, |scene, pga_g| {
            let interval_s = match &motion {
                LabMotion::Record(record) => record.dt_s(),
                LabMotion::Pulse(_) => 0.01,
            };
            let observe = Observe {
                events: true,
                accuracy: true,
                history_interval_s: Some(interval_s),
                ..Observe::default()
            };
            let mut response = respond(scene, &observe)?;
            let certified = certify(scene, &Certify::default())?;
            let history = take(&mut response.history);
            let alpha_rad = block.slenderness_rad();
            let ratio = history.iter().map(|p| p.rotation_rad / alpha_rad);
            let ratio: Vec<f64> = ratio.collect();
            let bits = Bits::default().add("peak", &[response.peak_ratio]);
            let bits = bits.add("ratio", &ratio).hex();
            let ground_g = history.iter().enumerate();
            let ground_g = ground_g.map(|(k, point)| match &motion {
                LabMotion::Record(record) => {
                    record.samples().get(k).map_or(0.0, |a| a * pga_g)
                }
                LabMotion::Pulse(pulse) => {
                    pulse.acceleration_g(point.time_s) * pga_g
                }
            });
            Ok(LabResponse {
                alpha_rad,
                p_rad_s: block.frequency_rad_s(),
                width_m: lengths.width_m,
                height_m: lengths.height_m,
                pga_g,
                bits,
                interval_s,
                ratio,
                ground_g: ground_g.collect(),
                certified,
                response,
            })
        })
    }

    /// The IDA of the record: levels of a tenth of the uplift threshold, the
    /// first overturning bisected.
    pub fn ida(&self) -> Answer<LabCurve> {
        let block = self.block.block()?;
        let motion = self.ground.motion()?;
        let restitution = Restitution::constant(self.eta)?;
        let LabMotion::Record(record) = motion else {
            return Err("an IDA needs a record".into());
        };
        let analysis = Analysis {
            grid: Grid::Im { step: 0.1 },
            refine: Some(ida::REFINEMENT),
            ..Analysis::paper(block, restitution)
        };
        let curve = ida::curve(&record, &analysis)?;
        let standing = curve.response(BracketEnd::Refined)?;
        let points: Vec<[f64; 2]> =
            standing.vertices().map(|(im, edp)| [im, edp]).collect();
        let overturning = standing.overturning_im();
        let first = overturning.unwrap_or(f64::INFINITY);
        let bits = Bits::default().add("points", points.as_flattened());
        let bits = bits.add("overturning", &[first]).hex();
        Ok(LabCurve { points, overturning, analyses: curve.analyses, bits })
    }

    /// Outcomes of blocks of the same slenderness and other sizes, at other
    /// intensities of the same motion.
    pub fn fates(
        &self,
        intensities: &[f64],
        p_rad_s: &[f64],
    ) -> Answer<FateGrid> {
        let alpha_rad = self.block.block()?.slenderness_rad();
        let motion = self.ground.motion()?;
        let solver = Solver { extent: Extent::Peak, ..Solver::default() };
        let observe = Observe { accuracy: true, ..Observe::default() };
        let (mut rows, mut peaks) = (Vec::new(), Vec::new());
        let mut bits = Bits::default();
        for p_rad_s in p_rad_s {
            let block = Block::try_new(alpha_rad, *p_rad_s)?;
            let (mut fates, mut row) = (Vec::new(), Vec::new());
            for intensity in intensities {
                let run = |scene: &rocking::Scene<'_>, _| {
                    Ok(solver.respond(scene, &observe)?)
                };
                let found = self.at(block, &motion, Some(*intensity), run)?;
                fates.push(found.outcome_name());
                row.push(found.peak_ratio);
            }
            bits = bits.add("peaks", &row);
            rows.push(fates);
            peaks.push(row);
        }
        Ok(FateGrid { rows, peaks, bits: bits.hex() })
    }
}

/// Fragility under a motion by the law of AvgSA.
#[derive(Serialize)]
pub struct LabFragility {
    average_sa_g: f64,
    /// Probability that a real block overturns.
    probability: f64,
    law: LawFragility,
}

/// Intervals in which the spectrum of a pulse is taken.
const INTERVALS: u32 = 1000;

impl LabScene {
    /// Probability of overturning by the law of AvgSA, only from the spectrum
    /// of the motion.
    pub fn fragility(&self) -> Answer<LabFragility> {
        let block = self.block.block()?;
        let motion = self.ground.motion()?;
        let error = ModelError::default();
        let law = law_fragility(&block, self.eta, f64::INFINITY, error)?;
        self.at(block, &motion, self.intensity, |_, pga_g| {
            let scaled = |a: f64| a * pga_g;
            let (dt_s, samples_g) = match &motion {
                LabMotion::Record(record) => {
                    let samples = record.samples().iter().copied();
                    (record.dt_s(), samples.map(scaled).collect())
                }
                LabMotion::Pulse(pulse) => {
                    let dt_s = pulse.duration_s() / f64::from(INTERVALS);
                    let samples = (0..=INTERVALS)
                        .map(|k| pulse.acceleration_g(f64::from(k) * dt_s));
                    (dt_s, samples.map(scaled).collect())
                }
            };
            let ground = Accelerogram::try_new("ground", dt_s, samples_g)?;
            let settings = Settings::of(STANDARD_GRAVITY_M_S2, [&law.im])?;
            let measures = Measures::of(&ground, &settings)?;
            let found = law.im.value(&measures, settings.periods_s());
            let average_sa_g = found.ok_or("no spectrum")?;
            let probability = law.total.cdf(average_sa_g);
            Ok(LabFragility { average_sa_g, probability, law })
        })
    }
}
