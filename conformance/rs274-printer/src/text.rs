//! What the printer reads from the text of a line: its number and its last comment.

/// Names of comments that act, as they are compared: letters without blanks.
const ACTS: [&[u8]; 8] =
    [b"msg,", b"debug,", b"print,", b"log,", b"logopen,", b"logappend,", b"abort,", b"logclose"];

/// The digits of a line's number, without a fraction; none where it has none.
pub(super) fn number(line: &[u8]) -> Option<&[u8]> {
    let line = after_blanks(line);
    let line = line.strip_prefix(b"/").map_or(line, after_blanks);
    let [b'n' | b'N', rest @ ..] = line else { return None };
    let digits = rest.iter().take_while(|byte| byte.is_ascii_digit()).count();
    rest.get(..digits)
}

/// The text of the last comment in parentheses, before a semicolon, without its leading blanks; none where nothing is
/// between the parentheses.
pub(super) fn comment(line: &[u8]) -> Option<&[u8]> {
    let mut found = None;
    let mut rest = line;
    while let Some(at) = rest.iter().position(|byte| matches!(byte, b'(' | b';')) {
        if rest.get(at) == Some(&b';') {
            break;
        }
        let inner = rest.get(at + 1..)?;
        let close = inner.iter().position(|byte| *byte == b')')?;
        found = inner.get(..close);
        rest = inner.get(close + 1..)?;
    }
    found.filter(|comment| !comment.is_empty()).map(<[u8]>::trim_ascii_start)
}

/// Whether a comment does something, so that it is not printed as a comment.
pub(super) fn acts(comment: &[u8]) -> bool {
    let text = comment.iter().filter(|byte| !matches!(byte, b' ' | b'\t'));
    ACTS.iter().any(|act| {
        let mut text = text.clone();
        act.iter()
            .all(|wanted| text.next().is_some_and(|byte| byte.to_ascii_lowercase() == *wanted))
    })
}

fn after_blanks(text: &[u8]) -> &[u8] {
    let blanks = text.iter().take_while(|byte| matches!(byte, b' ' | b'\t')).count();
    text.get(blanks..).unwrap_or(&[])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_and_comments_are_found() {
        assert_eq!(number(b" / n10.5 g0"), Some(&b"10"[..]));
        assert_eq!(number(b"g0 x1"), None);
        assert_eq!(comment(b"(a) g0 ( b ) x1"), Some(&b"b "[..]));
        assert_eq!(comment(b"(a) g0 ; (b)"), Some(&b"a"[..]));
        assert_eq!(comment(b"(a) (  )"), Some(&b""[..]));
        assert_eq!(comment(b"(a) ()"), None);
        assert!(acts(b" M S G, hi"));
        assert!(!acts(b"message"));
        assert!(!acts(b"m\x0csg, a form feed is not a blank"));
    }
}
