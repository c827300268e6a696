//! The law of average spectral acceleration beside the analyses that are kept.

use std::collections::BTreeMap;

use anyhow::Context as _;
use rocking::block::Block;
use rocking_common::table::PlainTable;
use rocking_common::words::range;
use rocking_draw::colour::{Dash, Ink, Pen};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Look, Mark, Place, Series,
};
use rocking_procedures::law::{
    FREQUENCY_RANGE_RAD_S, RESTITUTION_RANGE, SLENDERNESS_RANGE_RAD,
};
use rocking_procedures::{LawFragility, ModelError, law_fragility};
use rocking_statistics::Lognormal;
use serde::Deserialize;

use crate::speed::parse;
use rocking_common::paper::{
    FREQUENCIES_RAD_S, RESTITUTION, SLENDERNESSES_RAD,
};

const CELLS: &str = rocking_fixtures::text("law/cells.csv");
const PARTS: &str = rocking_fixtures::text("law/parts.csv");
const PULSES: &str = rocking_fixtures::text("law/pulses.csv");
const LAW: &str = rocking_fixtures::text("law/law.json");

/// The suite that the law was fitted to.
const FITTED: &str = "ordinary";

/// Slenderness of the table.
const SHOWN_RAD: f64 = 0.15;

/// Probabilities between which a fragility is drawn, and its steps.
const ENDS: (f64, f64) = (0.02, 0.98);
const STEPS: u32 = 24;

/// A block under a suite; columns that are not shown are not read.
#[derive(Deserialize)]
struct LawCell {
    suite: String,
    records: usize,
    alpha_rad: f64,
    p_rad_s: f64,
    restitution: String,
    model: String,
    overturn: String,
    demand: f64,
    median: f64,
    median_low: f64,
    median_high: f64,
    dispersion: f64,
    judged: String,
    pga_median: Option<f64>,
    pga_dispersion: Option<f64>,
}

impl LawCell {
    /// Whether the block overturns, by the choices of the paper.
    fn is_paper_s(&self) -> bool {
        self.demand.is_infinite()
            && self.restitution == RESTITUTION.to_string()
            && (self.model.as_str(), self.overturn.as_str())
                == ("nonlinear", "alpha")
    }
}

/// Overturning by a pulse.
#[derive(Deserialize)]
struct PulseCell {
    pulse: String,
    omega_over_p: f64,
    avgsa: f64,
}

/// Overturning by a part of the motions of a suite, over the whole.
#[derive(Deserialize)]
struct PartCell {
    suite: String,
    part: String,
    p_rad_s: f64,
    factor_16: f64,
    factor: f64,
    factor_84: f64,
}

/// How cells were judged, and the tests on the shaking table.
#[derive(Deserialize)]
struct LawJudgement {
    ln_median: BTreeMap<String, f64>,
    ln_dispersion: BTreeMap<String, f64>,
    cells: LawCounts,
    rocks: Vec<RockRatio>,
}

#[derive(Deserialize)]
struct LawCounts {
    holds: usize,
    open: usize,
    fails: usize,
}

#[derive(Deserialize)]
struct RockRatio {
    measured_over_law: f64,
}

/// The kept analyses.
pub struct LawCells {
    cells: Vec<LawCell>,
    parts: Vec<PartCell>,
    pulses: Vec<PulseCell>,
    judged: LawJudgement,
}

/// Overturning of a block of the table by the law.
fn law(p_rad_s: f64) -> anyhow::Result<LawFragility> {
    let block = Block::try_new(SHOWN_RAD, p_rad_s)?;
    let none = ModelError::none();
    Ok(law_fragility(&block, RESTITUTION, f64::INFINITY, none)?)
}

/// A lognormal between two probabilities.
fn curve(
    label: &str,
    pen: Pen,
    median: f64,
    dispersion: f64,
) -> Option<Series> {
    let law = Lognormal::try_new(0.0, libm::log(median), dispersion).ok()?;
    let (low, high) = ENDS;
    let step = (high - low) / f64::from(STEPS);
    let y: Vec<f64> = (0..=STEPS).map(|k| low + step * f64::from(k)).collect();
    let x = y.iter().map(|p| law.quantile(*p)).collect();
    Some(Series::new(label, Mark::Own(Look::line(pen)), x, y))
}

impl LawCells {
    /// The kept analyses.
    ///
    /// # Errors
    /// Where a file has been damaged.
    pub fn kept() -> anyhow::Result<Self> {
        Ok(Self {
            cells: parse(CELLS).context("fixtures/law/cells.csv")?,
            parts: parse(PARTS).context("fixtures/law/parts.csv")?,
            pulses: parse(PULSES).context("fixtures/law/pulses.csv")?,
            judged: serde_json::from_str(LAW).context("law.json")?,
        })
    }

    fn in_range(&self) -> impl Iterator<Item = &LawCell> {
        let (low, high) = FREQUENCY_RANGE_RAD_S;
        let is_in = move |c: &&LawCell| (low..=high).contains(&c.p_rad_s);
        self.cells.iter().filter(|c| c.is_paper_s()).filter(is_in)
    }

