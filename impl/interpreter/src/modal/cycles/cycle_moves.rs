//! Performs the moves of a canned cycle.

use gaugeblock_vocabulary::{Axis, Effect, LengthUnit, PathControlMode, SpindleTurn, Switch};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};

use super::super::Modal;
use super::super::modes::Spindles;
use super::super::refusal::Refusal;
use super::drilling::{At, CycleMove, Drilling, Levels};

impl Modal {
    /// Performs the next move of a cycle. Returns whether it was the last one.
    pub(super) fn perform_cycle_move<K: Sink>(
        &mut self,
        drilling: &mut Drilling,
        line: u32,
        sink: &mut K,
    ) -> Result<bool, Refusal> {
        let Some(cycle_move) = drilling.next() else { return Ok(true) };
        let cycle = drilling.cycle;
        let Levels { retract, bottom, clear } = cycle.levels;
        let normal = cycle.axes.normal;
        let level = self.position.coordinate_of(normal);
        let to = |modal: &Self, level| modal.position.with_axis(normal, level);
        match cycle_move {
            CycleMove::Across => {
                if self.choices.cycle_exact_path {
                    self.active.put(|modes| &mut modes.path, PathControlMode::ExactPath);
                }
                let [first, second] = cycle.hole;
                let across = self.position.with_axis(cycle.axes.first, first);
                self.traverse_to(line, across.with_axis(cycle.axes.second, second), sink)?;
            }
            CycleMove::Approach => {
                let is_preliminary = drilling.at == At::Preliminary;
                let late = is_preliminary && normal != Axis::Z && planted(PlantedFault::RiseXyOnly);
                if level < retract && !late || !is_preliminary && level > retract {
                    self.traverse_to(line, to(self, retract), sink)?;
                }
            }
            CycleMove::Drill => self.feed_to(line, to(self, bottom), sink)?,
            CycleMove::DrillBreaking | CycleMove::DrillPecking => {
                let clearance = self.peck_clearance();
                let breaking = cycle_move == CycleMove::DrillBreaking;
                let to_clear = self.choices.pecks_clear;
                let (level, feeds, done) = drilling.next_peck(breaking, clearance, to_clear);
                if feeds {
                    self.feed_to(line, to(self, level), sink)?;
                } else {
                    self.traverse_to(line, to(self, level), sink)?;
                }
                if !done {
                    return Ok(false);
                }
            }
            CycleMove::Dwell if !cycle.dwells => {}
            CycleMove::Dwell => {
                self.perform(line, &Effect::Dwell { seconds: cycle.dwell }, sink)?;
            }
            CycleMove::RapidOut => self.traverse_to(line, to(self, clear), sink)?,
            CycleMove::FeedOut => self.feed_to(line, to(self, clear), sink)?,
            CycleMove::FeedToRetract => self.feed_to(line, to(self, retract), sink)?,
            CycleMove::Turn(turn) => self.turn(cycle.spindle, turn, line, sink),
            CycleMove::TurnAgain if planted(PlantedFault::SpindleStays) => {}
            CycleMove::TurnAgain => self.turn(cycle.spindle, restarted(cycle.turn), line, sink),
            CycleMove::OverridesOff if self.choices.tap_keeps_overrides => {}
            CycleMove::OverridesOff => {
                self.set_overrides(cycle.spindle, (Switch::Off, Switch::Off));
            }
            CycleMove::OverridesBack => {
                if self.choices.tap_turns_back {
                    self.turn(cycle.spindle, SpindleTurn::Stopped, line, sink);
                    self.turn(cycle.spindle, cycle.turn, line, sink);
                }
                self.restore_overrides(drilling);
            }
        }
        let is_over = drilling.advance()?;
        if is_over {
            self.active.put(|modes| &mut modes.path, cycle.path);
        }
        Ok(is_over)
    }

    /// Starts or stops spindles and reports it at once, since a later move of the cycle can change it again.
    fn turn<K: Sink>(&mut self, which: Spindles, turn: SpindleTurn, line: u32, sink: &mut K) {
        self.for_spindles(which, |spindle| spindle.turn = turn);
        self.report(line, sink);
    }

    /// Restores the overrides and the path control mode that were active before the cycle.
    pub(super) fn restore_overrides(&mut self, drilling: &Drilling) {
        self.set_overrides(drilling.cycle.spindle, drilling.cycle.overrides);
        self.active.put(|modes| &mut modes.path, drilling.cycle.path);
    }

    /// The distance of a rapid move after each peck: 0.01 inch or 0.254 mm (11.5.40, 11.5.47), active length unit.
    fn peck_clearance(&self) -> f64 {
        match self.active.now().units {
            LengthUnit::Inch => 0.01,
            LengthUnit::Millimetre => 0.254,
        }
    }

    /// Sets the feed override, and the speed override of a spindle.
    fn set_overrides(&mut self, spindle: Spindles, (feed, speed): (Switch, Switch)) {
        self.active.put(|modes| &mut modes.feed_override, feed);
        self.set_speed_override(spindle, speed);
    }
}

/// The direction in which the spindle restarts after G86: as before, or, as a planted fault, always clockwise.
fn restarted(before: SpindleTurn) -> SpindleTurn {
    match before {
        SpindleTurn::Counterclockwise if planted(PlantedFault::RestartsClockwise) => {
            SpindleTurn::Clockwise
        }
        SpindleTurn::Clockwise
        | SpindleTurn::Counterclockwise
        | SpindleTurn::Stopped
        | SpindleTurn::Oriented => before,
    }
}
