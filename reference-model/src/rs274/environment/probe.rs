//! What the probe answers: where it begins or ceases to touch.

use gaugeblock_vocabulary::scenario::ProbeContact;
use gaugeblock_vocabulary::{Axis, Position};

use super::state::{EnvironmentState, Probed};

/// How far apart two points may be that are the same one, machine unit.
const SAME: f64 = 1e-6;

/// Whether a probing move is to make the probe touch, or to make it cease.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Wanted {
    /// G38.2, G38.3.
    Touching,
    /// G38.4, G38.5.
    Free,
}

impl EnvironmentState {
    /// Whether the probe is as a probing move wants it, the controlled point being at this machine position.
    pub(crate) fn probe_is(&self, wanted: Wanted, at: Position) -> bool {
        if self.is_stand_alone() {
            return false;
        }
        let here = |probed: &Probed| apart(probed.at, at) < SAME;
        let touching = match self.probed.filter(here) {
            Some(probed) => probed.touching,
            None => {
                matches!(self.scenario.probe, Some(ProbeContact::At(point)) if apart(point, at) < SAME)
            }
        };
        touching == (wanted == Wanted::Touching)
    }

    /// Where the probe changes on a straight move between two machine positions, if it does.
    pub(crate) fn probe(&self, from: Position, to: Position) -> Option<Position> {
        if self.is_stand_alone() {
            return Some(to);
        }
        match self.scenario.probe {
            Some(ProbeContact::AtTarget) => Some(to),
            Some(ProbeContact::At(point)) => on_the_way(point, from, to),
            Some(ProbeContact::Never) | None => None,
        }
    }

    /// Whether the controller learns that the probe changed: the interpreter program `rs274` has no probe.
    pub(crate) fn reports_contact(&self) -> bool {
        !self.is_stand_alone()
    }

    /// A probing move has been made; the probe stays as it is as long as the controlled point is there.
    pub(crate) fn has_probed(&mut self, wanted: Wanted, to: Position, changed: Option<Position>) {
        let touching = changed.is_some() == (wanted == Wanted::Touching);
        self.probed = Some(Probed { at: changed.unwrap_or(to), touching });
    }
}

/// The point, if it is on the straight line between two others.
fn on_the_way(point: Position, from: Position, to: Position) -> Option<Position> {
    let along = |a: Position, b: Position| -> f64 {
        let values = a.to_array().into_iter().zip(b.to_array()).zip(from.to_array());
        values.map(|((a, b), from)| (a - from) * (b - from)).sum()
    };
    let share = along(point, to) / along(to, to);
    let mut nearest = from;
    for axis in Axis::ALL.iter().copied() {
        *nearest.get_mut(axis) += share * (to.get(axis) - from.get(axis));
    }
    let within = (-SAME..=1.0 + SAME).contains(&share);
    (within && apart(nearest, point) < SAME).then_some(point)
}

fn apart(a: Position, b: Position) -> f64 {
    let differences = a.to_array().into_iter().zip(b.to_array()).map(|(a, b)| (a - b).abs());
    differences.fold(0.0, f64::max)
}
