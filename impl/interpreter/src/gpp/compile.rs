//! A program from its text: what is refused is refused here, before anything runs.

use alloc::collections::BTreeMap;
use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use super::choices::Choices;
use super::formats::{self, Format};
use super::lexer::{self, Lexer, Placed, Token};
use super::program::{Program, Statement};
use super::toolpath::{System, heading};
use super::variables::Variables;
use super::words::{self, Keyword};

/// Deepest nesting, of IF and REPEAT, and of parentheses, brackets and signs.
pub(super) const DEEPEST: usize = 50;
/// The signs that may be the symbol of the newline procedure.
pub(super) const SYMBOLS: [&str; 9] = ["!", "#", "$", "%", "&", "@", "?", "^", "~"];

/// Why a statement is not valid.
#[derive(Clone, Copy, Debug)]
pub(super) enum Stop {
    /// It is refused.
    Refused(FaultKind, &'static str),
    /// It is refused at another line than its own.
    RefusedAt(u32, FaultKind, &'static str),
    /// The documents leave it open.
    Open(&'static str),
}

/// A statement of another form than any that there is.
pub(super) const NO_STATEMENT: Stop = Stop::Refused(FaultKind::Statement, "not a statement");

/// A compiled program.
#[derive(Debug)]
pub(super) struct Compiled {
    pub(super) program: Program,
    pub(super) variables: Variables,
    /// Where the statements of each heading begin.
    pub(super) blocks: BTreeMap<String, usize>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Section {
    Declarations,
    Newline,
    Blocks,
}

/// An IF or REPEAT whose end has not come yet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Opened {
    pub(super) line: u32,
    pub(super) structure: Structure,
}

#[derive(Clone, Copy, Debug)]
pub(super) enum Structure {
    /// The statement that tests, and the jump before the ELSE if that has come.
    If { test: usize, jump: Option<usize> },
    /// The statement after REPEAT.
    Repeat { first: usize },
}

/// A program that is being compiled.
pub(super) struct Compiler<'a> {
    lexer: Lexer<'a>,
    next: Placed<'a>,
    pub(super) program: Program,
    pub(super) variables: Variables,
    pub(super) names: BTreeMap<String, usize>,
    /// The declared modality of each variable.
    pub(super) declared: Vec<Option<bool>>,
    /// Whether FORMAT has named a variable.
    pub(super) formatted: Vec<bool>,
    pub(super) choices: Choices,
    formats: &'a [Format],
    section: Section,
    /// The symbol of `NEW_LINE_IS`.
    symbol: Option<&'a str>,
    pub(super) opened: Vec<Opened>,
    blocks: BTreeMap<String, usize>,
    /// Parentheses, brackets and signs around what is being read.
    pub(super) depth: usize,
    /// The line at which the statement begins.
    pub(super) line: u32,
}

/// Compiles a program.
///
/// # Errors
/// The first statement that is not valid, by its line.
pub(super) fn compile(
    text: &str,
    systems: &[System],
    formats: &[Format],
    choices: Choices,
) -> Result<Compiled, (u32, Stop)> {
    let mut lexer = Lexer::new(text);
    let next = lexer.take();
    let mut compiler = Compiler {
        lexer,
        next,
        program: Program::default(),
        variables: Variables::default(),
        names: BTreeMap::new(),
        declared: Vec::new(),
        formatted: Vec::new(),
        choices,
        formats,
        section: Section::Declarations,
        symbol: None,
        opened: Vec::new(),
        blocks: BTreeMap::new(),
        depth: 0,
        line: 1,
    };
    // There is room for them: a toolpath has no more.
    for system in systems {
        compiler.name(system.name.clone(), system.format, None);
    }
    compiler.text().map_err(|stop| match stop {
        Stop::RefusedAt(line, kind, why) => (line, Stop::Refused(kind, why)),
        stop @ (Stop::Refused(..) | Stop::Open(_)) => (compiler.line, stop),
    })?;
    let Compiler { program, variables, blocks, .. } = compiler;
    Ok(Compiled { program, variables, blocks })
}

impl<'a> Compiler<'a> {
    /// Declares a variable; whether there is room for it.
    pub(super) fn name(&mut self, name: String, format: usize, size: Option<usize>) -> bool {
        let place = self.variables.variables.len();
        if !self.variables.declare(name.clone(), format, size) {
            return false;
        }
        self.names.insert(name, place);
        self.declared.push(None);
        self.formatted.push(false);
        true
    }

    /// The next token as it is, whatever it is.
    pub(super) fn raw(&self) -> Token<'a> {
        self.next.token
    }

    /// The next token.
    ///
    /// # Errors
    /// It is none.
    pub(super) fn peek(&self) -> Result<Token<'a>, Stop> {
        match self.next.token {
            Token::Bad(kind) => {
                let why = if kind == FaultKind::TextTooLong {
                    "a text of more than 256 characters"
                } else {
                    "a character that belongs nowhere, or a text that is not closed"
                };
                Err(Stop::Refused(kind, why))
            }
            Token::Number(text) if lexer::number(text).is_none() => {
                Err(Stop::Refused(FaultKind::BadNumber, "a number that is none"))
            }
            token @ (Token::Word(_)
            | Token::Number(_)
            | Token::Text(_)
            | Token::Sign(_)
            | Token::LineFeed
            | Token::End) => Ok(token),
        }
    }

