//! The reader: where it stands in a program, and the parts that every statement is made of.

use std::collections::BTreeMap;

use gaugeblock_vocabulary::FaultKind;

use super::{DEEPEST, Heading, Program, Statement, is_keyword};
use crate::Choices;
use crate::RuleCoverage;
use crate::gpp::refusal::{StepError, refuse, refuse_form};
use crate::gpp::text::{Placed, Token, no_number, tokens};
use crate::gpp::variables::Variables;
use crate::ids::rule;

/// Reads a program over the variables that the toolpath declares.
///
/// # Errors
/// The first statement that is refused: the line where it begins, and why.
pub fn read(
    text: &str,
    variables: Variables,
    choices: Choices,
    coverage: &mut RuleCoverage,
) -> Result<Program, (u32, StepError)> {
    let mut reader = Reader {
        tokens: tokens(text),
        at: 0,
        begun: 1,
        symbol: None,
        in_procedure: false,
        in_condition: false,
        depth: 0,
        nesting: 0,
        alone: 0,
        variables,
        choices,
        coverage,
        warnings: Vec::new(),
    };
    let parts = reader.program();
    let begun = reader.begun;
    let Reader { variables, warnings, .. } = reader;
    let (procedure, blocks) = parts.map_err(|error| (begun, error))?;
    Ok(Program { variables, procedure, blocks, warnings })
}

/// The procedure of the newline symbol, and the blocks.
type Parts = (Vec<Statement>, BTreeMap<Heading, Vec<Statement>>);

/// A program that is being read.
pub(super) struct Reader<'a> {
    tokens: Vec<Placed>,
    at: usize,
    /// The line where the statement begins that is being read.
    pub(super) begun: u32,
    /// The newline symbol, once it is declared.
    pub(super) symbol: Option<&'static str>,
    pub(super) in_procedure: bool,
    /// Within the parentheses of a condition, and not within the brackets of an index there. It tells where reading
    /// has stopped, too.
    pub(super) in_condition: bool,
    /// How many parentheses, brackets and signs are open.
    pub(super) depth: usize,
    /// How many statements are open.
    pub(super) nesting: usize,
    /// How many variables stood alone as tests of the last condition.
    pub(super) alone: usize,
    pub(super) variables: Variables,
    pub(super) choices: Choices,
    pub(super) coverage: &'a mut RuleCoverage,
    pub(super) warnings: Vec<(u32, String)>,
}

