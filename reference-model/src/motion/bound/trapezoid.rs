//! The least time along a straight way with one limit of speed and one of acceleration.

use crate::math::square_root;

/// The least time between two points of a way, from the square of a speed to that of another one, with a limit of
/// acceleration and one of the square of the speed.
///
/// What the two speeds need more of the way than there is, is not looked for: they are bounds themselves.
pub(super) fn least_time(squares: (f64, f64), way: f64, acceleration: f64, highest: f64) -> f64 {
    let peak = ((squares.0 + squares.1) / 2.0 + acceleration * way).min(highest);
    let (first, last, top) = (square_root(squares.0), square_root(squares.1), square_root(peak));
    if top == 0.0 {
        return f64::INFINITY;
    }
    if !acceleration.is_finite() {
        return if top.is_finite() { way / top } else { 0.0 };
    }
    let gain = |speed: f64| (peak - speed).max(0.0) / (2.0 * acceleration);
    let even = (way - gain(squares.0) - gain(squares.1)).max(0.0);
    let sloped = |speed: f64| (top - speed).max(0.0) / acceleration;
    let steady = if top.is_finite() { even / top } else { 0.0 };
    sloped(first) + sloped(last) + steady
}

/// The least time from rest to rest.
pub(super) fn rest_to_rest(way: f64, speed: f64, acceleration: f64) -> f64 {
    if way == 0.0 {
        return 0.0;
    }
    least_time((0.0, 0.0), way, acceleration, speed * speed)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_speeds_up_goes_on_and_brakes() {
        assert!((rest_to_rest(100.0, 100.0, 2000.0) - 1.05).abs() < 1e-12);
        assert!((rest_to_rest(0.5, 100.0, 2000.0) - 2.0 * (0.5_f64 / 2000.0).sqrt()).abs() < 1e-12);
        assert!(rest_to_rest(0.0, 100.0, 2000.0) == 0.0);
        assert!((rest_to_rest(10.0, 100.0, f64::INFINITY) - 0.1).abs() < 1e-12);
    }
}