    /// Takes the next token.
    pub(super) fn take(&mut self) -> Result<Token<'a>, Stop> {
        let token = self.peek()?;
        self.next = self.lexer.take();
        Ok(token)
    }

    /// Takes a sign if it is the next token.
    pub(super) fn takes(&mut self, sign: &str) -> Result<bool, Stop> {
        let is = self.peek()? == Token::Sign(sign);
        if is {
            self.take()?;
        }
        Ok(is)
    }

    /// Takes a sign that must come next.
    pub(super) fn expect(&mut self, sign: &str) -> Result<(), Stop> {
        if self.takes(sign)? { Ok(()) } else { Err(NO_STATEMENT) }
    }

    fn text(&mut self) -> Result<(), Stop> {
        loop {
            self.line = self.next.line;
            self.depth = 0;
            if self.next.token == Token::End {
                return self.end();
            }
            match self.heading() {
                Some((heading, lexer)) => {
                    self.lexer = lexer;
                    self.next = self.lexer.take();
                    self.block(heading)?;
                }
                None => self.statement()?,
            }
        }
    }

    /// The heading that comes next, and the text after it.
    fn heading(&self) -> Option<(String, Lexer<'a>)> {
        if !self.next.begins_line {
            return None;
        }
        let (mut lexer, mut next) = (self.lexer, self.next);
        let name = words_before_colon(&mut lexer, &mut next, self.line)?;
        let behind_name = lexer;
        next = lexer.take();
        match words_before_colon(&mut lexer, &mut next, self.line) {
            Some(qualifier) => Some((heading(&name, Some(&qualifier)), lexer)),
            None => Some((heading(&name, None), behind_name)),
        }
    }

    fn block(&mut self, heading: String) -> Result<(), Stop> {
        self.end()?;
        self.section = Section::Blocks;
        if words::is_taken(heading.split(':').next().unwrap_or_default()) {
            let why = "a word of the language is not a valid name of a block";
            return Err(Stop::Refused(FaultKind::Declaration, why));
        }
        if self.blocks.insert(heading, self.program.statements.len()).is_some() {
            let why = "a block of this name and qualifier exists already";
            return Err(Stop::Refused(FaultKind::Declaration, why));
        }
        Ok(())
    }

    /// The end of the section or block before.
    fn end(&mut self) -> Result<(), Stop> {
        if let Some(opened) = self.opened.last() {
            let why = "an IF or REPEAT without its end";
            return Err(Stop::RefusedAt(opened.line, FaultKind::Statement, why));
        }
        if self.section == Section::Declarations {
            self.settle();
        } else {
            self.program.statements.push(Statement::End);
        }
        Ok(())
    }

    /// The declarations are over: now it is known which variables are modal.
    fn settle(&mut self) {
        for (variable, declared) in self.variables.variables.iter_mut().zip(&self.declared) {
            let by_format = self.choices.modal_by_format
                && self.formats.get(variable.format).is_some_and(|format| format.modal);
            variable.modal = declared.unwrap_or(by_format);
        }
    }

    fn statement(&mut self) -> Result<(), Stop> {
        let Token::Word(word) = self.peek()? else { return Err(NO_STATEMENT) };
        let keyword = words::keyword(&word.to_ascii_uppercase());
        let declares = matches!(
            keyword,
            Some(
                Keyword::Format
                    | Keyword::Modal
                    | Keyword::NonModal
                    | Keyword::Identical
                    | Keyword::NewLineIs
            )
        );
        let is_old = match keyword {
            Some(Keyword::NonModal) => self.section == Section::Declarations,
            Some(Keyword::Reset) => true,
            _ => false,
        };
        if is_old && !self.choices.old_words {
            return Err(old_word());
        }
        match (self.section, keyword) {
            (Section::Declarations, Some(keyword)) if declares => {
                self.take()?;
                if keyword == Keyword::NewLineIs {
                    self.newline()
                } else {
                    self.declaration(keyword)
                }
            }
            (Section::Declarations, _) => Err(NO_STATEMENT),
            (Section::Newline | Section::Blocks, _) if declares => Err(Stop::Refused(
                FaultKind::Declaration,
                "a declaration after the part for declarations",
            )),
            (Section::Newline | Section::Blocks, Some(keyword)) => {
                self.take()?;
                self.executed(keyword)
            }
            (Section::Newline | Section::Blocks, None) => self.assignment(),
        }
    }

    fn newline(&mut self) -> Result<(), Stop> {
        self.symbol = match self.take()? {
            Token::Sign(sign) if SYMBOLS.contains(&sign) => Some(sign),
            Token::Word(_)
            | Token::Number(_)
            | Token::Text(_)
            | Token::Sign(_)
            | Token::LineFeed
            | Token::Bad(_)
            | Token::End => return Err(NO_STATEMENT),
        };
        self.expect(";")?;
        self.settle();
        self.section = Section::Newline;
        self.program.newline = Some(self.program.statements.len());
        Ok(())
    }

    /// Whether a sign runs the newline procedure where it is printed.
    pub(super) fn is_newline(&self, sign: &str) -> bool {
        self.symbol == Some(sign) && self.section == Section::Blocks
    }
}

/// Words of one line up to a colon, which is taken; none where something else comes first.
fn words_before_colon<'a>(
    lexer: &mut Lexer<'a>,
    next: &mut Placed<'a>,
    line: u32,
) -> Option<String> {
    let mut words = String::new();
    loop {
        match next.token {
            _ if next.line != line => return None,
            Token::Word(word) => words.push_str(word),
            Token::Number(word) if word.chars().all(lexer::is_of_word) => words.push_str(word),
            Token::Sign(":") if !words.is_empty() => return Some(words),
            Token::Number(_)
            | Token::Text(_)
            | Token::Sign(_)
            | Token::LineFeed
            | Token::Bad(_)
            | Token::End => return None,
        }
        words.push(' ');
        *next = lexer.take();
    }
}

/// The refusal of a word of the old GPP.
pub(super) fn old_word() -> Stop {
    Stop::Refused(FaultKind::Statement, "a word of the old GPP")
}

/// The refusal of what is nested too deep.
pub(super) fn too_deep() -> Stop {
    Stop::Refused(FaultKind::TooManyLevels, "nested more than 50 deep")
}

/// The place of a format's name.
pub(super) fn format_named(word: &str) -> Option<usize> {
    formats::named(&word.to_ascii_uppercase())
}
