//! Declarations: FORMAT, MODAL, `NON_MODAL`, IDENTICAL.

use alloc::format;
use alloc::string::String;

use gaugeblock_vocabulary::FaultKind;

use super::compile::{Compiler, NO_STATEMENT, Stop, format_named};
use super::lexer::Token;
use super::toolpath::LONGEST_NAME;
use super::words::{self, Keyword};

fn refused(why: &'static str) -> Stop {
    Stop::Refused(FaultKind::Declaration, why)
}

const UNKNOWN: Stop = Stop::Refused(FaultKind::NoSuchVariable, "a variable that is not declared");

impl Compiler<'_> {
    /// A declaration after its keyword.
    pub(super) fn declaration(&mut self, keyword: Keyword) -> Result<(), Stop> {
        if keyword == Keyword::Format {
            self.format()
        } else if keyword == Keyword::Identical {
            self.identical()
        } else {
            self.modality(keyword == Keyword::Modal)
        }
    }

    fn format(&mut self) -> Result<(), Stop> {
        self.expect("(")?;
        let Token::Word(word) = self.take()? else { return Err(NO_STATEMENT) };
        let format = format_named(word).ok_or(NO_STATEMENT)?;
        self.expect(")")?;
        let mut names = 0_usize;
        while !self.takes(";")? {
            let Token::Word(word) = self.take()? else { return Err(NO_STATEMENT) };
            self.formatted(word.to_ascii_uppercase(), format)?;
            names = names.saturating_add(1);
        }
        if names == 0 { Err(NO_STATEMENT) } else { Ok(()) }
    }

    /// A name to which FORMAT gives a format.
    fn formatted(&mut self, name: String, format: usize) -> Result<(), Stop> {
        if words::is_taken(&name) {
            return Err(refused("a word of the language is not a valid name"));
        }
        let known = self.names.get(&name).copied();
        if name.contains('_') {
            let place = known.ok_or(UNKNOWN)?;
            let formatted = self.formatted.get_mut(place).ok_or(UNKNOWN)?;
            if core::mem::replace(formatted, true) {
                return Err(refused("a system variable has a format already"));
            }
            let variable = self.variables.variables.get_mut(place).ok_or(UNKNOWN)?;
            let was_text = variable.is_text();
            variable.format = format;
            if variable.is_text() != was_text {
                let why = "a format of the other type";
                return Err(Stop::Refused(FaultKind::WrongType, why));
            }
            return Ok(());
        }
        if name.len() > LONGEST_NAME {
            return Err(refused("a name of more than 31 characters"));
        }
        if known.is_some() {
            return Err(refused("a variable that is declared already"));
        }
        let size = if self.takes("[")? { Some(self.size()?) } else { None };
        if self.name(name, format, size) {
            Ok(())
        } else {
            let why = "more than 25000 variables";
            Err(Stop::Refused(FaultKind::TooManyVariables, why))
        }
    }

    fn size(&mut self) -> Result<usize, Stop> {
        let Token::Number(digits) = self.take()? else { return Err(NO_STATEMENT) };
        if digits.contains('.') {
            return Err(NO_STATEMENT);
        }
        self.expect("]")?;
        match digits.parse() {
            Ok(0) => Err(refused("an array without a member")),
            Ok(size) => Ok(size),
            // More digits than any size has.
            Err(_) => Ok(usize::MAX),
        }
    }

    fn modality(&mut self, modal: bool) -> Result<(), Stop> {
        let mut names = 0_usize;
        while !self.takes(";")? {
            let place = self.declared_name()?;
            if self.peek()? == Token::Sign("[") {
                return Err(refused("a modality is that of the whole array"));
            }
            if let Some(declared) = self.declared.get_mut(place) {
                *declared = Some(modal);
            }
            names = names.saturating_add(1);
        }
        if names == 0 { Err(NO_STATEMENT) } else { Ok(()) }
    }

    /// The place of a variable that has been declared.
    fn declared_name(&mut self) -> Result<usize, Stop> {
        let Token::Word(word) = self.take()? else { return Err(NO_STATEMENT) };
        self.names.get(&word.to_ascii_uppercase()).copied().ok_or(UNKNOWN)
    }

    fn identical(&mut self) -> Result<(), Stop> {
        let mut first: Option<(usize, bool)> = None;
        let (mut names, mut systems) = (0_usize, [const { String::new() }; 2]);
        while !self.takes(";")? {
            let place = self.declared_name()?;
            let variable = self.variables.variables.get(place).ok_or(UNKNOWN)?;
            if variable.size.is_some() || self.peek()? == Token::Sign("[") {
                return Err(refused("an array or its member is identical to nothing"));
            }
            let (slot, is_text) = (variable.first, variable.is_text());
            if variable.name.contains('_')
                && let Some(empty) = systems.iter_mut().find(|system| system.is_empty())
            {
                empty.push_str(&variable.name);
            }
            match first {
                None => first = Some((slot, is_text)),
                Some((_, other)) if other != is_text => {
                    return Err(refused("identical variables of two types"));
                }
                Some((other, _)) => self.variables.join(other, slot),
            }
            names = names.saturating_add(1);
        }
        let [one, other] = &systems;
        if !other.is_empty() {
            let warning = format!("{one} and {other} are system variables");
            self.program.warnings.push((self.line, warning));
        }
        if names < 2 { Err(NO_STATEMENT) } else { Ok(()) }
    }
}
