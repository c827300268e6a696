//! Intensity measures and velocity pulses of listed records.

use std::collections::BTreeMap;

use rayon::prelude::*;
use rocking::intensity::velocity_pulse::{Candidate, candidates, pulse};
use rocking::intensity::{IntensityError, Measures, PairMeasures, Settings};
use serde_json::{Value, json};

use super::{Listed, line};
use crate::cli::{Failure, with_threads};

/// What is asked for beside the list.
#[derive(clap::Args)]
pub(super) struct MeasureArgs {
    /// Intensity measures: PGD, Arias intensity, cumulative absolute
    /// velocity, durations, mean period, response spectrum at 5 % damping;
    /// of pairs also the geometric mean and RotD50.
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
    /// Strong velocity pulses in pairs, by Shahi and Baker (2014). Pairs are
    /// those of a suite, or two files alone.
    #[arg(long)]
    pulses: bool,
}

/// Results, in the order of the records and of the pairs.
pub(super) struct Found {
    settings: Settings,
    /// What was done to the baseline, where drifts were not filtered out.
    baseline: Option<String>,
    singles: Option<Vec<Result<Measures, IntensityError>>>,
    pairs: Vec<FoundPair>,
}

struct FoundPair {
    name: String,
    files: [String; 2],
    measures: Option<Result<PairMeasures, IntensityError>>,
    candidates: Option<Result<Vec<Candidate>, IntensityError>>,
}

impl MeasureArgs {
    /// Measures what is asked for.
    ///
    /// # Errors
    /// [`Failure`] for a period that is none, or pulses without a pair.
    pub(super) fn run(
        &self,
        records: &[Listed],
        gravity_m_s2: f64,
        baseline: Option<String>,
    ) -> Result<Found, Failure> {
        let usual = Settings::default();
        let periods = self.periods.as_deref().unwrap_or(usual.periods_s());
        // Without a record nothing is measured, and what is wrong was said of
        // each file.
        let gravity_m_s2 = if records.is_empty() {
            usual.gravity_m_s2()
        } else {
            gravity_m_s2
        };
        let settings = Settings::try_new(
            gravity_m_s2,
            usual.damping_ratio(),
            periods.to_vec(),
        )
        .map_err(|error| Failure::input(error.to_string()))?;
        if !(self.intensity || self.pulses) {
            let (singles, pairs) = (None, Vec::new());
            return Ok(Found { settings, baseline, singles, pairs });
        }
        with_threads(None, || {
            self.measured(records, settings, gravity_m_s2, baseline)
        })?
    }

    fn measured(
        &self,
        records: &[Listed],
        settings: Settings,
        gravity_m_s2: f64,
        baseline: Option<String>,
    ) -> Result<Found, Failure> {
        let singles = self.intensity.then(|| {
            records
                .par_iter()
                .map(|listed| Measures::of(&listed.motion, &settings))
                .collect()
        });
        let pairs = pairs(records);
        if self.pulses && pairs.is_empty() {
            return Err(Failure::input(
                "--pulses: no two components of one motion among the \
                 records; expected a suite with pairs, or two files alone",
            ));
        }
        let pairs = pairs
            .into_par_iter()
            .map(|(name, [a, b])| {
                let (first, second) = (&records[a], &records[b]);
                let motions = (&first.motion, &second.motion);
                FoundPair {
                    name,
                    files: [first.file.clone(), second.file.clone()],
                    measures: self.intensity.then(|| {
                        PairMeasures::of(motions.0, motions.1, &settings)
                    }),
                    candidates: self.pulses.then(|| {
                        candidates(motions.0, motions.1, gravity_m_s2)
                    }),
                }
            })
            .collect();
        Ok(Found { settings, baseline, singles, pairs })
    }
}

/// Pairs by name, the study's component first; two records alone are one.
fn pairs(records: &[Listed]) -> Vec<(String, [usize; 2])> {
    let mut by_name: BTreeMap<&str, Vec<usize>> = BTreeMap::new();
    let mut names = Vec::new();
    for (i, listed) in records.iter().enumerate() {
        if let Some((Some(pair), study)) = &listed.place {
            let places = by_name.entry(pair).or_insert_with(|| {
                names.push(pair.as_str());
                Vec::new()
            });
            let at = if *study { 0 } else { places.len() };
            places.insert(at, i);
        }
    }
    let suite = records.iter().any(|listed| listed.place.is_some());
    if let ([first, second], false) = (records, suite) {
        let name = format!("{} + {}", first.file, second.file);
        return vec![(name, [0, 1])];
    }
    names
        .into_iter()
        .filter_map(|name| {
            let places = by_name.get(name)?.as_slice();
            let both = <[usize; 2]>::try_from(places).ok()?;
            Some((name.to_owned(), both))
        })
        .collect()
}

