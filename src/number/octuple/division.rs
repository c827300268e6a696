//! Division of significands, limb by limb.

use super::{Guarded, LIMB, LIMBS, Octuple};

impl Octuple {
    /// Quotient of finite numbers that are not zero.
    pub(super) fn over(self, other: Self) -> Self {
        // Half the dividend is below the divisor, whose leading bit is set.
        let [next, mut rest @ ..] = self.moved_down(1);
        let mut bits: Guarded = [0; LIMBS + 1];
        let mut next = next;
        for digit in bits.iter_mut().rev() {
            *digit = digit_of(&mut rest, next, &other.limbs);
            next = 0;
        }
        bits[0] |= u64::from(rest != [0; LIMBS]);
        // The first bit of the digits is a half of the quotient of the halved
        // dividend.
        let exponent = i64::from(self.exponent) - i64::from(other.exponent);
        Self::nearest(self.negative != other.negative, exponent, bits)
    }
}

/// Next digit of a quotient: the integer part of the remainder, followed by
/// the next limb of the dividend, over the divisor. Leaves the new remainder
/// in `rest`.
///
/// By the two leading limbs over the divisor's leading one the digit is too
/// large by two at most (Knuth, The Art of Computer Programming 2, 4.3.1).
fn digit_of(
    rest: &mut [u64; LIMBS],
    next: u64,
    divisor: &[u64; LIMBS],
) -> u64 {
    let [a, b, c, top] = *rest;
    let leading = u128::from(top) << LIMB | u128::from(c);
    let guess = leading / u128::from(divisor[LIMBS - 1]);
    let mut digit = u64::try_from(guess).unwrap_or(u64::MAX);
    let mut left = [next, a, b, c];
    let (mut carry, mut borrow) = (0, false);
    for (limb, d) in left.iter_mut().zip(divisor) {
        let part;
        (part, carry) = digit.carrying_mul(*d, carry);
        (*limb, borrow) = limb.borrowing_sub(part, borrow);
    }
    let (mut over, mut below) = top.borrowing_sub(carry, borrow);
    while below {
        digit -= 1;
        let mut carry = false;
        for (limb, d) in left.iter_mut().zip(divisor) {
            (*limb, carry) = limb.carrying_add(*d, carry);
        }
        (over, carry) = over.overflowing_add(u64::from(carry));
        below = !carry;
    }
    debug_assert_eq!(over, 0);
    *rest = left;
    digit
}
