//! Each choice of `offsets`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::OFFSETS;

    /// Whether an offset that is in force can be changed while cutter compensation is on, by G52, G92, or G10
    /// L2 and L20 for the active coordinate system. It is not among their errors.
    ChangeUnderCompensation = "offsets.change-under-compensation" {
        /// the offset changes
        Accepted = "accepted",
        /// it cannot
        Refused = "refused",
    }

    /// Whether parameters say if the offset of G92 applies, and how coordinate systems are turned: in
    /// LinuxCNC `#5210`, `#5230` and so on do, in NIST these are parameters like any other.
    FlagAndRotation = "offsets.flag-and-rotation" {
        /// they do
        Stored = "stored",
        /// they are not used
        None = "none",
    }

    /// What G92 does to the local offset of an axis for which it has no word: LinuxCNC takes it away, Grbl
    /// changes only axes that have a word.
    PositionOtherAxes = "offsets.position-other-axes" {
        /// it is zero
        Cleared = "cleared",
        /// it is as it was
        Kept = "kept",
    }

    /// What P0 of G10 L2 is: LinuxCNC means the active coordinate system, NIST has systems 1 to 9 only.
    SetActiveNumber = "offsets.set-active-number" {
        /// the active coordinate system
        Active = "active",
        /// no coordinate system
        Refused = "refused",
    }

    /// Whether G10 L2 needs an axis word: LinuxCNC calls all of them optional, Grbl lists their absence as an
    /// error.
    SetWithoutAxes = "offsets.set-without-axes" {
        /// nothing changes
        Accepted = "accepted",
        /// a word is missing
        Refused = "refused",
    }

    /// In which length unit stored offsets, positions and tools are: in LinuxCNC in the machine's; NIST's
    /// report does not say, and its program stores and reads the numbers as they are.
    StoredUnit = "offsets.stored-unit" {
        /// in that of the machine
        Machine = "machine",
        /// in that of the program when they are stored or read
        AsProgrammed = "as-programmed",
    }

    /// How many coordinate systems there are: nine from G54 to G59.3, or six from G54 to G59.
    Systems = "offsets.systems" {
        /// G10 sets systems 1 to 9
        Nine = "nine",
        /// G10 sets systems 1 to 6, and refuses P7 to P9 as it refuses P10
        Six = "six",
    }
}
