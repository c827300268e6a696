//! Speed against error on the page: drawn from the timings kept in
//! `fixtures/speed`, never timed again.

mod tables;

use anyhow::Context as _;

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
    /// Single analyses by each tool and setting: ours as shipped, the peer's,
    /// and all.
    own: Total,
    theirs: Total,
    singles: Vec<Total>,
    /// Many analyses: the paper's in lanes, one by one and by the peer, each
    /// on one thread, and all.
    paper: Throughput,
    one_by_one: Throughput,
    peer: Throughput,
    many: Vec<Throughput>,
    conditions: Vec<(String, String)>,
}

impl Timings {
    /// The timings that come with the program.
    ///
    /// # Errors
    /// Where a table has been damaged.
    pub fn kept() -> anyhow::Result<Self> {
        let singles = totals(&parse(SINGLES)?, BASE);
        let total = |key: [&str; 3]| {
            let found = singles.iter().find(|total| total.key() == key);
            found.cloned().with_context(|| key.join(", "))
        };
        let many = parse(MANY)?;
        let work = |name: &str| {
            let found = on_one_thread(&many, name);
            found.cloned().with_context(|| name.to_owned())
        };
        Ok(Self {
            own: total(BASE)?,
            theirs: total(PEER)?,
            paper: work(PAPER)?,
            one_by_one: work(ONE_BY_ONE)?,
            peer: work(PEER_WORK)?,
            singles,
            many,
            conditions: parse(CONDITIONS)?,
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

    /// Error against time.
    pub fn figure(&self) -> Figure {
        let series = |x: fn(&Total) -> f64, y: fn(&Total) -> f64| {
            let line = |(label, tool, method, without)| {
                let of = self.totals_of(tool, method, without);
                let mark = match INTERPRETED.contains(&tool) {
                    true => Mark::DashedAndPoints,
                    false => Mark::LineAndPoints,
                };
                let (x, y) = of.iter().map(|t| (x(t), y(t))).unzip();
                Series::new(label, mark, x, y)
            };
            LINES.map(line).into_iter().filter(|s| !s.x.is_empty()).collect()
        };
        let own_ms = 1e3 * self.own.cpu_s;
        let time = || {
            let words = "processor time, multiples of ours as shipped";
            let label = format!(
                "processor time (ms), ours in the median {}",
                digits(own_ms)
            );
            logarithmic(words).with_second(own_ms, label)
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
                         processor time. {}",
                        self.measured_on()
                    ),
                )
            },
            panels,
            columns: 3,
        };
        drawing.figure(self.reading())
    }

    /// The error of the peak, in a few words.
    pub fn error(&self) -> String {
        format!(
            "Peak of |theta|/alpha off by {} in the median, by {} at most, in \
             {} analyses",
            digits(self.own.peak_error),
            digits(self.own.peak_error_worst),
            self.own.cases
        )
    }

    /// Correct digits of the peak, in a clause.
    pub fn precision(&self) -> String {
        let digits = |error: f64| libm::floor(-libm::log10(error));
        format!(
            "The peak rotation is right to {} digits in the median of {} \
             analyses and to {} at worst",
            digits(self.own.peak_error),
            self.own.cases,
            digits(self.own.peak_error_worst)
        )
    }

    /// How fast it is beside the compiled peer at its best, in a sentence, and
    /// the rates behind that.
    pub fn speed(&self) -> (String, String) {
        let ratio =
            |ours: &Throughput| ours.rate_per_s() / self.peer.rate_per_s();
        let (lanes, one) = (ratio(&self.paper), ratio(&self.one_by_one));
        let error = match self.no_worse().contains(&BASE[2]) {
            true => "at no larger error",
            false => "at a larger error",
        };
        let answer = format!(
            "Many analyses run {} times as fast as with {PEER_NAME}, {error}, and \
             {} times one at a time.",
            digits(lanes),
            digits(one)
        );
        let equal = self.equal().map_or(String::new(), |(setting, times)| {
            format!("; {} times at {setting}", digits(times))
        });
        let rate = self.paper.rate_per_s();
        let effect =
            format!("{} analyses a second and core{equal}", digits(rate));
        (answer, effect)
    }

