//! One quantity of the embedded and the recorded suite, and its CSV.

use rocking::names::named;
use rocking_common::table::{Table, digits};
use rocking_statistics::{Estimate, Interval, Range};

named! {
    /// Kind of quantity in a row.
    pub(super) enum RowGroup: "group" {
        /// Hash of the recorded suite, as the quantity's name.
        Source = "source",
        /// A measure of the motions.
        Motion = "motion",
        /// Capacities of a block at a demand.
        Capacity = "capacity",
        /// Share of demand levels at which a block's capacities pass as
        /// lognormal: no quantiles, but the share with its null band.
        Accepted = "accepted",
    }
}

/// One side: the 16, 50 and 84 % quantiles; or low end of the null band, share,
/// and high end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Quantiles {
    pub(super) records: usize,
    pub(super) low: f64,
    pub(super) middle: f64,
    pub(super) high: f64,
}

impl Quantiles {
    /// Log-dispersion: half the logarithm of the 84 % over the 16 %
    /// quantile.
    pub(super) fn dispersion(&self) -> f64 {
        0.5 * libm::log(self.high / self.low)
    }
}

/// Agreement of two numbers by the interval of an estimate. The value `equal`
/// means equality; numbers are alike up to a distance `limit` from it.
fn agreement(estimate: &Estimate, equal: f64, limit: f64) -> SuiteAgreement {
    let Some(interval) = estimate.interval() else {
        return SuiteAgreement::Open;
    };
    let (low, high) = (interval.low() - equal, interval.high() - equal);
    if low >= -limit && high <= limit {
        SuiteAgreement::Alike
    } else if low > 0.0 || high < 0.0 {
        SuiteAgreement::Apart
    } else {
        SuiteAgreement::Open
    }
}

/// Agreement of two numbers by an interval. An interval that contains equality
/// shows no agreement: it may be wide.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum SuiteAgreement {
    /// They differ, and perhaps by more than the limit.
    Apart,
    /// They differ by less than the limit.
    Alike,
    /// Neither is shown, or there is no interval.
    Open,
}

/// One quantity on both sides.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct QuantityRow {
    pub(super) suite: String,
    pub(super) group: RowGroup,
    pub(super) quantity: String,
    pub(super) p_rad_s: f64,
    pub(super) alpha_rad: f64,
    pub(super) edp: f64,
    pub(super) embedded: Quantiles,
    pub(super) recorded: Quantiles,
    /// Embedded median over recorded, with its 95 % interval.
    pub(super) ratio: Estimate,
    /// Embedded dispersion minus recorded dispersion.
    pub(super) spread: Estimate,
    /// Distance of the two empirical distributions, and its p-value.
    pub(super) distance: f64,
    pub(super) p_value: f64,
}

impl QuantityRow {
    /// Agreement of the medians; alike means within the share `limit` of the
    /// recorded median.
    pub(super) fn medians(&self, limit: f64) -> SuiteAgreement {
        agreement(&self.ratio, 1.0, limit)
    }

    /// Agreement of the dispersions; alike means within the share `limit` of the
    /// recorded dispersion.
    pub(super) fn dispersions(&self, limit: f64) -> SuiteAgreement {
        agreement(&self.spread, 0.0, limit * self.recorded.dispersion())
    }
}

const HEADER: &str = "suite,group,quantity,p_rad_s,alpha_rad,edp,embedded_records,embedded_low,embedded,embedded_high,recorded_records,recorded_low,recorded,recorded_high,ratio,ratio_low,ratio_high,embedded_dispersion,recorded_dispersion,dispersion_difference,dispersion_difference_low,dispersion_difference_high,ks_distance,ks_p_value";

/// Four digits, more than the records support; an empty text if not finite.
fn short(x: f64) -> String {
    if x.is_finite() { digits(x, 4) } else { String::new() }
}

