//! Each rule of `trajectory`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::TRAJECTORY;

    /// An abort stops the motion as a hold does, for good.
    ABORT = "trajectory.abort",
    /// No axis ever accelerates or brakes more than it can.
    ACCELERATION = "trajectory.acceleration",
    /// The commanded point is nowhere farther from the programmed path than its tolerance; on it where the
    /// path is exact.
    DEVIATION = "trajectory.deviation",
    /// The axes rest for the time of a dwell, to the cycle.
    DWELL = "trajectory.dwell",
    /// The motion starts and ends at the programmed points, exactly, and at rest.
    ENDS = "trajectory.ends",
    /// The path is passed no faster than it is programmed and overridden.
    FEED = "trajectory.feed",
    /// A hold stops the motion on the path, within what braking takes and two cycles; it rests until nothing
    /// holds it any more, and goes on.
    HOLD = "trajectory.hold",
    /// No axis changes its acceleration faster than it can, where it has such a limit.
    JERK = "trajectory.jerk",
    /// Successive feed moves of X, Y, Z at one feed that are less than Q from a straight line may be merged
    /// into one, which moves their ends by Q more; nothing else may.
    MERGING = "trajectory.merging",
    /// Without a tolerance a corner is rounded between the middles of its two movements at most, so that each
    /// movement is touched.
    MIDPOINTS = "trajectory.midpoints",
    /// Each element that leads somewhere is passed, in the order of the program; one that leads nowhere
    /// changes nothing.
    ORDER = "trajectory.order",
    /// Outputs of M62, M63 and M67 switch where the next motion starts, those of M64, M65 and M68 at once
    /// while the motion rests, each in its order, and nothing else switches.
    OUTPUTS = "trajectory.outputs",
    /// The path is followed forwards, but that a negative adaptive feed runs it backwards, exactly as it
    /// came.
    PROGRESS = "trajectory.progress",
    /// At each instant the movements that a planner was given suffice to stop on.
    RESERVE = "trajectory.reserve",
    /// The motion rests at the end of each element that requires it: under exact stop, before a dwell or a
    /// wait, and for an output at once.
    STOP = "trajectory.stop",
    /// No axis is ever faster than it can be.
    VELOCITY = "trajectory.velocity",
    /// The commanded path passes each programmed end no farther away than P, exactly where the path is exact.
    VERTEX = "trajectory.vertex",
}
