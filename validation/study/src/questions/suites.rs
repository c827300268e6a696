//! What can the embedded suites show? They are compared with recorded suites:
//! those of this study, or else those of the committed comparison, which a study
//! of recorded suites wrote.

mod compare;
mod drawing;
mod row;

use row::{
    MOTIONS, QuantityRow, RowGroup, SuiteAgreement, of_group, of_motion,
};

use super::answer::{Rows, StudyAnswer, TableCell, count, number, word};
use crate::estimates::median;
use crate::kept::findings_of;
use crate::results::StudyResults;
use crate::words::table_words;
use rocking_common::findings::StudySettings;
use rocking_common::paper::{Intensity, SuiteKind};
use rocking_common::table::PlainTable;
use rocking_common::words::{capital, range};
use rocking_draw::markup;
use rocking_statistics::{Estimate, Interval};

/// The comparison with 86 ordinary and 44 pulse-type recorded motions: only
/// medians, dispersions and intervals.
const COMMITTED: &str = rocking_fixtures::text("comparison/suites.csv");

/// Medians and dispersions are alike within this share of the recorded values:
/// the smallest effect of interest, like that of the claims.
const LIMIT: f64 = 0.1;

pub(super) fn answer(results: &StudyResults) -> anyhow::Result<StudyAnswer> {
    let own = results.embedded();
    let rows = if own {
        kept(&results.plan.settings())?
    } else {
        // Through the file's digits: the same numbers as from the file.
        row::from_csv(&row::to_csv(&compare::comparison_rows(results)?))
    };
    let kinds = SuiteKind::ALL.map(SuiteKind::name);
    let answer = words(&rows, kinds);
    let origin = if own {
        "The recorded suites are not part of this run. Their numbers are kept \
         from a run with the default settings on 86 ordinary and 44 \
         pulse-type recorded motions of PEER's database. Only these medians, \
         dispersions and intervals are kept."
    } else {
        "The recorded suites are those of this run; the embedded ones were \
         run beside them with the same choices."
    };
    let mut tables = vec![motions(&rows, &answer, origin)];
    let mut figures = vec![drawing::motions(&rows, kinds)];
    if has_capacities(&rows) {
        tables.extend([capacities(&rows, kinds), accepted(&rows)]);
        figures.push(drawing::capacities(&rows, kinds));
    }
    let files = vec![("suites.csv".into(), row::to_csv(&rows))];
    let (id, question) = ("suites", &table_words("suites").question);
    Ok(StudyAnswer { id, question, answer, tables, figures, files })
}

/// The committed comparison. For settings other than its own it contains only the
/// motions, which no setting changes.
fn kept(settings: &StudySettings) -> anyhow::Result<Vec<QuantityRow>> {
    let mut rows = row::from_csv(COMMITTED);
    if findings_of(settings)?.is_none() {
        rows.retain(|r| {
            matches!(r.group, RowGroup::Source | RowGroup::Motion)
        });
    }
    Ok(rows)
}

fn has_capacities(rows: &[QuantityRow]) -> bool {
    rows.iter().any(|r| r.group == RowGroup::Capacity)
}

fn words(rows: &[QuantityRow], kinds: [&str; 2]) -> String {
    let mut out = Vec::new();
    for kind in kinds {
        let (mut shown, mut apart) = (Vec::new(), Vec::new());
        for (name, label) in MOTIONS {
            let Some(row) = of_motion(rows, kind, name) else { continue };
            shown.push(row.medians(LIMIT));
            if row.medians(LIMIT) == SuiteAgreement::Apart {
                let (label, ratio) = (markup::plain(label), row.ratio.value());
                apart.push(format!("{label} {ratio:.2}"));
            }
        }
        let apart = match apart.as_slice() {
            [] => String::new(),
            some => format!(" (embedded over recorded {})", some.join(", ")),
        };
        out.push(format!(
            "{} motions, medians of measures: {}{apart}.",
            capital(kind),
            counted(shown.into_iter()),
        ));
        for intensity in [Intensity::Pga, Intensity::Pgv] {
            let own =
                of_group(rows, RowGroup::Capacity, kind, intensity.name());
            if own.is_empty() {
                continue;
            }
            let (low, high) = range(own.iter().map(|r| r.ratio.value()));
            out.push(format!(
                "Capacities in {}: medians {low:.2} to {high:.2} times \
                 recorded, {}; dispersions, {}.",
                intensity.name().to_uppercase(),
                counted(own.iter().map(|r| r.medians(LIMIT))),
                counted(own.iter().map(|r| r.dispersions(LIMIT))),
            ));
        }
    }
    if !has_capacities(rows) {
        out.push(
            "Capacities under recorded motions are left out: the kept ones \
             are of settings other than those of this run."
                .into(),
        );
    }
    out.join(" ")
}

