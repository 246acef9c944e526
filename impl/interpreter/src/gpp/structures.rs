//! Statements by their keyword, and the structures that IF and REPEAT open.

use super::compile::{Compiler, DEEPEST, NO_STATEMENT, Opened, Stop, Structure, too_deep};
use super::program::{IndexRange, Statement};
use super::words::Keyword;

impl Compiler<'_> {
    /// A statement that begins with a keyword.
    pub(super) fn executed(&mut self, keyword: Keyword) -> Result<(), Stop> {
        match keyword {
            Keyword::Output => self.print(true),
            Keyword::Print => self.print(false),
            Keyword::SetOn | Keyword::Reset => self.switch(true),
            Keyword::SetOff => self.switch(false),
            Keyword::If | Keyword::IfSet => {
                self.deeper()?;
                let (tests, warns) = self.condition(keyword)?;
                let test = self.program.statements.len();
                self.open(Structure::If { test, jump: None });
                self.test(tests, 0, warns);
                Ok(())
            }
            Keyword::Repeat => {
                self.deeper()?;
                let first = self.program.statements.len();
                self.open(Structure::Repeat { first });
                Ok(())
            }
            Keyword::Else => self.otherwise(),
            Keyword::EndIf => self.end_if(),
            Keyword::Until => self.until(),
            Keyword::Format
            | Keyword::Modal
            | Keyword::NonModal
            | Keyword::Identical
            | Keyword::NewLineIs
            | Keyword::VarSet
            | Keyword::VarNotSet
            | Keyword::AllVar
            | Keyword::Compare(_) => Err(NO_STATEMENT),
        }
    }

    fn deeper(&self) -> Result<(), Stop> {
        if self.opened.len() < DEEPEST { Ok(()) } else { Err(too_deep()) }
    }

    fn open(&mut self, structure: Structure) {
        self.opened.push(Opened { line: self.line, structure });
    }

    fn test(&mut self, tests: IndexRange, otherwise: usize, warns: bool) {
        let line = self.line;
        self.program.statements.push(Statement::Test { line, tests, otherwise, warns });
    }

    fn otherwise(&mut self) -> Result<(), Stop> {
        let here = self.program.statements.len();
        let Some(Opened { structure: Structure::If { test, jump }, .. }) = self.opened.last_mut()
        else {
            return Err(NO_STATEMENT);
        };
        if jump.replace(here).is_some() {
            return Err(NO_STATEMENT);
        }
        let test = *test;
        self.program.statements.push(Statement::Jump(0));
        self.lead(test);
        Ok(())
    }

    fn end_if(&mut self) -> Result<(), Stop> {
        let Some(Opened { structure: Structure::If { test, jump }, .. }) =
            self.opened.last().copied()
        else {
            return Err(NO_STATEMENT);
        };
        self.expect(";")?;
        self.opened.pop();
        self.lead(jump.unwrap_or(test));
        Ok(())
    }

    /// Leads a statement to the one that comes next.
    fn lead(&mut self, from: usize) {
        let here = self.program.statements.len();
        if let Some(Statement::Test { otherwise: to, .. } | Statement::Jump(to)) =
            self.program.statements.get_mut(from)
        {
            *to = here;
        }
    }

    fn until(&mut self) -> Result<(), Stop> {
        let Some(Opened { structure: Structure::Repeat { first }, .. }) =
            self.opened.last().copied()
        else {
            return Err(NO_STATEMENT);
        };
        let (tests, _) = self.condition(Keyword::Until)?;
        self.expect(";")?;
        self.opened.pop();
        self.test(tests, first, false);
        Ok(())
    }
}
