//! The toolpath: the file that declares system variables and drives a program, block by block.

use std::collections::BTreeSet;

use gaugeblock_vocabulary::FaultKind;

use super::formats::{self, CHARACTER, Format, MOST_DIGITS, NAMES};
use super::refusal::{StepError, refuse_form};
use super::syntax::{Heading, is_keyword};
use super::text::{LONGEST_NUMBER, LONGEST_TEXT, is_number};
use super::variables::{Class, Value, Variables, is_system_name};
use crate::Choices;

/// Most characters of what is printed for zero.
const LONGEST_ZERO: usize = 16;

/// A toolpath as it is read.
#[derive(Clone, Debug)]
pub struct Toolpath {
    /// The system variables, and the formats of the run.
    pub variables: Variables,
    /// The blocks that are processed, in order.
    pub blocks: Vec<Processed>,
}

/// A block that is processed.
#[derive(Clone, Debug, PartialEq)]
pub struct Processed {
    /// Its line.
    pub line: u32,
    /// Its name and qualifier.
    pub heading: Heading,
    /// The system variables that it gives values, by their places.
    pub values: Vec<(usize, Value)>,
}

/// Reads a toolpath.
///
/// # Errors
/// The first line that is not of its form, and why.
pub fn read(text: &str, choices: &Choices) -> Result<Toolpath, (u32, StepError)> {
    let mut reader = Reader {
        choices,
        given: BTreeSet::new(),
        toolpath: Toolpath { variables: Variables::new(formats::all()), blocks: Vec::new() },
    };
    for (line, number) in text.split_inclusive('\n').zip(1..) {
        let read = content(line).and_then(|line| reader.line(line, number));
        read.map_err(|error| (number, error))?;
    }
    // A format may be given behind the variables that have it.
    reader.toolpath.variables.take_modality_of_formats(choices);
    Ok(reader.toolpath)
}

/// A line without its end: a line feed, a carriage return and a line feed, or nothing where the file ends.
fn content(line: &str) -> Result<&str, StepError> {
    let Some(line) = line.strip_suffix('\n') else {
        return if line.ends_with('\r') {
            Err(bad("a carriage return ends no line"))
        } else {
            Ok(line)
        };
    };
    Ok(line.strip_suffix('\r').unwrap_or(line))
}

struct Reader<'a> {
    choices: &'a Choices,
    /// Formats that the head has given.
    given: BTreeSet<usize>,
    toolpath: Toolpath,
}

fn bad(message: impl Into<String>) -> StepError {
    refuse_form(FaultKind::BadFile, message)
}

/// The first word of a text, and what comes after the blanks behind it.
fn word(text: &str) -> (&str, &str) {
    let text = text.trim_matches([' ', '\t']);
    let (word, rest) = text.split_once([' ', '\t']).unwrap_or((text, ""));
    (word, rest.trim_start_matches([' ', '\t']))
}

impl Reader<'_> {
    fn line(&mut self, line: &str, number: u32) -> Result<(), StepError> {
        let (first, rest) = word(line);
        if first.is_empty() || first.starts_with('#') {
            return Ok(());
        }
        let is_head = self.toolpath.blocks.is_empty();
        match first.to_ascii_lowercase().as_str() {
            "format" if is_head => self.format(rest),
            "system" if is_head => self.system(rest),
            "format" | "system" => Err(bad("the head comes before the first block")),
            "block" => self.block(rest, number),
            _ => Err(bad(format!("a line begins with format, system or block, not {first}"))),
        }
    }

    fn format(&mut self, text: &str) -> Result<(), StepError> {
        let (name, mut rest) = word(text);
        let place = format_of(name)?;
        if !self.given.insert(place) {
            return Err(bad("this format has been given"));
        }
        let mut keys = BTreeSet::new();
        while !rest.is_empty() {
            let (pair, after) = word(rest);
            rest = after;
            let (key, value) = pair.split_once('=').ok_or_else(|| bad("a format has key=value"))?;
            let key = key.to_ascii_lowercase();
            if place == CHARACTER && key != "modal" {
                return Err(bad("texts are printed as they are"));
            }
            set_key(&mut self.toolpath.variables.formats[place], &key, value)?;
            if !keys.insert(key) {
                return Err(bad("a key occurs twice"));
            }
        }
        Ok(())
    }

    fn system(&mut self, text: &str) -> Result<(), StepError> {
        let (name, rest) = word(text);
        let (class, rest) = word(rest);
        let (format, rest) = word(rest);
        let name = name.to_ascii_uppercase();
        if !is_system_name(&name) || is_keyword(&name) {
            return Err(bad("not a valid name of a system variable"));
        }
        if self.toolpath.variables.place(&name).is_some() {
            return Err(bad("this variable has been declared"));
        }
        let class = match class.to_ascii_lowercase().as_str() {
            "change" => Class::Change,
            "presence" => Class::Presence,
            _ => return Err(bad("a system variable is of the class change or presence")),
        };
        let format = format_of(format)?;
        if !rest.is_empty() {
            return Err(bad("unexpected text after the format"));
        }
        let declared =
            self.toolpath.variables.declare(&name, None, format, Some(class), self.choices);
        declared.map_err(|_| bad("there are too many variables"))
    }

    fn block(&mut self, text: &str, line: u32) -> Result<(), StepError> {
        let (name, rest) =
            text.split_once(':').ok_or_else(|| bad("a block's name ends with a colon"))?;
        let name = words(name).ok_or_else(|| bad("not a valid name of a block"))?;
        let before_values = &rest[..rest.find(['=', '"']).unwrap_or(rest.len())];
        let (qualifier, mut rest) = match before_values.split_once(':') {
            Some((qualifier, _)) => {
                let words =
                    words(qualifier).ok_or_else(|| bad("not a valid qualifier of a block"))?;
                (Some(words), &rest[qualifier.len() + 1..])
            }
            None => (None, rest),
        };
        let mut values = Vec::new();
        let mut named = BTreeSet::new();
        loop {
            rest = rest.trim_start_matches([' ', '\t']);
            if rest.is_empty() {
                break;
            }
            let (variable, value, after) = self.value(rest)?;
            if !named.insert(variable) {
                return Err(bad("a variable occurs twice in a line"));
            }
            values.push((variable, value));
            rest = after;
        }
        self.toolpath.blocks.push(Processed { line, heading: Heading { name, qualifier }, values });
        Ok(())
    }

    /// The pair with which a text begins, and what stands behind it.
    fn value<'t>(&self, text: &'t str) -> Result<(usize, Value, &'t str), StepError> {
        let (name, rest) = text.split_once('=').ok_or_else(|| bad("a value is NAME=VALUE"))?;
        let variables = &self.toolpath.variables;
        let variable = variables
            .place(&name.to_ascii_uppercase())
            .ok_or_else(|| bad(format!("there is no system variable {name}")))?;
        let (value, rest) = match rest.strip_prefix('"') {
            Some(rest) => {
                let (text, rest) = rest.split_once('"').ok_or_else(|| bad("an open text"))?;
                if text.chars().count() > LONGEST_TEXT {
                    return Err(bad(format!("a text has {LONGEST_TEXT} characters at most")));
                }
                (Value::Text(text.to_owned()), rest)
            }
            None => {
                let end = rest.find([' ', '\t']).unwrap_or(rest.len());
                (Value::Number(number(&rest[..end])?), &rest[end..])
            }
        };
        if !rest.is_empty() && !rest.starts_with([' ', '\t']) {
            return Err(bad("no blank between two values"));
        }
        if matches!(value, Value::Text(_)) != variables.is_text(variable) {
            return Err(bad(format!("{name} has a value of the other type")));
        }
        Ok((variable, value, rest))
    }
}

