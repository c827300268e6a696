//! The checks that a reader asks for first, as tables: pulses against closed
//! forms, and critical values beside published ones.

use rocking_statistics::lilliefors::{LillieforsError, LillieforsTable};
use serde::Deserialize;

use super::proof::Proof;
use rocking_common::table::{PlainTable, digits};
use rocking_common::words::percent;
use rocking_proof::cases::{Case, CaseError, load_all};
use rocking_proof::verdict::snapshot::CaseResult;

/// The pulses of the closed forms, in the order in which the cases name them.
const PULSES: &str = rocking_fixtures::text("references/linear_pulses.json");
/// Method of the cases that run them.
const PULSE_METHOD: &str = "linear-pulse";
/// Cases with critical values of others.
const SIMULATION: &str = "lilliefors/independent-simulation";
const PUBLISHED: &str = "lilliefors/published-tables";
/// Level of the critical values shown.
const LEVEL: f64 = 0.05;
/// Sizes shown beside those of the cases.
const SIZES: [usize; 1] = [5];
/// Largest size of the published formula.
const FORMULA_TO: usize = 100;

#[derive(Deserialize)]
struct PulseFile {
    cases: Vec<PulseEntry>,
}

#[derive(Deserialize)]
struct PulseEntry {
    pulse: String,
    /// Of the acceleration, of one pulse of the velocity: a number, and words
    /// in brackets.
    #[serde(rename = "A", alias = "A_v")]
    amplitude: String,
    #[serde(rename = "Omega", alias = "f_p")]
    frequency: Option<String>,
    eta: String,
}

/// Errors against the closed forms, pulse by pulse; by the results handed in.
pub fn similarity(proof: &Proof) -> PlainTable {
    let pulses: Vec<PulseEntry> = serde_json::from_str::<PulseFile>(PULSES)
        .map_or_else(|_| Vec::new(), |found| found.cases);
    let row = |(case, result): (&Case, &CaseResult)| {
        let entry = case.input.get("entry")?.as_integer()?;
        let pulse = pulses.get(usize::try_from(entry).ok()?)?;
        let quantities = &result.quantities;
        let error = |name: &str| {
            let Some(of) = quantities.get(name) else {
                return "–".to_owned();
            };
            let bound = of.bound.as_f64().unwrap_or(f64::NAN);
            match (of.values, of.margin.0 * bound) {
                (0, _) => "–".to_owned(),
                (_, 0.0) => "none".to_owned(),
                (_, error) => digits(error, 1),
            }
        };
        let impacts = quantities.get("impact-times-p").map(|of| of.values);
        Some(vec![
            pulse.pulse.replace('_', "-"),
            pulse.frequency.as_deref().map_or("–", bare).to_owned(),
            bare(&pulse.amplitude).to_owned(),
            pulse.eta.clone(),
            impacts.unwrap_or(0).to_string(),
            error("peak-ratio"),
            error("impact-times-p"),
            error("impact-speeds"),
        ])
    };
    let own = proof.cases().filter(|(case, _)| case.method == PULSE_METHOD);
    let header = [
        "pulse",
        "frequency over p",
        "amplitude over g alpha",
        "eta",
        "impacts compared",
        "peak, relative error",
        "impact times p t, error",
        "impact speeds, relative error",
    ];
    PlainTable::new(
        "sine-pulse-similarity",
        "Pulses in Eq. 2 against closed forms",
        "Each row runs six blocks of alpha 0.001 to 0.4 rad and p \
                  0.5 to 8 rad/s, which have one and the same closed form. \
                  The error is the largest over the six. A dash stands where \
                  the motion has no such number, or the case does not \
                  compare it.",
        &header,
        own.filter_map(row).collect(),
    )
}

/// A number without the words in brackets behind it.
fn bare(number: &str) -> &str {
    number.split(" (").next().unwrap_or(number)
}

#[derive(Default, Deserialize)]
struct SimulationInput {
    n: Vec<usize>,
    levels: Vec<f64>,
    values: Vec<Vec<f64>>,
}

#[derive(Default, Deserialize)]
struct PublicationInput {
    sources: Vec<String>,
    n: Vec<usize>,
    values: Vec<f64>,
}

