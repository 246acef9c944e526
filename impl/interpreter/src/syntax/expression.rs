//! Values: numbers, parameters, expressions and functions become operations (11.4.5 to 11.4.8).
//!
//! Constants are folded on the way, unless that fails: a wrong constant is an error of the block, and an error waits
//! for its execution.

use gaugeblock_vocabulary::FaultKind;

use crate::faults::{PlantedFault, planted};
use crate::limits::Limit;
use crate::syntax::bytecode::{Binary, CodeSegment, Function, Op, ParameterRef};
use crate::syntax::compiler::LineCompiler;
use crate::syntax::cursor::Cursor;
use crate::syntax::parameter::{is_position, short_parameter};
use crate::syntax::{Parsed, arithmetic, number};

/// Names of functions, with the longer of two that begin alike first.
const FUNCTIONS: [(&[u8], Function); 12] = [
    (b"abs", Function::Absolute),
    (b"acos", Function::Arccosine),
    (b"asin", Function::Arcsine),
    (b"cos", Function::Cosine),
    (b"exp", Function::Exponential),
    (b"fix", Function::RoundDown),
    (b"fup", Function::RoundUp),
    (b"round", Function::Round),
    (b"ln", Function::Logarithm),
    (b"sin", Function::Sine),
    (b"sqrt", Function::SquareRoot),
    (b"tan", Function::Tangent),
];

/// Operators of letters.
const WORDS: [(&[u8], Binary); 10] = [
    (b"and", Binary::And),
    (b"or", Binary::Or),
    (b"xor", Binary::Xor),
    (b"mod", Binary::Modulus),
    (b"eq", Binary::Equal),
    (b"ne", Binary::NotEqual),
    (b"gt", Binary::Greater),
    (b"ge", Binary::GreaterOrEqual),
    (b"lt", Binary::Less),
    (b"le", Binary::LessOrEqual),
];

/// Groups of operators; a planted fault has one more.
const GROUPS: usize = if cfg!(feature = "faults") { 6 } else { 5 };

/// The group of an operator (11.4.6), from 1 for the lowest.
#[inline]
pub(crate) fn group(operator: Binary) -> u8 {
    if planted(PlantedFault::EqualityLast) {
        return group_below_equality(operator);
    }
    match operator {
        Binary::And if planted(PlantedFault::AndFirst) => 3,
        Binary::And | Binary::Or | Binary::Xor => 1,
        Binary::Equal
        | Binary::NotEqual
        | Binary::Greater
        | Binary::GreaterOrEqual
        | Binary::Less
        | Binary::LessOrEqual => 2,
        Binary::Modulus if planted(PlantedFault::ModulusAmongSums) => 3,
        Binary::Add | Binary::Subtract => 3,
        Binary::Multiply | Binary::Divide | Binary::Modulus => 4,
        Binary::Power => 5,
    }
}

/// The group of an operator where equality has one of its own: a planted fault.
#[cold]
fn group_below_equality(operator: Binary) -> u8 {
    match operator {
        Binary::And | Binary::Or | Binary::Xor => 1,
        Binary::Equal | Binary::NotEqual => 2,
        Binary::Greater | Binary::GreaterOrEqual | Binary::Less | Binary::LessOrEqual => 3,
        Binary::Add | Binary::Subtract => 4,
        Binary::Multiply | Binary::Divide | Binary::Modulus => 5,
        Binary::Power => 6,
    }
}

impl LineCompiler {
    /// A real value: a number, a parameter, an expression or a function, possibly with a sign.
    #[inline]
    pub(crate) fn value(
        &mut self,
        cursor: &mut Cursor<'_>,
        into: &mut CodeSegment,
        depth: u32,
    ) -> Parsed<()> {
        if number::begins(cursor) {
            let number = number::read_unsigned(cursor)?;
            into.ops.push(Op::Number(number));
            return Ok(());
        }
        let sign = cursor.peek();
        if sign == b'#'
            && !self.choices.parameters_to_5399
            && let Some(number) = short_parameter(cursor)
        {
            into.ops.push(Op::Numbered(number));
            return Ok(());
        }
        if !matches!(sign, b'-' | b'+') {
            return self.unsigned_value(cursor, into, depth);
        }
        cursor.step();
        let again = cursor.peek();
        let twice = planted(PlantedFault::TwoSigns) && matches!(again, b'-' | b'+');
        if twice {
            cursor.step();
        }
        let sign = if twice { again } else { sign };
        if number::begins(cursor) {
            let number = number::read_unsigned(cursor)?;
            into.ops.push(Op::Number(if sign == b'-' { -number } else { number }));
            return Ok(());
        }
        if self.choices.sign_refused {
            return cursor.refuse(FaultKind::BadNumber, "a sign is allowed only before a number");
        }
        self.unsigned_value(cursor, into, depth)?;
        if sign == b'-' {
            match into.ops.last_mut() {
                Some(Op::Number(number)) => *number = -*number,
                Some(_) | None => into.ops.push(Op::Negate),
            }
        }
        Ok(())
    }