    /// The fastest of our settings whose errors are no larger than the peer's,
    /// and how many times as fast it is.
    fn equal(&self) -> Option<(&str, f64)> {
        let (setting, ours) = self.fastest()?;
        Some((setting, ours.rate_per_s() / self.peer.rate_per_s()))
    }

    /// How fast, in a sentence.
    pub fn plain(&self) -> String {
        let rate = self.paper.rate_per_s();
        let equal = self.equal().map_or(String::new(), |(setting, times)| {
            format!(
                " At {setting}, our fastest setting with no larger error, it \
                 is {} times.",
                digits(times)
            )
        });
        format!(
            "A single analysis takes {} ms of one core. The paper's 15 blocks \
             run at {rate:.0} analyses a second and core, {} times as many as \
             {PEER_NAME} at 1e-9.{equal} {}",
            digits(1e3 * self.own.cpu_s),
            digits(rate / self.peer.rate_per_s()),
            self.measured_on()
        )
    }

    /// The paper's work in lanes at one of our settings.
    fn in_lanes(&self, setting: &str) -> Option<&Throughput> {
        match setting == BASE[2] {
            true => Some(&self.paper),
            false => on_one_thread(&self.many, &format!("{PAPER}, {setting}")),
        }
    }

    /// Our settings that are no worse than the peer in any error, the
    /// largest ones too.
    fn no_worse(&self) -> Vec<&str> {
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
        let limits = errors(&self.theirs);
        let [tool, method, _] = BASE;
        self.totals_of(tool, method, &[])
            .into_iter()
            .filter(|t| errors(t).iter().zip(limits).all(|(e, max)| *e <= max))
            .map(|t| t.key()[2])
            .collect()
    }

    /// The fastest of those settings that move no more first overturnings
    /// than the peer, and the same work by it.
    fn fastest(&self) -> Option<(&str, &Throughput)> {
        self.no_worse()
            .into_iter()
            .filter_map(|setting| {
                let work = self.in_lanes(setting)?;
                (work.moved? <= self.peer.moved?).then_some((setting, work))
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
        let own = &self.own;
        let best = self.most_accurate();
        let by = |interpreted: bool| {
            let is =
                |t: &&&Total| INTERPRETED.contains(&t.key()[0]) == interpreted;
            let (fast, slow) = range(best.iter().filter(is).map(|t| t.ratio));
            format!("{} to {} times", digits(fast), digits(slow))
        };
        let (good, bad) = range(best.iter().map(|t| t.peak_error));
        format!(
            "As shipped the median error is {}. The most accurate setting of \
             each compiled tool takes {} as long, of each interpreted one {}. \
             Their errors are {} to {}. A line joins the settings of a tool, dashed where an interpreter \
             evaluates the equation. All ran the same {} cases{} under one \
             rest rule, against double-double.",
            digits(own.peak_error),
            by(false),
            by(true),
            digits(good),
            digits(bad),
            own.cases,
            self.fewer(),
        )
    }

    /// The tools that ran only some of the cases, in brackets.
    fn fewer(&self) -> String {
        let best = self.most_accurate().into_iter();
        let fewer = best.filter(|t| t.cases < self.own.cases);
        let some: Vec<String> = fewer
            .map(|t| format!("{} {} of them", t.key()[0], t.cases))
            .collect();
        match some.as_slice() {
            [] => String::new(),
            some => format!(" ({})", some.join(", ")),
        }
    }
}

/// A piece of work on one thread.
fn on_one_thread<'a>(
    many: &'a [Throughput],
    work: &str,
) -> Option<&'a Throughput> {
    many.iter().find(|t| t.threads == 1 && t.work == work)
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
