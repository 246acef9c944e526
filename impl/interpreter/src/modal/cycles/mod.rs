//! Canned cycles: G73, G74, G81 to G89 (11.5.40, 11.5.41, 11.5.43 to 11.5.53, 11.5.61), which rewrite a block into
//! plain moves.
//!
//! ```text
//! Words ─► MotionSeries (sticky words, initial level) ─► Drilling (a hole as numbers) ─► moves, one at a time
//! ```
//!
//! **Invariants.**
//! * Everything that a block can be refused for is checked before its first move, except that a repeat by polar words
//!   has no place after a hole at the origin.
//! * A step performs a bounded number of moves, whatever L and Q are, and a cycle allocates nothing.

mod cycle_moves;
mod drilling;
mod numbers;
mod pending;
mod plane_axes;
mod series;
mod steps;
mod thread_moves;
mod threading;

pub(super) use pending::PendingBlock;
pub(super) use series::{Curve, MotionSeries};

use gaugeblock_vocabulary::{
    Axis, Compensation, FaultKind, FeedMode, Lathe, ReturnMode, SpindleTurn, Switch,
};

use crate::faults::{PlantedFault, planted};
use crate::words::Words;

use super::Modal;
use super::check::Block;
use super::choices::TapWithoutDwell;
use super::codes::RETRACT;
use super::coordinates::Coordinates;
use super::end_point::with_radius;
use super::letters::{A, AXES, B, C, X, Y, Z};
use super::modes::{FIRST, Spindle};
use super::motion_codes::mode_of;
use super::refusal::{Refusal, refuse};

use drilling::{Cycle, Drilling, Levels, Step};
use numbers::Numbers;
use pending::Job;
use plane_axes::PlaneAxes;
use series::CycleSeries;

/// Whether the spindle turns as a thread is cut: clockwise under G84, counterclockwise under G74.
fn check_tapping(code: u16, turn: SpindleTurn) -> Result<(), Refusal> {
    let cuts = match code {
        740 => SpindleTurn::Counterclockwise,
        840 => SpindleTurn::Clockwise,
        _ => return Ok(()),
    };
    match turn {
        turn if turn == cuts => Ok(()),
        SpindleTurn::Stopped | SpindleTurn::Oriented => {
            refuse(FaultKind::ZeroSpeed, "tapping while the spindle is stopped")
        }
        SpindleTurn::Clockwise | SpindleTurn::Counterclockwise => {
            refuse(FaultKind::ModalConflict, "tapping while the spindle turns the other way")
        }
    }
}

/// R must not be below Z (11.5.43.5).
fn check_levels(levels: Levels) -> Result<(), Refusal> {
    let equal = levels.retract <= levels.bottom && planted(PlantedFault::EqualLevels);
    if equal || levels.retract < levels.bottom {
        return refuse(FaultKind::WordOutOfRange, "R is below the bottom of the hole");
    }
    Ok(())
}

impl Modal {
    /// Checks a canned cycle and makes it the unfinished work of its block.
    pub(super) fn canned_cycle(&mut self, block: &Block<'_>, code: u16) -> Result<(), Refusal> {
        if matches!(code, 870 | 880) {
            // 11.5.51, 11.5.52.
            return Err(Refusal::Unspecified("G87 and G88 are accepted, and undefined".into()));
        }
        self.check_cycle_modes(block.words, code)?;
        let radius;
        let words = if self.active.now().lathe == Lathe::Diameter {
            radius = with_radius(block.words);
            &radius
        } else {
            block.words
        };
        let axes = PlaneAxes::of(self.active.now().plane);
        let series = self.series_of(block);
        let sticky = series.sticky(code).filter(|_| !planted(PlantedFault::NothingSticky));
        let tap = if self.emulates_rs274 { self.cycle_dwell } else { 0.0 };
        let other = (&self.choices, tap, series.foreign_depth());
        let numbers = Numbers::read(words, code, axes.normal, sticky, other)?;
        let start = if self.choices.level_of_cycle { self.position } else { series.start() };
        let mut levels = self.levels(&numbers, axes.normal, start);
        if code == 730 && !self.choices.break_returns {
            levels.clear = levels.retract;
        }
        check_levels(levels)?;
        if !self.choices.cycle_feed_any {
            self.check_feed_move()?;
        }
        let spindle = self.selected(block, FIRST)?;
        let turning = self.spindle_of(spindle);
        if code == 860 && !turning.turns() {
            return refuse(FaultKind::ZeroSpeed, "G86 while the spindle is stopped");
        }
        if self.choices.tap_as_cut {
            check_tapping(code, turning.turn)?;
        }
        let (hole, step) = self.holes(words, axes)?;
        self.series = series.with_sticky(code, numbers);
        self.motion = mode_of(code);
        if numbers::dwells(code) {
            self.cycle_dwell = numbers.dwell;
        }
        if matches!(code, 850 | 860 | 890) && planted(PlantedFault::BoreMovesNothing) {
            let [first, second] = hole;
            let across = self.position.with_axis(axes.first, first).with_axis(axes.second, second);
            self.position = across.with_axis(axes.normal, levels.clear);
            return Ok(());
        }
        let cycle = Cycle {
            axes,
            hole,
            step,
            levels,
            dwell: numbers.dwell,
            dwells: numbers.has_dwell || self.choices.tap_without_dwell != TapWithoutDwell::NoDwell,
            path: self.active.now().path,
            increment: numbers.increment,
            spindle,
            // A spindle that was held at an angle is not turned back to it.
            turn: if turning.turns() { turning.turn } else { SpindleTurn::Stopped },
            overrides: self.overrides_before(code, turning),
        };
        let drilling = Drilling::new(
            code,
            cycle,
            numbers.repeats.saturating_add(u64::from(planted(PlantedFault::OneMoreHole))),
            &self.choices,
        );
        let drilling = if self.emulates_rs274 { drilling.emulating_rs274() } else { drilling };
        self.begin_job(block.words.line, Job::Drilling(drilling));
        Ok(())
    }

