//! Each choice of `tool`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

choices! {
    super::first::TOOL;

    /// Which spindles M6 stops on a machine with several. The documents name one spindle only.
    ChangeSpindles = "tool.change-spindles" {
        /// every spindle
        All = "all",
        /// spindle 0
        First = "first",
    }

    /// Whether a tool may be changed while cutter compensation is on. The chapter names no such error;
    /// another place of the last manual does.
    ChangeUnderCompensation = "tool.change-under-compensation" {
        /// it may
        Accepted = "accepted",
        /// it may not
        Refused = "refused",
    }

    /// Whether M6 needs a T since the last tool change. The chapter says only which T counts; another place
    /// of the last manual names the error.
    ChangeWithoutSelection = "tool.change-without-selection" {
        /// it does
        Refused = "refused",
        /// it does not, and the tool stays
        Accepted = "accepted",
    }

    /// Whether the cutter can be compensated in the ZX plane: LinuxCNC has XY and ZX, NIST has XY alone.
    CompensationInZx = "tool.compensation-in-zx" {
        /// it can
        Accepted = "accepted",
        /// the XY plane has to be selected
        Refused = "refused",
    }

    /// Whether a T that names no tool may be selected. One sentence has the spindle empty after a change to
    /// an empty slot, another one refuses a number that is not in the tool table.
    EmptySlot = "tool.empty-slot" {
        /// the spindle is empty after the change
        Accepted = "accepted",
        /// the selection is refused
        Refused = "refused",
    }

    /// Whether G10 L1, L10 and L11 may have a tool and nothing to set of it: the syntax has axis words, an
    /// example has none, and no error is listed.
    EntryWithoutWords = "tool.entry-without-words" {
        /// the entry is written as it is
        Accepted = "accepted",
        /// there is nothing to set
        Refused = "refused",
    }

    /// What G43 does with H0, and without H: in LinuxCNC it applies the offset of the tool in the spindle, in
    /// NIST H0 is an offset of zero, and H is required. D0 of G41 is the same with the radius.
    LengthNumberZero = "tool.length-number-zero" {
        /// the tool in the spindle
        Spindle = "spindle",
        /// H0 is an offset of zero, and no H is refused
        Zero = "zero",
    }

    /// Whether G49 can be in a block with a motion: in LinuxCNC it acts before the motion, Grbl counts it
    /// among the codes that use axis words.
    LengthOffWithMotion = "tool.length-off-with-motion" {
        /// the offset is cancelled, then the move is made
        Accepted = "accepted",
        /// two codes use axis words
        Refused = "refused",
    }

    /// Whether G43, G43.1, G43.2 and G49 are allowed while cutter compensation is on. The sections on them
    /// name no such error.
    LengthUnderCompensation = "tool.length-under-compensation" {
        /// the offset changes
        Accepted = "accepted",
        /// it cannot
        Refused = "refused",
    }

    /// What the numbers of D and H are: those of tools, or those of slots of the changer, an empty one
    /// without a tool.
    OffsetNumbers = "tool.offset-numbers" {
        /// the number of a tool in the tool table
        Tool = "tool",
        /// the number of a slot of the changer
        Slot = "slot",
    }

    /// Where the tool that was in the spindle goes on a machine whose tools change places: one text says its
    /// own slot; the later ones say the magazine, and their machine exchanges both tools.
    OldToolPlace = "tool.old-tool-place" {
        /// to its own slot
        ItsOwnSlot = "its-own-slot",
        /// to the slot from which the new one was taken
        SlotOfTheNew = "slot-of-the-new",
    }

    /// What the number of T is: that of a slot of the changer, or that of a tool. The older text says slot;
    /// the last one says pocket in one place, and tool in another.
    SelectedBy = "tool.selected-by" {
        /// the number of a tool in the tool table
        Number = "number",
        /// the number of a slot of the changer
        Slot = "slot",
    }

    /// Whether M61 is allowed in a program. The text speaks of MDI and manual mode.
    SetNumberInProgram = "tool.set-number-in-program" {
        /// it may
        Accepted = "accepted",
        /// it belongs to MDI and manual mode
        Refused = "refused",
    }

    /// Whether M61 may name a tool that the tool table does not hold. The documents name no such error.
    SetNumberUnknown = "tool.set-number-unknown" {
        /// it may not
        Refused = "refused",
        /// it may
        Accepted = "accepted",
    }
}
