//! Reading ahead of what is executed: modes and parameters change, the machine does not.

use alloc::boxed::Box;

use crate::parameters::Numbered;

use super::Modal;
use super::coordinates::Coordinates;
use super::snapshots::Stands;

impl Modal {
    /// From here on nothing is executed; the point stands here, program coordinates.
    #[cold]
    pub(super) fn read_ahead_from(&mut self, point: Coordinates) {
        if self.stands.is_some() {
            return;
        }
        self.stands = Some(Box::new(Stands {
            point: self.in_force.now().machine_of(point).converted(self.active_to_stored()),
            tool: self.tool,
            prepared: self.prepared,
            selected: self.selected,
            tools: self.tools.clone(),
        }));
    }

    /// From here on nothing is executed.
    pub(crate) fn read_ahead(&mut self) {
        self.read_ahead_from(self.position);
    }

    /// Reading ahead is over: the machine is as it was.
    pub(crate) fn stand(&mut self, numbered: &mut Numbered) {
        let Some(stands) = self.stands.take() else { return };
        let point = stands.point.converted(self.stored_to_active());
        self.position = self.in_force.now().program_of(point);
        self.tool = stands.tool;
        self.prepared = stands.prepared;
        self.selected = stands.selected;
        self.tools = stands.tools;
        self.publish_tool(numbered);
    }
}
