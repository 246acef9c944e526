//! Values that are found while they are read: numbers, parameters, expressions and functions, for the fast path of a
//! line.
//!
//! Reading a value changes nothing, so that whatever is unusual or wrong is left to the complete path, which starts
//! again.

use crate::faults::{PlantedFault, planted};
use crate::parameters::Parameters;
use crate::syntax::bytecode::{Binary, Function};
use crate::syntax::{
    LineCompiler, ParameterRef, arithmetic, group, is_position, parameter_number, read_short_prefix,
};

/// Highest number of a parameter.
const LAST: u16 = 5602;

/// The state that values depend on.
#[derive(Clone, Copy)]
pub(super) struct Values<'a> {
    pub(super) parameters: &'a Parameters,
    pub(super) compiler: &'a LineCompiler,
}

/// A value and the text after it.
type Found<'t, T> = Option<(T, &'t [u8])>;

/// The text from the next character that is not a blank.
#[inline]
pub(super) fn after_blanks(mut text: &[u8]) -> &[u8] {
    while let [b' ' | b'\t', behind @ ..] = text {
        text = behind;
    }
    text
}

impl Values<'_> {
    /// The value of a word or setting.
    pub(super) fn outermost<'t>(&self, text: &'t [u8]) -> Found<'t, f64> {
        self.value(text, self.compiler.bracket_depth)
    }

    /// Fast path of `LineCompiler::value`. Most values are numbers and parameters, which need only one call.
    #[inline]
    fn value<'t>(&self, text: &'t [u8], depth: u32) -> Found<'t, f64> {
        match text {
            [b'0'..=b'9' | b'.', ..] => number(text),
            [b'#', b'<', name @ ..] => self.named(name),
            [b'#', b'0'..=b'9', ..] => self.numbered(text.get(1..)?),
            _ => self.other_value(text, depth),
        }
    }

    /// The value of a named parameter, after its left angle bracket.
    #[inline(never)]
    fn named<'t>(&self, text: &'t [u8]) -> Found<'t, f64> {
        let (place, length) = self.compiler.find_known(text)?;
        Some((self.value_at(place)?, text.get(length..)?))
    }

    /// The value of a numbered parameter, after its number sign.
    #[inline(never)]
    fn numbered<'t>(&self, text: &'t [u8]) -> Found<'t, f64> {
        let (number, text) = self.parameter(text)?;
        (!is_position(number)).then(|| (self.parameters.numbered.get(u32::from(number)), text))
    }

    /// The number of a parameter; none where, by a choice, not all numbers are those of parameters.
    #[inline]
    fn parameter<'t>(&self, text: &'t [u8]) -> Found<'t, u16> {
        parameter(text).filter(|_| !self.compiler.choices.parameters_to_5399)
    }

    /// The value of a parameter; none where it is not kept with the other ones.
    #[inline]
    fn value_at(&self, place: ParameterRef) -> Option<f64> {
        match place {
            ParameterRef::Numbered(number) if !is_position(number) => {
                Some(self.parameters.numbered.get(u32::from(number)))
            }
            ParameterRef::Local(id) => self.parameters.named.local(id),
            ParameterRef::Global(id) => self.parameters.named.global(id),
            ParameterRef::Entry(value) => Some(value),
            ParameterRef::Numbered(_)
            | ParameterRef::Indirect
            | ParameterRef::Mode(_)
            | ParameterRef::Internal(_)
            | ParameterRef::Absent => None,
        }
    }

    /// A value that is neither a number nor a parameter by number or name.
    fn other_value<'t>(&self, text: &'t [u8], depth: u32) -> Found<'t, f64> {
        let (first, behind) = text.split_first()?;
        match first {
            b'#' => {
                let (place, text) = self.place(behind, depth)?;
                Some((self.value_at(place)?, text))
            }
            b'[' => self.expression(behind, depth),
            b'-' => {
                let (value, text) = self.signed(behind, depth)?;
                Some((-value, text))
            }
            b'+' => self.signed(behind, depth),
            b' ' | b'\t' => self.value(after_blanks(behind), depth),
            _ => self.call(text, depth),
        }
    }

    /// A value after its sign.
    #[inline(never)]
    fn signed<'t>(&self, text: &'t [u8], depth: u32) -> Found<'t, f64> {
        let text = after_blanks(text);
        match text.first()? {
            b'0'..=b'9' | b'.' => number(text),
            b'-' | b'+' => None,
            _ if self.compiler.choices.sign_refused => None,
            _ => self.value(text, depth),
        }
    }

    /// Fast path of `LineCompiler::parameter`. A parameter, after its number sign.
    #[inline]
    pub(super) fn place<'t>(&self, text: &'t [u8], depth: u32) -> Found<'t, ParameterRef> {
        match text.split_first()? {
            (b'<', behind) => {
                let (place, length) = self.compiler.find_known(behind)?;
                Some((place, behind.get(length..)?))
            }
            (b'[', behind) => {
                let (value, text) = self.expression(behind, depth)?;
                let number = parameter_number(value, &self.compiler.choices).ok()?;
                Some((ParameterRef::Numbered(number), text))
            }
            _ => {
                let (number, text) = self.parameter(text)?;
                Some((ParameterRef::Numbered(number), text))
            }
        }
    }

    /// Fast path of `LineCompiler::expression`. An expression, after its left bracket.
    fn expression<'t>(&self, text: &'t [u8], depth: u32) -> Found<'t, f64> {
        let depth = depth.checked_sub(1)?;
        // What waits for its right side, each in a higher group than the one before, whose group it keeps.
        let other_groups = planted(PlantedFault::AddFirst) || planted(PlantedFault::EqualityLast);
        if self.compiler.choices.logic_among_sums || other_groups {
            return None;
        }
        let mut waiting = [(0.0, Binary::Add, 0_u8); 5];
        let mut count = 0_usize;
        let mut highest = 0;
        let mut text = text;
        loop {
            let (mut value, behind) = self.value(text, depth)?;
            let (operator, behind) = operator(behind)?;
            let lowest = operator.map_or(1, group);
            let from_right = lowest == 5 && planted(PlantedFault::PowerFromRight);
            while highest >= lowest && !from_right {
                count = count.wrapping_sub(1);
                let (left, last, before) = *waiting.get(count)?;
                value =
                    arithmetic::binary_inline(last, left, value, &self.compiler.choices).ok()?;
                highest = before;
            }
            let Some(operator) = operator else { return Some((value, behind)) };
            *waiting.get_mut(count)? = (value, operator, highest);
            count = count.wrapping_add(1);
            highest = lowest;
            text = behind;
        }
    }

    /// Fast path of `LineCompiler::call_function`. A function with its argument in brackets.
    fn call<'t>(&self, text: &'t [u8], depth: u32) -> Found<'t, f64> {
        let (name, text) = letters(text)?;
        let [b'[', text @ ..] = after_blanks(text) else { return None };
        let function = match &name.to_be_bytes() {
            b"\0\0\0\0\0abs" => Function::Absolute,
            b"\0\0\0\0acos" => Function::Arccosine,
            b"\0\0\0\0asin" => Function::Arcsine,
            b"\0\0\0\0\0cos" => Function::Cosine,
            b"\0\0\0\0\0exp" => Function::Exponential,
            b"\0\0\0\0\0fix" => Function::RoundDown,
            b"\0\0\0\0\0fup" => Function::RoundUp,
            b"\0\0\0round" => Function::Round,
            b"\0\0\0\0\0\0ln" => Function::Logarithm,
            b"\0\0\0\0\0sin" => Function::Sine,
            b"\0\0\0\0sqrt" => Function::SquareRoot,
            b"\0\0\0\0\0tan" => Function::Tangent,
            b"\0\0\0\0atan" => {
                let (y, text) = self.expression(text, depth)?;
                let [b'/', text @ ..] = after_blanks(text) else { return None };
                let [b'[', text @ ..] = after_blanks(text) else { return None };
                let (x, text) = self.expression(text, depth)?;
                return Some((arithmetic::arctangent(y, x, &self.compiler.choices), text));
            }
            _ => return None,
        };
        let (value, text) = self.expression(text, depth)?;
        Some((arithmetic::function(function, value, &self.compiler.choices).ok()?, text))
    }
}

