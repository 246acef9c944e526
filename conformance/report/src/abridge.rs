//! Long texts, as a person reads them: lists without what both sides have, and lines of limited width.

use gaugeblock_compare::alignment::{Segment, segments};

/// Longest text that is printed whole, in characters.
const WHOLE_MAX: usize = 160;
/// Most characters of a line on a terminal.
const WIDTH: usize = 118;
/// Between the items of a list of effects.
const BETWEEN: &str = "; ";

/// An assertion and what was found. Of long lists of effects, only what differs is left, with one item before and
/// after.
pub(super) fn abridged(said: &str, found: &str) -> (String, String) {
    if said.len().max(found.len()) <= WHOLE_MAX || !said.starts_with("effects") {
        return (said.to_owned(), found.to_owned());
    }
    let (claim, list) = said.split_once(": ").unwrap_or(("", said));
    let expected: Vec<_> = list.split(BETWEEN).collect();
    let found: Vec<_> = found.split(BETWEEN).collect();
    let (mut left, mut right) = (Vec::new(), Vec::new());
    let all = segments(&expected, &found);
    for (place, segment) in all.iter().enumerate() {
        match segment {
            Segment::Different(one, other) => {
                left.extend_from_slice(&expected[one.clone()]);
                right.extend_from_slice(&found[other.clone()]);
            }
            Segment::Equal(one, _) => {
                let same = &expected[one.clone()];
                let before = if place > 0 { 1 } else { 0 };
                let after = if place + 1 < all.len() { 1 } else { 0 };
                let kept: Vec<&str> = if same.len() <= before + after + 1 {
                    same.to_vec()
                } else {
                    let (first, last) = (&same[..before], &same[same.len() - after..]);
                    first.iter().copied().chain(["…"]).chain(last.iter().copied()).collect()
                };
                left.extend_from_slice(&kept);
                right.extend_from_slice(&kept);
            }
        }
    }
    (format!("{claim}: {}", left.join(BETWEEN)), right.join(BETWEEN))
}

/// A text in lines of limited width, all but the first with this indentation.
pub(super) fn wrapped(text: &str, indentation: usize) -> String {
    let mut lines = String::new();
    let mut width = indentation;
    for word in text.split_inclusive(' ') {
        let length = word.chars().count();
        if width + word.trim_end().chars().count() > WIDTH && width > indentation {
            lines.truncate(lines.trim_end().len());
            lines.push('\n');
            lines.push_str(&" ".repeat(indentation));
            width = indentation;
        }
        lines.push_str(word);
        width += length;
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn of_long_lists_what_differs_is_left() {
        let effects = |ends: &[u32]| -> String {
            let all: Vec<_> =
                ends.iter().map(|x| format!("straight_traverse end=(x{x})")).collect();
            all.join("; ")
        };
        let said = format!("effects at 2: {}", effects(&[1, 2, 3, 4, 5, 6, 7]));
        let (expected, found) = abridged(&said, &effects(&[1, 2, 3, 4, 5, 9, 7]));
        let short = |x| format!("…; {}", effects(&[5, x, 7]));
        assert_eq!(expected, format!("effects at 2: {}", short(6)));
        assert_eq!(found, short(9));
        assert_eq!(abridged("accepted", "refused"), ("accepted".to_owned(), "refused".to_owned()));
    }

    #[test]
    fn wrapped_lines_are_narrow_and_lose_no_word() {
        let text = "word ".repeat(60);
        let lines = wrapped(&text, 13);
        assert!(lines.lines().all(|line| line.chars().count() <= WIDTH));
        assert!(lines.lines().skip(1).all(|line| line.starts_with(&" ".repeat(13))));
        assert_eq!(lines.split_whitespace().count(), 60);
        assert_eq!(wrapped("short", 3), "short");
    }
}
