//! Rolls back what a block changed before it was refused. The exception is a block whose probe finds nothing: it stays
//! executed up to the probe.
//!
//! What the sink received is not taken back: a sink that records keeps the effects of a block until it ends.

use gaugeblock_vocabulary::Tool;

use crate::parameters::Numbered;

use super::Modal;
use super::snapshots::BlockSnapshot;

impl Modal {
    /// Begins a block that can be rolled back.
    pub(super) fn snapshot_block(&mut self, numbered: &mut Numbered) -> BlockSnapshot {
        numbered.begin_notes();
        self.active.begin_notes();
        self.changed_tools.clear();
        self.saved.begin_notes();
        self.compensation.begin_notes();
        BlockSnapshot {
            motion: self.motion,
            position: self.position,
            series: self.series,
            cutter: self.cutter,
            surface_speed: self.surface_speed,
            feed_spindle: self.feed_spindle,
            tool: self.tool,
            prepared: self.prepared,
            selected: self.selected,
            controller_mode: self.controller_mode,
        }
    }

    /// Changes a tool of the table, which a refusal rolls back.
    pub(super) fn change_tool_entry(&mut self, place: usize, change: impl FnOnce(&mut Tool)) {
        if let Some(tool) = self.tools.get_mut(place) {
            self.changed_tools.push((place, tool.clone()));
            change(tool);
        }
    }

    /// Rolls back what the block did to the state.
    #[cold]
    pub(super) fn roll_back(&mut self, before: &BlockSnapshot, numbered: &mut Numbered) {
        numbered.roll_back();
        self.saved.roll_back();
        while let Some((place, before)) = self.changed_tools.pop() {
            if let Some(tool) = self.tools.get_mut(place) {
                *tool = before;
            }
        }
        self.active.roll_back();
        self.motion = before.motion;
        self.position = before.position;
        self.series = before.series;
        self.cutter = before.cutter;
        self.surface_speed = before.surface_speed;
        self.feed_spindle = before.feed_spindle;
        self.tool = before.tool;
        self.prepared = before.prepared;
        self.selected = before.selected;
        self.controller_mode = before.controller_mode;
        self.compensation.roll_back();
        self.lose_waiting();
        self.note_compensation();
    }
}
