//! High-precision references, embedded; every number is a decimal string
//! with 36 or 40 digits.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use anyhow::{Error, Result, anyhow};
use rocking::excitation::{PulseName, PulseParameter as P};
use rocking::number::Number as _;
use rocking::number::double::DoubleDouble;
use serde::Deserialize;
use serde::de::DeserializeOwned;
use serde_json::Value;

use crate::arithmetic::decimal;
use crate::pulse::rescaled;
use crate::scene::{
    CaseScene, Forcing, Model, Overturning, PulseKind, by_criterion,
};

/// An embedded file, read once.
pub(crate) struct ReferenceFile<T> {
    file: &'static str,
    text: &'static str,
    read: OnceLock<T>,
}

static TRAJECTORIES: ReferenceFile<Cases<Trajectory>> =
    ReferenceFile::new("references/trajectories.json");
static RECORDS: ReferenceFile<BTreeMap<String, ReferenceRecord>> =
    ReferenceFile::new("references/records.json");
pub(crate) static LINEAR_PULSES: ReferenceFile<Cases<LinearPulse>> =
    ReferenceFile::new("references/linear_pulses.json");
pub(crate) static FREE_ROCKING: ReferenceFile<Cases<FreeReference>> =
    ReferenceFile::new("references/free_rocking.json");
pub(crate) static RECT_PULSE: ReferenceFile<Cases<RectangularPulse>> =
    ReferenceFile::new("references/rect_pulse.json");
pub(crate) static SPECTRUM: ReferenceFile<Cases<SpectrumRow>> =
    ReferenceFile::new("references/linear_overturning_spectrum.json");

impl<T: DeserializeOwned> ReferenceFile<T> {
    /// The file of this path in `fixtures`.
    const fn new(file: &'static str) -> Self {
        let text = rocking_fixtures::text(file);
        Self { file, text, read: OnceLock::new() }
    }

    /// The parsed file.
    pub fn read(&self) -> Result<&T> {
        if let Some(read) = self.read.get() {
            return Ok(read);
        }
        let read = serde_json::from_str(self.text);
        let read = read.map_err(|error| self.lacks(error))?;
        Ok(self.read.get_or_init(|| read))
    }

    pub fn lacks(&self, what: impl std::fmt::Display) -> Error {
        anyhow!("fixtures/{}: {what}", self.file)
    }
}

impl<T: DeserializeOwned> ReferenceFile<Cases<T>> {
    /// The entry of this number among the file's cases.
    pub fn entry(&self, number: usize) -> Result<&T> {
        let found = self.read()?.cases.get(number);
        found.ok_or_else(|| self.lacks(format!("no entry {number}")))
    }
}

/// A file of cases.
#[derive(Deserialize)]
pub(crate) struct Cases<T> {
    #[serde(alias = "table")]
    pub cases: Vec<T>,
}

/// A decimal of a file: the nearest double, and the decimal to the last bits
/// of a double-double.
#[derive(Clone, Copy, Deserialize)]
#[serde(try_from = "String")]
pub(crate) struct Decimal {
    pub near: f64,
    pub wide: DoubleDouble,
}

impl TryFrom<String> for Decimal {
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
    pub t: Decimal,
    #[serde(alias = "theta_dot_before", alias = "phi_dot_before")]
    speed: Decimal,
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
    alpha: Decimal,
    p: Decimal,
    eta: Decimal,
    g: Decimal,
    forcing: ReferenceForcing,
    pub expected: TrajectoryResult,
    /// Errors of a careful double-precision code.
    pub attainable_float64: BTreeMap<String, Value>,
}