impl Found {
    /// Adds the measures to the record's JSON.
    pub(super) fn add_to(&self, position: usize, record: &mut Value) {
        let own = self.singles.as_ref().and_then(|all| all.get(position));
        if let (Some(own), Some(map)) = (own, record.as_object_mut()) {
            if let (Some(message), Some(remarks)) = (
                drift(own, self.baseline.as_deref()),
                map.get_mut("remarks").and_then(Value::as_array_mut),
            ) {
                remarks.push(json!({ "code": DRIFT, "message": message }));
            }
            let settings = &self.settings;
            map.insert(
                "intensity".into(),
                outcome(own, |m| json(m, settings)),
            );
        }
    }

    /// The pairs as JSON; none where nothing of them was asked for.
    pub(super) fn pairs_json(&self) -> Option<Value> {
        let asked = self.singles.is_some() || !self.pairs.is_empty();
        let one = |pair: &FoundPair| {
            let settings = &self.settings;
            let mut value = json!({ "pair": pair.name, "files": pair.files });
            let Some(map) = value.as_object_mut() else { return value };
            if let Some(found) = &pair.measures {
                let both = |m: &PairMeasures| {
                    json!({
                        "geometric_mean": json(&m.geometric_mean, settings),
                        "rotd50": json(&m.rotd50, settings),
                    })
                };
                map.insert("intensity".into(), outcome(found, both));
            }
            if let Some(found) = &pair.candidates {
                let all = |list: &Vec<Candidate>| {
                    json!({
                        "pulse_like": pulse(list).is_some(),
                        "pulse_period_s":
                            pulse(list).map(|c| c.period_s),
                        "candidates":
                            list.iter().map(candidate).collect::<Vec<_>>(),
                    })
                };
                map.insert("velocity_pulse".into(), outcome(found, all));
            }
            value
        };
        asked.then(|| self.pairs.iter().map(one).collect())
    }

    /// The measures as tables.
    pub(super) fn table(&self, records: &[Listed]) -> String {
        let mut text = String::new();
        if let Some(singles) = &self.singles {
            let mut rows: Vec<(String, Result<&Measures, &IntensityError>)> =
                Vec::new();
            for (listed, found) in records.iter().zip(singles) {
                rows.push((listed.file.clone(), found.as_ref()));
            }
            for pair in &self.pairs {
                let Some(found) = &pair.measures else { continue };
                let found = found.as_ref();
                let name = &pair.name;
                let mean = found.map(|m| &m.geometric_mean);
                rows.push((format!("{name}, geometric mean"), mean));
                rows.push((
                    format!("{name}, RotD50"),
                    found.map(|m| &m.rotd50),
                ));
            }
            self.measures_table(&mut text, &rows);
            for (listed, found) in records.iter().zip(singles) {
                let baseline = self.baseline.as_deref();
                if let Some(message) = drift(found, baseline) {
                    let (file, code) = (&listed.file, DRIFT);
                    line(&mut text, format_args!("{file}: {code}: {message}"));
                }
            }
        }
        self.pulse_table(&mut text);
        text
    }

    fn measures_table(
        &self,
        text: &mut String,
        rows: &[(String, Result<&Measures, &IntensityError>)],
    ) {
        let width = rows.iter().map(|(name, _)| name.chars().count());
        let width = width.max().unwrap_or(0).max(4);
        let periods: String = self
            .settings
            .periods_s()
            .iter()
            .map(|t| format!(" {:>9}", format!("SA({t})")))
            .collect();
        line(
            text,
            format_args!(
                "\n{:width$}   PGA (g) PGV (m/s)  PGD (m) Arias(m/s) \
                 CAV (m/s) D5-75 (s) D5-95 (s) T_m (s){periods}",
                "intensity",
            ),
        );
        for (name, found) in rows {
            let m = match found {
                Ok(m) => m,
                Err(error) => {
                    line(text, format_args!("{name:width$}  {error}"));
                    continue;
                }
            };
            let spectrum: String = m
                .spectral_acceleration_g
                .iter()
                .map(|a| format!(" {a:>9.4}"))
                .collect();
            let period = m
                .mean_period_s
                .map_or_else(|| "none".into(), |t| format!("{t:.3}"));
            line(
                text,
                format_args!(
                    "{name:width$}  {:>8.4} {:>9.4} {:>8.4} {:>10.4} {:>9.3} {:>9.3} {:>9.3} {period:>7}{spectrum}",
                    m.pga_g,
                    m.pgv_m_s,
                    m.pgd_m,
                    m.arias_intensity_m_s,
                    m.cav_m_s,
                    m.significant_duration_5_75_s,
                    m.significant_duration_5_95_s,
                ),
            );
        }
    }