/// Number of comparisons by agreement, without zeros: `all 45 open`, or `of 45 5
/// shown to differ, 40 open`.
fn counted(all: impl Iterator<Item = SuiteAgreement>) -> String {
    let all: Vec<SuiteAgreement> = all.collect();
    let agree = format!("agree within {:.0} %", 100.0 * LIMIT);
    let said = [
        (SuiteAgreement::Apart, "shown to differ"),
        (SuiteAgreement::Alike, agree.as_str()),
        (SuiteAgreement::Open, "open"),
    ];
    let found: Vec<(usize, &str)> = said
        .into_iter()
        .map(|(shown, words)| {
            (all.iter().filter(|s| **s == shown).count(), words)
        })
        .filter(|(count, _)| *count > 0)
        .collect();
    match found.as_slice() {
        [(count, words)] => format!("all {count} {words}"),
        some => {
            let parts = some.iter().map(|(n, words)| format!("{n} {words}"));
            let parts: Vec<String> = parts.collect();
            format!("of {} {}", all.len(), parts.join(", "))
        }
    }
}

/// Medians and dispersions of both suites, with ratio and difference.
fn compared(
    r: &QuantityRow,
    decimals: usize,
) -> Vec<(&'static str, TableCell)> {
    let ends = |e: &Estimate| {
        let (low, high) = e.ends();
        word(format!("{low:.2} to {high:.2}"))
    };
    vec![
        ("embedded median", number(r.embedded.middle, decimals)),
        ("recorded median", number(r.recorded.middle, decimals)),
        ("ratio", number(r.ratio.value(), 2)),
        ("95 %", ends(&r.ratio)),
        ("embedded dispersion", number(r.embedded.dispersion(), 2)),
        ("recorded dispersion", number(r.recorded.dispersion(), 2)),
        ("95 % of the difference", ends(&r.spread)),
    ]
}

fn motions(rows: &[QuantityRow], answer: &str, origin: &str) -> PlainTable {
    let mut table = Rows::default();
    for r in rows.iter().filter(|r| r.group == RowGroup::Motion) {
        let mut cells = vec![
            ("suite", word(&r.suite)),
            ("measure", word(r.quantity.replace('_', " "))),
        ];
        cells.extend(compared(r, 3));
        cells.push(("D", number(r.distance, 2)));
        cells.push(("p-value", number(r.p_value, 3)));
        table.row(cells);
    }
    let mut table = table.table("suites");
    let limit = format!("{:.0}", 100.0 * LIMIT);
    for (name, words) in
        [("{answer}", answer), ("{origin}", origin), ("{limit}", &limit)]
    {
        table.reading = table.reading.replace(name, words);
    }
    table
}

fn capacities(rows: &[QuantityRow], kinds: [&str; 2]) -> PlainTable {
    let mut table = Rows::default();
    for kind in kinds {
        for intensity in [Intensity::Pga, Intensity::Pgv] {
            let name = intensity.name();
            let all = of_group(rows, RowGroup::Capacity, kind, name);
            for r in all.into_iter().filter(|r| r.edp == 1.0) {
                let mut cells = vec![
                    ("suite", word(kind)),
                    ("measure", word(name.to_uppercase())),
                    ("p (rad/s)", number(r.p_rad_s, 0)),
                    ("alpha (rad)", number(r.alpha_rad, 2)),
                ];
                cells.extend(compared(r, 2));
                table.row(cells);
            }
        }
    }
    table.table("suites-capacities")
}

fn accepted(rows: &[QuantityRow]) -> PlainTable {
    let all = rows.iter().filter(|r| r.group == RowGroup::Accepted);
    let all = all.map(|r| (r.suite.as_str(), r.quantity.as_str()));
    let mut names: Vec<(&str, &str)> = all.collect();
    names.dedup();
    let mut table = Rows::default();
    for (kind, quantity) in names {
        let own = of_group(rows, RowGroup::Accepted, kind, quantity);
        let of = |value: fn(&QuantityRow) -> f64| {
            median(&own.iter().map(|r| value(r)).collect::<Vec<f64>>())
        };
        let below = |side: fn(&QuantityRow) -> row::Quantiles| {
            let is = |r: &&&QuantityRow| side(r).middle < side(r).low;
            count(own.iter().filter(is).count())
        };
        let apart = of(|r| r.embedded.middle - r.recorded.middle);
        let ends = apart.interval().map(Interval::ends);
        let ends =
            ends.map_or("–".into(), |(a, b)| format!("{a:.2} to {b:.2}"));
        table.row(vec![
            ("suite", word(kind)),
            ("sample", word(quantity.replace('_', " "))),
            ("blocks", count(own.len())),
            ("embedded", number(of(|r| r.embedded.middle).value(), 2)),
            ("recorded", number(of(|r| r.recorded.middle).value(), 2)),
            ("difference", number(apart.value(), 2)),
            ("95 %", word(ends)),
            ("embedded below its band", below(|r| r.embedded)),
            ("recorded below its band", below(|r| r.recorded)),
        ]);
    }
    table.table("suites-accepted")
}