/// Motion of the block.
#[derive(Deserialize)]
pub(crate) struct TrajectoryResult {
    pub n_uplifts: f64,
    pub uplifts: Vec<Uplift>,
    pub impacts: Vec<Hit>,
    #[serde(rename = "peak_of_hop_before_impact")]
    pub hops: Vec<HopPeak>,
    /// Numbers of impacts above a speed over p alpha.
    #[serde(rename = "n_impacts_with_speed_over_p_alpha_above")]
    pub faster: BTreeMap<String, f64>,
    t_first_abs_theta_eq_alpha: Option<Decimal>,
    t_abs_theta_eq_pi_over_2: Option<Decimal>,
    peak_abs_theta_over_alpha: String,
    pub t_peak: Option<Decimal>,
    pub rest_times: Vec<Decimal>,
    pub checkpoints: Vec<Checkpoint>,
}

#[derive(Deserialize)]
pub(crate) struct Uplift {
    pub t: Decimal,
    pub side: f64,
}

#[derive(Deserialize)]
pub(crate) struct HopPeak {
    pub t: Decimal,
    pub side: f64,
    pub abs_theta_over_alpha: Decimal,
}

#[derive(Deserialize)]
pub(crate) struct Checkpoint {
    pub t: Decimal,
    pub theta: Decimal,
    pub theta_dot: Decimal,
}

impl TrajectoryResult {
    /// Time of overturning by a criterion.
    pub fn overturned(&self, criterion: Overturning) -> Option<Decimal> {
        let alpha = self.t_first_abs_theta_eq_alpha;
        by_criterion(criterion, alpha, self.t_abs_theta_eq_pi_over_2)
    }

    /// The peak; none if the file says that pi/2 is reached.
    pub fn peak(&self) -> Option<Decimal> {
        self.peak_abs_theta_over_alpha.clone().try_into().ok()
    }

    /// The impacts before overturning, which ends a run.
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
struct ReferenceForcing {
    #[serde(alias = "pulse")]
    kind: String,
    dt: Option<Decimal>,
    acc: Option<SampleSource>,
    record: Option<String>,
    #[serde(flatten)]
    parameters: BTreeMap<String, Value>,
}

/// Samples, or the file that has them.
#[derive(Deserialize)]
#[serde(untagged)]
enum SampleSource {
    Here(Vec<Decimal>),
    Elsewhere(String),
}

impl ReferenceForcing {
    /// The pulse; none if the kind is not a pulse.
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
        let number = |found: &Value| match found {
            Value::String(digits) => {
                Decimal::try_from(digits.clone()).ok().map(|x| x.near)
            }
            found => found.as_f64(),
        };
        let kind = name.kind(|parameter| {
            let keys = match parameter {
                P::Amplitude => ["a_p", "A"],
                P::Omega => ["omega", "Omega"],
                P::Duration => ["t_d", "tau_d"],
                P::Period => ["T_p", "tau_p"],
                P::Cycles => ["n_Tp"; 2],
                P::Velocity => ["A_v"; 2],
                P::Frequency => ["f_p"; 2],
                P::Gamma => ["gamma"; 2],
                P::Phase => ["nu"; 2],
            };
            match keys.iter().find_map(|key| self.parameters.get(*key)) {
                Some(found) => number(found).ok_or_else(|| self.lacks()),
                // A Ricker pulse is 4 periods long by default.
                None if parameter == P::Cycles => Ok(4.0),
                None => Err(self.lacks()),
            }
        });
        kind.map(Some)
    }

