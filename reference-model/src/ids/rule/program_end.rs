//! Each rule of `program-end`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::PROGRAM_END;

    /// The program end switches cutter compensation off.
    COMPENSATION = "program-end.compensation",
    /// The program end switches mist and flood off.
    COOLANT = "program-end.coolant",
    /// The program end selects absolute distance mode.
    DISTANCE = "program-end.distance",
    /// M2 ends the program, and so does M30.
    ENDS = "program-end.ends",
    /// A program end keeps F and S; whether it keeps an F of G93 or G95 is a choice.
    FEED_KEPT = "program-end.feed-kept",
    /// The program end selects feed per minute.
    FEED_MODE = "program-end.feed-mode",
    /// A program end ends the program from inside a loop or a condition.
    INSIDE_CONTROL = "program-end.inside-control",
    /// A program end keeps units, arc distance, lathe, path and retract mode, spindle mode and tool offset.
    KEPT = "program-end.kept",
    /// The program end comes last in its block, after motion and everything else.
    LAST_IN_BLOCK = "program-end.last-in-block",
    /// Blocks after the program end are not executed, nor even read.
    LINES_AFTER = "program-end.lines-after",
    /// Whether the program end cancels the local offset, and keeps its parameters, is a choice.
    LOCAL_OFFSET = "program-end.local-offset",
    /// After the program end the controller is in MDI mode, so that a block by hand is executed.
    MDI_FOLLOWS = "program-end.mdi-follows",
    /// A file without program end that is not wrapped in percent signs is refused.
    MISSING = "program-end.missing",
    /// The program end changes the controller from auto to MDI mode.
    MODE = "program-end.mode",
    /// The program end sets the motion mode to straight feed.
    MOTION = "program-end.motion",
    /// The program end enables the feed and speed overrides.
    OVERRIDES = "program-end.overrides",
    /// M30 exchanges the pallet shuttles before it ends the program; M2 does not.
    PALLET = "program-end.pallet",
    /// Parameters keep their values at the program end.
    PARAMETERS_KEPT = "program-end.parameters-kept",
    /// A percent sign at the end of a file is not a program end: the modes stay as the program left them.
    PERCENT = "program-end.percent",
    /// The program end selects the XY plane.
    PLANE = "program-end.plane",
    /// After the program end cycle start starts the program at the beginning of the file.
    RESTART = "program-end.restart",
    /// The program end stops the spindle.
    SPINDLE = "program-end.spindle",
    /// The program end selects the first coordinate system.
    WORK_OFFSET = "program-end.work-offset",
}
