//! Programs: declarations, the newline procedure, blocks.

use std::fmt::Write as _;

use super::statements::Writer;
use super::toolpath::FORMATS;
use super::{Known, values};
use crate::generate::Dice;

/// Names of user variables.
const NAMES: &[&str] = &["A", "B", "C", "N", "SEQ", "X2", "AR", "BR", "T", "NAME1", "LINE"];

/// A program for the blocks of a toolpath. The first block gives most variables a value.
pub(super) fn program(
    dice: &mut Dice<'_>,
    systems: Vec<Known>,
    headings: &[&str],
    old_words: bool,
) -> String {
    let mut text = String::new();
    let mut known = systems;
    formats(dice, &mut known, &mut text);
    for variable in known.iter().filter(|known| known.system && !known.text) {
        if dice.chance(10) {
            let _infallible = writeln!(text, "FORMAT ({}) {};", dice.pick(FORMATS), variable.name);
        }
    }
    modalities(dice, &known, old_words, &mut text);
    identical(dice, &known, &mut text);
    let symbol = dice.chance(35).then(|| *dice.pick(&["!", "$", "%", "~"]));
    if let Some(symbol) = symbol {
        let _infallible = writeln!(text, "NEW_LINE_IS {symbol} ;");
        let count = dice.below(4);
        let mut writer = Writer::new(dice, &known, None, old_words);
        writer.statements(count, 1);
        text.push_str(&writer.text);
    }
    let mut headings = headings.to_vec();
    headings.retain(|heading| *heading == "START" || dice.chance(85));
    headings.sort_by_key(|heading| *heading != "START");
    for heading in headings {
        let _infallible = writeln!(text, "{}:", values::spelled(heading, dice));
        let count = dice.range(0, 8);
        let mut writer = Writer::new(dice, &known, symbol, old_words);
        if heading == "START" {
            writer.first_values();
        }
        writer.statements(count, 0);
        text.push_str(&writer.text);
    }
    text
}

fn formats(dice: &mut Dice<'_>, known: &mut Vec<Known>, text: &mut String) {
    let mut names = NAMES.to_vec();
    for _ in 0..dice.range(1, 4) {
        let is_text = dice.chance(25);
        let format = if is_text { "CHARACTER" } else { *dice.pick(FORMATS) };
        let _infallible = write!(text, "{} ({format})", values::spelled("FORMAT", dice));
        for _ in 0..dice.range(1, 3) {
            let place = usize::try_from(dice.below(u32::try_from(names.len()).unwrap_or(1)));
            if names.is_empty() {
                break;
            }
            let name = names.remove(place.unwrap_or_default());
            let size = dice.chance(if name.ends_with('R') { 90 } else { 5 });
            let size = size.then(|| dice.range(1, 4));
            let _infallible = write!(text, " {name}");
            if let Some(size) = size {
                let _infallible = write!(text, "[{size}]");
            }
            known.push(Known { name: name.to_owned(), text: is_text, size, system: false });
        }
        text.push_str(";\n");
    }
}

fn modalities(dice: &mut Dice<'_>, known: &[Known], old_words: bool, text: &mut String) {
    for (word, chance) in [("MODAL", 40), ("NON_MODAL", if old_words { 20 } else { 0 })] {
        let named: Vec<_> = known.iter().filter(|_| dice.chance(chance)).collect();
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

fn identical(dice: &mut Dice<'_>, known: &[Known], text: &mut String) {
    for _ in 0..dice.below(3) {
        let is_text = dice.chance(30);
        let joined: Vec<_> = known
            .iter()
            .filter(|known| known.text == is_text && known.size.is_none() && dice.chance(50))
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
