//! Each choice of `pause`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::PAUSE;

    /// What cycle start does while the program pauses at M0 or M1: EMC2 2.5 goes on by it, the later texts
    /// name resume.
    CycleStart = "pause.cycle-start" {
        /// only resume lets the program go on
        Refused = "refused",
        /// the program goes on at the following block
        GoesOn = "goes-on",
    }

    /// Whether a dwell during which the operator pauses the program continues to its end, after which the
    /// program stops, or is paused too. The section on G4 says how long it lasts, and not under a pause.
    DuringDwell = "pause.during-dwell" {
        /// its seconds are counted all the same
        GoesOn = "goes-on",
        /// what is left of it comes after the resume
        StandsStill = "stands-still",
    }

    /// Whether there is an optional stop: in LinuxCNC M1 stops while a switch is on, Grbl accepts M1 and
    /// ignores it.
    OptionalStop = "pause.optional-stop" {
        /// M1 stops while the switch is on
        Switch = "switch",
        /// M1 does nothing
        Ignored = "ignored",
    }

    /// Which of M30 and M60 ends the program and which pauses it: EMC2 2.5's table calls M30 with M60 a pause
    /// and M60 an end, its sections say the contrary.
    PalletCodes = "pause.pallet-codes" {
        /// M30 ends the program, M60 pauses it
        Sections = "sections",
        /// M60 ends the program, M30 pauses it
        Table = "table",
    }
}
