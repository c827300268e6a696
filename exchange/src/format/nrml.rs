//! OpenQuake's fragility models, NRML 0.5, as version 3.26 reads them.
//!
//! - Its `mean` and `stddev` are of the intensity, not of its logarithm.
//! - Its lognormal has no shift, and `noDamageLimit` cuts a curve, it does
//!   not move it: a shifted fragility is written as points.
//! - A level below `minIML` is raised to it before it is compared with
//!   `noDamageLimit`: `minIML` may not be above that.

use maud::{Markup, PreEscaped, html};
use rocking::fragility::points::points;
use rocking::intensity::Intensity;
use rocking::statistics::Lognormal;

use super::{ExchangeError, TAIL, TOLERANCE};
use crate::fragility::{BlockFragility, Id};
use crate::table::number;

const HEAD: &str = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
const SPACE: &str = "http://openquake.org/xmlns/nrml/0.5";

pub(super) fn text(
    fragilities: &[BlockFragility],
    limit_state: &Id,
) -> Result<String, ExchangeError> {
    let mut functions = Vec::new();
    for one in fragilities {
        functions.push(function(one, limit_state)?);
    }
    let mut origins: Vec<&str> =
        fragilities.iter().map(|one| one.origin.as_str()).collect();
    origins.dedup();
    let line = PreEscaped("\n");
    let model = html! {
        nrml xmlns=(SPACE) { (line)
            fragilityModel id="rocking_blocks" assetCategory="contents"
                lossCategory="contents" { (line)
                description { (origins.join("; ")) } (line)
                limitStates { (limit_state) } (line)
                @for function in functions { (function) (line) }
            } (line)
        } (line)
    };
    Ok(format!("{HEAD}{}", model.into_string()))
}

fn function(
    one: &BlockFragility,
    limit_state: &Id,
) -> Result<Markup, ExchangeError> {
    let (imt, fragility) = match one.intensity {
        Intensity::Pga => ("PGA", one.fragility),
        // OpenQuake's PGV is in cm/s.
        Intensity::Pgv => ("PGV", one.fragility.scaled(100.0)?),
    };
    let line = PreEscaped("\n");
    if fragility.shift() > 0.0 {
        let points = points(&fragility, TOLERANCE)?;
        let words = |each: fn(&(f64, f64)) -> f64| {
            let words: Vec<String> =
                points.iter().map(|point| number(each(point))).collect();
            words.join(" ")
        };
        return Ok(html! {
            fragilityFunction id=(one.id) format="discrete" { (line)
                imls imt=(imt) noDamageLimit=(number(fragility.shift())) {
                    (words(|point| point.0))
                } (line)
                poes ls=(limit_state) { (words(|point| point.1)) } (line)
            }
        });
    }
    let (least, most) = range(&fragility);
    Ok(html! {
        fragilityFunction id=(one.id) format="continuous" shape="logncdf" {
            (line)
            imls imt=(imt) noDamageLimit=(number(least))
                minIML=(number(least)) maxIML=(number(most)) {} (line)
            params ls=(limit_state) mean=(number(fragility.mean()))
                stddev=(number(fragility.standard_deviation())) {} (line)
        }
    })
}

/// Intensities between which all of a fragility but its ends lies.
fn range(fragility: &Lognormal) -> (f64, f64) {
    (fragility.quantile(TAIL), fragility.quantile(1.0 - TAIL))
}
