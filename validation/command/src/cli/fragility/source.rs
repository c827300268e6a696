//! Where the fragilities of blocks come from: samples, an IDA, counts, or the
//! law of AvgSA. `fragility export` and `risk` take the same.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use rocking::capacity::InversionRule;
use rocking::integrator::Model;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_exchange::{
    BlockFragility, Id, LimitState, unit_intensity, unstated_origin,
};
use rocking_procedures::fragility::hazard::HazardMeasure;
use rocking_procedures::{
    BootstrapFits, DispersionRule, FitOptions, LawFragility, ModelError,
    Shift, capacities, fit_sample, law_fragility,
};
use rocking_records::intensity::{Intensity, IntensityMeasure};
use rocking_statistics::lognormal::FitMethod;
use rocking_statistics::{CensoredSample, Clusters, Lognormal};

use super::counts::{self, CountTable};
use crate::cli::blocks::{self, BlockRow};
use crate::cli::capacities::{EdpLevels, edp_levels};
use crate::cli::names;
use crate::cli::scene::BlockArgs;
use crate::cli::shared::positive;
use crate::failure::{AtPlace as _, Failure, bail, ensure};
use crate::input;
use rocking_common::paper::RESTITUTION;
use rocking_exchange::sample::SampleSetting;

/// Sources of fragilities, and the blocks they belong to.
#[derive(clap::Args)]
pub struct SourceArgs {
    /// Sample of capacities; one per limit state, by increasing damage.
    #[arg(long, value_name = "FILE")]
    sample: Vec<PathBuf>,
    #[command(flatten)]
    ida: IdaArgs,
    /// Table of counts, intensity,exceeded,n; one per limit state.
    #[arg(
        long,
        value_name = "FILE.csv",
        requires = "im",
        conflicts_with_all = ["sample", "ida"]
    )]
    counts: Vec<PathBuf>,
    /// The law of AvgSA at these EDP levels; inf: overturning.
    #[arg(
        long,
        value_name = "LEVELS",
        value_parser = edp_levels,
        num_args = 0..=1,
        default_missing_value = "inf",
        conflicts_with_all = ["sample", "ida", "counts", "im"]
    )]
    law: Option<EdpLevels>,
    /// Measure of --ida [default: pga], --counts, or a sample without one.
    #[arg(long, value_name = "MEASURE")]
    im: Option<IntensityMeasure>,
    /// Table of blocks: alpha,p or width_m,height_m; also id, eta, sample.
    #[arg(
        long,
        value_name = "BLOCKS.csv",
        conflicts_with_all = ["alpha", "p", "width_m", "height_m", "id"]
    )]
    blocks: Option<PathBuf>,
    #[command(flatten)]
    block: BlockArgs,
    /// Name of the block [default: from alpha and p].
    #[arg(long, value_name = "NAME")]
    id: Option<Id>,
    /// Name of a limit state; may be repeated [default: exceeded, LS1, ..].
    #[arg(long, value_name = "NAME")]
    limit_state: Vec<Id>,
    /// Gravity in m/s2.
    #[arg(
        long,
        value_name = "G",
        value_parser = positive,
        default_value_t = STANDARD_GRAVITY_M_S2
    )]
    gravity: f64,
}

/// Capacities of a table of `rocking ida`.
#[derive(clap::Args)]
pub struct IdaArgs {
    /// Table of `rocking ida`; `-` is standard input.
    #[arg(
        long,
        value_name = "FILE",
        requires = "at",
        conflicts_with = "sample"
    )]
    pub ida: Option<PathBuf>,
    /// EDP levels of --ida, FIRST:LAST:STEP or a list; inf: overturning.
    #[arg(
        long,
        value_name = "LEVELS",
        value_parser = edp_levels,
        requires = "ida",
        allow_hyphen_values = true
    )]
    at: Option<EdpLevels>,
    /// Capacity of a record with several crossings [default: median].
    #[arg(long, value_parser = names::crossing(), requires = "ida")]
    point: Option<InversionRule>,
}

