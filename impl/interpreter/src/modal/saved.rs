//! Saved state: M70 saves, M71 invalidates, M72 restores, M73 restores at the end of its sub (11.6.19 to 11.6.22).

use gaugeblock_vocabulary::{FaultKind, Motion, PathControlMode, SpindleTurn};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::parameters::Numbered;

use super::Modal;
use super::modes::Modes;
use super::refusal::{Refusal, refuse};
use super::saved_states::{SaveSlot, Saved};

impl Modal {
    /// Ends all calls: only the states that the main program has saved remain.
    pub(crate) fn leave_saved_calls(&mut self) {
        self.saved.leave_calls();
    }

    /// The program has ended, or the next one begins: ends all calls. If the options say so, the states that the main
    /// program has saved are removed, too.
    pub(crate) fn end_run(&mut self) {
        self.saved.leave_calls();
        if self.choices.saved_for_one_run {
            self.saved.places.clear();
        }
    }

    /// Begins a call level.
    #[inline]
    pub(crate) fn enter_call(&mut self) {
        let levels = u32::from(!planted(PlantedFault::OneLevel));
        self.saved.level = self.saved.level.saturating_add(levels);
    }

    /// Ends a call level, by whatever return, and restores the state that M73 saved there.
    #[inline]
    pub(crate) fn leave_call<K: Sink>(&mut self, numbered: &mut Numbered, sink: &mut K, line: u32) {
        while let Some(place) = self.saved.places.last()
            && place.level >= self.saved.level
        {
            if place.autorestore && place.valid && !planted(PlantedFault::NoAutorestore) {
                let state = place.state;
                self.restore(&state, numbered);
                self.report(line, sink);
            }
            self.saved.places.pop();
        }
        self.saved.level = self.saved.level.saturating_sub(1);
    }

    /// Disables the restore at the end of the sub: a planted fault.
    pub(crate) fn forget_autorestore(&mut self) {
        self.saved.here().for_each(|place| place.autorestore = false);
    }

    /// Restores what M73 has saved in the main program: a planted fault.
    pub(super) fn restore_at_end(&mut self, numbered: &mut Numbered) {
        let main = |place: &&SaveSlot| place.level == 0 && place.autorestore && place.valid;
        if let Some(state) = self.saved.places.iter().find(main).map(|place| place.state) {
            self.restore(&state, numbered);
        }
    }

    /// M70 to M73.
    pub(super) fn saved_state(
        &mut self,
        code: u16,
        numbered: &mut Numbered,
    ) -> Result<(), Refusal> {
        self.saved.note();
        match code {
            70 if planted(PlantedFault::FirstSaveCounts)
                && self.saved.here().any(|place| place.by_m70 && place.valid) =>
            {
                Ok(())
            }
            70 | 73 => {
                let state = Saved {
                    modes: *self.active.now(),
                    motion: self.motion,
                    cutter: self.cutter,
                    feed_spindle: self.feed_spindle,
                };
                let slot_code = if self.choices.one_place { 70 } else { code };
                self.saved.save(slot_code, code, state);
                Ok(())
            }
            71 => self.invalidate(),
            _ if planted(PlantedFault::RestoresNothing) && self.saved.here().next().is_none() => {
                Ok(())
            }
            _ => {
                let needs_m70 = self.choices.restore_needs_m70;
                let saved = self.saved.here().find(|place| place.by_m70 || !needs_m70);
                let taken = saved.filter(|place| place.valid).map(|place| {
                    place.valid = !(place.by_m70 && planted(PlantedFault::RestoredOnce));
                    place.state
                });
                let Some(state) = taken else {
                    return refuse(FaultKind::NothingSaved, "nothing was saved at this call level");
                };
                self.restore(&state, numbered);
                self.check_compensated_path()
            }
        }
    }

    /// M71: the states that were saved at this call level can no longer be restored.
    fn invalidate(&mut self) -> Result<(), Refusal> {
        if planted(PlantedFault::NotInvalidated) {
            return Ok(());
        }
        if planted(PlantedFault::InvalidatesAll) {
            self.saved.places.iter_mut().for_each(|place| place.valid = false);
            return Ok(());
        }
        let mut any = false;
        for place in self.saved.here() {
            any |= place.valid;
            place.valid = false;
        }
        if !any && self.choices.invalidate_needs_save {
            return refuse(FaultKind::NothingSaved, "nothing was saved at this call level");
        }
        Ok(())
    }

