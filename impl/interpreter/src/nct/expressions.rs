//! Expressions: read from left to right, written as operations after their operands.

use gaugeblock_vocabulary::FaultKind;

use super::choices::Choices;
use super::program::{
    Bits, Code, Compare, Condition, Function, Operation, Operator, Stop, Target, Value, refuse,
    slot,
};
use super::text::Cursor;
use crate::faults::{PlantedFault, planted};
use crate::index_range::IndexRange;

/// Most brackets within each other.
const DEEPEST: u32 = 5;

/// The functions, and whether a document names them.
const FUNCTIONS: [(&[u8], Function, bool); 14] = [
    (b"COS", Function::Cos, true),
    (b"NOT", Function::Not, true),
    (b"SIN", Function::Sin, false),
    (b"TAN", Function::Tan, false),
    (b"ASIN", Function::Asin, false),
    (b"ACOS", Function::Acos, false),
    (b"ATAN", Function::Atan, false),
    (b"SQRT", Function::Sqrt, false),
    (b"ABS", Function::Abs, false),
    (b"ROUND", Function::Round, false),
    (b"FIX", Function::Fix, false),
    (b"FUP", Function::Fup, false),
    (b"LN", Function::Ln, false),
    (b"EXP", Function::Exp, false),
];

const COMPARES: [(&[u8], Compare); 6] = [
    (b"EQ", Compare::Equal),
    (b"NE", Compare::NotEqual),
    (b"GT", Compare::Greater),
    (b"LT", Compare::Less),
    (b"GE", Compare::GreaterOrEqual),
    (b"LE", Compare::LessOrEqual),
];

/// The refusal of a statement of another form than any that there is.
pub(super) fn bad_statement<T>() -> Result<T, Stop> {
    refuse(FaultKind::Statement, "3064 BAD MACRO STATEMENT")
}

/// The rest of a line, and the destination of its operations.
pub(super) struct Reader<'a> {
    pub(super) cursor: Cursor<'a>,
    pub(super) code: &'a mut Code,
    pub(super) choices: Choices,
    /// Brackets around what is being read.
    pub(super) depth: u32,
}

