//! Each choice of `motion`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::MOTION;

    /// Whether a motion code without axis words makes a move to where the point is. All axis words are
    /// optional, and an axis without a word keeps its value.
    WithoutAxisWords = "motion.without-axis-words" {
        /// only the mode is set
        Nothing = "nothing",
        /// a move of no length
        MoveInPlace = "move-in-place",
    }
}
