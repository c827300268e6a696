//! OpenQuake's fragility models, NRML 0.5, as version 3.26 reads them.
//!
//! - Its `mean` and `stddev` are of the intensity, not of its logarithm.
//! - Its lognormal has no shift, and `noDamageLimit` cuts a curve without
//!   moving it: a shifted fragility is written as points.
//! - A level below `minIML` is raised to it before it is compared with
//!   `noDamageLimit`: `minIML` may not be above that.
//! - All functions have one list of limit states, and a function has one list
//!   of levels for all its limit states.
//! - Its average spectral acceleration does not state its periods.
//! - A model has one description: it states each origin once, and of many
//!   origins the first.

use maud::{Markup, PreEscaped, html};
use rocking_procedures::fragility::points::points;
use rocking_procedures::fragility::total::TotalFragility;
use rocking_records::intensity::{Intensity, IntensityMeasure};

use super::{ExchangeError, ExchangeFormat, Result, TAIL, TOLERANCE, Texts};
use crate::fragility::{BlockFragility, StateTotal};
use crate::table::number;

/// The format.
pub(super) static FORMAT: ExchangeFormat = ExchangeFormat {
    name: "nrml",
    help: "OpenQuake's NRML 0.5: PGA, SA, AvgSA in g, PGV in cm/s",
    cells: "OpenQuake 3.26 | PGA, PGV, SA, AvgSA (NRML does not state its periods) | as points of the curve",
    extension: "xml",
    in_assessment: true,
    texts,
    ..ExchangeFormat::BASE
};

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
const SPACE: &str = "http://openquake.org/xmlns/nrml/0.5";

/// The most origins in a description.
const MOST_ORIGINS: usize = 5;

fn texts(fragilities: &[BlockFragility]) -> Result<Texts> {
    let names = fragilities.first().map_or(String::new(), states);
    let mut functions = Vec::new();
    for one in fragilities {
        let found = states(one);
        if found != names {
            let (id, expected) = (one.id.clone(), names);
            return Err(ExchangeError::Mixed { id, found, expected });
        }
        functions.push(function(one)?);
    }
    let line = PreEscaped("\n");
    let model = html! {
        nrml xmlns=(SPACE) { (line)
            fragilityModel id="rocking_blocks" assetCategory="contents"
                lossCategory="contents" { (line)
                description { (description(fragilities)) } (line)
                limitStates { (names) } (line)
                @for function in functions { (function) (line) }
            } (line)
        } (line)
    };
    let main = format!("{HEAD}{}", model.into_string());
    Ok(Texts { main, beside: None })
}

/// Names of the limit states.
fn states(one: &BlockFragility) -> String {
    let names = one.limit_states.iter().map(|state| state.name.to_string());
    names.collect::<Vec<_>>().join(" ")
}

/// Each origin once, or the first and the number of the others.
fn description(fragilities: &[BlockFragility]) -> String {
    let mut origins: Vec<String> = Vec::new();
    for own in fragilities.iter().map(BlockFragility::described) {
        if !origins.contains(&own) {
            origins.push(own);
        }
    }
    match origins.len() {
        0..=MOST_ORIGINS => origins.join("; "),
        n => format!("{}; and {} other origins", origins[0], n - 1),
    }
}

/// OpenQuake's name of a measure, and the number of its units in our unit.
fn measure(one: &BlockFragility) -> Result<(String, Option<f64>)> {
    Ok(match &one.im {
        IntensityMeasure::Axis(Intensity::Pga) => ("PGA".into(), None),
        // OpenQuake's PGV is in cm/s.
        IntensityMeasure::Axis(Intensity::Pgv) => ("PGV".into(), Some(100.0)),
        IntensityMeasure::Sa(period_s) => (format!("SA({period_s:?})"), None),
        IntensityMeasure::AverageSa(_) | IntensityMeasure::RockingSa(_) => {
            ("AvgSA".into(), None)
        }
        _ => {
            let expected = "pga, pgv, sa:T, avgsa:T1,T2,.. or avgsa:rocking";
            return Err(one.unknown("NRML", expected));
        }
    })
}

fn function(one: &BlockFragility) -> Result<Markup> {
    let (imt, units) = measure(one)?;
    let totals = one.totals(units.unwrap_or(1.0))?;
    let line = PreEscaped("\n");
    let closed = |(state, total): &StateTotal<'_>| {
        let law = total.closed().filter(|law| law.shift() == 0.0)?;
        Some((state.name.clone(), law))
    };
    let laws: Option<Vec<_>> = totals.iter().map(closed).collect();
    let Some(laws) = laws else {
        let (levels, curves) = discrete(totals.iter().map(|(_, law)| law))?;
        return Ok(html! {
            fragilityFunction id=(one.id) format="discrete" { (line)
                imls imt=(imt) noDamageLimit=(number(levels[0])) {
                    (words(&levels))
                } (line)
                @for ((state, _), curve) in totals.iter().zip(&curves) {
                    poes ls=(state.name) { (words(curve)) } (line)
                }
            }
        });
    };
    let ends = |p: f64| laws.iter().map(move |(_, law)| law.quantile(p));
    let least = ends(TAIL).fold(f64::INFINITY, f64::min);
    let most = ends(1.0 - TAIL).fold(0.0, f64::max);
    Ok(html! {
        fragilityFunction id=(one.id) format="continuous" shape="logncdf" {
            (line)
            imls imt=(imt) noDamageLimit=(number(least))
                minIML=(number(least)) maxIML=(number(most)) {} (line)
            @for (name, law) in &laws {
                params ls=(name) mean=(number(law.mean()))
                    stddev=(number(law.standard_deviation())) {} (line)
            }
        }
    })
}

fn words(numbers: &[f64]) -> String {
    let words: Vec<String> = numbers.iter().map(|x| number(*x)).collect();
    words.join(" ")
}

/// The levels of all curves' own points, and the probabilities of each curve
/// there; the last is certainty.
fn discrete<'a>(
    laws: impl Iterator<Item = &'a TotalFragility> + Clone,
) -> Result<(Vec<f64>, Vec<Vec<f64>>)> {
    let mut levels = Vec::new();
    for law in laws.clone() {
        levels.extend(points(*law, TOLERANCE)?.iter().map(|point| point.0));
    }
    // Nine digits are written, and levels must rise. OpenQuake refuses a level
    // of zero.
    levels.sort_by(f64::total_cmp);
    levels.dedup_by_key(|level| number(*level));
    levels.retain(|level| *level > 0.0);
    let curves = laws.map(|law| {
        let mut curve: Vec<f64> =
            levels.iter().map(|level| law.cdf(*level)).collect();
        curve.last_mut().into_iter().for_each(|last| *last = 1.0);
        curve
    });
    let curves = curves.collect();
    Ok((levels, curves))
}
