//! Speed against error on the page: drawn from the timings kept in
//! `fixtures/speed`, never timed again.

use super::StudyError;
use super::figures::{Figure, range};
use crate::figures::data::{
    Axis, Chart, ChartPanel, Heading, Mark, Scale, Series,
};
use crate::report::PlainTable;
use crate::speed::measured::{self, Total, totals};
use crate::speed::singles::BASE;
use crate::speed::throughput::{self, Throughput};

const SINGLES: &str = include_str!("../../../fixtures/speed/singles.csv");
const MANY: &str = include_str!("../../../fixtures/speed/throughput.csv");
const CONDITIONS: &str =
    include_str!("../../../fixtures/speed/conditions.csv");

/// Lines of the figure: legend, tool, method, and settings left out.
const LINES: [(&str, &str, &str, &[&str]); 7] = [
    (
        "this project: orders 4, 6, 8, as shipped",
        "rocking",
        "Taylor",
        &["order 10"],
    ),
    ("heyoka", "heyoka", "Taylor sample by sample", &[]),
    (
        "Boost.odeint, stopped at samples",
        "Boost.odeint",
        "dopri5 sample by sample",
        &[],
    ),
    ("Boost.odeint", "Boost.odeint", "dopri5", &[]),
    ("SUNDIALS CVODE", "SUNDIALS CVODE", "Adams with roots", &[]),
    ("SciPy DOP853", "SciPy", "solve_ivp DOP853", &[]),
    ("GNU Octave ode45", "GNU Octave", "ode45", &[]),
];

/// What our own settings are for.
const USES: [(&str, &str); 6] = [
    ("order 4", "a first look; not for results"),
    ("order 6", "exploring large numbers of analyses"),
    ("order 8", "statistics of many analyses"),
    ("order 10", "as the default, at a fixed order"),
    ("as shipped", "everything; lengthens its series where a step needs it"),
    ("order 27", "single fates that double precision cannot tell: --certify"),
];

/// The kept timings.
pub struct Timings {
    singles: Vec<Total>,
    many: Vec<Throughput>,
    conditions: Vec<(String, String)>,
}

