//! Reading ahead of what is executed: modes and parameters change, the machine does not.

use alloc::boxed::Box;

use crate::canon::Sink;
use crate::parameters::Numbered;

use super::Modal;
use super::coordinates::Coordinates;
use super::snapshots::MachineSnapshot;

impl Modal {
    /// From here on blocks are only read. The machine stays at this point, in program coordinates.
    #[cold]
    pub(super) fn begin_read_ahead_at(&mut self, point: Coordinates) {
        if self.machine_snapshot.is_some() {
            return;
        }
        self.machine_snapshot = Some(Box::new(MachineSnapshot {
            point: self.active.now().machine_of(point).converted(self.active_to_machine()),
            tool: self.tool,
            prepared: self.prepared,
            selected: self.selected,
            tools: self.tools.clone(),
        }));
    }

    /// Whether blocks are only read. Their settings count even if a later block is refused.
    pub(super) fn reads_ahead(&self) -> bool {
        self.machine_snapshot.is_some()
    }

    /// From here on blocks are only read.
    pub(crate) fn begin_read_ahead(&mut self) {
        self.begin_read_ahead_at(self.reached_point());
    }

    /// Ends reading ahead: position and tools are those of the machine again. Settings that wait for a
    /// compensated move were read: they are reported, and the move is lost.
    pub(crate) fn end_read_ahead<K: Sink>(&mut self, numbered: &mut Numbered, sink: &mut K) {
        let Some(snapshot) = self.machine_snapshot.take() else { return };
        self.report_waiting(sink);
        self.forget_compensated_path();
        let point = snapshot.point.converted(self.machine_to_active());
        self.position = self.active.now().program_of(point);
        self.tool = snapshot.tool;
        self.prepared = snapshot.prepared;
        self.selected = snapshot.selected;
        self.tools = snapshot.tools;
        self.publish_tool(numbered);
    }
}
