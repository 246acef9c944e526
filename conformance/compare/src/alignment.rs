//! Alignment of two sequences, so that an item that only one side has shifts nothing.

use std::hash::Hash;
use std::ops::Range;

use similar::{Algorithm, DiffOp, capture_diff_slices};

/// Most items of a side that are aligned after the first difference; longer sequences are compared item by item.
pub const ALIGNED_MAX: usize = 5_000;

/// A part of two aligned sequences.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Segment {
    /// Both sides have these items.
    Equal(Range<usize>, Range<usize>),
    /// The sides have different items here; one range may be empty.
    Different(Range<usize>, Range<usize>),
}

/// The parts of two sequences, in order. Together they have every item of both sides once.
pub fn segments<T: Hash + Eq + Ord>(left: &[T], right: &[T]) -> Vec<Segment> {
    let both = left.iter().zip(right).take_while(|(a, b)| a == b).count();
    let (left_rest, right_rest) = (&left[both..], &right[both..]);
    let mut segments = Vec::new();
    if both > 0 {
        segments.push(Segment::Equal(0..both, 0..both));
    }
    if left_rest.len().max(right_rest.len()) > ALIGNED_MAX {
        segments.push(Segment::Different(both..left.len(), both..right.len()));
        return segments;
    }
    let later = |range: Range<usize>| range.start + both..range.end + both;
    let ops = capture_diff_slices(Algorithm::Myers, left_rest, right_rest);
    segments.extend(ops.iter().map(|op| match op {
        DiffOp::Equal { .. } => Segment::Equal(later(op.old_range()), later(op.new_range())),
        DiffOp::Delete { .. } | DiffOp::Insert { .. } | DiffOp::Replace { .. } => {
            Segment::Different(later(op.old_range()), later(op.new_range()))
        }
    }));
    segments
}

/// The places of both sides that belong together. Different items are paired in
/// their order.
pub fn pairs<T: Hash + Eq + Ord>(left: &[T], right: &[T]) -> Vec<(Option<usize>, Option<usize>)> {
    let of_segment = |segment| {
        let (Segment::Equal(left, right) | Segment::Different(left, right)) = segment;
        (0..left.len().max(right.len()))
            .map(move |place| (left.clone().nth(place), right.clone().nth(place)))
    };
    segments(left, right).into_iter().flat_map(of_segment).collect()
}

/// The lines that differ between two texts, `-` for the old and `+` for the new ones, with the line before each part.
/// Empty if the texts have the same lines.
pub fn changed_lines(old: &str, new: &str) -> String {
    let (old, new): (Vec<_>, Vec<_>) = (old.lines().collect(), new.lines().collect());
    let mut text = String::new();
    for segment in segments(&old, &new) {
        let Segment::Different(left, right) = segment else { continue };
        let before = left.start.checked_sub(1).and_then(|place| old.get(place));
        text.extend(before.map(|line| format!("  {line}\n")));
        text.extend(old[left].iter().map(|line| format!("- {line}\n")));
        text.extend(new[right].iter().map(|line| format!("+ {line}\n")));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn item_that_one_side_has_more_shifts_nothing() {
        assert_eq!(
            pairs(&["a", "b", "c"], &["a", "x", "b", "c"]),
            [(Some(0), Some(0)), (None, Some(1)), (Some(1), Some(2)), (Some(2), Some(3))]
        );
        assert_eq!(pairs(&["a"], &["b"]), [(Some(0), Some(0))]);
        assert!(pairs::<u8>(&[], &[]).is_empty());
    }

    #[test]
    fn long_sequences_are_compared_item_by_item() {
        let left: Vec<usize> = (0..=ALIGNED_MAX).collect();
        let right: Vec<usize> = (1..=ALIGNED_MAX).collect();
        let all = pairs(&left, &right);
        assert_eq!(all.first(), Some(&(Some(0), Some(0))));
        assert_eq!(all.last(), Some(&(Some(ALIGNED_MAX), None)));
    }

    #[test]
    fn changed_lines_have_the_line_before() {
        assert_eq!(changed_lines("a\nb\nc\n", "a\nx\nc\nd\n"), "  a\n- b\n+ x\n  c\n+ d\n");
        assert_eq!(changed_lines("a\n", "a\n"), "");
    }
}