    /// Restores the units first, so that the saved feed and lengths are in their own unit, then everything else
    /// (11.6.21).
    fn restore(&mut self, saved: &Saved, numbered: &mut Numbered) {
        let kept;
        let modes = if planted(PlantedFault::OverridesNotRestored) {
            kept = with_overrides(&saved.modes, self.active.now());
            &kept
        } else {
            &saved.modes
        };
        if !planted(PlantedFault::UnitsForgotten) {
            self.change_units(modes.units);
        }
        self.restore_cutter(saved);
        if self.active.now().work_offset != modes.work_offset {
            self.use_work_offset(modes.work_offset, numbered);
        }
        self.offset_by(|now| {
            (now.tool_length, now.tool_offset) = (modes.tool_length, modes.tool_offset);
        });
        self.feed_spindle = saved.feed_spindle;
        let feed_rate = if planted(PlantedFault::FeedNotRestored) {
            self.active.now().feed_rate
        } else {
            modes.feed_rate
        };
        let now = self.active.set();
        // G61 and G61.1 have no tolerances: restoring them keeps the present ones.
        let own = if modes.path == PathControlMode::Continuous { modes } else { &*now };
        let tolerances = (own.blend_tolerance, own.naive_cam_tolerance);
        let mut spindles = modes.spindles;
        for (saved, now) in spindles.iter_mut().zip(&now.spindles) {
            saved.turn = restored_turn(saved.turn, now.turn);
        }
        if planted(PlantedFault::FirstSpindleRestored) {
            let [first, ..] = spindles;
            spindles = now.spindles;
            if let Some(spindle) = spindles.first_mut() {
                *spindle = first;
            }
        }
        *now = Modes {
            spindles,
            // The list of restored modes does not name the offsets. `change_units` has converted them above.
            g5x_offset: now.g5x_offset,
            g92_offset: now.g92_offset,
            rotation: now.rotation,
            feed_rate,
            blend_tolerance: tolerances.0,
            naive_cam_tolerance: tolerances.1,
            ..*modes
        };
        self.note_surface_speed();
        self.note_compensation();
        if self.choices.motion_restored && (self.choices.every_motion || is_listed(saved.motion)) {
            self.series = self.series.changed(self.motion, saved.motion);
            self.motion = saved.motion;
        }
    }
}

/// Saved modes with the override switches that are in force.
fn with_overrides(saved: &Modes, now: &Modes) -> Modes {
    let mut spindles = saved.spindles;
    for (saved, now) in spindles.iter_mut().zip(&now.spindles) {
        saved.speed_override = now.speed_override;
    }
    Modes {
        spindles,
        feed_override: now.feed_override,
        adaptive_feed: now.adaptive_feed,
        feed_stop: now.feed_stop,
        ..*saved
    }
}

/// The list of restored modes has M3, M4 and M5 only. A spindle that was oriented at the save is stopped, not oriented
/// again.
fn restored_turn(saved: SpindleTurn, now: SpindleTurn) -> SpindleTurn {
    use SpindleTurn::{Clockwise, Counterclockwise};
    match (saved, now) {
        (Clockwise, Counterclockwise) | (Counterclockwise, Clockwise)
            if planted(PlantedFault::DirectionNotRestored) =>
        {
            now
        }
        (SpindleTurn::Oriented, SpindleTurn::Oriented) => SpindleTurn::Oriented,
        (SpindleTurn::Oriented, _) => SpindleTurn::Stopped,
        (turn, _) => turn,
    }
}

/// The motion modes of the draft's list: G1 G2 G3 G5.2 G73 G80 G82 G83 G86 G87 G88 G89.
fn is_listed(motion: Motion) -> bool {
    matches!(
        motion,
        Motion::Feed
            | Motion::ArcClockwise
            | Motion::ArcCounterclockwise
            | Motion::Nurbs
            | Motion::Cycle73
            | Motion::None
            | Motion::Cycle82
            | Motion::Cycle83
            | Motion::Cycle86
            | Motion::Cycle87
            | Motion::Cycle88
            | Motion::Cycle89
    )
}
