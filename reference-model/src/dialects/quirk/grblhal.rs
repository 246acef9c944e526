//! Each quirk of `grblhal`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

quirks! {
    super::first::GRBLHAL;

    /// Eight digits of a number count, zeros before them not; further ones become zeros.
    EIGHT_DIGITS = "grblhal.eight-digits",
    /// The greatest line number is 10,000,000.
    LINE_NUMBER_LIMIT = "grblhal.line-number-limit",
    /// A negative number after G is read as G0, after M as M0.
    NEGATIVE_CODE = "grblhal.negative-code",
    /// Axis words of G10, G28, G30 and G92 are accepted while G80 is active; those of G43.1 are refused.
    WORDS_AFTER_CANCEL = "grblhal.words-after-cancel",
}
