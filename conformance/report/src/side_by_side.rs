//! The expected and the found trace side by side, aligned, with differences marked.
//!
//! A line that only one side has is opposite an empty cell and shifts nothing. A trace reports changes of the state. A
//! value is compared with the one that is set on the other side after the same block. Reporting it again is not a
//! difference, and neither is a field that one side never reports.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_compare::alignment::{Segment, pairs, segments};
use gaugeblock_runner::certify::Traces;
use serde::Serialize;

/// Relative difference up to which numbers may be equal, reported with fewer digits.
const RELATIVE_TOLERANCE: f64 = 6e-5;

/// A line of each trace, where the side has one.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Row<'a> {
    expected: Option<Vec<Part<'a>>>,
    found: Option<Vec<Part<'a>>>,
    differs: bool,
}

/// A part of a line.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Part<'a> {
    text: &'a str,
    differs: bool,
}

/// Both traces. Masked fields are not compared.
pub(super) fn side_by_side<'a>(traces: &'a Traces, masked: &BTreeSet<String>) -> Vec<Row<'a>> {
    let without_blocks = masked.contains("blocks");
    let (expected, found) = (groups(&traces.expected), groups(&traces.found));
    let (expected, found) = if without_blocks {
        (vec![in_one(expected)], vec![in_one(found)])
    } else {
        (expected, found)
    };
    let keys = |groups: &[Group<'a>]| -> Vec<&'a str> { groups.iter().map(|it| it.key).collect() };
    let group_pairs = pairs_of_like(&keys(&expected), &keys(&found));
    let sides = Sides { masked, without_blocks };
    let rows = group_pairs.into_iter().flat_map(|(left, right)| {
        sides.rows(left.map(|place| &expected[place]), right.map(|place| &found[place]))
    });
    rows.collect()
}

/// A single line, or a block with its effects.
#[derive(Debug)]
struct Group<'a> {
    /// The block, or the first word of another line; of a pin its name, too.
    key: &'a str,
    lines: Vec<&'a str>,
    /// Values of settings and state after it; of parameters, those at the end.
    values: BTreeMap<&'a str, &'a str>,
}

/// The groups of a trace.
fn groups(trace: &str) -> Vec<Group<'_>> {
    let mut groups: Vec<Group<'_>> = Vec::new();
    for line in trace.trim_end().split('\n') {
        match groups.last_mut() {
            Some(group) if line.starts_with(' ') => group.lines.push(line),
            _ => {
                let key = match line.split(' ').next().unwrap_or_default() {
                    "block" => line,
                    "pin" => line.split(" time=").next().unwrap_or_default(),
                    name => name,
                };
                groups.push(Group { key, lines: vec![line], values: BTreeMap::new() });
            }
        }
    }
    let mut values = BTreeMap::new();
    for group in &mut groups {
        let mut own = fields(&group.lines);
        if group.key != "parameters" {
            values.append(&mut own);
            own.clone_from(&values);
        }
        group.values = own;
    }
    groups
}

/// A trace as one group, for a controller that does not report blocks.
fn in_one(groups: Vec<Group<'_>>) -> Group<'_> {
    let lines = groups.into_iter().flat_map(|group| group.lines).collect();
    Group { key: "", lines, values: BTreeMap::new() }
}

/// The places of both sides that belong together. Only the same keys are opposite each other.
fn pairs_of_like(left: &[&str], right: &[&str]) -> Vec<(Option<usize>, Option<usize>)> {
    let split = |pair| match pair {
        (Some(one), Some(other)) if left[one] != right[other] => {
            vec![(Some(one), None), (None, Some(other))]
        }
        pair => vec![pair],
    };
    pairs(left, right).into_iter().flat_map(split).collect()
}

/// What is compared of both sides.
#[derive(Clone, Copy)]
struct Sides<'m> {
    masked: &'m BTreeSet<String>,
    without_blocks: bool,
}

