//! What a table comes to, in words and in JSON.

use std::fmt::Write as _;

use rocking::ida::{Certification, HIGHEST_IM, IdaCurve};
use serde_json::{Value, json};

use super::Job;
use super::forces::Audit;
use rocking_common::suites::aside;

/// Median first overturning intensity, counting the curves that stand as
/// infinite.
fn median_overturning(table: &[IdaCurve]) -> Option<f64> {
    let mut all: Vec<f64> = table
        .iter()
        .map(|c| c.overturning.map_or(f64::INFINITY, |first| first.im()))
        .collect();
    all.sort_by(f64::total_cmp);
    let n = all.len();
    match n {
        0 => None,
        n if n % 2 == 1 => Some(all[n / 2]),
        _ => Some(0.5 * (all[n / 2 - 1] + all[n / 2])),
    }
}

struct Counts {
    analyses: u64,
    overturned: usize,
    certification: Certification,
    resurrections: usize,
}

fn counts(table: &[IdaCurve]) -> Counts {
    let mut certification = Certification::default();
    for curve in table {
        certification.add(&curve.certification);
    }
    Counts {
        analyses: table.iter().map(|c| c.analyses).sum(),
        overturned: table.iter().filter(|c| c.overturning.is_some()).count(),
        certification,
        resurrections: table.iter().map(IdaCurve::resurrections).sum(),
    }
}

impl Job<'_> {
    pub(super) fn summary_json(&self) -> Value {
        let Job { args, table, suite, .. } = *self;
        let counts = counts(table);
        let told = counts.certification;
        let sought = args.resurrections_to.is_some();
        json!({
            "suite": suite.name(),
            "processing": self.processing,
            "remarks": self.remarks.json(),
            "set_aside": aside::json(suite.set_aside()),
            "highest_im": HIGHEST_IM,
            "records": table.len(),
            "study_components": suite.study_rule().to_string(),
            "order": args.order,
            "analyses": counts.analyses,
            "overturned_curves": counts.overturned,
            "median_overturning_im": median_overturning(table),
            "unresolved": told.unresolved,
            "certified": args.certify.then(|| json!({
                "assessed": told.assessed,
                "by_double": told.double,
                "by_double_double": told.double_double,
                "by_octuple": told.octuple,
                "unresolved": told.unresolved,
                "fates_moved": told.moved,
                "for_these_doubles_only": told.only_these_doubles,
            })),
            "pivot": self.audit.as_ref().map(Audit::json),
            "resurrections": sought.then_some(counts.resurrections),
            "curves": table.iter().map(|c| json!({
                "record": c.record,
                "levels": c.points.len(),
                "overturning_im":
                    c.overturning.map(|first| first.im()),
            })).collect::<Vec<_>>(),
        })
    }

    pub(super) fn summary(&self) -> String {
        let Job { args, table, suite, .. } = *self;
        let counts = counts(table);
        let mut text = String::new();
        let mut row = |name: &str, value: String| {
            let _ = writeln!(text, "{name:<24}{value}");
        };
        row("suite", suite.name().to_owned());
        if let Some(words) = &self.processing {
            row("processing", words.clone());
        }
        row("records", table.len().to_string());
        if let Some(words) = self.remarks.words() {
            row("remarks", words);
        }
        if !suite.set_aside().is_empty() {
            row("set aside", suite.set_aside().to_string());
        }
        row("study components", suite.study_rule().to_string());
        if let Some(order) = args.order {
            row("order", format!("{order}, whatever it leaves"));
        }
        row("analyses", counts.analyses.to_string());
        let overturned = format!("{} of {}", counts.overturned, table.len());
        row(
            "overturned",
            if counts.overturned == table.len() {
                overturned
            } else {
                format!("{overturned}; the others stand up to IM {HIGHEST_IM}")
            },
        );
        if let Some(median) = median_overturning(table) {
            row("median overturning IM", format!("{median:.4}"));
        }
        let told = counts.certification;
        if args.certify {
            row("assessed", format!("{} of {}", told.assessed, told.analyses));
            row("told by double", told.double.to_string());
            row("told by double-double", told.double_double.to_string());
            row("told by octuple", told.octuple.to_string());
            row("fates moved", told.moved.to_string());
            row("for these doubles only", told.only_these_doubles.to_string());
        }
        let unresolved = told.unresolved;
        row("unresolved", format!("{unresolved} of {}", told.analyses));
        if args.resurrections_to.is_some() {
            row("resurrections", counts.resurrections.to_string());
        }
        for (name, value) in self.audit.iter().flat_map(Audit::rows) {
            row(&name, value);
        }
        row("table", args.out.display().to_string());
        text
    }
}
