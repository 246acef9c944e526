//! Each choice of `nct`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::NCT;

    /// In which unit the angles of functions are.
    Angles = "nct.angles" {
        /// degrees
        Degrees = "degrees",
        /// radians
        Radians = "radians",
    }

    /// What becomes of G, L and P in a block that is taken as the arguments of a modal call.
    BlockArguments = "nct.block-arguments" {
        /// they are left out
        LeftOut = "left-out",
        /// they are `#10`, `#12` and `#16`
        OwnNumbers = "own-numbers",
    }

    /// What G67 does where no modal call is in force.
    CancelWithoutCall = "nct.cancel-without-call" {
        /// nothing
        NoEffect = "no-effect",
        /// it is refused
        Refused = "refused",
    }

    /// How deep calls nest.
    Depth = "nct.depth" {
        /// four macro levels, eight calls in all
        Four = "four",
        /// five macro levels, fifteen calls in all
        Five = "five",
    }

    /// In which unit P of G4 is.
    Dwell = "nct.dwell" {
        /// seconds
        Seconds = "seconds",
        /// milliseconds
        Milliseconds = "milliseconds",
    }

    /// Where FIX and FUP round numbers below zero.
    FixFup = "nct.fix-fup" {
        /// towards zero, and away from it
        ByMagnitude = "by-magnitude",
        /// down, and up
        FloorAndCeiling = "floor-and-ceiling",
    }

    /// Whether there are other functions than COS and NOT, and MOD.
    Functions = "nct.functions" {
        /// those of the rule nct.functions
        Usual = "usual",
        /// none that no document names
        Documented = "documented",
    }

    /// Whether there are WHILE, DO and END.
    Loops = "nct.loops" {
        /// there are
        Accepted = "accepted",
        /// there are none
        Refused = "refused",
    }

    /// What M99 does in the main program.
    MainReturn = "nct.main-return" {
        /// it begins again
        BeginsAgain = "begins-again",
        /// it is refused
        Refused = "refused",
    }

    /// What the local variables are when a call is repeated.
    RepeatedLocals = "nct.repeated-locals" {
        /// what the repetition before left
        Kept = "kept",
        /// the arguments again
        Reloaded = "reloaded",
    }

    /// To which set of I, J and K a letter belongs.
    SetAdvance = "nct.set-advance" {
        /// its n-th one to the n-th set
        ByLetter = "by-letter",
        /// to the set in progress; a repeated letter opens the next
        BySet = "by-set",
    }

    /// Whether 32 bits are a number with a sign.
    ThirtyTwoBits = "nct.thirty-two-bits" {
        /// with a sign
        Signed = "signed",
        /// without
        Unsigned = "unsigned",
    }
}
