//! What a finding is, in words: what differs, what explains it, and how much hangs on it.

use std::collections::{BTreeMap, BTreeSet};

use gaugeblock_compare::Divergence;
use gaugeblock_runner::certify::{RuleDivergence, Traces};
use gaugeblock_runner::findings::{Finding, FindingCause};
use gaugeblock_runner::fuzz::signature::Signature;
use gaugeblock_runner::other_controller;

use super::side_by_side::{field, tokens};

/// Its size in words.
pub fn size(finding: &Finding<'_, '_>) -> String {
    let counted = |count: usize, what: &str| match count {
        1 => format!("1 {what}"),
        _ => format!("{count} {what}s"),
    };
    let mut parts = vec![counted(finding.cases.len(), "case")];
    if !finding.touched.is_empty() {
        let rules = counted(finding.touched_rules().len(), "other rule");
        parts.push(format!("{} of {rules}", counted(finding.touched.len(), "case")));
    }
    if !finding.side_differences.is_empty() {
        parts.push(counted(finding.side_differences.len(), "side difference"));
    }
    parts.join(", ")
}

/// What a finding is, in a line.
pub fn title(controller: &str, finding: &Finding<'_, '_>) -> String {
    let first = finding.divergent().next();
    match &finding.cause {
        FindingCause::Options(parts) => explanation_by(controller, parts).text,
        FindingCause::Rule => {
            first.map(|(_, divergence)| difference_in_words(divergence)).unwrap_or_default()
        }
        FindingCause::Unknown(what) => what.clone(),
    }
}

/// The explanation of a divergence.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Explanation {
    /// Whether it explains this controller. A quirk of another controller does not: the agreement may be chance.
    pub applies_to_controller: bool,
    /// In words.
    pub text: String,
}

/// The explanation of a divergence, or the controller that does the same.
pub fn explain(controller: &str, divergence: &RuleDivergence) -> Option<Explanation> {
    let parts = &divergence.explanation;
    (!parts.is_empty()).then(|| explanation_by(controller, parts))
}

/// An explanation by quirks and other options of choices.
fn explanation_by(controller: &str, parts: &[String]) -> Explanation {
    let names = parts.join(" and ");
    let other = parts.iter().find_map(|name| other_controller(controller, name));
    let text = match other {
        Some(other) => format!("{other} does this, too: {names}"),
        None => {
            // Of several, one may explain this difference alone, and the others what follows it.
            let several = parts.len() > 1;
            let what = if several { " (this and later differences)" } else { "" };
            format!("explained by {names}{what}")
        }
    };
    Explanation { applies_to_controller: other.is_none(), text }
}

/// What differs, without lines and numbers.
pub(crate) fn difference_in_words(divergence: &RuleDivergence) -> String {
    // Effects of a block that should have been refused, or missing ones after a wrong refusal, follow from that alone.
    if let Some(told) = divergence.traces.as_ref().and_then(refusal_difference) {
        return told;
    }
    if let Some(divergence) = divergence.difference.as_deref().and_then(parts) {
        let Signature { field, expected, found } = Signature::of(&divergence);
        return match (expected.as_str(), found.as_str()) {
            ("", "") => format!("{field}: another course"),
            ("a value", "a value") => format!("{field}: another value"),
            (one, other) if one == other => match arguments(&divergence).join(" and ") {
                which if which.is_empty() => format!("{field}: another {one}"),
                which => format!("{field}: {one} with another {which}"),
            },
            _ => format!("{field}: expected {expected}, found {found}"),
        };
    }
    // The words of an assertion, whatever its numbers are.
    let said = divergence.assertion.as_ref().map_or("", |(said, _)| said.as_str());
    let words = without_guard(said).split_whitespace();
    let is_word = |word: &&str| word.starts_with(|c: char| c.is_alphabetic() || c == '=');
    let words: Vec<_> = words.filter(is_word).collect();
    format!("asserted: {}", words.join(" "))
}

/// The difference if one side refuses and the other does not.
fn refusal_difference(traces: &Traces) -> Option<String> {
    let (expected, found) = (end(&traces.expected)?, end(&traces.found)?);
    match (expected.strip_prefix("fault"), found.strip_prefix("fault")) {
        (Some(fault), None) => {
            let kind = fault.split_whitespace().find_map(|word| word.strip_prefix("kind="));
            Some(format!("not refused: {}", kind.unwrap_or("whatever it is")))
        }
        (None, Some(fault)) => {
            let said = fault.split_once("message=").map_or("", |(_, message)| message);
            Some(format!("refused, and should not be: {}", without_lines(said)))
        }
        _ => None,
    }
}

/// A text without the numbers of lines and blocks. All other numbers stay: `error:20` and `error:33` are two causes.
pub(super) fn without_lines(text: &str) -> String {
    let ends = |c: char| c == ' ' || c == '"' || c == '(' || c == '[';
    let mut is_place = false;
    let mut kept = String::new();
    for word in text.split_inclusive(ends) {
        let (name, end) = match word.char_indices().next_back() {
            Some((at, last)) if ends(last) => word.split_at(at),
            _ => (word, ""),
        };
        kept.push_str(&if is_place { without_digits(name) } else { without_line_of_file(name) });
        kept.push_str(end);
        if !name.is_empty() {
            is_place = matches!(name.to_ascii_lowercase().as_str(), "line" | "lines" | "block");
        }
    }
    kept
}

fn without_digits(word: &str) -> String {
    word.chars().filter(|c| !c.is_ascii_digit()).collect()
}

