//! The only place where numbers are rounded to integers and transcendental functions are called.
//!
//! The functions come from `libm`, so that a program gives the same numbers on every platform; nothing is fused.

/// Two numbers this close are equal, and a number this close to an integer is one (11.4.2.4, 11.4.7).
pub(crate) const CLOSE: f64 = 0.0001;

/// The integer that a number is close to, within ±2^53.
#[inline]
#[expect(clippy::as_conversions, reason = "the range is checked, so that nothing is lost")]
#[expect(clippy::cast_possible_truncation, reason = "the range is checked")]
#[expect(clippy::cast_precision_loss, reason = "below 2^53 nothing is lost")]
pub(crate) fn near_integer(value: f64) -> Option<i64> {
    if !(-9.0e15..=9.0e15).contains(&value) {
        return None;
    }
    let exact = value as i64;
    if (exact as f64 - value).to_bits() << 1 == 0 {
        return Some(exact);
    }
    let nearest = libm::rint(value);
    ((nearest - value).abs() <= CLOSE).then_some(nearest as i64)
}

/// An integer below 2^53 as a number, exactly.
#[inline]
#[expect(clippy::as_conversions, reason = "the standard library converts them only by `as`")]
#[expect(clippy::cast_precision_loss, reason = "callers keep below 2^53")]
#[expect(clippy::cast_possible_wrap, reason = "and so below 2^63, which converts faster")]
pub(crate) fn from_u64(value: u64) -> f64 {
    value as i64 as f64
}

/// A number of turns from a number that is not below 0; the largest count where it is larger.
#[expect(clippy::as_conversions, reason = "saturates")]
#[expect(clippy::cast_possible_truncation, reason = "saturates")]
#[expect(clippy::cast_sign_loss, reason = "saturates at zero")]
pub(crate) fn to_count(value: f64) -> u64 {
    value as u64
}

pub(crate) fn floor(value: f64) -> f64 {
    libm::floor(value)
}
pub(crate) fn ceil(value: f64) -> f64 {
    libm::ceil(value)
}
/// To the nearest integer, from halfway away from zero.
pub(crate) fn round_away(value: f64) -> f64 {
    libm::round(value)
}
/// To the nearest integer, from halfway to the even one.
pub(crate) fn round_even(value: f64) -> f64 {
    libm::rint(value)
}
pub(crate) fn sqrt(value: f64) -> f64 {
    libm::sqrt(value)
}
pub(crate) fn exp(value: f64) -> f64 {
    libm::exp(value)
}
pub(crate) fn ln(value: f64) -> f64 {
    libm::log(value)
}
pub(crate) fn power(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}
/// The remainder with the sign of the number on the left.
pub(crate) fn remainder(left: f64, right: f64) -> f64 {
    libm::fmod(left, right)
}
/// The length of the third side.
pub(crate) fn hypotenuse(x: f64, y: f64) -> f64 {
    libm::sqrt(x * x + y * y)
}
/// The length of the third side, also where the squares of the others are too large or too small.
pub(crate) fn hypotenuse_of_any_size(x: f64, y: f64) -> f64 {
    libm::hypot(x, y)
}
/// The other short side of a triangle with a right angle, of any size.
pub(crate) fn other_leg(hypotenuse: f64, leg: f64) -> f64 {
    let (less, more) = (hypotenuse - leg, hypotenuse + leg);
    let square = less * more;
    if square.is_normal() { libm::sqrt(square) } else { libm::sqrt(less) * libm::sqrt(more) }
}
/// Sine and cosine of an angle in degrees, exact for right angles.
pub(crate) fn direction(degrees: f64) -> (f64, f64) {
    let within = libm::fmod(degrees, 360.0);
    let quarters = within / 90.0;
    if (quarters - libm::rint(quarters)).abs() > 0.0 || !quarters.is_finite() {
        return (sine(degrees), cosine(degrees));
    }
    match near_integer(quarters) {
        Some(1 | -3) => (1.0, 0.0),
        Some(2 | -2) => (0.0, -1.0),
        Some(3 | -1) => (-1.0, 0.0),
        _ => (0.0, 1.0),
    }
}
/// Sine of an angle in degrees.
pub(crate) fn sine(degrees: f64) -> f64 {
    sine_of_radians(degrees.to_radians())
}
/// Sine of an angle in radians.
pub(crate) fn sine_of_radians(radians: f64) -> f64 {
    libm::sin(radians)
}
/// Cosine of an angle in degrees.
pub(crate) fn cosine(degrees: f64) -> f64 {
    cosine_of_radians(degrees.to_radians())
}
/// Cosine of an angle in radians.
pub(crate) fn cosine_of_radians(radians: f64) -> f64 {
    libm::cos(radians)
}
/// Tangent of an angle in degrees.
pub(crate) fn tangent(degrees: f64) -> f64 {
    tangent_of_radians(degrees.to_radians())
}
/// Tangent of an angle in radians.
pub(crate) fn tangent_of_radians(radians: f64) -> f64 {
    libm::tan(radians)
}
/// Degrees.
pub(crate) fn arcsine(value: f64) -> f64 {
    libm::asin(value).to_degrees()
}
/// Radians.
pub(crate) fn arcsine_in_radians(value: f64) -> f64 {
    libm::asin(value)
}
/// Degrees.
pub(crate) fn arccosine(value: f64) -> f64 {
    libm::acos(value).to_degrees()
}
/// Degrees, above -180 up to 180.
pub(crate) fn arctangent(y: f64, x: f64) -> f64 {
    libm::atan2(y, x).to_degrees()
}
/// The angle of a direction: radians, above -pi up to pi.
pub(crate) fn angle(y: f64, x: f64) -> f64 {
    libm::atan2(y, x)
}
/// The integer that a number is, within ±2^53.
#[inline]
#[expect(clippy::as_conversions, reason = "the range is checked, so that nothing is lost")]
#[expect(clippy::cast_possible_truncation, reason = "the range is checked")]
#[expect(clippy::cast_precision_loss, reason = "below 2^53 nothing is lost")]
pub(crate) fn whole(value: f64) -> Option<i64> {
    if !(-9.0e15..=9.0e15).contains(&value) {
        return None;
    }
    let exact = value as i64;
    ((exact as f64 - value).to_bits() << 1 == 0).then_some(exact)
}
/// Without the digits after the point.
pub(crate) fn truncate(value: f64) -> f64 {
    libm::trunc(value)
}
/// An integer within ±2^53 as a number, exactly.
#[expect(clippy::as_conversions, reason = "the standard library converts them only by `as`")]
#[expect(clippy::cast_precision_loss, reason = "callers keep below 2^53")]
pub(crate) fn from_i64(value: i64) -> f64 {
    value as f64
}

