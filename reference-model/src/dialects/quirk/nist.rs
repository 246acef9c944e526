//! Each quirk of `nist`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

quirks! {
    super::first::NIST;

    /// In incremental distance mode a canned cycle repeats the number of the last X, Y or Z word for an axis
    /// of its plane that has no word.
    CYCLE_REPEATS_LAST_WORD = "nist.cycle-repeats-last-word",
    /// A canned cycle is accepted while the cutter is compensated.
    CYCLE_UNDER_COMPENSATION = "nist.cycle-under-compensation",
    /// A line number may have any number of digits if it is not above 99999.
    FIVE_DIGITS = "nist.five-digits",
    /// G28 and G30 do not move the rotary axes. Their coordinates are nevertheless those of the stored
    /// position.
    HOME_WITHOUT_ROTARY = "nist.home-without-rotary",
    /// Under inverse time a straight move has a feed rate of at least 0.1 length units per minute.
    INVERSE_TIME_AT_LEAST_A_TENTH = "nist.inverse-time-at-least-a-tenth",
    /// A canned cycle is accepted under inverse time, with or without F, and feeds at the rate of before.
    INVERSE_TIME_CYCLE = "nist.inverse-time-cycle",
    /// The offset that `#5211` to `#5216` hold applies from the start of the next run.
    OFFSET_AT_START = "nist.offset-at-start",
    /// After the program end the G92 offset of Y and Z is still in force, although the coordinates do not
    /// have it any more.
    OFFSET_KEPT_AT_END = "nist.offset-kept-at-end",
    /// ROUND of a number that 32 bits do not hold is -2147483648.
    ROUND_32_BITS = "nist.round-32-bits",
    /// A line has at most 253 bytes without its line end, not 256 characters.
    SHORTER_LINES = "nist.shorter-lines",
    /// A coordinate system is selected while the cutter is compensated.
    SYSTEMS_UNDER_COMPENSATION = "nist.systems-under-compensation",
    /// G43 with an offset of zero is reported as G49.
    ZERO_LENGTH_OFF = "nist.zero-length-off",
}
