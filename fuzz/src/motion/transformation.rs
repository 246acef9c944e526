//! Transformations of a motion program, and the effect that each may have on its time.

use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{MotionLimits, PathMode};
use gaugeblock_vocabulary::scenario::AxisLimits;

use super::draw::between;
use super::{Axes, MotionProgram, Pace, Plane, Step};
use crate::generate::Entropy;

/// A transformation of a motion program.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Transformation {
    /// X becomes Y, Y becomes Z, and Z becomes X.
    AxesPermuted,
    /// X runs the other way.
    Mirrored,
    /// Lengths, speeds and accelerations are twice as large.
    Scaled,
    /// A line that may be blended is two.
    SplitLine,
    /// An axis may be faster.
    HigherVelocity,
    /// An axis may accelerate more.
    HigherAcceleration,
    /// Corners may be passed farther away.
    LooserTolerance,
}

impl Transformation {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::AxesPermuted,
        Self::Mirrored,
        Self::Scaled,
        Self::SplitLine,
        Self::HigherVelocity,
        Self::HigherAcceleration,
        Self::LooserTolerance,
    ];

    /// In a word.
    pub fn name(self) -> &'static str {
        match self {
            Self::AxesPermuted => "axes-permuted",
            Self::Mirrored => "mirrored",
            Self::Scaled => "scaled",
            Self::SplitLine => "split-line",
            Self::HigherVelocity => "higher-velocity",
            Self::HigherAcceleration => "higher-acceleration",
            Self::LooserTolerance => "looser-tolerance",
        }
    }

    /// Whether it may save time; what else it does, costs none.
    pub fn may_save(self) -> bool {
        match self {
            Self::HigherVelocity | Self::HigherAcceleration | Self::LooserTolerance => true,
            Self::AxesPermuted | Self::Mirrored | Self::Scaled | Self::SplitLine => false,
        }
    }

    /// The changed program; `None` where there is nothing to change.
    ///
    /// With limits of jerk, a greater tolerance or another greater limit may cost time: a planner divides the jerk by
    /// them.
    pub fn of(self, program: &MotionProgram, entropy: &mut Entropy<'_>) -> Option<MotionProgram> {
        let limits_jerk = program.limits.axes.values().any(|limit| limit.jerk.is_some());
        if self.may_save() && limits_jerk {
            return None;
        }
        let mut changed = program.clone();
        match self {
            Self::AxesPermuted => {
                changed.each_point(|point| {
                    let [x, y, z, ..] = *point;
                    (point[0], point[1], point[2]) = (z, x, y);
                });
                changed.plane = match program.plane {
                    Plane::Xy => Plane::Yz,
                    Plane::Yz => Plane::Zx,
                    Plane::Zx => Plane::Xy,
                };
                let to = [(Axis::X, Axis::Y), (Axis::Y, Axis::Z), (Axis::Z, Axis::X)];
                for (from, to) in to {
                    match program.limits.axes.get(&from) {
                        Some(limit) => changed.limits.axes.insert(to, *limit),
                        None => changed.limits.axes.remove(&to),
                    };
                }
            }
            Self::Mirrored => changed.mirror(),
            Self::Scaled => changed.double(),
            Self::SplitLine => return divided(program, entropy),
            Self::HigherVelocity | Self::HigherAcceleration => {
                let axes: Vec<Axis> = program.limits.axes.keys().copied().collect();
                let limit = changed.limits.axes.get_mut(entropy.pick(&axes))?;
                let raised = if self == Self::HigherVelocity {
                    &mut limit.velocity
                } else {
                    &mut limit.acceleration
                };
                *raised = raised.map(|value| value * between(entropy, 1.0, 2.0));
            }
            Self::LooserTolerance => {
                let by = between(entropy, 1.0, 3.0);
                let mut any = false;
                for step in &mut changed.steps {
                    if let Step::Mode(PathMode::Within { tolerance, .. }) = step {
                        *tolerance *= by;
                        any = true;
                    }
                }
                // A blend has the feed of its slower leg, and a longer one has it for longer.
                return (any && program.has_one_feed()).then_some(changed);
            }
        }
        Some(changed)
    }
}