impl IdaArgs {
    /// The EDP levels, and the rule for several crossings.
    pub(super) fn levels(&self) -> (&[f64], InversionRule) {
        let at = self.at.as_deref().unwrap_or_default();
        (at, self.point.unwrap_or(InversionRule::Median))
    }
}

/// Whether the levels of an IDA have one dispersion.
#[derive(clap::Args)]
pub(super) struct DispersionArg {
    /// Dispersion of the fragilities of --ida; with a common one, fitted by
    /// maximum likelihood, their curves do not cross.
    #[arg(
        long,
        value_parser = names::named(
            DispersionRule::ALL,
            DispersionRule::name,
            ["Each its own", "One for all"],
        ),
        default_value = DispersionRule::Own.name(),
        requires = "ida"
    )]
    pub(super) dispersion: DispersionRule,
}

/// The values of a level.
enum LevelValues {
    Sample(CensoredSample, Clusters),
    Counts(CountTable),
    Law { edp: f64 },
}

/// A fragility, and what the draws of its sample make of it.
pub type SampledFragility = (Lognormal, Option<BootstrapFits>);

/// The fragilities of a block, and what draws make of each limit state.
type BlockDraws = (BlockFragility, Vec<Option<BootstrapFits>>);

/// Source of one limit state.
struct FragilityLevel {
    /// The file, or the flag in its place.
    place: String,
    /// The measure, or why there is none.
    im: Result<IntensityMeasure, String>,
    setting: SampleSetting,
    values: LevelValues,
    origin: String,
}

/// The files of [`SourceArgs`], read.
pub struct FragilitySource {
    /// Of the flags.
    levels: Vec<FragilityLevel>,
    /// Of the table of blocks.
    samples: BTreeMap<PathBuf, FragilityLevel>,
    rows: Vec<BlockRow>,
    names: Vec<Id>,
    gravity_m_s2: f64,
}

impl SourceArgs {
    /// The files that flags name.
    pub fn inputs(&self) -> Vec<PathBuf> {
        let many = self.sample.iter().chain(&self.counts);
        many.chain(&self.ida.ida).chain(&self.blocks).cloned().collect()
    }

    /// Reads every file, each once.
    ///
    /// # Errors
    /// [`Failure`] for a file or a block that is refused.
    pub fn open(&self) -> Result<FragilitySource, Failure> {
        let gravity_m_s2 = self.gravity;
        let rows = match &self.blocks {
            Some(path) => blocks::on_ground(path, gravity_m_s2)?,
            None if self.id.is_none() && !self.block.is_given() => Vec::new(),
            None => {
                let block = self.block.block(gravity_m_s2)?;
                let id = self.id.clone().map_or_else(|| Id::of(&block), Ok);
                let id = id.map_err(Failure::input)?;
                vec![BlockRow::of(id, block)]
            }
        };
        let mut samples = BTreeMap::new();
        for path in rows.iter().flat_map(|row| &row.samples) {
            if !samples.contains_key(path) {
                samples.insert(path.clone(), self.sample(path)?);
            }
        }
        let (levels, names) = (self.levels()?, self.limit_state.clone());
        Ok(FragilitySource { levels, samples, rows, names, gravity_m_s2 })
    }

    fn levels(&self) -> Result<Vec<FragilityLevel>, Failure> {
        if let Some(path) = &self.ida.ida {
            return self.ida(path);
        }
        let samples = self.sample.iter().map(|path| self.sample(path));
        let counts = self.counts.iter().map(|path| self.counts(path));
        let edps = self.law.iter().flatten();
        let law = |&edp: &f64| {
            Ok(FragilityLevel {
                place: "--law".to_owned(),
                im: Ok(IntensityMeasure::RockingSa(None)),
                setting: SampleSetting::default(),
                values: LevelValues::Law { edp },
                origin: LawFragility::origin(edp),
            })
        };
        samples.chain(counts).chain(edps.map(law)).collect()
    }