/// An integer as a number, exactly; none beyond 2^53.
#[expect(clippy::as_conversions, reason = "From does not convert i64 to f64")]
#[expect(clippy::cast_precision_loss, reason = "integers below 2^53 are exact")]
pub(crate) fn whole_as_number(value: i64) -> Option<f64> {
    (value.unsigned_abs() <= 1 << 53).then_some(value as f64)
}

/// By how many radians so many quarter turns, computed as degrees times pi over 180 in numbers of 64 bits, exceed the
/// exact angle. There are at most 4096 of them.
#[expect(clippy::as_conversions, reason = "a small difference needs no exact last bits")]
#[expect(clippy::cast_precision_loss, reason = "a small difference needs no exact last bits")]
pub(crate) fn rounding_of_quarter_turns(turns: u128) -> f64 {
    /// Pi in 64 bits: two before the binary point, 62 after it.
    const PI: u128 = 0xC90F_DAA2_2168_C235;
    /// Half of pi with 109 bits after the point.
    const HALF_PI: i128 = 0x3243_F6A8_885A_308D_3131_98A2_E037;
    let (product, shift) = rounded_to_64_bits(PI.wrapping_mul(turns).wrapping_mul(90), false);
    let scaled = product << 64;
    let inexact = scaled.checked_rem(180) != Some(0);
    let (quotient, more) = rounded_to_64_bits(scaled.checked_div(180).unwrap_or(0), inexact);
    // The quotient has 62 + 64 bits after the point, less those that were rounded away.
    let angle = quotient << shift.wrapping_add(more).wrapping_add(109).wrapping_sub(126);
    let exact = HALF_PI.wrapping_mul(turns.cast_signed());
    angle.cast_signed().wrapping_sub(exact) as f64 * libm::exp2(-109.0)
}

/// A number rounded to its first 64 bits, to the even one from halfway, and how many bits were rounded away.
fn rounded_to_64_bits(value: u128, more_follows: bool) -> (u128, u32) {
    let bits = 128_u32.wrapping_sub(value.leading_zeros());
    let shift = bits.saturating_sub(64);
    if shift == 0 {
        return (value, 0);
    }
    let kept = value >> shift;
    let rest = value & (1_u128 << shift).wrapping_sub(1);
    let half = 1_u128 << shift.wrapping_sub(1);
    let up = rest > half || rest == half && (more_follows || kept & 1 == 1);
    (if up { kept.wrapping_add(1) } else { kept }, shift)
}