impl Sides<'_> {
    /// The rows of two groups.
    fn rows<'a>(self, left: Option<&Group<'a>>, right: Option<&Group<'a>>) -> Vec<Row<'a>> {
        let lines = |group: Option<&Group<'a>>| group.map_or(Vec::new(), |it| it.lines.clone());
        let (left_lines, right_lines) = (lines(left), lines(right));
        let row = |(one, other): (Option<usize>, Option<usize>)| {
            let one = one.map(|place| left_lines[place]);
            let other = other.map(|place| right_lines[place]);
            let expected = one.map(|line| self.marked(line, other, left, right));
            let found = other.map(|line| self.marked(line, one, right, left));
            let differs = expected.iter().chain(&found).flatten().any(|part| part.differs);
            Row { expected, found, differs }
        };
        self.line_pairs(&left_lines, &right_lines).into_iter().map(row).collect()
    }

    /// Aligns lines: effects by their coarse values, those that differ by their names.
    fn line_pairs(self, left: &[&str], right: &[&str]) -> Vec<(Option<usize>, Option<usize>)> {
        let coarse = |lines: &[&str]| -> Vec<String> {
            lines.iter().map(|line| coarse_line(line)).collect()
        };
        let names = |lines: &[&str]| -> Vec<String> {
            lines.iter().map(|line| line_name(line).to_owned()).collect()
        };
        let mut all = Vec::new();
        for segment in segments(&coarse(left), &coarse(right)) {
            match segment {
                Segment::Equal(one, other) => {
                    all.extend(one.zip(other).map(|(one, other)| (Some(one), Some(other))));
                }
                Segment::Different(one, other) => {
                    let (own, theirs) = (names(&left[one.clone()]), names(&right[other.clone()]));
                    for (l, r) in pairs(&own, &theirs) {
                        let (l, r) = (l.map(|at| at + one.start), r.map(|at| at + other.start));
                        match (l, r) {
                            (Some(l), Some(r)) if !are_opposite(left[l], right[r]) => {
                                all.extend([(Some(l), None), (None, Some(r))]);
                            }
                            pair => all.push(pair),
                        }
                    }
                }
            }
        }
        all
    }

    /// A line of a group with its differences from the other side.
    fn marked<'a>(
        self,
        line: &'a str,
        opposite: Option<&str>,
        own: Option<&Group<'a>>,
        other: Option<&Group<'a>>,
    ) -> Vec<Part<'a>> {
        let whole = |differs| vec![Part { text: line, differs }];
        if is_compared_effect(line, self.masked) {
            return whole(!opposite.is_some_and(|other| same_effect(line, other)));
        }
        let is_block = line.starts_with("block ");
        if line.starts_with("end ") {
            return whole(opposite.is_none_or(|other| end_tokens(line) != end_tokens(other)));
        }
        if line.starts_with("pin ") {
            return whole(opposite != Some(line));
        }
        match other {
            Some(other) if has_fields(line) && !self.without_blocks => {
                let is_parameters = own.is_some_and(|own| own.key == "parameters");
                let differs = |(name, value): (&str, &str)| {
                    let theirs = other.values.get(name);
                    let is_lacking = is_parameters && theirs.is_none();
                    is_lacking || theirs.is_some_and(|theirs| !same_value(value, theirs))
                };
                let part = |text| Part { text, differs: field(text).is_some_and(differs) };
                tokens(line).map(part).collect()
            }
            Some(_) => whole(false),
            None => whole(is_block && !self.without_blocks),
        }
    }
}

/// The name of an effect, or the first word of another line.
fn line_name(line: &str) -> &str {
    let line = line.trim_start();
    let rest = line.strip_prefix("do ").unwrap_or(line);
    rest.split(' ').next().unwrap_or_default()
}

/// Whether two different lines may be opposite each other: both are effects, or they have the same first word.
fn are_opposite(one: &str, other: &str) -> bool {
    let is_effect = |line: &str| line.starts_with("  do ");
    is_effect(one) && is_effect(other) || line_name(one) == line_name(other)
}

/// A line as it is aligned: an effect with few digits, the first word of another line.
fn coarse_line(line: &str) -> String {
    if !line.starts_with("  do ") {
        return line_name(line).to_owned();
    }
    let coarse = |token: &str| match field(token) {
        Some((name, value)) => format!(" {name}={}", coarse_value(value)),
        None => token.to_owned(),
    };
    tokens(line).map(coarse).collect()
}

fn coarse_value(value: &str) -> String {
    if let Ok(number) = value.parse::<f64>() {
        return format!("{number:.2}");
    }
    let Some(coordinates) = coordinates(value) else { return value.to_owned() };
    let coordinates = coordinates.iter().filter(|(_, value)| **value != 0.0);
    coordinates.map(|(axis, value)| format!("{axis}{value:.2} ")).collect()
}