    fn sample(&self, path: &Path) -> Result<FragilityLevel, Failure> {
        let file = input::sample(path)?;
        let place = path.display().to_string();
        let setting = file.setting;
        let n = file.values().len();
        let im = file.im(self.im.as_ref())?.ok_or_else(|| match file.of() {
            Some(of) => format!(
                "{place}: a sample of {of}: expected an intensity measure"
            ),
            None => {
                format!(
                    "{place}: it does not state its measure: expected --im"
                )
            }
        });
        let origin = match (file.of(), &im) {
            (None, Ok(im)) => unstated_origin(n, im),
            (of, _) => format!("{n} capacities, {}", of.unwrap_or_default()),
        } + &setting.to_string();
        let values = LevelValues::Sample(file.censored()?, file.clusters());
        Ok(FragilityLevel { place, im, setting, values, origin })
    }

    fn ida(&self, path: &Path) -> Result<Vec<FragilityLevel>, Failure> {
        let place = path.display().to_string();
        let intensity = in_table(self.im.as_ref())?;
        let im = IntensityMeasure::from(intensity);
        let (table, curves) = input::ida(path, intensity)?;
        let setting = SampleSetting {
            alpha_rad: table.alpha_rad(),
            p_rad_s: Some(table.setting.p_rad_s),
            eta: Some(table.setting.eta),
            model: Some(table.setting.model),
        };
        let clusters = curves.clusters.clone();
        let curves = curves.into_curves();
        let (at, rule) = self.ida.levels();
        let words: Vec<String> = at.iter().map(f64::to_string).collect();
        let origin = format!(
            "{} capacities, {} at EDP {}, {rule} crossing{}",
            curves.len(),
            im.words(),
            words.join(" and "),
            setting,
        );
        let level = |&edp: &f64| {
            let values = capacities::sample(&curves, edp, rule);
            Ok(FragilityLevel {
                values: LevelValues::Sample(
                    values.at(&place)?,
                    clusters.clone(),
                ),
                place: place.clone(),
                im: Ok(im.clone()),
                setting,
                origin: origin.clone(),
            })
        };
        at.iter().map(level).collect()
    }

    fn counts(&self, path: &Path) -> Result<FragilityLevel, Failure> {
        let counted = counts::read(path)?;
        let im = self.im.clone().unwrap_or(IntensityMeasure::PGA);
        let origin = match counted.stripes() {
            None => "outcomes of each record".to_owned(),
            Some(all) => {
                format!("counts of exceedance at {} intensities", all.len())
            }
        };
        Ok(FragilityLevel {
            place: path.display().to_string(),
            im: Ok(im),
            setting: SampleSetting::default(),
            values: LevelValues::Counts(counted),
            origin,
        })
    }
}

/// The measure for a table of `rocking ida`, by default PGA.
///
/// # Errors
/// [`Failure`] for a measure that tables do not have.
pub(super) fn in_table(
    im: Option<&IntensityMeasure>,
) -> Result<Intensity, Failure> {
    let im = im.unwrap_or(&IntensityMeasure::PGA);
    im.dimensionless().ok_or_else(|| {
        Failure::input(format!(
            "--im {im}: a table of `rocking ida` has pga and pgv: expected \
             one of them, or --sample with a file of `rocking capacities \
             --im {im} --suite`"
        ))
    })
}

impl FragilityLevel {
    fn im(&self) -> Result<&IntensityMeasure, Failure> {
        self.im.as_ref().map_err(Failure::input)
    }

    /// The fit in the unit of the values, and what draws make of it.
    fn fit(
        &self,
        options: &FitOptions,
        row: Option<&BlockRow>,
    ) -> Result<SampledFragility, Failure> {
        let place = &self.place;
        let refused = |expected: &str| bail!("{place}: {expected}");
        let once = FitOptions { draws: None, ..options.clone() };
        match (&self.values, options.shift, row) {
            (LevelValues::Sample(sample, clusters), ..) => {
                let fitted = fit_sample(sample, &once).at(place)?.fitted;
                let clusters = Some(clusters.clone());
                let own = FitOptions { clusters, ..options.clone() };
                Ok((fitted, own.sampled(sample).at(place)?))
            }
            (LevelValues::Counts(counted), Shift::Given(shift), _)
                if options.method == FitMethod::MaximumLikelihood =>
            {
                let found = counted.fit(shift, None);
                let drawn = options
                    .draws
                    .and_then(|draws| counted.sampled(shift, draws));
                let drawn = drawn.transpose().at(place)?;
                Ok((found.at(place)?.fitted, drawn))
            }
            (LevelValues::Counts(_), ..) => refused(
                "counts: expected --shift with a number and --method mle",
            ),
            (LevelValues::Law { edp }, _, Some(row))
                if once == FitOptions::default() =>
            {
                let eta = row.cells.eta.unwrap_or(RESTITUTION);
                let none = ModelError::none();
                let found = law_fragility(&row.block, eta, *edp, none);
                Ok((found.at(place)?.fitted, None))
            }
            (LevelValues::Law { .. }, ..) => {
                refused("expected a block and no flag of a fit")
            }
        }
    }

