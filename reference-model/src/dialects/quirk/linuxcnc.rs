//! Each quirk of `linuxcnc`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

quirks! {
    super::first::LINUXCNC;

    /// The program end leaves the controller in auto mode.
    AUTO_AFTER_PROGRAM_END = "linuxcnc.auto-after-program-end",
    /// A request for auto mode while a program runs in it drops the program without a word.
    AUTO_WHILE_RUNNING = "linuxcnc.auto-while-running",
    /// Cycle start is refused while the program pauses at M60; resume lets it go on.
    CYCLE_START_WHILE_PAUSED = "linuxcnc.cycle-start-while-paused",
    /// A block that is refused while it is read ahead ends the program at once, although blocks before it
    /// have not been executed.
    FAULT_READ_AHEAD = "linuxcnc.fault-read-ahead",
    /// Under G95 a change of the length unit does not convert F.
    FEED_PER_REVOLUTION_UNIT = "linuxcnc.feed-per-revolution-unit",
    /// The machine skips an arc if the square of its radius exceeds the largest number.
    GREAT_ARC = "linuxcnc.great-arc",
    /// Before the first G64 a path is blended within a thousandth of an inch, and not as fast as possible.
    INITIAL_TOLERANCE = "linuxcnc.initial-tolerance",
    /// M66 with the number of no input is accepted up to 63 and reads zero.
    INPUT_NUMBER = "linuxcnc.input-number",
    /// Under G93 a change of the length unit converts F.
    INVERSE_TIME_UNIT = "linuxcnc.inverse-time-unit",
    /// An abort brings back the modes that were in force at the last motion of the main program.
    MODES_OF_LAST_MOTION = "linuxcnc.modes-of-last-motion",
    /// A move in place is dropped: nothing holds it, and outputs of M62, M63 and M67 wait for the move after
    /// it.
    MOVE_IN_PLACE = "linuxcnc.move-in-place",
    /// M19 for a spindle that is locked sets angle and direction, but does not command the spindle to turn
    /// there.
    ORIENT_WHILE_LOCKED = "linuxcnc.orient-while-locked",
    /// M64, M65 and M68 with the number of no output show an error and change nothing, and the program goes
    /// on. Of a larger number than 255 eight bits count.
    OUTPUT_NUMBER_AT_ONCE = "linuxcnc.output-number-at-once",
    /// M62, M63 and M67 with the number of no output are accepted, and nothing changes. Of a larger number
    /// than 255 eight bits count.
    OUTPUT_NUMBER_WITH_MOTION = "linuxcnc.output-number-with-motion",
    /// What M62, M63 and M67 set changes although the next motion is held where it begins.
    OUTPUT_WHILE_HELD = "linuxcnc.output-while-held",
    /// At the program end, and after M6, M61 and M66, the interpreter reads the controlled point back from
    /// the machine, where it has lost it.
    POINT_READ_BACK = "linuxcnc.point-read-back",
    /// M49 and M50 P0 disable the rapid override, too.
    RAPID_OVERRIDE_DISABLED = "linuxcnc.rapid-override-disabled",
    /// When a program starts `_value` still has what the last sub of the program before it has returned.
    RETURNED_VALUE_KEPT = "linuxcnc.returned-value-kept",
    /// After M6 for the tool that is in the spindle already, the next M6 needs no T.
    SELECTION_KEPT = "linuxcnc.selection-kept",
    /// A speed releases the brake of a spindle that is stopped; the next stop applies it again.
    SPEED_RELEASES_BRAKE = "linuxcnc.speed-releases-brake",
    /// A speed for a spindle that M19 has oriented unlocks it, and lets it turn again as it turned before.
    SPEED_WHILE_ORIENTED = "linuxcnc.speed-while-oriented",
    /// M6, M61 and M66 set the mode of each spindle to revolutions, although its speed still follows G96.
    SPINDLE_MODE_READ_BACK = "linuxcnc.spindle-mode-read-back",
    /// G74 and G84 are refused in the planes UV, WU and VW.
    TAP_IN_PARALLEL_PLANE = "linuxcnc.tap-in-parallel-plane",
    /// A rapid override of zero does not hold the move to where the tool is changed.
    TOOL_CHANGE_MOVE = "linuxcnc.tool-change-move",
    /// A change to MDI mode sets `_value` and `_value_returned` to zero.
    VALUE_LOST_IN_MDI = "linuxcnc.value-lost-in-mdi",
    /// M66 with L above 4 is accepted, and ends with its time-out, whatever the input does.
    WAIT_MODE_TIMES_OUT = "linuxcnc.wait-mode-times-out",
}
