//! One line of the text form: words and `name=value` pairs.

use alloc::borrow::ToOwned as _;
use alloc::collections::BTreeSet;
use alloc::format;
use alloc::string::String;
use alloc::vec::Vec;

use super::value::{FromText as _, ReadArgument};
use crate::error::TextError;

/// The arguments of a line: `name=value` pairs that have not been taken yet.
#[derive(Clone, Debug, Default)]
pub struct Arguments {
    pairs: Vec<(String, Option<String>, String)>,
}

impl Arguments {
    /// Splits `name=value name[index]=value …`.
    ///
    /// # Errors
    /// A part without a name or value, or a quote or parenthesis that is not closed.
    pub fn parse(text: &str) -> Result<Self, TextError> {
        let mut pairs = Vec::new();
        let mut seen = BTreeSet::new();
        let mut rest = text.trim_start();
        while !rest.is_empty() {
            let name_end = rest.find(['=', '[']).ok_or_else(|| no_pair(rest))?;
            let name = &rest[..name_end];
            if name.is_empty() || name.contains(char::is_whitespace) {
                return Err(no_pair(rest));
            }
            rest = &rest[name_end..];
            let mut index = None;
            if let Some(after) = rest.strip_prefix('[') {
                let end = index_end(after).ok_or_else(|| no_pair(rest))?;
                index = Some(unquoted(&after[..end])?);
                rest = after[end..].strip_prefix(']').ok_or_else(|| no_pair(rest))?;
            }
            let after = rest.strip_prefix('=').ok_or_else(|| no_pair(rest))?;
            let end = value_end(after)?;
            if !seen.insert((name, index.clone())) {
                return Err(TextError::new(format!("this occurs twice in the line: {name}")));
            }
            pairs.push((name.to_owned(), index, after[..end].to_owned()));
            rest = &after[end..];
            if !rest.is_empty() && !rest.starts_with(char::is_whitespace) {
                return Err(no_pair(rest));
            }
            rest = rest.trim_start();
        }
        Ok(Self { pairs })
    }

    /// Takes an argument by name.
    ///
    /// # Errors
    /// It is missing though required, or unreadable.
    pub fn take<T: ReadArgument>(&mut self, name: &str) -> Result<T, TextError> {
        let found = self.pairs.iter().position(|(pair, index, _)| pair == name && index.is_none());
        let text = found.map(|place| self.pairs.remove(place).2);
        T::read(text.as_deref())
            .map_err(|error| TextError::new(format!("argument {name}: {}", error.message)))
    }

    /// Checks that nothing is left.
    ///
    /// # Errors
    /// An argument that is unknown, since it was not taken.
    pub fn finish(self) -> Result<(), TextError> {
        match self.pairs.first() {
            Some((name, ..)) => Err(TextError::new(format!("unknown argument {name}"))),
            None => Ok(()),
        }
    }

    /// All pairs: name, index, value.
    pub fn pairs(&self) -> impl Iterator<Item = (&str, Option<&str>, &str)> {
        self.pairs
            .iter()
            .map(|(name, index, value)| (name.as_str(), index.as_deref(), value.as_str()))
    }
}

fn no_pair(rest: &str) -> TextError {
    TextError::new(format!("expected name=value, found: {rest}"))
}

fn unquoted(text: &str) -> Result<String, TextError> {
    if text.starts_with('"') { String::from_text(text) } else { Ok(text.to_owned()) }
}

/// A name at the beginning of a line, quoted or up to where `end` finds its end, and what follows it.
pub(super) fn name_and_rest(
    text: &str,
    end: impl Fn(&str) -> Option<usize>,
) -> Result<(String, &str), TextError> {
    let place = if text.starts_with('"') { quote_end(text) } else { end(text) };
    let (name, rest) = place.map_or((text, ""), |place| text.split_at(place));
    Ok((unquoted(name)?, rest))
}

/// Where a text in double quotes ends, the closing one included.
fn quote_end(text: &str) -> Option<usize> {
    let mut escaped = false;
    let closing = text.char_indices().skip(1).find(|(_, c)| {
        let closes = *c == '"' && !escaped;
        escaped = *c == '\\' && !escaped;
        closes
    });
    closing.map(|(place, _)| place + 1)
}

/// Where an index ends: before the bracket that closes it.
fn index_end(text: &str) -> Option<usize> {
    if text.starts_with('"') { quote_end(text) } else { text.find(']') }
}

/// Where a value ends: a text at its quote, a position at its parenthesis, all else at the next blank.
fn value_end(text: &str) -> Result<usize, TextError> {
    let end = match text.chars().next() {
        Some('"') => quote_end(text),
        Some('(') => text.find(')').map(|place| place + 1),
        _ => text.find(char::is_whitespace).or(Some(text.len())),
    };
    end.ok_or_else(|| TextError::new(format!("a quote or parenthesis is not closed: {text}")))
}