    /// The number of units of the block's own intensity measure in one of
    /// the values'.
    fn unit(&self, row: &BlockRow, gravity_m_s2: f64) -> Result<f64, Failure> {
        let at = |what: String| {
            Failure::input(format!("{}: {}: {what}", row.place, self.place))
        };
        let setting = &self.setting;
        let intensity = self.im()?.dimensionless();
        setting.holds_for(&row.block, intensity).map_err(at)?;
        if let (Some(own), Some(eta)) = (setting.eta, row.cells.eta)
            && own != eta
        {
            return Err(at(format!(
                "capacities at eta {own}, the block has {eta}: expected the \
                 same"
            )));
        }
        let model = setting.model.unwrap_or(Model::Nonlinear);
        Ok(intensity.map_or(1.0, |intensity| {
            unit_intensity(intensity, &row.block, model, gravity_m_s2)
        }))
    }
}

impl FragilitySource {
    /// The files that the table of blocks names.
    pub fn inputs(&self) -> Vec<PathBuf> {
        self.samples.keys().cloned().collect()
    }

    /// The samples of the flags that have one dispersion by the rule.
    pub(super) fn family(&self, rule: DispersionRule) -> Vec<CensoredSample> {
        let samples = self.levels.iter().filter_map(|one| match &one.values {
            LevelValues::Sample(sample, _) => Some(sample.clone()),
            _ => None,
        });
        rule.family(&samples.collect::<Vec<_>>())
    }

    /// The measure of the fragilities of one block.
    ///
    /// # Errors
    /// [`Failure`] for several blocks, or values without a measure.
    pub fn im(&self) -> Result<IntensityMeasure, Failure> {
        let mut own = self.samples.values().chain(&self.levels);
        let im = own.next().map_or(Ok(&IntensityMeasure::PGA), |l| l.im())?;
        match self.rows.as_slice() {
            [] => Ok(im.clone()),
            [one] => Ok(im.of_block(one.block.frequency_rad_s())),
            many => bail!(
                "{} blocks: their periods differ: expected one block with \
                 several --hazard",
                many.len()
            ),
        }
    }

    /// The fragilities in the unit of a hazard curve's measure; if that is
    /// their own measure, in the unit of their values. If there are several,
    /// they have names.
    ///
    /// # Errors
    /// [`Failure`] for values that make no fit, or are of another measure, and
    /// for a block if the unit is the values' own.
    pub fn against(
        &self,
        im: &HazardMeasure,
        options: &FitOptions,
    ) -> Result<Vec<(Option<String>, SampledFragility)>, Failure> {
        if *im == HazardMeasure::Own
            && let Some(row) = self.rows.first()
        {
            bail!(
                "{}: the hazard curve is in the sample's own unit \
                 (`intensity`): expected no block, or pga_g, pgv_m_s or \
                 pgv_cm_s",
                row.place
            );
        }
        let is_own = im.dimensionless().is_none() && self.rows.is_empty();
        let own = self.samples.values().chain(&self.levels);
        let p_rad_s = self.rows.first().map(|r| r.block.frequency_rad_s());
        let of_row = |of: &IntensityMeasure| {
            p_rad_s.map_or_else(|| of.clone(), |p| of.of_block(p))
        };
        for level in own {
            if let Some(im_name) = im.name()
                && !im.is_of(&of_row(level.im()?))
            {
                bail!(
                    "{}: a sample of {}, a hazard curve of {im_name}: \
                     expected the same measure",
                    level.place,
                    level.im()?.words()
                );
            }
        }
        let mut found = Vec::new();
        if is_own {
            let fits = self.levels.iter().map(|one| one.fit(options, None));
            let fits = fits.collect::<Result<Vec<SampledFragility>, _>>()?;
            let laws = fits.iter().map(|(law, _)| *law).collect();
            let states = self.named(laws)?.into_iter();
            found.extend(states.map(|state| state.name.to_string()).zip(fits));
        } else {
            for (one, sampled) in self.all(options)? {
                let states = one.limit_states.iter().zip(sampled);
                found.extend(states.map(|(state, sampled)| {
                    let name = format!("{}, {}", one.id, state.name);
                    (name, (state.fragility, sampled))
                }));
            }
        }
        let several = found.len() > 1;
        let found = found.into_iter();
        Ok(found.map(|(name, own)| (several.then_some(name), own)).collect())
    }