impl Timings {
    /// The timings that come with the program.
    ///
    /// # Errors
    /// [`StudyError`] where a table has been damaged.
    pub fn kept() -> Result<Self, StudyError> {
        let pairs = csv::Reader::from_reader(CONDITIONS.as_bytes())
            .deserialize()
            .collect::<Result<_, _>>();
        Ok(Self {
            singles: totals(&measured::parse(SINGLES)?, BASE),
            many: throughput::parse(MANY)?,
            conditions: pairs?,
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

    fn of(&self, tool: &str, method: &str, without: &[&str]) -> Vec<&Total> {
        let own = |t: &&Total| {
            let [name, _, how, setting] = &t.label;
            name == tool
                && how == method
                && !without.contains(&setting.as_str())
        };
        self.singles.iter().filter(own).collect()
    }

    /// Error against time and work.
    #[must_use]
    pub fn figure(&self) -> Figure {
        let series = |x: fn(&Total) -> f64, y: fn(&Total) -> f64| {
            let line = |(label, tool, method, without): &(
                &str,
                &str,
                &str,
                &[&str],
            )| {
                let of = self.of(tool, method, without);
                Series {
                    label: (*label).into(),
                    mark: Mark::LineAndPoints,
                    x: of.iter().map(|t| x(t)).collect(),
                    y: of.iter().map(|t| y(t)).collect(),
                    interval: Vec::new(),
                }
            };
            LINES.iter().map(line).filter(|s| !s.x.is_empty()).collect()
        };
        let time = "processor time, multiples of ours as shipped";
        let panel = |title: &str, x: Axis, y: Axis, series| ChartPanel {
            title: title.into(),
            x,
            y,
            series,
        };
        let error = "median error of peak |*θ*|/*α*";
        let share =
            |t: &Total| 100.0 * t.other_impacts as f64 / t.cases as f64;
        let mut panels = vec![
            panel(
                "peak, by time",
                logarithmic(time),
                logarithmic(error),
                series(|t| t.ratio, |t| t.peak_error),
            ),
            panel(
                "peak, by work",
                logarithmic("Taylor polynomials, or derivatives evaluated"),
                logarithmic(error),
                series(|t| t.work, |t| t.peak_error),
            ),
            panel(
                "first ten impacts, by time",
                logarithmic(time),
                logarithmic("median error of their times (s)"),
                series(|t| t.ratio, |t| t.impact_error_s),
            ),
            panel(
                "all impacts, by time",
                logarithmic(time),
                Axis {
                    label: "cases with another number of them (%)".into(),
                    scale: Scale::Linear,
                    range: Some((-4.0, 104.0)),
                    categories: Vec::new(),
                },
                series(|t| t.ratio, share),
            ),
        ];
        panels.iter_mut().for_each(widen);
        let drawing = Chart {
            heading: Heading {
                name: "speed-and-error".into(),
                title: "Speed and error, this project and other tools".into(),
                description: format!(
                    "Error of the peak and of impact times, and share of \
                     analyses with another number of impacts, against \
                     processor time and work. {}",
                    self.measured_on()
                ),
                arm: None,
            },
            panels,
            columns: 2,
        };
        Figure { drawing: Box::new(drawing), reading: self.reading() }
    }

    fn reading(&self) -> String {
        let own = self.singles.iter().find(|t| {
            let [tool, _, method, setting] = &t.label;
            [tool.as_str(), method, setting] == BASE
        });
        let best: Vec<&Total> = LINES[1..]
            .iter()
            .filter_map(|(_, tool, method, without)| {
                self.of(tool, method, without)
                    .into_iter()
                    .min_by(|a, b| a.peak_error.total_cmp(&b.peak_error))
            })
            .collect();
        let (fast, slow) = range(best.iter().map(|t| t.ratio));
        let (good, bad) = range(best.iter().map(|t| t.peak_error));
        format!(
            "{} cases, the same records, blocks and rest rule for all, \
             against double-double. As shipped, an analysis takes {} ms at a \
             median error of {}; the most accurate setting of each other \
             tool takes {} to {} times as long at {} to {}. A line joins the \
             settings of a tool, least accurate first. {}",
            own.map_or(0, |t| t.cases),
            own.map_or(String::new(), |t| digits(1e3 * t.cpu_s)),
            own.map_or(String::new(), |t| digits(t.peak_error)),
            digits(fast),
            digits(slow),
            digits(good),
            digits(bad),
            self.measured_on()
        )
    }

    /// Tools and settings; which of ours when; many analyses.
    #[must_use]
    pub fn tables(&self) -> Vec<PlainTable> {
        vec![self.tools(), self.settings(), self.throughput()]
    }

    fn tools(&self) -> PlainTable {
        let row = |t: &Total| {
            let [tool, version, method, setting] = &t.label;
            vec![
                format!("{tool} {version}, {method}, {setting}"),
                digits(t.ratio),
                digits(1e3 * t.cpu_s),
                digits(t.peak_error),
                digits(t.peak_error_90),
                digits(t.impact_error_s),
                format!("{} of {}", t.wrong_fates, t.cases),
                format!("{} of {}", t.other_impacts, t.cases),
                digits(t.work),
            ]
        };
        let reference = |t: &&Total| t.label[3] != "order 27";
        table(
            "speed-tools",
            "Speed and error of single analyses",
            format!(
                "Medians over the cases; times are processor time, the ratio \
                 is taken case by case. Near overturning the dynamics \
                 amplify any error. {}",
                self.measured_on()
            ),
            &[
                "tool and setting",
                "time / ours as shipped",
                "time (ms)",
                "peak error",
                "90 % below",
                "impact times (s)",
                "wrong fates",
                "other number of impacts",
                "evaluations",
            ],
            self.singles.iter().filter(reference).map(row).collect(),
        )
    }

    fn settings(&self) -> PlainTable {
        let moved = |setting: &str| {
            let name = format!("15 blocks, Eq. 1, one by one, {setting}");
            let row = self.many.iter().find(|t| t.work == name)?;
            Some(row.moved?.to_string())
        };
        let rows = self
            .singles
            .iter()
            .filter(|t| t.label[0] == "rocking")
            .map(|t| {
                let setting = t.label[3].as_str();
                let is = |(name, _): &&(&str, &str)| *name == setting;
                let reference = setting == "order 27";
                let unless = |x: f64| {
                    if reference { "reference".into() } else { digits(x) }
                };
                vec![
                    if reference {
                        "double-double".into()
                    } else {
                        setting.to_owned()
                    },
                    digits(t.ratio),
                    unless(t.peak_error),
                    unless(t.peak_error_90),
                    moved(setting).unwrap_or_default(),
                    USES.iter().find(is).map_or("", |(_, u)| u).to_owned(),
                ]
            })
            .collect();
        table(
            "speed-settings",
            "Which of our settings when",
            "Moved: of the chains of 15 blocks and all embedded records \
             (0.01 g steps), those whose first overturning is at another \
             level than as shipped. Orders are chosen by the library's \
             respond_at_order; commands run as shipped."
                .into(),
            &[
                "setting",
                "time / as shipped",
                "peak error",
                "90 % below",
                "chains moved",
                "for",
            ],
            rows,
        )
    }

    fn throughput(&self) -> PlainTable {
        let row = |t: &Throughput| {
            vec![
                t.work.clone(),
                self.base(t).map_or(String::new(), |base| {
                    digits(base.rate_per_s() / t.rate_per_s())
                }),
                t.threads.to_string(),
                digits(t.cpu_s),
                t.count.to_string(),
                format!("{:.0}", t.rate_per_s()),
                t.sample_ns().map_or(String::new(), digits),
                t.moved.map_or(String::new(), |n| n.to_string()),
            ]
        };
        table(
            "speed-throughput",
            "Many analyses",
            format!(
                "Levels of 0.01 g up to the first overturning, all embedded \
                 records. {}",
                self.measured_on()
            ),
            &[
                "work",
                "time an analysis / in lanes",
                "threads",
                "processor time (s)",
                "analyses",
                "analyses a second",
                "ns a sample",
                "chains moved",
            ],
            self.many.iter().map(row).collect(),
        )
    }

    /// The same work in lanes on one thread.
    fn base(&self, of: &Throughput) -> Option<&Throughput> {
        self.many.iter().find(|t| {
            let prefix = t.work.strip_suffix("in lanes");
            t.threads == 1 && prefix.is_some_and(|p| of.work.starts_with(p))
        })
    }
}

fn table(
    name: &str,
    title: &str,
    reading: String,
    header: &[&str],
    rows: Vec<Vec<String>>,
) -> PlainTable {
    PlainTable {
        name: name.into(),
        title: title.into(),
        reading,
        header: header.iter().map(|cell| (*cell).to_owned()).collect(),
        rows,
    }
}

fn logarithmic(label: &str) -> Axis {
    Axis {
        label: label.into(),
        scale: Scale::Logarithmic,
        range: None,
        categories: Vec::new(),
    }
}

/// Room for the marks within the axes.
fn widen(panel: &mut ChartPanel) {
    for (axis, values, by) in [
        (
            &mut panel.x,
            panel
                .series
                .iter()
                .flat_map(|s| &s.x)
                .copied()
                .collect::<Vec<f64>>(),
            1.6,
        ),
        (
            &mut panel.y,
            panel.series.iter().flat_map(|s| &s.y).copied().collect(),
            8.0,
        ),
    ] {
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
    let rounded = measured::rounded(x, if x.abs() >= 100.0 { 3 } else { 2 });
    if rounded == 0.0 || (1e-2..1e6).contains(&rounded.abs()) {
        format!("{rounded}")
    } else {
        format!("{rounded:e}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_timings_have_every_line_and_a_base_for_ratios() {
        let kept = Timings::kept().expect("tables");
        for (label, tool, method, without) in LINES {
            let of = kept.of(tool, method, without);
            assert!(of.len() > 1, "{label}");
            for total in of {
                assert!(total.ratio > 0.0, "{label}");
            }
        }
        assert!(!kept.measured_on().contains("unknown"));
        let based = kept.many.iter().filter(|t| kept.base(t).is_some());
        assert!(based.count() > 8);
    }

    /// An integrator that shares nothing with ours agrees with the reference
    /// to rounding: what was measured vouches for the reference, too.
    #[test]
    fn heyoka_agreed_with_the_reference() {
        let kept = Timings::kept().expect("tables");
        for total in kept.of("heyoka", "Taylor sample by sample", &[]) {
            assert_eq!((total.wrong_fates, total.other_impacts), (0, 0));
            assert!(total.peak_error < 1e-12 && total.impact_error_s < 1e-11);
        }
    }

    /// Writes the figure where `ROCKING_FIGURES` says, to be looked at.
    #[test]
    fn draws_the_same_bytes_twice() {
        let draw = || {
            let figure = Timings::kept().expect("tables").figure();
            (figure.drawing.svg().expect("drawn"), figure.drawing.csv())
        };
        let (svg, csv) = draw();
        assert_eq!((&svg, &csv), (&draw().0, &draw().1));
        assert!(!svg.contains("no data in this range"));
        if let Ok(folder) = std::env::var("ROCKING_FIGURES") {
            std::fs::write(format!("{folder}/speed.svg"), svg).expect("write");
        }
    }

    #[test]
    fn numbers_are_short() {
        let shown = [0.0, 2.84e-16, 0.0171, 1.0, 9703.4, f64::NAN];
        let words = shown.map(digits);
        assert_eq!(words, ["0", "2.8e-16", "0.017", "1", "9700", "none"]);
    }
}
