//! The toolpath: formats and system variables in its head, then the blocks that are processed.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use super::formats::{self, Format, MOST_DIGITS};
use super::lexer::{self, LONGEST_NUMBER, LONGEST_TEXT};
use super::variables::MOST;

/// Most characters of a name.
pub(super) const LONGEST_NAME: usize = 31;
/// Most characters of what is printed for zero.
const LONGEST_ZERO: usize = 16;

/// A variable that the toolpath sets.
#[derive(Clone, Debug)]
pub(super) struct System {
    /// In capitals.
    pub(super) name: String,
    /// Whether it is on where a block names it and off where none does; otherwise its change turns it on.
    pub(super) presence: bool,
    /// A place among the formats.
    pub(super) format: usize,
}

/// The value that a block gives to a system variable.
#[derive(Clone, Debug)]
pub(super) enum Value {
    Number(f64),
    Text(String),
}

/// A block to be processed.
#[derive(Clone, Debug)]
pub(super) struct Processed {
    pub(super) line: u32,
    /// Which block of the program it is for, as [`heading`] writes it.
    pub(super) heading: String,
    /// System variables by place, and their values, in order.
    pub(super) sets: Vec<(usize, Value)>,
}

/// A toolpath, read.
#[derive(Clone, Debug)]
pub(super) struct Toolpath {
    pub(super) formats: [Format; 19],
    pub(super) systems: Vec<System>,
    pub(super) blocks: Vec<Processed>,
}

/// A line is not what it must be.
#[derive(Clone, Copy, Debug)]
struct InvalidLine;

impl Toolpath {
    /// Reads a toolpath.
    ///
    /// # Errors
    /// The first line that is none.
    pub(super) fn read(text: &str) -> Result<Self, u32> {
        let toolpath =
            Self { formats: formats::defaults(), systems: Vec::new(), blocks: Vec::new() };
        let mut reader =
            Reader { toolpath, is_set: [false; 19], names: BTreeMap::new(), set_in: Vec::new() };
        for (line, text) in (1..).zip(text.split_inclusive('\n')) {
            content(text).and_then(|text| reader.line(text, line)).map_err(|InvalidLine| line)?;
        }
        Ok(reader.toolpath)
    }
}

/// What a line says without its end, of which a carriage return is a part before a line feed alone.
fn content(line: &str) -> Result<&str, InvalidLine> {
    match line.strip_suffix('\n') {
        Some(line) => Ok(line.strip_suffix('\r').unwrap_or(line)),
        None if line.ends_with('\r') => Err(InvalidLine),
        None => Ok(line),
    }
}

/// A heading as it is compared: words in capitals, a blank between two of them, a colon before the qualifier.
pub(super) fn heading(name: &str, qualifier: Option<&str>) -> String {
    let mut heading = String::new();
    push_words(name, &mut heading);
    if let Some(qualifier) = qualifier {
        heading.push(':');
        push_words(qualifier, &mut heading);
    }
    heading
}

fn push_words(words: &str, text: &mut String) {
    for (place, word) in words.split([' ', '\t']).filter(|word| !word.is_empty()).enumerate() {
        if place > 0 {
            text.push(' ');
        }
        text.extend(word.chars().map(|letter| letter.to_ascii_uppercase()));
    }
}

/// Whether a text is words of a heading, one at least.
fn is_words(text: &str) -> bool {
    let is_of_words = |c| lexer::is_of_word(c) || c == ' ' || c == '\t';
    text.chars().all(is_of_words) && text.chars().any(lexer::is_of_word)
}

struct Reader {
    toolpath: Toolpath,
    /// Which formats have been set.
    is_set: [bool; 19],
    names: BTreeMap<String, usize>,
    /// The line in which each system variable was set last.
    set_in: Vec<u32>,
}

impl Reader {
    fn line(&mut self, text: &str, line: u32) -> Result<(), InvalidLine> {
        let text = text.trim_matches([' ', '\t']);
        if text.is_empty() || text.starts_with('#') {
            return Ok(());
        }
        let length = text.find([' ', '\t']).unwrap_or(text.len());
        let (keyword, rest) = (text.get(..length), text.get(length..).unwrap_or_default());
        let is = |word: &str| keyword.is_some_and(|keyword| keyword.eq_ignore_ascii_case(word));
        if is("block") {
            self.block(rest, line)
        } else if !self.toolpath.blocks.is_empty() {
            Err(InvalidLine)
        } else if is("format") {
            self.format(rest)
        } else if is("system") {
            self.system(rest)
        } else {
            Err(InvalidLine)
        }
    }

    fn format(&mut self, rest: &str) -> Result<(), InvalidLine> {
        let mut words = rest.split([' ', '\t']).filter(|word| !word.is_empty());
        let place = words.next().and_then(|name| formats::named(&name.to_ascii_uppercase()));
        let place = place.ok_or(InvalidLine)?;
        let is_set = self.is_set.get_mut(place).ok_or(InvalidLine)?;
        if core::mem::replace(is_set, true) {
            return Err(InvalidLine);
        }
        let format = self.toolpath.formats.get_mut(place).ok_or(InvalidLine)?;
        let mut keys = Vec::new();
        for word in words {
            let (key, value) = word.split_once('=').ok_or(InvalidLine)?;
            let key = key.to_ascii_lowercase();
            if place == formats::CHARACTER && key != "modal" || keys.contains(&key) {
                return Err(InvalidLine);
            }
            set_key(format, &key, value)?;
            keys.push(key);
        }
        Ok(())
    }

