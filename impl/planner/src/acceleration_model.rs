//! The acceleration model of an element, and its speed limits, from the limits of the axes.

use crate::limits::{Limits, PLANNED_RATIO, least, squared};
use crate::math;
use crate::parameters::Axes;
use crate::path_element::{AccelerationModel, Averaged, Circle, PathElement};

/// The share of an acceleration limit that a blended arc may use across the path. The rest is kept for acceleration
/// along the path. The second value is for corners, where the motion slows down.
const NORMAL_ACCELERATION_RATIO_MAX: f64 = 0.95;
const CORNER_NORMAL_ACCELERATION_RATIO_MAX: f64 = 0.8;
/// The greatest distance of p' and p'' of an arc from the chord between their values at its ends, relative to their
/// amplitude and to the square of the angle: an eighth, and more where the radius changes.
const ARC_BOW_RATIO: f64 = 0.25;
/// From this change of direction on a blended arc is treated as a corner.
const CORNER_ANGLE_MIN_RAD: f64 = 0.1;

impl Limits {
    /// Sets the acceleration model and the speed limits of an element. A blend of two lines gets exact limits per
    /// axis; other elements get bounds that hold over the whole element.
    pub(crate) fn assign_model(&self, element: &mut PathElement) {
        let axes = element.axis_count;
        let bends = element.curvature.iter().any(|bend| bend.abs() > 0.0);
        match element.circle {
            None if !bends => return self.assign_line_model(element),
            None => {
                if axes <= 3 {
                    self.assign_blend_model::<3>(element);
                } else {
                    self.assign_blend_model::<9>(element);
                }
                return;
            }
            Some(circle) if !bends => self.assign_arc_model(element, &circle),
            Some(circle) => self.assign_blended_arc_model(element, &circle),
        }
        element.end_limit_sq = element.start_limit_sq;
        element.speed_limit = math::sqrt(element.start_limit_sq);
    }

    /// Does the same for a line.
    #[inline]
    pub(crate) fn assign_line_model(&self, element: &mut PathElement) {
        let acceleration = least(&self.planned, &element.tangent, element.axis_count);
        element.model = AccelerationModel::Constant { acceleration };
        element.start_limit_sq =
            squared(least(&self.velocity, &element.tangent, element.axis_count));
        element.end_limit_sq = element.start_limit_sq;
        element.speed_limit = math::sqrt(element.start_limit_sq);
    }

    /// Sets the limits of a blend of two lines. Let p and q be the derivatives of an axis at the two ends, |p| ≤ |q|.
    /// The axis keeps its velocity limit v at the end of q with a squared speed of v²/q². It keeps v everywhere if the
    /// squared speed changes linearly from there to at most v²/q²·(3 - 2p/q): the logarithm of (p'·speed)² is concave
    /// along the blend, so the maximum is at that end unless the speed falls towards it.
    fn assign_blend_model<const N: usize>(&self, element: &mut PathElement) {
        let [mut starts, mut ends] = [[0.0; N]; 2];
        let axes = self.velocity.iter().zip(&element.tangent).zip(&element.curvature);
        for ((start, end), ((limit, first), bend)) in starts.iter_mut().zip(&mut ends).zip(axes) {
            let last = first + element.length * bend;
            let falls = first.abs() > last.abs();
            let (most, other) = if falls { (*first, last) } else { (last, *first) };
            // For an axis that does not move these are NaN, which `math::min` ignores.
            let (here, share) = (squared(limit / most), other / most);
            // Where the axis reverses within the blend, the other end may have a lower limit.
            let there = if share < -0.5 { here } else { here * (3.0 - 2.0 * share) };
            (*start, *end) = if falls { (here, there) } else { (there, here) };
        }
        let steady_speed_sq = least(&self.planned, &element.curvature, N);
        element.model = AccelerationModel::Blend { steady_speed_sq };
        element.start_limit_sq = starts.into_iter().fold(f64::INFINITY, math::min);
        element.end_limit_sq = ends.into_iter().fold(f64::INFINITY, math::min);
        element.speed_limit = math::sqrt(math::max(element.start_limit_sq, element.end_limit_sq));
    }

    /// Sets the limits of an arc. An axis has a constant part l and a rotating part m, so it needs at most l·|u| +
    /// m·√(u² + (κ·v²)²).
    fn assign_arc_model(&self, element: &mut PathElement, circle: &Circle) {
        let axes = element.axis_count;
        let most = max_derivative(element, circle);
        let acceleration = least(&self.acceleration, &most, axes);
        // Where the planned speed falls, a cycle begins faster than its mean speed. The share lost is proportional to
        // the angle of a cycle.
        let angle = math::sqrt(circle.angle_rate * acceleration) * self.cycle;
        let planned = acceleration * math::sqrt((1.0 - angle).max(0.25));
        element.model = AccelerationModel::Arc { acceleration, planned };
        element.start_limit_sq =
            squared(least(&self.velocity, &most, axes)).min(planned / circle.angle_rate);
        if self.smoothing.averaged == Averaged::LoneArc {
            let jerk = least(&self.jerk, &most, axes);
            let grows = circle.growth.abs() > 1e-6 * circle.angle_rate;
            let jerk = if grows { jerk / GROWING_RATIO } else { jerk };
            let fastest = lone_arc_speed(circle.angle_rate, acceleration, jerk);
            let machine = least(&self.unsmoothed, &most, axes);
            if let Some(across) = lone_arc_across(acceleration, machine) {
                let acceleration = acceleration * PLANNED_RATIO;
                element.model = AccelerationModel::Constant { acceleration };
                element.start_limit_sq =
                    squared(least(&self.velocity, &most, axes)).min(across / circle.angle_rate);
            }
            element.start_limit_sq = element.start_limit_sq.min(squared(fastest));
        }
    }