impl MotionProgram {
    /// Whether all moves have the same speed along the path.
    fn has_one_feed(&self) -> bool {
        let paces = self.steps.iter().filter(|step| matches!(step, Step::Pace(_))).count();
        let by_length =
            |step: &Step| !matches!(step, Step::Rapid(_) | Step::Pace(Pace::PerMove(_)));
        self.limits.axes.len() == 3 && paces <= 1 && self.steps.iter().all(by_length)
    }

    fn each_point(&mut self, change: impl Fn(&mut Axes)) {
        change(&mut self.start);
        self.steps.iter_mut().filter_map(Step::end_mut).for_each(change);
    }

    fn mirror(&mut self) {
        self.each_point(|point| point[0] = 0.0 - point[0]);
        let place = self.plane.axes().iter().position(|axis| *axis == 0);
        for step in &mut self.steps {
            if let (Step::Arc { centre, clockwise, .. }, Some(place)) = (step, place) {
                centre[place] = 0.0 - centre[place];
                *clockwise = !*clockwise;
            }
        }
    }

    fn double(&mut self) {
        self.each_point(|point| *point = point.map(|value| 2.0 * value));
        for step in &mut self.steps {
            match step {
                Step::Mode(PathMode::Within { tolerance, .. }) => *tolerance *= 2.0,
                Step::Pace(Pace::PerMinute(feed) | Pace::PerTurn(feed)) => *feed *= 2.0,
                Step::Arc { centre, .. } => *centre = centre.map(|value| 2.0 * value),
                Step::Mode(
                    PathMode::ExactStop | PathMode::ExactPath | PathMode::BetweenMidpoints,
                )
                | Step::Pace(Pace::PerMove(_))
                | Step::Rapid(_)
                | Step::Line(_)
                | Step::Dwell(_)
                | Step::Output { .. } => {}
            }
        }
        double_limits(&mut self.limits);
    }
}

fn double_limits(limits: &mut MotionLimits) {
    for limit in limits.axes.values_mut() {
        let AxisLimits { velocity, acceleration, jerk, .. } = *limit;
        limit.velocity = velocity.map(|value| 2.0 * value);
        limit.acceleration = acceleration.map(|value| 2.0 * value);
        limit.jerk = jerk.map(|value| 2.0 * value);
    }
}

/// How much longer than a tolerance a line is of which blends at both ends take less than a third each, but for the
/// flattest.
const BLENDS: f64 = 100.0;

/// A line in continuous mode with a tolerance, at a feed that does not count moves, becomes two.
fn divided(program: &MotionProgram, entropy: &mut Entropy<'_>) -> Option<MotionProgram> {
    let (mut continuous, mut by_length) = (None, true);
    let mut here = program.start;
    let mut places = Vec::new();
    for (place, step) in program.steps.iter().enumerate() {
        match step {
            Step::Mode(PathMode::Within { tolerance, .. }) => continuous = Some(*tolerance),
            Step::Mode(_) => continuous = None,
            Step::Pace(pace) => by_length = !matches!(pace, Pace::PerMove(_)),
            Step::Line(end) if by_length => {
                // What blends take of a line must not depend on where it is divided.
                let length = libm::sqrt(
                    here.iter().zip(end).map(|(from, to)| (to - from) * (to - from)).sum::<f64>(),
                );
                if continuous.is_some_and(|tolerance| length > BLENDS * tolerance) {
                    places.push((place, here, *end));
                }
            }
            Step::Line(_)
            | Step::Rapid(_)
            | Step::Arc { .. }
            | Step::Dwell(_)
            | Step::Output { .. } => {}
        }
        here = step.end().copied().unwrap_or(here);
    }
    if places.is_empty() {
        return None;
    }
    let (place, from, to) = *entropy.pick(&places);
    let share = between(entropy, 0.3, 0.7);
    let inside = std::array::from_fn(|axis| from[axis] + share * (to[axis] - from[axis]));
    let mut changed = program.clone();
    changed.steps.insert(place, Step::Line(inside));
    Some(changed)
}
