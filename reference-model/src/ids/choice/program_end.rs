//! Each choice of `program-end`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::PROGRAM_END;

    /// What becomes of F when the program end changes the feed mode to feed per minute: F is not among its
    /// effects, and after a switch to G94 a new feed rate must be given.
    FeedAfterModeChange = "program-end.feed-after-mode-change" {
        /// none is set, as after G94
        Zero = "zero",
        /// the number stays and counts per minute
        Kept = "kept",
        /// it is the rate per minute at which the last feed move was made
        OfLastMove = "of-last-move",
    }

    /// What the program end does to the offset of G92: in LinuxCNC it stays, in NIST it is cancelled as by
    /// G92.2.
    LocalOffset = "program-end.local-offset" {
        /// it stays
        Kept = "kept",
        /// it is cancelled as by G92.2
        Suspended = "suspended",
    }

    /// Which spindles the program end stops on a machine with several: the documents speak of the spindle, as
    /// if there were one.
    Spindles = "program-end.spindles" {
        /// every spindle
        All = "all",
        /// spindle 0
        First = "first",
    }
}
