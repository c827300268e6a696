//! Intensity measures and velocity pulses of listed records.

use std::collections::BTreeMap;

use rayon::prelude::*;
use rocking::accelerogram::Accelerogram;
use rocking_records::intensity::velocity_pulse::{Candidate, candidates};
use rocking_records::intensity::{
    IntensityError, IntensityMeasure, Measures, PairMeasures, Settings,
};
use serde::Serialize;

use super::{RecordFinding, RecordListing};
use crate::failure::{Failure, bail, ensure};
use rocking_draw::figures::of_result::record_svg;

/// Measures to compute beside the list.
#[derive(clap::Args)]
pub(super) struct MeasureArgs {
    /// Intensity measures: PGD, Arias intensity, cumulative absolute velocity,
    /// durations, mean period, response spectrum at 5 % damping; for pairs
    /// also the geometric mean and RotD.
    #[arg(long)]
    intensity: bool,
    /// Periods of the response spectrum in s.
    #[arg(
        long,
        value_name = "S,..",
        value_delimiter = ',',
        requires = "intensity"
    )]
    periods: Option<Vec<f64>>,
    /// Frequency parameter of a block in rad/s: its periods, 0.15 to 1.0 times
    /// 2 pi/p, and AvgSA over them (avgsa:rocking).
    #[arg(
        long,
        value_name = "P",
        requires = "intensity",
        conflicts_with = "periods"
    )]
    p: Option<f64>,
    /// Percentiles of pairs over all directions: 50 is RotD50, 100 the
    /// largest.
    #[arg(
        long,
        value_name = "P,..",
        value_delimiter = ',',
        default_value = "50",
        requires = "intensity"
    )]
    rotd: Vec<f64>,
    /// Strong velocity pulses in pairs, by Shahi and Baker (2014). Pairs are
    /// those of a suite, or exactly two files.
    #[arg(long)]
    pulses: bool,
}

/// The component that is a record's own.
const OWN: &str = "own";

/// The measures: one row per record, two per pair.
#[derive(Serialize)]
pub(super) struct RecordMeasures {
    /// The measure that is the average over the periods of a block.
    #[serde(skip)]
    average: Option<IntensityMeasure>,
    damping_ratio: f64,
    periods_s: Vec<f64>,
    intensity: Vec<MeasuresOf>,
    velocity_pulses: Vec<PulseOf>,
    not_measured: Vec<MeasureRefusal>,
}

#[derive(Serialize)]
struct MeasuresOf {
    /// File, or name of the pair.
    of: String,
    component: String,
    /// AvgSA over the periods of the block.
    #[serde(skip_serializing_if = "Option::is_none")]
    average_sa_g: Option<f64>,
    #[serde(flatten)]
    measures: Measures,
}

#[derive(Serialize)]
struct PulseOf {
    pair: String,
    /// Whether the candidate is a pulse.
    pulse: bool,
    #[serde(flatten)]
    candidate: Candidate,
}

#[derive(Serialize)]
struct MeasureRefusal {
    of: String,
    reason: String,
}

impl MeasureArgs {
    /// Computes the measures, if any flag requests them.
    ///
    /// # Errors
    /// [`Failure`] for an invalid period, or pulses without a pair.
    pub(super) fn run(
        &self,
        records: &[RecordListing],
        gravity_m_s2: f64,
    ) -> Result<Option<RecordMeasures>, Failure> {
        let usual = Settings::default();
        let average = self.p.map(|p_rad_s| {
            let own = IntensityMeasure::RockingSa(None).of_block(p_rad_s);
            let is_known = !own.periods_s().is_empty();
            is_known.then_some(own).ok_or_else(|| {
                let found = format!("--p {p_rad_s}");
                Failure::input(format!("{found}: expected 0.001 to 1000"))
            })
        });
        let average = average.transpose()?;
        let of_block = average.as_ref().map(IntensityMeasure::periods_s);
        let periods = self.periods.as_deref().or(of_block);
        let periods = periods.unwrap_or(usual.periods_s());
        // Without a record nothing is measured, and what is wrong was said of
        // each file.
        let gravity_m_s2 = if records.is_empty() {
            usual.gravity_m_s2()
        } else {
            gravity_m_s2
        };
        let damping_ratio = usual.damping_ratio();
        let settings =
            Settings::try_new(gravity_m_s2, damping_ratio, periods.to_vec())?;
        ensure!(
            self.rotd.iter().all(|p| (0.0..=100.0).contains(p)),
            "--rotd: expected numbers from 0 to 100"
        );
        if !(self.intensity || self.pulses) {
            return Ok(None);
        }
        let pairs = pairs(records);
        ensure!(
            !(self.pulses && pairs.is_empty()),
            "--pulses: no two components of one motion among the \
             records; expected a suite with pairs, or two files alone"
        );
        let mut found = RecordMeasures {
            average: average.clone(),
            damping_ratio,
            periods_s: settings.periods_s().to_vec(),
            intensity: Vec::new(),
            velocity_pulses: Vec::new(),
            not_measured: Vec::new(),
        };
        if self.intensity {
            let single = |l: &RecordListing| {
                Measures::of(&l.member.accelerogram, &settings)
            };
            let singles: Vec<_> = records.par_iter().map(single).collect();
            for (listed, single) in records.iter().zip(singles) {
                let single = found.take(&listed.member.file, single);
                found.add(&listed.member.file, OWN, single);
            }
            let both = |(_, [a, b]): &NamedPair<'_>| {
                PairMeasures::of(a, b, &settings, &self.rotd)
            };
            let measures: Vec<_> = pairs.par_iter().map(both).collect();
            for ((name, _), both) in pairs.iter().zip(measures) {
                let Some(both) = found.take(name, both) else { continue };
                found.add(name, "geometric mean", Some(both.geometric_mean));
                for (p, measures) in self.rotd.iter().zip(both.rotd) {
                    found.add(name, &format!("RotD{p}"), Some(measures));
                }
            }
        }
        if self.pulses {
            let all =
                |(_, [a, b]): &NamedPair<'_>| candidates(a, b, gravity_m_s2);
            let all: Vec<_> = pairs.par_iter().map(all).collect();
            for ((name, _), all) in pairs.iter().zip(all) {
                for candidate in found.take(name, all).into_iter().flatten() {
                    let pulse = candidate.is_pulse();
                    let pair = name.clone();
                    let row = PulseOf { pair, pulse, candidate };
                    found.velocity_pulses.push(row);
                }
            }
        }
        Ok(Some(found))
    }
}

