//! Expressions in brackets: operands, operators and their precedence.

use gaugeblock_vocabulary::FaultKind;

use super::parser::Parser;
use super::value::Wanted;
use super::{Expression, Operator};
use crate::ids::{Rule, choice, rule};
use crate::rs274::refusal::StepError;
use crate::rs274::text::Glyph;

const OPERATORS: [(&str, Operator); 15] = [
    ("**", Operator::Power),
    ("*", Operator::Multiply),
    ("/", Operator::Divide),
    ("mod", Operator::Modulus),
    ("+", Operator::Add),
    ("-", Operator::Subtract),
    ("eq", Operator::Equal),
    ("ne", Operator::NotEqual),
    ("gt", Operator::Greater),
    ("ge", Operator::GreaterOrEqual),
    ("lt", Operator::Less),
    ("le", Operator::LessOrEqual),
    ("and", Operator::And),
    ("or", Operator::Or),
    ("xor", Operator::ExclusiveOr),
];

/// Groups of operators in the order in which they are performed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Group {
    Power,
    Product,
    Sum,
    Comparison,
    Logic,
}

impl Group {
    const ALL: [Self; 5] = [Self::Power, Self::Product, Self::Sum, Self::Comparison, Self::Logic];

    /// The group of an operator. Rule expressions.logical-precedence. Whether AND, OR and XOR are among additions and
    /// subtractions is a choice.
    fn of(operator: Operator, is_logic_a_sum: bool) -> Self {
        match operator {
            Operator::And | Operator::Or | Operator::ExclusiveOr if is_logic_a_sum => Self::Sum,
            Operator::Power => Self::Power,
            Operator::Multiply | Operator::Divide | Operator::Modulus => Self::Product,
            Operator::Add | Operator::Subtract => Self::Sum,
            Operator::Equal
            | Operator::NotEqual
            | Operator::Greater
            | Operator::GreaterOrEqual
            | Operator::Less
            | Operator::LessOrEqual => Self::Comparison,
            Operator::And | Operator::Or | Operator::ExclusiveOr => Self::Logic,
        }
    }

    /// The rule that puts a group before all that follow it.
    fn rule(self) -> Rule {
        match self {
            Self::Power => rule::expressions::POWER_FIRST,
            Self::Product => rule::expressions::MULTIPLY_BEFORE_ADD,
            Self::Sum => rule::expressions::ADD_BEFORE_COMPARE,
            Self::Comparison => rule::expressions::COMPARE_BEFORE_LOGICAL,
            Self::Logic => rule::expressions::LEFT_FIRST,
        }
    }
}

impl Parser<'_> {
    /// The operator that is next, with its spelling.
    pub(super) fn operator(&self) -> Option<(&'static str, Operator)> {
        OPERATORS.iter().copied().find(|(spelling, _)| self.sees(spelling))
    }

    /// An expression with its brackets.
    ///
    /// Rule expressions.nested. An expression may contain expressions.
    /// Rule expressions.unbalanced. An expression without its closing bracket is refused.
    pub(super) fn bracketed(&mut self) -> Result<Expression, StepError> {
        self.advance();
        if self.peek() == Some('[') {
            self.reach(rule::expressions::NESTED);
        }
        let mut operands = vec![self.value(Wanted::Operand)?];
        let mut operators = Vec::new();
        while !self.take("]") {
            let Some((spelling, operator)) = self.operator() else {
                return Err(self.no_operator());
            };
            self.take(spelling);
            operators.push(operator);
            operands.push(self.value(Wanted::Operand)?);
        }
        let is_logic_a_sum = self.choices.is(choice::expressions::LogicalPrecedence::WithAddition);
        let groups: Vec<_> =
            operators.iter().map(|operator| Group::of(*operator, is_logic_a_sum)).collect();
        self.reach_groups(&operators, &groups);
        Ok(combine(operands, operators, groups))
    }

    /// Which rule refuses what stands where an operator or the closing bracket should stand.
    ///
    /// Rule expressions.incomplete. An expression that lacks an operator is refused.
    /// Rule expressions.unknown-operator. An operator that the table does not list is refused.
    /// Rule numbers.no-exponent. What looks like an exponent is not part of a number and is refused.
    fn no_operator(&self) -> StepError {
        let next = self.peek();
        let digit =
            |character: Option<char>| character.is_some_and(|character| character.is_ascii_digit());
        let exponent = digit(self.last()) && next == Some('e');
        let (rule, kind, message) = match next {
            None => {
                (rule::expressions::UNBALANCED, FaultKind::BadExpression, "a bracket is not closed")
            }
            Some(Glyph::COMMENT) => {
                (rule::text::COMMENT_INSIDE_WORD, FaultKind::BadComment, "an expression goes on")
            }
            Some('[' | '#' | '0'..='9') => {
                (rule::expressions::INCOMPLETE, FaultKind::BadExpression, "an operator is missing")
            }
            Some(_) if self.sees_function() => {
                (rule::expressions::INCOMPLETE, FaultKind::BadExpression, "an operator is missing")
            }
            Some(_) if exponent => {
                (rule::numbers::NO_EXPONENT, FaultKind::BadNumber, "a number has no exponent")
            }
            Some(_) => {
                (rule::expressions::UNKNOWN_OPERATOR, FaultKind::BadExpression, "no such operator")
            }
        };
        self.refuse(rule, kind, message)
    }

    /// The rules of precedence that an expression with these operators reaches.
    fn reach_groups(&mut self, operators: &[Operator], groups: &[Group]) {
        for group in Group::ALL {
            let of_group = groups.iter().filter(|other| **other == group).count();
            if of_group > 1 {
                self.reach(rule::expressions::LEFT_FIRST);
            }
            if of_group > 0 && groups.iter().any(|other| *other > group) {
                self.reach(group.rule());
            }
        }
        let is_logical = |operator: &Operator| {
            matches!(operator, Operator::And | Operator::Or | Operator::ExclusiveOr)
        };
        let is_sum = |operator: &Operator| matches!(operator, Operator::Add | Operator::Subtract);
        if operators.iter().any(is_logical) && operators.iter().any(is_sum) {
            self.reach(rule::expressions::LOGICAL_PRECEDENCE);
        }
        if !operators.is_empty() {
            self.reach(rule::expressions::OPERATORS_IN_BRACKETS);
        }
    }
}

/// Operations of a group are performed before those of the groups that follow.
///
/// Rule expressions.left-first. Of operations of one group the one on the left comes first.
fn combine(
    mut operands: Vec<Expression>,
    mut operators: Vec<Operator>,
    mut groups: Vec<Group>,
) -> Expression {
    for group in Group::ALL {
        while let Some(index) = groups.iter().position(|other| *other == group) {
            groups.remove(index);
            let operator = operators.remove(index);
            let right = operands.remove(index + 1);
            let left = std::mem::replace(&mut operands[index], Expression::Number(0.0));
            operands[index] = Expression::Binary(operator, Box::new(left), Box::new(right));
        }
    }
    operands.swap_remove(0)
}
