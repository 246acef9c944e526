//! Parameters in the text (11.4.3): `#` with a number, an expression, a further parameter, or a name.

use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, narrowed, planted};
use crate::limits::Limit;
use crate::math;
use crate::parameters::{Internal, LAST, NameId, Predefined};
use crate::syntax::bytecode::{CodeSegment, Op, ParameterRef};
use crate::syntax::choices::Choices;
use crate::syntax::compiler::LineCompiler;
use crate::syntax::cursor::Cursor;
use crate::syntax::{Parsed, arithmetic, number};

/// The last number of a parameter.
const LAST_NUMBER: u64 = 5602;

/// The greatest number where, by a choice, there are no parameters above it.
const LAST_OF_FEWER: u64 = 5399;
/// It is the one that the parameters end with.
const _: () = assert!(LAST == 5602);

impl LineCompiler {
    /// `#` and what follows it (11.4.3.1): a number, a further parameter, an expression, or a name.
    pub(crate) fn parameter(
        &mut self,
        cursor: &mut Cursor<'_>,
        into: &mut CodeSegment,
        depth: u32,
    ) -> Parsed<ParameterRef> {
        let start = cursor.at();
        cursor.step();
        match cursor.peek() {
            b'<' => return self.named(cursor),
            b'0'..=b'9' | b'.' => {
                if let Some(short) = number::read_short(cursor.rest())
                    && let Some(number @ 1..=LAST_NUMBER) = short.integer()
                    && (number <= LAST_OF_FEWER || !self.choices.parameters_to_5399)
                {
                    cursor.advance_to_next(short.length);
                    return Ok(ParameterRef::Numbered(u16::try_from(number).unwrap_or(0)));
                }
                let number = number::read_unsigned(cursor)?;
                into.ops.push(Op::Number(number));
            }
            b'[' => self.expression(cursor, into, depth)?,
            // A number may have a sign (11.4.2.4).
            b'+' | b'-' => self.value(cursor, into, depth)?,
            b'#' if depth == 0 => {
                self.limit_exceeded = Some(Limit::BracketDepth);
                return cursor.refuse(FaultKind::BadExpression, "too many number signs");
            }
            b'#' => {
                // The inner parameter's value is the number of the outer one.
                let inner = self.parameter(cursor, into, depth.wrapping_sub(1))?;
                let op = match inner {
                    ParameterRef::Numbered(number) => {
                        into.ops.push(Op::Number(f64::from(number)));
                        Op::Indirect
                    }
                    ParameterRef::Indirect => Op::Indirect,
                    ParameterRef::Local(id) => Op::Local(id),
                    ParameterRef::Global(id) => Op::Global(id),
                    ParameterRef::Mode(name) => Op::Mode(name),
                    ParameterRef::Internal(name) => Op::Internal(name),
                    ParameterRef::Entry(value) => Op::Number(value),
                    ParameterRef::Absent => Op::Absent,
                };
                into.ops.push(op);
                return Ok(ParameterRef::Indirect);
            }
            b'a'..=b'z' if self.choices.emulates_rs274 || self.choices.function_number => {
                self.value(cursor, into, depth)?;
            }
            _ => return cursor.refuse(FaultKind::BadExpression, "a parameter number is missing"),
        }
        let Some(Op::Number(number)) = into.ops.last().copied() else {
            return Ok(ParameterRef::Indirect);
        };
        into.ops.pop();
        match parameter_number(number, &self.choices) {
            Ok(number) => Ok(ParameterRef::Numbered(number)),
            Err(_) if self.in_label || !self.choices.emulates_rs274 => {
                // Whether its value is ever needed is not known yet, and an o-word keeps its keyword.
                into.ops.push(Op::Number(number));
                Ok(ParameterRef::Indirect)
            }
            Err((kind, message)) => cursor.refuse_from(start, *kind, message),
        }
    }

    /// `<name>`, in lower case and without blanks (11.4.3.3).
    #[inline]
    pub(crate) fn named(&mut self, cursor: &mut Cursor<'_>) -> Parsed<ParameterRef> {
        // Most names need no change.
        let text = cursor.rest().get(1..).unwrap_or(&[]);
        let plain = |byte: &u8| matches!(byte, b'a'..=b'z' | b'0'..=b'9' | b'_');
        let length = text.iter().position(|byte| !plain(byte)).unwrap_or(text.len());
        if length != 0
            && text.get(length) == Some(&b'>')
            && let Some(name) = text.get(..length)
        {
            cursor.advance(length.wrapping_add(2));
            return Ok(self.resolve(name));
        }
        self.unusual_name(cursor)
    }

    /// A name with blanks, capitals or other characters.
    fn unusual_name(&mut self, cursor: &mut Cursor<'_>) -> Parsed<ParameterRef> {
        let mut name = core::mem::take(&mut self.scratch);
        let place = self.read_name(cursor, &mut name).map(|()| self.resolve(name.as_bytes()));
        self.scratch = name;
        place
    }