    /// The suites in their order.
    fn suites(&self) -> Vec<&str> {
        let mut names: Vec<&str> =
            self.cells.iter().map(|c| c.suite.as_str()).collect();
        names.dedup();
        names
    }

    /// The answer, and its numbers.
    ///
    /// # Errors
    /// None in practice: the blocks are in the range of the law.
    pub fn answer(&self) -> anyhow::Result<(String, String)> {
        let (p_low, p_high) = FREQUENCY_RANGE_RAD_S;
        let shown = self.in_range().filter(|c| c.alpha_rad == SHOWN_RAD);
        let laws = shown.map(|c| law(c.p_rad_s));
        let laws = laws.collect::<anyhow::Result<Vec<_>>>()?;
        let (low, high) = range(laws.iter().map(|l| l.median_ratio));
        let error = laws.first().map_or(f64::NAN, |l| l.law_error);
        let (least, most) = range(self.in_range().map(|c| c.median));
        let (pga_low, pga_high) =
            range(self.in_range().filter_map(|c| c.pga_median));
        let (s_low, s_high) = range(laws.iter().map(|l| l.record_dispersion));
        let LawJudgement { cells, rocks, .. } = &self.judged;
        let all = cells.holds + cells.open + cells.fails;
        let (alpha_low, alpha_high) = SLENDERNESS_RANGE_RAD;
        let (eta_low, eta_high) = RESTITUTION_RANGE;
        let rocks: Vec<String> = rocks
            .iter()
            .map(|r| format!("{:.2}", r.measured_over_law))
            .collect();
        let answer = format!(
            "Yes, in AvgSA, the geometric mean of SA over periods from 0.15 \
             to 1.0 times 2π/p, which scale with the block: half of the \
             motions overturn any block at {least:.1} to {most:.1} g tan α, \
             in PGA at {pga_low:.1} to {pga_high:.0} g tan α. The law gives \
             {low:.1} to {high:.1}; the error of its median is {:.0} %.",
            100.0 * error
        );
        let numbers = format!(
            "Blocks: p {p_low} to {p_high} rad/s, alpha {alpha_low} to \
             {alpha_high}, eta {eta_low} to {eta_high}; of {all} cells of six \
             other suites {} shown within 15 %, {} beyond, {} open; dispersion \
             {s_high:.2} to {s_low:.2}, falling with p; tests of two \
             rocks {} times the law",
            cells.holds,
            cells.fails,
            cells.open,
            rocks.join(" and ")
        );
        Ok((answer, numbers))
    }

    /// The law as a formula, in a sentence.
    pub fn formula(&self) -> String {
        let sum = |terms: &BTreeMap<String, f64>| {
            let term = |(name, c): (&String, &f64)| match name.as_str() {
                "1" => c.to_string(),
                name => format!("{c} {name}"),
            };
            terms.iter().map(term).collect::<Vec<_>>().join(" + ")
        };
        format!(
            "The law: ln of median AvgSA/(g tan alpha) = {}; ln of dispersion \
             = {}; l = ln(p/sqrt 6), d = |theta|/alpha, 1 for overturning. \
             The error of the median is the root mean square of its \
             logarithm. It does not include the error of the model.",
            sum(&self.judged.ln_median),
            sum(&self.judged.ln_dispersion)
        )
    }

    /// Fragilities of the paper's blocks under all suites.
    fn fan(
        &self,
        title: &str,
        x: ChartAxis,
        of: impl Fn(&LawCell) -> Option<(f64, f64)>,
    ) -> ChartPanel {
        let mut series = Vec::new();
        for (k, p) in FREQUENCIES_RAD_S.iter().enumerate() {
            let own = self.in_range().filter(|c| {
                c.p_rad_s == *p && SLENDERNESSES_RAD.contains(&c.alpha_rad)
            });
            let pen = Pen::new(Ink::Series(k), 0.7);
            for (n, (median, s)) in own.filter_map(&of).enumerate() {
                let label = format!("*p* = {p} s^{{−1}}");
                let label = if n == 0 { label } else { String::new() };
                series.extend(curve(&label, pen, median, s));
            }
        }
        let y = ChartAxis::linear("probability of overturning", (0.0, 1.0));
        ChartPanel::new(title, x, y, series)
    }

