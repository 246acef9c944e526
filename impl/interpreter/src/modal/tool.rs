//! Tools: T, M6, M61 (11.6.6, 11.6.14, 11.8.3) and tool length offsets (11.5.28 to 11.5.31).

use gaugeblock_vocabulary::{ControllerMode, Effect, FaultKind, SpindleTurn, Switch, Tool};

use crate::canon::{Reply, Sink};
use crate::faults::{PlantedFault, narrowed, planted};
use crate::parameters::Numbered;
use crate::quirks;
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::coordinates::{Conversion, Coordinates};
use super::modes::FIRST;
use super::offsets;
use super::refusal::{Refusal, refuse};
use super::state::NO_TOOL;
use super::values::{integer, integer_in};

/// The number of a tool; one that is too large for an effect is none that a program can name.
pub(crate) fn number_of(tool: &Tool) -> i32 {
    i32::try_from(tool.number).unwrap_or(i32::MAX)
}

/// The pocket of a tool; its number where the table gives none.
fn pocket_of(tool: &Tool) -> i32 {
    i32::try_from(tool.pocket.unwrap_or(tool.number)).unwrap_or(i32::MAX)
}

impl Modal {
    fn tool_numbered(&self, number: i32) -> Option<&Tool> {
        self.tools.iter().find(|tool| number_of(tool) == number)
    }

    /// The tool in the spindle, when the tool table holds it. 11.5.28: number 0 is none, except where tools change
    /// places.
    fn loaded(&self) -> Option<&Tool> {
        let none = self.tool == 0 && !self.random_tool_changer;
        self.tool_numbered(self.tool).filter(|_| !none)
    }

    /// T: which tool the next change puts into the spindle.
    pub(super) fn prepare_tool<K: Sink>(
        &mut self,
        word: f64,
        line: u32,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let word = narrowed(PlantedFault::ToolWraps, word, 256.0);
        let number = integer_in(word, 0, i32::MAX, "T")?;
        let found = if self.choices.tool_by_slot {
            self.tools.iter().find(|tool| pocket_of(tool) == number)
        } else {
            self.tool_numbered(number)
        };
        // T0 is no tool, except where tools change places: there it is a number like any other (11.8.3).
        let tool = match found {
            _ if number == 0 && !self.random_tool_changer => NO_TOOL,
            // 11.5.28: number 0 of the table is no tool there, so that its slot is empty.
            Some(tool) if number_of(tool) != 0 || self.random_tool_changer => number_of(tool),
            _ if self.choices.tool_must_exist => {
                return refuse(
                    FaultKind::ToolNotFound,
                    "the tool table does not hold the tool of T",
                );
            }
            _ => NO_TOOL,
        };
        self.prepared = Some(tool);
        self.selected = Some(tool);
        self.perform(line, &Effect::PrepareTool { tool: tool.max(0) }, sink)
    }

    /// M6: the tool that T selected comes into the spindle.
    pub(super) fn change_tool<K: Sink>(
        &mut self,
        line: u32,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if self.choices.change_uncompensated {
            self.refuse_under_compensation("M6")?;
        }
        self.check_without_path("M6")?;
        let tool = match self.prepared {
            Some(tool) => tool.max(0),
            None if self.choices.change_unselected => self.tool,
            None => return refuse(FaultKind::MissingWord, "M6 without a T since the last change"),
        };
        let same = tool == self.tool && planted(PlantedFault::SameToolTurns);
        if !self.tool_change.with_spindle_on && !planted(PlantedFault::SpindleTurnsOn) && !same {
            let first = self.choices.change_stops_first;
            let which = if first { FIRST } else { self.all_spindles() };
            self.for_spindles(which, |spindle| spindle.turn = SpindleTurn::Stopped);
        }
        if planted(PlantedFault::ChangeStopsFlood) {
            self.active.put(|modes| &mut modes.flood, Switch::Off);
        }
        self.move_to_change(line, numbered, sink)?;
        let reply = self.perform_with_reply(line, &Effect::ChangeTool { tool }, sink)?;
        self.exchange_pockets(tool);
        self.tool = if let Reply::Tool(tool) = reply { tool } else { tool };
        self.loaded_by_change = self.tool;
        if self.tool == 0 && planted(PlantedFault::UnloadCancelsLength) {
            let none = (Switch::Off, Coordinates::default());
            self.offset_by(|modes| (modes.tool_length, modes.tool_offset) = none);
        }
        if !planted(PlantedFault::StaysSelected) {
            self.prepared = None;
        }
        self.publish_tool(numbered);
        Ok(())
    }

