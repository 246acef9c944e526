//! Each choice of `compensation`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::COMPENSATION;

    /// What joins both paths at an outside corner in front of a G0. The manual's picture has arcs in front of
    /// feed moves.
    CornerBeforeTraverse = "compensation.corner-before-traverse" {
        /// a straight traverse
        Straight = "straight",
        /// an arc about the corner, as in front of other moves
        Arc = "arc",
    }

    /// What may follow cutter compensation: in LinuxCNC's manual a line longer than the tool's diameter, in
    /// NIST's report any move.
    ExitMove = "compensation.exit-move" {
        /// a line that is longer than the diameter of the tool
        Line = "line",
        /// any move
        Any = "any",
    }
}
