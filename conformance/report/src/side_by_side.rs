//! The expected and the found trace side by side, with differences marked.
//!
//! A trace reports changes of the state. A value is compared with the one that is set on the other side after the same
//! block. Reporting it again is not a difference, and neither is a field that one side never reports.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_runner::certify::Traces;
use serde::Serialize;

/// Relative difference up to which numbers may be equal, reported with fewer digits.
const RELATIVE_TOLERANCE: f64 = 6e-5;

/// One of the two traces, line by line.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Side<'a> {
    name: &'static str,
    lines: Vec<Vec<Part<'a>>>,
}

/// A part of a line.
#[derive(Debug, PartialEq, Serialize)]
pub(super) struct Part<'a> {
    text: &'a str,
    differs: bool,
}

/// Both traces. Masked fields are not compared.
pub(super) fn side_by_side<'a>(traces: &'a Traces, masked: &BTreeSet<String>) -> Vec<Side<'a>> {
    let (expected, found) =
        (ParsedTrace::parse(&traces.expected), ParsedTrace::parse(&traces.found));
    let side = |name, own: &ParsedTrace<'a>, other: &ParsedTrace<'_>| {
        let lines = own.groups.iter().flat_map(|group| group.mark_differences(other, masked));
        Side { name, lines: lines.collect() }
    };
    let by_the_documents = side("by the documents", &expected, &found);
    vec![by_the_documents, side("on the controller", &found, &expected)]
}

/// A trace.
#[derive(Debug)]
struct ParsedTrace<'a> {
    groups: Vec<Group<'a>>,
}

/// A single line, or a block with its effects.
#[derive(Debug)]
struct Group<'a> {
    /// Its kind, and how many of this kind came before.
    key: (&'a str, usize),
    lines: Vec<&'a str>,
    /// Values of settings and state after it; of parameters, those at the end.
    values: BTreeMap<&'a str, &'a str>,
}

impl<'a> ParsedTrace<'a> {
    fn parse(trace: &'a str) -> Self {
        let mut groups: Vec<Group<'a>> = Vec::new();
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        let mut values = BTreeMap::new();
        for line in trace.trim_end().split('\n') {
            match groups.last_mut() {
                Some(group) if line.starts_with(' ') => group.lines.push(line),
                _ => {
                    let name = line.split(' ').next().unwrap_or_default();
                    let what = if name == "block" { line } else { name };
                    let count = counts.entry(what).or_default();
                    groups.push(Group {
                        key: (what, *count),
                        lines: vec![line],
                        values: BTreeMap::new(),
                    });
                    *count += 1;
                }
            }
        }
        for group in &mut groups {
            let mut own = fields(&group.lines);
            if group.key.0 != "parameters" {
                values.append(&mut own);
                own.clone_from(&values);
            }
            group.values = own;
        }
        Self { groups }
    }

    fn counterpart(&self, group: &Group<'_>) -> Option<&Group<'a>> {
        self.groups.iter().find(|other| other.key == group.key)
    }

    /// All effects, for a trace without blocks.
    fn doings(&self, masked: &BTreeSet<String>) -> Vec<&'a str> {
        self.groups.iter().flat_map(|group| group.doings(masked)).collect()
    }
}

impl<'a> Group<'a> {
    /// Effects that are compared, in order.
    fn doings(&self, masked: &BTreeSet<String>) -> impl Iterator<Item = &'a str> {
        self.lines.iter().copied().filter(|line| is_compared_effect(line, masked))
    }

    fn mark_differences(
        &self,
        other: &ParsedTrace<'_>,
        masked: &BTreeSet<String>,
    ) -> Vec<Vec<Part<'a>>> {
        let without_blocks = masked.contains("blocks");
        let like = other.counterpart(self);
        let doings = match like {
            _ if without_blocks => other.doings(masked),
            Some(like) => like.doings(masked).collect(),
            None => Vec::new(),
        };
        let mut number = 0;
        let mut line = |line: &&'a str| -> Vec<Part<'a>> {
            let whole = |differs| vec![Part { text: line, differs }];
            if is_compared_effect(line, masked) {
                number += 1;
                let differs = if without_blocks {
                    !doings.iter().any(|doing| same_effect(line, doing))
                } else {
                    !doings.get(number - 1).is_some_and(|doing| same_effect(line, doing))
                };
                return whole(differs);
            }
            if let Some(like) = like.filter(|_| has_fields(line) && !without_blocks) {
                let differs = |(name, value): (&str, &str)| {
                    let theirs = like.values.get(name);
                    let is_lacking = self.key.0 == "parameters" && theirs.is_none();
                    is_lacking || theirs.is_some_and(|theirs| !same_value(value, theirs))
                };
                return tokens(line)
                    .map(|text| Part { text, differs: field(text).is_some_and(differs) })
                    .collect();
            }
            whole(match (like, self.key.0) {
                (Some(like), "end") => {
                    end_tokens(line) != end_tokens(like.lines.first().unwrap_or(&""))
                }
                (Some(like), "pin") => like.lines.first() != Some(line),
                (None, "pin") => other.groups.iter().any(|group| group.key.0 == "pin"),
                (None, "end") => true,
                (None, block) => block.starts_with("block ") && !without_blocks,
                (Some(_), _) => false,
            })
        };
        self.lines.iter().map(&mut line).collect()
    }
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
    let coordinates = |value: &str| -> Option<BTreeMap<char, f64>> {
        let inner = value.strip_prefix('(')?.strip_suffix(')')?;
        let words = inner.split(' ').filter(|word| !word.is_empty());
        words.map(|word| Some((word.chars().next()?, word.get(1..)?.parse().ok()?))).collect()
    };
    match (coordinates(one), coordinates(other)) {
        (Some(one), Some(other)) => {
            let of = |all: &BTreeMap<char, f64>, axis| all.get(axis).copied().unwrap_or(0.0);
            one.keys().chain(other.keys()).all(|axis| near(of(&one, axis), of(&other, axis)))
        }
        _ => one == other,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const EXPECTED: &str = "gaugeblock outcome 0\nlanguage rs274\nstart units=mm plane=xy\nblock main.ngc:1\n  do straight_traverse end=(x1 y1)\n  state motion=traverse position=(x1 y1) tool=0\nblock main.ngc:2\n  do straight_feed end=(x5 y-2)\n  do controller_mode mode=mdi\n  state motion=feed position=(x5 y-2)\nend program_end\nparameters 31=1 5220=1\n";

    /// The marked parts of both sides.
    fn marked(found: &str, masked: &[&str]) -> [Vec<String>; 2] {
        let traces = Traces { expected: EXPECTED.to_owned(), found: found.to_owned() };
        let masked = masked.iter().map(|name| (*name).to_owned()).collect();
        let sides = side_by_side(&traces, &masked);
        let whole: Vec<String> =
            sides[0].lines.iter().map(|line| line.iter().map(|part| part.text).collect()).collect();
        assert_eq!(whole.join("\n") + "\n", EXPECTED, "nothing of the text is lost");
        [0, 1].map(|side| {
            let parts = sides[side].lines.iter().flatten().filter(|part| part.differs);
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
}
