//! Libraries of pelicun, as version 3.10 reads them: a CSV with the
//! parameters, and a JSON that describes them.
//!
//! - A shifted lognormal, and its total, is a `multilinear_CDF`,
//!   "x1,x2,..|p1,p2,..", which begins with probability 0, ends with 1, and
//!   whose steps exceed 1e-8.
//! - A limit state `LSk` is followed by `LSk+1`; the damage states `DSk` are
//!   counted through all limit states.
//! - Where a component is named, a name with `-` is split there.
//! - `Demand-Directional` is 1: for a component without direction pelicun
//!   multiplies the larger of two demands by 1.2, but the intensity here is
//!   the intensity of the applied component.

use rocking_procedures::fragility::points::points;
use rocking_procedures::fragility::total::TotalFragility;
use rocking_records::intensity::{Intensity, IntensityMeasure};
use serde_json::{Map, json};

use super::{ExchangeError, ExchangeFormat, Result, TOLERANCE, Texts};
use crate::fragility::BlockFragility;
use crate::table::{Table, number};

/// The format.
pub(super) static FORMAT: ExchangeFormat = ExchangeFormat {
    name: "pelicun",
    help: "CSV, and JSON beside it: PGA, SA in g, PGV in m/s",
    cells: "pelicun 3.10; a JSON lies beside the CSV | PGA, PGV, SA | as points of the curve",
    beside: Some("json"),
    in_assessment: true,
    texts,
    ..ExchangeFormat::BASE
};

/// The smallest step that pelicun distinguishes from zero.
const LEAST_STEP: f64 = 1e-8;

fn texts(fragilities: &[BlockFragility]) -> Result<Texts> {
    let beside = Some(json(fragilities));
    Ok(Texts { main: csv(fragilities)?, beside })
}

fn csv(fragilities: &[BlockFragility]) -> Result<String> {
    let states = fragilities.iter().map(|one| one.limit_states.len());
    let states = states.max().unwrap_or(0);
    let mut header = String::from(
        "ID,Incomplete,Demand-Type,Demand-Unit,Demand-Offset,\
         Demand-Directional",
    );
    for k in 1..=states {
        for part in ["Family", "Theta_0", "Theta_1", "DamageStateWeights"] {
            header += &format!(",LS{k}-{part}");
        }
    }
    let mut table = Table::headed(&header);
    for one in fragilities {
        let (demand, unit) = demand(one)?;
        let mut row = vec![one.id.to_string(), "0".into(), demand];
        row.extend([unit, "0", "1"].map(String::from));
        for (_, total) in one.totals(1.0)? {
            row.extend(law(one, &total)?);
            row.push(String::new());
        }
        row.resize(6 + 4 * states, String::new());
        table.row(row);
    }
    Ok(table.finish())
}

/// Type and unit of the demand.
fn demand(one: &BlockFragility) -> Result<(String, &'static str)> {
    Ok(match &one.im {
        IntensityMeasure::Axis(Intensity::Pga) => {
            ("Peak Ground Acceleration".into(), "g")
        }
        IntensityMeasure::Axis(Intensity::Pgv) => {
            ("Peak Ground Velocity".into(), "mps")
        }
        IntensityMeasure::Sa(period_s) => {
            (format!("Spectral Acceleration|{period_s:?}"), "g")
        }
        _ => return Err(one.unknown("pelicun", "pga, pgv or sa:T")),
    })
}

/// Family and parameters.
fn law(one: &BlockFragility, total: &TotalFragility) -> Result<[String; 3]> {
    let closed = total.closed().filter(|law| law.shift() == 0.0);
    let Some(law) = closed else {
        let points = points(*total, TOLERANCE)?;
        let wide = |pair: &[(f64, f64)]| pair[1].0 - pair[0].0 > LEAST_STEP;
        if !points.windows(2).all(wide) {
            let unit = one.im.unit();
            return Err(ExchangeError::Narrow { id: one.id.clone(), unit });
        }
        let (x, p): (Vec<_>, Vec<_>) =
            points.iter().map(|(x, p)| (number(*x), number(*p))).unzip();
        let both = format!("{}|{}", x.join(","), p.join(","));
        return Ok(["multilinear_CDF".into(), both, String::new()]);
    };
    let (median, beta) = (law.median(), law.dispersion());
    Ok(["lognormal".into(), number(median), number(beta)])
}

fn json(fragilities: &[BlockFragility]) -> String {
    let mut library = Map::new();
    for one in fragilities {
        let states = one.limit_states.iter().zip(1..).map(|(state, k)| {
            let damage = json!({
                "Description": state.name.to_string(),
                "RepairAction": "Not stated",
            });
            (format!("LS{k}"), json!({ format!("DS{k}"): damage }))
        });
        let entry = json!({
            "Description": format!(
                "Free-standing rigid block, alpha {} rad, p {} rad/s",
                number(one.block.slenderness_rad()),
                number(one.block.frequency_rad_s()),
            ),
            "Comments": one.described(),
            "SuggestedComponentBlockSize": "1 EA",
            "RoundUpToIntegerQuantity": "True",
            "LimitStates": states.collect::<Map<_, _>>(),
        });
        library.insert(one.id.to_string(), entry);
    }
    format!("{:#}\n", serde_json::Value::Object(library))
}
