//! High-precision references, embedded; every number is a decimal string
//! with 36 or 40 digits.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use anyhow::{Error, Result, anyhow};
use rocking::excitation::{PulseName, PulseParameter as P};
use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real as _};
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::arithmetic::decimal;
use crate::pulse::rescaled;
use crate::scene::{Forcing, Model, Overturning, PulseKind, Scene};

/// An embedded file, read once.
pub(crate) struct Reference<T> {
    file: &'static str,
    text: &'static str,
    read: OnceLock<T>,
}

macro_rules! reference {
    ($name:literal) => {
        Reference {
            file: concat!("fixtures/references/", $name),
            text: rocking_fixtures::text(concat!("references/", $name)),
            read: OnceLock::new(),
        }
    };
}

static TRAJECTORIES: Reference<Cases<Trajectory>> =
    reference!("trajectories.json");
static RECORDS: Reference<BTreeMap<String, Record>> =
    reference!("records.json");
pub(crate) static LINEAR_PULSES: Reference<Cases<LinearPulse>> =
    reference!("linear_pulses.json");
pub(crate) static FREE_ROCKING: Reference<Cases<FreeRocking>> =
    reference!("free_rocking.json");
pub(crate) static RECT_PULSE: Reference<Cases<RectangularPulse>> =
    reference!("rect_pulse.json");
pub(crate) static SPECTRUM: Reference<Spectrum> =
    reference!("linear_overturning_spectrum.json");

impl<T: DeserializeOwned> Reference<T> {
    /// What the file holds.
    pub fn read(&self) -> Result<&T> {
        if let Some(read) = self.read.get() {
            return Ok(read);
        }
        let read = serde_json::from_str(self.text);
        let read = read.map_err(|error| self.lacks(error))?;
        Ok(self.read.get_or_init(|| read))
    }

    pub fn lacks(&self, what: impl std::fmt::Display) -> Error {
        anyhow!("{}: {what}", self.file)
    }
}

impl<T> Reference<Cases<T>>
where
    Cases<T>: DeserializeOwned,
{
    /// The entry of this number among the file's cases.
    pub fn entry(&self, number: usize) -> Result<&T> {
        let found = self.read()?.cases.get(number);
        found.ok_or_else(|| self.lacks(format!("no entry {number}")))
    }
}

/// A file of cases.
#[derive(Deserialize)]
pub(crate) struct Cases<T> {
    pub cases: Vec<T>,
}

/// A decimal of a file: the nearest double, and the decimal to the last bits
/// of a double-double.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub(crate) struct Digits {
    pub near: f64,
    pub wide: DoubleDouble,
}

impl TryFrom<String> for Digits {
    type Error = String;

    fn try_from(text: String) -> Result<Self, String> {
        // Words may follow the decimal.
        let near = text.split_whitespace().next().map(str::parse);
        let both = near.and_then(Result::ok).zip(decimal(&text));
        let (near, wide) = both.ok_or(format!("`{text}` is no decimal"))?;
        Ok(Self { near, wide })
    }
}

/// An impact: its time, and the speed before it.
#[derive(Deserialize)]
pub(crate) struct Hit {
    #[serde(alias = "tau")]
    pub t: Digits,
    #[serde(alias = "theta_dot_before", alias = "phi_dot_before")]
    speed: Digits,
}

impl Hit {
    /// Time and speed, each times a unit.
    pub fn wide(&self, units: [f64; 2]) -> (DoubleDouble, DoubleDouble) {
        let [time, speed] = units.map(DoubleDouble::from_f64);
        (self.t.wide * time, self.speed.wide.abs() * speed)
    }
}

/// A trajectory under a record or a pulse.
#[derive(Deserialize)]
pub(crate) struct Trajectory {
    name: String,
    model: String,
    alpha: Digits,
    p: Digits,
    eta: Digits,
    g: Digits,
    forcing: Ground,
    pub expected: Expected,
    /// What a careful double-precision code was off by.
    pub attainable_float64: BTreeMap<String, Value>,
}