impl Reader<'_> {
    /// Requires this text next.
    pub(super) fn expect(&mut self, what: &[u8]) -> Result<(), Stop> {
        if self.cursor.takes(what) { Ok(()) } else { bad_statement() }
    }

    /// `value := ['+' | '-'] simple`
    pub(super) fn value(&mut self) -> Result<Value, Stop> {
        let from = self.code.operations.len();
        let sign = self.sign();
        self.simple()?;
        self.signed(sign);
        Ok(self.read_since(from))
    }

    /// `expression := term (('+' | '-' | 'OR' | 'XOR') term)*`, up to the end of the line.
    pub(super) fn last_expression(&mut self) -> Result<Value, Stop> {
        let from = self.code.operations.len();
        self.expression()?;
        if self.cursor.is_at_end() { Ok(self.read_since(from)) } else { bad_statement() }
    }

    /// `condition := '[' expression compare expression ']'`
    pub(super) fn condition(&mut self) -> Result<Condition, Stop> {
        self.open()?;
        let from = self.code.operations.len();
        self.expression()?;
        let left = self.read_since(from);
        let compares = COMPARES.iter().find(|(word, _)| self.cursor.takes(word));
        let Some((_, compare)) = compares else { return bad_statement() };
        let from = self.code.operations.len();
        self.expression()?;
        let right = self.read_since(from);
        self.close()?;
        Ok(Condition { left, compare: *compare, right })
    }

    /// `variable := '#' (number | '[' expression ']')`, at the left of an assignment.
    pub(super) fn target(&mut self) -> Result<Target, Stop> {
        let from = self.code.operations.len();
        self.variable()?;
        if let Some(Operation::Variable(slot)) = self.code.operations.get(from).copied()
            && self.code.operations.len() == from.wrapping_add(1)
        {
            self.code.operations.truncate(from);
            return Ok(Target::Variable(slot));
        }
        // Without its last operation it is the number of the variable.
        self.code.operations.pop();
        Ok(Target::Indirect(IndexRange { from, to: self.code.operations.len() }))
    }

    /// What has been read since.
    fn read_since(&mut self, from: usize) -> Value {
        let to = self.code.operations.len();
        let alone = match self.code.operations.get(from..to) {
            Some([Operation::Number(number)]) => Value::Number(*number),
            Some([Operation::Variable(slot)]) => Value::Variable(*slot),
            Some(_) | None => return Value::Expression(IndexRange { from, to }),
        };
        self.code.operations.truncate(from);
        alone
    }

    fn expression(&mut self) -> Result<(), Stop> {
        const SUMS: [(&[u8], Operator); 4] = [
            (b"+", Operator::Add),
            (b"-", Operator::Subtract),
            (b"OR", Operator::Bits(Bits::Or)),
            (b"XOR", Operator::Bits(Bits::Xor)),
        ];
        self.term()?;
        while let Some((_, operator)) = SUMS.iter().find(|(word, _)| self.cursor.takes(word)) {
            self.term()?;
            self.write(Operation::Two(*operator));
        }
        Ok(())
    }

    /// `term := operand (('*' | '/' | 'AND' | 'MOD') operand)*`
    fn term(&mut self) -> Result<(), Stop> {
        const PRODUCTS: [(&[u8], Operator); 4] = [
            (b"*", Operator::Multiply),
            (b"/", Operator::Divide),
            (b"AND", Operator::Bits(Bits::And)),
            (b"MOD", Operator::Modulus),
        ];
        self.operand()?;
        while let Some((_, operator)) = PRODUCTS.iter().find(|(word, _)| self.cursor.takes(word)) {
            if *operator == Operator::Modulus && self.choices.documented_functions {
                return bad_statement();
            }
            self.operand()?;
            self.write(Operation::Two(*operator));
        }
        Ok(())
    }

    /// `operand := ['+' | '-'] (function simple | simple)`
    fn operand(&mut self) -> Result<(), Stop> {
        let sign = self.sign();
        match FUNCTIONS.iter().find(|(word, ..)| self.cursor.takes(word)) {
            Some((.., documented)) if self.choices.documented_functions && !documented => {
                return bad_statement();
            }
            Some((_, function, _)) => {
                self.simple()?;
                self.write(Operation::One(*function));
            }
            None => self.simple()?,
        }
        self.signed(sign);
        Ok(())
    }

    fn sign(&mut self) -> Option<Operation> {
        if self.cursor.takes(b"-") {
            Some(Operation::Minus)
        } else {
            self.cursor.takes(b"+").then_some(Operation::Plus)
        }
    }

    /// Writes a sign after its operand.
    fn signed(&mut self, sign: Option<Operation>) {
        match (sign, self.code.operations.last_mut()) {
            (None, _) | (Some(Operation::Plus), Some(Operation::Number(_))) => {}
            (Some(Operation::Minus), Some(Operation::Number(number))) => *number = -*number,
            (Some(sign), _) => self.write(sign),
        }
    }

    /// `simple := number | variable | '[' expression ']'`
    fn simple(&mut self) -> Result<(), Stop> {
        match self.cursor.peek() {
            b'#' => self.variable(),
            b'[' => {
                self.open()?;
                self.expression()?;
                self.close()
            }
            _ if self.cursor.begins_number() => {
                let number = self.cursor.number()?;
                self.write(Operation::Number(number));
                Ok(())
            }
            _ => bad_statement(),
        }
    }

    fn variable(&mut self) -> Result<(), Stop> {
        self.expect(b"#")?;
        if self.cursor.begins_number() {
            let number = self.cursor.number()?;
            // A number that no variable has is refused when it is reached.
            match slot(Some(number)) {
                Ok(slot) => self.write(Operation::Variable(slot)),
                Err(_) => {
                    self.write(Operation::Number(number));
                    self.write(Operation::Indirect);
                }
            }
            return Ok(());
        }
        self.open()?;
        self.expression()?;
        self.close()?;
        self.write(Operation::Indirect);
        Ok(())
    }

    fn open(&mut self) -> Result<(), Stop> {
        self.depth = self.depth.saturating_add(1);
        let deepest = if planted(PlantedFault::SixBrackets) { 6 } else { DEEPEST };
        if self.depth > deepest { bad_statement() } else { self.expect(b"[") }
    }

    fn close(&mut self) -> Result<(), Stop> {
        self.depth = self.depth.saturating_sub(1);
        self.expect(b"]")
    }

    fn write(&mut self, operation: Operation) {
        self.code.operations.push(operation);
    }
}
