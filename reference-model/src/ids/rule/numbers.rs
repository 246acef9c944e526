//! Each rule of `numbers`; written from the pages by `cargo run -p gaugeblock-suite --bin model-ids`.

rules! {
    super::first::NUMBERS;

    /// Digits may be left out before or after the decimal point, not on both sides.
    DIGITS = "numbers.digits",
    /// A second sign or a second decimal point is refused.
    FORM = "numbers.form",
    /// A number may have any number of digits; about seventeen significant ones count.
    MANY_DIGITS = "numbers.many-digits",
    /// Where an integer is meant, a decimal within 0.0001 of one is taken as that integer.
    NEAR_INTEGER = "numbers.near-integer",
    /// A number has no exponent: what looks like one is not part of it and is refused.
    NO_EXPONENT = "numbers.no-exponent",
    /// Where an integer is meant, a decimal that is not within 0.0001 of one is refused.
    NOT_NEAR_INTEGER = "numbers.not-near-integer",
    /// A number may begin with a plus or minus sign; without one it is positive.
    SIGN = "numbers.sign",
    /// Leading and trailing zeros change no number.
    ZEROS = "numbers.zeros",
}
