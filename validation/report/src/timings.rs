//! Speed against error on the page: drawn from the timings kept in
//! `fixtures/speed`, never timed again.

mod tables;

use crate::speed::measured::{Total, totals};
use crate::speed::parse;
use crate::speed::singles::BASE;
use crate::speed::throughput::Throughput;
use rocking_common::words::{range, rounded};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Mark, Place, Series,
};

const SINGLES: &str = rocking_fixtures::text("speed/singles.csv");
const MANY: &str = rocking_fixtures::text("speed/throughput.csv");
const WINDOW_STEP: &str = rocking_fixtures::text("speed/window-step.csv");
const CONDITIONS: &str = rocking_fixtures::text("speed/conditions.csv");

/// The work that the paper's study is made of.
const PAPER: &str = "15 blocks, Eq. 1, in lanes";
const ONE_BY_ONE: &str = "15 blocks, Eq. 1, one by one";

/// The fastest compiled tool that did the same work at the tolerance of 1e-9:
/// tool, method and setting. It stops at every sample, where the record has a
/// kink.
const PEER: [&str; 3] =
    ["Boost.odeint", "dopri5 sample by sample", "rtol 1e-09"];
const PEER_NAME: &str = "Boost.odeint stopped at samples";
const PEER_WORK: &str =
    "15 blocks, Eq. 1, Boost.odeint dopri5 sample by sample, rtol 1e-09";

/// Lines of the figure: legend, tool, method, and settings left out.
const LINES: [(&str, &str, &str, &[&str]); 7] = [
    (
        "this project, compiled: orders 4, 6, 8, as shipped",
        "rocking",
        "Taylor",
        &["order 10"],
    ),
    (
        "heyoka, called from Python once a sample",
        "heyoka",
        "Taylor sample by sample",
        &[],
    ),
    (
        "Boost.odeint, compiled, stopped at samples",
        "Boost.odeint",
        "dopri5 sample by sample",
        &[],
    ),
    ("Boost.odeint, compiled", "Boost.odeint", "dopri5", &[]),
    ("SUNDIALS CVODE, compiled", "SUNDIALS CVODE", "Adams with roots", &[]),
    ("SciPy DOP853, interpreted", "SciPy", "solve_ivp DOP853", &[]),
    ("GNU Octave ode45, interpreted", "GNU Octave", "ode45", &[]),
];

/// Tools whose right-hand side an interpreter evaluates.
const INTERPRETED: [&str; 2] = ["SciPy", "GNU Octave"];

/// The kept timings.
pub struct Timings {
    singles: Vec<Total>,
    many: Vec<Throughput>,
    conditions: Vec<(String, String)>,
    /// Header and rows of a trial.
    window_step: (Vec<String>, Vec<Vec<String>>),
}

impl Timings {
    /// The timings that come with the program.
    ///
    /// # Errors
    /// Where a table has been damaged.
    pub fn kept() -> anyhow::Result<Self> {
        Ok(Self {
            singles: totals(&parse(SINGLES)?, BASE),
            many: parse(MANY)?,
            conditions: parse(CONDITIONS)?,
            window_step: table(WINDOW_STEP)?,
        })
    }

    /// `2026-11-21 on AMD EPYC, AVX-512 ..`.
    fn measured_on(&self) -> String {
        let value = |what: &str| {
            let found = self.conditions.iter().find(|(name, _)| name == what);
            found.map_or("unknown", |(_, value)| value.as_str())
        };
        format!(
            "Measured on {} on one core of {}, {}, {}; rustc {}, g++ {}.",
            value("date"),
            value("processor"),
            value("vectors"),
            value("system"),
            value("rustc"),
            value("g++"),
        )
    }

    fn totals_of(
        &self,
        tool: &str,
        method: &str,
        without: &[&str],
    ) -> Vec<&Total> {
        let own = |t: &&Total| {
            let [name, how, setting] = t.key();
            [name, how] == [tool, method] && !without.contains(&setting)
        };
        self.singles.iter().filter(own).collect()
    }

