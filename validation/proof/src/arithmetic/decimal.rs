use rocking::number::Number as _;
use rocking::number::double::DoubleDouble;

/// The first word of a text as a decimal number, to the last bit or two of a
/// double-double; none where it is no number.
///
/// ```
/// use rocking::number::double::DoubleDouble;
/// use rocking_proof::arithmetic::decimal;
/// let tenth = decimal("1.0e-1").unwrap();
/// assert_eq!((tenth.hi(), tenth.lo()), (0.1, -5.551115123125783e-18));
/// assert!(decimal("-1.5e3x").is_none());
/// ```
pub fn decimal(text: &str) -> Option<DoubleDouble> {
    let word = text.split_whitespace().next()?;
    let (mantissa, exponent) = word.split_once('e').unwrap_or((word, "0"));
    let mut exponent: i32 = exponent.parse().ok()?;
    let digits = mantissa.strip_prefix('-').unwrap_or(mantissa);
    let ten = DoubleDouble::from_f64(10.0);
    let mut value = DoubleDouble::zero();
    let mut fraction = false;
    for digit in digits.chars() {
        if digit == '.' && !fraction {
            fraction = true;
            continue;
        }
        let digit = f64::from(digit.to_digit(10)?);
        value = value * ten + DoubleDouble::from_f64(digit);
        exponent -= i32::from(fraction);
    }
    for _ in 0..exponent.abs() {
        value = if exponent < 0 { value / ten } else { value * ten };
    }
    Some(if mantissa.starts_with('-') { -value } else { value })
}