/// Whether a line is an effect that is compared.
fn is_compared_effect(line: &str, masked: &BTreeSet<String>) -> bool {
    let name = line.strip_prefix("  do ").and_then(|rest| rest.split(' ').next());
    name.is_some_and(|name| !masked.contains(name))
}

fn has_fields(line: &str) -> bool {
    ["start ", "parameters ", "  set ", "  state "].iter().any(|name| line.starts_with(name))
}

/// The fields of lines, the last value of each.
fn fields<'a>(lines: &[&'a str]) -> BTreeMap<&'a str, &'a str> {
    let lines = lines.iter().filter(|line| has_fields(line));
    lines.flat_map(|line| tokens(line)).filter_map(field).collect()
}

pub(super) fn field(token: &str) -> Option<(&str, &str)> {
    token.trim_start().split_once('=')
}

/// The words of a line with the blanks before them; brackets and quotation marks keep words together.
pub(super) fn tokens(line: &str) -> impl Iterator<Item = &str> {
    let mut rest = line;
    std::iter::from_fn(move || {
        let (mut depth, mut quoted, mut escaped, mut begun) = (0_u32, false, false, false);
        let end = rest.char_indices().find_map(|(at, c)| {
            if c == ' ' && depth == 0 && !quoted && begun {
                return Some(at);
            }
            begun |= c != ' ';
            match c {
                '"' if !escaped => quoted = !quoted,
                '(' if !quoted => depth += 1,
                ')' if !quoted => depth = depth.saturating_sub(1),
                _ => {}
            }
            escaped = c == '\\' && !escaped;
            None
        });
        let (token, left) = rest.split_at(end.unwrap_or(rest.len()));
        rest = left;
        (!token.is_empty()).then_some(token)
    })
}

/// The end of a run, without messages for people.
fn end_tokens(line: &str) -> Vec<&str> {
    let is_compared = |token: &&str| {
        !["message=", "from=", "to="].iter().any(|name| token.trim_start().starts_with(name))
    };
    tokens(line).filter(is_compared).collect()
}

/// Whether two effects are equal up to their digits.
fn same_effect(one: &str, other: &str) -> bool {
    let (mut words, mut others) = (tokens(one), tokens(other));
    loop {
        match (words.next(), others.next()) {
            (None, None) => return true,
            (Some(one), Some(other)) if one == other => {}
            (Some(one), Some(other)) => match (field(one), field(other)) {
                (Some(one), Some(other)) if one.0 == other.0 && same_value(one.1, other.1) => {}
                _ => return false,
            },
            _ => return false,
        }
    }
}

/// Whether two values are equal up to their digits. Missing coordinates of a position are zero.
fn same_value(one: &str, other: &str) -> bool {
    let near = |a: f64, b: f64| (a - b).abs() <= RELATIVE_TOLERANCE * a.abs().max(b.abs()).max(1.0);
    if let (Ok(one), Ok(other)) = (one.parse(), other.parse()) {
        return near(one, other);
    }
    match (coordinates(one), coordinates(other)) {
        (Some(one), Some(other)) => {
            let of = |all: &BTreeMap<char, f64>, axis| all.get(axis).copied().unwrap_or(0.0);
            one.keys().chain(other.keys()).all(|axis| near(of(&one, axis), of(&other, axis)))
        }
        _ => one == other,
    }
}

