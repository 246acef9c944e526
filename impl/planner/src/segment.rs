//! Segments: what a caller queues.

use crate::parameters::Axes;

/// The geometry of a segment, in machine coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path {
    /// A straight line.
    Straight {
        /// End point.
        end: Axes,
    },
    /// An arc or helix about an axis through the centre. All other axes move in proportion. Where the end point is not
    /// on the circle, the difference is spread evenly over the arc.
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
    /// No motion. The corner before it is a stop.
    Dwell {
        /// Seconds.
        seconds: f64,
    },
}

/// The requested speed of a segment.
///
/// "Along the path" means along X Y Z where those move, else along U V W, else in degrees along A B C.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feed {
    /// As fast as the axes allow. The rapid override applies.
    Rapid,
    /// Millimetres or degrees per second along the path. Feed override and adaptive feed apply.
    PerSecond(f64),
    /// The whole segment in so many seconds, if acceleration took no time.
    InTime(f64),
    /// Millimetres or degrees per revolution of the spindle. Feed override and adaptive feed apply. Look-ahead plans
    /// for the present spindle speed; where the spindle suddenly slows down, the motion follows as fast as the axes
    /// allow.
    PerTurn(f64),
}

/// What may happen at the corner after a segment. A blend of two lines is a parabola, or an arc where the axes can keep
/// the feed on it; at an arc the path itself is bent.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub enum PathControl {
    /// G61.1: stop.
    #[default]
    ExactStop,
    /// G61: stay on the path. It is passed without a stop where it goes on smoothly, or nearly enough that the axes
    /// can follow from one cycle to the next.
    ExactPath,
    /// G64 with a tolerance: leave the path by at most this distance, in the length of all nine axes, millimetres.
    /// Short lines, several of which would be over within a cycle, are merged within it.
    Within(f64),
    /// G64 without a tolerance: leave the path at most between the midpoints of the two segments.
    BetweenMidpoints,
}

/// An output that switches with the start of the next segment.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OutputSwitch {
    /// Output number.
    pub output: u16,
    /// Value; 0 and 1 for digital outputs.
    pub value: f64,
}

/// One canonical move.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Caller's number, which is reported in the output.
    pub number: u64,
    /// Its geometry.
    pub path: Path,
    /// Its requested speed.
    pub feed: Feed,
    /// What may happen at its end.
    pub path_control: PathControl,
    /// Whether it, and the queue, ends at the first change of the probe. The motion stops before and after it.
    pub probing: bool,
}
