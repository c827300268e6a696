//! `rocking compare`: paired ratios of two samples over the same records.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use rocking::statistics::paired::{
    PairedError, Pairs, SignTest, equivalence, hodges_lehmann,
    sign_equivalence,
};
use rocking::statistics::{Boxplot, ExtendedSample, QuantileType};
use serde_json::{Value, json};

use super::samples::SampleFile;
use super::{Failure, boxplot, print, print_json};

/// Paired ratios a/b of two samples: counts, boxplot, tests of a centre at 1
/// and of equivalence to it. Values are paired by the names of their records,
/// or line by line where a value has none.
///
/// A ratio exists where both values are finite and positive. Pairs in which
/// one or both are infinite (overturned, censored) or zero are counted by
/// kind.
#[derive(ClapArgs)]
pub struct Args {
    /// Sample file of the numerators.
    #[arg(long, value_name = "FILE")]
    a: PathBuf,
    /// Sample file of the denominators, of the same records.
    #[arg(long, value_name = "FILE")]
    b: PathBuf,
    /// Margin of equivalence: ratios between 1/(1 + M) and 1 + M are
    /// equivalent to 1.
    #[arg(long, value_name = "M", default_value_t = 0.05)]
    margin: f64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for files, pairs or a margin that are refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    if !(args.margin > 0.0 && args.margin.is_finite()) {
        return Err(PairedError::Margin(args.margin).into());
    }
    let (a, b) = (SampleFile::read(&args.a)?, SampleFile::read(&args.b)?);
    let (a, b, by_name) = a.pairs(&b)?;
    let pairs = Pairs::try_new(&a, &b)?;
    let sample = ExtendedSample::try_new(&pairs.ratios).ok();
    let quantile_type = QuantileType::default();
    let boxplot =
        sample.and_then(|s| Boxplot::try_new(&s, quantile_type).ok());
    if args.json {
        let mut out = to_json(args, &pairs, boxplot.as_ref());
        out["paired_by_name"] = by_name.into();
        return print_json(out);
    }
    let paired = if by_name { "record" } else { "line" };
    let text = to_text(args, &pairs, boxplot.as_ref());
    print(&format!("paired by               {paired}\n{text}"))
}

fn to_json(args: &Args, pairs: &Pairs, boxplot: Option<&Boxplot>) -> Value {
    let ratios = &pairs.ratios;
    let sign = SignTest::of(ratios, 1.0);
    let mcnemar = pairs.mcnemar();
    let reason = |e: PairedError| json!({ "reason": e.to_string() });
    let mean = equivalence(ratios, args.margin).map_or_else(reason, |t| {
        json!({
            "geometric_mean": t.geometric_mean,
            "low": t.low,
            "high": t.high,
            "interval_level": 0.9,
            "p_lower": t.p_lower,
            "p_upper": t.p_upper,
            "p_value": t.p_value,
            "equivalent": t.p_value < 0.05,
        })
    });
    let median =
        sign_equivalence(ratios, args.margin).map_or_else(reason, |t| {
            json!({
                "p_lower": t.p_lower,
                "p_upper": t.p_upper,
                "p_value": t.p_value,
                "equivalent": t.p_value < 0.05,
            })
        });
    let centre = hodges_lehmann(ratios).map_or_else(reason, |c| {
        json!({
            "ratio": c.ratio,
            "low": c.low,
            "high": c.high,
            "interval_level": c.level,
        })
    });
    let quantile_type = QuantileType::default();
    json!({
        "n": pairs.n,
        "usable": ratios.len(),
        "share": pairs.share(),
        "only_a_infinite": pairs.only_a_infinite,
        "only_b_infinite": pairs.only_b_infinite,
        "both_infinite": pairs.both_infinite,
        "both_zero": pairs.both_zero,
        "only_a_zero": pairs.only_a_zero,
        "only_b_zero": pairs.only_b_zero,
        "boxplot": boxplot.map(|b| boxplot::to_json(b, quantile_type)),
        "sign_test": {
            "above": sign.above,
            "below": sign.below,
            "equal": sign.equal,
            "p_value": sign.p_value,
        },
        "hodges_lehmann": centre,
        "mcnemar": {
            "only_a": mcnemar.above,
            "only_b": mcnemar.below,
            "p_value": mcnemar.p_value,
        },
        "equivalence": {
            "margin": args.margin,
            "level": 0.05,
            "mean": mean,
            "median": median,
        },
    })
}

fn to_text(args: &Args, pairs: &Pairs, boxplot: Option<&Boxplot>) -> String {
    let ratios = &pairs.ratios;
    let sign = SignTest::of(ratios, 1.0);
    let mcnemar = pairs.mcnemar();
    let mut text = format!(
        "pairs                   {}\n\
         usable ratios           {} ({:.1} %)\n\
         infinite                {} only a, {} only b, {} both\n\
         zero                    {} only a, {} only b, {} both\n",
        pairs.n,
        ratios.len(),
        100.0 * pairs.share(),
        pairs.only_a_infinite,
        pairs.only_b_infinite,
        pairs.both_infinite,
        pairs.only_a_zero,
        pairs.only_b_zero,
        pairs.both_zero,
    );
    text += &boxplot.map_or(String::new(), boxplot::to_text);
    text += &format!(
        "sign test               {} above 1, {} below: p {:.5}\n\
         McNemar                 {} against {}: p {:.5}\n",
        sign.above,
        sign.below,
        sign.p_value,
        mcnemar.above,
        mcnemar.below,
        mcnemar.p_value,
    );
    if let Ok(c) = hodges_lehmann(ratios) {
        text += &format!(
            "Hodges-Lehmann          {:.6} ({:.6} .. {:.6}, {} %)\n",
            c.ratio,
            c.low,
            c.high,
            100.0 * c.level
        );
    }
    let percent = 100.0 * args.margin;
    text += &match equivalence(ratios, args.margin) {
        Ok(t) => format!(
            "equivalence, {percent} %, mean    p {:.5} (geometric mean {:.6})\n",
            t.p_value, t.geometric_mean
        ),
        Err(e) => format!("equivalence             none: {e}\n"),
    };
    if let Ok(t) = sign_equivalence(ratios, args.margin) {
        text +=
            &format!("equivalence, {percent} %, median  p {:.5}\n", t.p_value);
    }
    text
}
