//! Lower bounds for a path that may be rounded.
//!
//! A motion that keeps the laws passes gates in order: each programmed corner within its tolerance, at the ends
//! exactly and at rest. What every such motion needs at least is bounded in two ways that forget most of the problem.

use super::trapezoid::rest_to_rest;
use crate::motion::vector::{AxisVector, direction, distance, dot, minus};

/// A point that is passed within a distance.
#[derive(Clone, Copy, Debug)]
pub(super) struct Gate {
    pub(super) at: AxisVector,
    pub(super) tolerance: f64,
}

/// Each axis alone, forgetting the others: it visits the intervals of its gates in order.
///
/// Let the axis need to be at M or above at some time, and then at m < M or below, and so on. Where it is highest
/// between the time before and the time after, it is at M or above and rests, and these moments come in order. So
/// from each turn to the next it goes from rest to rest over M - m at least, and the times add up. The sequence of
/// turns that is found here is what one axis needs: the sum is the least time of the relaxed problem, not only a
/// bound of it.
pub(super) fn axis(gates: &[Gate], axis: usize, speed: f64, acceleration: f64) -> f64 {
    let Some(first) = gates.first() else { return 0.0 };
    // The last turn, and how far the axis needs to go from there, up or down.
    let (mut turn, mut reach) = (first.at[axis], first.at[axis]);
    let mut seconds = 0.0;
    for gate in &gates[1..] {
        let (low, high) = (gate.at[axis] - gate.tolerance, gate.at[axis] + gate.tolerance);
        let upwards = reach > turn || reach >= turn && low > reach;
        if upwards && high >= reach {
            reach = reach.max(low);
        } else if !upwards && low <= reach {
            reach = reach.min(high);
        } else {
            seconds += rest_to_rest((reach - turn).abs(), speed, acceleration);
            turn = reach;
            reach = if upwards { high } else { low };
        }
    }
    seconds + rest_to_rest((reach - turn).abs(), speed, acceleration)
}

/// The time that the shortest way through the gates takes at least, in coordinates `counted`, where `fastest` holds
/// the speed that is not exceeded on the way to each gate; on the way to the first it means nothing.
///
/// Between two gates the motion makes no more than their fastest speed Fᵢ. So for any vectors uᵢ no longer than 1/Fᵢ
/// a motion through points xᵢ within Pᵢ of vᵢ takes Σ uᵢ·(xᵢ₊₁ - xᵢ) at least, which is Σ uᵢ·(vᵢ₊₁ - vᵢ) - Σ Pᵢ|uᵢ₋₁
/// - uᵢ| or more. The vectors have directions of the path, taken over more and more of it; the best of them counts.
pub(super) fn shortest(gates: &[Gate], fastest: &[f64], counted: std::ops::Range<usize>) -> f64 {
    let only = |vector: AxisVector| -> AxisVector {
        std::array::from_fn(|axis| if counted.contains(&axis) { vector[axis] } else { 0.0 })
    };
    let point = |place: usize| only(gates[place].at);
    let mut best = 0.0_f64;
    let mut reach = 0;
    while reach < gates.len() {
        let slowness = |place: usize| {
            let from = place.saturating_sub(reach);
            let to = (place + 1 + reach).min(gates.len() - 1);
            let toward = direction(&minus(&point(to), &point(from))).unwrap_or([0.0; 9]);
            toward.map(|part| part / fastest[place + 1])
        };
        let mut seconds = 0.0;
        let mut before: Option<AxisVector> = None;
        for (place, gate) in gates[..gates.len() - 1].iter().enumerate() {
            let vector = slowness(place);
            seconds += dot(&vector, &minus(&point(place + 1), &point(place)));
            if let Some(before) = before {
                seconds -= gate.tolerance * distance(&before, &vector);
            }
            before = Some(vector);
        }
        best = best.max(seconds);
        reach = 2 * reach + 1;
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gates(points: &[(f64, f64)]) -> Vec<Gate> {
        let gate = |(x, tolerance): &(f64, f64)| Gate {
            at: [*x, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            tolerance: *tolerance,
        };
        points.iter().map(gate).collect()
    }

    #[test]
    fn an_axis_turns_only_where_it_must() {
        let time = |points: &[(f64, f64)]| axis(&gates(points), 0, 1e9, 2000.0);
        let leg = |way: f64| 2.0 * (way / 2000.0).sqrt();
        let close =
            |time: f64, wanted: f64| assert!((time - wanted).abs() < 1e-12, "{time} {wanted}");
        close(time(&[(0.0, 0.0), (1.0, 0.1), (2.0, 0.1), (3.0, 0.0)]), leg(3.0));
        close(time(&[(0.0, 0.0), (1.0, 0.1), (0.0, 0.0)]), 2.0 * leg(0.9));
        close(time(&[(0.0, 0.0), (1.0, 0.1), (0.0, 0.1), (1.0, 0.0)]), 2.0 * leg(0.9) + leg(0.8));
        close(time(&[(0.0, 0.0), (0.05, 0.1), (-0.05, 0.1), (0.0, 0.0)]), 0.0);
        close(time(&[(0.0, 0.0), (-1.0, 0.0), (-0.5, 0.6), (-2.0, 0.0)]), leg(2.0));
    }

    #[test]
    fn each_way_between_gates_has_its_own_speed() {
        let straight = gates(&[(0.0, 0.0), (1.0, 0.0), (3.0, 0.0), (8.0, 0.0)]);
        let seconds = shortest(&straight, &[0.0, 10.0, f64::INFINITY, 5.0], 0..3);
        assert!((seconds - 1.1).abs() < 1e-12, "{seconds}");
        // Within the tolerance of a gate the faster of two speeds may be taken up early.
        let early = gates(&[(0.0, 0.0), (1.0, 0.25), (3.0, 0.0)]);
        let seconds = shortest(&early, &[0.0, 1.0, 2.0], 0..3);
        assert!((seconds - (0.75 + 2.25 / 2.0)).abs() < 1e-12, "{seconds}");
    }

    #[test]
    fn the_way_through_gates_is_no_longer_than_any() {
        let mut two = gates(&[(0.0, 0.0), (3.0, 1.0), (0.0, 0.0)]);
        assert!((shortest(&two, &[1.0; 3], 0..3) - 4.0).abs() < 1e-12);
        two[1].at[1] = 4.0;
        let length = shortest(&two, &[1.0; 3], 0..3);
        assert!((8.0 - 1e-9..=8.0 + 1e-9).contains(&length), "{length}");
        // A noisy line is no longer than a straight one through its band.
        let noise = |place: u32| if place.is_multiple_of(2) { 0.01 } else { -0.01 };
        let mut noisy =
            gates(&(0..=100_u32).map(|place| (f64::from(place) * 0.01, 0.02)).collect::<Vec<_>>());
        for (place, gate) in (0..).zip(&mut noisy) {
            gate.at[1] = noise(place);
        }
        let length = shortest(&noisy, &[1.0; 101], 0..3);
        assert!((0.94..=1.0).contains(&length), "{length}");
    }
}
