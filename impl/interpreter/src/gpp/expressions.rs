//! Compiles expressions and variables from left to right into postfix operations.

use gaugeblock_vocabulary::FaultKind;

use super::compile::{Compiler, DEEPEST, NO_STATEMENT, Stop, too_deep};
use super::lexer::{self, Token};
use super::program::{IndexRange, Operation, Sum, VariableRef};
use super::variables::Variable;
use super::words::{self, Compare, Keyword};

/// The refusal of a text in place of a number, or a number in place of a text.
pub(super) const WRONG_TYPE: Stop = Stop::Refused(
    FaultKind::WrongType,
    "a text in place of a number, or a number in place of a text",
);

/// An operand that has been read.
#[derive(Clone, Copy, Debug)]
pub(super) enum Node {
    /// A variable alone. Only the operations of its index have been emitted.
    Variable { place: VariableRef, is_text: bool },
    /// Any other expression; its operations have been emitted.
    Number,
}

impl Compiler<'_> {
    /// The variable to which a reference refers.
    pub(super) fn variable(&self, place: VariableRef) -> Option<&Variable> {
        match place {
            VariableRef::Alone(slot) => self.variables.variable_of(slot),
            VariableRef::Member { variable, .. } => self.variables.variables.get(variable),
        }
    }

    /// Emits the operation of an operand, which must be a number.
    fn emit_operand(&mut self, node: Node) -> Result<(), Stop> {
        match node {
            Node::Number => {}
            Node::Variable { is_text: true, .. } => return Err(WRONG_TYPE),
            Node::Variable { place: VariableRef::Alone(slot), .. } => {
                self.program.operations.push(Operation::Value(slot));
            }
            Node::Variable { place: VariableRef::Member { variable, .. }, .. } => {
                self.program.operations.push(Operation::Member(variable));
            }
        }
        Ok(())
    }

    /// An expression, or a variable alone. In a condition, parentheses around a test are unspecified.
    pub(super) fn sum(&mut self, in_condition: bool) -> Result<Node, Stop> {
        self.chain(&[("+", Sum::Add), ("-", Sum::Subtract)], Self::product, in_condition)
    }

    fn product(&mut self, in_condition: bool) -> Result<Node, Stop> {
        self.chain(&[("*", Sum::Multiply), ("/", Sum::Divide)], Self::factor, in_condition)
    }

    /// Operands with operators of one precedence between them, from the left.
    fn chain(
        &mut self,
        operators: &[(&str, Sum)],
        operand: fn(&mut Self, bool) -> Result<Node, Stop>,
        in_condition: bool,
    ) -> Result<Node, Stop> {
        let mut node = operand(self, in_condition)?;
        loop {
            let Token::Sign(sign) = self.peek()? else { return Ok(node) };
            let Some((_, operation)) = operators.iter().find(|(known, _)| *known == sign) else {
                return Ok(node);
            };
            self.take()?;
            self.emit_operand(node)?;
            let right = operand(self, in_condition)?;
            self.emit_operand(right)?;
            self.program.operations.push(Operation::Two(*operation));
            node = Node::Number;
        }
    }

    fn factor(&mut self, in_condition: bool) -> Result<Node, Stop> {
        match self.take()? {
            Token::Sign(sign @ ("+" | "-")) => {
                self.enter()?;
                let node = self.factor(in_condition)?;
                self.emit_operand(node)?;
                if sign == "-" {
                    self.program.operations.push(Operation::Negate);
                }
                self.leave();
                Ok(Node::Number)
            }
            Token::Sign("(") => {
                self.enter()?;
                if in_condition && self.peek()? == Token::Sign("!") {
                    return Err(Stop::Open("! in a condition"));
                }
                let node = self.sum(in_condition)?;
                if in_condition && self.is_of_condition()? {
                    return Err(Stop::Open("parentheses around a test"));
                }
                self.expect(")")?;
                self.leave();
                Ok(node)
            }
            Token::Number(text) => {
                let number = lexer::number(text).unwrap_or_default();
                self.program.operations.push(Operation::Number(number));
                Ok(Node::Number)
            }
            Token::Text(_) => Err(WRONG_TYPE),
            Token::Word(word) => {
                let is_set_test = matches!(
                    words::keyword(&word.to_ascii_uppercase()),
                    Some(Keyword::VarSet | Keyword::VarNotSet)
                );
                if is_set_test && in_condition && self.depth > 0 {
                    return Err(Stop::Open("parentheses around a test"));
                }
                let (place, is_text) = self.reference(word, true)?;
                Ok(Node::Variable { place, is_text })
            }
            Token::Sign(_) | Token::LineFeed | Token::Bad(_) | Token::End => Err(NO_STATEMENT),
        }
    }

    /// The variable that an `IF_SET` of GPP2 tests: in parentheses or not, but not an expression.
    pub(super) fn tested(&mut self) -> Result<VariableRef, Stop> {
        if !self.takes("(")? {
            let Token::Word(word) = self.take()? else { return Err(NO_STATEMENT) };
            return Ok(self.reference(word, false)?.0);
        }
        self.enter()?;
        let place = self.tested()?;
        self.expect(")")?;
        self.leave();
        Ok(place)
    }

    /// Whether the next token can be part of a condition, but not of an expression.
    fn is_of_condition(&self) -> Result<bool, Stop> {
        Ok(match self.peek()? {
            Token::Sign("&&" | "||") => true,
            Token::Sign(sign) => Compare::of_sign(sign).is_some(),
            Token::Word(word) => {
                let keyword = words::keyword(&word.to_ascii_uppercase());
                matches!(keyword, Some(Keyword::Compare(_)))
            }
            Token::Number(_) | Token::Text(_) | Token::LineFeed | Token::Bad(_) | Token::End => {
                false
            }
        })
    }

    fn enter(&mut self) -> Result<(), Stop> {
        self.depth = self.depth.saturating_add(1);
        if self.depth > DEEPEST { Err(too_deep()) } else { Ok(()) }
    }

    fn leave(&mut self) {
        self.depth = self.depth.saturating_sub(1);
    }

    /// A reference to a variable, by its name and the index of an array, and whether the variable is a text. In an
    /// expression the name can be that of a function, which is unspecified.
    pub(super) fn reference(
        &mut self,
        word: &str,
        in_expression: bool,
    ) -> Result<(VariableRef, bool), Stop> {
        let name = word.to_ascii_uppercase();
        if words::is_taken(&name) {
            return Err(NO_STATEMENT);
        }
        let Some(variable) = self.names.get(&name).copied() else {
            if in_expression && self.raw() == Token::Sign("(") {
                return Err(Stop::Open("a function"));
            }
            let why = "a variable that is not declared";
            return Err(Stop::Refused(FaultKind::NoSuchVariable, why));
        };
        let of = self.variables.variables.get(variable).ok_or(NO_STATEMENT)?;
        let (first, size, is_text) = (of.first, of.size, of.is_text());
        let has_index = self.raw() == Token::Sign("[");
        if has_index != size.is_some() {
            let why = "an array without an index, or an index on a variable that is not an array";
            return Err(Stop::Refused(FaultKind::Statement, why));
        }
        if !has_index {
            return Ok((VariableRef::Alone(first), is_text));
        }
        self.take()?;
        self.enter()?;
        let from = self.program.operations.len();
        let node = self.sum(false)?;
        self.emit_operand(node)?;
        let index = IndexRange { from, to: self.program.operations.len() };
        self.expect("]")?;
        self.leave();
        Ok((VariableRef::Member { variable, index }, is_text))
    }
}
