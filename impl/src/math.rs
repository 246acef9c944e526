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
#[expect(clippy::as_conversions, reason = "there is no other conversion")]
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
/// Degrees.
pub(crate) fn arccosine(value: f64) -> f64 {
    libm::acos(value).to_degrees()
}
/// Degrees, above -180 up to 180.
pub(crate) fn arctangent(y: f64, x: f64) -> f64 {
    libm::atan2(y, x).to_degrees()
}
/// The lesser of two numbers, the first where one is none; an instruction, which `f64::min` is not.
#[inline]
pub(crate) fn lesser(one: f64, other: f64) -> f64 {
    if other < one { other } else { one }
}
/// The greater of two numbers, the first where one is none.
#[inline]
pub(crate) fn greater(one: f64, other: f64) -> f64 {
    if other > one { other } else { one }
}
/// Sine and cosine of an angle in radians, to within 2^-52. It is asked for in each cycle on an arc, and takes half
/// of what `libm::sincos` does: without the bits that only a small sine would show, one reduction to an eighth of a
/// turn serves both. The series are those of `libm`.
#[inline]
pub(crate) fn turned(radians: f64) -> (f64, f64) {
    /// Within it, a number of quarters times the first part of one is exact.
    const MOST: f64 = 1e6;
    /// Added, rounds to an integer, which the last bits of the sum then are.
    const ROUNDS: f64 = 1.5 / f64::EPSILON;
    /// A quarter of a turn: 33 bits, and the rest.
    const QUARTER: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];
    const SINE: [f64; 6] = [
        -1.666_666_666_666_663_2e-1,
        8.333_333_333_322_49e-3,
        -1.984_126_982_985_795e-4,
        2.755_731_370_707_006_8e-6,
        -2.505_076_025_340_686_3e-8,
        1.589_690_995_211_55e-10,
    ];
    const COSINE: [f64; 6] = [
        4.166_666_666_666_66e-2,
        -1.388_888_888_887_411e-3,
        2.480_158_728_947_673e-5,
        -2.755_731_435_139_066_3e-7,
        2.087_572_321_298_175e-9,
        -1.135_964_755_778_819_5e-11,
    ];
    if radians.is_nan() || radians.abs() > MOST {
        return libm::sincos(radians);
    }
    let sum = radians * core::f64::consts::FRAC_2_PI + ROUNDS;
    let (quarters, bits) = (sum - ROUNDS, sum.to_bits());
    let x = radians - quarters * QUARTER[0] - quarters * QUARTER[1];
    let z = x * x;
    let series = |[a, b, c, d, e, f]: [f64; 6]| a + z * (b + z * (c + z * (d + z * (e + z * f))));
    let sine = x + x * z * series(SINE);
    let cosine = 1.0 - (0.5 * z - z * z * series(COSINE));
    let (sine, cosine) = if bits & 1 == 0 { (sine, cosine) } else { (cosine, -sine) };
    if bits & 2 == 0 { (sine, cosine) } else { (-sine, -cosine) }
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
/// Without the digits behind the point.
pub(crate) fn truncate(value: f64) -> f64 {
    libm::trunc(value)
}
/// An integer within ±2^53 as a number, exactly.
#[expect(clippy::as_conversions, reason = "there is no other conversion")]
#[expect(clippy::cast_precision_loss, reason = "callers keep below 2^53")]
pub(crate) fn from_i64(value: i64) -> f64 {
    value as f64
}

#[cfg(test)]
mod tests {
    use super::turned;

    #[test]
    fn turned_is_what_libm_gives() {
        let angles = (-40_000..40_000).map(|step| f64::from(step) * 0.003_7);
        for angle in angles.chain([core::f64::consts::PI, 1e-300, 3e5, 1e12]) {
            let ((sine, cosine), (same, other)) = (turned(angle), libm::sincos(angle));
            let apart = (sine - same).abs().max((cosine - other).abs());
            assert!(apart <= f64::EPSILON, "{angle} is {apart} apart");
        }
    }
}
