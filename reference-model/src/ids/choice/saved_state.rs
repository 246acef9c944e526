//! Each choice of `saved-state`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::SAVED_STATE;

    /// Whether what M70 saved in the main program is still there when that program has ended, or is aborted,
    /// or when the next one begins. There is one storage location at the level of the main program, and no
    /// sentence says how long it holds.
    AfterRun = "saved-state.after-run" {
        /// the next restore at that level uses it: in a block by hand, or in the next program
        Kept = "kept",
        /// it is gone with the program's end, with an abort, and when a program begins
        Forgotten = "forgotten",
    }

    /// Whether M71 is accepted where nothing was saved. The documents say what it does to a saved state and
    /// no more.
    InvalidateNothing = "saved-state.invalidate-nothing" {
        /// nothing is saved, before and after
        Accepted = "accepted",
        /// there is nothing to invalidate
        Refused = "refused",
    }

    /// Where the motion mode is restored: whether only the modes that the draft lists come back, or every
    /// one. Its list has no G0.
    ListedMotion = "saved-state.listed-motion" {
        /// a motion mode that the list leaves out does not come back
        Listed = "listed",
        /// every motion mode comes back
        Every = "every",
    }

    /// Whether the motion mode belongs to the saved state.
    MotionMode = "saved-state.motion-mode" {
        /// the motion mode stays as it is
        NotRestored = "not-restored",
        /// the motion mode comes back
        Restored = "restored",
    }

    /// Whether M70 and M73 save in one place of a call level or in one each. The documents speak of one place
    /// for the M70 of the main program, and name M70 and M73 in one breath where M71 invalidates.
    Places = "saved-state.places" {
        /// the end of the sub restores what M73 saved; M71 cancels that for good
        Apart = "apart",
        /// the end of a sub with M73 restores what was saved last, by whichever code, unless M71 came after
        /// it
        One = "one",
    }

    /// Whether M72 also restores what M73 saved. The section on M72 calls for an M70 before it at the level;
    /// the one on M71 says of what either code saved that an M72 fails once it is invalidated.
    Restorable = "saved-state.restorable" {
        /// M72 restores what was saved last at its level, by whichever code
        Either = "either",
        /// M72 restores what M70 saved, and is refused where no M70 was executed at its level
        M70Only = "m70-only",
    }
}
