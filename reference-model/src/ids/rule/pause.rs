//! Each rule of `pause`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::PAUSE;

    /// M0 pauses the program: the blocks after it are not executed until someone lets it go on.
    ALWAYS = "pause.always",
    /// M0 and M1 are allowed in MDI mode, where the next block can be entered anyway.
    BY_HAND = "pause.by-hand",
    /// Cycle start lets the program go on after M0 and M1, or resume alone does: the documents name different
    /// buttons.
    CYCLE_START = "pause.cycle-start",
    /// A dwell during which the operator pauses the program continues to its end, after which the program
    /// stops, or is paused with it.
    DURING_DWELL = "pause.during-dwell",
    /// A pause comes last in its block, after motion and everything else.
    LAST_IN_BLOCK = "pause.last-in-block",
    /// While a program pauses the controller stays in auto mode, so that a block by hand is refused.
    MDI_REFUSED = "pause.mdi-refused",
    /// While a program pauses the controller stays in auto mode: a request for another mode is refused.
    MODE_KEPT = "pause.mode-kept",
    /// M1 pauses the program while the optional-stop switch is on, and else does not.
    OPTIONAL = "pause.optional",
    /// Whether M1 is an optional stop, or does nothing, is a choice.
    OPTIONAL_STOP = "pause.optional-stop",
    /// M60 exchanges the pallet shuttles and then pauses the program, whatever the optional-stop switch is.
    PALLET = "pause.pallet",
    /// Cycle start lets the program go on at the following block after M60.
    PALLET_RESTART = "pause.pallet-restart",
    /// Resume lets the program go on at the following block after M0 and M1.
    RESUME = "pause.resume",
}
