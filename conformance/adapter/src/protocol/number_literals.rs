//! Numbers that are not JSON: the literals that Python writes for numbers that are not finite, and literals beyond the
//! range of 64 bits.
//!
//! They are results of the controller, so that the referee reads them. They are rare, so that only a line that is not
//! valid otherwise is searched for them.

use serde::de::DeserializeOwned;

/// Reads JSON whose numbers need not be finite.
///
/// # Errors
/// It is not valid; the message has the place in the line.
pub(crate) fn read_json<T: DeserializeOwned>(line: &[u8]) -> serde_json::Result<T> {
    let read = serde_json::from_slice(line);
    match read.is_err().then(|| with_texts(line)).flatten() {
        Some(line) => serde_json::from_slice(&line),
        None => read,
    }
}

/// Replaces each number that is not JSON by a string. Returns `None` if the line has no such number.
pub(super) fn with_texts(line: &[u8]) -> Option<Vec<u8>> {
    let mut written = Vec::with_capacity(line.len());
    let (mut rest, mut has_changed) = (line, false);
    while let Some(first) = rest.first() {
        let length = match first {
            b'"' => text_length(rest),
            b'-' | b'0'..=b'9' | b'N' | b'I' => {
                let is_of_number =
                    |byte: &u8| byte.is_ascii_alphanumeric() || matches!(byte, b'-' | b'+' | b'.');
                rest.iter().take_while(|byte| is_of_number(byte)).count()
            }
            _ => 1,
        };
        let (token, after) = rest.split_at(length);
        let text = text_of(token);
        has_changed |= text.is_some();
        written.extend_from_slice(text.map_or(token, str::as_bytes));
        rest = after;
    }
    has_changed.then_some(written)
}

/// The length of a text in quotes.
fn text_length(line: &[u8]) -> usize {
    let mut escaped = false;
    let end = line.iter().skip(1).position(|byte| {
        let ends = *byte == b'"' && !escaped;
        escaped = *byte == b'\\' && !escaped;
        ends
    });
    end.map_or(line.len(), |end| end + 2)
}

fn text_of(token: &[u8]) -> Option<&'static str> {
    match token {
        b"NaN" => Some("\"nan\""),
        b"Infinity" => Some("\"inf\""),
        b"-Infinity" => Some("\"-inf\""),
        [b'-' | b'0'..=b'9', ..] => {
            let number: f64 = std::str::from_utf8(token).ok()?.parse().ok()?;
            let is_digit = token.iter().any(u8::is_ascii_digit);
            (number.is_infinite() && is_digit).then_some(if number > 0.0 {
                "\"inf\""
            } else {
                "\"-inf\""
            })
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_numbers_that_are_not_json_become_texts() {
        for (line, expected) in [
            (r#"{"x":NaN,"y":-Infinity}"#, Some(r#"{"x":"nan","y":"-inf"}"#)),
            (r#"[Infinity,1e400,-1e400]"#, Some(r#"["inf","inf","-inf"]"#)),
            (r#"[1e-400,-0,1E308,-inf,nan]"#, None),
            (r#"{"NaN":"1e999 \" NaN","x":1}"#, None),
            (r#"["\\",NaN,"NaN]"#, Some(r#"["\\","nan","NaN]"#)),
        ] {
            let found = with_texts(line.as_bytes());
            assert_eq!(found.as_deref(), expected.map(str::as_bytes), "{line}");
        }
    }

    #[test]
    fn number_too_small_reads_as_zero() {
        let read: Vec<f64> = read_json(b"[1e-400, -0]").unwrap();
        assert!(read.iter().all(|number| number.abs() <= 0.0), "{read:?}");
    }
}
