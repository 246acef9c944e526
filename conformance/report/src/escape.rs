//! Escapes untrusted text: terminal control sequences and marks that reorder letters.

use std::borrow::Cow;

/// The text with control characters written as in JSON; ends of lines stay.
pub fn escape_text(text: &str) -> Cow<'_, str> {
    if !text.contains(is_unsafe) {
        return Cow::Borrowed(text);
    }
    let written =
        |c: char| if is_unsafe(c) { format!("\\u{:04x}", u32::from(c)) } else { c.into() };
    Cow::Owned(text.chars().map(written).collect())
}

/// The text in one line, with control characters written as in JSON.
pub fn escape_line(text: &str) -> String {
    escape_text(text).replace('\n', "\\n")
}

/// Control characters except end of line and tabulator, and marks that change the direction of writing.
fn is_unsafe(c: char) -> bool {
    let turns = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{061c}');
    turns || c.is_control() && !matches!(c, '\n' | '\t')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_control_sequences_are_escaped() {
        assert_eq!(escape_text("plain\n\ttext – ü"), "plain\n\ttext – ü");
        assert_eq!(escape_text("a\x1b]0;owned\x07b\r"), "a\\u001b]0;owned\\u0007b\\u000d");
        assert_eq!(escape_text("\u{202e}txt\u{9b}2J"), "\\u202etxt\\u009b2J");
        assert_eq!(escape_line("a\nb"), "a\\nb");
    }
}