    fn pulse_table(&self, text: &mut String) {
        let rows: Vec<_> = self
            .pairs
            .iter()
            .filter_map(|pair| Some((pair, pair.candidates.as_ref()?)))
            .collect();
        if rows.is_empty() {
            return;
        }
        let width = rows.iter().map(|(pair, _)| pair.name.chars().count());
        let width = width.max().unwrap_or(0).max(14);
        line(
            text,
            format_args!(
                "\n{:width$}  pulse period (s)  time (s) PGV (m/s) \
                     indicator  late",
                "velocity pulse",
            ),
        );
        for (pair, found) in rows {
            let name = &pair.name;
            // The pulse, or else the strongest candidate.
            let shown = match found {
                Ok(list) => pulse(list).or(list.first()),
                Err(error) => {
                    line(text, format_args!("{name:width$}  {error}"));
                    continue;
                }
            };
            let Some(c) = shown else { continue };
            let yes = |x: bool| if x { "yes" } else { "no" };
            line(
                text,
                format_args!(
                    "{name:width$}  {:>5} {:>10.3} {:>9.2} {:>9.4} {:>9.3} {:>5}",
                    yes(c.is_pulse()),
                    c.period_s,
                    c.time_s,
                    c.pgv_m_s,
                    c.indicator,
                    yes(c.late),
                ),
            );
        }
    }
}

/// A value, or why there is none.
fn outcome<T>(
    found: &Result<T, IntensityError>,
    show: impl Fn(&T) -> Value,
) -> Value {
    match found {
        Ok(value) => show(value),
        Err(error) => json!({ "refused": error.to_string() }),
    }
}

fn json(m: &Measures, settings: &Settings) -> Value {
    let spectrum: Vec<Value> = settings
        .periods_s()
        .iter()
        .zip(&m.spectral_acceleration_g)
        .map(|(t, a)| {
            json!({
                "period_s": *t,
                "spectral_acceleration_g": *a,
            })
        })
        .collect();
    json!({
        "pga_g": m.pga_g,
        "pgv_m_s": m.pgv_m_s,
        "pgd_m": m.pgd_m,
        "arias_intensity_m_s": m.arias_intensity_m_s,
        "cav_m_s": m.cav_m_s,
        "significant_duration_5_75_s": m.significant_duration_5_75_s,
        "significant_duration_5_95_s": m.significant_duration_5_95_s,
        "mean_period_s": m.mean_period_s,
        "damping_ratio": settings.damping_ratio(),
        "spectrum": spectrum,
    })
}

fn candidate(c: &Candidate) -> Value {
    json!({
        "pulse": c.is_pulse(),
        "period_s": c.period_s,
        "time_s": c.time_s,
        "direction_rad": c.direction_rad,
        "pgv_m_s": c.pgv_m_s,
        "pgv_ratio": c.pgv_ratio,
        "energy_ratio": c.energy_ratio,
        "indicator": c.indicator,
        "late": c.late,
    })
}

/// Code of the remark on displacements that a drifting baseline makes.
const DRIFT: &str = "drift";

/// A peak ground displacement above this, in m, is remarked where nothing
/// filtered slow drifts out: the largest that processed records of
/// earthquakes have are of 4 m or so, permanent offsets aside.
const LARGEST_PGD_M: f64 = 5.0;

/// What makes the displacement implausible, if it is; `baseline` says what
/// was done to the record where slow drifts were not filtered out.
fn drift(
    found: &Result<Measures, IntensityError>,
    baseline: Option<&str>,
) -> Option<String> {
    let (pgd_m, baseline) = (found.as_ref().ok()?.pgd_m, baseline?);
    (!(pgd_m <= LARGEST_PGD_M))
        .then(|| format!("PGD {pgd_m:.1} m: {baseline}; see --high-pass"))
}
