//! The timings as tables.

use super::{Timings, digits};
use crate::speed::measured::Total;
use crate::speed::singles::BASE;
use crate::speed::throughput::Throughput;
use rocking_common::table::PlainTable;

/// What our own settings are for.
const USES: [(&str, &str); 6] = [
    ("order 4", "a first look; not for results"),
    ("order 6", "exploring large numbers of analyses"),
    ("order 8", "statistics of many analyses"),
    ("order 10", "one above the default's own order, fixed"),
    ("as shipped", "everything; lengthens its series where a step needs it"),
    ("order 27", "single fates that double precision cannot tell: --certify"),
];

impl Timings {
    /// Tools and settings; many analyses.
    pub fn tables(&self) -> Vec<PlainTable> {
        vec![self.tools(), self.throughput()]
    }

    fn tools(&self) -> PlainTable {
        let sums = |t: &Total| match t.cases == self.own.cases {
            true => t.mean_cpu_s / self.own.mean_cpu_s,
            false => f64::NAN,
        };
        let row = |t: &Total| {
            let [tool, version, method, setting] = &t.label;
            vec![
                format!("{tool} {version}, {method}, {setting}"),
                digits(t.ratio),
                digits(sums(t)),
                digits(1e3 * t.cpu_s),
                digits(t.peak_error),
                digits(t.peak_error_90),
                digits(t.impact_error_s),
                format!("{} of {}", t.wrong_fates, t.cases),
                format!("{} of {}", t.other_impacts, t.cases),
                digits(t.work),
            ]
        };
        let reference = |t: &&Total| t.key()[2] != "order 27";
        PlainTable::new(
            "speed-tools",
            "Speed and error of single analyses",
            format!(
                "Medians over the cases; times are processor time, the ratio \
                 is taken case by case, and that of the sums stands beside \
                 it. heyoka was called from Python, once a sample: its time \
                 is mostly that of the calls. Near overturning the dynamics \
                 amplify any error. {}",
                self.measured_on()
            ),
            &[
                "tool and setting",
                "time / ours as shipped",
                "sum of times / ours",
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

    /// Which of our settings when.
    pub fn settings(&self) -> PlainTable {
        let shipped = self.paper.rate_per_s();
        let moved = |setting| Some(self.in_lanes(setting)?.moved?.to_string());
        let in_lanes = |setting| {
            Some(digits(shipped / self.in_lanes(setting)?.rate_per_s()))
        };
        let rows = self
            .singles
            .iter()
            .filter(|t| t.key()[0] == BASE[0])
            .map(|t| {
                let setting = t.key()[2];
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
                    in_lanes(setting).unwrap_or_default(),
                    unless(t.peak_error),
                    unless(t.peak_error_90),
                    moved(setting).unwrap_or_default(),
                    USES.iter().find(is).map_or("", |(_, u)| u).to_owned(),
                ]
            })
            .collect();
        PlainTable::new(
            "speed-settings",
            "Which of our settings when",
            "Moved: chains of 15 blocks and all embedded records whose first \
             overturning is at another level than as shipped.",
            &[
                "setting",
                "single analyses: time / as shipped",
                "many, in lanes: time / as shipped",
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
        PlainTable::new(
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

    /// The same work in lanes on one thread, as shipped.
    pub(super) fn base(&self, of: &Throughput) -> Option<&Throughput> {
        self.many.iter().find(|t| {
            let prefix = t.work.strip_suffix("in lanes");
            t.threads == 1 && prefix.is_some_and(|p| of.work.starts_with(p))
        })
    }
}