    /// The series that a block continues or begins.
    fn series_of(&self, block: &Block<'_>) -> CycleSeries {
        let series = self.series.cycle_series(self.motion, self.position);
        if block.g(RETRACT).is_some() && planted(PlantedFault::ReturnSwitchResets) {
            return series.from(self.position);
        }
        series
    }

    /// The feed and speed override before a cycle.
    fn overrides_before(&self, code: u16, turning: Spindle) -> (Switch, Switch) {
        if code == 840 && planted(PlantedFault::TapEnables) {
            return (Switch::On, Switch::On);
        }
        (self.active.now().feed_override, turning.speed_override)
    }

    /// Modes and axis words that no cycle takes (11.5.43, 11.5.43.5).
    fn check_cycle_modes(&self, words: &Words, code: u16) -> Result<(), Refusal> {
        let now = self.active.now();
        if now.compensation != Compensation::Off {
            return refuse(FaultKind::CompensationActive, "a canned cycle under compensation");
        }
        if now.feed_mode == FeedMode::InverseTime && !planted(PlantedFault::CycleInverseTime) {
            return refuse(FaultKind::ModalConflict, "a canned cycle under inverse time");
        }
        let later = planted(PlantedFault::RotaryLater) && self.motion == mode_of(code);
        if words.present & (A | B | C) != 0 && !later {
            return refuse(FaultKind::AxisWords, "a rotary axis word in a canned cycle");
        }
        let both = planted(PlantedFault::FamiliesMixed);
        let foreign = if both && PlaneAxes::letters(now.plane) & X == 0 { X | Y | Z } else { 0 };
        let allowed = PlaneAxes::letters(now.plane) | foreign | if later { A | B | C } else { 0 };
        if words.present & AXES & !allowed != 0 {
            return refuse(FaultKind::AxisWords, "an axis word that is not of the plane's family");
        }
        Ok(())
    }

    /// R, the bottom and the clear level as positions. In incremental mode R counts from where the axis is, and the
    /// bottom from R (11.5.43.2).
    fn levels(&self, numbers: &Numbers, normal: Axis, start: Coordinates) -> Levels {
        let now = self.active.now();
        let (retract, bottom) = if self.is_incremental() {
            let origin = if self.emulates_rs274 { start } else { self.position };
            let retract = origin.coordinate_of(normal) + numbers.retract;
            let from = if planted(PlantedFault::BottomFromPoint) {
                retract - numbers.retract
            } else {
                retract
            };
            (retract, from + numbers.bottom)
        } else {
            (numbers.retract, numbers.bottom)
        };
        let initial = start.coordinate_of(normal);
        let clear = if now.retract == ReturnMode::OldZ && !planted(PlantedFault::BackToR) {
            initial.max(retract)
        } else {
            retract
        };
        Levels { retract, bottom, clear }
    }

    /// The place of the first hole, and how each follows from the one before: in absolute mode they are all in one
    /// place (11.5.43.3).
    fn holes(&self, words: &Words, axes: PlaneAxes) -> Result<([f64; 2], Step), Refusal> {
        const IN_PLACE: Step = Step::By([0.0, 0.0]);
        if words.is_polar() {
            let incremental = self.is_incremental();
            let step = if incremental { Step::Polar(self.polar(words, true)) } else { IN_PLACE };
            return Ok((self.polar_hole(words, axes)?, step));
        }
        let plane = [axes.first, axes.second];
        let here = plane.map(|axis| self.position.coordinate_of(axis));
        let [first, second] = plane.map(|axis| numbers::axis_word(words, axis));
        let [at_first, at_second] = here;
        if !self.is_incremental() {
            return Ok(([first.unwrap_or(at_first), second.unwrap_or(at_second)], IN_PLACE));
        }
        let omitted = if planted(PlantedFault::OmittedAxisAdds) { here } else { [0.0, 0.0] };
        let [omitted_first, omitted_second] = omitted;
        let step = [first.unwrap_or(omitted_first), second.unwrap_or(omitted_second)];
        let [by_first, by_second] = step;
        Ok(([at_first + by_first, at_second + by_second], Step::By(step)))
    }

    /// The hole of polar words, which set X and Y as for a move (11.4.12).
    fn polar_hole(&self, words: &Words, axes: PlaneAxes) -> Result<[f64; 2], Refusal> {
        if (axes.first, axes.second) != (Axis::X, Axis::Y) {
            let why = "polar words in a cycle of another plane: they give X and Y (11.4.12)";
            return Err(Refusal::Unspecified(why.into()));
        }
        let polar = self.polar(words, self.is_incremental());
        let hole = polar.end(self.position, self.position)?;
        Ok([axes.first, axes.second].map(|axis| hole.coordinate_of(axis)))
    }
}