    /// Reads a name in angle brackets into a text. It may have any characters except the one that ends it (11.4.3.3),
    /// in any language.
    pub(crate) fn read_name(&self, cursor: &mut Cursor<'_>, name: &mut String) -> Parsed<()> {
        let start = cursor.at();
        name.clear();
        cursor.step();
        let mut foreign = Vec::new();
        loop {
            match cursor.peek() {
                b'>' => break,
                // A name has no characters that begin or end a comment (11.4.14).
                b'(' | b')' | b';' => {
                    return cursor.refuse(FaultKind::BadComment, "a comment within a name");
                }
                0 => {
                    return cursor.refuse_from(
                        start,
                        FaultKind::BadExpression,
                        "a name is not closed",
                    );
                }
                byte if byte.is_ascii() && foreign.is_empty() => name.push(char::from(byte)),
                byte => foreign.push(byte),
            }
            cursor.step();
        }
        cursor.step();
        name.push_str(&String::from_utf8_lossy(&foreign));
        if name.is_empty() {
            return cursor.refuse_from(start, FaultKind::BadExpression, "a name is empty");
        }
        Ok(())
    }

    /// Finds the reference of a named parameter. It never changes, so that it is looked up once.
    #[inline]
    pub(crate) fn resolve(&mut self, name: &[u8]) -> ParameterRef {
        let id = self.names.intern(name);
        if let Some(place) = usize::try_from(id).ok().and_then(|id| self.parameter_refs.get(id)) {
            return *place;
        }
        if id >= self.names_max {
            self.limit_exceeded = Some(Limit::NamedParameters);
        }
        let place = self.look_up(self.names.name(id), id);
        self.parameter_refs.push(place);
        place
    }

    /// Fast path of [`Self::resolve`]. The reference of a named parameter whose short, known name begins a text, and
    /// the length of the name with its bracket.
    #[inline(always)]
    pub(crate) fn find_known(&self, text: &[u8]) -> Option<(ParameterRef, usize)> {
        let (id, length) = self.names.find_short(text)?;
        let place = usize::try_from(id).ok().and_then(|id| self.parameter_refs.get(id)).copied()?;
        Some((place, length))
    }

    /// The reference of a parameter whose name is new.
    #[cold]
    fn look_up(&self, name: &str, id: NameId) -> ParameterRef {
        if !name.starts_with('_') {
            return ParameterRef::Local(id);
        }
        if let Some(entry) = bracketed(name, "_ini").filter(|entry| entry.contains(']')) {
            return self.entry(entry).map_or(ParameterRef::Absent, ParameterRef::Entry);
        }
        if let Some(item) = bracketed(name, "_hal").filter(|item| item.ends_with(']')) {
            return self
                .place_of_item(item)
                .map_or(ParameterRef::Absent, |at| ParameterRef::Internal(Internal::Item(at)));
        }
        if let Some(own) = Internal::from_name(name) {
            return ParameterRef::Internal(own);
        }
        match Predefined::from_name(name) {
            Some(name) => ParameterRef::Mode(name),
            None => ParameterRef::Global(id),
        }
    }

    /// The value of the INI entry `[section]name`: the first one of that name, whose ASCII letters have no case.
    fn entry(&self, name: &str) -> Option<f64> {
        self.ini.iter().find(|(entry, _)| entry.eq_ignore_ascii_case(name)).map(|(_, value)| *value)
    }

    /// The place of the HAL item `[item]`, where that has been declared.
    fn place_of_item(&self, name: &str) -> Option<u32> {
        let name = name.strip_prefix('[')?.strip_suffix(']')?;
        let place = self.items.iter().position(|item| item.is(name))?;
        u32::try_from(place).ok()
    }
}

/// The text after such a word in a name, from its bracket on. A name without a bracket there, or without its end, is
/// an ordinary name.
fn bracketed<'a>(name: &'a str, word: &str) -> Option<&'a str> {
    name.strip_prefix(word).filter(|rest| rest.starts_with('['))
}

/// Fast path of [`LineCompiler::parameter`]. `#` with a plain number, as nearly every parameter is written; otherwise
/// nothing is taken. Parameters of the position are excluded.
#[inline]
pub(crate) fn short_parameter(cursor: &mut Cursor<'_>) -> Option<u16> {
    let short = number::read_short(cursor.rest().get(1..)?)?;
    let number @ 1..=LAST_NUMBER = short.integer()? else { return None };
    let number = u16::try_from(number).ok().filter(|number| !is_position(*number))?;
    cursor.advance_to_next(short.length.wrapping_add(1));
    Some(number)
}

/// Whether a parameter is a coordinate of the controlled point, which the modes hold.
#[inline]
pub(crate) fn is_position(number: u16) -> bool {
    (5420..=5428).contains(&number)
}

/// Whether a parameter reports the tool or the controlled point.
#[inline]
pub(crate) fn is_machine_state(number: u16) -> bool {
    number >= 5400 && (number <= 5413 || is_position(number))
}

/// The number of a parameter from a value that should be one.
#[inline]
pub(crate) fn parameter_number(
    value: f64,
    choices: &Choices,
) -> Result<u16, arithmetic::ArithmeticError> {
    let value = narrowed(PlantedFault::ParameterWraps, value, 65_536.0);
    let value = if planted(PlantedFault::ParameterCut) { math::floor(value) } else { value };
    let Some(number) = math::near_integer(value) else {
        return Err(&(FaultKind::ParameterNotInteger, "a parameter number is not an integer"));
    };
    match u16::try_from(number) {
        Ok(number)
            if number != 0
                && u32::from(number) <= LAST
                && (u64::from(number) <= LAST_OF_FEWER || !choices.parameters_to_5399) =>
        {
            Ok(number)
        }
        Ok(_) | Err(_) => {
            Err(&(FaultKind::ParameterOutOfRange, "the number of the parameter is out of range"))
        }
    }
}