/// `main.ngc:4` is `main.ngc`, and `line:4` is `line`. A name without a dot is not a file.
fn without_line_of_file(word: &str) -> String {
    match word.split_once(':') {
        Some((name, rest)) if name.contains('.') || name.eq_ignore_ascii_case("line") => {
            format!("{name}{}", without_digits(rest).trim_start_matches(':'))
        }
        _ => word.to_owned(),
    }
}

/// Names of the arguments in which an effect differs.
fn arguments(divergence: &Divergence) -> Vec<&str> {
    let fields = |text| -> BTreeMap<_, _> { tokens(text).filter_map(field).collect() };
    let (expected, found) = (fields(&divergence.expected), fields(&divergence.found));
    let names: BTreeSet<_> = expected.keys().chain(found.keys()).copied().collect();
    names.into_iter().filter(|name| expected.get(name) != found.get(name)).collect()
}

/// The end of a trace, unless it is cut before.
fn end(trace: &str) -> Option<&str> {
    trace.lines().rev().find_map(|line| line.strip_prefix("end "))
}

/// Parses a divergence from its line.
fn parts(line: &str) -> Option<Divergence> {
    let (place, rest) = line.split_once(": expected ")?;
    let (expected, found) = rest.split_once(", found ")?;
    let field = place.rsplit_once(": ").map_or(place, |(_, field)| field);
    let (field, expected, found) = (field.to_owned(), expected.to_owned(), found.to_owned());
    Some(Divergence { block: None, field, expected, found })
}

/// An assertion without its guard: the option is that of the edition.
pub(super) fn without_guard(assertion: &str) -> &str {
    let guarded = assertion.strip_prefix("when ").and_then(|rest| rest.split_once(": "));
    guarded.map_or(assertion, |(_, claim)| claim)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn divergence(difference: &str, explanation: &[&str]) -> RuleDivergence {
        let explanation = explanation.iter().map(|name| (*name).to_owned()).collect();
        RuleDivergence {
            difference: Some(difference.to_owned()),
            explanation,
            ..RuleDivergence::default()
        }
    }

    #[test]
    fn lines_and_numbers_do_not_change_the_cause() {
        for (difference, expected) in [
            ("main.ngc:4: feed_rate: expected 12.3, found 0", "feed_rate: another value"),
            ("motion: expected traverse, found none", "motion: expected traverse, found none"),
            (
                "main.ngc:3: effect: expected straight_feed end=(x5 y-2), found straight_feed end=(x5)",
                "effect: straight_feed with another end",
            ),
            (
                "main.ngc:1: end: expected refused at main.ngc:1 (repeated_word), found program end",
                "end: expected refused (repeated_word), found program end",
            ),
        ] {
            assert_eq!(difference_in_words(&divergence(difference, &[])), expected);
        }
        let assertion = Some(("when a.b=c: after 4 g5x_offset = (x1)".to_owned(), "x".to_owned()));
        let asserted = RuleDivergence { assertion, ..RuleDivergence::default() };
        assert_eq!(difference_in_words(&asserted), "asserted: after g5x_offset =");
    }

    #[test]
    fn consequences_of_a_missing_refusal_are_one_cause() {
        let refused = "end fault kind=repeated_word file=\"main.ngc\" line=1 message=\"x 12, G17\"\nparameters 5220=1\n";
        let accepted = "step main.ngc:1\nend program_end\n";
        for (expected, found, told) in [
            (refused, accepted, "not refused: repeated_word"),
            (accepted, refused, "refused, and should not be: \"x 12, G17\""),
            (accepted, accepted, "effect: another value"),
            (refused, "cut …", "effect: another value"),
        ] {
            let (expected, found) = (expected.to_owned(), found.to_owned());
            let traces = Some(Traces { expected, found });
            let divergence =
                RuleDivergence { traces, ..divergence("effect: expected 1, found 2", &[]) };
            assert_eq!(difference_in_words(&divergence), told);
        }
    }

    #[test]
    fn numbers_of_lines_are_left_out_and_other_numbers_stay() {
        for (said, kept) in [
            ("error:20", "error:20"),
            ("error:33", "error:33"),
            ("ALARM:2 in block 14", "ALARM:2 in block "),
            ("Line 7: unknown G99", "Line : unknown G99"),
            ("main.ngc:12: tool 5", "main.ngc tool 5"),
            ("(line 3)", "(line )"),
            ("line:3 bad", "line bad"),
            ("radius 1.5 to end 12.25", "radius 1.5 to end 12.25"),
        ] {
            assert_eq!(without_lines(said), kept);
        }
    }

    /// A quirk explains only the controller that has it.
    #[test]
    fn a_quirk_of_another_controller_explains_nothing() {
        let explained_by = |controller: &str, explanation: &[&str]| {
            explain(controller, &divergence("a: expected 1, found 2", explanation))
        };
        assert_eq!(explained_by("mill", &[]), None);
        for (controller, explanation, applies, words) in [
            ("rs274", "rs274.nine-levels", true, "explained by rs274.nine-levels"),
            ("mill", "rs274.nine-levels", false, "LinuxCNC does this, too: rs274.nine-levels"),
            ("rs274", "grbl.radius-helix", false, "Grbl does this, too: grbl.radius-helix"),
            ("grblHAL", "grbl.radius-helix", true, "explained by grbl.radius-helix"),
            ("mill", "probe.where = there", true, "explained by probe.where = there"),
        ] {
            let explained = explained_by(controller, &[explanation]).unwrap();
            assert_eq!(
                (explained.applies_to_controller, explained.text.as_str()),
                (applies, words)
            );
        }
    }
}
