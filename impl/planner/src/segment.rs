//! What a planner is asked to do.

use crate::parameters::Axes;

/// The geometry of a segment, in machine coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path {
    /// A straight line.
    Straight {
        /// End point.
        end: Axes,
    },
    /// An arc or helix about an axis through the centre; all other axes move evenly with it. Where the end point does
    /// not lie on the circle, the difference is spread evenly over the arc.
    Arc {
        /// End point.
        end: Axes,
        /// Centre, X Y Z in millimetres.
        centre: [f64; 3],
        /// Direction of the arc's axis, of length 1.
        normal: [f64; 3],
        /// Angle about the normal, radians; positive is counterclockwise.
        angle: f64,
    },
    /// No motion; the corner before it is a stop.
    Dwell {
        /// Seconds.
        seconds: f64,
    },
}

/// How fast a segment is asked to be.
///
/// Along the path is along X Y Z where those move, else along U V W, else in degrees along A B C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feed {
    /// As fast as the axes allow; the rapid override applies.
    Rapid,
    /// Millimetres or degrees per second along the path; feed override and adaptive feed apply.
    PerSecond(f64),
    /// The whole segment in so many seconds, were it not for acceleration.
    InTime(f64),
    /// Millimetres or degrees per turn of the spindle; feed override and adaptive feed apply. Look-ahead plans for
    /// the speed that the spindle has; where it turns slower all of a sudden, the motion comes down to its feed as
    /// fast as the axes allow.
    PerTurn(f64),
}

/// What may happen at the corner after a segment. Between a line and another is a parabola, otherwise the path itself
/// bent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PathControl {
    /// G61.1: come to rest.
    #[default]
    ExactStop,
    /// G61: keep to the path, without rest where it goes on smoothly, or so nearly that the axes can follow from one
    /// cycle to the next.
    ExactPath,
    /// G64 with a tolerance: leave the path by this much at most, in the length of all nine axes, millimetres. Lines
    /// of which several are over within a cycle become one within it.
    Within(f64),
    /// G64 without one: leave the path between the midpoints of the two segments.
    BetweenMidpoints,
}

/// An output that switches with the start of the next motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OutputSwitch {
    /// Output number.
    pub output: u16,
    /// Value; 0 and 1 for digital outputs.
    pub value: f64,
}

/// One canonical move, as a planner takes it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Caller's number, which comes back in the output.
    pub number: u64,
    /// Where it goes.
    pub path: Path,
    /// How fast it is asked to be.
    pub feed: Feed,
    /// What may happen at its end.
    pub path_control: PathControl,
    /// Whether it ends, and the queue with it, at the first change of the probe. The segments around it come to rest.
    pub probing: bool,
}
