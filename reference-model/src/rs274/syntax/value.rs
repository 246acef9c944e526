//! Values: numbers, parameters, functions, and expressions in brackets.

use gaugeblock_vocabulary::FaultKind;

use super::parser::Parser;
use super::{Expression, Function, Parameter};
use crate::ids::{Rule, choice, rule};
use crate::rs274::refusal::StepError;
use crate::rs274::text::Glyph;

/// What a value is wanted for; it decides which rule refuses a missing one.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Wanted {
    /// Behind a word's letter.
    Word(char),
    /// Behind the equals sign of a setting.
    Setting,
    /// Behind the number sign of a parameter.
    ParameterNumber,
    /// Within an expression.
    Operand,
    /// Behind the letter O.
    Label,
}

const FUNCTIONS: [(&str, Function); 12] = [
    ("abs", Function::Absolute),
    ("acos", Function::ArcCosine),
    ("asin", Function::ArcSine),
    ("cos", Function::Cosine),
    ("exp", Function::Exponential),
    ("fix", Function::RoundDown),
    ("fup", Function::RoundUp),
    ("ln", Function::Logarithm),
    ("round", Function::Round),
    ("sin", Function::Sine),
    ("sqrt", Function::SquareRoot),
    ("tan", Function::Tangent),
];

impl Parser<'_> {
    /// A number, a parameter, an expression or a function, with or without a sign.
    pub(super) fn value(&mut self, wanted: Wanted) -> Result<Expression, StepError> {
        match self.peek() {
            Some('+' | '-') => self.signed(wanted),
            Some('0'..='9' | '.') => self.number().map(Expression::Number),
            Some('#') => self.parameter().map(Expression::Parameter),
            Some('[') => self.bracketed(),
            Some(Glyph::COMMENT) => {
                // Where comments are removed, none is met here.
                self.fail(rule::text::COMMENTS_REMOVED);
                let message = "a value is missing";
                Err(self.refuse(rule::text::COMMENT_INSIDE_WORD, FaultKind::BadComment, message))
            }
            _ => self.function(wanted),
        }
    }

    /// Whether a value other than a number could begin here.
    fn sees_value(&self) -> bool {
        matches!(self.peek(), Some('#' | '[')) || self.sees_function()
    }

    /// Whether the name of a function is next.
    pub(super) fn sees_function(&self) -> bool {
        self.peek().is_some_and(|next| next.is_ascii_lowercase())
            && (self.sees("atan")
                || self.sees("exists")
                || FUNCTIONS.iter().any(|(name, _)| self.sees(name)))
    }

    /// Rule numbers.sign. A number may begin with a plus or minus sign; without one it is positive.
    /// Rule numbers.form. A second sign is refused.
    /// Choice expressions.unary-minus: whether a parameter, an expression or a function may have a sign.
    fn signed(&mut self, wanted: Wanted) -> Result<Expression, StepError> {
        let minus = self.peek() == Some('-');
        self.advance();
        let value = match self.peek() {
            Some('0'..='9' | '.') => {
                self.reach(rule::numbers::SIGN);
                self.value(wanted)?
            }
            Some('+' | '-') if self.choices.dialect().second_sign_is_allowed(self.choices) => {
                self.value(wanted)?
            }
            Some('+' | '-') => {
                return Err(self.refuse(
                    rule::numbers::FORM,
                    FaultKind::BadNumber,
                    "a number has one sign, no second one",
                ));
            }
            Some(Glyph::COMMENT) => self.value(wanted)?,
            _ if self.sees_value() => {
                if self.choices.is(choice::expressions::UnaryMinus::Refused) {
                    let message = "a sign belongs to a number, which does not begin";
                    return Err(self.refuse(
                        rule::numbers::FORM,
                        FaultKind::BadExpression,
                        message,
                    ));
                }
                self.value(wanted)?
            }
            _ => {
                return Err(self.refuse(
                    rule::numbers::DIGITS,
                    FaultKind::BadNumber,
                    "a sign without digits",
                ));
            }
        };
        if !minus {
            return Ok(value);
        }
        Ok(match value {
            Expression::Number(number) => Expression::Number(-number),
            value @ (Expression::Parameter(_)
            | Expression::Negate(_)
            | Expression::Function(..)
            | Expression::ArcTangent(..)
            | Expression::Exists(_)
            | Expression::Binary(..)) => Expression::Negate(Box::new(value)),
        })
    }

    /// Rule numbers.digits. Digits may be left out before or after the decimal point, not on both sides.
    /// Rule numbers.form. A second decimal point is refused.
    /// Rule numbers.zeros. Leading and trailing zeros change no number.
    /// Rule numbers.many-digits. A number may have any number of digits; about seventeen significant ones count.
    fn number(&mut self) -> Result<f64, StepError> {
        let mut text = std::mem::take(&mut self.room.digits);
        text.clear();
        self.take_into(&mut text, |character| character.is_ascii_digit());
        let whole = text.len();
        if self.take(".") {
            text.push('.');
            self.take_into(&mut text, |character| character.is_ascii_digit());
        }
        if self.peek() == Some('.') {
            return Err(self.refuse(
                rule::numbers::FORM,
                FaultKind::BadNumber,
                "a number has a second decimal point",
            ));
        }
        let counted = self.choices.dialect().digits_that_count(&text, self.choices);
        let Ok(number) = counted.parse() else {
            return Err(self.refuse(
                rule::numbers::DIGITS,
                FaultKind::BadNumber,
                "a decimal point without digits",
            ));
        };
        if whole == 0 || text.ends_with('.') {
            self.reach(rule::numbers::DIGITS);
        }
        if text.starts_with('0') || text.ends_with('0') {
            self.reach(rule::numbers::ZEROS);
        }
        if text.len() > 15 {
            self.reach(rule::numbers::MANY_DIGITS);
        }
        self.room.digits = text;
        Ok(number)
    }

    /// Rule parameters.indirect. The number sign may be repeated or precede an expression: the value within is the
    /// parameter's number.
    /// Rule parameters.sign-first. The number sign binds closer than any operator.
    /// Rule parameters.name-marks. A name is enclosed in < and >.
    /// Choice parameters.function-number: whether a function gives the number.
    pub(super) fn parameter(&mut self) -> Result<Parameter, StepError> {
        self.advance();
        if self.peek() == Some('<') {
            return self.name().map(Parameter::Named);
        }
        if matches!(self.peek(), Some('#' | '[')) {
            self.reach(rule::parameters::INDIRECT);
        }
        if self.sees_function() && self.choices.is(choice::parameters::FunctionNumber::Refused) {
            let message = "a function in place of a parameter's number";
            return Err(self.refuse(rule::parameters::INDIRECT, FaultKind::BadExpression, message));
        }
        let number = self.value(Wanted::ParameterNumber)?;
        self.reach(rule::parameters::SIGN_FIRST);
        Ok(Parameter::Numbered(Box::new(number)))
    }

    /// Rule parameters.name-spelling. Case and blanks in a name do not count.
    pub(super) fn name(&mut self) -> Result<String, StepError> {
        self.advance();
        // A NUL is not a valid character anywhere.
        let ends = ['>', Glyph::COMMENT, '\0'];
        let name = self.take_while(|character| !ends.contains(&character));
        let empty = name.is_empty() && !self.choices.dialect().empty_name_is_allowed(self.choices);
        if empty || !self.take(">") {
            let message = "a name without its closing >";
            return Err(self.refuse(rule::parameters::NAME_MARKS, FaultKind::BadBlock, message));
        }
        self.reach(rule::parameters::NAME_SPELLING);
        Ok(name)
    }

    /// Rule expressions.function-brackets. A function takes its argument in brackets.
    fn function(&mut self, wanted: Wanted) -> Result<Expression, StepError> {
        if self.take("exists") {
            return self.exists();
        }
        if self.take("atan") {
            return self.arc_tangent();
        }
        match FUNCTIONS.iter().find(|(name, _)| self.sees(name)) {
            Some((name, function)) => {
                self.take(name);
                let argument = self.argument(rule::expressions::FUNCTION_BRACKETS)?;
                Ok(Expression::Function(*function, Box::new(argument)))
            }
            None => Err(self.missing(wanted)),
        }
    }

    /// A function's argument.
    fn argument(&mut self, rule: Rule) -> Result<Expression, StepError> {
        if self.peek() == Some('[') {
            return self.bracketed();
        }
        Err(self.refuse(
            rule,
            FaultKind::BadExpression,
            "the argument of a function without brackets",
        ))
    }

    /// Rule expressions.arctangent. ATAN takes two bracketed arguments with a slash between them.
    fn arc_tangent(&mut self) -> Result<Expression, StepError> {
        const RULE: Rule = rule::expressions::ARCTANGENT;
        let opposite = self.argument(RULE)?;
        if !self.take("/") {
            return Err(self.refuse(
                RULE,
                FaultKind::BadExpression,
                "ATAN without a slash after its first argument",
            ));
        }
        let adjacent = self.argument(RULE)?;
        Ok(Expression::ArcTangent(Box::new(opposite), Box::new(adjacent)))
    }

    /// Rule expressions.exists-argument. EXISTS of a numbered parameter or of an expression is refused.
    fn exists(&mut self) -> Result<Expression, StepError> {
        let wrong = |parser: &Self| {
            let message = "EXISTS without a named parameter in brackets";
            Err(parser.refuse(
                rule::expressions::EXISTS_ARGUMENT,
                FaultKind::BadExpression,
                message,
            ))
        };
        if !self.take("[") || self.peek() != Some('#') {
            return wrong(self);
        }
        let numbered = self.peek_after(1) != Some('<');
        if numbered && !self.choices.dialect().exists_takes_numbered(self.choices) {
            return wrong(self);
        }
        let parameter = self.parameter()?;
        if !self.take("]") {
            return wrong(self);
        }
        Ok(Expression::Exists(parameter))
    }

    /// Which rule misses a value.
    fn missing(&self, wanted: Wanted) -> StepError {
        let letter = self.peek().is_some_and(|next| next.is_ascii_lowercase());
        let letters = (0..)
            .take_while(|index| {
                self.peek_after(*index).is_some_and(|next| next.is_ascii_lowercase())
            })
            .count();
        let called = letters > 1 && self.peek_after(letters) == Some('[');
        let (rule, kind, message) = match wanted {
            Wanted::ParameterNumber if letter => {
                (rule::parameters::NAME_MARKS, FaultKind::BadBlock, "a name without < and >")
            }
            Wanted::ParameterNumber if self.peek() == Some('=') => (
                rule::parameters::ASSIGNMENT_FORM,
                FaultKind::BadBlock,
                "a parameter's number is missing",
            ),
            Wanted::Operand | Wanted::ParameterNumber if self.peek().is_none() => {
                (rule::expressions::UNBALANCED, FaultKind::BadExpression, "a bracket is not closed")
            }
            _ if called => {
                (rule::expressions::UNKNOWN_OPERATOR, FaultKind::BadExpression, "no such function")
            }
            Wanted::Operand if letter && self.operator().is_none() => {
                (rule::expressions::UNKNOWN_OPERATOR, FaultKind::BadExpression, "no such function")
            }
            Wanted::Operand | Wanted::ParameterNumber => {
                (rule::expressions::INCOMPLETE, FaultKind::BadExpression, "a value is missing")
            }
            Wanted::Word(letter) => {
                let message = format!("the number of {} is missing", letter.to_ascii_uppercase());
                return self.refuse(rule::text::WORD_VALUE, FaultKind::BadNumber, &message);
            }
            Wanted::Setting => (
                rule::parameters::ASSIGNMENT_FORM,
                FaultKind::BadBlock,
                "a setting's value is missing",
            ),
            Wanted::Label => (
                rule::control::UNRELATED_WORDS,
                FaultKind::BadBlock,
                "the label of an O-word is missing",
            ),
        };
        self.refuse(rule, kind, message)
    }
}