    /// The fragilities of all blocks, each in its own unit, without an error
    /// of the model.
    ///
    /// # Errors
    /// [`Failure`] for values that make no fit, and for a block to which they
    /// do not apply.
    pub(super) fn all(
        &self,
        options: &FitOptions,
    ) -> Result<Vec<BlockDraws>, Failure> {
        ensure!(
            !self.rows.is_empty(),
            "expected --blocks, or --alpha and --p, or --width-m and \
             --height-m"
        );
        self.rows.iter().map(|row| self.of_row(row, options)).collect()
    }

    fn of_row(
        &self,
        row: &BlockRow,
        options: &FitOptions,
    ) -> Result<BlockDraws, Failure> {
        let own = row.samples.iter().filter_map(|path| self.samples.get(path));
        let own: Vec<&FragilityLevel> = match row.samples.is_empty() {
            true => self.levels.iter().collect(),
            false => own.collect(),
        };
        let Some(first) = own.first() else {
            bail!(
                "expected --sample, --ida, --counts or --law, or a column \
                  `sample`"
            );
        };
        let (mut laws, mut draws) = (Vec::new(), Vec::new());
        let mut origins = Vec::new();
        for level in &own {
            let (im, expected) = (level.im()?, first.im()?);
            ensure!(
                im == expected,
                "{}: a sample of {}: expected one of {}, as the first",
                level.place,
                im.words(),
                expected.words()
            );
            let unit = level.unit(row, self.gravity_m_s2)?;
            let (law, sampled) = level.fit(options, Some(row))?;
            laws.push(law.scaled(unit)?);
            draws.push(sampled.map(|all| all.scaled(unit)).transpose()?);
            origins.push(level.origin.as_str());
        }
        origins.dedup();
        let is_law = matches!(first.values, LevelValues::Law { .. });
        let usual = is_law.then_some(RESTITUTION);
        let fragility = BlockFragility {
            id: row.id.clone(),
            block: row.block,
            eta: row.cells.eta.or(first.setting.eta).or(usual),
            im: first.im()?.of_block(row.block.frequency_rad_s()),
            limit_states: self.named(laws)?,
            origin: origins.join("; "),
            model_error: ModelError::none(),
        };
        Ok((fragility, draws))
    }

    /// The limit states of these fragilities.
    fn named(&self, laws: Vec<Lognormal>) -> Result<Vec<LimitState>, Failure> {
        let name = |k: usize| match (self.names.get(k), laws.len()) {
            (Some(name), _) => Ok(name.clone()),
            (None, 1) => "exceeded".parse(),
            (None, _) => format!("LS{}", k + 1).parse(),
        };
        ensure!(
            self.names.is_empty() || self.names.len() == laws.len(),
            "--limit-state: found {}: expected one for each of {} limit \
             states",
            self.names.len(),
            laws.len()
        );
        let states = laws.iter().enumerate().map(|(k, fragility)| {
            Ok(LimitState { name: name(k)?, fragility: *fragility })
        });
        states.collect::<Result<_, String>>().map_err(Failure::input)
    }
}