    /// Error against time and work.
    pub fn figure(&self) -> Figure {
        let series = |x: fn(&Total) -> f64, y: fn(&Total) -> f64| {
            let line = |(label, tool, method, without): &(
                &str,
                &str,
                &str,
                &[&str],
            )| {
                let of = self.totals_of(tool, method, without);
                let mark = if INTERPRETED.contains(tool) {
                    Mark::DashedAndPoints
                } else {
                    Mark::LineAndPoints
                };
                Series::new(
                    *label,
                    mark,
                    of.iter().map(|t| x(t)).collect(),
                    of.iter().map(|t| y(t)).collect(),
                )
            };
            LINES.iter().map(line).filter(|s| !s.x.is_empty()).collect()
        };
        let own_ms = self.own().map_or(f64::NAN, |own| 1e3 * own.cpu_s);
        let time = || {
            let words = "processor time, multiples of ours as shipped";
            let axis = logarithmic(words);
            if own_ms > 0.0 {
                let label = format!(
                    "processor time (ms), ours in the median {}",
                    digits(own_ms)
                );
                axis.with_second(own_ms, label)
            } else {
                axis
            }
        };
        let error = "median error of peak |*θ*|/*α*";
        let share =
            |t: &Total| 100.0 * t.other_impacts as f64 / t.cases as f64;
        let mut panels = vec![
            ChartPanel::new(
                "peak, by time",
                time(),
                logarithmic(error),
                series(|t| t.ratio, |t| t.peak_error),
            ),
            ChartPanel::new(
                "peak, by work",
                logarithmic("Taylor polynomials, or derivatives evaluated"),
                logarithmic(error),
                series(|t| t.work, |t| t.peak_error),
            ),
            ChartPanel::new(
                "first ten impacts, by time",
                time(),
                logarithmic("median error of their times (s)"),
                series(|t| t.ratio, |t| t.impact_error_s),
            ),
            ChartPanel::new(
                "all impacts, by time",
                time(),
                ChartAxis::linear(
                    "cases with another number of them (%)",
                    (-4.0, 104.0),
                ),
                series(|t| t.ratio, share),
            ),
        ];
        panels.iter_mut().for_each(widen);
        let drawing = Chart {
            heading: Heading {
                place: Place::Speed,
                ..Heading::new(
                    "speed-and-error",
                    "Speed and error, this project and other tools",
                    format!(
                        "Error of the peak and of impact times, and share of \
                         analyses with another number of impacts, against \
                         processor time and work. {}",
                        self.measured_on()
                    ),
                )
            },
            panels,
            columns: 2,
        };
        drawing.figure(self.reading())
    }

    /// The total of a tool, a method and a setting.
    fn total(&self, key: [&str; 3]) -> Option<&Total> {
        self.singles.iter().find(|total| total.key() == key)
    }

    /// Our own run as shipped.
    fn own(&self) -> Option<&Total> {
        self.total(BASE)
    }

    /// Errors against double-double, in a sentence.
    pub fn accuracy(&self) -> String {
        let Some(own) = self.own() else { return String::new() };
        format!(
            "Over {} analyses of the timings the peak of |theta|/alpha is \
             off by {} (median), {} (90 % are below) and {} (largest), with \
             {} wrong fates, against double-double.",
            own.cases,
            digits(own.peak_error),
            digits(own.peak_error_90),
            digits(own.peak_error_worst),
            own.wrong_fates
        )
    }

    /// The error of the peak, in a few words.
    pub fn error(&self) -> String {
        self.own().map_or(String::new(), |own| {
            format!(
                "Peak of |theta|/alpha off by {} in the median, by {} at \
                 most, in {} analyses",
                digits(own.peak_error),
                digits(own.peak_error_worst),
                own.cases
            )
        })
    }

    /// Whether it is faster than the compiled peer at its best, at no larger
    /// error, and how fast.
    pub fn speed(&self) -> (String, String) {
        let ratio = |work: &str| {
            let ours = self.throughput_of(work)?.rate_per_s();
            Some(ours / self.throughput_of(PEER_WORK)?.rate_per_s())
        };
        let answer = match (ratio(PAPER), ratio(ONE_BY_ONE)) {
            (Some(lanes), Some(one))
                if lanes > 1.0 && self.no_worse().contains(&BASE[2]) =>
            {
                format!(
                    "Yes: {} times as fast as {}; one by one, {} times.",
                    digits(lanes),
                    PEER_NAME,
                    digits(one)
                )
            }
            (Some(lanes), _) => {
                format!(
                    "No: {} times as fast as {}.",
                    digits(lanes),
                    PEER_NAME
                )
            }
            (None, _) => "Open: no timing compares them.".into(),
        };
        let many = self.throughput_of(PAPER).zip(self.equal());
        let effect =
            many.map_or(String::new(), |(paper, (setting, times))| {
                format!(
                    "{:.0} analyses a second and core as shipped; {} times at \
                 {setting}",
                    paper.rate_per_s(),
                    digits(times)
                )
            });
        (answer, effect)
    }

    /// The fastest of our settings whose errors are no larger than the peer's,
    /// and how many times as fast it is.
    fn equal(&self) -> Option<(&str, f64)> {
        let theirs = self.throughput_of(PEER_WORK)?;
        let (setting, ours) = self.fastest(theirs)?;
        Some((setting, ours.rate_per_s() / theirs.rate_per_s()))
    }

    /// How fast, in a sentence.
    pub fn plain(&self) -> String {
        let peer = || {
            let rate = self.throughput_of(PEER_WORK)?.rate_per_s();
            let ratio = self.throughput_of(PAPER)?.rate_per_s() / rate;
            let (setting, times) = self.equal()?;
            Some(format!(
                ", {} times as many as {} at 1e-9. At {setting}, our fastest \
                 setting with no larger error, it is {} times",
                digits(ratio),
                PEER_NAME,
                digits(times)
            ))
        };
        let peer = peer().unwrap_or_default();
        let many = self.throughput_of(PAPER).map_or(String::new(), |paper| {
            format!(
                " The paper's 15 blocks run at {:.0} analyses a second and \
                 core{peer}.",
                paper.rate_per_s()
            )
        });
        format!(
            "A single analysis takes {} ms of one core.{many} {}",
            self.own().map_or(String::new(), |t| digits(1e3 * t.cpu_s)),
            self.measured_on()
        )
    }

