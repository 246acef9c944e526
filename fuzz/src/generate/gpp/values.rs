//! Numbers, texts and names.

use crate::generate::Entropy;

/// Numbers that lie where something is decided.
const NUMBERS: &[&str] = &[
    "0",
    "1",
    "2",
    "3",
    "0.5",
    "1.5",
    "2.5",
    "0.125",
    "0.0625",
    "1.005",
    "1.0001",
    "1.0002",
    "1.0006",
    "0.0004",
    "0.0005",
    "0.0006",
    "99.9996",
    "9.95",
    "10",
    "99",
    "100",
    "999.5",
    "1000",
    "12345",
    "0.1",
    "0.2",
    "0.3",
    ".25",
    "007",
    "0.00000000000001",
    "3.14159265358979",
];

/// Numbers that few formats hold.
const LARGE: &[&str] =
    &["99999.9995", "123456", "99999999999999", "1234567890123456789", "4503599627370496.5"];

/// Texts.
const TEXTS: &[&str] = &[
    "",
    "a",
    "A",
    "G00",
    "N",
    " ",
    "// no comment",
    "* none",
    "x;y:z",
    "[",
    "1",
    "\u{e9}",
    "END_IF;",
];

/// A number without a sign.
pub(super) fn number(entropy: &mut Entropy<'_>) -> String {
    match entropy.below(60) {
        0..=38 => (*entropy.pick(NUMBERS)).to_owned(),
        39..=49 => entropy.below(20).to_string(),
        50..=58 => format!("{}.{}", entropy.below(120), entropy.below(10_000)),
        _ => (*entropy.pick(LARGE)).to_owned(),
    }
}

/// A text in double quotes.
pub(super) fn text(entropy: &mut Entropy<'_>) -> String {
    format!("\"{}\"", entropy.pick(TEXTS))
}

/// A word in one of its spellings.
pub(super) fn spelled(word: &str, entropy: &mut Entropy<'_>) -> String {
    if entropy.chance(10) { word.to_ascii_lowercase() } else { word.to_owned() }
}
