//! Suggestions for unknown words: "did you mean …?".

/// The nearest known word, if one is near.
pub(super) fn suggest<'a>(word: &str, known: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    let near = known.into_iter().map(|other| (distance(word, other), other));
    let (distance, other) = near.min_by_key(|(distance, _)| *distance)?;
    (distance > 0 && distance <= (word.chars().count() / 3).max(1)).then_some(other)
}

/// Adds a suggestion to a message that lists the known words.
pub(crate) fn with_suggestion(message: &str) -> String {
    // The form of serde's message: `unknown field `x`, expected one of `y`, `z``.
    let suggested = || {
        let (before, list) = message.split_once(", expected ")?;
        let word = before.strip_suffix('`')?.rsplit_once('`')?.1;
        let other = suggest(word, list.split('`').skip(1).step_by(2))?;
        Some(format!("{before} (did you mean `{other}`?), expected {list}"))
    };
    suggested().unwrap_or_else(|| message.to_owned())
}

/// The number of insertions, deletions, changes and swaps of neighbours.
fn distance(a: &str, b: &str) -> usize {
    let (a, b): (Vec<char>, Vec<char>) = (a.chars().collect(), b.chars().collect());
    // The last two rows of the table of distances between prefixes.
    let (mut before, mut row) = (Vec::new(), (0..=b.len()).collect::<Vec<_>>());
    for (i, own) in a.iter().enumerate() {
        let mut next = vec![i + 1];
        for (j, other) in b.iter().enumerate() {
            let mut least =
                (row[j] + usize::from(own != other)).min(row[j + 1] + 1).min(next[j] + 1);
            if i > 0 && j > 0 && *own == b[j - 1] && a[i - 1] == *other {
                let swapped: &[usize] = &before;
                least = least.min(swapped[j - 1] + 1);
            }
            next.push(least);
        }
        before = std::mem::replace(&mut row, next);
    }
    row.last().copied().unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slip_of_the_pen_is_found_and_another_word_is_not() {
        let known = ["position", "motion", "feed_rate", "straight_feed", "straight_traverse"];
        for (word, expected) in [
            ("positon", Some("position")),
            ("mtoion", Some("motion")),
            ("feedrate", Some("feed_rate")),
            ("straight_fed", Some("straight_feed")),
            ("spindle", None),
            ("x", None),
            ("motion", None),
        ] {
            assert_eq!(suggest(word, known), expected, "{word}");
        }
    }

    #[test]
    fn message_with_known_words_gets_a_suggestion() {
        for (message, expected) in [
            (
                "unknown field `positon`, expected one of `motion`, `position` at line 1",
                "unknown field `positon` (did you mean `position`?), expected one of `motion`, `position` at line 1",
            ),
            ("unknown field `q`, expected `position`", "unknown field `q`, expected `position`"),
            ("EOF while parsing a string", "EOF while parsing a string"),
        ] {
            assert_eq!(with_suggestion(message), expected);
        }
    }
}
