//! The declaration part: FORMAT, MODAL, IDENTICAL, and the procedure of the newline symbol.

use gaugeblock_vocabulary::FaultKind;

use super::is_keyword;
use super::reader::Reader;
use crate::gpp::formats::{CHARACTER, NAMES};
use crate::gpp::refusal::{StepError, refuse};
use crate::gpp::syntax::Statement;
use crate::gpp::text::Token;
use crate::gpp::variables::{MOST_VARIABLES, is_user_name};
use crate::ids::{choice, rule};

/// The signs that `NEW_LINE_IS` can name.
const SYMBOLS: &[&str] = &["!", "#", "$", "%", "&", "@", "?", "^", "~"];

impl Reader<'_> {
    pub(super) fn declarations(&mut self) -> Result<(), StepError> {
        loop {
            self.begin();
            if self.is_heading() {
                break;
            }
            match self.word() {
                Some("FORMAT") => self.format()?,
                Some("MODAL") => self.modality(true)?,
                Some("NON_MODAL") => self.non_modal()?,
                Some("IDENTICAL") => self.identical()?,
                _ => break,
            }
        }
        for variable in &self.variables.all {
            if self.choices.is(choice::gpp::DefaultModality::ByFormat) {
                self.coverage.accepted(rule::gpp::FORMAT_MODALITY);
            } else if !variable.modal {
                self.coverage.accepted(rule::gpp::DEFAULT_NON_MODAL);
            }
            self.coverage.accepted(rule::gpp::MODALITY);
        }
        Ok(())
    }

    /// Rule gpp.declaration. FORMAT declares user variables, and gives a system variable another format.
    fn format(&mut self) -> Result<(), StepError> {
        self.take();
        self.expect("(")?;
        let format = self.word().and_then(|word| NAMES.iter().position(|name| *name == word));
        let Some(format) = format else { return Err(self.odd("the name of a format")) };
        self.take();
        self.expect(")")?;
        loop {
            self.declared_name(format)?;
            if self.takes(";") {
                self.coverage.accepted(rule::gpp::DECLARATION);
                return Ok(());
            }
        }
    }

    fn declared_name(&mut self, format: usize) -> Result<(), StepError> {
        let Some(name) = self.word().map(str::to_owned) else { return Err(self.odd("a name")) };
        self.take();
        if let Some(place) = self.variables.place(&name) {
            return self.another_format(place, format);
        }
        if name.contains('_') && !is_keyword(&name) {
            let message = format!("the toolpath declares no system variable {name}");
            return Err(refuse(rule::gpp::DECLARATION, FaultKind::NoSuchVariable, message));
        }
        if is_keyword(&name) || !is_user_name(&name) {
            return Err(refused(format!("{name} is not a valid name of a user variable")));
        }
        let size = if self.takes("[") { Some(self.size()?) } else { None };
        self.variables.declare(&name, size, format, None, &self.choices)
    }

    /// The number of members; one that no variable can have is too large, however it is written.
    fn size(&mut self) -> Result<u32, StepError> {
        let Token::Number(number) = self.peek() else { return Err(self.odd("a size")) };
        let number = number.clone();
        if number.contains('.') {
            return Err(self.odd("a whole number"));
        }
        self.take();
        self.expect("]")?;
        let most = u32::try_from(MOST_VARIABLES).unwrap_or(u32::MAX);
        match number.parse::<u32>() {
            Ok(0) => Err(refused("an array has one member at least")),
            Ok(size) => Ok(size),
            Err(_) => Ok(most + 1),
        }
    }

    fn another_format(&mut self, place: usize, format: usize) -> Result<(), StepError> {
        let by_format = self.choices.is(choice::gpp::DefaultModality::ByFormat);
        let is_modal = self.variables.formats[format].modal;
        let variable = &mut self.variables.all[place];
        if variable.is_declared {
            return Err(refused(format!("{} has been declared", variable.name)));
        }
        if (variable.format == CHARACTER) != (format == CHARACTER) {
            let message = format!("{} is of the other type", variable.name);
            return Err(refuse(rule::gpp::DECLARATION, FaultKind::WrongType, message));
        }
        variable.is_declared = true;
        variable.format = format;
        if by_format && !variable.modality_is_declared {
            variable.modal = is_modal;
        }
        Ok(())
    }

    /// The place of a variable whose name stands here alone.
    fn named(&mut self) -> Result<usize, StepError> {
        let Some(name) = self.word().map(str::to_owned) else { return Err(self.odd("a name")) };
        let place = self.variables.place(&name);
        self.take();
        place.ok_or_else(|| no_such(&name))
    }

    /// Rules gpp.modal-declaration and gpp.array-modality. MODAL makes variables modal; an array whole, and no member
    /// alone.
    fn modality(&mut self, modal: bool) -> Result<(), StepError> {
        self.take();
        loop {
            let place = self.named()?;
            if self.is_sign("[") {
                let message = "all members of an array have one modality";
                return Err(refuse(rule::gpp::ARRAY_MODALITY, FaultKind::Declaration, message));
            }
            let variable = &mut self.variables.all[place];
            (variable.modal, variable.modality_is_declared) = (modal, true);
            self.coverage.accepted(rule::gpp::MODAL_DECLARATION);
            if self.variables.all[place].size.is_some() {
                self.coverage.accepted(rule::gpp::ARRAY_MODALITY);
            }
            if self.takes(";") {
                return Ok(());
            }
        }
    }

    fn non_modal(&mut self) -> Result<(), StepError> {
        self.old_word("NON_MODAL")?;
        self.modality(false)
    }

    /// Rule gpp.old-words. What only the old GPP understands.
    pub(super) fn old_word(&mut self, word: &str) -> Result<(), StepError> {
        if self.choices.is(choice::gpp::OldWords::Accepted) {
            self.coverage.accepted(rule::gpp::OLD_WORDS);
            return Ok(());
        }
        let message = format!("{word} belongs to the old GPP");
        Err(refuse(rule::gpp::OLD_WORDS, FaultKind::Statement, message))
    }

    /// Rule gpp.identical. Identical variables have one type and are no arrays; two system variables are warned of.
    fn identical(&mut self) -> Result<(), StepError> {
        self.take();
        let first = self.named_alone()?;
        let mut all = vec![first];
        while !self.takes(";") {
            all.push(self.named_alone()?);
        }
        if all.len() < 2 {
            let message = "variables are identical to others";
            return Err(refuse(rule::gpp::STATEMENT, FaultKind::Statement, message));
        }
        if all.iter().any(|place| self.variables.is_text(*place) != self.variables.is_text(first)) {
            let message = "identical variables are of one type";
            return Err(refuse(rule::gpp::IDENTICAL, FaultKind::Declaration, message));
        }
        let is_system = |place: &&usize| self.variables.all[**place].class.is_some();
        let system: Vec<&str> = all
            .iter()
            .filter(is_system)
            .map(|place| self.variables.all[*place].name.as_str())
            .collect();
        if let [one, other, ..] = system[..] {
            let message = format!("warning: {one} and {other} are system variables");
            self.warnings.push((self.begun, message));
        }
        for place in &all[1..] {
            self.variables.join(first, *place);
        }
        Ok(())
    }

    fn named_alone(&mut self) -> Result<usize, StepError> {
        let place = self.named()?;
        if self.variables.all[place].size.is_some() {
            let message = "no array is identical to anything";
            return Err(refuse(rule::gpp::IDENTICAL, FaultKind::Declaration, message));
        }
        Ok(place)
    }

    /// Rule gpp.newline-symbol. `NEW_LINE_IS` names a symbol; the statements up to the first block are its procedure.
    pub(super) fn procedure(&mut self) -> Result<Vec<Statement>, StepError> {
        self.begin();
        if self.is_heading() || self.word() != Some("NEW_LINE_IS") {
            return Ok(Vec::new());
        }
        self.take();
        let Token::Sign(symbol) = *self.peek() else { return Err(self.odd("a symbol")) };
        if !SYMBOLS.contains(&symbol) {
            return Err(self.odd("a symbol"));
        }
        self.take();
        self.expect(";")?;
        self.symbol = Some(symbol);
        self.in_procedure = true;
        let statements = self.statements();
        self.in_procedure = false;
        statements
    }

    /// Rule gpp.modal-declaration. Variables are declared in the declaration part alone.
    pub(super) fn late_declaration(&self, word: &str) -> StepError {
        let rule =
            if word == "MODAL" { rule::gpp::MODAL_DECLARATION } else { rule::gpp::DECLARATION };
        refuse(
            rule,
            FaultKind::Declaration,
            "declarations come before the newline procedure and the blocks",
        )
    }
}

fn refused(message: impl Into<String>) -> StepError {
    refuse(rule::gpp::DECLARATION, FaultKind::Declaration, message)
}

/// A name that is not declared.
pub(super) fn no_such(name: &str) -> StepError {
    refuse(rule::gpp::DECLARATION, FaultKind::NoSuchVariable, format!("{name} is not declared"))
}
