//! Flags of the excitation.

use std::iter::repeat;
use std::path::PathBuf;

use rocking::accelerogram::Accelerogram;
use rocking::excitation::{
    Excitation, NormalisedRecord, Pulse, PulseKind, PulseName, PulseParameter,
    ScaledRecord,
};
use rocking_records::{Record, RemarkInput, SetAside, read_file};

use super::names::{self, named};
use super::processing::RecordArgs;
use super::shared::positive;
use crate::failure::{Failure, bail, ensure};
use rocking_common::paper::Intensity;
use rocking_common::suites::remarks::Remarks;
use rocking_common::words::capital;

/// The excitation: a record, a pulse, or none.
#[derive(clap::Args, Clone, Debug)]
#[command(mut_arg("recursive", |arg| arg.hide(true)))]
pub struct ExcitationArgs {
    /// A record file.
    #[arg(
        long,
        value_name = "FILE",
        required_unless_present_any = ["pulse", "free"],
        conflicts_with_all = ["pulse", "free"]
    )]
    record: Option<PathBuf>,
    #[command(flatten)]
    pub input: RecordArgs,
    /// An analytic pulse from t = 0.
    #[arg(
        long,
        value_name = "KIND",
        value_parser = named(PulseName::ALL, PulseName::name, repeat("")),
        conflicts_with = "free"
    )]
    pulse: Option<PulseName>,
    #[command(flatten)]
    parameters: PulseParameters,
    /// No ground motion: the block is released from an initial rotation.
    #[arg(long, requires = "initial_ratio")]
    free: bool,
    /// Initial rotation divided by alpha, in (0, 1).
    #[arg(long, value_name = "X", requires = "free")]
    initial_ratio: Option<f64>,
    /// Factor applied to every acceleration.
    #[arg(long, value_name = "F", conflicts_with_all = ["pga", "im", "free"])]
    scale: Option<f64>,
    /// Scale to this peak ground acceleration in g.
    #[arg(
        long,
        value_name = "G",
        value_parser = positive,
        conflicts_with_all = ["im", "free"]
    )]
    pga: Option<f64>,
    /// Scale to this dimensionless intensity.
    #[arg(
        long,
        value_name = "X",
        value_parser = positive,
        conflicts_with = "free"
    )]
    im: Option<f64>,
    /// Which intensity: PGA/(g tan alpha) or p PGV/(g tan alpha); g alpha
    /// for Eq. 2 [default: pga].
    #[arg(long, value_parser = names::intensity(), requires = "im")]
    im_kind: Option<Intensity>,
}

/// The excitation, owned.
#[derive(Clone, Debug, Default)]
enum MotionSource {
    /// A record as given, and a factor on it.
    Factor(Accelerogram, f64),
    /// A record scaled to a peak (g).
    Peak(NormalisedRecord, f64),
    /// A pulse.
    Pulse(Pulse),
    /// None.
    #[default]
    Free,
}

/// The excitation, and what is known of it.
#[derive(Clone, Debug, Default)]
pub struct GroundMotion {
    motion: MotionSource,
    /// Peak ground acceleration, g.
    pub pga_g: f64,
    /// Sampling interval of a record, s.
    pub dt_s: Option<f64>,
    /// Initial rotation over the slenderness angle.
    pub initial_ratio: f64,
    /// Remarks on the record, if it is one.
    pub remarks: Option<Remarks>,
}

impl ExcitationArgs {
    /// Reads and scales the excitation for a block of uplift threshold
    /// `threshold` (over g) and frequency parameter `p`.
    ///
    /// # Errors
    /// [`Failure`] for a file that is refused, a flag that the chosen
    /// excitation does not use, or a parameter out of range.
    pub fn ground(
        &self,
        gravity_m_s2: f64,
        threshold: f64,
        p: f64,
    ) -> Result<GroundMotion, Failure> {
        self.refuse_unused()?;
        if let Some(scale) = self.scale
            && !scale.is_finite()
        {
            bail!("--scale {scale}: expected a finite number");
        }
        if self.free {
            let ratio = self.initial_ratio.unwrap_or(0.0);
            ensure!(
                ratio > 0.0 && ratio < 1.0,
                "--initial-ratio {ratio}: expected a number in (0, 1)"
            );
            let none = GroundMotion::default();
            return Ok(GroundMotion { initial_ratio: ratio, ..none });
        }
        let kind = self.im_kind.unwrap_or(Intensity::Pga);
        let target_pga_g = |velocity_ratio_s| {
            let by_im = |im| kind.pga_g(im, threshold, p, velocity_ratio_s);
            self.pga.or(self.im.map(by_im))
        };
        if let Some(path) = &self.record {
            ensure!(
                !self.input.reading.recursive,
                "--recursive is not used with one record: expected a suite"
            );
            let options = self.input.reading.options(gravity_m_s2);
            let Record { accelerogram, remarks: read, .. } =
                read_file(path, &options)?;
            let record = self.input.processing()?.apply(&accelerogram)?;
            let remarked = RemarkInput::of(&record, None, &read);
            let remarks = Remarks::of(&[remarked]);
            self.input.reading.judge(&SetAside::default(), &remarks)?;
            let unit = NormalisedRecord::new(&record);
            let target = target_pga_g(unit.velocity_ratio_s());
            let dt_s = Some(record.dt_s());
            let (motion, pga_g) = match target {
                None => {
                    let factor = self.scale.unwrap_or(1.0);
                    let pga_g = record.pga_g() * factor.abs();
                    (MotionSource::Factor(record, factor), pga_g)
                }
                Some(_) if !(unit.pga_g() > 0.0) => bail!(
                    "{}: all samples are zero and cannot be scaled",
                    path.display()
                ),
                Some(pga_g) => (MotionSource::Peak(unit, pga_g), pga_g),
            };
            return Ok(GroundMotion {
                motion,
                pga_g,
                dt_s,
                remarks: Some(remarks),
                ..GroundMotion::default()
            });
        }
        let pulse = Pulse::try_new_si(self.pulse_kind()?, gravity_m_s2)?;
        let ratio_s = pulse.pgv_g_s() / pulse.pga_g();
        let target = target_pga_g(ratio_s);
        let pulse = match (target, self.scale) {
            (Some(pga_g), _) => pulse.with_pga(pga_g)?,
            (None, Some(scale)) => pulse.scaled(scale)?,
            (None, None) => pulse,
        };
        let pga_g = pulse.pga_g();
        let motion = MotionSource::Pulse(pulse);
        Ok(GroundMotion { motion, pga_g, ..GroundMotion::default() })
    }

