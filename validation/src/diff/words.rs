//! Numbers and names as an engineer says them.

use crate::words::rounded;

/// A number with at most so many significant digits; "none" for NaN.
pub fn plain(x: f64, digits: usize) -> String {
    if x.is_nan() {
        return "none".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "inf".into() } else { "-inf".into() };
    }
    let whole = x.fract() == 0.0 && x.abs() < 1e9;
    let value = if whole { x } else { rounded(x, digits) };
    let size = value.abs();
    if value == 0.0 || (1e-4..1e9).contains(&size) {
        format!("{value}")
    } else {
        format!("{value:e}")
    }
}

/// Two numbers with as few digits as tell them apart, three at least.
pub fn pair(old: f64, new: f64) -> (String, String) {
    let at = |digits| (plain(old, digits), plain(new, digits));
    (3..17).map(at).find(|(a, b)| a != b).unwrap_or_else(|| at(17))
}

/// A share as a percentage with its sign.
pub fn percent(share: f64) -> String {
    let sign = if share < 0.0 { "-" } else { "+" };
    format!("{sign}{} %", plain(100.0 * share.abs(), 2))
}

/// Fields that tell one row of a section from another.
pub fn identities(section: &str) -> &'static [&'static str] {
    match section {
        "suites" => &["kind"],
        "questions" => &["id"],
        "single_records" => &["suite", "p_rad_s"],
        _ => &[
            "id",
            "suite",
            "im_kind",
            "choice",
            "p_rad_s",
            "alpha_rad",
            "im_pga",
            "edp",
            "arm",
        ],
    }
}

/// One of those fields in words; nothing for what the group says.
pub fn identity(field: &str, value: &str) -> Option<String> {
    Some(match field {
        "suite" | "kind" | "im_kind" => return None,
        "p_rad_s" => format!("p = {value}"),
        "alpha_rad" => {
            let alpha = value.parse::<f64>().ok();
            format!(
                "alpha = {}",
                alpha.map_or(value.to_owned(), |a| format!("{a:.2}"))
            )
        }
        "im_pga" => format!("PGA/(g tan alpha) = {value}"),
        "edp" => format!("demand {value}"),
        "arm" => format!("arm {value}"),
        _ => value.to_owned(),
    })
}

/// An intensity measure as the paper writes it.
pub fn intensity(kind: &str) -> &str {
    match kind {
        "pga" => "PGA/(g tan alpha)",
        "pgv" => "p PGV/(g tan alpha)",
        other => other,
    }
}

/// What a section is about.
pub fn section(name: &str) -> String {
    match name {
        "accepted_shares" => "lognormality along the demand".into(),
        "figure_09" => "slenderness adjusted instead of scaling".into(),
        "options" => "settings".into(),
        "overturning" => "overturning intensities".into(),
        "questions" => "questions beyond the paper".into(),
        "resurrections" => "resurrections".into(),
        "sensitivities" => "other choices".into(),
        "single_records" => "records one by one".into(),
        "suites" => "suite and work".into(),
        "uplift_unscaled" => "uplift without scaling".into(),
        other => other.replace('_', " "),
    }
}

/// What a number of a section is.
pub fn quantity(section: &str, field: &str) -> String {
    match (section, field) {
        ("overturning", "median") => "median overturning".into(),
        ("accepted_shares", "original") => {
            "share of demand levels accepted as lognormal".into()
        }
        ("accepted_shares", "shifted") => {
            "share of demand levels accepted as shifted lognormal".into()
        }
        ("accepted_shares", "im_r") => "shift IM_R".into(),
        ("figure_09", "median") => {
            "median ratio of demands, adjusted over scaled".into()
        }
        ("figure_09", "median_alpha_to_0.25") => {
            "the same where the adjusted alpha is 0.25 at most".into()
        }
        ("figure_09", "median_alpha_above_0.25") => {
            "the same where the adjusted alpha is above 0.25".into()
        }
        ("sensitivities", "median_ratio") => {
            "median ratio of capacities, this choice over the study's".into()
        }
        ("single_records", "median_distance") => {
            "median normalized distance of histories to alpha = 0.10".into()
        }
        ("single_records", "median_peak_ratio") => {
            "median ratio of peaks to alpha = 0.10".into()
        }
        ("single_records", "median_ln_im") => {
            "median |ln| of the ratio of intensities to alpha = 0.10".into()
        }
        ("uplift_unscaled", "ordinary") => {
            "ordinary records that move the block".into()
        }
        ("uplift_unscaled", "pulse_type") => {
            "pulse-type records that move the block".into()
        }
        ("resurrections", "stand_again") => {
            "overturned on a stripe that stand at that intensity".into()
        }
        ("suites", "largest_shift_if_flipped") => {
            "largest shift of an overturning quantile if all open fates \
             flipped"
                .into()
        }
        (_, field) => field.replace('_', " "),
    }
}
