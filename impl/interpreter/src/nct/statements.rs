//! Reads the content of a line after its numbers: words, or a macro statement.

use gaugeblock_vocabulary::FaultKind;

use super::expressions::{Reader, bad_statement};
use super::program::{Kind, Stop, Word, refuse};
use crate::index_range::IndexRange;

/// What a loop's block is, before it is known which other one belongs to it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Ring {
    /// DO, by its number.
    Opens(u32),
    /// END, by its number.
    Closes(u32),
}

impl Reader<'_> {
    /// A block, and what it has to do with a loop.
    pub(super) fn block(&mut self) -> Result<(Kind, Option<Ring>), Stop> {
        if self.cursor.peek() == b'#' {
            return self.assignment().map(without_loop);
        }
        if self.cursor.takes(b"GOTO") {
            let to = self.value()?;
            self.end()?;
            return Ok(without_loop(Kind::Goto(to)));
        }
        if self.cursor.takes(b"IF") {
            return self.branch().map(without_loop);
        }
        let is_while = self.cursor.takes(b"WHILE");
        let is_do = !is_while && self.cursor.takes(b"DO");
        let is_end = !is_while && !is_do && self.cursor.takes(b"END");
        if (is_while || is_do || is_end) && self.choices.no_loops {
            return bad_statement();
        }
        if is_while {
            let condition = self.condition()?;
            self.expect(b"DO")?;
            let number = self.number_of_loop()?;
            return Ok((Kind::While { condition, behind: 0 }, Some(Ring::Opens(number))));
        }
        if is_do {
            return Err(Stop::Open("DO without WHILE"));
        }
        if is_end {
            let number = self.number_of_loop()?;
            return Ok((Kind::End(0), Some(Ring::Closes(number))));
        }
        self.words().map(without_loop)
    }

    /// `assignment := variable '=' expression`
    fn assignment(&mut self) -> Result<Kind, Stop> {
        let to = self.target()?;
        self.expect(b"=")?;
        Ok(Kind::Assign { to, from: self.last_expression()? })
    }

    /// `'IF' condition 'GOTO' value`
    fn branch(&mut self) -> Result<Kind, Stop> {
        let condition = self.condition()?;
        if self.cursor.takes(b"THEN") {
            return Err(Stop::Open("IF with THEN"));
        }
        self.expect(b"GOTO")?;
        let to = self.value()?;
        self.end()?;
        Ok(Kind::If { condition, to })
    }

    /// The m of DO and END.
    fn number_of_loop(&mut self) -> Result<u32, Stop> {
        let Some(number) = self.cursor.number_of_loop() else { return bad_statement() };
        self.end()?;
        Ok(number)
    }

    fn end(&self) -> Result<(), Stop> {
        if self.cursor.is_at_end() { Ok(()) } else { bad_statement() }
    }

    fn words(&mut self) -> Result<Kind, Stop> {
        let from = self.code.words.len();
        while !self.cursor.is_at_end() {
            let Some(letter) = self.cursor.letter() else {
                return refuse(FaultKind::BadBlock, "no word begins here");
            };
            if matches!(letter, b'N' | b'O') {
                if self.cursor.begins_variable() {
                    return refuse(FaultKind::Statement, "O and N take no variable");
                }
                return refuse(FaultKind::BadBlock, "O and N open their block");
            }
            let value = self.value()?;
            self.code.words.push(Word { letter, value });
        }
        Ok(Kind::Words(IndexRange { from, to: self.code.words.len() }))
    }
}

fn without_loop(kind: Kind) -> (Kind, Option<Ring>) {
    (kind, None)
}
