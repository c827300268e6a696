//! Fits, quantiles, tests and paired procedures against other packages.

use rocking::statistics::lilliefors::Statistic;
use rocking::statistics::lognormal::{FitMethod, fit};
use rocking::statistics::normality::{
    anderson_darling, cramer_von_mises, shapiro_wilk,
};
use rocking::statistics::paired::{
    SignTest, equivalence, hodges_lehmann, sign_equivalence,
};
use rocking::statistics::rivals::{self, Family};
use rocking::statistics::{ExtendedSample, QuantileType, Sample};
use serde::Deserialize;

use super::cells::{number, refused, rows};
use crate::cases::WrongModel;
use crate::error::MethodError;
use crate::methods::method::{Answer, Context};

const LOGNORMAL: &str = "fixtures/oracles/lognormal.csv";
const LOGNORMAL_CSV: &str =
    include_str!("../../../../../fixtures/oracles/lognormal.csv");
const RIVALS: &str = "fixtures/oracles/rivals.csv";
const RIVALS_CSV: &str =
    include_str!("../../../../../fixtures/oracles/rivals.csv");
const NORMALITY: &str = "fixtures/oracles/normality.csv";
const NORMALITY_CSV: &str =
    include_str!("../../../../../fixtures/oracles/normality.csv");
const PAIRED: &str = "fixtures/oracles/paired.csv";
const PAIRED_CSV: &str =
    include_str!("../../../../../fixtures/oracles/paired.csv");
const QUANTILES: &str = "fixtures/oracles/quantiles.csv";
const QUANTILES_CSV: &str =
    include_str!("../../../../../fixtures/oracles/quantiles.csv");

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct FitInput {
    sample: Vec<f64>,
    /// As it stands in the files: a fit of the lognormal, or a rival.
    method: String,
}

