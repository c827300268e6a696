//! Speed against error on the page, from the timings kept in
//! `fixtures/speed`. The report never measures them again.

use anyhow::Context as _;

use crate::speed::many::{IN_LANES, ONE_BY_ONE, PAPER};
use crate::speed::measured::{Total, totals};
use crate::speed::parse;
use crate::speed::singles::BASE;
use crate::speed::throughput::Throughput;
use rocking_common::table::PlainTable;
use rocking_common::words::{range, rounded};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Mark, Place, Series,
};

const SINGLES: &str = rocking_fixtures::text("speed/singles.csv");
const MANY: &str = rocking_fixtures::text("speed/throughput.csv");
const CONDITIONS: &str = rocking_fixtures::text("speed/conditions.csv");

/// Tool, method and setting of the fastest compiled peer that did the same
/// work at a tolerance of 1e-9. It stops at every sample, because the record
/// has a kink there.
const PEER: [&str; 3] = [BOOST, "dopri5 sample by sample", "rtol 1e-09"];
const PEER_NAME: &str = "Boost.odeint stopped at samples";
const BOOST: &str = "Boost.odeint";
/// Method of heyoka, which also stops at every sample.
const HEYOKA: &str = "Taylor sample by sample";

/// Lines of the figure: legend, tool and method, and whether an interpreter
/// evaluates the equation.
const LINES: [(&str, [&str; 2], bool); 7] = [
    ("this program", [BASE[0], BASE[1]], false),
    ("heyoka, called from Python", ["heyoka", HEYOKA], false),
    ("Boost.odeint, stopped at samples", [PEER[0], PEER[1]], false),
    ("Boost.odeint", [BOOST, "dopri5"], false),
    ("SUNDIALS CVODE", ["SUNDIALS CVODE", "Adams with roots"], false),
    ("SciPy DOP853, interpreted", ["SciPy", "solve_ivp DOP853"], true),
    ("GNU Octave ode45, interpreted", ["GNU Octave", "ode45"], true),
];

/// Our settings, and the use of each.
const USES: [(&str, &str); 6] = [
    ("order 4", "a first look; not for results"),
    ("order 6", "exploring large numbers of analyses"),
    ("order 8", "statistics of many analyses"),
    ("order 10", "a fixed order, one higher than the default's"),
    ("as shipped", "everything; adds terms if a step needs them"),
    (
        "order 27",
        "single outcomes that double precision cannot decide (--certify)",
    ),
];

/// The kept timings.
pub struct Timings {
    /// Single analyses by each tool and setting: ours as shipped, the peer's,
    /// and all.
    own: Total,
    theirs: Total,
    singles: Vec<Total>,
    /// The paper's analyses on one thread: in lanes, one by one, and by the
    /// peer; and all work.
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
    /// If a table has been damaged.
    pub fn kept() -> anyhow::Result<Self> {
        let singles = totals(&parse(SINGLES)?, BASE);
        let total = |key: [&str; 3]| {
            let found = singles.iter().find(|total| total.key() == key);
            found.cloned().with_context(|| key.join(", "))
        };
        let many = parse(MANY)?;
        let work = |name: &[&str]| {
            let found = on_one_thread(&many, name);
            found.cloned().with_context(|| name.join(", "))
        };
        let [tool, method, setting] = PEER;
        Ok(Self {
            own: total(BASE)?,
            theirs: total(PEER)?,
            paper: work(&[PAPER, IN_LANES])?,
            one_by_one: work(&[PAPER, ONE_BY_ONE])?,
            peer: work(&[PAPER, &format!("{tool} {method}"), setting])?,
            singles,
            many,
            conditions: parse(CONDITIONS)?,
        })
    }

    /// `Measured on 2026-11-21 on one core of AMD EPYC, AVX-512 ..`.
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

