//! The two suites of a study: embedded, or read from files.

pub mod export;
pub mod inputs;
pub mod remarks;

use crate::findings::RecordName;
use crate::paper::SuiteKind;
use std::fmt;
use std::path::Path;

use rocking::accelerogram::Accelerogram;
use rocking_records::{Processing, ReadOptions, SetAside, SuiteMember};
use rocking_statistics::Clusters;
use rocking_statistics::clusters::SamplingUnit;
use rocking_synthesis::{ORDINARY_SEED, PULSE_SEED, Pair, ordinary, pulse};
use sha2::{Digest as _, Sha256};

use inputs::read_suite;
use remarks::Remarks;

/// Origin of the records of a suite.
#[derive(Clone, Debug, PartialEq)]
pub enum SuiteSource {
    /// The embedded synthetic suite of these streams.
    Embedded {
        /// Seed of the streams.
        streams: &'static str,
    },
    /// The user's files.
    Files {
        /// Name of the folder or index.
        name: String,
        /// Processing of the records.
        processing: Processing,
    },
}

impl SuiteSource {
    /// Whether the suite is an embedded one.
    pub fn is_embedded(&self) -> bool {
        matches!(self, Self::Embedded { .. })
    }
}

impl fmt::Display for SuiteSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Embedded { streams } => {
                write!(f, "embedded synthetic suite, streams {streams}")
            }
            Self::Files { name, processing } if processing.is_none() => {
                write!(f, "suite {name}")
            }
            Self::Files { name, processing } => {
                write!(f, "suite {name} ({processing})")
            }
        }
    }
}

/// The study component and the other component of its pair.
#[derive(Clone, Debug)]
pub struct StudyMotion {
    /// The study component, which acts on the block.
    pub study: Accelerogram,
    /// The other component, if the suite has it.
    pub other: Option<Accelerogram>,
}

/// A suite as the study uses it.
#[derive(Clone, Debug)]
pub struct StudySuite {
    /// `ordinary` or `pulse-type`.
    pub kind: SuiteKind,
    /// Origin of the records.
    pub source: SuiteSource,
    /// Rule by which the study component was chosen, in words.
    pub component_rule: String,
    /// Remarks on suspicious records; empty for an embedded suite.
    pub remarks: Remarks,
    /// Files of the folder or archive that are not records.
    pub set_aside: SetAside,
    /// The motions, in the suite's order.
    pub motions: Vec<StudyMotion>,
    /// The earthquakes of the motions.
    pub clusters: Clusters,
}

impl StudySuite {
    /// The embedded suites, ordinary and pulse-type.
    ///
    /// # Errors
    /// Never in practice: the samples are finite by construction.
    pub fn embedded() -> anyhow::Result<[Self; 2]> {
        let of = |kind, streams, pairs: Vec<Pair>| Self {
            kind,
            source: SuiteSource::Embedded { streams },
            component_rule: "the first component of each pair".into(),
            remarks: Remarks::default(),
            set_aside: SetAside::default(),
            clusters: Clusters::from_labels(
                pairs.iter().map(|pair| pair.scenario.event()),
            ),
            motions: pairs
                .into_iter()
                .map(|Pair { components: [study, other], .. }| StudyMotion {
                    study,
                    other: Some(other),
                })
                .collect(),
        };
        Ok([
            of(SuiteKind::Ordinary, ORDINARY_SEED, ordinary()?),
            of(SuiteKind::PulseType, PULSE_SEED, pulse()?),
        ])
    }

    /// The suite in a folder or an index.
    ///
    /// # Errors
    /// Naming a refused file and the reason.
    pub fn read(
        kind: SuiteKind,
        path: &Path,
        options: ReadOptions,
        processing: &Processing,
    ) -> anyhow::Result<Self> {
        let suite = read_suite(path, options)?;
        let suite = suite.processed(processing)?;
        let remarks = Remarks::on(&suite);
        let motions = suite
            .study_components()
            .map(|study| StudyMotion {
                study: study.accelerogram.clone(),
                other: study.pair.as_ref().and_then(|pair| {
                    suite
                        .other_components()
                        .find(|other| other.pair.as_ref() == Some(pair))
                        .map(|other| other.accelerogram.clone())
                }),
            })
            .collect();
        Ok(Self {
            kind,
            source: SuiteSource::Files {
                name: suite.name().to_owned(),
                processing: *processing,
            },
            component_rule: suite.study_rule().to_string(),
            remarks,
            set_aside: suite.set_aside().clone(),
            clusters: clusters(&suite.study_components().collect::<Vec<_>>()),
            motions,
        })
    }

    /// The study components: names, and SHA-256 over interval and samples.
    pub fn list(&self) -> Vec<RecordName> {
        let one = |StudyMotion { study, .. }: &StudyMotion| RecordName {
            name: study.name().to_owned(),
            sha256: format!("{:x}", hash(study, Sha256::new()).finalize()),
        };
        self.motions.iter().map(one).collect()
    }

    /// SHA-256 over names, sampling intervals and samples of the study
    /// components, so that results can be distinguished by their input.
    pub fn sha256(&self) -> String {
        let mut sum = Sha256::new();
        for StudyMotion { study, .. } in &self.motions {
            sum.update(study.name().as_bytes());
            sum.update([0]);
            sum = hash(study, sum);
        }
        format!("{:x}", sum.finalize())
    }
}

/// Records by earthquake; every record is its own cluster if the index names no
/// earthquakes.
pub fn clusters<M>(members: &[&SuiteMember<M>]) -> Clusters {
    let events = members.iter().map(|member| member.event.as_deref());
    let events: Option<Vec<&str>> = events.collect();
    let records = || Clusters::singletons(members.len());
    events.map_or_else(records, Clusters::from_labels)
}

/// Number of earthquakes, if they are known.
pub fn earthquakes(clusters: &Clusters) -> Option<usize> {
    (clusters.unit() == SamplingUnit::Earthquake).then_some(clusters.count())
}

/// Sampling interval and samples, added to a hash.
fn hash(record: &Accelerogram, mut sum: Sha256) -> Sha256 {
    sum.update(record.dt_s().to_le_bytes());
    for a in record.samples_g() {
        sum.update(a.to_le_bytes());
    }
    sum
}