    /// A parameter, an expression or a function.
    fn unsigned_value(
        &mut self,
        cursor: &mut Cursor<'_>,
        into: &mut CodeSegment,
        depth: u32,
    ) -> Parsed<()> {
        match cursor.peek() {
            b'#' => {
                let place = self.parameter(cursor, into, depth)?;
                let op = match place {
                    ParameterRef::Numbered(number) if is_position(number) => {
                        into.ops.push(Op::Number(f64::from(number)));
                        Op::Indirect
                    }
                    ParameterRef::Numbered(number) => Op::Numbered(number),
                    ParameterRef::Indirect => Op::Indirect,
                    ParameterRef::Local(id) => Op::Local(id),
                    ParameterRef::Global(id) => Op::Global(id),
                    ParameterRef::Mode(name) => Op::Mode(name),
                    ParameterRef::Internal(name) => Op::Internal(name),
                    ParameterRef::Entry(value) => Op::Number(value),
                    ParameterRef::Absent => Op::Absent,
                };
                into.ops.push(op);
                Ok(())
            }
            b'[' => self.expression(cursor, into, depth),
            b'a'..=b'z' => self.call_function(cursor, into, depth),
            b'(' => cursor.refuse(FaultKind::BadComment, "expected a number, found a comment"),
            _ => cursor.refuse(FaultKind::BadNumber, "a number is missing"),
        }
    }

    /// The group of an operator. Whether AND, OR and XOR are among plus and minus is a choice.
    #[inline]
    fn group(&self, operator: Binary) -> u8 {
        let is_logic = matches!(operator, Binary::And | Binary::Or | Binary::Xor);
        if self.choices.logic_among_sums && is_logic { 3 } else { group(operator) }
    }

    /// `[` … `]`, with operators by groups, those of one group from the left.
    pub(crate) fn expression(
        &mut self,
        cursor: &mut Cursor<'_>,
        into: &mut CodeSegment,
        depth: u32,
    ) -> Parsed<()> {
        if depth == 0 {
            self.limit_exceeded = Some(Limit::BracketDepth);
            return cursor.refuse(FaultKind::BadExpression, "brackets are nested too deep");
        }
        if !cursor.take(b'[') {
            return cursor.refuse(FaultKind::BadExpression, "a left bracket is missing");
        }
        let mut waiting = [Binary::Add; GROUPS];
        let mut count = 0_usize;
        loop {
            self.value(cursor, into, depth.wrapping_sub(1))?;
            let operator = operator(cursor)?;
            let lowest = operator.map_or(0, |operator| self.group(operator));
            let from_right = lowest == 5 && planted(PlantedFault::PowerFromRight);
            while let Some(last) = count.checked_sub(1).and_then(|last| waiting.get(last)).copied()
                && self.group(last) >= lowest
                && !from_right
                && !(planted(PlantedFault::AddFirst)
                    && last == Binary::Subtract
                    && operator == Some(Binary::Add))
            {
                self.emit_operator(last, into);
                count = count.wrapping_sub(1);
            }
            let Some(operator) = operator else { return Ok(()) };
            if let Some(slot) = waiting.get_mut(count) {
                *slot = operator;
            }
            count = count.wrapping_add(1);
        }
    }

    /// Emits an operator, folded where its operands are known.
    fn emit_operator(&self, operator: Binary, into: &mut CodeSegment) {
        let right = into.ops.pop();
        let op = match (into.ops.last_mut(), right) {
            (Some(Op::Number(left)), Some(Op::Number(right))) => {
                if let Ok(result) = arithmetic::binary(operator, *left, right, &self.choices) {
                    *left = result;
                    return;
                }
                Op::BinaryNumber(operator, right)
            }
            (_, Some(Op::Number(right))) => Op::BinaryNumber(operator, right),
            (_, Some(Op::Numbered(right))) => Op::BinaryNumbered(operator, right),
            (_, right) => {
                into.ops.extend(right);
                Op::Binary(operator)
            }
        };
        into.ops.push(op);
    }