    fn forcing(&self) -> Result<Forcing> {
        if let Some(pulse) = self.pulse()? {
            return Ok(Forcing::Pulse(pulse));
        }
        let acceleration_m_s2 = match (&self.acc, &self.record) {
            (Some(SampleSource::Here(acc)), _) => nearest(acc),
            (Some(SampleSource::Elsewhere(place)), Some(name))
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
pub(crate) fn nearest(list: &[Decimal]) -> Vec<f64> {
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
    pub fn scene(&self, criterion: Overturning) -> Result<CaseScene> {
        let block = [self.alpha, self.p, self.g].map(|digits| digits.near);
        let scene =
            CaseScene::new(block, self.eta.near, self.forcing.forcing()?);
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
struct ReferenceRecord {
    dt: Decimal,
    acc: Vec<Decimal>,
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
    ground: ReferenceForcing,
    eta: Decimal,
    pub expected: LinearResult,
}

/// Motion of the block.
#[derive(Deserialize)]
pub(crate) struct LinearResult {
    pub uplift_tau: Decimal,
    pub side: f64,
    pub state_at_pulse_end: Option<LinearEnd>,
    pub impacts: Vec<Hit>,
    #[serde(rename = "peak_of_hop_before_impact")]
    pub hops: Vec<Decimal>,
    pub verdict: Option<String>,
    #[serde(rename = "tau_first_abs_phi_eq_1")]
    pub overturned: Option<Decimal>,
}

#[derive(Deserialize)]
pub(crate) struct LinearEnd {
    #[serde(rename = "E_plus")]
    pub growing: Decimal,
    #[serde(rename = "E_minus")]
    pub decaying: Decimal,
}

impl LinearPulse {
    /// A block (alpha, p, g) under the pulse.
    pub fn scene(
        &self,
        [alpha, p, g]: [f64; 3],
        criterion: Overturning,
    ) -> Result<CaseScene> {
        let pulse = self.ground.pulse()?.ok_or_else(|| self.ground.lacks())?;
        let forcing = Forcing::Pulse(rescaled(pulse, g * alpha, p));
        let scene = CaseScene::new([alpha, p, g], self.eta.near, forcing);
        Ok(scene.in_equation(Model::Linearized).to(criterion))
    }
}

/// A release, and what follows in both equations.
#[derive(Deserialize)]
pub(crate) struct FreeReference {
    pub alpha: Decimal,
    pub p: Decimal,
    pub eta: Decimal,
    pub theta0: Decimal,
    pub nonlinear: FreeResult,
    pub linear: FreeResult,
}

#[derive(Deserialize)]
pub(crate) struct FreeResult {
    pub impacts: Vec<Hit>,
    pub settling_time: Decimal,
}

/// A rectangular pulse in Eq. 1.
#[derive(Deserialize)]
pub(crate) struct RectangularPulse {
    alpha: Decimal,
    pub p: Decimal,
    eta: Decimal,
    a0: Decimal,
    td: Decimal,
    t_theta_eq_alpha: Option<Decimal>,
    t_theta_eq_pi_over_2: Option<Decimal>,
    #[serde(default)]
    pub impacts: Vec<Hit>,
    pub peak_over_alpha: Option<Decimal>,
    pub t_peak: Option<Decimal>,
    pub settling_time: Option<Decimal>,
}

impl RectangularPulse {
    pub fn scene(&self, criterion: Overturning) -> CaseScene {
        let [amplitude, duration_s] = [self.a0.near, self.td.near];
        let pulse = PulseKind::Rectangle { amplitude, duration_s };
        let block = [self.alpha.near, self.p.near, 9.81];
        let forcing = Forcing::Pulse(pulse);
        CaseScene::new(block, self.eta.near, forcing).to(criterion)
    }

    /// Time of overturning by a criterion.
    pub fn overturned(&self, criterion: Overturning) -> Option<Decimal> {
        let alpha = self.t_theta_eq_alpha;
        by_criterion(criterion, alpha, self.t_theta_eq_pi_over_2)
    }
}

/// The edges at one restitution and frequency.
#[derive(Deserialize)]
pub(crate) struct SpectrumRow {
    pub eta: Decimal,
    #[serde(rename = "Omega")]
    pub omega: Decimal,
    pub mode2_lower: Decimal,
    pub mode2_lower_alpha_criterion: Decimal,
    pub mode1_lower: Option<Decimal>,
    pub mode1_upper: Option<Decimal>,
    #[serde(default)]
    pub multi_impact_bands: Vec<ImpactBand>,
}

/// A band of overturning after some impacts.
#[derive(Deserialize)]
pub(crate) struct ImpactBand {
    pub n_impacts: u32,
    pub lower: Decimal,
    pub upper: Decimal,
}