/// A number without a sign.
#[inline]
fn number(text: &[u8]) -> Found<'_, f64> {
    let number = read_short_prefix(text)?;
    Some((number.value(), text.get(number.length..)?))
}

/// The number of a parameter.
#[inline]
fn parameter(text: &[u8]) -> Found<'_, u16> {
    small_integer(text).filter(|(number, _)| (1..=LAST).contains(number))
}

/// Up to four digits without a point, from the beginning of the text.
#[inline]
fn small_integer(text: &[u8]) -> Found<'_, u16> {
    let mut number = 0_u16;
    let mut rest = text;
    while let [digit @ b'0'..=b'9', behind @ ..] = rest {
        if number > 999 {
            return None;
        }
        number = number.wrapping_mul(10).wrapping_add(u16::from(digit & 15));
        rest = behind;
    }
    (rest.first() != Some(&b'.')).then_some((number, rest))
}

/// Up to eight adjacent letters, in lower case, the last one in the lowest byte.
#[inline]
fn letters(text: &[u8]) -> Found<'_, u64> {
    let mut name = 0_u64;
    let mut rest = text;
    while let [byte, behind @ ..] = rest
        && byte.is_ascii_alphabetic()
    {
        if name >> 56 != 0 {
            return None;
        }
        name = name << 8 | u64::from(byte | 0x20);
        rest = behind;
    }
    Some((name, rest))
}

