//! Each quirk of `nist`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

quirks! {
    super::first::NIST;

    /// Under G91 a canned cycle without a word of an axis of its plane repeats the number of the axis's last
    /// word.
    CYCLE_REPEATS_LAST_WORD = "nist.cycle-repeats-last-word",
    /// A canned cycle is accepted while the cutter is compensated.
    CYCLE_UNDER_COMPENSATION = "nist.cycle-under-compensation",
    /// A line number may have any number of digits if the lowest 32 bits of its value, the highest being the
    /// sign, are not above 99999.
    FIVE_DIGITS = "nist.five-digits",
    /// G28 and G30 do not move the rotary axes. Their coordinates are nevertheless those of the stored
    /// position.
    HOME_WITHOUT_ROTARY = "nist.home-without-rotary",
    /// Under inverse time a straight move has a feed rate of at least 0.1 length units per minute.
    INVERSE_TIME_AT_LEAST_A_TENTH = "nist.inverse-time-at-least-a-tenth",
    /// A canned cycle is accepted under inverse time, with or without F, and feeds at the rate of before.
    INVERSE_TIME_CYCLE = "nist.inverse-time-cycle",
    /// G92 and G92.1 to G92.3 are refused while the cutter is compensated.
    LOCAL_OFFSET_UNDER_COMPENSATION = "nist.local-offset-under-compensation",
    /// The offset that `#5211` to `#5216` hold applies from the start of the next run.
    OFFSET_AT_START = "nist.offset-at-start",
    /// The program end keeps the G92 offset of Y and Z in force, but removes it from the coordinates.
    OFFSET_KEPT_AT_END = "nist.offset-kept-at-end",
    /// A line has at most 253 bytes without its line end, not 256 characters.
    SHORTER_LINES = "nist.shorter-lines",
    /// A line that block delete skips is read, and refused where it is wrong; it is not executed.
    SKIPPED_LINE_IS_READ = "nist.skipped-line-is-read",
    /// A coordinate system is selected while the cutter is compensated.
    SYSTEMS_UNDER_COMPENSATION = "nist.systems-under-compensation",
    /// G43 with an offset of zero is reported as G49.
    ZERO_LENGTH_OFF = "nist.zero-length-off",
}
