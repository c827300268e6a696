//! The plan of a sweep: blocks, records, settings, tiles.

use std::fs;
use std::path::{Path, PathBuf};

use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Grid, REFINEMENT};
use rocking_exchange::Id;
use rocking_records::{Profile, ReadOptions, Suite, read};
use rocking_statistics::Clusters;
use serde::{Deserialize, Serialize};

use crate::failure::{AtPlace as _, Failure, ensure};
use crate::input;
use rocking_common::files::write_atomically;
use rocking_common::suites::export;
use rocking_common::suites::inputs::{BLOCK_SAMPLES, SuiteInput, sha256_hex};

mod check;

/// Version of the plan's shape.
pub const SCHEMA: u32 = 6;

/// Replicates of the bootstrap of a fragility's parameters.
pub(super) const REPLICATES: usize = 400;

/// Curves of a tile, approximately, if the number of its blocks is not given.
pub const TILE_CURVES: usize = 1000;

/// Name of the suite in the plan's folder.
const SUITE: &str = "suite";

/// Everything that a task must know.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SweepPlan {
    /// Version of its shape.
    pub schema: u32,
    /// Program that made the plan, with its commit; it makes the tiles, too.
    pub software: String,
    /// Levels of a curve.
    pub levels: LevelSteps,
    /// Demands at which capacities are reported.
    pub demands: Vec<f64>,
    /// Whether every level is kept.
    pub rows: bool,
    /// The blocks.
    pub blocks: Vec<SweepBlock>,
    /// Study components: name and SHA-256 of the packed file.
    pub records: Vec<(String, String)>,
    /// Their earthquakes; empty if the suite does not state them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub events: Vec<String>,
    /// Blocks per tile; the last tile may have fewer.
    pub tile_blocks: usize,
}

/// A block of a plan.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SweepBlock {
    /// Its name.
    pub id: Id,
    /// Slenderness angle.
    pub alpha_rad: f64,
    /// Frequency parameter.
    pub p_rad_s: f64,
    /// Coefficient of restitution.
    pub eta: f64,
}

impl SweepBlock {
    /// The parameters as the tables have them.
    pub fn cells(&self) -> [String; 3] {
        [self.alpha_rad, self.p_rad_s, self.eta].map(|x| x.to_string())
    }
}

/// Steps in which the levels of a curve rise.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LevelSteps {
    /// In PGA/(g tan alpha), from 1.
    StepIm(f64),
    /// In PGA, multiples of gravity, from 0.
    StepPgaG(f64),
}

/// A plan with its folder and its hash.
#[derive(Clone, Debug)]
pub struct SweepFolder {
    /// The plan.
    pub plan: SweepPlan,
    /// Its folder.
    pub folder: PathBuf,
    /// SHA-256 of the plan's file.
    pub hash: String,
    /// About how many samples the records of one block have.
    pub block_samples: usize,
}

impl SweepPlan {
    /// Writes a plan without records and packs the suite, whose records are
    /// in `input`, into its folder.
    ///
    /// # Errors
    /// [`Failure`] for a repeated block or demand, if the folder has another
    /// plan already, and if a record cannot be packed or a file cannot be
    /// written.
    pub fn write(
        mut self,
        suite: &Suite<Profile>,
        input: SuiteInput<'_>,
        folder: &Path,
    ) -> Result<SweepFolder, Failure> {
        let members: Vec<_> = suite.study_components().collect();
        let events: Option<Vec<String>> =
            members.iter().map(|member| member.event.clone()).collect();
        self.events = events.unwrap_or_default();
        // Refused before the records are packed.
        self.check_settings()?;
        self.check_blocks()?;
        let path = folder.join("plan.json");
        let there = fs::read_to_string(&path).ok();
        let write = |path: &str, text: &str| match there {
            Some(_) => Ok(()),
            None => write_atomically(&folder.join(path), text),
        };
        for part in [SUITE, "tiles"].into_iter().filter(|_| there.is_none()) {
            let part = folder.join(part);
            let place = format_args!("cannot make {}", part.display());
            fs::create_dir_all(&part).at(place)?;
        }
        let own = members.iter().flat_map(|member| &member.attributes);
        let event = members.iter().any(|member| member.event.is_some());
        let own = own.map(|(name, _)| &**name).chain(event.then_some("event"));
        let mut packing = export::Packing::new(SUITE, own);
        input.each(&members, |motion, member| {
            let row = export::member_of(motion, member);
            let (path, text) = packing.add(&row)?;
            let sum = sha256_hex(text.as_bytes());
            self.records.push((motion.name().to_owned(), sum));
            Ok::<_, Failure>(write(&path, &text)?)
        })?;
        let (index, text) = packing.finish();
        write(&index, &text)?;
        let text = self.text();
        ensure!(
            there.is_none_or(|there| there == text),
            "{}: contains another plan; expected an empty folder, or the \
             same plan",
            folder.display()
        );
        write_atomically(&path, &text)?;
        SweepFolder::read(folder)
    }