/// The operator that comes next; none at the closing bracket, which is taken.
#[inline]
fn operator(text: &[u8]) -> Found<'_, Option<Binary>> {
    let operator = match text {
        [b']', behind @ ..] => return Some((None, behind)),
        [b'*', b'*', behind @ ..] => return Some((Some(Binary::Power), behind)),
        // A blank may separate the signs of a power.
        [b'*', b' ' | b'\t', behind @ ..] if after_blanks(behind).first() == Some(&b'*') => {
            return None;
        }
        [b'*', ..] => Binary::Multiply,
        [b'+', ..] => Binary::Add,
        [b'-', ..] => Binary::Subtract,
        [b'/', ..] => Binary::Divide,
        [b' ' | b'\t', behind @ ..] => return operator_apart(behind),
        _ => return operator_word(text),
    };
    Some((Some(operator), text.get(1..)?))
}

/// The operator after a blank.
#[inline(never)]
fn operator_apart(text: &[u8]) -> Found<'_, Option<Binary>> {
    operator(after_blanks(text))
}

/// An operator of letters.
#[inline(never)]
fn operator_word(text: &[u8]) -> Found<'_, Option<Binary>> {
    let (word, behind) = letters(text)?;
    let operator = match &word.to_be_bytes() {
        b"\0\0\0\0\0and" => Binary::And,
        b"\0\0\0\0\0\0or" => Binary::Or,
        b"\0\0\0\0\0xor" => Binary::Xor,
        b"\0\0\0\0\0mod" => Binary::Modulus,
        b"\0\0\0\0\0\0eq" => Binary::Equal,
        b"\0\0\0\0\0\0ne" => Binary::NotEqual,
        b"\0\0\0\0\0\0gt" => Binary::Greater,
        b"\0\0\0\0\0\0ge" => Binary::GreaterOrEqual,
        b"\0\0\0\0\0\0lt" => Binary::Less,
        b"\0\0\0\0\0\0le" => Binary::LessOrEqual,
        _ => return None,
    };
    Some((Some(operator), behind))
}