    /// A piece of work on one thread.
    fn throughput_of(&self, work: &str) -> Option<&Throughput> {
        self.many.iter().find(|t| t.threads == 1 && t.work == work)
    }

    /// Our settings that are no worse than the peer in any error, the
    /// largest ones too.
    fn no_worse(&self) -> Vec<&str> {
        let theirs = self.total(PEER);
        let errors = |t: &Total| {
            [
                t.peak_error,
                t.peak_error_90,
                t.peak_error_worst,
                t.impact_error_s,
                t.impact_error_worst_s,
                t.wrong_fates as f64,
                t.other_impacts as f64,
            ]
        };
        let Some(limits) = theirs.map(errors) else { return Vec::new() };
        let [tool, method, _] = BASE;
        self.totals_of(tool, method, &[])
            .into_iter()
            .filter(|t| errors(t).iter().zip(limits).all(|(e, max)| *e <= max))
            .map(|t| t.key()[2])
            .collect()
    }

    /// The fastest of those settings that move no more first overturnings
    /// than the peer, and the same work by it.
    fn fastest(&self, theirs: &Throughput) -> Option<(&str, &Throughput)> {
        self.no_worse()
            .into_iter()
            .filter_map(|setting| {
                let work =
                    self.throughput_of(&format!("{PAPER}, {setting}"))?;
                (work.moved? <= theirs.moved?).then_some((setting, work))
            })
            .max_by(|a, b| a.1.rate_per_s().total_cmp(&b.1.rate_per_s()))
    }

    /// The most accurate setting of every other tool.
    fn most_accurate(&self) -> Vec<&Total> {
        LINES[1..]
            .iter()
            .filter_map(|(_, tool, method, without)| {
                self.totals_of(tool, method, without)
                    .into_iter()
                    .min_by(|a, b| a.peak_error.total_cmp(&b.peak_error))
            })
            .collect()
    }

    fn reading(&self) -> String {
        let own = self.own();
        let best = self.most_accurate();
        let by = |interpreted: bool| {
            let is =
                |t: &&&Total| INTERPRETED.contains(&t.key()[0]) == interpreted;
            let (fast, slow) = range(best.iter().filter(is).map(|t| t.ratio));
            format!("{} to {} times", digits(fast), digits(slow))
        };
        let (good, bad) = range(best.iter().map(|t| t.peak_error));
        format!(
            "As shipped, an analysis takes {} ms at a median error of {}. \
             The most accurate setting of each compiled tool takes {} as \
             long, of each interpreted one {}. Their errors are {} to {}. A \
             line joins the settings of a tool, dashed where an interpreter \
             evaluates the equation. All ran the same {} cases{} under one \
             rest rule, against double-double.",
            own.map_or(String::new(), |t| digits(1e3 * t.cpu_s)),
            own.map_or(String::new(), |t| digits(t.peak_error)),
            by(false),
            by(true),
            digits(good),
            digits(bad),
            own.map_or(0, |t| t.cases),
            self.fewer(),
        )
    }

    /// The tools that ran only some of the cases, in brackets.
    fn fewer(&self) -> String {
        let all = self.own().map_or(0, |t| t.cases);
        let fewer = self.most_accurate().into_iter().filter(|t| t.cases < all);
        let some: Vec<String> = fewer
            .map(|t| format!("{} {} of them", t.key()[0], t.cases))
            .collect();
        match some.as_slice() {
            [] => String::new(),
            some => format!(" ({})", some.join(", ")),
        }
    }
}

/// Header and rows.
fn table(text: &str) -> Result<(Vec<String>, Vec<Vec<String>>), csv::Error> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let header = reader.headers()?.iter().map(str::to_owned).collect();
    let rows = reader.deserialize().collect::<Result<_, _>>()?;
    Ok((header, rows))
}

fn logarithmic(label: &str) -> ChartAxis {
    ChartAxis::logarithmic(label, None::<(f64, f64)>)
}

/// Room for the marks within the axes.
fn widen(panel: &mut ChartPanel) {
    let all = |of: fn(&Series) -> &[f64]| -> Vec<f64> {
        panel.series.iter().flat_map(of).copied().collect()
    };
    let (xs, ys) = (all(|s| &s.x), all(|s| &s.y));
    for (axis, values, by) in
        [(&mut panel.x, xs, 1.6), (&mut panel.y, ys, 8.0)]
    {
        if axis.range.is_none() {
            let (low, high) = range(values.into_iter().filter(|v| *v > 0.0));
            axis.range = Some((low / by, high * by));
        }
    }
}

/// Two significant digits, as people write them.
fn digits(x: f64) -> String {
    if !x.is_finite() {
        return if x.is_nan() { "none".into() } else { "one missing".into() };
    }
    let rounded = rounded(x, if x.abs() >= 100.0 { 3 } else { 2 });
    if rounded == 0.0 || (1e-2..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests;
