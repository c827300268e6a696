//! Values of findings as people read them, each in the unit of its limit.

use rocking_common::findings::{
    Claim, ClaimResult, DecisionPower, Quantifier, Region, Unit,
};
use rocking_common::words::{rounded, rounded_text};
use rocking_statistics::Estimate;

/// How a number is shown.
#[derive(Clone, Copy, PartialEq, Eq)]
enum ValueScale {
    /// As it is.
    Plain,
    /// In per cent.
    Percent,
    /// A difference of two shares, in percentage points.
    Points,
    /// A ratio as its distance from 1, in per cent.
    Change,
}

/// How numbers are shown that are held against `region`. Ratios with limits
/// that lie as far above 1 as below are shown as a change, and small
/// differences in per cent.
fn scale(unit: Unit, region: Option<Region>) -> ValueScale {
    match (unit, region) {
        (Unit::Share, _) => ValueScale::Percent,
        (Unit::Points, _) => ValueScale::Points,
        (Unit::One, Some(Region::Within(a, b)))
            if (a + b - 2.0).abs() < 1e-9 =>
        {
            ValueScale::Change
        }
        (Unit::One, Some(Region::Below(x) | Region::Above(x))) if x < 0.5 => {
            ValueScale::Percent
        }
        _ => ValueScale::Plain,
    }
}

impl ValueScale {
    fn of(self, x: f64) -> f64 {
        match self {
            Self::Plain => x,
            Self::Percent | Self::Points => 100.0 * x,
            Self::Change => 100.0 * (x - 1.0),
        }
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Percent | Self::Change => " %",
            Self::Points => " points",
        }
    }

    fn number(self, x: f64) -> String {
        match self {
            // A ratio near 1 needs its third digit.
            Self::Plain if x.is_finite() => rounded(x, 3).to_string(),
            Self::Change if x > 1.0 && x.is_finite() => {
                format!("+{}", number(self.of(x)))
            }
            _ => number(self.of(x)),
        }
    }
}

/// Two or three digits that matter; below 0.01 only that it is.
pub fn number(x: f64) -> String {
    if x.is_nan() {
        return "none".into();
    }
    if x.is_infinite() {
        return if x > 0.0 { "infinite".into() } else { "-infinite".into() };
    }
    let digits = if x.abs() < 10.0 { 2 } else { 3 };
    let x = rounded((1e2 * x).round() / 1e2, digits);
    // No negative zero.
    if x == 0.0 { "0".into() } else { x.to_string() }
}

fn text(estimate: &Estimate, scale: ValueScale) -> String {
    if estimate.value().is_nan() {
        return "no data".into();
    }
    estimate.text(scale.unit(), |x| scale.number(x))
}

/// Whether a claim's value is a share of cells, and its region about one of
/// them.
fn of_cells(claim: &Claim) -> bool {
    let quantifier = claim.quantifier;
    matches!(quantifier, Some(Quantifier::Most | Quantifier::AlmostAll))
}

/// A result's value with its interval and unit: `12 % (8 to 17)`.
pub fn measured_text(claim: &Claim, result: &ClaimResult) -> String {
    let region = claim.region.filter(|_| !of_cells(claim));
    text(&result.estimate, scale(result.unit, region))
}

/// That text; where the limit is about one cell of many, it is the share of
/// the cells within it, and their number follows.
pub fn value_text(claim: &Claim, result: &ClaimResult) -> String {
    let text = measured_text(claim, result);
    match &result.cells {
        Some(cells) if of_cells(claim) && cells.deciding > 0 => format!(
            "{text}, {}/{} cells",
            cells.deciding,
            cells.deciding + cells.too_few
        ),
        _ => text,
    }
}

/// The number of a cell of a claim, in the unit of the claim's limit.
pub fn cell_text(claim: &Claim, value: &Estimate) -> String {
    text(value, scale(Unit::One, claim.region))
}