#[cfg(test)]
mod tests {
    use super::row::Quantiles;
    use super::*;
    use crate::facts::{Facts, facts};
    use rocking_common::suites::StudySuite;
    use rocking_statistics::{ExtendedSample, QuantileType, Range};

    /// A row of capacities with intervals of the ratio of medians and of
    /// the difference of dispersions, about a recorded dispersion of 0.5.
    fn capacity(ratio: (f64, f64), spread: (f64, f64)) -> QuantityRow {
        let estimate = |(low, high): (f64, f64)| {
            let value = 0.5 * (low + high);
            let interval = Interval::try_new(low, high).ok();
            interval.map_or(Estimate::exact(value), |interval| {
                Estimate::try_new(value, interval, Range::Real).unwrap()
            })
        };
        let side = Quantiles {
            records: 86,
            low: libm::exp(-0.5),
            middle: 1.0,
            high: libm::exp(0.5),
        };
        QuantityRow {
            suite: "ordinary".into(),
            group: RowGroup::Capacity,
            quantity: "pga".into(),
            p_rad_s: 1.0,
            alpha_rad: 0.1,
            edp: 1.0,
            embedded: side,
            recorded: side,
            ratio: estimate(ratio),
            spread: estimate(spread),
            distance: f64::NAN,
            p_value: f64::NAN,
        }
    }

    #[test]
    fn an_interval_that_holds_equality_shows_no_agreement() {
        let nan = (f64::NAN, f64::NAN);
        let rows = [
            // Wide about equality: nothing is shown.
            capacity((0.6, 1.6), (-0.4, 0.4)),
            // Away from equality.
            capacity((0.6, 0.95), (0.01, 0.4)),
            // Within 10 %, and of 0.5: with equality, and without.
            capacity((0.95, 1.05), (-0.04, 0.04)),
            capacity((1.01, 1.09), (0.01, 0.04)),
            // Within 0.1, but not within a tenth of 0.5.
            capacity((0.6, 1.6), (-0.09, 0.09)),
            capacity(nan, nan),
        ];
        let said = words(&rows, ["ordinary", "pulse-type"]);
        let medians = "of 6 1 shown to differ, 2 agree within 10 %, 3 open";
        assert!(said.contains(&format!("times recorded, {medians};")));
        assert!(said.contains(&format!("dispersions, {medians}.")), "{said}");
        let motion = QuantityRow {
            group: RowGroup::Motion,
            quantity: "pga_g".into(),
            ..capacity((0.6, 1.6), (-0.4, 0.4))
        };
        let said = words(&[motion], ["ordinary", "pulse-type"]);
        assert!(said.contains("medians of measures: all 1 open."), "{said}");
        assert!(!said.contains("Capacities in"), "{said}");
        assert!(said.contains("left out"), "{said}");
    }

    #[test]
    fn kept_capacities_are_shown_for_their_own_settings_only() {
        let kept_findings = crate::kept::findings().expect("findings");
        let mut settings = kept_findings.settings;
        let all = row::from_csv(COMMITTED).len();
        assert_eq!(kept(&settings).expect("rows").len(), all);
        settings.eta = 0.90;
        let rows = kept(&settings).expect("rows");
        assert!(rows.iter().any(|r| r.group == RowGroup::Motion));
        let of_settings = |r: &&QuantityRow| {
            matches!(r.group, RowGroup::Capacity | RowGroup::Accepted)
        };
        assert_eq!(rows.iter().find(of_settings), None);
    }

    #[test]
    fn the_committed_comparison_is_of_these_embedded_suites() {
        let rows = row::from_csv(COMMITTED);
        assert_eq!(row::to_csv(&rows), COMMITTED);
        assert!(!rows.is_empty());
        for suite in StudySuite::embedded().expect("suites") {
            let all: Vec<_> = suite
                .motions
                .iter()
                .map(|m| facts(m).expect("moves"))
                .collect();
            let of = |value: &dyn Fn(&Facts) -> f64| {
                let values: Vec<f64> = all.iter().map(value).collect();
                let sample = ExtendedSample::try_new(&values).expect("sample");
                QuantileType::default()
                    .extended_quantile(&sample, 0.5)
                    .expect("median")
            };
            for (quantity, own) in [
                ("pga_g", of(&|f| f.pga_g)),
                (
                    "arias_intensity_m_s",
                    of(&|f| f.measures.arias_intensity_m_s),
                ),
                (
                    "mean_period_s",
                    of(&|f| f.measures.mean_period_s.unwrap_or(0.0)),
                ),
            ] {
                let row = of_motion(&rows, suite.kind.name(), quantity);
                let kept = row.expect("a row").embedded.middle;
                assert!(
                    (own - kept).abs() < 6e-4 * own,
                    "{} {quantity}: {own}, kept {kept}; run `rocking study` \
                     with recorded suites and keep its suites.csv",
                    suite.kind
                );
            }
        }
    }
}
