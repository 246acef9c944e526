//! Products and lengths of vectors.

use crate::math;
use crate::parameters::Axes;

/// The length of a vector of so many leading axes, at least three.
#[inline]
pub(crate) fn norm_of(vector: &Axes, axes: usize) -> f64 {
    let [x, y, z, ..] = *vector;
    if axes <= 3 { math::sqrt(x * x + y * y + z * z) } else { norm(vector) }
}

pub(crate) fn norm(vector: &Axes) -> f64 {
    let mut sum = 0.0;
    for value in vector {
        sum += value * value;
    }
    math::sqrt(sum)
}

pub(crate) fn dot(left: &[f64; 3], right: &[f64; 3]) -> f64 {
    let [x, y, z] = *left;
    let [u, v, w] = *right;
    x * u + y * v + z * w
}

pub(crate) fn cross(left: &[f64; 3], right: &[f64; 3]) -> [f64; 3] {
    let [x, y, z] = *left;
    let [u, v, w] = *right;
    [y * w - z * v, z * u - x * w, x * v - y * u]
}
