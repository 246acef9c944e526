//! Text of a controller that nothing obeys: no terminal, and no reader who sees letters in an order that they do not
//! have.

use std::borrow::Cow;

/// The text with everything that is no letter, but an order to whoever shows it, written out as JSON does; lines stay
/// lines.
pub fn escape_text(text: &str) -> Cow<'_, str> {
    if !text.contains(is_unsafe) {
        return Cow::Borrowed(text);
    }
    let written =
        |c: char| if is_unsafe(c) { format!("\\u{:04x}", u32::from(c)) } else { c.into() };
    Cow::Owned(text.chars().map(written).collect())
}

/// The text in one line, with everything written out that is no letter.
pub fn escape_line(text: &str) -> String {
    escape_text(text).replace('\n', "\\n")
}

/// Control characters but the end of a line and the tabulator, and those that turn the direction of writing.
fn is_unsafe(c: char) -> bool {
    let turns = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{061c}');
    turns || c.is_control() && !matches!(c, '\n' | '\t')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_written_out() {
        assert_eq!(escape_text("plain\n\ttext – ü"), "plain\n\ttext – ü");
        assert_eq!(escape_text("a\x1b]0;owned\x07b\r"), "a\\u001b]0;owned\\u0007b\\u000d");
        assert_eq!(escape_text("\u{202e}txt\u{9b}2J"), "\\u202etxt\\u009b2J");
        assert_eq!(escape_line("a\nb"), "a\\nb");
    }
}