    /// The settings of a tool and method.
    fn totals_of<'a>(
        &'a self,
        [tool, method]: [&'a str; 2],
    ) -> impl Iterator<Item = &'a Total> {
        let own = move |t: &&Total| t.key()[..2] == [tool, method];
        self.singles.iter().filter(own)
    }

    /// Error against time.
    pub fn figure(&self) -> Figure {
        let own_ms = 1e3 * self.own.cpu_s;
        let panel = |title, y: ChartAxis, of: fn(&Total) -> f64| {
            let line = |(label, key, is_interpreted)| {
                let mark = match is_interpreted {
                    true => Mark::DashedAndPoints,
                    false => Mark::LineAndPoints,
                };
                let totals = self.totals_of(key);
                let (x, y) = totals.map(|t| (t.ratio, of(t))).unzip();
                Series::new(label, mark, x, y)
            };
            let series = LINES.map(line);
            let x = around(series.iter().flat_map(|s| &s.x), 1.6);
            let x = ChartAxis::logarithmic("CPU time / ours as shipped", x);
            let x = x.with_second(own_ms, "CPU time (ms)");
            let ys = around(series.iter().flat_map(|s| &s.y), 8.0);
            ChartPanel::new(title, x, y.or_within(ys), series.into())
        };
        let error = |label| ChartAxis::logarithmic(label, None);
        let share = "analyses with a wrong number of impacts (%)";
        let panels = vec![
            panel("peak", error("median error of peak |*θ*|/*α*"), |t| {
                t.peak_error
            }),
            panel(
                "times of the first ten impacts",
                error("median error of impact times (s)"),
                |t| t.impact_error_s,
            ),
            panel(
                "number of impacts",
                ChartAxis::linear(share, (-4.0, 104.0)),
                |t| 100.0 * t.other_impacts as f64 / t.cases as f64,
            ),
        ];
        let words = format!(
            "Error of the peak and of impact times, and share of analyses \
             with a wrong number of impacts, against CPU time. {}",
            self.measured_on()
        );
        let heading = Heading::new(
            "speed-and-error",
            "Speed and error, this program and other tools",
            words,
        );
        let heading = Heading { place: Place::Speed, ..heading };
        Chart { heading, panels, columns: 3 }.figure(self.reading())
    }

    /// The error of the peak, in a few words.
    pub fn error(&self) -> String {
        format!(
            "peak of |theta|/alpha off by {} in the median, by {} at most, in \
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
            "The peak rotation is correct to {} digits in the median of {} \
             analyses and to {} in the worst case",
            digits(self.own.peak_error),
            self.own.cases,
            digits(self.own.peak_error_worst)
        )
    }

    /// How many times as fast as the peer some work of ours is.
    fn times(&self, ours: &Throughput) -> String {
        digits(ours.rate_per_s() / self.peer.rate_per_s())
    }

    /// How fast it is beside the compiled peer at its best, in a sentence, and
    /// the rates behind that.
    pub fn speed(&self) -> (String, String) {
        let (lanes, one) =
            (self.times(&self.paper), self.times(&self.one_by_one));
        let error = match self.no_worse().contains(&BASE[2]) {
            true => "at no larger error",
            false => "at a larger error",
        };
        let answer = format!(
            "Many analyses run {lanes} times as fast as with {PEER_NAME}, \
             {error}, and {one} times as fast one at a time."
        );
        let equal = self.fastest().map(|(setting, ours)| {
            format!("; {} times as fast at {setting}", self.times(ours))
        });
        let equal = equal.unwrap_or_default();
        let rate = self.paper.rate_per_s();
        let effect =
            format!("{} analyses a second and core{equal}", digits(rate));
        (answer, effect)
    }

    /// How fast, in a sentence.
    pub fn plain(&self) -> String {
        let equal = self.fastest().map(|(setting, ours)| {
            format!(
                " At {setting}, our fastest setting with no larger error, it \
                 is {} times as many.",
                self.times(ours)
            )
        });
        format!(
            "A single analysis takes {} ms of one core. The paper's 15 blocks \
             run at {:.0} analyses a second and core, {} times as many as \
             {PEER_NAME} at 1e-9.{} {}",
            digits(1e3 * self.own.cpu_s),
            self.paper.rate_per_s(),
            self.times(&self.paper),
            equal.unwrap_or_default(),
            self.measured_on()
        )
    }

    /// The paper's work in lanes at one of our settings.
    fn in_lanes(&self, setting: &str) -> Option<&Throughput> {
        match setting == BASE[2] {
            true => Some(&self.paper),
            false => on_one_thread(&self.many, &[PAPER, IN_LANES, setting]),
        }
    }

    /// Our settings of which no error, median or largest, exceeds the peer's.
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
        self.totals_of([BASE[0], BASE[1]])
            .filter(|t| errors(t).iter().zip(limits).all(|(e, max)| *e <= max))
            .map(|t| t.key()[2])
            .collect()
    }

    /// The fastest of those settings that move no more first overturnings
    /// than the peer, and the paper's work at it.
    fn fastest(&self) -> Option<(&str, &Throughput)> {
        self.no_worse()
            .into_iter()
            .filter_map(|setting| {
                let work = self.in_lanes(setting)?;
                (work.moved? <= self.peer.moved?).then_some((setting, work))
            })
            .max_by(|a, b| a.1.rate_per_s().total_cmp(&b.1.rate_per_s()))
    }

    /// The most accurate setting of every other tool, and whether the tool is
    /// interpreted.
    fn most_accurate(&self) -> Vec<(&Total, bool)> {
        let best =
            |(_, key, is_interpreted): &(&str, [&'static str; 2], _)| {
                let own = self.totals_of(*key);
                let best =
                    own.min_by(|a, b| a.peak_error.total_cmp(&b.peak_error));
                Some((best?, *is_interpreted))
            };
        LINES[1..].iter().filter_map(best).collect()
    }

    fn reading(&self) -> String {
        let all = self.most_accurate();
        let by = |interpreted: bool| {
            let own = all.iter().filter(|(_, is)| *is == interpreted);
            let (fast, slow) = range(own.map(|(t, _)| t.ratio));
            format!("{} to {} times", digits(fast), digits(slow))
        };
        let (good, bad) = range(all.iter().map(|(t, _)| t.peak_error));
        let cases = self.own.cases;
        let fewer: Vec<String> = all
            .iter()
            .filter(|(t, _)| t.cases < cases)
            .map(|(t, _)| format!("{} {} of them", t.key()[0], t.cases))
            .collect();
        let fewer = match fewer.is_empty() {
            true => String::new(),
            false => format!(" ({})", fewer.join(", ")),
        };
        format!(
            "As shipped, the median error of the peak is {}. At its most \
             accurate setting a compiled tool takes {} as long, an \
             interpreted one {}; their errors are {} to {}. A line joins the \
             settings of a tool (ours: orders 4 to 10, as shipped); it is \
             dashed if an interpreter evaluates the equation. Each tool ran \
             the same {cases} analyses{fewer} with the same rule for rest. \
             Errors are measured against double-double arithmetic.",
            digits(self.own.peak_error),
            by(false),
            by(true),
            digits(good),
            digits(bad),
        )
    }

    /// Which of our settings to use when.
    pub fn settings(&self) -> PlainTable {
        let shipped = self.paper.rate_per_s();
        let row = |(setting, purpose): &(&str, &str)| {
            let is =
                |t: &&Total| [t.key()[0], t.key()[2]] == [BASE[0], *setting];
            let own = self.singles.iter().find(is)?;
            // The errors of the others are measured against double-double.
            let is_reference = own.key()[1] != BASE[1];
            let error = |x: f64| match is_reference {
                true => "reference".into(),
                false => digits(x),
            };
            let name = if is_reference { "double-double" } else { setting };
            let lanes = self.in_lanes(setting);
            let ratio = lanes.map(|own| digits(shipped / own.rate_per_s()));
            let moved = lanes.and_then(|own| own.moved);
            Some(vec![
                name.into(),
                digits(own.ratio),
                ratio.unwrap_or_default(),
                error(own.peak_error),
                error(own.peak_error_90),
                moved.map(|n| n.to_string()).unwrap_or_default(),
                (*purpose).into(),
            ])
        };
        PlainTable::new(
            "speed-settings",
            "Which of our settings to use",
            "Chains moved: number of IDAs (15 blocks, all embedded records) \
             whose first overturning is at another level than as shipped.",
            &[
                "setting",
                "single analyses: time / as shipped",
                "many, in lanes: time / as shipped",
                "peak error, median",
                "peak error, 90 % quantile",
                "chains moved",
                "use",
            ],
            USES.iter().filter_map(row).collect(),
        )
    }
}

/// The work with these names, on one thread.
fn on_one_thread<'a>(
    many: &'a [Throughput],
    names: &[&str],
) -> Option<&'a Throughput> {
    let work = names.join(", ");
    many.iter().find(|t| t.threads == 1 && t.work == work)
}

/// The ends of a logarithmic axis with room for marks: the positive values,
/// and a factor more either way.
fn around<'a>(values: impl Iterator<Item = &'a f64>, room: f64) -> (f64, f64) {
    let (low, high) = range(values.copied().filter(|x| *x > 0.0));
    (low / room, high * room)
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
