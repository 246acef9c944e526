//! Each choice of `units-planes`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::UNITS_PLANES;

    /// Whether diameter mode halves the X words of offsets too, those of G10, G43.1 and G52: the documents
    /// speak of moves.
    DiameterOffsets = "units-planes.diameter-offsets" {
        /// an offset is as long as its word says
        MovesOnly = "moves-only",
        /// every X word is a diameter
        EveryWord = "every-word",
    }

    /// What a change of the length unit does to the feed rate: the documents say that feeds are read by the
    /// unit in use, not what becomes of one that is set.
    FeedOverUnitChange = "units-planes.feed-over-unit-change" {
        /// the same feed, expressed in the new unit
        Rescaled = "rescaled",
        /// the same number
        Kept = "kept",
    }

    /// Which length unit is in force before the first G20 or G21.
    InitialUnit = "units-planes.initial-unit" {
        /// millimetres on every machine
        Millimetre = "millimetre",
        /// the machine's own unit
        Machine = "machine",
    }

    /// Whether G17, G18 and G19 can select another plane while cutter compensation is on. LinuxCNC's section
    /// on them names no error; in NIST compensation needs the XY plane.
    PlaneUnderCompensation = "units-planes.plane-under-compensation" {
        /// the plane is selected
        Accepted = "accepted",
        /// it cannot
        Refused = "refused",
    }

    /// Whether G20 and G21 are accepted while cutter compensation is on. LinuxCNC's section on them names no
    /// error; NIST's program refuses them.
    UnitsUnderCompensation = "units-planes.units-under-compensation" {
        /// they are
        Accepted = "accepted",
        /// they are refused, in force or not
        Refused = "refused",
    }
}
