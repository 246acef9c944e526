//! Spindles: S, G96, G97, M3 to M5, M19 (11.5.60, 11.6.5, 11.6.8, 11.8.2).

use gaugeblock_vocabulary::{
    Effect, FaultKind, OrientDirection, SpindleLimit, SpindleMode, SpindleTurn, Switch,
};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::math;

use super::Modal;
use super::check::Block;
use super::codes::SPINDLE_MODE;
use super::modes::{FIRST, Spindle, Spindles};
use super::refusal::{Refusal, refuse};
use super::values::{integer, not_negative};

impl Modal {
    /// Every spindle of the machine.
    pub(super) fn all_spindles(&self) -> Spindles {
        u8::MAX.checked_shr(8_u32.saturating_sub(self.spindles)).unwrap_or(0)
    }

    /// The spindles that `$` selects, or those that a code without it acts on.
    pub(super) fn selected(
        &self,
        block: &Block<'_>,
        without: Spindles,
    ) -> Result<Spindles, Refusal> {
        let Some(dollar) = block.words.dollar else { return Ok(without) };
        // An integer of any size: a number beyond 32 bits must not select another spindle.
        let Some(number) = math::near_integer(dollar) else {
            return refuse(FaultKind::NotAnInteger, "$ is not an integer");
        };
        match u32::try_from(number) {
            Ok(number) if number < self.spindles => Ok(FIRST.wrapping_shl(number)),
            _ => refuse(FaultKind::SpindleOutOfRange, "the machine has no spindle of this number"),
        }
    }

    /// Sets something for each of a set of spindles.
    pub(super) fn for_spindles(&mut self, which: Spindles, mut set: impl FnMut(&mut Spindle)) {
        for (place, spindle) in (0_u32..).zip(self.active.set().spindles.iter_mut()) {
            if which & FIRST.wrapping_shl(place) != 0 {
                set(spindle);
            }
        }
    }

    /// Set spindle speed (S), and what it means (G96, G97). Without $ it is spindle 0 (11.8.2).
    pub(super) fn spindle_speed(&mut self, block: &Block<'_>) -> Result<(), Refusal> {
        let words = block.words;
        let speed = words.get(b'S');
        let mode = block.g(SPINDLE_MODE);
        if speed.is_none() && mode.is_none() {
            return Ok(());
        }
        let without = if planted(PlantedFault::SpeedForAll) { self.all_spindles() } else { FIRST };
        let which = self.selected(block, without)?;
        if let Some(speed) = speed
            && !planted(PlantedFault::NegativeSpeed)
        {
            not_negative(speed, "S")?;
        }
        let limit = match words.get(b'D') {
            Some(_) if planted(PlantedFault::NoSpindleLimit) => SpindleLimit::None,
            Some(limit) if mode == Some(960) => SpindleLimit::Rpm(not_negative(limit, "D")?),
            Some(_) | None => SpindleLimit::None,
        };
        if mode == Some(970) && speed.is_none() && self.choices.rpm_needs_speed {
            return refuse(FaultKind::MissingWord, "G97 without S");
        }
        self.for_spindles(which, |spindle| {
            if let Some(speed) = speed {
                spindle.speed = speed;
            }
            match mode {
                Some(960) => (spindle.mode, spindle.limit) = (SpindleMode::SurfaceSpeed, limit),
                Some(_) => (spindle.mode, spindle.limit) = (SpindleMode::Rpm, SpindleLimit::None),
                None => {}
            }
        });
        self.note_surface_speed();
        Ok(())
    }

    /// M3, M4, M5.
    pub(super) fn turn_spindle(&mut self, block: &Block<'_>, code: u16) -> Result<(), Refusal> {
        let first = self.choices.turn_first && !(code == 5 && planted(PlantedFault::StopStopsAll));
        let without = if first { FIRST } else { self.all_spindles() };
        // That -1 means all spindles is said of these codes only (11.6.5), also together with S or another code.
        let all = self.choices.minus_one_all
            && block.words.dollar.is_some_and(|number| math::near_integer(number) == Some(-1));
        let which = if all { self.all_spindles() } else { self.selected(block, without)? };
        let last_out = all && self.spindles > 1 && planted(PlantedFault::LastSpindleLeftOut);
        let which = if last_out { which >> 1 } else { which };
        let turn = match code {
            3 => SpindleTurn::Clockwise,
            4 if planted(PlantedFault::OneDirection) => SpindleTurn::Clockwise,
            4 => SpindleTurn::Counterclockwise,
            _ => SpindleTurn::Stopped,
        };
        let keeps = code == 5 && planted(PlantedFault::StopKeepsOrientation);
        let reverses = code == 4 && planted(PlantedFault::ReversalStops);
        self.for_spindles(which, |spindle| {
            if reverses && spindle.turn == SpindleTurn::Clockwise {
                spindle.turn = SpindleTurn::Stopped;
            } else if !(keeps && spindle.turn == SpindleTurn::Oriented) {
                spindle.turn = turn;
            }
            if code == 5 && planted(PlantedFault::StopForgetsSpeed) {
                spindle.speed = 0.0;
            }
        });
        Ok(())
    }