impl RecordMeasures {
    /// The result; the reason for none goes into the list.
    fn take<T>(
        &mut self,
        of: &str,
        found: Result<T, IntensityError>,
    ) -> Option<T> {
        let refuse = |error: IntensityError| {
            let (of, reason) = (of.to_owned(), error.to_string());
            self.not_measured.push(MeasureRefusal { of, reason });
        };
        found.map_err(refuse).ok()
    }

    fn add(&mut self, of: &str, component: &str, measures: Option<Measures>) {
        let (of, component) = (of.to_owned(), component.to_owned());
        let row = measures.map(|measures| MeasuresOf {
            of,
            component,
            average_sa_g: self
                .average
                .as_ref()
                .and_then(|im| im.value(&measures, &self.periods_s)),
            measures,
        });
        self.intensity.extend(row);
    }

    /// Remarks on displacements that a drifting baseline makes; `baseline`
    /// says what was done to it.
    pub(super) fn drifts(
        &self,
        baseline: &str,
    ) -> impl Iterator<Item = RecordFinding> {
        let own = self.intensity.iter().filter(|row| row.component == OWN);
        own.filter(|row| row.measures.drifts()).map(move |row| RecordFinding {
            file: row.of.clone(),
            code: "drift",
            line: None,
            message: format!(
                "PGD {:.1} m: {baseline}; see --high-pass",
                row.measures.pgd_m
            ),
        })
    }
}

/// The name of a pair, and its components.
type NamedPair<'a> = (String, [&'a Accelerogram; 2]);

/// Pairs by name, the study's component first; exactly two records are one
/// pair.
fn pairs(records: &[RecordListing]) -> Vec<NamedPair<'_>> {
    let mut by_name: BTreeMap<&str, Vec<&Accelerogram>> = BTreeMap::new();
    let mut names = Vec::new();
    for listed in records {
        if let Some(pair) = &listed.member.pair {
            let places = by_name.entry(pair).or_insert_with(|| {
                names.push(pair.as_str());
                Vec::new()
            });
            let is_first = listed.in_suite && listed.member.study_component;
            let at = if is_first { 0 } else { places.len() };
            places.insert(at, &listed.member.accelerogram);
        }
    }
    let suite = records.iter().any(|listed| listed.in_suite);
    if let ([first, second], false) = (records, suite) {
        let (first, second) = (&first.member, &second.member);
        let name = format!("{} + {}", first.file, second.file);
        let motions = [&first.accelerogram, &second.accelerogram];
        return vec![(name, motions)];
    }
    names
        .into_iter()
        .filter_map(|name| {
            let places = by_name.get(name)?.as_slice();
            let both = <[&Accelerogram; 2]>::try_from(places).ok()?;
            Some((name.to_owned(), both))
        })
        .collect()
}

/// Periods of a drawn spectrum: 40 a decade from 0.05 to 10 s.
const DRAWN_PERIODS: i32 = 92;

/// Draws the one record of a list; `done` is what was done to it.
///
/// # Errors
/// [`Failure`] for any other number of records.
pub(super) fn svg(
    records: &[RecordListing],
    done: Option<&str>,
    gravity_m_s2: f64,
) -> Result<String, Failure> {
    let [RecordListing { member, .. }] = records else {
        bail!("--plot: {} records: expected one", records.len());
    };
    let motion = &member.accelerogram;
    let periods_s: Vec<f64> = (0..=DRAWN_PERIODS)
        .map(|k| 0.05 * libm::exp10(f64::from(k) / 40.0))
        .collect();
    let settings = Settings::try_new(gravity_m_s2, 0.05, periods_s.clone())?;
    let found = (&Measures::of(motion, &settings)?, &periods_s[..]);
    Ok(record_svg(motion, found, gravity_m_s2, done))
}