    /// Refuses a flag that the chosen excitation has no use for.
    fn refuse_unused(&self) -> Result<(), Failure> {
        let chosen = match self.pulse {
            Some(name) => format!("--pulse {name}"),
            None if self.free => "--free".to_owned(),
            None => "--record".to_owned(),
        };
        let unused = |flag: &str| bail!("{flag} is not used with {chosen}");
        let of_record = self.input.given();
        if let Some(flag) = of_record.filter(|_| self.record.is_none()) {
            return unused(flag);
        }
        if self.initial_ratio.is_some() && !self.free {
            return unused("--initial-ratio");
        }
        ensure!(
            self.im_kind.is_none() || self.im.is_some(),
            "--im-kind is not used without --im"
        );
        let used = self.pulse.map_or(&[][..], PulseName::parameters);
        for (parameter, _) in &self.parameters.0 {
            if !used.contains(parameter) {
                return unused(&format!("--{parameter}"));
            }
        }
        Ok(())
    }

    /// The pulse with its amplitude as given, in m/s2 or m/s.
    fn pulse_kind(&self) -> Result<PulseKind, Failure> {
        let Some(name) = self.pulse else {
            bail!("expected --record, --pulse or --free");
        };
        name.kind(|parameter| {
            let mut given = self.parameters.0.iter();
            let own = given.find(|(own, _)| *own == parameter);
            let value = own.map(|(_, value)| *value);
            match value.or(parameter.default_value()) {
                Some(value) => Ok(value),
                None => bail!("--pulse {name} needs --{parameter}"),
            }
        })
    }

    /// The files that are read.
    pub fn inputs(&self) -> Vec<PathBuf> {
        self.record.iter().cloned().collect()
    }

    /// The excitation, in a word.
    pub fn name(&self) -> String {
        let file = self.record.as_deref().and_then(|path| path.file_stem());
        match (file, self.pulse) {
            (Some(stem), _) => stem.to_string_lossy().into_owned(),
            (None, Some(pulse)) => pulse.to_string(),
            (None, None) => "free motion".to_owned(),
        }
    }
}

/// Values of flags of pulses: a flag for each [`PulseParameter`].
#[derive(Clone, Debug)]
struct PulseParameters(Vec<(PulseParameter, f64)>);

/// The help of a parameter: quantity, unit, and the pulses that take it.
fn parameter_help(parameter: PulseParameter) -> String {
    let (takers, others): (Vec<_>, Vec<_>) = PulseName::ALL
        .into_iter()
        .partition(|pulse| pulse.parameters().contains(&parameter));
    let most = takers.len() > others.len();
    let pulses = if most { &others } else { &takers }.iter();
    let pulses: Vec<_> = pulses.map(|pulse| pulse.name()).collect();
    let mut help = capital(parameter.quantity());
    if !parameter.unit().is_empty() {
        help += &format!(" in {}", parameter.unit());
    }
    let but = if most { "all pulses but " } else { "" };
    help += &format!(" ({but}{})", pulses.join(", "));
    if let Some(value) = parameter.default_value() {
        help += &format!(" [default: {value}]");
    }
    help
}

impl clap::Args for PulseParameters {
    fn augment_args(command: clap::Command) -> clap::Command {
        command.args(PulseParameter::ALL.map(|parameter| {
            clap::Arg::new(parameter.name())
                .long(parameter.name())
                .value_name("X")
                .value_parser(clap::value_parser!(f64))
                .help(parameter_help(parameter))
        }))
    }

    fn augment_args_for_update(command: clap::Command) -> clap::Command {
        Self::augment_args(command)
    }
}

impl clap::FromArgMatches for PulseParameters {
    fn from_arg_matches(
        matches: &clap::ArgMatches,
    ) -> Result<Self, clap::Error> {
        let given = PulseParameter::ALL.into_iter().filter_map(|parameter| {
            let value = matches.get_one::<f64>(parameter.name())?;
            Some((parameter, *value))
        });
        Ok(Self(given.collect()))
    }

    fn update_from_arg_matches(
        &mut self,
        matches: &clap::ArgMatches,
    ) -> Result<(), clap::Error> {
        *self = Self::from_arg_matches(matches)?;
        Ok(())
    }
}

impl GroundMotion {
    /// The excitation.
    pub fn excitation(&self) -> Excitation<'_> {
        match &self.motion {
            MotionSource::Factor(record, factor) => {
                Excitation::Record(ScaledRecord::by_factor(record, *factor))
            }
            MotionSource::Peak(unit, pga_g) => {
                Excitation::Record(ScaledRecord::to_pga(unit, *pga_g))
            }
            MotionSource::Pulse(pulse) => Excitation::Pulse(pulse),
            MotionSource::Free => Excitation::Free,
        }
    }
}
