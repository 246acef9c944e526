//! Each choice of `positions`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::POSITIONS;

    /// Which axes go to the stored position by G28 and G30 with axis words: in LinuxCNC those that have a
    /// word, in NIST all of them.
    HomeAxes = "positions.home-axes" {
        /// those that have a word
        Named = "named",
        /// all axes
        All = "all",
    }

    /// Which axes go to the stored position when G28 or G30 has axis words and the coordinate system is
    /// rotated: those of the machine, whose positions are stored, or those of the coordinate system, which
    /// the words name.
    RotatedAxes = "positions.rotated-axes" {
        /// machine X is 1
        Machine = "machine",
        /// X is where the stored position has it
        Program = "program",
    }
}
