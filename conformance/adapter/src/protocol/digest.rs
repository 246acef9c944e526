//! The digest of an outcome: SHA-256 of its canonical JSON (RFC 8785), as lower-case hexadecimal digits.
//!
//! Canonical JSON has no white space, the members of an object in the order of their names, and numbers as ECMAScript
//! prints them. An adapter in any language computes the same bytes.

use std::fmt::Write as _;

use gaugeblock_vocabulary::Outcome;
use serde_json::Value;
use sha2::{Digest as _, Sha256};

/// The canonical text of an outcome.
pub fn canonical(outcome: &Outcome) -> String {
    // Every outcome can be written as JSON, so this never fails.
    let value = serde_json::to_value(outcome).unwrap_or(Value::Null);
    let mut text = String::new();
    write(&value, &mut text);
    text
}

/// The digest of an outcome.
pub fn digest(outcome: &Outcome) -> String {
    let text = canonical(outcome);
    Sha256::digest(text.as_bytes()).iter().fold(String::new(), |mut hex, byte| {
        // Writing to a string never fails.
        let _taken = write!(hex, "{byte:02x}");
        hex
    })
}

fn write(value: &Value, text: &mut String) {
    match value {
        Value::Object(members) => {
            let mut members: Vec<_> = members.iter().collect();
            members.sort_by(|(a, _), (b, _)| a.encode_utf16().cmp(b.encode_utf16()));
            text.push('{');
            for (place, (name, value)) in members.into_iter().enumerate() {
                if place > 0 {
                    text.push(',');
                }
                text.push_str(&Value::from(name.as_str()).to_string());
                text.push(':');
                write(value, text);
            }
            text.push('}');
        }
        Value::Array(elements) => {
            text.push('[');
            for (place, element) in elements.iter().enumerate() {
                if place > 0 {
                    text.push(',');
                }
                write(element, text);
            }
            text.push(']');
        }
        Value::Number(number) => {
            text.push_str(&ecmascript_number(number.as_f64().unwrap_or_default()));
        }
        Value::Null | Value::Bool(_) | Value::String(_) => text.push_str(&value.to_string()),
    }
}

/// A number as ECMAScript prints it: the fewest digits that come back, a power of ten only below 1e-6 and from 1e21.
fn ecmascript_number(number: f64) -> String {
    if number == 0.0 {
        return "0".to_owned();
    }
    if (1e-6..1e21).contains(&number.abs()) {
        return number.to_string();
    }
    let text = format!("{number:e}");
    if text.contains("e-") { text } else { text.replace('e', "e+") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_printed_as_ecmascript_does() {
        for (number, expected) in [
            (-0.0, "0"),
            (1.0, "1"),
            (-12.5, "-12.5"),
            (0.000_001, "0.000001"),
            (0.000_000_1, "1e-7"),
            (1.5e-9, "1.5e-9"),
            (1e20, "100000000000000000000"),
            (1e21, "1e+21"),
            (-1.25e300, "-1.25e+300"),
            (333_333_333.333_333_3, "333333333.3333333"),
        ] {
            assert_eq!(ecmascript_number(number), expected);
        }
    }

    #[test]
    fn members_are_sorted_without_white_space() {
        let value =
            serde_json::json!({"b": [1.0, {}, [], "\n\u{e9}\""], "a": {"z": null, "y": true}});
        let mut text = String::new();
        write(&value, &mut text);
        assert_eq!(text, "{\"a\":{\"y\":true,\"z\":null},\"b\":[1,{},[],\"\\n\u{e9}\\\"\"]}");
    }
}
