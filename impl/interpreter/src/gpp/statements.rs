//! Statements: assignments, OUTPUT, PRINT, switches, and the conditions of IF, `IF_SET` and UNTIL.

use alloc::format;

use gaugeblock_vocabulary::FaultKind;

use super::compile::{Compiler, NO_STATEMENT, SYMBOLS, Stop, old_word};
use super::expressions::{Node, WRONG_TYPE};
use super::lexer::Token;
use super::program::{IndexRange, Item, Source, Statement, Target, Test};
use super::words::{self, Compare, Keyword};

impl Compiler<'_> {
    pub(super) fn assignment(&mut self) -> Result<(), Stop> {
        let Token::Word(word) = self.take()? else { return Err(NO_STATEMENT) };
        let (to, is_text) = self.reference(word, false)?;
        self.expect("=")?;
        let (source, source_is_text) = self.operand(false)?;
        if is_text != source_is_text {
            return Err(WRONG_TYPE);
        }
        self.expect(";")?;
        let line = self.line;
        self.program.statements.push(Statement::Assign { line, to, source });
        Ok(())
    }

    pub(super) fn print(&mut self, is_output: bool) -> Result<(), Stop> {
        let from = self.program.items.len();
        loop {
            let item = match self.take()? {
                Token::Sign(";") => break,
                Token::Sign(sign) if SYMBOLS.contains(&sign) && self.is_newline(sign) => {
                    Item::Symbol
                }
                Token::LineFeed => Item::LineFeed,
                Token::Text(text) => Item::Text(self.kept(text)),
                Token::Word(word) => Item::Variable(self.reference(word, false)?.0),
                Token::Sign(_) | Token::Number(_) | Token::Bad(_) | Token::End => {
                    return Err(NO_STATEMENT);
                }
            };
            self.program.items.push(item);
        }
        let items = IndexRange { from, to: self.program.items.len() };
        let line = self.line;
        self.program.statements.push(Statement::Print { line, items, is_output });
        Ok(())
    }

    /// The place of a text that the program holds.
    fn kept(&mut self, text: &str) -> usize {
        self.program.texts.push(text.into());
        self.program.texts.len().saturating_sub(1)
    }

    pub(super) fn switch(&mut self, on: bool) -> Result<(), Stop> {
        let from = self.program.targets.len();
        loop {
            let target = match self.take()? {
                Token::Sign(";") => break,
                Token::Word(word) => self.target(word)?,
                Token::Number(_)
                | Token::Text(_)
                | Token::Sign(_)
                | Token::LineFeed
                | Token::Bad(_)
                | Token::End => return Err(NO_STATEMENT),
            };
            self.program.targets.push(target);
        }
        let targets = IndexRange { from, to: self.program.targets.len() };
        if targets.from == targets.to {
            return Err(NO_STATEMENT);
        }
        let line = self.line;
        self.program.statements.push(Statement::Switch { line, on, targets });
        Ok(())
    }

    fn target(&mut self, word: &str) -> Result<Target, Stop> {
        let name = word.to_ascii_uppercase();
        if words::keyword(&name) == Some(Keyword::AllVar) {
            return if self.choices.old_words { Ok(Target::All) } else { Err(old_word()) };
        }
        if self.raw() != Token::Sign("[")
            && let Some(place) = self.names.get(&name)
            && self.variables.variables.get(*place).is_some_and(|one| one.size.is_some())
        {
            return Ok(Target::Array(*place));
        }
        Ok(Target::VariableRef(self.reference(word, false)?.0))
    }

    /// The tests of a condition in its parentheses, and whether what an `IF_SET` tests is not modal.
    pub(super) fn condition(&mut self, keyword: Keyword) -> Result<(IndexRange, bool), Stop> {
        self.expect("(")?;
        let from = self.program.tests.len();
        let mut warns = false;
        loop {
            let is_first = from == self.program.tests.len();
            warns |= self.test_of(keyword, is_first)?;
            match self.take()? {
                Token::Sign(")") => break,
                Token::Sign("&&") => {}
                Token::Sign("||") => return Err(Stop::Open("|| in a condition")),
                Token::Word(_)
                | Token::Number(_)
                | Token::Text(_)
                | Token::Sign(_)
                | Token::LineFeed
                | Token::Bad(_)
                | Token::End => return Err(NO_STATEMENT),
            }
        }
        Ok((IndexRange { from, to: self.program.tests.len() }, warns))
    }

    /// A test; whether it is the one of an `IF_SET`, of a variable that is not modal.
    fn test_of(&mut self, keyword: Keyword, is_first: bool) -> Result<bool, Stop> {
        if keyword == Keyword::IfSet && !self.choices.old_words {
            return self.test_of_set();
        }
        match self.peek()? {
            Token::Sign("!") => return Err(Stop::Open("! in a condition")),
            Token::Word(word) => match words::keyword(&word.to_ascii_uppercase()) {
                Some(Keyword::VarSet) => return self.flag(true).map(|()| false),
                Some(Keyword::VarNotSet) => return self.flag(false).map(|()| false),
                _ => {}
            },
            Token::Number(_)
            | Token::Text(_)
            | Token::Sign(_)
            | Token::LineFeed
            | Token::Bad(_)
            | Token::End => {}
        }
        let (left, left_is_text) = self.operand(true)?;
        let compare = match self.peek()? {
            Token::Sign(sign) => Compare::of_sign(sign),
            Token::Word(word) => match words::keyword(&word.to_ascii_uppercase()) {
                Some(Keyword::Compare(compare)) => Some(compare),
                _ => None,
            },
            Token::Number(_) | Token::Text(_) | Token::LineFeed | Token::Bad(_) | Token::End => {
                None
            }
        };
        let Some(compare) = compare else {
            let alone = is_first && self.peek()? == Token::Sign(")");
            return self.variable_alone(left, keyword, alone);
        };
        self.take()?;
        let (right, right_is_text) = self.operand(true)?;
        if left_is_text != right_is_text {
            return Err(WRONG_TYPE);
        }
        if left_is_text && compare.is_of_order() {
            return Err(Stop::Open("an order between texts"));
        }
        self.program.tests.push(if left_is_text {
            Test::Texts { left, compare, right }
        } else {
            Test::Numbers { left, compare, right }
        });
        Ok(false)
    }

    /// The test of an `IF_SET` of GPP2; whether its variable is not modal.
    fn test_of_set(&mut self) -> Result<bool, Stop> {
        let place = self.tested()?;
        if self.peek()? != Token::Sign(")") {
            let why = "an IF_SET that tests more than a variable";
            return Err(Stop::Refused(FaultKind::Statement, why));
        }
        self.program.tests.push(Test::Flag { place, on: true });
        Ok(self.variable(place).is_some_and(|variable| !variable.modal))
    }

    /// A variable where a test belongs.
    fn variable_alone(
        &mut self,
        left: Source,
        keyword: Keyword,
        alone: bool,
    ) -> Result<bool, Stop> {
        let Source::Variable(place) = left else { return Err(NO_STATEMENT) };
        let sets = keyword == Keyword::IfSet;
        if !(sets || alone && keyword == Keyword::Until) {
            return Err(NO_STATEMENT);
        }
        self.program.tests.push(Test::Flag { place, on: true });
        let modal = self.variable(place).is_some_and(|variable| variable.modal);
        if !(sets && alone) {
            self.warn_of_flag(place);
        }
        Ok(sets && alone && !modal)
    }

    /// `VAR_SET` or `VAR_NOTSET`, and its variable.
    fn flag(&mut self, on: bool) -> Result<(), Stop> {
        self.take()?;
        self.expect("(")?;
        let Token::Word(word) = self.take()? else { return Err(NO_STATEMENT) };
        let (place, _) = self.reference(word, false)?;
        self.expect(")")?;
        self.warn_of_flag(place);
        self.program.tests.push(Test::Flag { place, on });
        Ok(())
    }

    /// Warns where the flag of a variable is tested that is not modal.
    fn warn_of_flag(&mut self, place: super::program::VariableRef) {
        let Some(variable) = self.variable(place).filter(|variable| !variable.modal) else {
            return;
        };
        let warning = format!("{} is not modal", variable.name);
        self.program.warnings.push((self.line, warning));
    }

    /// Something that is compared or assigned, and whether it is a text.
    fn operand(&mut self, in_condition: bool) -> Result<(Source, bool), Stop> {
        if let Token::Text(text) = self.peek()? {
            self.take()?;
            return Ok((Source::Text(self.kept(text)), true));
        }
        let from = self.program.operations.len();
        match self.sum(in_condition)? {
            Node::Variable { place, is_text } => Ok((Source::Variable(place), is_text)),
            Node::Number => {
                let to = self.program.operations.len();
                Ok((Source::Expression(IndexRange { from, to }), false))
            }
        }
    }
}
