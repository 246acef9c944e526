//! Escapes untrusted text: terminal control sequences and marks that reorder letters.

use std::borrow::Cow;

/// The text with control characters written as in JSON; ends of lines stay.
pub fn escape_text(text: &str) -> Cow<'_, str> {
    if !text.contains(is_unsafe) && !text.contains(COMMAND) {
        return Cow::Borrowed(text);
    }
    let written =
        |c: char| if is_unsafe(c) { format!("\\u{:04x}", u32::from(c)) } else { c.into() };
    let escaped: String = text.chars().map(written).collect();
    Cow::Owned(escaped.replace(COMMAND, "#\\u0023["))
}

/// What some runners of a CI obey anywhere in a line, such as `##[error]`.
const COMMAND: &str = "##[";

/// The text in one line, with control characters written as in JSON.
pub fn escape_line(text: &str) -> String {
    escape_text(text).replace('\n', "\\n")
}

/// Control characters except end of line and tabulator, marks that change the direction of writing, and what is no
/// character of Unicode, which XML does not allow.
fn is_unsafe(c: char) -> bool {
    let turns = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}' | '\u{061c}');
    let is_none = u32::from(c) & 0xfffe == 0xfffe || matches!(c, '\u{fdd0}'..='\u{fdef}');
    turns || is_none || c.is_control() && !matches!(c, '\n' | '\t')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_control_sequences_are_escaped() {
        assert_eq!(escape_text("plain\n\ttext – ü"), "plain\n\ttext – ü");
        assert_eq!(escape_text("a\x1b]0;owned\x07b\r"), "a\\u001b]0;owned\\u0007b\\u000d");
        assert_eq!(escape_text("a\u{fffe}b\u{1ffff}"), "a\\ufffeb\\u1ffff");
        assert_eq!(escape_text("##[error]forged"), "#\\u0023[error]forged");
        assert_eq!(escape_line("main.ngc\n::error::forged"), "main.ngc\\n::error::forged");
        assert_eq!(escape_text("\u{202e}txt\u{9b}2J"), "\\u202etxt\\u009b2J");
        assert_eq!(escape_line("a\nb"), "a\\nb");
    }
}