/// What the block does.
#[derive(Deserialize)]
pub(crate) struct Expected {
    pub n_uplifts: f64,
    pub uplifts: Vec<Uplift>,
    pub impacts: Vec<Hit>,
    #[serde(rename = "peak_of_hop_before_impact")]
    pub hops: Vec<Hop>,
    /// Numbers of impacts above a speed over p alpha.
    #[serde(rename = "n_impacts_with_speed_over_p_alpha_above")]
    pub faster: BTreeMap<String, f64>,
    t_first_abs_theta_eq_alpha: Option<Digits>,
    t_abs_theta_eq_pi_over_2: Option<Digits>,
    peak_abs_theta_over_alpha: String,
    pub t_peak: Option<Digits>,
    pub rest_times: Vec<Digits>,
    pub checkpoints: Vec<Checkpoint>,
}

#[derive(Deserialize)]
pub(crate) struct Uplift {
    pub t: Digits,
    pub side: f64,
}

#[derive(Deserialize)]
pub(crate) struct Hop {
    pub t: Digits,
    pub side: f64,
    pub abs_theta_over_alpha: Digits,
}

#[derive(Deserialize)]
pub(crate) struct Checkpoint {
    pub t: Digits,
    pub theta: Digits,
    pub theta_dot: Digits,
}

impl Expected {
    /// When the block overturns by a criterion.
    pub fn overturned(&self, criterion: Overturning) -> Option<Digits> {
        match criterion {
            Overturning::Alpha => self.t_first_abs_theta_eq_alpha,
            Overturning::HalfPi => self.t_abs_theta_eq_pi_over_2,
        }
    }

    /// The peak; none where the file says that pi/2 is reached.
    pub fn peak(&self) -> Option<Digits> {
        self.peak_abs_theta_over_alpha.clone().try_into().ok()
    }

    /// The impacts before it overturns, where a run ends.
    pub fn impacts_until(
        &self,
        criterion: Overturning,
    ) -> Vec<(DoubleDouble, DoubleDouble)> {
        let end = self.overturned(criterion);
        let before = |t: DoubleDouble| end.is_none_or(|end| t < end.wide);
        let all = self.impacts.iter().map(|hit| hit.wide([1.0; 2]));
        all.filter(|(t, _)| before(*t)).collect()
    }
}

/// A ground motion: its kind, and those parameters that the kind has.
#[derive(Deserialize)]
struct Ground {
    #[serde(alias = "pulse")]
    kind: String,
    #[serde(alias = "A")]
    a_p: Option<Digits>,
    #[serde(alias = "Omega")]
    omega: Option<Digits>,
    #[serde(alias = "tau_d")]
    t_d: Option<Digits>,
    #[serde(alias = "tau_p", rename = "T_p")]
    t_p: Option<Digits>,
    #[serde(rename = "n_Tp")]
    cycles: Option<f64>,
    #[serde(rename = "A_v")]
    a_v: Option<Digits>,
    f_p: Option<Digits>,
    gamma: Option<Digits>,
    nu: Option<Digits>,
    dt: Option<Digits>,
    acc: Option<Samples>,
    record: Option<String>,
}

/// Samples, or where they stand.
#[derive(Deserialize)]
#[serde(untagged)]
enum Samples {
    Here(Vec<Digits>),
    Elsewhere(String),
}

