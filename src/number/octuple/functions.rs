//! Elementary functions: series after reduction, and Newton's iteration from
//! the value in double precision.

use super::{LIMBS, Octuple, SPECIAL};
use crate::number::{Number, Real, SeriesWork, series};

/// pi/2 in two parts, the first with 192 bits, so that its product with a
/// whole number of one limb is exact.
const RIGHT_ANGLE: [Octuple; 2] = [
    part(0, [0, 0x29024e088a67cc74, 0xc4c6628b80dc1cd1, 0xc90fdaa22168c234]),
    part(
        -198,
        [
            0x0ac29b7c97c50dd4,
            0xe5466cf34e90c6cc,
            0x52821e638d01377b,
            0x82efa98ec4e6c894,
        ],
    ),
];

/// ln 2 alike.
const LN_2: [Octuple; 2] = [
    part(-1, [0, 0x40f343267298b62d, 0xc9e3b39803f2f6af, 0xb17217f7d1cf79ab]),
    part(
        -193,
        [
            0xed2eae35c1382144,
            0x559552fb4afa1b10,
            0xe7b876206debac98,
            0x8a0d175b8baafa2b,
        ],
    ),
];

/// Terms of the series on [-pi/4, pi/4] and [-ln 2/2, ln 2/2]: the next is
/// below 2^-264 of the sum.
pub(super) const TERMS: i32 = 56;

/// Exponent below which a function equals its argument: the next term is
/// smaller by at least a factor of the argument.
const TINY: i32 = -264;

/// Whole numbers up to here count turns and powers of two.
const COUNTED: f64 = 1e9;

const fn part(exponent: i32, limbs: [u64; LIMBS]) -> Octuple {
    Octuple { negative: false, exponent, limbs }
}

/// Remainder after subtracting `count` times a constant in two parts.
fn less(x: Octuple, count: f64, parts: [Octuple; 2]) -> Octuple {
    let count = Octuple::from_f64(count);
    parts.iter().fold(x, |rest, part| rest - count * *part)
}

impl Octuple {
    /// Significand and power of two, exactly: this is the first, in [1, 4),
    /// times 4 to the second.
    fn split(self) -> (Self, i32) {
        let power = self.exponent.div_euclid(2);
        (Self { exponent: self.exponent.rem_euclid(2), ..self }, power)
    }

    /// Square root by Newton's iteration.
    pub(super) fn root(self) -> Self {
        if self.is_zero() || self.negative || !self.is_finite() {
            return if self.negative { Self::NAN } else { self };
        }
        let (square, power) = self.split();
        let mut root = Self::from_f64(square.to_f64().sqrt());
        // 53, 106, 212 and all bits.
        for _ in 0..3 {
            root = (root + square / root).scaled(-1);
        }
        root.scaled(power)
    }
}

impl Real for Octuple {
    /// 2^-256.
    const ROUNDOFF: f64 = f64::from_bits((1023 - 256) << 52);
    const NEWTON_STEP: f64 = 1e-45;

    fn to_f64(self) -> f64 {
        let sign = if self.negative { -1.0 } else { 1.0 };
        let Self { exponent, limbs: [.., leading], .. } = self;
        if self.is_nan() {
            return f64::NAN;
        }
        if self.is_zero() || exponent < -1075 {
            return sign * 0.0;
        }
        if exponent > 1023 {
            return sign * f64::INFINITY;
        }
        // Bits that a double of this size has.
        let bits = if exponent < -1022 { exponent + 1075 } else { 53 };
        let below = self.limbs[..LIMBS - 1].iter().any(|limb| *limb != 0);
        let wide = u128::from(leading | u64::from(below)) << bits;
        let (kept, rest) = ((wide >> 64) as u64, wide as u64);
        let half = 1 << 63;
        let up = rest > half || (rest == half && kept & 1 == 1);
        let kept = kept + u64::from(up);
        sign * libm::scalbn(kept as f64, exponent + 1 - bits)
    }

    fn sin_cos(self) -> (Self, Self) {
        let x = self.to_f64();
        if !(x.abs() < COUNTED) {
            return (Self::NAN, Self::NAN);
        }
        let turns = (x / std::f64::consts::FRAC_PI_2).round();
        let rest = less(self, turns, RIGHT_ANGLE);
        series::turned(rest.sin_cos_small(), turns)
    }

    fn exp(self) -> Self {
        let x = self.to_f64();
        if self.is_nan() {
            return self;
        }
        if !(x.abs() < COUNTED) {
            return if x < 0.0 { Self::ZERO } else { Self::infinite(false) };
        }
        let count = (x / std::f64::consts::LN_2).round();
        let rest = less(self, count, LN_2);
        (Self::one() + series::exp_m1(rest, TERMS)).scaled(count as i32)
    }

    /// Newton's iteration on exp(y) = 1 + x from a double, to second order.
    fn ln_1p(self) -> Self {
        let whole = Self::one() + self;
        if !(whole > Self::ZERO) {
            let pole = whole.is_zero();
            return if pole { Self::infinite(true) } else { Self::NAN };
        }
        if whole.exponent == SPECIAL || self.exponent < TINY {
            return self;
        }
        let near = self.to_f64().abs() < 0.4;
        let mut y = Self::from_f64(if near {
            libm::log1p(self.to_f64())
        } else {
            let (leading, power) = whole.split();
            let powers = 2.0 * f64::from(power) * std::f64::consts::LN_2;
            libm::log(leading.to_f64()) + powers
        });
        // 53 bits, three times as many, and all.
        for _ in 0..2 {
            let step = if near {
                let value = series::exp_m1(y, TERMS);
                (self - value) / (Self::one() + value)
            } else {
                let value = y.exp();
                (whole - value) / value
            };
            y = y + step - (step * step).scaled(-1);
        }
        y
    }

    fn asin(self) -> Self {
        // 53 bits, or half of them if x is near 1, then all.
        if self.exponent < TINY / 2 { self } else { series::asin(self, 2) }
    }

    fn right_angle() -> Self {
        RIGHT_ANGLE[0] + RIGHT_ANGLE[1]
    }

    fn with_lengths<W: SeriesWork>(work: W) -> W::Output {
        work.run::<48, 48>()
    }
}