    /// The plan of a text, if its parts fit each other and a task can work on
    /// them.
    fn parse(text: &str) -> Result<Self, Failure> {
        let plan: Self = serde_json::from_str(text)?;
        plan.check_settings()?;
        plan.check_blocks()?;
        plan.check_records()?;
        Ok(plan)
    }

    /// The records by earthquake, if the suite states it.
    pub fn clusters(&self) -> Clusters {
        match self.events.as_slice() {
            [] => Clusters::singletons(self.records.len()),
            events => Clusters::from_labels(events),
        }
    }

    pub(super) fn text(&self) -> String {
        // These types print without an error.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Number of tiles.
    pub fn tiles(&self) -> usize {
        self.blocks.len().div_ceil(self.tile_blocks)
    }

    /// The blocks of a tile.
    pub fn blocks_of(&self, tile: usize) -> &[SweepBlock] {
        let mut tiles = self.blocks.chunks(self.tile_blocks);
        tiles.nth(tile).unwrap_or_default()
    }

    /// The analysis of a block.
    ///
    /// # Errors
    /// [`Failure`] for a block out of range.
    pub fn analysis(&self, given: &SweepBlock) -> Result<Analysis, Failure> {
        let block = Block::try_new(given.alpha_rad, given.p_rad_s)?;
        let restitution = Restitution::constant(given.eta)?;
        let grid = match self.levels {
            LevelSteps::StepIm(step) => Grid::Im { step },
            LevelSteps::StepPgaG(step_g) => Grid::Pga { step_g },
        };
        Ok(Analysis {
            grid,
            refine: Some(REFINEMENT),
            ..Analysis::paper(block, restitution)
        })
    }
}

impl SweepFolder {
    /// The files of the folder: plan, suite, and tiles.
    pub fn files(&self) -> Vec<PathBuf> {
        let own = ["plan.json".to_owned(), format!("{SUITE}.csv")];
        let own = own.map(|name| self.folder.join(name));
        let inner = [SUITE, "tiles"].into_iter().flat_map(|part| {
            let listed = fs::read_dir(self.folder.join(part)).into_iter();
            listed.flatten().flatten().map(|entry| entry.path())
        });
        own.into_iter().chain(inner).collect()
    }

    /// Reads the plan of a folder.
    ///
    /// # Errors
    /// [`Failure`] if there is none, and for another form.
    pub fn read(folder: &Path) -> Result<Self, Failure> {
        let path = folder.join("plan.json");
        let text = input::text(&path)?;
        let plan = SweepPlan::parse(&text).map_err(|found| {
            Failure::input(format!(
                "{}: {}; expected a plan of `rocking sweep plan`",
                path.display(),
                found.message
            ))
        })?;
        Ok(Self {
            hash: sha256_hex(text.as_bytes()),
            folder: folder.into(),
            plan,
            block_samples: BLOCK_SAMPLES,
        })
    }

    /// The packed records of the block that begins at a place, each held to
    /// the plan's hash.
    ///
    /// # Errors
    /// [`Failure`] for a record that is another now.
    pub fn records(
        &self,
        from: usize,
    ) -> Result<Vec<NormalisedRecord>, Failure> {
        let (mut records, mut samples) = (Vec::new(), 0);
        for (name, expected) in &self.plan.records[from..] {
            if samples >= self.block_samples {
                break;
            }
            let path = self.folder.join(SUITE).join(format!("{name}.at2"));
            let place = path.display().to_string();
            let bytes =
                fs::read(&path).at(format_args!("cannot read {place}"))?;
            let found = sha256_hex(&bytes);
            ensure!(
                found == *expected,
                "{place}: found hash {found}; expected {expected}, as \
                 planned"
            );
            let record = read(&place, &bytes, &ReadOptions::default())?;
            samples += record.accelerogram.samples_g().len();
            records.push(NormalisedRecord::new(&record.accelerogram));
        }
        Ok(records)
    }

    /// Path of a tile.
    pub fn tile_path(&self, content: super::Content, tile: usize) -> PathBuf {
        let name = format!("{}-{tile:05}.csv", content.name());
        self.folder.join("tiles").join(name)
    }
}
