//! Each choice of `motion`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::MOTION;

    /// Whether the axis words of G10, G28, G30, G43.1 and G92 are refused while G80 is active. LinuxCNC
    /// refuses words that no code of group 0 uses; Grbl's table of errors speaks of unused words, its parser
    /// of all.
    OffsetWordsAfterCancel = "motion.offset-words-after-cancel" {
        /// the code uses the words
        Accepted = "accepted",
        /// any axis word is refused
        Refused = "refused",
    }

    /// What a motion code without axis words does: it makes a move to where the point is, sets the mode only,
    /// or is refused. All axis words are optional, and an axis without a word keeps its value; NIST lists
    /// their absence as an error.
    WithoutAxisWords = "motion.without-axis-words" {
        /// only the mode is set
        Nothing = "nothing",
        /// a move of no length
        MoveInPlace = "move-in-place",
        /// a word is missing
        Refused = "refused",
    }
}
