//! Nine coordinates as a vector: X Y Z A B C U V W, millimetres and degrees.
//!
//! Where a distance counts all nine, a degree counts like a millimetre: the documents give path tolerances in length
//! units and say nothing of rotary axes.

use crate::math;

/// Nine coordinates or their rates.
pub(super) type AxisVector = [f64; 9];

/// Axis by axis.
pub(super) fn each(a: &AxisVector, b: &AxisVector, value: impl Fn(f64, f64) -> f64) -> AxisVector {
    std::array::from_fn(|place| value(a[place], b[place]))
}

/// `a - b`.
pub(super) fn minus(a: &AxisVector, b: &AxisVector) -> AxisVector {
    each(a, b, |a, b| a - b)
}

/// `a + b * factor`.
pub(super) fn plus(a: &AxisVector, b: &AxisVector, factor: f64) -> AxisVector {
    each(a, b, |a, b| a + b * factor)
}

/// The inner product.
pub(super) fn dot(a: &AxisVector, b: &AxisVector) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The length.
pub(super) fn length(a: &AxisVector) -> f64 {
    math::square_root(dot(a, a))
}

/// The distance of two points.
pub(super) fn distance(a: &AxisVector, b: &AxisVector) -> f64 {
    length(&minus(a, b))
}

/// The direction, a unit vector; `None` without a length.
pub(super) fn direction(a: &AxisVector) -> Option<AxisVector> {
    let length = length(a);
    (length > 0.0).then(|| a.map(|value| value / length))
}

/// Which part of a straight line from `a` to `b`, 0 to 1, is nearest to a point.
pub(super) fn nearest_part(a: &AxisVector, b: &AxisVector, point: &AxisVector) -> f64 {
    let along = minus(b, a);
    let square = dot(&along, &along);
    if square == 0.0 {
        return 0.0;
    }
    (dot(&minus(point, a), &along) / square).clamp(0.0, 1.0)
}

/// The distance of a point from the straight line between two others.
pub(super) fn from_segment(a: &AxisVector, b: &AxisVector, point: &AxisVector) -> f64 {
    let nearest = plus(a, &minus(b, a), nearest_part(a, b, point));
    distance(&nearest, point)
}

/// The distance to the next number that can be written, at the largest coordinate of a point.
pub(super) fn last_place(value: f64) -> f64 {
    let size = value.abs().max(f64::MIN_POSITIVE);
    size.next_up() - size
}

/// A number of cycles or elements as a number to calculate with.
pub(super) fn count(number: usize) -> f64 {
    f64::from(u32::try_from(number).unwrap_or(u32::MAX))
}
