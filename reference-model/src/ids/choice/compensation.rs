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
}