/// A fit with and without a shift: parameters, likelihood and distances.
pub(crate) fn fits(context: &Context) -> Result<Answer, MethodError> {
    let input: FitInput = context.input()?;
    let sample = ExtendedSample::try_new(&input.sample).map_err(refused)?;
    let quantile_type = match context.wrong {
        Some(WrongModel::OtherQuantileType) => QuantileType::try_new(7),
        _ => QuantileType::try_new(5),
    }
    .map_err(refused)?;
    let mut answer = Answer::default();
    if let Ok(family) = input.method.parse::<Family>() {
        for row in rows(RIVALS_CSV, RIVALS, &input.method)? {
            let shift = match context.wrong {
                Some(WrongModel::HalfTheShift) => {
                    0.5 * number(RIVALS, row[1])?
                }
                _ => number(RIVALS, row[1])?,
            };
            let fit = rivals::fit(&sample, shift, family).map_err(refused)?;
            for (name, own, text) in [
                ("shape", fit.shape, row[2]),
                ("scale", fit.scale, row[3]),
                ("log-likelihood", fit.log_likelihood, row[4]),
            ] {
                answer.put(name, [own], [number(RIVALS, text)?]);
            }
        }
        return Ok(answer);
    }
    let method: FitMethod = input.method.parse()?;
    let swapped = match (context.wrong, method) {
        (Some(WrongModel::OtherDivisor), FitMethod::MaximumLikelihood) => {
            FitMethod::Moment
        }
        (Some(WrongModel::OtherDivisor), FitMethod::Moment) => {
            FitMethod::MaximumLikelihood
        }
        (Some(WrongModel::OtherDivisor), FitMethod::Censored(t)) => {
            FitMethod::Trimmed(t)
        }
        (_, own) => own,
    };
    let swapped = swapped.with_quantile_type(quantile_type);
    for row in rows(LOGNORMAL_CSV, LOGNORMAL, &input.method)? {
        let shift = match context.wrong {
            Some(WrongModel::HalfTheShift) => 0.5 * number(LOGNORMAL, row[1])?,
            _ => number(LOGNORMAL, row[1])?,
        };
        let fit = fit(&sample, shift, swapped).map_err(refused)?;
        let own = fit.distribution;
        let area = own.area_distance(&sample).unwrap_or(f64::NAN);
        let likelihood = fit.log_likelihood.unwrap_or(f64::NAN);
        for (name, own, text) in [
            ("kept", fit.n_kept as f64, row[2]),
            ("mu", own.log_mean(), row[3]),
            ("beta", own.dispersion(), row[4]),
            ("log-likelihood", likelihood, row[5]),
            ("kolmogorov", own.kolmogorov_distance(&sample), row[6]),
            ("area", area, row[7]),
        ] {
            answer.put(name, [own], [number(LOGNORMAL, text)?]);
        }
    }
    Ok(answer)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct QuantileInput {
    sample: Vec<f64>,
    /// Types 1 to 9.
    number: u8,
}

/// Quantiles of one type for several sizes and probabilities.
pub(crate) fn quantiles(context: &Context) -> Result<Answer, MethodError> {
    let input: QuantileInput = context.input()?;
    let used = match (context.wrong, input.number) {
        (Some(WrongModel::OtherQuantileType), 7) => 5,
        (Some(WrongModel::OtherQuantileType), _) => 7,
        (_, own) => own,
    };
    let quantile_type = QuantileType::try_new(used).map_err(refused)?;
    let mut answer = Answer::default();
    for n in ["1", "2", "10", "11"] {
        for row in rows(QUANTILES_CSV, QUANTILES, n)? {
            if row[1] != input.number.to_string() {
                continue;
            }
            let size = number(QUANTILES, n)? as usize;
            let sample =
                Sample::try_new(&input.sample[..size]).map_err(refused)?;
            let p = number(QUANTILES, row[2])?;
            let own = quantile_type.of(&sample, p).map_err(refused)?;
            let expected = number(QUANTILES, row[3])?;
            answer.put("quantile", [own], [expected]);
        }
    }
    Ok(answer)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct TestInput {
    sample: Vec<f64>,
    /// Its letter in the file.
    letter: String,
}

/// Statistics and p-values of four tests of normality of the logarithms.
pub(crate) fn tests(context: &Context) -> Result<Answer, MethodError> {
    let input: TestInput = context.input()?;
    let logs: Vec<f64> = match context.wrong {
        Some(WrongModel::NoLogarithm) => input.sample.clone(),
        _ => input.sample.iter().map(|x| libm::log(*x)).collect(),
    };
    let sample = Sample::try_new(&logs).map_err(refused)?;
    let rows = rows(NORMALITY_CSV, NORMALITY, &input.letter)?;
    let d = Statistic::try_new(&sample).map_err(refused)?;
    let d = match context.wrong {
        Some(WrongModel::UpperSideOnly) => d.d_plus.min(d.d_minus),
        _ => d.d,
    };
    let a = anderson_darling(&sample).map_err(refused)?;
    let w = cramer_von_mises(&sample).map_err(refused)?;
    let s = shapiro_wilk(&sample).map_err(refused)?;
    let mut answer = Answer::default();
    for (name, own, text) in [
        ("lilliefors", d, rows[0][2]),
        ("anderson-darling", a.statistic, rows[0][3]),
        ("anderson-darling-p", a.p_value, rows[0][4]),
        ("cramer-von-mises", w.statistic, rows[0][5]),
        ("cramer-von-mises-p", w.p_value, rows[0][6]),
        ("shapiro-wilk", s.statistic, rows[0][7]),
        ("shapiro-wilk-p", s.p_value, rows[0][8]),
    ] {
        // R's tests refuse fewer than eight values for two of them.
        if text != "NA" {
            answer.put(name, [own], [number(NORMALITY, text)?]);
        }
    }
    Ok(answer)
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct PairedInput {
    ratios: Vec<f64>,
    letter: String,
}

/// Equivalence by t and sign tests, the sign test, Hodges and Lehmann.
pub(crate) fn paired(context: &Context) -> Result<Answer, MethodError> {
    let input: PairedInput = context.input()?;
    let margin = match context.wrong {
        // 1 -+ m instead of 1/(1 + m) to 1 + m.
        Some(WrongModel::OtherMargin) => 0.06,
        _ => 0.05,
    };
    let mean = equivalence(&input.ratios, margin).map_err(refused)?;
    let median = sign_equivalence(&input.ratios, margin).map_err(refused)?;
    let sign = SignTest::of(&input.ratios, 1.0);
    let centre = hodges_lehmann(&input.ratios).map_err(refused)?;
    let own = [
        ("geometric_mean", mean.geometric_mean),
        ("low", mean.low),
        ("high", mean.high),
        ("p_lower", mean.p_lower),
        ("p_upper", mean.p_upper),
        ("sign_lower", median.p_lower),
        ("sign_upper", median.p_upper),
        ("sign", sign.p_value),
        ("hl", centre.ratio),
        ("hl_low", centre.low),
        ("hl_high", centre.high),
    ];
    let rows = rows(PAIRED_CSV, PAIRED, &input.letter)?;
    let mut answer = Answer::default();
    for (name, own) in own {
        let row = rows.iter().find(|row| row[1] == name);
        let row = row.ok_or_else(|| MethodError::Reference {
            file: PAIRED,
            what: format!("no `{name}`"),
        })?;
        let expected = number(PAIRED, row[2])?;
        answer.put(&name.replace('_', "-"), [own], [expected]);
    }
    Ok(answer)
}