impl Ground {
    /// The pulse; none where the kind is not that of a pulse.
    fn pulse(&self) -> Result<Option<PulseKind>> {
        let name = match self.kind.as_str() {
            "one_sine" => PulseName::OneSine,
            "half_sine" => PulseName::HalfSine,
            "one_cosine" => PulseName::OneCosine,
            "rectangular" => PulseName::Rectangle,
            "triangular" => PulseName::Triangle,
            "ricker_sym" => PulseName::RickerSymmetric,
            "ricker_anti" => PulseName::RickerAntisymmetric,
            "mavroeidis" => PulseName::MavroeidisPapageorgiou,
            _ => return Ok(None),
        };
        let kind = name.kind(|parameter| {
            let found = match parameter {
                P::Amplitude => self.a_p,
                P::Omega => self.omega,
                P::Duration => self.t_d,
                P::Period => self.t_p,
                // A Ricker pulse is 4 periods long where nothing is said.
                P::Cycles => return Ok(self.cycles.unwrap_or(4.0)),
                P::Velocity => self.a_v,
                P::Frequency => self.f_p,
                P::Gamma => self.gamma,
                P::Phase => self.nu,
            };
            found.map(|found| found.near).ok_or_else(|| self.lacks())
        });
        kind.map(Some)
    }

    fn forcing(&self) -> Result<Forcing> {
        if let Some(pulse) = self.pulse()? {
            return Ok(Forcing::Pulse(pulse));
        }
        let acceleration_m_s2 = match (&self.acc, &self.record) {
            (Some(Samples::Here(acc)), _) => nearest(acc),
            (Some(Samples::Elsewhere(place)), Some(name))
                if place.ends_with(name) =>
            {
                record(name)?.1
            }
            _ => return Err(self.lacks()),
        };
        let dt_s = self.dt.ok_or_else(|| self.lacks())?.near;
        Ok(Forcing::Samples { dt_s, acceleration_m_s2 })
    }

    fn lacks(&self) -> Error {
        TRAJECTORIES.lacks(format!("ground motion of kind `{}`", self.kind))
    }
}

/// Times of impacts times `unit`, and speeds.
pub(crate) fn hits(list: &[Hit], unit: f64) -> Vec<(f64, f64)> {
    let pair = |hit: &Hit| (hit.t.near * unit, hit.speed.near.abs());
    list.iter().map(pair).collect()
}

/// The nearest doubles of a list.
pub(crate) fn nearest(list: &[Digits]) -> Vec<f64> {
    list.iter().map(|digits| digits.near).collect()
}

/// The trajectories, in their order.
pub(crate) fn trajectories() -> Result<&'static [Trajectory]> {
    TRAJECTORIES.read().map(|file| file.cases.as_slice())
}

/// The trajectory of this name.
pub(crate) fn trajectory(name: &str) -> Result<&'static Trajectory> {
    let found = trajectories()?.iter().find(|case| case.name == name);
    found.ok_or_else(|| TRAJECTORIES.lacks(format!("no case `{name}`")))
}

impl Trajectory {
    pub fn scene(&self, criterion: Overturning) -> Result<Scene> {
        let block = [self.alpha, self.p, self.g].map(|digits| digits.near);
        let scene = Scene::new(block, self.eta.near, self.forcing.forcing()?);
        let equation = match self.model.as_str() {
            "nonlinear" => Model::Nonlinear,
            "linear" => Model::Linearized,
            _ => return Err(TRAJECTORIES.lacks("another model")),
        };
        Ok(scene.in_equation(equation).to(criterion))
    }
}

/// A synthetic record.
#[derive(Deserialize)]
struct Record {
    dt: Digits,
    acc: Vec<Digits>,
}

/// A synthetic record: interval in s and samples in m/s2.
pub(crate) fn record(name: &str) -> Result<(f64, Vec<f64>)> {
    let found = RECORDS.read()?.get(name);
    let record = found.ok_or_else(|| RECORDS.lacks(format!("no `{name}`")))?;
    Ok((record.dt.near, nearest(&record.acc)))
}

/// A pulse on a block in Eq. 2: p t, theta/alpha and a/(g alpha).
#[derive(Deserialize)]
pub(crate) struct LinearPulse {
    #[serde(flatten)]
    ground: Ground,
    eta: Digits,
    pub expected: LinearExpected,
}

