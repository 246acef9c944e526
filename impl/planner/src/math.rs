//! All calls of `libm`, and comparisons that compile to single instructions.
//!
//! The functions come from `libm`, and nothing is fused, so that a motion has the same samples on every platform.

/// The square root.
pub(crate) fn sqrt(value: f64) -> f64 {
    libm::sqrt(value)
}
/// The length of the hypotenuse of a right triangle.
pub(crate) fn hypotenuse(x: f64, y: f64) -> f64 {
    libm::sqrt(x * x + y * y)
}
/// The cube root.
pub(crate) fn cube_root(value: f64) -> f64 {
    libm::cbrt(value)
}
/// The angle of a right triangle between `adjacent` and the hypotenuse, radians.
pub(crate) fn arc_tangent(opposite: f64, adjacent: f64) -> f64 {
    libm::atan2(opposite, adjacent)
}
/// The lesser of two numbers, the first one if either is NaN; one instruction, unlike `f64::min`.
#[inline]
pub(crate) fn min(one: f64, other: f64) -> f64 {
    if other < one { other } else { one }
}
/// The greater of two numbers, the first one if either is NaN.
#[inline]
pub(crate) fn max(one: f64, other: f64) -> f64 {
    if other > one { other } else { one }
}
/// Sine and cosine of an angle in radians, to within 2^-52. Each cycle on an arc calls it, and it takes half the time
/// of `libm::sincos`: it omits the bits that matter for small sines alone, and one reduction to an eighth of a turn
/// serves both. The series are those of `libm`.
#[inline]
pub(crate) fn sin_cos(radians: f64) -> (f64, f64) {
    /// Up to this angle, the number of quarter turns times the first part of `QUARTER_TURN` is exact.
    const EXACT_RADIANS_MAX: f64 = 1e6;
    /// Adding this rounds to an integer, which is then in the last bits of the sum.
    const ROUNDING_TERM: f64 = 1.5 / f64::EPSILON;
    /// A quarter turn: 33 bits, and the rest.
    const QUARTER_TURN: [f64; 2] = [1.570_796_326_734_125_6, 6.077_100_506_506_192e-11];
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
    if radians.is_nan() || radians.abs() > EXACT_RADIANS_MAX {
        return libm::sincos(radians);
    }
    let sum = radians * core::f64::consts::FRAC_2_PI + ROUNDING_TERM;
    let (quarters, bits) = (sum - ROUNDING_TERM, sum.to_bits());
    let x = radians - quarters * QUARTER_TURN[0] - quarters * QUARTER_TURN[1];
    let z = x * x;
    let series = |[a, b, c, d, e, f]: [f64; 6]| a + z * (b + z * (c + z * (d + z * (e + z * f))));
    let sine = x + x * z * series(SINE);
    let cosine = 1.0 - (0.5 * z - z * z * series(COSINE));
    let (sine, cosine) = if bits & 1 == 0 { (sine, cosine) } else { (cosine, -sine) };
    if bits & 2 == 0 { (sine, cosine) } else { (-sine, -cosine) }
}

#[cfg(test)]
mod tests {
    use super::sin_cos;

    #[test]
    fn turned_is_what_libm_gives() {
        let angles = (-40_000..40_000).map(|step| f64::from(step) * 0.003_7);
        for angle in angles.chain([core::f64::consts::PI, 1e-300, 3e5, 1e12]) {
            let ((sine, cosine), (same, other)) = (sin_cos(angle), libm::sincos(angle));
            let apart = (sine - same).abs().max((cosine - other).abs());
            assert!(apart <= f64::EPSILON, "{angle} is {apart} apart");
        }
    }
}