    fn assign_blended_arc_model(&self, element: &mut PathElement, circle: &Circle) {
        let axes = element.axis_count;
        let [_, mut along, mut across] = element.derivatives::<9>(0.0);
        let [_, last, last_across] = element.derivatives::<9>(element.length);
        for ((one, other), (across, then)) in
            along.iter_mut().zip(&last).zip(across.iter_mut().zip(&last_across))
        {
            *one = math::max(one.abs(), other.abs());
            *across = math::max(across.abs(), then.abs());
        }
        // Between its ends an arc, and each of its derivatives, is no farther from a chord than this.
        let bow = ARC_BOW_RATIO * squared(circle.angle_rate * element.length);
        let amplitudes = amplitudes(circle, element.length);
        for ((along, across), amplitude) in along.iter_mut().zip(&mut across).zip(&amplitudes) {
            *along += bow * amplitude;
            *across += bow * amplitude * circle.angle_rate;
        }
        let turned: f64 =
            element.curvature.iter().map(|bend| squared(2.0 * bend * element.length)).sum();
        let share = if turned < squared(CORNER_ANGLE_MIN_RAD) {
            NORMAL_ACCELERATION_RATIO_MAX
        } else {
            CORNER_NORMAL_ACCELERATION_RATIO_MAX
        };
        let ceiling = share * least(&self.acceleration, &across, axes);
        element.start_limit_sq = ceiling.min(squared(least(&self.velocity, &along, axes)));
        let mut left = self.acceleration;
        for (left, across) in left.iter_mut().zip(&across) {
            *left -= across * element.start_limit_sq;
        }
        // An acceleration that is allowed both at rest and at the speed limit is allowed at all speeds between.
        let most = least(&self.acceleration, &along, axes);
        let less = (most - least(&left, &along, axes)) / element.start_limit_sq;
        // Where the planned speed falls, a cycle begins faster than its mean speed.
        let planned =
            PLANNED_RATIO / (1.0 + less * math::sqrt(element.start_limit_sq) * self.cycle);
        element.model =
            AccelerationModel::BlendedArc { at_rest: planned * most, loss: planned * less };
    }
}

/// Below this share of the acceleration along a lone arc, the rest is available across it.
const LONE_ARC_ALONG_RATIO_MAX: f64 = 0.6;

/// The ratio by which a growing radius lowers the limit of jerk.
const GROWING_RATIO: f64 = 1.35;

/// The acceleration that is available across a lone arc: what the averaged parameter leaves of the machine's. `None`
/// if the parameter takes most of it.
pub(crate) fn lone_arc_across(along: f64, machine: f64) -> Option<f64> {
    (along < LONE_ARC_ALONG_RATIO_MAX * machine)
        .then(|| PLANNED_RATIO * math::sqrt(squared(machine) - squared(along)))
}

/// The highest speed on an arc whose parameter is averaged, within a limit of jerk.
///
/// With a speed v, an acceleration u and a jerk w of the parameter, the jerk is w + κ²·v³ along the arc and 3·κ·u·v
/// across it. The window is so long that w takes half of the limit. With three tenths of it for κ²·v³ and four for
/// 3·κ·u·v, these two take the other half. Where the radius grows by g, κ + 3·g takes the place of κ in the third
/// derivative, and the amplitudes have κ + √5·g: the jerk is less by [`GROWING_RATIO`].
pub(crate) fn lone_arc_speed(angle_rate: f64, acceleration: f64, jerk: f64) -> f64 {
    let across = 0.4 * jerk / (3.0 * angle_rate * acceleration);
    math::min(math::cube_root(0.3 * jerk / squared(angle_rate)), across)
}

/// The greatest |p'| of each axis on an arc.
fn max_derivative(element: &PathElement, circle: &Circle) -> Axes {
    let mut greatest = element.tangent.map(f64::abs);
    for (most, amplitude) in greatest.iter_mut().zip(&amplitudes(circle, element.length)) {
        *most += amplitude;
    }
    greatest
}

/// The amplitude of p' on X, Y and Z. Where the radius grows by g, p'·u + p''·y rotates with u·(κ·r, g) +
/// y·κ·(2g, κ·r) about the centre, r being the relative radius. Its length is at most √(u² +
/// (κ·y)²) times κ·r + √5·|g|.
fn amplitudes(circle: &Circle, length: f64) -> [f64; 3] {
    const SQRT_5: f64 = 2.236_067_977_499_79;
    let grown = circle.radius_ratio(length).max(1.0);
    let swing = circle.angle_rate * grown + SQRT_5 * circle.growth.abs();
    let mut amplitudes = [0.0; 3];
    for ((amplitude, along), across) in amplitudes.iter_mut().zip(&circle.cosine).zip(&circle.sine)
    {
        *amplitude = swing * math::hypotenuse(*along, *across);
    }
    amplitudes
}