/// Where a claim's values have to lie: `-5 to +5 %, in every cell`; "most"
/// is more than half.
pub fn rule_text(claim: &Claim) -> String {
    let (Some(quantifier), Some(region)) = (claim.quantifier, claim.region)
    else {
        return String::new();
    };
    let unit = match of_cells(claim) {
        true => Unit::One,
        false => claim.results.first().map_or(Unit::One, |r| r.unit),
    };
    let scale = scale(unit, Some(region));
    let (number, unit) = (|x| scale.number(x), scale.unit());
    let limits = match region {
        Region::Within(a, b) => {
            format!("{} to {}{unit}", number(a), number(b))
        }
        Region::Below(x) => format!("below {}{unit}", number(x)),
        Region::Above(x) => format!("above {}{unit}", number(x)),
    };
    match quantifier {
        Quantifier::One => limits,
        Quantifier::All => format!("{limits}, in every cell"),
        Quantifier::AlmostAll => format!("{limits}, in 90 % of cells"),
        Quantifier::Most => format!("{limits}, in most cells"),
    }
}

/// What a suite like this one is able to decide.
fn power_text(power: DecisionPower) -> String {
    let share = number(100.0 * power.probability);
    let times = if power.times.is_finite() {
        format!("{} times as many motions decide", number(power.times))
    } else {
        "100 times as many motions do not decide".into()
    };
    format!(
        "power: were the value true, {share} % of such suites decide; {times} \
         in 80 %"
    )
}

/// What stands beside a result: cells, the deciding one, details, how the
/// interval was made, and power.
pub fn remarks(claim: &Claim, result: &ClaimResult) -> Vec<String> {
    let mut remarks = Vec::new();
    match &result.cells {
        Some(cells) => remarks.push(format!(
            "{} of {} cells shown inside, {} refuted{}",
            cells.inside,
            cells.deciding,
            cells.outside,
            match cells.too_few {
                0 => String::new(),
                few => format!(", {few} with too few records"),
            }
        )),
        None => remarks.push(result.at.clone()),
    }
    if let Some(cell) = &result.deciding_cell {
        let value = cell_text(claim, &cell.estimate);
        remarks.push(format!("deciding: {}, {value}", cell.name));
    } else if result.cells.is_some() {
        remarks.push(format!("deciding: {}", result.at));
    }
    for detail in &result.details {
        let number = detail.estimate.text("", rounded_text);
        remarks.push(format!("{}: {number}", detail.name));
    }
    if let Some(interval) = result.interval {
        remarks.push(format!("interval: {}", interval.words()));
    }
    remarks.extend(result.power.map(power_text));
    remarks
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking_statistics::{Interval, Range};

    #[test]
    fn values_carry_the_unit_of_their_limit() {
        let text = |unit, region, x, interval: Option<(f64, f64)>| {
            let estimate = interval.map_or(Estimate::exact(x), |(a, b)| {
                let interval = Interval::try_new(a, b).unwrap();
                Estimate::try_new(x, interval, Range::Real).unwrap()
            });
            text(&estimate, scale(unit, region))
        };
        let (share, one) = (Unit::Share, Unit::One);
        let ends = Some((0.95, 1.041));
        let same = Some(Region::Within(0.9, 1.1));
        assert_eq!(text(one, same, 1.0131, ends), "+1.3 % (-5 to +4.1)");
        assert_eq!(text(share, None, 0.272, None), "27.2 %");
        // A difference of shares is no share, a distance no percentage.
        let (points, distance) = (Unit::Points, Unit::Distance);
        let (above, wide) = (Some(Region::Above(0.1)), Some((-0.913, 0.406)));
        let found = text(points, above, -0.25, wide);
        assert_eq!(found, "-25 points (-91.3 to 40.6)");
        let above = Some(Region::Above(0.05));
        assert_eq!(text(distance, above, 0.0143, None), "0.0143");
        let below = Some(Region::Below(0.05));
        assert_eq!(text(one, below, 0.006_29, None), "0.63 %");
        let wide = Some(Region::Within(0.74, 1.35));
        assert_eq!(text(one, wide, 1.2087, None), "1.21");
        assert_eq!(text(one, same, f64::NAN, None), "no data");
        let open = Some((f64::NEG_INFINITY, f64::INFINITY));
        let open = text(one, same, 1.2, open);
        assert_eq!(open, "+20 % (-infinite to infinite)");
    }

    #[test]
    fn numbers_have_digits_that_matter_and_no_powers() {
        let all = [0.0, -1e-9, 0.0046, 7.3575, 27.204, 118.2, 1e-20];
        let texts = all.map(number);
        assert_eq!(texts, ["0", "0", "0", "7.4", "27.2", "118", "0"]);
        assert_eq!(number(f64::INFINITY), "infinite");
    }
}
