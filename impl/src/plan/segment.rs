//! What a planner is asked to do.

use super::parameters::Axes;

/// The geometry of a segment, in machine coordinates.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Path {
    /// A straight line.
    Straight {
        /// End point.
        end: Axes,
    },
    /// An arc or helix about an axis through the centre; all other axes move evenly with it.
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
    /// No motion.
    Dwell {
        /// Seconds.
        seconds: f64,
    },
}

/// How fast a segment is asked to be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Feed {
    /// As fast as the axes allow; the rapid override applies.
    Rapid,
    /// Millimetres or degrees per second along the path; feed override and adaptive feed apply.
    PerSecond(f64),
    /// The whole segment in so many seconds.
    InTime(f64),
    /// Millimetres per turn of the spindle.
    PerTurn(f64),
}

/// What may happen at the corner after a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Blend {
    /// G61.1: come to rest.
    ExactStop,
    /// G61: touch the end point, without rest where the path goes on smoothly.
    ExactPath,
    /// G64: leave the path by this much at most, millimetres.
    Within(f64),
}

/// An output that switches with the start of a segment.
#[derive(Clone, Copy, Debug, PartialEq)]
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
    pub blend: Blend,
    /// What switches at its start.
    pub output: Option<OutputSwitch>,
    /// Whether it ends at the first change of the probe.
    pub probing: bool,
}
