//! Whether a refusal is evidence of an option of a choice, or has another reason.
//!
//! A controller that does not have a word refuses each program with it. Such a refusal says nothing about a choice.
//! It counts only with evidence:
//!
//! 1. The controller and the model name the same kind of fault. Another kind decides nothing: a block can have two
//!    faults, and no document says which one is reported.
//! 2. Otherwise *control programs* decide: the same program with one word of the refused block removed, or with another
//!    number in it. The model says which of them are lawful under the option. For each word, the controller has to
//!    accept one lawful control program with that word.

use gaugeblock_adapter::Adapter;
use gaugeblock_suite::assertion::is_accepted;
use gaugeblock_vocabulary::{End, Fault, Language, Program, Scenario};

/// Whether a refusal is the one of an option.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum RefusalReason {
    /// The refusal of the option.
    Option,
    /// Another refusal, or one of unknown reason. The text says why.
    Other(String),
}

/// Finds out whether a controller refuses the program of a choice for the reason of an option. The scenario has that
/// option.
pub(super) fn reason(
    controller: &dyn Adapter,
    scenario: &Scenario,
    found: &Fault,
) -> RefusalReason {
    let End::Fault(expected) = gaugeblock_reference::run(scenario).0.end else {
        return RefusalReason::Other(format!("refused: {}", found.message));
    };
    let has_kinds = controller.observables(scenario).faults_have_kinds;
    let found_kind = found.kind.filter(|_| has_kinds);
    if found_kind.is_some() && found_kind == expected.kind {
        return RefusalReason::Option;
    }
    let said = match (found_kind, expected.kind) {
        (Some(kind), Some(expected)) => format!("{kind}, not {expected}: {}", found.message),
        _ => found.message.clone(),
    };
    let line = expected.block.as_ref().filter(|block| block.file == Program::MAIN);
    let controls = line.and_then(|block| Controls::of(scenario, block.line));
    match controls.map_or(Evidence::Missing, |controls| controls.evidence(controller)) {
        Evidence::Accepted => RefusalReason::Option,
        Evidence::Refused(word) => RefusalReason::Other(format!(
            "refused for another reason, since lawful programs with `{word}` are refused, too: {said}"
        )),
        Evidence::Missing if found_kind.is_some() => {
            RefusalReason::Other(format!("refused for another reason: {said}"))
        }
        Evidence::Missing => RefusalReason::Other(format!(
            "refused, but the reason is not known without kinds of faults: {said}"
        )),
    }
}

/// What control programs say of a refusal.
enum Evidence<'a> {
    /// The controller accepts lawful programs with the words of the refused block.
    Accepted,
    /// It refuses every lawful one with this word.
    Refused(&'a str),
    /// No control program is lawful.
    Missing,
}

/// The control programs of a refused block.
struct Controls<'a> {
    scenario: &'a Scenario,
    line: usize,
    words: Vec<&'a str>,
}

impl<'a> Controls<'a> {
    /// None if the block does not consist of words.
    fn of(scenario: &'a Scenario, line: u32) -> Option<Self> {
        if scenario.program.language != Language::Rs274 {
            return None;
        }
        let line = usize::try_from(line).ok()?.checked_sub(1)?;
        let block = scenario.program.main.lines().nth(line)?;
        let words = words(block)?;
        Some(Self { scenario, line, words })
    }

    /// A word without a lawful control program is what the choice is about; if no word has one, the block is.
    fn evidence(&self, controller: &dyn Adapter) -> Evidence<'a> {
        let mut blocks = self.blocks();
        blocks.retain(|block| is_lawful(&self.program(block)));
        let mut evidence = Evidence::Missing;
        for word in &self.words {
            let has_word = |block: &&Vec<String>| block.iter().any(|other| is_same(other, word));
            let mut with_word = blocks.iter().filter(has_word).peekable();
            if with_word.peek().is_none() {
                continue;
            }
            if !with_word.any(|block| accepts(controller, &self.program(block))) {
                return Evidence::Refused(word);
            }
            evidence = Evidence::Accepted;
        }
        let without_block = self.program(&[]);
        if matches!(evidence, Evidence::Missing)
            && is_lawful(&without_block)
            && accepts(controller, &without_block)
        {
            evidence = Evidence::Accepted;
        }
        evidence
    }

    /// The block without one word, and with another number in one word.
    fn blocks(&self) -> Vec<Vec<String>> {
        let own = || self.words.iter().map(|word| (*word).to_owned());
        let mut blocks = Vec::new();
        for (place, word) in self.words.iter().enumerate() {
            let mut block: Vec<String> = own().collect();
            block.remove(place);
            blocks.push(block);
            for other in other_numbers(word) {
                let mut block: Vec<String> = own().collect();
                block[place] = other;
                blocks.push(block);
            }
        }
        blocks
    }

    fn program(&self, block: &[String]) -> Scenario {
        let mut scenario = self.scenario.clone();
        let lines = scenario.program.main.lines().enumerate();
        let lines = lines.map(|(at, line)| match at == self.line {
            true => block.join(" ") + "\n",
            false => format!("{line}\n"),
        });
        scenario.program.main = lines.collect();
        scenario
    }
}

