//! Writing into the tool table: G10 L1, L10, L11 (11.5.13, 11.5.15, 11.5.16), and reading it again: G10 L0 (11.5.12).

use gaugeblock_vocabulary::{Effect, FaultKind, Switch, Tool};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::parameters::Numbered;
use crate::words::Words;

use super::Modal;
use super::coordinates::Coordinates;
use super::letters::{AXES, I, J, Q, R};
use super::modes::Modes;
use super::offsets;
use super::refusal::{Refusal, refuse};
use super::tool::number_of;
use super::values::{integer, integer_in};

/// The coordinate system of L11, G59.3.
const FIXTURE: u32 = 9;

impl Modal {
    /// Whether G10 is L0, which does not use axis words (11.5.12); rs274 accepts them.
    pub(super) fn refuses_axes_of_reload(&self, words: &Words) -> bool {
        !self.emulates_rs274 && words.get(b'L').and_then(math::near_integer) == Some(0)
    }

    /// G10 L0. What a program writes is in the table at once, so that it reads what is there.
    pub(super) fn reload_tools(&self, numbered: &mut Numbered) -> Result<(), Refusal> {
        if self.tool != 0 {
            return refuse(FaultKind::ModalConflict, "G10 L0 with a tool in the spindle");
        }
        self.publish_tool(numbered);
        Ok(())
    }

    /// G10 L1, L10, L11. An offset that applies stays in force until the next G43.
    pub(super) fn set_tool_entry<K: Sink>(
        &mut self,
        words: &Words,
        kind: i32,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.refuse_under_compensation("setting the tool table")?;
        if self.choices.entry_needs_words && words.present & (AXES | R | I | J | Q) == 0 {
            return refuse(FaultKind::MissingWord, "nothing to set in the tool table");
        }
        let number = integer(words.get(b'P').unwrap_or(0.0), "P of G10")?;
        if number == 0 {
            return refuse(FaultKind::WordOutOfRange, "P of G10 L1, L10 and L11 is not 0");
        }
        let place = self.tools.iter().position(|tool| number_of(tool) == number);
        let Some((place, old)) = place.and_then(|place| Some((place, self.tools.get(place)?)))
        else {
            return refuse(FaultKind::ToolNotFound, "the tool table does not hold the tool of P");
        };
        let tool = self.new_entry(old, words, kind, numbered)?;
        let conversion = self.table_to_active();
        let effect = Effect::SetToolEntry {
            tool: number,
            offset: Coordinates::from(tool.offset).converted(conversion).position(),
            diameter: conversion.of(tool.diameter),
            front_angle: tool.front_angle,
            back_angle: tool.back_angle,
            orientation: i32::from(tool.orientation),
        };
        self.perform(words.line, &effect, sink)?;
        let offset = Coordinates::from(tool.offset).converted(conversion);
        self.change_tool_entry(place, |entry| *entry = tool);
        let applies = kind == 10 && number == self.tool && planted(PlantedFault::MeasuredAtOnce);
        if applies && self.active.now().tool_length == Switch::On {
            self.offset_by(|modes| modes.tool_offset = offset);
        }
        if number == self.tool {
            self.publish_tool(numbered);
        }
        Ok(())
    }

    /// The entry with the values of the words; what has no word stays.
    fn new_entry(
        &self,
        old: &Tool,
        words: &Words,
        kind: i32,
        numbered: &Numbered,
    ) -> Result<Tool, Refusal> {
        let mut tool = old.clone();
        let to_stored = self.table_to_active().inverse();
        let written = self.offset_words(words);
        let letters = words.present & AXES;
        let table = Coordinates::from(old.offset);
        let offset = if kind == 1 {
            table.taking(letters, Coordinates::default().replaced(&written).converted(to_stored))
        } else {
            let frame = self.measuring_frame(kind, table, numbered);
            let machine = self.active.now().machine_of(self.position);
            // Axes that have no word keep the coordinates that they would have with the old entry.
            let target = frame.program_of(machine).replaced(&written);
            let untooled = Modes { tool_offset: Coordinates::default(), ..frame };
            let offset = machine.minus(untooled.machine_of(target)).converted(to_stored);
            table.taking(frame.letters_moved_together(letters), offset)
        };
        tool.offset = offset.position();
        if let Some(radius) = words.get(b'R') {
            let halves = kind != 1 && planted(PlantedFault::MeasuredRadius);
            tool.diameter = to_stored.of(if halves { radius } else { 2.0 * radius });
        }
        tool.front_angle = words.get(b'I').unwrap_or(tool.front_angle);
        tool.back_angle = words.get(b'J').unwrap_or(tool.back_angle);
        if let Some(orientation) = words.get(b'Q') {
            let orientation = integer_in(orientation, 0, 9, "Q of G10")?;
            tool.orientation = u8::try_from(orientation).unwrap_or(0);
        }
        Ok(tool)
    }

    /// The offsets under which L10 and L11 measure, with the entry as it is: those in force, or those of G59.3
    /// without that of G92.
    fn measuring_frame(&self, kind: i32, table: Coordinates, numbered: &Numbered) -> Modes {
        let conversion = self.stored_to_active();
        let tool_offset = table.converted(self.table_to_active());
        let now = Modes { tool_offset, ..*self.active.now() };
        if kind == 10 {
            return now;
        }
        let local = if planted(PlantedFault::FixtureKeepsLocal) {
            now.g92_offset
        } else {
            Coordinates::default()
        };
        let origin = offsets::origin(numbered, FIXTURE).converted(conversion);
        let (_, rotation) = self.applying(origin, offsets::rotation(numbered, FIXTURE));
        Modes { g5x_offset: origin, rotation, g92_offset: local, ..now }
    }
}