    /// M19: turn to an angle and wait for it.
    pub(super) fn orient<K: Sink>(
        &mut self,
        block: &Block<'_>,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let words = block.words;
        let (angle, timeout) = (words.get(b'R').unwrap_or(0.0), words.get(b'Q').unwrap_or(0.0));
        let turns = !self.emulates_rs274 || words.get(b'R').is_some() || words.get(b'P').is_some();
        let waits = !self.emulates_rs274 || words.get(b'Q').is_some();
        let refused = planted(PlantedFault::FullTurnRefused) && angle >= 360.0;
        if refused || !(0.0..=360.0).contains(&angle) {
            return refuse(FaultKind::WordOutOfRange, "R of M19 is 0 to 360");
        }
        // rs274 has begun to turn when it looks at Q.
        if !self.emulates_rs274 {
            self.check_orient_timeout(timeout)?;
        }
        let direction = match words.get(b'P').map_or(Ok(0), |p| integer(p, "P"))? {
            0 => OrientDirection::Shortest,
            1 => OrientDirection::Clockwise,
            2 => OrientDirection::Counterclockwise,
            _ => return refuse(FaultKind::WordOutOfRange, "P of M19 is 0, 1 or 2"),
        };
        let without = if self.choices.orient_all { self.all_spindles() } else { FIRST };
        let which = self.selected(block, without)?;
        let held = self.spindle_of(which).turn == SpindleTurn::Oriented;
        if held && planted(PlantedFault::OrientedAlready) {
            return Ok(());
        }
        let turns_on = words.get(b'P').is_none() && planted(PlantedFault::TurnsOnWithoutP);
        let direction = match self.spindle_of(which).turn {
            SpindleTurn::Clockwise if turns_on => OrientDirection::Clockwise,
            SpindleTurn::Counterclockwise if turns_on => OrientDirection::Counterclockwise,
            SpindleTurn::Clockwise
            | SpindleTurn::Counterclockwise
            | SpindleTurn::Stopped
            | SpindleTurn::Oriented => direction,
        };
        // The sum is the value of the pin (11.6.8); it may be more than a turn.
        let offset = if planted(PlantedFault::NoOrientOffset) { 0.0 } else { self.orient_offset };
        let angle = angle + offset;
        let over = angle > 360.0 && planted(PlantedFault::AngleWithinTurn);
        let angle = if over { angle - 360.0 } else { angle };
        if turns && !planted(PlantedFault::OrientTurnsOn) {
            self.for_spindles(which, |spindle| spindle.turn = SpindleTurn::Oriented);
        }
        for spindle in spindles_of(which).filter(|_| turns) {
            self.perform(words.line, &Effect::OrientSpindle { spindle, angle, direction }, sink)?;
        }
        if waits && self.emulates_rs274 {
            self.check_orient_timeout(timeout)?;
        }
        for spindle in spindles_of(which).filter(|_| waits) {
            self.perform(words.line, &Effect::WaitOrient { spindle, timeout }, sink)?;
        }
        Ok(())
    }

    fn check_orient_timeout(&self, timeout: f64) -> Result<(), Refusal> {
        if timeout < 0.0 || timeout <= 0.0 && !self.choices.orient_at_once {
            return refuse(FaultKind::WordOutOfRange, "Q of M19 is greater than zero");
        }
        Ok(())
    }

    /// A spindle under constant surface speed that does not turn: a feed move is refused then (11.5.60).
    pub(super) fn is_surface_speed_stopped(&self) -> bool {
        let stands =
            |spindle: &Spindle| spindle.mode == SpindleMode::SurfaceSpeed && !spindle.turns();
        self.surface_speed && self.active.now().spindles.iter().any(stands)
    }

    /// Whether any spindle is under constant surface speed; kept in a field of its own because every feed move uses
    /// it.
    pub(super) fn note_surface_speed(&mut self) {
        self.surface_speed = self
            .active
            .now()
            .spindles
            .iter()
            .any(|spindle| spindle.mode == SpindleMode::SurfaceSpeed);
    }

    /// Enables or disables speed overrides.
    pub(super) fn set_speed_override(&mut self, which: Spindles, switch: Switch) {
        self.for_spindles(which, |spindle| spindle.speed_override = switch);
    }
}

/// The numbers of a set of spindles, ascending.
fn spindles_of(which: Spindles) -> impl Iterator<Item = u32> {
    (0..8).filter(move |number| which & FIRST.wrapping_shl(*number) != 0)
}