/// The coordinates of a position, by axis.
fn coordinates(value: &str) -> Option<BTreeMap<char, f64>> {
    let inner = value.strip_prefix('(')?.strip_suffix(')')?;
    let words = inner.split(' ').filter(|word| !word.is_empty());
    words.map(|word| Some((word.chars().next()?, word.get(1..)?.parse().ok()?))).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXPECTED: &str = "gaugeblock outcome 0\nlanguage rs274\nstart units=mm plane=xy\nblock main.ngc:1\n  do straight_traverse end=(x1 y1)\n  state motion=traverse position=(x1 y1) tool=0\nblock main.ngc:2\n  do straight_feed end=(x5 y-2)\n  do controller_mode mode=mdi\n  state motion=feed position=(x5 y-2)\nend program_end\nparameters 31=1 5220=1\n";

    /// The marked parts of both sides.
    fn marked(found: &str, masked: &[&str]) -> [Vec<String>; 2] {
        let traces = Traces { expected: EXPECTED.to_owned(), found: found.to_owned() };
        let masked = masked.iter().map(|name| (*name).to_owned()).collect();
        let rows = side_by_side(&traces, &masked);
        let of = |place: usize| -> Vec<&Vec<Part<'_>>> {
            rows.iter().filter_map(|row| [&row.expected, &row.found][place].as_ref()).collect()
        };
        let whole: Vec<String> =
            of(0).iter().map(|line| line.iter().map(|part| part.text).collect()).collect();
        assert_eq!(whole.join("\n") + "\n", EXPECTED, "nothing of the text is lost");
        [0, 1].map(|place| {
            let parts = of(place).into_iter().flatten().filter(|part| part.differs);
            parts.map(|part| part.text.trim().to_owned()).collect()
        })
    }

    #[test]
    fn repeated_and_missing_values_are_not_marked() {
        let found = "gaugeblock outcome 0\nlanguage rs274\nstart\nblock main.ngc:1\n  do straight_traverse end=(x1.00001 y1)\n  state motion=traverse position=(x1 y1)\nblock main.ngc:2\n  do straight_feed end=(x5 y-2 z0)\n  state motion=feed position=(x5 y-2)\nend program_end\nparameters 31=1 5220=1\n";
        assert_eq!(marked(found, &["controller_mode"]), [vec![], vec![]] as [Vec<String>; 2]);
    }

    #[test]
    fn differences_are_marked_on_both_sides() {
        let found = "gaugeblock outcome 0\nlanguage rs274\nstart units=mm\nblock main.ngc:1\n  do straight_traverse end=(x1 y1)\n  state motion=traverse position=(x1 y1)\nblock main.ngc:2\n  do straight_feed end=(x5 y1)\n  state motion=feed position=(x5 y1)\nend fault kind=bad_block file=\"main.ngc\" line=3 message=\"no such word\"\nparameters 5220=1\n";
        let [expected, found] = marked(found, &["controller_mode"]);
        assert_eq!(
            expected,
            ["do straight_feed end=(x5 y-2)", "position=(x5 y-2)", "end program_end", "31=1"]
        );
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found[2].starts_with("end fault"), "{found:?}");
    }

    #[test]
    fn without_blocks_only_effects_are_looked_at() {
        let found = "gaugeblock outcome 0\nlanguage rs274\nstart\nblock main.ngc:1\n  do straight_traverse end=(x1 y1)\n  do straight_feed end=(x5 y-3)\nend program_end\nparameters 31=1 5220=1\n";
        let [expected, found] = marked(found, &["blocks", "controller_mode"]);
        assert_eq!(expected, ["do straight_feed end=(x5 y-2)"]);
        assert_eq!(found, ["do straight_feed end=(x5 y-3)"]);
    }

    #[test]
    fn effect_that_one_side_has_more_marks_one_row() {
        let effects = |ends: &[&str]| -> String {
            let lines = ends.iter().map(|end| format!("  do straight_feed end=({end})\n"));
            format!(
                "block main.ngc:1\n{}  state motion=feed\nend program_end\n",
                lines.collect::<String>()
            )
        };
        let traces = |found: &[&str]| Traces {
            expected: effects(&["x1", "x2", "x3", "x4"]),
            found: effects(found),
        };
        let differing = |found: &[&str]| {
            let traces = traces(found);
            let rows = side_by_side(&traces, &BTreeSet::new());
            rows.iter().filter(|row| row.differs).count()
        };
        assert_eq!(differing(&["x1", "x2", "x3", "x4"]), 0);
        assert_eq!(differing(&["x1", "x9", "x2", "x3", "x4"]), 1);
        assert_eq!(differing(&["x2", "x3", "x4"]), 1);
        assert_eq!(differing(&["x1", "x2.5", "x3", "x4.00001"]), 1);
    }

    #[test]
    fn block_that_one_side_executes_more_often_shifts_nothing() {
        let block = |line: u32| format!("block main.ngc:{line}\n  do dwell seconds={line}\n");
        let traces = Traces {
            expected: block(1) + &block(2) + &block(3),
            found: block(1) + &block(2) + &block(2) + &block(3),
        };
        let rows = side_by_side(&traces, &BTreeSet::new());
        let differing: Vec<_> = rows.iter().filter(|row| row.differs).collect();
        assert_eq!(differing.len(), 2, "{differing:?}");
        assert!(differing.iter().all(|row| row.expected.is_none()));
    }
}