fn number(text: &str) -> Result<f64, StepError> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    let is_number = is_number(digits) && text.len() <= LONGEST_NUMBER;
    let number = text.parse().ok().filter(|_| is_number);
    number.ok_or_else(|| bad(format!("not a number: {text}")))
}

fn format_of(name: &str) -> Result<usize, StepError> {
    let name = name.to_ascii_uppercase();
    let place = NAMES.iter().position(|known| *known == name);
    place.ok_or_else(|| bad(format!("there is no format {name}")))
}

fn set_key(format: &mut Format, key: &str, value: &str) -> Result<(), StepError> {
    match key {
        "integer" => {
            format.integer = digits(value).filter(|(_, most)| *most > 0).ok_or_else(few)?;
        }
        "fraction" => format.fraction = digits(value).ok_or_else(few)?,
        "leading" => format.leading = yes(value)?,
        "trailing" => format.trailing = yes(value)?,
        "whole_point" => format.whole_point = yes(value)?,
        "modal" => format.modal = yes(value)?,
        "plus" => format.plus = character(value)?,
        "minus" => format.minus = character(value)?,
        "point" => format.point = character(value)?.ok_or_else(|| bad("a point is needed"))?,
        "zero" if value.chars().count() > LONGEST_ZERO => {
            return Err(bad(format!("zero has {LONGEST_ZERO} characters at most")));
        }
        "zero" => format.zero = Some(value.to_owned()).filter(|text| !text.is_empty()),
        _ => return Err(bad(format!("a format has no key {key}"))),
    }
    Ok(())
}

fn few() -> StepError {
    bad(format!("digits are FEWEST..MOST, {MOST_DIGITS} at most"))
}

fn digits(text: &str) -> Option<(usize, usize)> {
    let (fewest, most) = text.split_once("..")?;
    let number = |text: &str| {
        let is_plain = text.chars().all(|c| c.is_ascii_digit());
        text.parse::<usize>().ok().filter(|_| is_plain)
    };
    let (fewest, most) = (number(fewest)?, number(most)?);
    (fewest <= most && most <= MOST_DIGITS).then_some((fewest, most))
}

fn yes(text: &str) -> Result<bool, StepError> {
    match text.to_ascii_lowercase().as_str() {
        "yes" => Ok(true),
        "no" => Ok(false),
        _ => Err(bad("it is yes or no")),
    }
}

fn character(text: &str) -> Result<Option<char>, StepError> {
    let mut characters = text.chars();
    match (characters.next(), characters.next()) {
        (first, None) => Ok(first),
        (_, Some(_)) => Err(bad("it is one character, or none")),
    }
}

/// Words of letters, digits and underscores in capitals, with one blank between them; `None` where there is none, or
/// another sign.
fn words(text: &str) -> Option<String> {
    let words: Vec<String> =
        text.split([' ', '\t']).filter(|w| !w.is_empty()).map(str::to_ascii_uppercase).collect();
    let is_word = |word: &String| word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
    (!words.is_empty() && words.iter().all(is_word)).then(|| words.join(" "))
}
