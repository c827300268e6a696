//! Our settings as a table.

use super::{Timings, digits};
use crate::speed::singles::BASE;
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
}
