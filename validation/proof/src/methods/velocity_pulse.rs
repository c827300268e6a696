//! Velocity pulses against a second implementation of the algorithm.

use std::f64::consts::PI;

use anyhow::Result;
use rocking::accelerogram::Accelerogram;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::intensity::velocity_pulse::{
    Candidate, candidates, pulse,
};
use serde::Deserialize;

use super::cells::Csv;
use super::method::{Context, Reply, WrongModel};

const EXPECTED: Csv = Csv::new("oracles/velocity_pulse.csv");

/// Sampling interval in s, and number of samples.
const SAMPLES: (f64, usize) = (0.01, 3000);

/// Amplitude, frequency in Hz and phase of the sines.
const SINES: [(f64, f64, f64); 5] = [
    (1.0, 0.7, 0.3),
    (0.8, 1.3, 1.1),
    (0.9, 2.1, 2.0),
    (0.7, 3.7, 0.5),
    (0.5, 5.3, 1.7),
];

/// A number of a candidate.
type PulseQuantity = fn(&Candidate) -> f64;

/// A pulse of Mavroeidis and Papageorgiou along one direction, and modulated
/// sines, rounded to a millionth of g.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PulseInput {
    motion: String,
    amplitude_m_s: f64,
    frequency_hz: f64,
    gamma: f64,
    phase_rad: f64,
    time_s: f64,
    angle_deg: f64,
    noise_g: f64,
}

impl PulseInput {
    fn acceleration_g(&self, t: f64) -> f64 {
        let w = 2.0 * PI * self.frequency_hz;
        let tau = t - self.time_s;
        if !(tau.abs() < self.gamma / (2.0 * self.frequency_hz)) {
            return 0.0;
        }
        let e = w / self.gamma;
        let (sin, cos) = libm::sincos(w * tau + self.phase_rad);
        let (envelope_sin, envelope_cos) = libm::sincos(e * tau);
        0.5 * self.amplitude_m_s
            * (-w * sin * (1.0 + envelope_cos) - e * envelope_sin * cos)
            / STANDARD_GRAVITY_M_S2
    }

    fn component(&self, share: f64, number: f64) -> Result<Accelerogram> {
        let sample = |i: usize| {
            let t = SAMPLES.0 * i as f64;
            let envelope = self.noise_g * t / 8.0 * libm::exp(1.0 - t / 8.0);
            let sines = SINES.iter().fold(0.0, |sum, (a, f, phase)| {
                sum + a * libm::sin(2.0 * PI * f * t + number * phase)
            });
            let a = share * self.acceleration_g(t) + envelope * sines;
            (a * 1e6).round() / 1e6
        };
        let samples = (0..SAMPLES.1).map(sample).collect();
        Ok(Accelerogram::try_new("case", SAMPLES.0, samples)?)
    }
}

/// The five candidates of a pair, and whether one is a pulse.
pub fn pulses(context: &Context, answer: &mut Reply) -> Result<()> {
    let input: PulseInput = context.input()?;
    let (sin, cos) = libm::sincos(input.angle_deg.to_radians());
    let first = input.component(cos, 1.0)?;
    let silent =
        Accelerogram::try_new("case", SAMPLES.0, vec![0.0; SAMPLES.1])?;
    let second = input.component(sin, 2.0)?;
    let second = context.or(WrongModel::OneComponent, silent, second);
    // PGV enters in cm/s.
    let unit = context.or(WrongModel::VelocityInMS, 0.01, 1.0);
    let found = candidates(&first, &second, unit * STANDARD_GRAVITY_M_S2)?;
    let quantities: [(&str, PulseQuantity); 8] = [
        ("period_s", |c| c.period_s),
        ("time_s", |c| c.time_s),
        ("direction_rad", |c| c.direction_rad),
        ("pgv_m_s", |c| c.pgv_m_s),
        ("pgv_ratio", |c| c.pgv_ratio),
        ("energy_ratio", |c| c.energy_ratio),
        ("indicator", |c| c.indicator),
        ("late", |c| f64::from(u8::from(c.late))),
    ];
    for (name, value) in quantities {
        let row = EXPECTED.row(&[&input.motion, name])?;
        let expected = row.numbers::<5>(2)?;
        answer.put(&name.replace('_', "-"), found.iter().map(value), expected);
    }
    let late = found.iter().find(|c| c.indicator > 0.0);
    let chosen = context.or(WrongModel::LatePulsesKept, late, pulse(&found));
    answer.see("pulse-like", [f64::from(chosen.is_some())]);
    if let Some(shown) = chosen.or(found.first()) {
        let known = shown.period_s * input.frequency_hz;
        answer.see("period-over-known", [known]);
    }
    Ok(())
}
