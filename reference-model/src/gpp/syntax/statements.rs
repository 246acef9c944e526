//! The statements of blocks and of the newline procedure.

use gaugeblock_vocabulary::FaultKind;

use super::reader::Reader;
use super::{Action, Condition, Item, Printer, Reference, Statement, Target, Test};
use crate::gpp::refusal::{StepError, refuse};
use crate::gpp::text::Token;
use crate::ids::{choice, rule};

impl Reader<'_> {
    /// The statements up to the next heading, the end of the program, or a word that ends or divides the statement
    /// around them.
    pub(super) fn statements(&mut self) -> Result<Vec<Statement>, StepError> {
        let mut statements = Vec::new();
        loop {
            self.begin();
            let ends = matches!(self.word(), Some("ELSE" | "END_IF" | "UNTIL")) && self.nesting > 0;
            if ends || self.is_heading() || *self.peek() == Token::End {
                return Ok(statements);
            }
            let line = self.begun;
            let action = self.action()?;
            self.coverage.accepted(rule::gpp::STATEMENT);
            statements.push(Statement { line, action });
        }
    }

    fn action(&mut self) -> Result<Action, StepError> {
        let Some(word) = self.word().map(str::to_owned) else {
            return Err(self.odd("a statement"));
        };
        match word.as_str() {
            "OUTPUT" => self.print(Printer::Output),
            "SET_ON" => self.switch(true),
            "SET_OFF" => self.switch(false),
            "RESET" => {
                self.old_word("RESET")?;
                self.switch(true)
            }
            "IF" => self.conditional(false),
            "IF_SET" => self.conditional(true),
            "REPEAT" => self.repeat(),
            "FORMAT" | "MODAL" | "NON_MODAL" | "IDENTICAL" | "NEW_LINE_IS" => {
                Err(self.late_declaration(&word))
            }
            _ if is_print(&word) => self.print(Printer::Print),
            _ if super::is_keyword(&word) => Err(self.odd("a statement")),
            _ => self.assignment(),
        }
    }

    fn assignment(&mut self) -> Result<Action, StepError> {
        let to = self.reference()?;
        self.expect("=")?;
        let side = self.side()?;
        self.expect(";")?;
        self.same_type(to.is_text(&self.variables), self.is_text(&side))?;
        Ok(Action::Assign(to, side))
    }

    /// What is assigned or compared is of one type with the other side.
    pub(super) fn same_type(&self, one: bool, other: bool) -> Result<(), StepError> {
        if one == other {
            return Ok(());
        }
        let message = "a text and a number do not go together";
        Err(refuse(rule::gpp::STATEMENT, FaultKind::WrongType, message))
    }

    fn print(&mut self, printer: Printer) -> Result<Action, StepError> {
        self.take();
        let mut items = Vec::new();
        while !self.takes(";") {
            items.push(self.item()?);
        }
        Ok(Action::Print(printer, items))
    }

    fn item(&mut self) -> Result<Item, StepError> {
        match self.peek().clone() {
            Token::Text(text) => {
                self.take();
                Ok(Item::Text(text))
            }
            Token::LineFeed => {
                self.take();
                Ok(Item::LineFeed)
            }
            Token::Sign(sign) if Some(sign) == self.symbol && !self.in_procedure => {
                self.take();
                Ok(Item::Newline)
            }
            Token::Word(_) => Ok(Item::Variable(self.reference()?)),
            Token::Number(_)
            | Token::HeadingWord(_)
            | Token::Sign(_)
            | Token::Bad(..)
            | Token::End => Err(self.odd("a text, a variable, `\\J`, the newline symbol, or `;`")),
        }
    }

    fn switch(&mut self, on: bool) -> Result<Action, StepError> {
        self.take();
        let mut targets = Vec::new();
        loop {
            targets.push(self.target()?);
            if self.takes(";") {
                return Ok(Action::Switch(on, targets));
            }
        }
    }

    fn target(&mut self) -> Result<Target, StepError> {
        if self.word() == Some("ALL_VAR") {
            self.old_word("ALL_VAR")?;
            self.take();
            return Ok(Target::All);
        }
        let place = self.place()?;
        let is_array = self.variables.all[place].size.is_some();
        if is_array && !self.is_sign("[") {
            return Ok(Target::Array(place));
        }
        Ok(Target::Variable(self.indexed(place)?))
    }

    fn conditional(&mut self, by_flag: bool) -> Result<Action, StepError> {
        let line = self.begun;
        self.take();
        let condition = if by_flag { self.flag()? } else { Condition::All(self.condition(false)?) };
        self.nest()?;
        let then = self.statements()?;
        let mut otherwise = Vec::new();
        if self.word() == Some("ELSE") && !self.is_heading() {
            self.take();
            otherwise = self.statements()?;
        }
        self.ends(line, "END_IF")?;
        self.take();
        self.expect(";")?;
        self.nesting -= 1;
        Ok(Action::If { condition, then, otherwise })
    }

    /// The word that ends a statement stands here. At a heading or the end of the program it is missing, which the
    /// statement is refused for; another such word belongs to no statement that is open.
    fn ends(&mut self, line: u32, word: &str) -> Result<(), StepError> {
        if self.is_heading() || *self.peek() == Token::End {
            self.begun = line;
            let message = format!("{word} is missing");
            return Err(refuse(rule::gpp::STATEMENT, FaultKind::Statement, message));
        }
        if self.word() == Some(word) { Ok(()) } else { Err(self.odd(word)) }
    }

    /// The condition of `IF_SET`: one variable, which is warned of when it is tested. The old GPP has conditions
    /// there, too.
    fn flag(&mut self) -> Result<Condition, StepError> {
        let warnings = self.warnings.len();
        let tests = match self.condition(true) {
            // Whatever it would say, it is a condition; but an index is an expression of its own.
            Err(StepError::Unspecified(open)) if self.in_condition => {
                self.old_word("a condition in IF_SET")?;
                return Err(StepError::Unspecified(open));
            }
            tests => tests?,
        };
        let all_alone = self.alone == tests.len();
        if let (true, [Test::Is(true, reference)]) = (all_alone, &tests[..]) {
            self.warnings.truncate(warnings);
            return Ok(Condition::Flag(reference.clone()));
        }
        if all_alone && !self.choices.is(choice::gpp::OldWords::Accepted) {
            let message = "IF_SET tests one variable";
            return Err(refuse(rule::gpp::TESTED, FaultKind::Statement, message));
        }
        self.old_word("a condition in IF_SET")?;
        Ok(Condition::All(tests))
    }

    fn repeat(&mut self) -> Result<Action, StepError> {
        let line = self.begun;
        self.take();
        self.nest()?;
        let body = self.statements()?;
        self.ends(line, "UNTIL")?;
        let until_line = self.begun;
        self.take();
        let until = match self.condition(true) {
            // A variable alone is all of a condition, so that nothing stands behind it.
            Err(StepError::Unspecified(_)) if self.alone > 0 => return Err(lone_variable()),
            Ok(tests) if self.alone > 0 && tests.len() > 1 => return Err(lone_variable()),
            tests => tests?,
        };
        self.expect(";")?;
        self.nesting -= 1;
        Ok(Action::Repeat { body, line: until_line, until })
    }

    /// Rule gpp.tested. To ask for the flag of a variable that is not modal is warned of when the program is compiled.
    pub(super) fn warn_of_non_modal(&mut self, place: usize) {
        let variable = &self.variables.all[place];
        if !variable.modal {
            self.warnings.push((self.begun, format!("warning: {} is not modal", variable.name)));
        }
    }

    /// The place of the variable whose name stands here.
    pub(super) fn place(&mut self) -> Result<usize, StepError> {
        let Some(name) = self.word().map(str::to_owned) else { return Err(self.odd("a variable")) };
        if super::is_keyword(&name) {
            return Err(self.odd("a variable"));
        }
        let place = self.variables.place(&name);
        self.take();
        place.ok_or_else(|| super::declarations::no_such(&name))
    }

    /// A variable, or a member of an array.
    pub(super) fn reference(&mut self) -> Result<Reference, StepError> {
        let place = self.place()?;
        self.indexed(place)
    }
}

/// Rule gpp.tested. A variable is a number or a text, and no condition.
pub(super) fn lone_variable() -> StepError {
    let message =
        "a variable is not a condition; expected VAR_SET or VAR_NOTSET, which test its flag";
    refuse(rule::gpp::TESTED, FaultKind::Statement, message)
}

/// PRINT, and PRINT0 to PRINT10.
fn is_print(word: &str) -> bool {
    super::is_keyword(word) && word.starts_with("PRINT")
}
