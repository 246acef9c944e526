//! OUTPUT and PRINT, and the newline procedure in between.

use alloc::format;

use gaugeblock_vocabulary::{Channel, Effect};

use super::evaluate::StatementError;
use super::program::{IndexRange, Item, VariableRef};
use super::run::report_warning;
use super::runner::{Printing, Runner};
use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};

impl Runner {
    /// An OUTPUT or PRINT up to its end or to the newline procedure; whether it is done. One within the procedure has
    /// no symbol, and the one around it waits.
    pub(super) fn print<S: Sink>(
        &mut self,
        (line, at): (u32, usize),
        (items, is_output): (IndexRange, bool),
        sink: &mut S,
    ) -> Result<bool, StatementError> {
        let within = self.printing.waits;
        let room = if within { &mut self.within } else { &mut self.printing };
        let mut printing = core::mem::take(room);
        printing.line = line;
        printing.at = at;
        printing.is_output = is_output;
        printing.has_run = false;
        printing.items = items;
        printing.goes_off.clear();
        printing.carried.clear();
        let done = self.go_on(&mut printing, sink);
        if within {
            self.within = printing;
        } else {
            self.printing = printing;
        }
        done
    }

    /// The rest of an OUTPUT after the newline procedure, up to the next one; whether it is done.
    pub(super) fn print_rest<S: Sink>(&mut self, sink: &mut S) -> Result<bool, StatementError> {
        let mut printing = core::mem::take(&mut self.printing);
        let done = self.go_on(&mut printing, sink);
        self.printing = printing;
        done
    }

    fn go_on<S: Sink>(
        &mut self,
        printing: &mut Printing,
        sink: &mut S,
    ) -> Result<bool, StatementError> {
        let done = self.items(printing, sink)?;
        printing.waits = !done;
        if !self.text.is_empty() {
            let text = core::mem::take(&mut self.text);
            let message = Effect::Message { channel: Channel::Output, text };
            let _reply = sink.perform(printing.line, &message);
            if let Effect::Message { text, .. } = message {
                self.text = text;
            }
        }
        if done {
            for slot in &printing.goes_off {
                self.variables.switch(*slot, false);
            }
        }
        Ok(done)
    }

    fn items<S: Sink>(
        &mut self,
        printing: &mut Printing,
        sink: &mut S,
    ) -> Result<bool, StatementError> {
        self.text.clear();
        self.text.push_str(&printing.carried);
        printing.carried.clear();
        while printing.items.from < printing.items.to {
            let item = self.program.items.get(printing.items.from).copied();
            printing.items.from = printing.items.from.saturating_add(1);
            self.printed = self.printed.saturating_add(1);
            let piece = match item {
                None => "",
                // A procedure without statements divides nothing.
                Some(Item::Symbol) if self.procedure_is_empty => "",
                Some(Item::Symbol) if self.choices.newline_lazy => {
                    self.newline_waits = true;
                    ""
                }
                Some(Item::Symbol) if planted(PlantedFault::NewlineOnce) && printing.has_run => "",
                Some(Item::Symbol) => {
                    printing.has_run = true;
                    return Ok(false);
                }
                Some(Item::LineFeed) => "\n",
                Some(Item::Text(place)) => {
                    self.program.texts.get(place).map_or("", |text| text.as_str())
                }
                Some(Item::Variable(place)) => match self.printed_slot(place, printing, sink)? {
                    Some(slot) => {
                        self.variables.slots.get(slot).map_or("", |slot| slot.text.as_str())
                    }
                    None => "",
                },
            };
            if piece.is_empty() {
                continue;
            }
            if self.newline_waits {
                self.newline_waits = false;
                printing.carried.push_str(piece);
                return Ok(false);
            }
            self.text.push_str(piece);
        }
        Ok(true)
    }

    /// The slot of a variable that is printed; none where it is left out or has no value.
    fn printed_slot<S: Sink>(
        &mut self,
        place: VariableRef,
        printing: &mut Printing,
        sink: &mut S,
    ) -> Result<Option<usize>, StatementError> {
        let mut stack = core::mem::take(&mut self.stack);
        let slot = self.evaluator().slot(place, &mut stack);
        self.stack = stack;
        let slot = slot?;
        let Some(variable) = self.variables.variable_of(slot) else { return Ok(None) };
        let modal = variable.modal;
        let left_out = self.choices.off_left_out || planted(PlantedFault::OffLeftOut);
        if left_out && modal && !self.variables.is_on(slot) {
            return Ok(None);
        }
        if !self.variables.has_value(slot) {
            let name = self.variables.name_of(slot);
            report_warning(sink, printing.line, format!("warning: {name} has no value"));
            return Ok(None);
        }
        let stays = self.choices.members_stay || planted(PlantedFault::MemberStays);
        let stays = stays && variable.size.is_some();
        let stays = stays || planted(PlantedFault::PrintKeeps) && !printing.is_output;
        if (modal || planted(PlantedFault::NonModalOff)) && !stays {
            printing.goes_off.push(slot);
        }
        Ok(Some(slot))
    }
}
