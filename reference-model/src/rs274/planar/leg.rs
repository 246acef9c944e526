//! A compensated move: its programmed move, and the curve of the tool along it.

use super::{
    Circle, InPlane, Line, Vector, across, along, away, between, direction, length, quarter_turn,
    sweep,
};
use crate::math;

/// An arc as it is programmed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct ProgrammedArc {
    pub(crate) start: InPlane,
    pub(crate) end: InPlane,
    pub(crate) centre: InPlane,
    /// Positive counterclockwise, negative clockwise.
    pub(crate) turns: i32,
}

/// The tool while the cutter is compensated.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Cutter {
    /// Half of the diameter, active length unit; positive.
    pub(crate) radius: f64,
    /// 1 with the tool on the left of its path, -1 on the right.
    pub(crate) side: f64,
}

/// The curve of the tool, without the ends that corners give it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Curve {
    /// The parallel to a line.
    Straight(Line),
    /// The circle along an arc.
    Round {
        circle: Circle,
        /// 1 counterclockwise, -1 clockwise.
        sense: f64,
        /// 1 if the centre of the programmed arc is on the tool's side, -1 elsewhere.
        inside: f64,
        /// The programmed sweep without full turns, radians.
        sweep: f64,
    },
}

/// A compensated move in the plane; lengths in the active length unit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Leg {
    /// The curve of the tool.
    pub(crate) curve: Curve,
    /// Where this curve begins by itself.
    pub(crate) start: InPlane,
    /// Where this curve ends by itself.
    pub(crate) end: InPlane,
    /// Where the tool begins.
    pub(crate) begins: InPlane,
    /// The direction of the programmed move at its start.
    pub(crate) leaves: Vector,
    /// The direction of the programmed move at its end.
    pub(crate) arrives: Vector,
    /// Whether it has to fit between its corners. The entry does not, nor a move right after a pause.
    pub(crate) has_to_fit: bool,
}

impl Leg {
    /// A line leads from P + R n to Q + R n. It has a length in the plane.
    pub(crate) fn line(start: InPlane, end: InPlane, cutter: Cutter) -> Self {
        let ahead = direction(between(start, end));
        let normal = quarter_turn(ahead, cutter.side);
        let (start, end) = (away(start, cutter.radius, normal), away(end, cutter.radius, normal));
        Self {
            curve: Curve::Straight(Line { point: end, direction: ahead }),
            start,
            end,
            begins: start,
            leaves: ahead,
            arrives: ahead,
            has_to_fit: true,
        }
    }

    /// An arc leads from P - k R u0 to Q - k R u1 about its own centre; none if the tool does not fit into it.
    ///
    /// `slack`, active length unit, is added to the radius that is left. An arc at most as long is a whole turn.
    pub(crate) fn arc(arc: ProgrammedArc, cutter: Cutter, slack: f64) -> Option<Self> {
        let sense = if arc.turns < 0 { -1.0 } else { 1.0 };
        let inside = sense * cutter.side;
        let (to_start, to_end) = (between(arc.centre, arc.start), between(arc.centre, arc.end));
        let radius = length(to_end) - inside * cutter.radius;
        if radius + slack <= 0.0 || radius <= 0.0 {
            return None;
        }
        let (first, last) = (direction(to_start), direction(to_end));
        let start = away(arc.start, -inside * cutter.radius, first);
        let end = away(arc.end, -inside * cutter.radius, last);
        // An arc has a length: one that ends in the direction of its start is a whole turn.
        let programmed = match sweep(first, last, sense) {
            turned if turned * length(to_end) <= slack.max(0.0) => math::TURN,
            turned => turned,
        };
        Some(Self {
            curve: Curve::Round {
                circle: Circle { centre: arc.centre, radius },
                sense,
                inside,
                sweep: programmed,
            },
            start,
            end,
            begins: start,
            leaves: quarter_turn(first, sense),
            arrives: quarter_turn(last, sense),
            has_to_fit: true,
        })
    }

    /// Whether an arc as entry is turned over: along its circle it arrives against its programmed direction.
    pub(crate) fn is_turned_over(&self) -> bool {
        match self.curve {
            Curve::Straight(_) => false,
            Curve::Round { circle, sense, .. } => {
                let ahead = quarter_turn(between(circle.centre, self.end), sense);
                along(ahead, self.arrives) < 0.0
            }
        }
    }

    /// Whether it leads somewhere from where it begins to an end, and not backward. `slack` is how far, active length
    /// unit, it may run backward.
    ///
    /// A line must not run against its direction. An arc must not be more than 0.001 radian longer than programmed.
    pub(crate) fn fits(&self, end: InPlane, slack: f64) -> bool {
        match self.curve {
            Curve::Straight(line) => along(between(self.begins, end), line.direction) >= -slack,
            Curve::Round { circle, sense, sweep: programmed, .. } => {
                if programmed + LONGER >= math::TURN {
                    return true;
                }
                let (from, to) = (between(circle.centre, self.begins), between(circle.centre, end));
                // An arc that has shrunk to a point runs backward no more than a line does.
                let backward = -sense * across(from, to) / circle.radius;
                let is_point = backward.abs() <= slack.abs() && along(from, to) > 0.0;
                if is_point {
                    return backward <= slack;
                }
                sweep(from, to, sense) <= programmed + LONGER
            }
        }
    }

    /// The same move in another length unit.
    pub(crate) fn scaled(self, factor: f64) -> Self {
        let scaled = |point: InPlane| (point.0 * factor, point.1 * factor);
        let curve = match self.curve {
            Curve::Straight(line) => {
                Curve::Straight(Line { point: scaled(line.point), direction: line.direction })
            }
            Curve::Round { circle, sense, inside, sweep } => {
                let (centre, radius) = (scaled(circle.centre), circle.radius * factor);
                Curve::Round { circle: Circle { centre, radius }, sense, inside, sweep }
            }
        };
        Self {
            curve,
            start: scaled(self.start),
            end: scaled(self.end),
            begins: scaled(self.begins),
            ..self
        }
    }
}

/// How much longer than programmed the sweep of an arc may be, radians.
const LONGER: f64 = 0.001;
