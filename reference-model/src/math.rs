//! Arithmetic that is equal on every platform: the `libm` crate, and no fused multiply-add.

/// Sine of an angle in degrees.
pub(crate) fn sine_of_degrees(degrees: f64) -> f64 {
    libm::sin(degrees.to_radians())
}

/// Cosine of an angle in degrees.
pub(crate) fn cosine_of_degrees(degrees: f64) -> f64 {
    libm::cos(degrees.to_radians())
}

/// Sine and cosine of an angle in degrees; along an axis they are whole, so that nothing of a long way is left beside it.
pub(crate) fn sine_and_cosine_of_degrees(degrees: f64) -> (f64, f64) {
    const AXES: [(f64, (f64, f64)); 5] = [
        (0.0, (0.0, 1.0)),
        (90.0, (1.0, 0.0)),
        (180.0, (0.0, -1.0)),
        (270.0, (-1.0, 0.0)),
        (360.0, (0.0, 1.0)),
    ];
    let turned = libm::fmod(degrees, 360.0);
    let turned = if turned < 0.0 { turned + 360.0 } else { turned };
    let along = AXES.iter().find(|(axis, _)| (turned - axis).abs() <= 0.0);
    along
        .map_or_else(|| (sine_of_degrees(degrees), cosine_of_degrees(degrees)), |(_, along)| *along)
}

/// Tangent of an angle in degrees.
pub(crate) fn tangent_of_degrees(degrees: f64) -> f64 {
    libm::tan(degrees.to_radians())
}

/// The angle in degrees, -90 to 90, with this sine; not a number outside of -1 to 1.
pub(crate) fn degrees_of_sine(sine: f64) -> f64 {
    libm::asin(sine).to_degrees()
}

/// The angle in degrees, 0 to 180, with this cosine; not a number outside of -1 to 1.
pub(crate) fn degrees_of_cosine(cosine: f64) -> f64 {
    libm::acos(cosine).to_degrees()
}

/// The angle in degrees, above -180 up to 180, of the direction with these components. A zero has no sign.
pub(crate) fn degrees_of(opposite: f64, adjacent: f64) -> f64 {
    degrees_of_signed(opposite + 0.0, adjacent + 0.0)
}

/// The same from -180, where a zero may have a sign: an opposite -0 is below zero, an adjacent one to the left of it.
pub(crate) fn degrees_of_signed(opposite: f64, adjacent: f64) -> f64 {
    libm::atan2(opposite, adjacent).to_degrees()
}

/// Sine of an angle in radians.
pub(crate) fn sine(radians: f64) -> f64 {
    libm::sin(radians)
}

/// Cosine of an angle in radians.
pub(crate) fn cosine(radians: f64) -> f64 {
    libm::cos(radians)
}

/// The square root of a number that is not negative.
pub(crate) fn square_root(number: f64) -> f64 {
    libm::sqrt(number)
}

/// The length of a line with these components.
pub(crate) fn hypotenuse(first: f64, second: f64) -> f64 {
    libm::hypot(first, second)
}

/// e raised to a power.
pub(crate) fn exponential(power: f64) -> f64 {
    libm::exp(power)
}

/// The logarithm to the base e; not finite for zero and below.
pub(crate) fn logarithm(number: f64) -> f64 {
    libm::log(number)
}

/// A number raised to a power; not a number or not finite where there is no real power.
pub(crate) fn power(base: f64, exponent: f64) -> f64 {
    libm::pow(base, exponent)
}

/// The integer that a value is taken for: one closer than 0.0001.
///
/// Rules numbers.near-integer and numbers.not-near-integer. Values beyond what an `i64` holds are at its end.
pub(crate) fn near_integer(value: f64) -> Option<i64> {
    let nearest = value.round();
    #[expect(
        clippy::cast_possible_truncation,
        reason = "an `as` conversion stops at the ends of the range"
    )]
    ((value - nearest).abs() <= 0.0001).then_some(nearest as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_lies_along_an_axis_is_whole() {
        for (degrees, along) in [(-90.0, (-1.0, 0.0)), (450.0, (1.0, 0.0)), (-180.0, (0.0, -1.0))] {
            assert_eq!(sine_and_cosine_of_degrees(degrees), along);
        }
        let (sine, cosine) = sine_and_cosine_of_degrees(-30.0);
        assert!((sine + 0.5).abs() < 1e-15 && (cosine - 0.75_f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn integers_are_taken_from_close_by() {
        assert_eq!(near_integer(2.000_05), Some(2));
        assert_eq!(near_integer(-1.999_95), Some(-2));
        assert_eq!(near_integer(2.001), None);
        assert_eq!(near_integer(f64::NAN), None);
        assert_eq!(near_integer(f64::INFINITY), None);
        assert_eq!(near_integer(1e300), Some(i64::MAX));
    }

    #[test]
    fn directions_go_half_a_turn_either_way() {
        let close = |angle: f64, wanted: f64| assert!((angle - wanted).abs() < 1e-12, "{angle}");
        close(degrees_of(1.0, 1.0), 45.0);
        close(degrees_of(-1.0, -1.0), -135.0);
        close(degrees_of(0.0, -2.0), 180.0);
        close(degrees_of(-0.0, -2.0), 180.0);
    }
}