    /// Fifteen blocks and all suites in both measures; a pulse.
    ///
    /// # Errors
    /// None in practice: the blocks are in the range of the law.
    pub fn figure(&self) -> anyhow::Result<Figure> {
        let pga = |c: &LawCell| c.pga_median.zip(c.pga_dispersion);
        let average = |c: &LawCell| Some((c.median, c.dispersion));
        let label = "AvgSA / (*g* tan *α*)";
        let ends = (0.8, 40.0);
        let axis = |label| ChartAxis::logarithmic(label, ends);
        let mut ours = self.fan("AvgSA", axis(label), average);
        let own = law(3.0)?;
        let pen = Pen::new(Ink::Text, 2.0).dash(Dash::Dashed);
        let line = curve(
            "the law, *p* = 3 s^{−1}",
            pen,
            own.median_ratio,
            own.record_dispersion,
        );
        ours.series.extend(line);
        let mut pulses: Vec<Series> = Vec::new();
        for name in ["one sine", "one cosine"] {
            let own = self.pulses.iter().filter(|c| c.pulse == name);
            let (x, y) = own.map(|c| (c.omega_over_p, c.avgsa)).unzip();
            let pen = Pen::of_series(FREQUENCIES_RAD_S.len() + pulses.len());
            let look = Mark::Own(Look::line(pen));
            pulses.push(Series::new(name, look, x, y));
        }
        let panels = vec![
            self.fan("PGA", axis("PGA / (*g* tan *α*)"), pga),
            ours,
            ChartPanel::new(
                "a single pulse, Eq. 2",
                ChartAxis::logarithmic("*ω* / *p*", (0.5, 16.0)),
                ChartAxis::linear(label, (0.0, 9.0)),
                pulses,
            ),
        ];
        let heading = Heading::new(
            "law",
            "One curve for all blocks and suites",
            "Lognormal fragilities of fifteen blocks under seven suites of \
             motions: in PGA they spread over more than a decade, in AvgSA \
             they nearly coincide. AvgSA at overturning by a single sine and \
             a single cosine, against pulse frequency divided by p.",
        );
        let heading = Heading { place: Place::Answers, ..heading };
        let reading = "(a), (b) Lognormal fragilities of 15 blocks under \
                       seven suites of motions, five of them recorded. (c) \
                       AvgSA at overturning by a single pulse.";
        Ok(Chart { heading, panels, columns: 3 }.figure(reading))
    }

    /// Medians and dispersions by suite and p.
    ///
    /// # Errors
    /// None in practice: the blocks are in the range of the law.
    pub fn table(&self) -> anyhow::Result<PlainTable> {
        let shown = |c: &&LawCell| c.is_paper_s() && c.alpha_rad == SHOWN_RAD;
        let of = |suite: &str| -> Vec<&LawCell> {
            let own = self.cells.iter().filter(|c| c.suite == suite);
            own.filter(shown).collect()
        };
        let first = of(FITTED);
        let mut header = vec!["suite".to_owned(), "motions".to_owned()];
        header.extend(first.iter().map(|c| format!("p = {}", c.p_rad_s)));
        let mut rows = Vec::new();
        for suite in self.suites() {
            let own = of(suite);
            let records = own.first().map_or(0, |c| c.records);
            let mut row = vec![suite.to_owned(), records.to_string()];
            row.extend(own.iter().map(|c| {
                format!(
                    "{:.2} ({:.2} to {:.2}), {:.2}, {}",
                    c.median,
                    c.median_low,
                    c.median_high,
                    c.dispersion,
                    c.judged
                )
            }));
            rows.push(row);
        }
        let mut row = vec!["law".to_owned(), String::new()];
        row.extend(first.iter().map(|c| {
            law(c.p_rad_s).map_or("refused".into(), |own| {
                format!(
                    "{:.2}, {:.2}",
                    own.median_ratio, own.record_dispersion
                )
            })
        }));
        rows.push(row);
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        Ok(PlainTable::new(
            "law-by-suite",
            "AvgSA/(g tan alpha) at overturning, by suite and p",
            format!(
                "Median with its 95 % interval by earthquake, dispersion, and \
                 verdict: the interval, divided by the law's median, is \
                 within 0.87 to 1.15 (holds), outside (fails), or neither \
                 (open). alpha = {SHOWN_RAD}, eta = {RESTITUTION}. The law was \
                 fitted to the first suite."
            ),
            &header,
            rows,
        ))
    }

    /// By how much a part of the motions must be scaled further.
    pub fn parts(&self) -> PlainTable {
        let mut rows: Vec<Vec<String>> = Vec::new();
        let mut header = vec!["suite".to_owned(), "part".to_owned()];
        for cell in &self.parts {
            let column = format!("p = {}", cell.p_rad_s);
            if !header.contains(&column) {
                header.push(column);
            }
            let names = [&cell.suite, &cell.part];
            let own = rows.iter_mut().find(|row| names == [&row[0], &row[1]]);
            let value = format!(
                "{:.2} ({:.2} to {:.2})",
                cell.factor, cell.factor_16, cell.factor_84
            );
            match own {
                Some(row) => row.push(value),
                None => {
                    rows.push(vec![names[0].clone(), names[1].clone(), value])
                }
            }
        }
        let header: Vec<&str> = header.iter().map(String::as_str).collect();
        PlainTable::new(
            "law-parts",
            "The part of a motion that overturns a block",
            format!(
                "Scale factor at which this part of the record first \
                 overturns the block, divided by the factor for the whole \
                 record: median and 16 to 84 % range over the records. \
                 alpha = {SHOWN_RAD}, eta = {RESTITUTION}."
            ),
            &header,
            rows,
        )
    }
}
