//! Input and output of a servo cycle, and the machine's limits.

/// A value per axis, in the order X Y Z A B C U V W; millimetres for linear axes, degrees for rotary ones.
pub type Axes = [f64; 9];

/// The limits of the machine, and the size of the queue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dynamics {
    /// Highest velocity per axis, millimetres or degrees per second.
    pub velocity: Axes,
    /// Highest acceleration per axis, millimetres or degrees per second squared.
    pub acceleration: Axes,
    /// Highest jerk per axis, millimetres or degrees per second cubed; `None` for profiles without a limit of jerk, and
    /// infinite for an axis without one.
    pub jerk: Option<Axes>,
    /// Servo cycle, seconds.
    pub cycle: f64,
    /// How many segments the queue holds.
    pub queue: u32,
}

/// Sets the leading axes.
#[inline]
pub(crate) fn lead<const N: usize>(axes: &mut Axes, leading: &[f64; N]) {
    for (axis, leading) in axes.iter_mut().zip(leading) {
        *axis = *leading;
    }
}

/// Whether the machine must come to rest on its path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Hold {
    /// Go on.
    #[default]
    Run,
    /// Come to rest and keep the queue.
    Hold,
    /// Come to rest and forget the queue.
    Abort,
}

/// What the operator and the machine request in this cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InputParameter {
    /// Feed override, 0 and up; 1 is the programmed feed.
    pub feed_override: f64,
    /// Rapid override, 0 to 1.
    pub rapid_override: f64,
    /// Adaptive feed, -1 to 1, multiplies both overrides. Negative values run backwards along the path, as far as the
    /// planner remembers it.
    pub adaptive_feed: f64,
    /// Feed hold, or abort.
    pub hold: Hold,
    /// Revolutions of the spindle since the start, for segments that follow it.
    pub spindle_turns: f64,
    /// Whether the probe is in contact.
    pub probe: bool,
}

impl Default for InputParameter {
    fn default() -> Self {
        Self {
            feed_override: 1.0,
            rapid_override: 1.0,
            adaptive_feed: 1.0,
            hold: Hold::Run,
            spindle_turns: 0.0,
            probe: false,
        }
    }
}

/// What the planner is doing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Phase {
    /// At rest at the end of all that was queued.
    #[default]
    Idle,
    /// Moving along the path.
    Moving,
    /// Waiting: a dwell, or the spindle.
    Waiting,
    /// Coming to rest or at rest by hold or abort, on the path.
    Holding,
}

/// Where the machine must be at the end of this cycle.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct OutputParameter {
    /// Machine position.
    pub position: Axes,
    /// Velocity, per second. With limits of jerk: in the mean of this cycle.
    pub velocity: Axes,
    /// Acceleration, per second squared. With limits of jerk: the change of that velocity.
    pub acceleration: Axes,
    /// What the planner is doing.
    pub phase: Phase,
    /// Caller's number of the segment under way, or of the last one. Of several segments within a cycle, the last one.
    pub segment: u64,
    /// Speed along the path of all nine axes, millimetres or degrees per second.
    pub speed: f64,
    /// Whether the probe has changed in a probing segment. The motion then stops, and the queue is cleared.
    pub probe_tripped: bool,
}