pub(super) fn to_csv(rows: &[QuantityRow]) -> String {
    let mut table = Table::headed(HEADER);
    for row in rows {
        let dispersions = match row.group {
            RowGroup::Motion | RowGroup::Capacity => {
                [row.embedded, row.recorded].map(|side| side.dispersion())
            }
            RowGroup::Source | RowGroup::Accepted => [f64::NAN; 2],
        };
        let side = |s: &Quantiles| {
            let ends = [s.low, s.middle, s.high].map(short);
            std::iter::once(s.records.to_string()).chain(ends)
        };
        let three = |e: &Estimate| {
            let ends =
                [e.low(), e.high()].map(|x| x.map_or(String::new(), short));
            std::iter::once(short(e.value())).chain(ends)
        };
        let name = row.group.name().to_owned();
        let cells = [row.suite.clone(), name, row.quantity.clone()]
            .into_iter()
            .chain([row.p_rad_s, row.alpha_rad, row.edp].map(short))
            .chain(side(&row.embedded).chain(side(&row.recorded)))
            .chain(three(&row.ratio))
            .chain(dispersions.map(short))
            .chain(three(&row.spread))
            .chain([row.distance, row.p_value].map(short));
        table.row(cells);
    }
    table.finish()
}

/// Rows of a CSV by [`to_csv`]; other lines are left out.
pub(super) fn from_csv(text: &str) -> Vec<QuantityRow> {
    let line = |line: &str| {
        let cells: Vec<&str> = line.split(',').collect();
        let number = |k: usize| -> f64 {
            cells.get(k).and_then(|c| c.parse().ok()).unwrap_or(f64::NAN)
        };
        let side = |k: usize| Quantiles {
            records: number(k) as usize,
            low: number(k + 1),
            middle: number(k + 2),
            high: number(k + 3),
        };
        let estimate = |k: usize| {
            let value = number(k);
            Interval::try_new(number(k + 1), number(k + 2))
                .and_then(|ends| Estimate::try_new(value, ends, Range::Real))
                .unwrap_or(Estimate::exact(value))
        };
        Some(QuantityRow {
            suite: (*cells.first()?).to_owned(),
            group: RowGroup::ALL
                .into_iter()
                .find(|g| Some(&g.name()) == cells.get(1))?,
            quantity: (*cells.get(2)?).to_owned(),
            p_rad_s: number(3),
            alpha_rad: number(4),
            edp: number(5),
            embedded: side(6),
            recorded: side(10),
            ratio: estimate(14),
            spread: estimate(19),
            distance: number(22),
            p_value: number(23),
        })
    };
    text.lines().filter_map(line).collect()
}

/// Measures of motions in words and figures, by their names in the CSV, with
/// the labels of the figure.
pub(super) const MOTIONS: [(&str, &str); 8] = [
    ("pga_g", "PGA"),
    ("pgv_m_s", "PGV"),
    ("pgv_over_pga_s", "PGV/PGA"),
    ("arias_intensity_m_s", "Arias"),
    ("cav_m_s", "CAV"),
    ("significant_duration_5_75_s", "*D*_{5–75}"),
    ("significant_duration_5_95_s", "*D*_{5–95}"),
    ("mean_period_s", "*T*_{m}"),
];

/// The row of a measure of the motions.
pub(super) fn of_motion<'a>(
    rows: &'a [QuantityRow],
    kind: &str,
    quantity: &str,
) -> Option<&'a QuantityRow> {
    of_group(rows, RowGroup::Motion, kind, quantity).first().copied()
}

/// The rows of a group, a suite and a quantity.
pub(super) fn of_group<'a>(
    rows: &'a [QuantityRow],
    group: RowGroup,
    kind: &str,
    quantity: &str,
) -> Vec<&'a QuantityRow> {
    let rows = rows.iter().filter(|r| r.group == group && r.suite == kind);
    rows.filter(|r| r.quantity == quantity).collect()
}
