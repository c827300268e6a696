//! Libraries of pelicun, as version 3.10 reads them: a CSV with the
//! parameters, and a JSON that describes them.
//!
//! - A shifted lognormal is a `multilinear_CDF`, "x1,x2,..|p1,p2,..", which
//!   begins with probability 0, ends with 1, and whose steps exceed 1e-8.
//! - A name with `-` is split at it wherever a component is named by it.
//! - `Demand-Directional` is 1: for a component without direction pelicun
//!   multiplies the larger of two demands by 1.2, and the intensity here is
//!   that of the component applied.

use rocking::fragility::points::points;
use rocking::intensity::Intensity;
use serde_json::{Map, json};

use super::{ExchangeError, TOLERANCE};
use crate::fragility::{BlockFragility, Id, unit};
use crate::table::{Table, number};

/// Steps that pelicun tells from none.
const LEAST_STEP: f64 = 1e-8;

pub(super) fn csv(
    fragilities: &[BlockFragility],
) -> Result<String, ExchangeError> {
    let mut table = Table::new(&[
        "ID",
        "Incomplete",
        "Demand-Type",
        "Demand-Unit",
        "Demand-Offset",
        "Demand-Directional",
        "LS1-Family",
        "LS1-Theta_0",
        "LS1-Theta_1",
        "LS1-DamageStateWeights",
    ]);
    for one in fragilities {
        let (demand, unit_name) = match one.intensity {
            Intensity::Pga => ("Peak Ground Acceleration", "g"),
            Intensity::Pgv => ("Peak Ground Velocity", "mps"),
        };
        let [family, first, second] = law(one)?;
        table.row([
            one.id.to_string(),
            "0".into(),
            demand.into(),
            unit_name.into(),
            "0".into(),
            "1".into(),
            family,
            first,
            second,
            String::new(),
        ]);
    }
    Ok(table.finish())
}

/// Family and parameters.
fn law(one: &BlockFragility) -> Result<[String; 3], ExchangeError> {
    let fragility = &one.fragility;
    if fragility.shift() > 0.0 {
        let points = points(fragility, TOLERANCE)?;
        let wide = |pair: &[(f64, f64)]| pair[1].0 - pair[0].0 > LEAST_STEP;
        if !points.windows(2).all(wide) {
            let unit = unit(one.intensity);
            return Err(ExchangeError::Narrow { id: one.id.clone(), unit });
        }
        let join = |each: fn(&(f64, f64)) -> f64| {
            let words: Vec<String> =
                points.iter().map(|point| number(each(point))).collect();
            words.join(",")
        };
        let both = format!("{}|{}", join(|p| p.0), join(|p| p.1));
        return Ok(["multilinear_CDF".into(), both, String::new()]);
    }
    let (median, beta) = (fragility.median(), fragility.dispersion());
    Ok(["lognormal".into(), number(median), number(beta)])
}

pub(super) fn json(
    fragilities: &[BlockFragility],
    limit_state: &Id,
) -> String {
    let mut library = Map::new();
    for one in fragilities {
        let (alpha, p) =
            (one.block.slenderness_rad(), one.block.frequency_rad_s());
        let entry = json!({
            "Description": format!(
                "Free-standing rigid block, alpha {} rad, p {} rad/s",
                number(alpha),
                number(p),
            ),
            "Comments": one.origin,
            "SuggestedComponentBlockSize": "1 EA",
            "RoundUpToIntegerQuantity": "True",
            "LimitStates": {
                "LS1": { "DS1": {
                    "Description": limit_state.to_string(),
                    "RepairAction": "Not stated",
                } },
            },
        });
        library.insert(one.id.to_string(), entry);
    }
    format!("{:#}\n", serde_json::Value::Object(library))
}