impl Reader<'_> {
    fn program(&mut self) -> Result<Parts, StepError> {
        self.declarations()?;
        let procedure = self.procedure()?;
        let mut blocks = BTreeMap::new();
        loop {
            self.begin();
            if *self.peek() == Token::End {
                return Ok((procedure, blocks));
            }
            let heading = self.heading()?;
            if blocks.contains_key(&heading) {
                let message = "a block of this name and qualifier exists already";
                return Err(refuse_form(FaultKind::Declaration, message));
            }
            let statements = self.statements()?;
            blocks.insert(heading, statements);
        }
    }

    /// A statement begins here.
    pub(super) fn begin(&mut self) {
        self.begun = self.tokens[self.at].line;
    }

    pub(super) fn peek(&self) -> &Token {
        &self.tokens[self.at].token
    }

    /// The next part; the end of the program is never passed.
    pub(super) fn take(&mut self) -> Token {
        let token = self.peek().clone();
        if token != Token::End {
            self.at += 1;
        }
        token
    }

    pub(super) fn is_sign(&self, sign: &str) -> bool {
        matches!(self.peek(), Token::Sign(found) if *found == sign)
    }

    pub(super) fn takes(&mut self, sign: &str) -> bool {
        let stands = self.is_sign(sign);
        if stands {
            self.at += 1;
        }
        stands
    }

    pub(super) fn expect(&mut self, sign: &str) -> Result<(), StepError> {
        if self.takes(sign) { Ok(()) } else { Err(self.odd(&format!("`{sign}`"))) }
    }

    /// The word that stands here, if one does.
    pub(super) fn word(&self) -> Option<&str> {
        match self.peek() {
            Token::Word(word) => Some(word),
            Token::Number(_)
            | Token::HeadingWord(_)
            | Token::Text(_)
            | Token::Sign(_)
            | Token::LineFeed
            | Token::Bad(..)
            | Token::End => None,
        }
    }

    /// The refusal of what stands where something else belongs.
    pub(super) fn odd(&mut self, expected: &str) -> StepError {
        let found = match self.peek() {
            Token::Bad(kind, message) => {
                return refuse(rule::gpp::STATEMENT, *kind, message.clone());
            }
            Token::HeadingWord(word) => {
                return refuse(rule::gpp::STATEMENT, FaultKind::BadNumber, no_number(word));
            }
            Token::Word(word) | Token::Number(word) => word.clone(),
            Token::Text(text) => format!("{text:?}"),
            Token::Sign(sign) => (*sign).to_owned(),
            Token::LineFeed => "\\J".to_owned(),
            Token::End => "the end of the program".to_owned(),
        };
        let message = format!("{expected} is expected here, not {found}");
        refuse(rule::gpp::STATEMENT, FaultKind::Statement, message)
    }

    /// Whether this sign comes after the part that stands here.
    pub(super) fn comes_next(&self, sign: &str) -> bool {
        let next = self.tokens.get(self.at + 1);
        next.is_some_and(|placed| matches!(placed.token, Token::Sign(found) if found == sign))
    }

    /// How many parts the words up to a colon take, if they stand here and in one line.
    fn words_up_to_colon(&self, from: usize) -> Option<usize> {
        let line = self.tokens.get(from)?.line;
        let rest = self.tokens[from..].iter().take_while(|placed| placed.line == line);
        let mut words = 0;
        for placed in rest {
            match &placed.token {
                Token::Word(_) | Token::HeadingWord(_) => words += 1,
                Token::Number(number) if !number.contains('.') => words += 1,
                Token::Sign(":") if words > 0 => return Some(words),
                Token::Number(_)
                | Token::Text(_)
                | Token::Sign(_)
                | Token::LineFeed
                | Token::Bad(..)
                | Token::End => return None,
            }
        }
        None
    }

    /// Whether a block begins here.
    pub(super) fn is_heading(&self) -> bool {
        self.tokens[self.at].begins_line && self.words_up_to_colon(self.at).is_some()
    }

    fn heading(&mut self) -> Result<Heading, StepError> {
        if !self.is_heading() {
            return Err(self.odd("the name of a block"));
        }
        let line = self.tokens[self.at].line;
        let name = self.words_before_colon().unwrap_or_default();
        if is_keyword(&name) {
            let message = format!("{name} is not a valid name of a block");
            return Err(refuse_form(FaultKind::Declaration, message));
        }
        let same_line = self.tokens[self.at].line == line;
        let qualifier = if same_line { self.words_before_colon() } else { None };
        Ok(Heading { name, qualifier })
    }

    fn words_before_colon(&mut self) -> Option<String> {
        let count = self.words_up_to_colon(self.at)?;
        let words = self.tokens[self.at..self.at + count].iter();
        let words: Vec<&str> = words
            .filter_map(|placed| match &placed.token {
                Token::Word(word) | Token::HeadingWord(word) | Token::Number(word) => {
                    Some(word.as_str())
                }
                Token::Text(_) | Token::Sign(_) | Token::LineFeed | Token::Bad(..) | Token::End => {
                    None
                }
            })
            .collect();
        let text = words.join(" ");
        self.at += count + 1;
        Some(text)
    }

    /// Goes one deeper among parentheses, brackets and signs.
    pub(super) fn deeper(&mut self) -> Result<(), StepError> {
        self.depth += 1;
        too_deep(self.depth)
    }

    /// The statement nests another one.
    pub(super) fn nest(&mut self) -> Result<(), StepError> {
        self.nesting += 1;
        too_deep(self.nesting)
    }
}

fn too_deep(depth: usize) -> Result<(), StepError> {
    if depth <= DEEPEST {
        return Ok(());
    }
    let message = format!("nothing is nested more than {DEEPEST} deep");
    Err(refuse_form(FaultKind::TooManyLevels, message))
}