/// Our critical values at 5 % beside those of an independent simulation, of
/// published sources and of other software, with the level at which a test
/// by them really is.
///
/// # Errors
/// [`CaseError`] where the declared cases cannot be read.
pub fn critical_values() -> Result<PlainTable, CaseError> {
    let cases = load_all()?;
    let input = |id: &str| {
        let case = cases.iter().find(|case| case.id == id);
        case.map(|case| toml::Value::Table(case.input.clone()))
    };
    let simulated: SimulationInput = case_input(input(SIMULATION));
    let published: PublicationInput = case_input(input(PUBLISHED));
    let mut all: Vec<(usize, String, f64)> = Vec::new();
    let at = simulated.levels.iter().position(|level| *level == LEVEL);
    for (n, values) in simulated.n.iter().zip(&simulated.values) {
        if let Some(value) = at.and_then(|k| values.get(k)) {
            all.push((*n, "independent simulation".into(), *value));
        }
    }
    for ((source, n), value) in
        published.sources.iter().zip(&published.n).zip(&published.values)
    {
        all.push((*n, source.clone(), *value));
    }
    let mut sizes: Vec<usize> =
        all.iter().map(|(n, ..)| *n).chain(SIZES).collect();
    sizes.sort_unstable();
    sizes.dedup();
    let mut rows = Vec::new();
    for n in sizes {
        let Ok((ours, error)) =
            LillieforsTable::embedded().critical_value(n, LEVEL)
        else {
            continue;
        };
        let mut row = |who: String, value: f64, away: Option<f64>| {
            let level = level_of(n, value).unwrap_or(f64::NAN);
            rows.push(vec![
                n.to_string(),
                who,
                format!("{value:.5}"),
                away.map_or("–".into(), |x| {
                    format!("{x:+.2} %").replace('-', "−")
                }),
                percent(level, 2),
            ]);
        };
        let words = format!("this program, standard error {error:.1e}");
        row(words, ours, None);
        let away = |value: f64| Some(100.0 * (value / ours - 1.0));
        for (_, who, value) in all.iter().filter(|(size, ..)| *size == n) {
            row(who.clone(), *value, away(*value));
        }
        let given = all
            .iter()
            .any(|(size, who, _)| *size == n && who.contains("Dallal"));
        if n <= FORMULA_TO && !given {
            let value = dallal_wilkinson(n);
            let words = "Dallal and Wilkinson 1986, formula evaluated here";
            row(words.into(), value, away(value));
        }
    }
    let header =
        ["n", "source", "critical value at 5 %", "against ours", "true level"];
    Ok(PlainTable::new(
        "lilliefors-critical-values",
        "Lilliefors' critical values beside those of others",
        "True level: how often a test by that value rejects normal \
                  samples of this size, by our table. Values of others at n \
                  = 44 and 86 are those that the declared case holds.",
        &header,
        rows,
    ))
}

fn case_input<T: Default + serde::de::DeserializeOwned>(
    input: Option<toml::Value>,
) -> T {
    input.and_then(|value| value.try_into().ok()).unwrap_or_default()
}

fn level_of(n: usize, value: f64) -> Result<f64, LillieforsError> {
    Ok(LillieforsTable::embedded().p_value(n, value)?.value())
}

/// Where the formula of Dallal and Wilkinson (American Statistician 40, 1986,
/// 294-296) gives a p value of 5 %; for n = 5 to 100.
fn dallal_wilkinson(n: usize) -> f64 {
    let n = n as f64;
    let log_p = |d: f64| {
        let k = n + 2.78019;
        -7.01256 * d * d * k + 2.99587 * d * k.sqrt() - 0.122119
            + 0.974598 / n.sqrt()
            + 1.67997 / n
    };
    // It falls in D over the range of critical values.
    let (mut low, mut high) = (0.5 / n.sqrt(), 1.2 / n.sqrt());
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if log_p(middle) > libm::log(LEVEL) {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_formula_gives_the_values_that_are_declared_of_it() {
        // 0.0957 and 0.1327 in the declared case.
        for (n, value) in [(86, 0.0957), (44, 0.1327)] {
            assert!((dallal_wilkinson(n) - value).abs() < 5e-5, "{n}");
        }
    }

    #[test]
    fn every_size_has_our_value_and_one_of_others() {
        let table = critical_values().unwrap();
        let count = |n: &str| table.rows.iter().filter(|r| r[0] == n).count();
        for n in ["5", "10", "20", "30", "44", "50", "86", "100", "300"] {
            assert!(count(n) >= 2, "{n}");
        }
        let at = |n: &str, who: &str| {
            let is = |r: &&Vec<String>| r[0] == n && r[1].contains(who);
            table.rows.iter().find(is).unwrap()[4].clone()
        };
        assert_eq!(at("86", "this program"), "5.00 %");
        // By the independent simulation 3.7 %.
        let level = at("86", "statsmodels");
        let level: f64 = level.trim_end_matches(" %").parse().unwrap();
        assert!((level - 3.7).abs() < 0.05, "{level}");
    }

    #[test]
    fn every_pulse_has_a_row_with_its_errors() {
        let table = similarity(&Proof::committed(0));
        assert!(table.rows.len() > 10);
        assert!(
            table.rows.iter().any(|r| r[0] == "one-sine" && r[1] == "3.0")
        );
        assert!(table.rows.iter().flatten().all(|c| c != "NaN"));
    }
}
