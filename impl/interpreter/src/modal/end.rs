//! Stops and ends: M0, M1, M60 (11.6.2, 11.6.4), M2, M30 (11.6.3), and the operator's abort.

use gaugeblock_vocabulary::{
    Compensation, ControllerMode, Distance, Effect, FeedMode, Motion, Plane, SpindleTurn, Switch,
};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::parameters::Numbered;

use super::Modal;
use super::choices::FeedAtEnd;
use super::compensation::Cutter;
use super::modes::{FIRST, Modes};
use super::refusal::Refusal;

impl Modal {
    /// A code of group 4, the last phase of a block; whether the program is over.
    pub(super) fn stop<K: Sink>(
        &mut self,
        code: u16,
        line: u32,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<bool, Refusal> {
        let ends = match code {
            30 => !self.choices.pallet_table,
            60 => self.choices.pallet_table,
            code => code == 2,
        };
        if code == 1 && self.choices.no_optional_stop {
            return Ok(false);
        }
        let mode = self.controller_mode;
        self.finish_waiting(sink)?;
        if ends {
            // What the block has switched on before has been on.
            self.report(line, sink);
            if planted(PlantedFault::EndRestores) {
                self.restore_at_end(numbered);
            }
            self.reset_at_end(numbered);
        }
        let late = code == 60 && planted(PlantedFault::PalletsAfter);
        let none = code == 60 && planted(PlantedFault::NoPallets);
        if matches!(code, 30 | 60) && !none && !late {
            self.perform(line, &Effect::PalletShuttle {}, sink)?;
        }
        if !ends {
            let optional = code == 1 && !planted(PlantedFault::NotOptional)
                || code == 60 && planted(PlantedFault::PalletStopOptional);
            self.perform(line, &Effect::Stop { optional }, sink)?;
            if late {
                self.perform(line, &Effect::PalletShuttle {}, sink)?;
            }
            return Ok(false);
        }
        if self.controller_mode != mode {
            let mode = self.controller_mode;
            self.perform(line, &Effect::ChangeControllerMode { mode }, sink)?;
        }
        self.perform(line, &Effect::ProgramEnd {}, sink)?;
        self.end_run();
        Ok(true)
    }

    /// The documented effects of a program end. Units, G90.1, G7, G61, G98 and G96 stay. Whether the offset of G92 does
    /// is a choice.
    fn reset_at_end(&mut self, numbered: &mut Numbered) {
        self.controller_mode = ControllerMode::Mdi;
        self.reset_offsets(numbered);
        self.reset_feed();
        let is_kept = planted(PlantedFault::CompensationKept);
        if !is_kept {
            self.cutter = Cutter::NONE;
        }
        if !planted(PlantedFault::MotionStays) {
            self.motion = Motion::Feed;
        }
        let modes = self.active.set();
        let uvw = matches!(modes.plane, Plane::Uv | Plane::Wu | Plane::Vw);
        if !(uvw && planted(PlantedFault::UvwPlaneStays)) {
            modes.plane = Plane::Xy;
        }
        if !planted(PlantedFault::IncrementalStays) {
            modes.distance = Distance::Absolute;
        }
        let dynamic =
            matches!(modes.compensation, Compensation::DynamicLeft | Compensation::DynamicRight);
        if !(is_kept || dynamic && planted(PlantedFault::DynamicCompensationStays)) {
            modes.compensation = Compensation::Off;
        }
        modes.feed_override = Switch::On;
        self.forget_compensated_path();
        let all = self.all_spindles();
        let first = planted(PlantedFault::OtherOverridesStay);
        self.set_speed_override(if first { FIRST } else { all }, Switch::On);
        let before = self.active.now().spindles;
        self.stop_running(if self.choices.end_stops_first { FIRST } else { all });
        if planted(PlantedFault::StaysOriented) {
            for (spindle, before) in self.active.set().spindles.iter_mut().zip(before) {
                if before.turn == SpindleTurn::Oriented {
                    spindle.turn = before.turn;
                }
            }
        }
    }

    /// G94. What becomes of F where the mode changes is a choice.
    fn reset_feed(&mut self) {
        let Modes { feed_rate: feed, feed_mode, .. } = *self.active.now();
        let rate = self.rate_of_move;
        let per_revolution = self.active.now().feed_mode == FeedMode::PerRevolution;
        if !(per_revolution && planted(PlantedFault::PerRevolutionStays)) {
            self.select_feed_mode(940);
        }
        match self.choices.feed_at_end {
            _ if self.active.now().feed_mode == feed_mode => {}
            FeedAtEnd::Zero if planted(PlantedFault::FeedKeptOverMode) => {}
            FeedAtEnd::Zero => self.active.set_feed_rate(0.0),
            FeedAtEnd::Kept => self.active.set_feed_rate(feed),
            FeedAtEnd::OfLastMove => self.active.set_feed_rate(rate),
        }
    }

    /// G54, and by a choice G92.2.
    fn reset_offsets(&mut self, numbered: &mut Numbered) {
        if !planted(PlantedFault::SystemStays) {
            self.use_work_offset(1, numbered);
        }
        if self.choices.end_suspends_offset {
            self.suspend_g92(numbered);
        }
    }

    /// Like M5 and M9.
    fn stop_running(&mut self, which: u8) {
        self.for_spindles(which, |spindle| spindle.turn = SpindleTurn::Stopped);
        if !planted(PlantedFault::CoolantOn) {
            self.coolant(9);
        }
    }

    /// The program begins, whichever: no call is open. Modes stay as they are (11.4.24).
    pub(crate) fn begin(&mut self) {
        self.begin_again();
        self.forget_compensated_path();
    }

    /// Repeats the program after M99. The compensated path keeps its end: the next move must still be a line.
    pub(crate) fn begin_again(&mut self) {
        self.leave_saved_calls();
        self.stop_asked = false;
        self.abandon();
        self.controller_mode = ControllerMode::Auto;
    }

    /// An operator's abort: nothing is restored (11.6.22), no call is open any more.
    pub(crate) fn abort<K: Sink>(&mut self, sink: &mut K, line: u32) {
        self.end_run();
        self.abort_idle(sink, line);
    }

    /// An operator's abort while no program runs: none ends by it.
    pub(crate) fn abort_idle<K: Sink>(&mut self, sink: &mut K, line: u32) {
        self.abandon();
        self.forget_compensated_path();
        if !self.choices.abort_leaves_running {
            self.stop_running(self.all_spindles());
        }
        self.active.report(line, sink);
    }
}