    /// The moves that a machine is set up to make before a change.
    fn move_to_change<K: Sink>(
        &mut self,
        line: u32,
        numbered: &Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if self.tool_change.quill_up {
            let [x, y, _, a, b, c, u, v, w] = self.active.now().machine_of(self.position).0;
            let up = Coordinates([x, y, 0.0, a, b, c, u, v, w]);
            self.traverse_to(line, self.active.now().program_of(up), sink)?;
        }
        if self.tool_change.at_g30 {
            let stored = offsets::row(numbered, offsets::G30_POSITION);
            // An axis that the machine has not stands at zero, whatever is stored of it.
            let place = Coordinates::default().taking(self.axes, stored);
            let place = place.converted(self.stored_to_active());
            self.traverse_to(line, self.active.now().program_of(place), sink)?;
        }
        Ok(())
    }

    /// Where tools change places, the new tool's pocket takes the old tool; pocket 0 is the spindle.
    fn exchange_pockets(&mut self, new: i32) {
        let old = self.tool;
        if !self.random_tool_changer || !self.choices.old_tool_to_new_slot || old == new {
            return;
        }
        let freed = self.tool_numbered(new).map(|tool| tool.pocket.unwrap_or(tool.number));
        for place in 0..self.tools.len() {
            let number = self.tools.get(place).map(number_of);
            if number == Some(new) {
                self.change_tool_entry(place, |tool| tool.pocket = Some(0));
            } else if number == Some(old) && freed.is_some() {
                self.change_tool_entry(place, |tool| tool.pocket = freed);
            }
        }
    }

