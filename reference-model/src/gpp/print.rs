//! OUTPUT and PRINT.

use gaugeblock_vocabulary::Channel;

use super::refusal::StepError;
use super::run::Run;
use super::syntax::{Item, Printer, Reference};
use crate::ids::{choice, rule};

/// A statement that prints, half way.
struct Printing {
    line: u32,
    printer: Printer,
    /// What it has printed since its last step.
    text: String,
    /// The variables that it has printed, with their cells.
    printed: Vec<(usize, usize)>,
}

impl Run<'_> {
    /// Prints items in order; then the modal variables among them go off.
    ///
    /// # Errors
    /// An index leads to no member, or the newline procedure is halted.
    pub(super) fn print(
        &mut self,
        line: u32,
        printer: Printer,
        items: &[Item],
    ) -> Result<(), StepError> {
        let mut printing = Printing { line, printer, text: String::new(), printed: Vec::new() };
        for item in items {
            self.record.spend(1);
            match item {
                Item::Newline => self.newline(&mut printing)?,
                Item::LineFeed => self.put(&mut printing, "\n")?,
                Item::Text(text) => self.put(&mut printing, text)?,
                Item::Variable(reference) => self.put_variable(&mut printing, reference)?,
            }
        }
        self.say(&mut printing);
        for (variable, cell) in printing.printed {
            self.goes_off(variable, cell, printing.printer);
        }
        self.end_step(line)
    }

    fn say(&mut self, printing: &mut Printing) {
        if !printing.text.is_empty() {
            self.record.say(Channel::Output, std::mem::take(&mut printing.text));
        }
    }

    /// Rule gpp.newline-symbol. The symbol runs its procedure: at each occurrence, or, in the old GPP, when something
    /// is printed after it.
    fn newline(&mut self, printing: &mut Printing) -> Result<(), StepError> {
        self.coverage.accepted(rule::gpp::NEWLINE_SYMBOL);
        if self.program.procedure.is_empty() {
            return Ok(());
        }
        if self.choices.is(choice::gpp::Newline::Lazy) {
            self.newline_waits = true;
            return Ok(());
        }
        self.run_procedure(printing)
    }

    /// The procedure runs in the middle of a statement, which is a step up to here and another one from here on.
    fn run_procedure(&mut self, printing: &mut Printing) -> Result<(), StepError> {
        self.say(printing);
        self.end_step(printing.line)?;
        self.procedure()?;
        self.begin_step(printing.line)
    }

    fn put(&mut self, printing: &mut Printing, text: &str) -> Result<(), StepError> {
        if self.newline_waits && !text.is_empty() {
            self.newline_waits = false;
            self.run_procedure(printing)?;
        }
        printing.text.push_str(text);
        Ok(())
    }

    /// Rules gpp.off-printed and gpp.off-modal. A variable is printed whether it is on or off. In the old GPP a modal
    /// variable that is off is left out.
    fn put_variable(
        &mut self,
        printing: &mut Printing,
        reference: &Reference,
    ) -> Result<(), StepError> {
        let variable = reference.variable;
        let cell = self.cell(reference)?;
        let is_modal = self.variables.all[variable].modal;
        if is_modal {
            self.coverage.accepted(rule::gpp::OFF_MODAL);
        }
        if !self.variables.cells[cell].on {
            if is_modal && self.choices.is(choice::gpp::OffModal::LeftOut) {
                return Ok(());
            }
            self.coverage.accepted(rule::gpp::OFF_PRINTED);
        }
        let Some(value) = &self.variables.cells[cell].value else {
            let name = self.variables.shown_name(variable, cell);
            self.record.say(Channel::Display, format!("warning: {name} has no value"));
            return Ok(());
        };
        let text = self.variables.text(variable, value, self.choices.get::<choice::gpp::Tie>());
        let text = text.expect("status: what is assigned has a text");
        self.coverage.accepted(rule::gpp::NUMBER_FORMAT);
        printing.printed.push((variable, cell));
        self.put(printing, &text)
    }

    /// Rules gpp.output-turns-off, gpp.print-turns-off, gpp.non-modal-stays, gpp.modal-members and
    /// gpp.identical-printed. A modal variable that has been printed goes off, with all that are identical to it; one
    /// that is not modal stays as it is. In the old GPP members of modal arrays stay on.
    fn goes_off(&mut self, variable: usize, cell: usize, printer: Printer) {
        let declared = &self.variables.all[variable];
        let (is_modal, is_member) = (declared.modal, declared.size.is_some());
        if !is_modal {
            self.coverage.accepted(rule::gpp::NON_MODAL_STAYS);
            return;
        }
        if is_member {
            self.coverage.accepted(rule::gpp::MODAL_MEMBERS);
            if self.choices.is(choice::gpp::ArrayMembers::StayOn) {
                return;
            }
        }
        self.coverage.accepted(match printer {
            Printer::Output => rule::gpp::OUTPUT_TURNS_OFF,
            Printer::Print => rule::gpp::PRINT_TURNS_OFF,
        });
        if self.variables.is_shared(cell) {
            self.coverage.accepted(rule::gpp::IDENTICAL_PRINTED);
        }
        self.turn(variable, cell, false);
    }
}
