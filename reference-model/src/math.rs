//! Arithmetic that is equal on every platform: the `libm` crate, and no fused multiply-add.

/// Sine of an angle in degrees.
pub(crate) fn sine_of_degrees(degrees: f64) -> f64 {
    sine(degrees.to_radians())
}

/// Cosine of an angle in degrees.
pub(crate) fn cosine_of_degrees(degrees: f64) -> f64 {
    cosine(degrees.to_radians())
}

/// Sine and cosine of an angle in degrees; along an axis they are whole, so that nothing of a long way is left beside
/// it.
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
    tangent(degrees.to_radians())
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

/// A full turn, radians.
pub(crate) const TURN: f64 = std::f64::consts::TAU;

/// The angle in radians, above -pi up to pi, of the direction with these components. A zero has no sign.
pub(crate) fn angle(opposite: f64, adjacent: f64) -> f64 {
    libm::atan2(opposite + 0.0, adjacent + 0.0)
}

/// Sine of an angle in radians.
pub(crate) fn sine(radians: f64) -> f64 {
    libm::sin(radians)
}

/// Cosine of an angle in radians.
pub(crate) fn cosine(radians: f64) -> f64 {
    libm::cos(radians)
}

/// Tangent of an angle in radians.
pub(crate) fn tangent(radians: f64) -> f64 {
    libm::tan(radians)
}

/// The square root of a number that is not negative.
pub(crate) fn square_root(number: f64) -> f64 {
    libm::sqrt(number)
}

/// The length of a line with these components.
pub(crate) fn hypotenuse(first: f64, second: f64) -> f64 {
    libm::hypot(first, second)
}

/// The other leg of a right triangle with this hypotenuse and this leg; none is left where the leg is as long as the
/// hypotenuse.
///
/// It is worked out at the size of 1, which changes no bit, so that no square of a finite number is too great.
pub(crate) fn other_leg(hypotenuse: f64, leg: f64) -> f64 {
    let (_, size) = libm::frexp(hypotenuse);
    let (hypotenuse, leg) = (libm::ldexp(hypotenuse, -size), libm::ldexp(leg, -size));
    let square = (hypotenuse - leg) * (hypotenuse + leg);
    libm::ldexp(libm::sqrt(square.max(0.0)), size)
}

/// As much of a whole as a part is of something that is no shorter: no more than the whole on the way there either.
pub(crate) fn portion(whole: f64, part: f64, of: f64) -> f64 {
    let (_, size) = libm::frexp(of);
    whole / libm::ldexp(of, 1 - size) * libm::ldexp(part, 1 - size)
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
    fn a_leg_is_found_at_any_size() {
        for size in [1.0, 1e-300, 1e300, f64::MAX / 5.0, f64::from_bits(1)] {
            let found = other_leg(5.0 * size, 3.0 * size);
            assert!((found / size - 4.0).abs() < 1e-14, "{found} at {size}");
            assert_eq!(other_leg(size, size).to_bits(), 0);
        }
        assert_eq!(other_leg(0.0, 0.0).to_bits(), 0);
        assert_eq!(other_leg(1.0, 2.0).to_bits(), 0);
        let nearly_the_hypotenuse = other_leg(100_000.0 + 1e-7, 100_000.0);
        assert!((nearly_the_hypotenuse - 0.02_f64.sqrt()).abs() < 1e-5);
    }

    #[test]
    fn a_portion_is_found_at_any_size() {
        for (whole, of) in [(5.0, 4.0), (1e200, 1e-200), (f64::MAX, 1e300), (f64::MAX, 1e-310)] {
            let found = portion(whole, of / -2.0, of);
            assert!((found / whole + 0.5).abs() < 1e-12, "{found} of {whole}");
        }
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