    /// M61: says which tool is in the spindle.
    pub(super) fn set_tool<K: Sink>(
        &mut self,
        block: &Block<'_>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if self.choices.no_set_in_program && self.controller_mode == ControllerMode::Auto {
            return refuse(FaultKind::ControllerMode, "M61 belongs to MDI and manual mode");
        }
        self.check_without_path("M61")?;
        let tool = integer_in(block.words.get(b'Q').unwrap_or(0.0), 0, i32::MAX, "Q of M61")?;
        // 9.6.17.13: zero unloads the tool, whatever the changer.
        let none = tool == 0;
        let any = self.choices.set_any_tool || planted(PlantedFault::SetUnknown);
        if !none && !any && self.tool_numbered(tool).is_none() {
            return refuse(FaultKind::ToolNotFound, "the tool table does not hold the tool of M61");
        }
        self.perform(block.words.line, &Effect::SetToolNumber { tool }, sink)?;
        self.tool = tool;
        if planted(PlantedFault::SetForgetsSelection) {
            self.prepared = None;
        }
        let applies = self.active.now().tool_length == Switch::On;
        if applies && planted(PlantedFault::SetNumberLength) {
            let offset = self.table_offset(None)?;
            self.offset_by(|modes| modes.tool_offset = offset);
        }
        self.publish_tool(numbered);
        Ok(())
    }

    /// Writes the tool in the spindle into its parameters.
    pub(super) fn publish_tool(&self, numbered: &mut Numbered) {
        let none = Tool::default();
        offsets::store_tool(numbered, self.tool, self.loaded().unwrap_or(&none));
    }

    /// G43, G43.1, G43.2, G49. They move nothing: the point gets other coordinates.
    pub(super) fn tool_length(&mut self, words: &Words, code: u16) -> Result<(), Refusal> {
        if self.choices.length_uncompensated {
            self.refuse_under_compensation("a tool length offset")?;
        }
        self.check_without_path("another tool length")?;
        let old = self.active.now().tool_offset;
        let offset = match code {
            490 => Coordinates::default(),
            430 if self.choices.length_zero_is_none => self.indexed_offset(words.get(b'H'))?,
            430 => self.table_offset(words.get(b'H'))?,
            431 if planted(PlantedFault::DynamicClearsOthers) => {
                Coordinates::default().replaced(&self.offset_words(words))
            }
            431 => old.replaced(&self.offset_words(words)),
            _ => match words.get(b'H') {
                Some(tool) => old.plus(self.table_offset(Some(tool))?),
                None => old.moved_by(&self.offset_words(words)),
            },
        };
        let switch = if code == 490 { Switch::Off } else { Switch::On };
        self.offset_by(|modes| (modes.tool_length, modes.tool_offset) = (switch, offset));
        Ok(())
    }

    /// The offset of the tool table that H names; H is required, and H0 is an offset of zero.
    fn indexed_offset(&self, h: Option<f64>) -> Result<Coordinates, Refusal> {
        let Some(number) = h else {
            return refuse(FaultKind::MissingWord, "G43 without H");
        };
        if integer(number, "H")? == 0 {
            return Ok(Coordinates::default());
        }
        self.table_offset(h)
    }

    /// The offset of the tool table that H names, of the tool in the spindle without H.
    fn table_offset(&self, h: Option<f64>) -> Result<Coordinates, Refusal> {
        let selected =
            self.prepared.filter(|tool| *tool > 0 && planted(PlantedFault::LengthOfSelected));
        let tool = self.named_tool(h.or(selected.map(f64::from)), "H")?;
        Ok(tool.map_or(Coordinates::default(), |tool| {
            let offset = Coordinates::from(tool.offset);
            if planted(PlantedFault::OffsetUnit) {
                return offset;
            }
            offset.converted(self.table_to_active())
        }))
    }

    /// From lengths of the tool table to the active unit.
    pub(super) fn table_to_active(&self) -> Conversion {
        let conversion = self.stored_to_active();
        if self.emulates_rs274 { conversion.scaled(quirks::TABLE_SCALE) } else { conversion }
    }

    /// The tool of an H or D word. Zero is the tool in the spindle, except where tools change places; nothing in the
    /// spindle means no tool.
    pub(super) fn named_tool(
        &self,
        word: Option<f64>,
        letter: &str,
    ) -> Result<Option<&Tool>, Refusal> {
        let number = match word {
            Some(word) => integer(narrowed(PlantedFault::LengthWraps, word, 256.0), letter)?,
            None => self.tool,
        };
        if number < 0 {
            return refuse(FaultKind::WordOutOfRange, alloc::format!("{letter} is negative"));
        }
        if number == 0 && !self.random_tool_changer {
            return Ok(self.loaded());
        }
        if self.choices.offsets_by_slot && word.is_some() && !self.random_tool_changer {
            // An empty slot has no tool.
            let number_is_tool = |tool: &&Tool| pocket_of(tool) == number && number_of(tool) != 0;
            return Ok(self.tools.iter().find(number_is_tool));
        }
        match self.tool_numbered(number) {
            Some(tool) => Ok(Some(tool)),
            None if word.is_none() => Ok(None),
            None => refuse(FaultKind::ToolNotFound, "the tool table does not hold the tool"),
        }
    }

    /// The index of a tool in the tooldata: its place in the table from 1, or its pocket where tools change places.
    pub(super) fn tool_index(&self, number: i32) -> i32 {
        let place = self.tools.iter().position(|tool| number_of(tool) == number);
        match place {
            Some(place) if self.random_tool_changer => self.tools.get(place).map_or(0, pocket_of),
            Some(place) if number != 0 => i32::try_from(place).map_or(0, |at| at.saturating_add(1)),
            Some(_) | None => 0,
        }
    }
}
