//! One line of the text form: words and `name=value` pairs.

use super::TextError;
use crate::field::Argument;

/// A text in double quotes, with the escapes of JSON.
pub(crate) fn quoted(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

/// An index as it stands between brackets: plain where it can be, else quoted.
pub(crate) fn index_text(index: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || matches!(c, '_' | '.' | '-' | '(' | ')');
    if !index.is_empty() && index.chars().all(plain) { index.to_owned() } else { quoted(index) }
}

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
                let end = value_end(after, |c| c == ']')?;
                index = Some(unquoted(&after[..end])?);
                rest = after[end..].strip_prefix(']').ok_or_else(|| no_pair(rest))?;
            }
            let after = rest.strip_prefix('=').ok_or_else(|| no_pair(rest))?;
            let end = value_end(after, char::is_whitespace)?;
            pairs.push((name.to_owned(), index, after[..end].to_owned()));
            rest = after[end..].trim_start();
        }
        Ok(Self { pairs })
    }

    /// Takes an argument by name.
    ///
    /// # Errors
    /// It is missing though required, or unreadable.
    pub fn take<T: Argument>(&mut self, name: &str) -> Result<T, TextError> {
        let found = self.pairs.iter().position(|(pair, index, _)| pair == name && index.is_none());
        let text = found.map(|place| self.pairs.remove(place).2);
        T::read(text.as_deref())
            .map_err(|error| TextError::new(format!("argument {name}: {}", error.message)))
    }

    /// Checks that nothing is left.
    ///
    /// # Errors
    /// An argument that nobody took.
    pub fn finish(self) -> Result<(), TextError> {
        match self.pairs.first() {
            Some((name, ..)) => Err(TextError::new(format!("nothing takes the argument {name}"))),
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
    if text.starts_with('"') { crate::field::Scalar::from_text(text) } else { Ok(text.to_owned()) }
}

/// Where a value ends: at the first `end` outside of quotes and parentheses, or at the end of the text.
fn value_end(text: &str, end: impl Fn(char) -> bool) -> Result<usize, TextError> {
    let (mut quoted, mut escaped, mut depth) = (false, false, 0_u32);
    for (place, c) in text.char_indices() {
        match c {
            _ if escaped => escaped = false,
            '\\' if quoted => escaped = true,
            '"' => quoted = !quoted,
            _ if quoted => {}
            '(' => depth += 1,
            ')' => depth = depth.saturating_sub(1),
            _ if depth == 0 && end(c) => return Ok(place),
            _ => {}
        }
    }
    if quoted || depth > 0 {
        return Err(TextError::new(format!("a quote or parenthesis is not closed: {text}")));
    }
    Ok(text.len())
}