fn is_lawful(scenario: &Scenario) -> bool {
    is_accepted(&gaugeblock_reference::run(scenario).0.end)
}

fn accepts(controller: &dyn Adapter, scenario: &Scenario) -> bool {
    if controller.supports(scenario).is_err() {
        return false;
    }
    let outcome = controller.run_fresh(scenario).unwrap_or_else(|| controller.run(scenario));
    outcome.is_ok_and(|outcome| is_accepted(&outcome.end))
}

/// The words of a block: a letter and what follows it up to the next letter outside of brackets. None for a block with
/// an O-word, a comment or anything else.
fn words(block: &str) -> Option<Vec<&str>> {
    let mut begins = Vec::new();
    let mut depth = 0_u32;
    for (at, c) in block.char_indices() {
        match c {
            '[' => depth += 1,
            ']' => depth = depth.checked_sub(1)?,
            _ if depth > 0 => {}
            'o' | 'O' | '(' | ';' | '%' | '/' | '#' => return None,
            'a'..='z' | 'A'..='Z' | '$' | '@' | '^' => begins.push(at),
            _ => {}
        }
    }
    if depth > 0 {
        return None;
    }
    let ends = begins.iter().skip(1).copied().chain([block.len()]);
    let words = begins.iter().zip(ends).map(|(begin, end)| block.get(*begin..end).map(str::trim));
    let words: Vec<_> = words.collect::<Option<_>>()?;
    (!words.is_empty()).then_some(words)
}

/// Whether two words are the same for a controller that does not have one of them: G and M codes by their numbers,
/// others by their letters.
fn is_same(one: &str, other: &str) -> bool {
    let letter = |word: &str| word.chars().next().map(|letter| letter.to_ascii_lowercase());
    match letter(one) {
        Some('g' | 'm') => one == other,
        own => own == letter(other),
    }
}

/// A word with other numbers. Another G or M code is another word.
fn other_numbers(word: &str) -> Vec<String> {
    let mut chars = word.chars();
    let Some(letter) =
        chars.next().filter(|letter| !matches!(letter.to_ascii_lowercase(), 'g' | 'm'))
    else {
        return Vec::new();
    };
    let number: Option<f64> = chars.as_str().trim().parse().ok();
    let near = number.map(|number| [-number, number + 1.0, number - 1.0]);
    let all = [1.0, 0.0, 2.0, 5.0].into_iter().chain(near.into_iter().flatten());
    let others = all.filter(|other| number.is_none_or(|number| (number - other).abs() > 1e-9));
    let mut words: Vec<String> = Vec::new();
    for word in others.map(|other| format!("{letter}{}", other + 0.0)) {
        if !words.contains(&word) {
            words.push(word);
        }
    }
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_of_a_block_end_at_the_next_letter() {
        assert_eq!(words("g2 i0 z[1 + 2]x3"), Some(vec!["g2", "i0", "z[1 + 2]", "x3"]));
        for other in ["o1 if [1]", "#31=1", "g0 x#31", "(comment)", "", "g0 x[1", "g0 x]1["] {
            assert_eq!(words(other), None, "{other}");
        }
    }

    #[test]
    fn code_with_another_number_is_another_word() {
        assert!(other_numbers("g2").is_empty());
        assert_eq!(other_numbers("i0"), ["i1", "i2", "i5", "i-1"]);
        assert!(is_same("I0", "i5") && is_same("g2", "g2") && !is_same("g2", "g3"));
    }
}
