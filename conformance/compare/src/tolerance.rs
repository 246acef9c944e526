//! When two values count as equal. Version 0 of the table.
//!
//! | observable | tolerance |
//! | --- | --- |
//! | positions, settings, arguments of effects, pins | 1e-6 absolute, 1e-9 relative |
//! | numbers inside texts: messages, P and Q of a user-defined code | 2e-6 absolute: they have six decimals |
//! | what a post-processor prints | none: each character counts |
//!
//! The error that a controller declares is added, within the bounds of [`crate::accuracy`]; what it hides is masked.
//!
//! A case never carries a tolerance of its own.

use gaugeblock_vocabulary::{Axis, Channel, Effect, Position, Value};

use crate::accuracy::{Quantity, Resolution};

/// Version of the table.
pub const VERSION: u32 = 0;

const ABSOLUTE: f64 = 1e-6;
const RELATIVE: f64 = 1e-9;
const IN_MESSAGES: f64 = 2e-6;

/// Whether two numbers are equal for a controller of this resolution. A number that is not finite equals only itself,
/// whatever the resolution is.
pub fn numbers(a: f64, b: f64, quantity: Quantity, resolution: Resolution) -> bool {
    if a.is_finite() && b.is_finite() {
        let (absolute, relative) = resolution.error_of(quantity);
        (a - b).abs() <= ABSOLUTE + absolute + (RELATIVE + relative) * a.abs().max(b.abs())
    } else {
        a.to_bits() == b.to_bits() || a.is_nan() && b.is_nan()
    }
}

/// Whether two numbers are the same number; zero has no sign.
pub fn identical(a: f64, b: f64) -> bool {
    a.partial_cmp(&b) == Some(std::cmp::Ordering::Equal) || a.is_nan() && b.is_nan()
}

/// Whether two positions are equal, axis by axis.
pub fn positions(a: &Position, b: &Position, resolution: Resolution) -> bool {
    Axis::ALL
        .iter()
        .all(|axis| numbers(a.get(*axis), b.get(*axis), Quantity::of_axis(*axis), resolution))
}

/// Whether two values are equal, of a field or an argument of this name.
pub fn values(name: &str, a: &Value, b: &Value, resolution: Resolution) -> bool {
    match (a, b) {
        (Value::Number(a), Value::Number(b)) => numbers(*a, *b, Quantity::of(name), resolution),
        (Value::Position(a), Value::Position(b)) => positions(a, b, resolution),
        (Value::Text(a), Value::Text(b)) => texts(a, b),
        (Value::Word(a), Value::Word(b)) => a == b,
        _ => false,
    }
}

/// Whether two values of a field are equal. What a post-processor would print is read by a machine: there each
/// character counts.
pub fn fields(field: &str, a: &Value, b: &Value, resolution: Resolution) -> bool {
    if field == "variable" { a == b } else { values(field, a, b, resolution) }
}

/// Whether two effects are equal, argument by argument. In what a post-processor has printed each character counts.
pub fn effects(a: &Effect, b: &Effect, resolution: Resolution) -> bool {
    if let Effect::Message { channel: Channel::Output, .. } = a {
        return a == b;
    }
    let (left, right) = (a.arguments(), b.arguments());
    a.name() == b.name()
        && left.len() == right.len()
        && left
            .iter()
            .zip(&right)
            .all(|((name, a), (other, b))| name == other && values(name, a, b, resolution))
}

/// Whether two sequences are as long as each other and equal number by number.
pub fn sequences(a: &[f64], b: &[f64], resolution: Resolution) -> bool {
    let same = |(a, b): (&f64, &f64)| numbers(*a, *b, Quantity::Number, resolution);
    a.len() == b.len() && a.iter().zip(b).all(same)
}

/// Whether two texts are equal when the numbers in them are compared as numbers.
pub fn texts(a: &str, b: &str) -> bool {
    a == b || {
        let (a, b) = (parts(a), parts(b));
        a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| part(a, b))
    }
}

fn part(a: &str, b: &str) -> bool {
    let number = |text: &str| text.parse::<f64>().ok().filter(|number| number.is_finite());
    match (number(a), number(b)) {
        (Some(a), Some(b)) => (a - b).abs() <= IN_MESSAGES + RELATIVE * a.abs().max(b.abs()),
        _ => a == b,
    }
}

/// Splits a text into numbers and what is between them.
fn parts(text: &str) -> Vec<&str> {
    let of_number = |place: usize, c: char| {
        let next_is_digit =
            || text[place + c.len_utf8()..].starts_with(|c: char| c.is_ascii_digit() || c == '.');
        c.is_ascii_digit() || c == '.' || (c == '-' && next_is_digit())
    };
    let mut parts = Vec::new();
    let mut start = 0;
    let mut in_number = None;
    for (place, c) in text.char_indices() {
        let now = of_number(place, c);
        if in_number.is_some_and(|before| before != now) {
            parts.push(&text[start..place]);
            start = place;
        }
        in_number = Some(now);
    }
    parts.push(&text[start..]);
    parts
}

/// A value without the noise of the last bits.
pub fn rounded(value: &Value) -> String {
    let tidy = |number: f64| {
        let rounded = (number * 1e6).round() / 1e6;
        if rounded.is_finite() { rounded + 0.0 } else { number }
    };
    match value {
        Value::Number(number) => tidy(*number).to_string(),
        Value::Position(position) => Position::from(position.to_array().map(tidy)).to_string(),
        Value::Word(_) | Value::Text(_) => value.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use gaugeblock_vocabulary::LengthUnit;

    use super::*;

    const COARSE: Resolution = Resolution::new(f64::MAX, f64::MAX, LengthUnit::Millimetre);

    #[test]
    fn numbers_in_texts_are_compared_as_numbers() {
        assert!(texts("a=1.000000 b=-2", "a=1 b=-2.000001"));
        assert!(!texts("a=1.000000", "a=1.001"));
        assert!(!texts("a=1", "b=1"));
        assert!(!texts("a=1 ", "a=1"));
        assert!(texts("", ""));
    }

    #[test]
    fn number_that_is_not_finite_equals_only_itself() {
        let all = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 0.0, -1.0, 1e300, f64::MAX];
        for (place, a) in all.into_iter().enumerate() {
            for (other, b) in all.into_iter().enumerate() {
                for resolution in [Resolution::EXACT, COARSE] {
                    let finite = a.is_finite() && b.is_finite();
                    let is_equal = numbers(a, b, Quantity::Length, resolution);
                    assert!(finite || is_equal == (place == other), "{a} {b} {resolution:?}");
                }
            }
        }
        assert!(numbers(f64::NAN, -f64::NAN, Quantity::Length, Resolution::EXACT));
        assert!(numbers(-0.0, 0.0, Quantity::Count, Resolution::EXACT));
    }

    #[test]
    fn nan_differs_from_each_specified_value() {
        let nan = f64::NAN;
        let point = |x| Position { x, ..Position::default() };
        assert!(!positions(&point(nan), &point(0.0), COARSE));
        assert!(!values("feed_rate", &Value::Number(0.0), &Value::Number(nan), COARSE));
        assert!(!fields("feed_rate", &Value::Number(0.0), &Value::Number(nan), COARSE));
        let (dwell, never) = (Effect::Dwell { seconds: 0.0 }, Effect::Dwell { seconds: nan });
        assert!(!effects(&dwell, &never, COARSE));
        assert!(!sequences(&[0.0], &[nan], COARSE));
        assert!(!texts("a=0", "a=nan") && !texts("a=0", "a=inf"));
    }
}
