//! Each choice of `cycles`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::CYCLES;

    /// How G85 goes on from R to the clear height: LinuxCNC feeds out to R and traverses from there, NIST
    /// feeds to the clear height.
    BoreReturn = "cycles.bore-return" {
        /// it traverses
        Traverse = "traverse",
        /// it feeds
        Feed = "feed",
    }

    /// Whether G73 ends at R under G98 too. Its own section names R; the section on the return mode speaks of
    /// all canned cycles.
    ChipBreakReturn = "cycles.chip-break-return" {
        /// it ends at R, as its own section says
        Retract = "retract",
        /// it ends where the return mode says
        ReturnLevel = "return-level",
    }

    /// Whether a canned cycle needs a feed rate: LinuxCNC's manual refuses a feed move without one, NIST's
    /// list of errors in cycles has no feed rate.
    FeedRate = "cycles.feed-rate" {
        /// without one it is refused
        Needed = "needed",
        /// it is accepted without one
        Any = "any",
    }

    /// Which level G98 returns to: in LinuxCNC where the normal axis was before the first of a row of canned
    /// cycles, in NIST where it was before each cycle.
    OldLevel = "cycles.old-level" {
        /// that before the row of cycles
        Row = "row",
        /// that before the cycle
        Cycle = "cycle",
    }

    /// In which path control mode a canned cycle moves: by LinuxCNC's manual in that of the program, NIST's
    /// report does not say, and its program takes the exact path.
    PathMode = "cycles.path-mode" {
        /// the mode of the program holds
        AsProgrammed = "as-programmed",
        /// exact path mode holds from its first move in the plane to its end
        ExactPath = "exact-path",
    }

    /// Where G83 goes between two pecks: in LinuxCNC to R, in NIST to the clear height, which under G98 can
    /// be above R.
    PeckReturn = "cycles.peck-return" {
        /// R
        Retract = "retract",
        /// the clear height
        Clear = "clear",
    }

    /// Whether P and Q of a canned cycle stick as R and the depth do. The manual says what a sticky number
    /// is, and of these two that the block of the cycle specifies them.
    StickyArguments = "cycles.sticky-arguments" {
        /// a later block of the same cycle may leave them out
        Sticky = "sticky",
        /// each block needs them
        EachBlock = "each-block",
    }

    /// Whether G84 needs a spindle that turns clockwise, and G74 one that turns counterclockwise. The manual
    /// names no such error, and each cycle starts the other direction for the way out.
    TapDirection = "cycles.tap-direction" {
        /// whether and in whichever direction it turns
        Any = "any",
        /// it must turn as the thread is cut
        AsCut = "as-cut",
    }

    /// Whether G84 and G74 disable the overrides: LinuxCNC disables them until the end of the cycle, in NIST
    /// the lower one counts for feed and speed.
    TapOverrideSwitches = "cycles.tap-override-switches" {
        /// they are disabled while it cuts and feeds out
        Disabled = "disabled",
        /// they stay as they are
        Kept = "kept",
    }

    /// Whether the spindle turns as before after G84 and G74. The list of what they do ends with the
    /// overrides.
    TapReturn = "cycles.tap-return" {
        /// it stays as it turned on the way out
        Reversed = "reversed",
        /// it turns as before
        AsBefore = "as-before",
    }

    /// Whether G84 and G74 need P. In LinuxCNC both dwell for P seconds, in NIST G84 has no dwell.
    TapWithoutDwell = "cycles.tap-without-dwell" {
        /// they need it
        Refused = "refused",
        /// without it they dwell for zero seconds
        Zero = "zero",
        /// they do not dwell
        None = "none",
    }
}
