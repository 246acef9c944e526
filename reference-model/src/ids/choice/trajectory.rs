//! Each choice of `trajectory`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::TRAJECTORY;

    /// Where a motion starts at a corner that is rounded, for the outputs that wait for it.
    MotionStart = "trajectory.motion-start" {
        /// in the sample that is nearest to the corner, or a cycle before or after it
        Corner = "corner",
        /// where the blend has ended, at the first sample on the motion's own path, or a cycle before or
        /// after it
        BlendEnd = "blend-end",
    }

    /// Which P holds at the end of a movement if another P was programmed for the next one.
    ToleranceAtChange = "trajectory.tolerance-at-change" {
        /// the larger one: what no reading allows is not allowed
        Larger = "larger",
        /// that of the movement which ends there
        Before = "before",
        /// that of the movement which starts there
        After = "after",
    }
}
