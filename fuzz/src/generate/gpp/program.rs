//! Programs: declarations, the newline procedure, blocks.

use std::fmt::Write as _;

use super::statements::Writer;
use super::toolpath::FORMATS;
use super::values;
use super::variable::Variable;
use crate::generate::Entropy;

/// Names of user variables.
const NAMES: &[&str] = &["A", "B", "C", "N", "SEQ", "X2", "AR", "BR", "T", "NAME1", "LINE"];

/// A program for the blocks of a toolpath. The first block gives most variables a value.
pub(super) fn program(
    entropy: &mut Entropy<'_>,
    systems: Vec<Variable>,
    headings: &[&str],
    old_words: bool,
) -> String {
    let mut text = String::new();
    let mut known = systems;
    formats(entropy, &mut known, &mut text);
    for variable in known.iter().filter(|known| known.system && !known.text) {
        if entropy.chance(10) {
            let _infallible =
                writeln!(text, "FORMAT ({}) {};", entropy.pick(FORMATS), variable.name);
        }
    }
    modalities(entropy, &known, old_words, &mut text);
    identical(entropy, &known, &mut text);
    let symbol = entropy.chance(35).then(|| *entropy.pick(&["!", "$", "%", "~"]));
    if let Some(symbol) = symbol {
        let _infallible = writeln!(text, "NEW_LINE_IS {symbol} ;");
        let count = entropy.below(4);
        let mut writer = Writer::new(entropy, &known, None, old_words);
        writer.statements(count, 1);
        text.push_str(&writer.text);
    }
    let mut headings = headings.to_vec();
    headings.retain(|heading| *heading == "START" || entropy.chance(85));
    headings.sort_by_key(|heading| *heading != "START");
    for heading in headings {
        let _infallible = writeln!(text, "{}:", values::spelled(heading, entropy));
        let count = entropy.range(0, 8);
        let mut writer = Writer::new(entropy, &known, symbol, old_words);
        if heading == "START" {
            writer.first_values();
        }
        writer.statements(count, 0);
        text.push_str(&writer.text);
    }
    text
}

fn formats(entropy: &mut Entropy<'_>, known: &mut Vec<Variable>, text: &mut String) {
    let mut names = NAMES.to_vec();
    for _ in 0..entropy.range(1, 4) {
        let is_text = entropy.chance(25);
        let format = if is_text { "CHARACTER" } else { *entropy.pick(FORMATS) };
        let _infallible = write!(text, "{} ({format})", values::spelled("FORMAT", entropy));
        for _ in 0..entropy.range(1, 3) {
            let place = usize::try_from(entropy.below(u32::try_from(names.len()).unwrap_or(1)));
            if names.is_empty() {
                break;
            }
            let name = names.remove(place.unwrap_or_default());
            let size = entropy.chance(if name.ends_with('R') { 90 } else { 5 });
            let size = size.then(|| entropy.range(1, 4));
            let _infallible = write!(text, " {name}");
            if let Some(size) = size {
                let _infallible = write!(text, "[{size}]");
            }
            known.push(Variable { name: name.to_owned(), text: is_text, size, system: false });
        }
        text.push_str(";\n");
    }
}

fn modalities(entropy: &mut Entropy<'_>, known: &[Variable], old_words: bool, text: &mut String) {
    for (word, chance) in [("MODAL", 40), ("NON_MODAL", if old_words { 20 } else { 0 })] {
        let named: Vec<_> = known.iter().filter(|_| entropy.chance(chance)).collect();
        if named.is_empty() {
            continue;
        }
        text.push_str(word);
        for variable in named {
            let _infallible = write!(text, " {}", variable.name);
        }
        text.push_str(";\n");
    }
}

fn identical(entropy: &mut Entropy<'_>, known: &[Variable], text: &mut String) {
    for _ in 0..entropy.below(3) {
        let is_text = entropy.chance(30);
        let joined: Vec<_> = known
            .iter()
            .filter(|known| known.text == is_text && known.size.is_none() && entropy.chance(50))
            .collect();
        if joined.len() < 2 {
            continue;
        }
        text.push_str("IDENTICAL");
        for variable in joined {
            let _infallible = write!(text, " {}", variable.name);
        }
        text.push_str(";\n");
    }
}