    /// A function with its argument in brackets.
    fn call_function(
        &mut self,
        cursor: &mut Cursor<'_>,
        into: &mut CodeSegment,
        depth: u32,
    ) -> Parsed<()> {
        let start = cursor.at();
        if cursor.peek() == b'a' && cursor.take_word(b"atan") {
            self.expression(cursor, into, depth)?;
            if !cursor.take(b'/') {
                return cursor.refuse(FaultKind::BadExpression, "ATAN takes [y]/[x]");
            }
            self.expression(cursor, into, depth)?;
            into.ops.push(Op::Arctangent);
            return Ok(());
        }
        if cursor.peek() == b'e' && cursor.take_word(b"exists") {
            return self.exists(cursor, into);
        }
        let first = cursor.peek();
        for (name, function) in FUNCTIONS {
            if name.first() == Some(&first) && cursor.take_word(name) {
                self.expression(cursor, into, depth)?;
                if let Some(Op::Number(number)) = into.ops.last_mut()
                    && let Ok(result) = arithmetic::function(function, *number, &self.choices)
                {
                    *number = result;
                } else {
                    into.ops.push(Op::Function(function));
                }
                return Ok(());
            }
        }
        if self.in_label && depth == self.bracket_depth {
            return cursor.refuse_from(start, FaultKind::BadBlock, "a label is missing");
        }
        cursor.refuse_from(start, FaultKind::BadExpression, "no such function")
    }

    /// EXISTS takes one named parameter and nothing else.
    fn exists(&mut self, cursor: &mut Cursor<'_>, into: &mut CodeSegment) -> Parsed<()> {
        if !cursor.take(b'[') || cursor.peek() != b'#' {
            return cursor.refuse(FaultKind::BadExpression, "EXISTS takes one named parameter");
        }
        if self.choices.emulates_rs274 && !cursor.rest().starts_with(b"#<") {
            return self.numbered_exists(cursor, into);
        }
        if !cursor.take(b'#') || cursor.peek() != b'<' {
            return cursor.refuse(FaultKind::BadExpression, "EXISTS takes one named parameter");
        }
        let place = self.named(cursor)?;
        if !cursor.take(b']') {
            return cursor.refuse(FaultKind::BadExpression, "EXISTS takes one named parameter");
        }
        into.ops.push(match place {
            ParameterRef::Local(id) => Op::ExistsLocal(id),
            ParameterRef::Global(id) => Op::ExistsGlobal(id),
            ParameterRef::Mode(_) | ParameterRef::Internal(_) | ParameterRef::Entry(_) => {
                Op::Number(1.0)
            }
            ParameterRef::Absent | ParameterRef::Numbered(_) | ParameterRef::Indirect => {
                Op::Number(0.0)
            }
        });
        Ok(())
    }
}

impl LineCompiler {
    /// Quirk rs274.exists-numbered. EXISTS takes a numbered parameter.
    #[cold]
    fn numbered_exists(&mut self, cursor: &mut Cursor<'_>, into: &mut CodeSegment) -> Parsed<()> {
        cursor.step();
        self.value(cursor, into, self.bracket_depth)?;
        if !cursor.take(b']') {
            return cursor.refuse(FaultKind::BadExpression, "EXISTS takes one parameter");
        }
        into.ops.push(Op::ExistsNumbered);
        Ok(())
    }
}

/// The operator that comes next; none at the closing bracket, which is taken.
fn operator(cursor: &mut Cursor<'_>) -> Parsed<Option<Binary>> {
    let operator = match cursor.peek() {
        b']' => {
            cursor.step();
            return Ok(None);
        }
        b'+' => Binary::Add,
        b'-' => Binary::Subtract,
        b'/' => Binary::Divide,
        b'*' => {
            cursor.step();
            return Ok(Some(if cursor.take(b'*') { Binary::Power } else { Binary::Multiply }));
        }
        _ => {
            let first = cursor.peek();
            let found = WORDS
                .iter()
                .find(|(word, _)| word.first() == Some(&first) && cursor.take_word(word));
            return match found {
                Some((_, operator)) => Ok(Some(*operator)),
                None => cursor.refuse(FaultKind::BadExpression, "an operator or ] is missing"),
            };
        }
    };
    cursor.step();
    Ok(Some(operator))
}