/// What the block does.
#[derive(Deserialize)]
pub(crate) struct LinearExpected {
    pub uplift_tau: Digits,
    pub side: f64,
    pub state_at_pulse_end: Option<LinearEnd>,
    pub impacts: Vec<Hit>,
    #[serde(rename = "peak_of_hop_before_impact")]
    pub hops: Vec<Digits>,
    pub verdict: Option<String>,
    #[serde(rename = "tau_first_abs_phi_eq_1")]
    pub overturned: Option<Digits>,
}

#[derive(Deserialize)]
pub(crate) struct LinearEnd {
    #[serde(rename = "E_plus")]
    pub growing: Digits,
    #[serde(rename = "E_minus")]
    pub decaying: Digits,
}

impl LinearPulse {
    /// A block (alpha, p, g) under the pulse.
    pub fn scene(
        &self,
        [alpha, p, g]: [f64; 3],
        criterion: Overturning,
    ) -> Result<Scene> {
        let pulse = self.ground.pulse()?.ok_or_else(|| self.ground.lacks())?;
        let forcing = Forcing::Pulse(rescaled(pulse, g * alpha, p));
        let scene = Scene::new([alpha, p, g], self.eta.near, forcing);
        Ok(scene.in_equation(Model::Linearized).to(criterion))
    }
}

/// A release, and what follows in both equations.
#[derive(Deserialize)]
pub(crate) struct FreeRocking {
    pub alpha: Digits,
    pub p: Digits,
    pub eta: Digits,
    pub theta0: Digits,
    pub nonlinear: FreeExpected,
    pub linear: FreeExpected,
}

#[derive(Deserialize)]
pub(crate) struct FreeExpected {
    pub impacts: Vec<Hit>,
    pub settling_time: Digits,
}

/// A rectangular pulse in Eq. 1.
#[derive(Deserialize)]
pub(crate) struct RectangularPulse {
    alpha: Digits,
    pub p: Digits,
    eta: Digits,
    a0: Digits,
    td: Digits,
    t_theta_eq_alpha: Option<Digits>,
    t_theta_eq_pi_over_2: Option<Digits>,
    #[serde(default)]
    pub impacts: Vec<Hit>,
    pub peak_over_alpha: Option<Digits>,
    pub t_peak: Option<Digits>,
    pub settling_time: Option<Digits>,
}

impl RectangularPulse {
    pub fn scene(&self, criterion: Overturning) -> Scene {
        let [amplitude, duration_s] = [self.a0.near, self.td.near];
        let pulse = PulseKind::Rectangle { amplitude, duration_s };
        let block = [self.alpha.near, self.p.near, 9.81];
        let forcing = Forcing::Pulse(pulse);
        Scene::new(block, self.eta.near, forcing).to(criterion)
    }

    /// When the block overturns by a criterion.
    pub fn overturned(&self, criterion: Overturning) -> Option<Digits> {
        match criterion {
            Overturning::Alpha => self.t_theta_eq_alpha,
            Overturning::HalfPi => self.t_theta_eq_pi_over_2,
        }
    }
}

/// Edges of overturning under one-sine pulses in Eq. 2.
#[derive(Deserialize)]
pub(crate) struct Spectrum {
    pub table: Vec<SpectrumRow>,
}

/// The edges at one restitution and frequency.
#[derive(Deserialize)]
pub(crate) struct SpectrumRow {
    pub eta: Digits,
    #[serde(rename = "Omega")]
    pub omega: Digits,
    pub mode2_lower: Digits,
    pub mode2_lower_alpha_criterion: Digits,
    pub mode1_lower: Option<Digits>,
    pub mode1_upper: Option<Digits>,
    #[serde(default)]
    pub multi_impact_bands: Vec<Band>,
}

/// A band of overturning after some impacts.
#[derive(Deserialize)]
pub(crate) struct Band {
    pub n_impacts: u32,
    pub lower: Digits,
    pub upper: Digits,
}