    fn system(&mut self, rest: &str) -> Result<(), InvalidLine> {
        let mut words = rest.split([' ', '\t']).filter(|word| !word.is_empty());
        let (Some(name), Some(class), Some(format), None) =
            (words.next(), words.next(), words.next(), words.next())
        else {
            return Err(InvalidLine);
        };
        let name = name.to_ascii_uppercase();
        let presence = class.eq_ignore_ascii_case("presence");
        let format = formats::named(&format.to_ascii_uppercase()).ok_or(InvalidLine)?;
        let letter_first = name.starts_with(|c: char| c.is_ascii_alphabetic());
        let is_name = letter_first && name.contains('_') && name.chars().all(lexer::is_of_word);
        if !is_name
            || name.len() > LONGEST_NAME
            || super::words::is_taken(&name)
            || !(presence || class.eq_ignore_ascii_case("change"))
        {
            return Err(InvalidLine);
        }
        let place = self.toolpath.systems.len();
        if place == MOST {
            return Err(InvalidLine);
        }
        if self.names.insert(name.clone(), place).is_some() {
            return Err(InvalidLine);
        }
        self.set_in.push(0);
        self.toolpath.systems.push(System { name, presence, format });
        Ok(())
    }

    fn block(&mut self, rest: &str, line: u32) -> Result<(), InvalidLine> {
        let (name, mut rest) = rest.split_once(':').ok_or(InvalidLine)?;
        if !is_words(name) {
            return Err(InvalidLine);
        }
        let mut qualifier = None;
        if let Some((words, behind)) = rest.split_once(':')
            && is_words(words)
        {
            qualifier = Some(words);
            rest = behind;
        }
        let heading = heading(name, qualifier);
        let mut sets: Vec<(usize, Value)> = Vec::new();
        loop {
            let trimmed = rest.trim_start_matches([' ', '\t']);
            if trimmed.is_empty() {
                break;
            }
            let (name, behind) = trimmed.split_once('=').ok_or(InvalidLine)?;
            let place = *self.names.get(&name.to_ascii_uppercase()).ok_or(InvalidLine)?;
            let set_in = self.set_in.get_mut(place).ok_or(InvalidLine)?;
            if core::mem::replace(set_in, line) == line {
                return Err(InvalidLine);
            }
            let (value, behind) = value(behind)?;
            let system = self.toolpath.systems.get(place).ok_or(InvalidLine)?;
            if (system.format == formats::CHARACTER) != matches!(value, Value::Text(_)) {
                return Err(InvalidLine);
            }
            sets.push((place, value));
            rest = behind;
        }
        self.toolpath.blocks.push(Processed { line, heading, sets });
        Ok(())
    }
}

/// A value, and the text after it.
fn value(text: &str) -> Result<(Value, &str), InvalidLine> {
    let (value, behind) = if let Some(text) = text.strip_prefix('"') {
        let (text, behind) = text.split_once('"').ok_or(InvalidLine)?;
        if text.chars().nth(LONGEST_TEXT).is_some() {
            return Err(InvalidLine);
        }
        (Value::Text(text.into()), behind)
    } else {
        let length = text.find([' ', '\t']).unwrap_or(text.len());
        let (word, behind) = text.split_at_checked(length).ok_or(InvalidLine)?;
        let negative = word.starts_with('-');
        let digits = word.strip_prefix(['+', '-']).unwrap_or(word);
        let magnitude = lexer::number(digits).filter(|_| word.len() <= LONGEST_NUMBER);
        let magnitude = magnitude.ok_or(InvalidLine)?;
        (Value::Number(if negative { -magnitude } else { magnitude }), behind)
    };
    if behind.is_empty() || behind.starts_with([' ', '\t']) {
        Ok((value, behind))
    } else {
        Err(InvalidLine)
    }
}

fn set_key(format: &mut Format, key: &str, value: &str) -> Result<(), InvalidLine> {
    match key {
        "integer" => {
            format.integer = range(value)?;
            if format.integer.1 == 0 {
                return Err(InvalidLine);
            }
        }
        "fraction" => format.fraction = range(value)?,
        "leading" => format.leading = yes(value)?,
        "trailing" => format.trailing = yes(value)?,
        "plus" => format.plus = character(value)?,
        "minus" => format.minus = character(value)?,
        "point" => format.point = character(value)?.ok_or(InvalidLine)?,
        "whole_point" => format.whole_point = yes(value)?,
        "zero" if value.chars().nth(LONGEST_ZERO).is_none() => format.zero = value.into(),
        "modal" => format.modal = yes(value)?,
        _ => return Err(InvalidLine),
    }
    Ok(())
}

fn range(text: &str) -> Result<(u32, u32), InvalidLine> {
    let count = |text: &str| {
        let digits = text.bytes().all(|byte| byte.is_ascii_digit());
        text.parse().ok().filter(|count: &u32| digits && *count <= MOST_DIGITS)
    };
    let (fewest, most) = text.split_once("..").ok_or(InvalidLine)?;
    match (count(fewest), count(most)) {
        (Some(fewest), Some(most)) if fewest <= most => Ok((fewest, most)),
        _ => Err(InvalidLine),
    }
}

fn yes(text: &str) -> Result<bool, InvalidLine> {
    if text.eq_ignore_ascii_case("yes") {
        Ok(true)
    } else if text.eq_ignore_ascii_case("no") {
        Ok(false)
    } else {
        Err(InvalidLine)
    }
}

/// One character, or none where there is nothing.
fn character(text: &str) -> Result<Option<char>, InvalidLine> {
    let mut characters = text.chars();
    let first = characters.next();
    if characters.next().is_none() { Ok(first) } else { Err(InvalidLine) }
}
