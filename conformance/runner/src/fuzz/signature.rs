//! What a divergence is by, so that thousands of programs with one cause are one group.

use gaugeblock_compare::{Divergence, NEXT_BLOCK};
use gaugeblock_reference::RuleOutcome;
use gaugeblock_vocabulary::{Program, Scenario};
use serde::{Deserialize, Serialize};

/// A number or another value that is not a word.
const VALUE: &str = "a value";

/// What differs, without what is accidental: lines, numbers, indexes. Kept while a program is shrunk.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub struct Signature {
    /// `effect`, `end`, [`NEXT_BLOCK`] or a field's name.
    pub field: String,
    /// The kind of what one side has.
    pub expected: String,
    /// The kind of what the other side has.
    pub found: String,
}

impl Signature {
    /// The signature of a divergence.
    pub fn of(divergence: &Divergence) -> Self {
        let field = without_index(&divergence.field);
        let (expected, found) = if field == NEXT_BLOCK {
            Default::default()
        } else {
            (kind_of(&divergence.expected), kind_of(&divergence.found))
        };
        Self { field, expected, found }
    }
}

impl std::fmt::Display for Signature {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}", self.field)?;
        match (self.found.as_str(), self.expected.as_str()) {
            ("", "") => Ok(()),
            (VALUE, VALUE) => write!(f, ": different values"),
            (found, expected) if found == expected => write!(f, ": different {found}"),
            (found, expected) => write!(f, ": {found} against {expected}"),
        }
    }
}

/// `spindle[0]` is `spindle`; parameters that programs use are alike, those that tell the state are not.
fn without_index(field: &str) -> String {
    let number = field.strip_prefix('#').and_then(|rest| rest.strip_suffix(" at the end"));
    if let Some(number) = number.and_then(|number| number.parse::<u32>().ok()) {
        return if number <= 5000 { "#n at the end".to_owned() } else { field.to_owned() };
    }
    let name = field.split('[').next().unwrap_or_default();
    if name == "parameter" && !field.contains("[_") {
        "parameter".to_owned()
    } else {
        name.to_owned()
    }
}

/// Words stay, numbers do not, and an effect is its name; a fault keeps its kind.
fn kind_of(value: &str) -> String {
    if let Some(rest) = value.strip_prefix("refused") {
        let kind = rest.find('(').map_or("", |at| &rest[at..]);
        return format!("refused {kind}").trim_end().to_owned();
    }
    if value == "no such effect" || value.starts_with("budget exhausted") {
        return value.to_owned();
    }
    let word = value.split([' ', ':']).next().unwrap_or_default();
    let is_word = word.chars().all(|c| c.is_ascii_alphabetic() || c == '_');
    if is_word && !word.is_empty() {
        if value.contains('=') { word.to_owned() } else { value.to_owned() }
    } else {
        VALUE.to_owned()
    }
}

/// The rules that the block at which two runs differ adds to what the model reaches; of a small program few are left.
pub fn rules(scenario: &Scenario, divergence: &Divergence) -> Vec<String> {
    let reached = reached_at(scenario, divergence).into_iter();
    reached.map(|(rule, outcome)| format!("{rule} ({outcome:?})").to_lowercase()).collect()
}

/// The same, as ids and outcomes.
pub(super) fn reached_at(
    scenario: &Scenario,
    divergence: &Divergence,
) -> Vec<(&'static str, RuleOutcome)> {
    let reached =
        |scenario: &Scenario| gaugeblock_reference::run(scenario).1.iter().collect::<Vec<_>>();
    let all = reached(scenario);
    let block = divergence.block.as_ref().filter(|block| block.file == Program::MAIN);
    let line = block.and_then(|block| usize::try_from(block.line).ok());
    let without = line.map(|line| {
        let lines = scenario.program.language.lines(&scenario.program.main).enumerate();
        let kept = lines.map(|(at, text)| if at + 1 == line { "" } else { text });
        let main = kept.flat_map(|text| [text, "\n"]).collect();
        let program = Program { main, ..scenario.program.clone() };
        reached(&Scenario { program, ..scenario.clone() })
    });
    let without = without.unwrap_or_default();
    let added: Vec<_> = all.iter().filter(|rule| !without.contains(rule)).copied().collect();
    if added.is_empty() { all } else { added }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn signature(field: &str, expected: &str, found: &str) -> String {
        let of = |text: &str| text.to_owned();
        let divergence =
            Divergence { block: None, field: of(field), expected: of(expected), found: of(found) };
        Signature::of(&divergence).to_string()
    }

    #[test]
    fn signature_drops_lines_and_numbers() {
        assert_eq!(
            signature("end", "refused at main.ngc:3 (zero_feed)", "program end"),
            "end: program end against refused (zero_feed)"
        );
        assert_eq!(signature("spindle_speed[2]", "100", "0"), "spindle_speed: different values");
        assert_eq!(signature("motion", "traverse", "none"), "motion: none against traverse");
        assert_eq!(
            signature("effect", "straight_feed end=(x1)", "no such effect"),
            "effect: no such effect against straight_feed"
        );
        assert_eq!(signature(NEXT_BLOCK, "main.ngc:4", "main.ngc:7"), "next executed block");
        assert_eq!(signature("#31 at the end", "1", "2"), "#n at the end: different values");
    }
}
