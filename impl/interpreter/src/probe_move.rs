//! A straight probe, as a sink receives it in addition to its effect.

use gaugeblock_vocabulary::Position;

use crate::modal::{Conversion, Coordinates, Modes};

/// A straight probe that is about to be made (11.5.24).
#[derive(Clone, Debug)]
pub struct ProbeMove {
    pub(crate) toward: bool,
    pub(crate) from: Coordinates,
    pub(crate) to: Coordinates,
    pub(crate) modes: Modes,
    pub(crate) stored_to_active: Conversion,
}

impl ProbeMove {
    /// Whether the probe is to touch (G38.2, G38.3), and not to cease to.
    pub fn toward(&self) -> bool {
        self.toward
    }

    /// Where the controlled point is: machine coordinates in the machine's unit.
    pub fn from(&self) -> Position {
        self.from.position()
    }

    /// Where it goes at most, likewise.
    pub fn to(&self) -> Position {
        self.to.position()
    }

    /// A point of the machine in program coordinates and the active unit, as
    /// [`Reply::Contact`](crate::Reply::Contact) takes it.
    pub fn program(&self, machine: Position) -> Position {
        let machine = Coordinates::from(machine).converted(self.stored_to_active);
        self.modes.program_of(machine).position()
    }
}
