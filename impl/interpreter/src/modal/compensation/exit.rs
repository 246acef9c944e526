//! The end of a compensated path: what waits is put out where no next move is known, and a line leads away.

use gaugeblock_vocabulary::{Axis, Compensation, FaultKind, Motion};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::math;

use super::super::Modal;
use super::super::check::Block;
use super::super::coordinates::Coordinates;
use super::super::refusal::{Refusal, refuse};
use super::path::{Exit, PathState};

impl Modal {
    /// Puts out what waits, because a stop or an end comes before the next move. The last move ends where its own
    /// curve does.
    pub(in super::super) fn finish_waiting<K: Sink>(
        &mut self,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if !self.compensation.waits() {
            return Ok(());
        }
        if let Some(last) = &self.compensation.path.last {
            last.check_fit(last.end)?;
        }
        self.put_out(None, sink)
    }

    /// A move of G0 to G3 that no compensated move comes before. The first one after compensation is a line (11.5.25).
    pub(in super::super) fn leave_path(&mut self, block: &Block<'_>) -> Result<(), Refusal> {
        let Some(exit) = self.compensation.path.exit else { return Ok(()) };
        if matches!(self.motion, Motion::ArcClockwise | Motion::ArcCounterclockwise) {
            if planted(PlantedFault::ArcAfterOff) {
                self.lift_exit();
                return Ok(());
            }
            return refuse(FaultKind::Gouging, "an arc as the first move after G40");
        }
        if !self.emulates_rs274 {
            self.check_exit_length(&exit, self.block_end_point(block)?)?;
        }
        self.lift_exit();
        Ok(())
    }

    /// Another move than G0 to G3: the next one may be an arc. For `rs274` only G33 and G33.1 are such moves.
    pub(in super::super) fn leave_path_by_other_move(&mut self, code: u16) {
        if !self.emulates_rs274 || matches!(code, 330 | 331) {
            self.lift_exit();
        }
    }

    fn lift_exit(&mut self) {
        if self.compensation.path.exit.is_some() {
            self.compensation.path_mut().exit = None;
            self.note_compensation();
        }
    }

    /// The line after compensation is longer than the diameter (11.5.25), from the programmed point as well as from
    /// the cutter: the manual does not say which of both it means, nor whether one as long as the diameter is refused.
    fn check_exit_length(&self, exit: &Exit, end: Coordinates) -> Result<(), Refusal> {
        let way = end.minus(self.position);
        let lengths = [way, way.minus(exit.gap)].map(length);
        let is_turned = (exit.rotation - self.active.now().rotation).abs() > 0.0;
        let is_longer = lengths.iter().all(|length| *length > exit.diameter);
        let is_shorter = lengths.iter().all(|length| *length < exit.diameter);
        let others = [Axis::A, Axis::B, Axis::C, Axis::U, Axis::V, Axis::W];
        let by_others = others.iter().any(|axis| way.coordinate_of(*axis).abs() > 0.0);
        match (is_turned, is_longer, is_shorter && !by_others) {
            (false, true, _) => Ok(()),
            (false, false, true) => refuse(
                FaultKind::Gouging,
                "a line after G40 that is shorter than the cutter's diameter",
            ),
            _ => Err(Refusal::Unsupported("the length of the line after G40".into())),
        }
    }

    /// G40: what waits is put out, and the next move leads away.
    pub(super) fn switch_off<K: Sink>(&mut self, sink: &mut K) -> Result<(), Refusal> {
        let was_on = self.active.now().compensation != Compensation::Off;
        let is_due = !self.choices.any_exit
            && (self.compensation.has_path() || was_on && !self.emulates_rs274);
        let cutter_point = self.cutter_point();
        self.end_path(sink)?;
        let mut exit = self.compensation.path.exit;
        if is_due {
            let diameter = 2.0 * self.cutter.radius;
            let (gap, rotation) = (cutter_point.minus(self.position), self.active.now().rotation);
            let due = exit.get_or_insert(Exit { diameter, gap, rotation });
            due.diameter = due.diameter.max(diameter);
        }
        *self.compensation.path_mut() = PathState { exit, ..PathState::default() };
        self.active.put(|modes| &mut modes.compensation, Compensation::Off);
        self.note_compensation();
        Ok(())
    }

    /// The programmed point goes to where the cutter is, where compensation has ended and no move has led away yet.
    pub(in super::super) fn move_to_cutter(&mut self) {
        if let Some(exit) = &mut self.compensation.path_mut().exit {
            self.position = self.position.plus(core::mem::take(&mut exit.gap));
        }
    }

    /// Where the last compensated move leads the cutter.
    fn cutter_point(&self) -> Coordinates {
        let Some(last) = &self.compensation.path.last else { return self.position };
        self.position.with_in_plane(last.plane, last.end.plus(self.plane_shift()))
    }

    /// Ends the path: the programmed point is current again (11.5.25).
    pub(in super::super) fn end_path<K: Sink>(&mut self, sink: &mut K) -> Result<(), Refusal> {
        self.finish_waiting(sink)?;
        if let Some(last) = self.compensation.path_mut().last.take() {
            self.position = self.position.with_in_plane(last.plane, last.segment.to);
        }
        Ok(())
    }
}

/// The length of a way along X, Y and Z.
fn length(way: Coordinates) -> f64 {
    let [x, y, z] = [Axis::X, Axis::Y, Axis::Z].map(|axis| way.coordinate_of(axis));
    math::hypotenuse_of_any_size(math::hypotenuse_of_any_size(x, y), z)
}
