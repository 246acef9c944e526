//! Work coordinate systems and offsets: G54 to G59.3, G10 L2 and L20, G52, G92 (11.1, 11.5.14, 11.5.17, 11.5.32,
//! 11.5.34, 11.5.56).

use alloc::format;

use gaugeblock_vocabulary::{Compensation, FaultKind, Lathe, Motion};

use crate::canon::Sink;
use crate::faults::{PlantedFault, narrowed, planted};
use crate::parameters::Numbered;
use crate::words::Words;

use super::Modal;
use super::coordinates::Coordinates;
use super::end_point::with_radius;
use super::letters::{AXES, X, Y, Z};
use super::modes::Modes;
use super::offsets;
use super::refusal::{Refusal, refuse};
use super::values::integer_in;

impl Modal {
    /// Changes offsets. Nothing moves: the point keeps its machine coordinates and gets other program coordinates.
    pub(super) fn offset_by(&mut self, change: impl FnOnce(&mut Modes)) {
        let now = self.active.now();
        let machine = now.machine_of(self.position);
        self.series.each_point(|point| now.machine_of(point));
        change(self.active.set());
        let now = self.active.now();
        self.position = now.program_of(machine);
        self.series.each_point(|point| now.program_of(point));
    }

    /// The axis words of an offset; whether X is a diameter there is an option.
    pub(super) fn offset_words(&self, words: &Words) -> Words {
        if self.choices.diameter_offsets && self.active.now().lathe == Lathe::Diameter {
            with_radius(words)
        } else {
            words.clone()
        }
    }

    /// G54 to G59.3.
    pub(super) fn select_work_offset(
        &mut self,
        code: u16,
        numbered: &mut Numbered,
    ) -> Result<(), Refusal> {
        if !planted(PlantedFault::SelectCompensated) {
            self.refuse_under_compensation("selecting a coordinate system")?;
        }
        let system = match code {
            540 => 1,
            550 => 2,
            560 => 3,
            570 => 4,
            580 => 5,
            590 => 6,
            591 => 7,
            592 => 8,
            _ if planted(PlantedFault::LastSystem) => 8,
            _ => 9,
        };
        self.use_work_offset(system, numbered);
        Ok(())
    }

    /// Puts a work coordinate system into force, as it is stored.
    pub(super) fn use_work_offset(&mut self, system: u32, numbered: &mut Numbered) {
        let origin = offsets::origin(numbered, system).converted(self.stored_to_active());
        let (origin, rotation) = self.applying(origin, offsets::rotation(numbered, system));
        self.offset_by(|modes| {
            modes.work_offset = system;
            modes.g5x_offset = origin;
            modes.rotation = rotation;
        });
        numbered.set(offsets::WORK_OFFSET, f64::from(system));
    }

    /// The axes that have offsets: by a choice those of the machine alone.
    fn offset_axes(&self) -> u32 {
        if self.choices.offsets_of_axes { self.axes } else { AXES }
    }

    /// What of a stored origin and rotation applies.
    pub(super) fn applying(&self, origin: Coordinates, rotation: f64) -> (Coordinates, f64) {
        let rotation = if self.choices.offsets_of_axes { 0.0 } else { rotation };
        (Coordinates::default().taking(self.offset_axes(), origin), rotation)
    }

    /// Stores the offset of G92, active unit.
    fn store_g92(&self, offset: Coordinates, numbered: &mut Numbered) {
        let stored = offset.converted(self.active_to_stored());
        let kept = offsets::g92_offset(numbered);
        offsets::store_g92(numbered, kept.taking(self.offset_axes(), stored));
    }

    /// Stores whether the offset of G92 applies: by a choice nowhere.
    fn store_flag(&self, applies: bool, numbered: &mut Numbered) {
        if !self.choices.offsets_of_axes {
            numbered.set(offsets::G92_APPLIED, f64::from(u8::from(applies)));
        }
    }

    /// G52 and G92 to G92.3.
    pub(super) fn local_offset(
        &mut self,
        words: &Words,
        code: u16,
        numbered: &mut Numbered,
    ) -> Result<(), Refusal> {
        if matches!(code, 520 | 920) {
            self.check_offset_change()?;
        } else if self.active.now().compensation != Compensation::Off {
            // They are accepted, and change nothing.
            return Ok(());
        }
        match code {
            520 => {
                let mut offset = self.active.now().g92_offset;
                if planted(PlantedFault::UnsetCleared) {
                    offset = Coordinates::default().taking(X | Y | Z, offset);
                }
                self.set_g92(offset.replaced(&self.offset_words(words)), numbered);
            }
            920 => self.set_g92(self.new_g92_offset(words), numbered),
            921 | 922 => {
                if code == 921 {
                    self.store_g92(Coordinates::default(), numbered);
                }
                self.suspend_g92(numbered);
            }
            923 => {
                let stored = offsets::g92_offset(numbered);
                let offset = if planted(PlantedFault::RestoredNumber) {
                    stored
                } else {
                    stored.converted(self.stored_to_active())
                };
                if !planted(PlantedFault::RestoredUnflagged) {
                    self.store_flag(true, numbered);
                }
                let offset = Coordinates::default().taking(self.offset_axes(), offset);
                self.offset_by(|modes| modes.g92_offset = offset);
            }
            _ => {}
        }
        Ok(())
    }

    /// Cancels the offset of G92 and keeps its parameters.
    pub(super) fn suspend_g92(&mut self, numbered: &mut Numbered) {
        self.store_flag(false, numbered);
        self.offset_by(|modes| modes.g92_offset = Coordinates::default());
    }

    /// Whether an offset in force may change.
    fn check_offset_change(&self) -> Result<(), Refusal> {
        if self.choices.offset_uncompensated {
            self.refuse_under_compensation("changing an offset in force")?;
        }
        self.check_without_path("another offset")
    }

    /// The offset of G92: the point gets the coordinates of the words. Whether an axis without a word keeps its offset
    /// or gets none is a choice.
    fn new_g92_offset(&self, words: &Words) -> Coordinates {
        let old = self.active.now().g92_offset;
        let local = self.position.plus(old);
        let target = local.replaced(&self.offset_words(words));
        // Where no word stands `target` is `local`, which leaves zero.
        let offset = local.minus(target);
        // Quirk rs274.position-omitted-axes.
        if self.choices.position_keeps_other_axes || self.emulates_rs274 {
            old.taking(words.present, offset)
        } else {
            offset
        }
    }

    fn set_g92(&mut self, offset: Coordinates, numbered: &mut Numbered) {
        self.store_g92(offset, numbered);
        self.store_flag(true, numbered);
        self.offset_by(|modes| modes.g92_offset = offset);
    }

    /// G10 (11.5.12 to 11.5.17).
    pub(super) fn set_data<K: Sink>(
        &mut self,
        words: &Words,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        let kind = words.get(b'L').unwrap_or(0.0);
        let kind = narrowed(PlantedFault::OffsetKindWraps, kind, 256.0);
        let kind = integer_in(kind, 0, 20, "L of G10")?;
        if words.has_axes() && planted(PlantedFault::StaysSuspended) {
            self.motion = Motion::None;
        }
        match kind {
            0 => self.reload_tools(numbered),
            1 | 10 | 11 => self.set_tool_entry(words, kind, numbered, sink),
            2 | 20 => self.set_origin(words, kind, numbered),
            _ => refuse(FaultKind::WordOutOfRange, format!("there is no G10 L{kind}")),
        }
    }

    /// G10 L2 and L20.
    fn set_origin(
        &mut self,
        words: &Words,
        kind: i32,
        numbered: &mut Numbered,
    ) -> Result<(), Refusal> {
        let active = self.active.now().work_offset;
        let system = words.get(b'P').unwrap_or(0.0);
        let system = narrowed(PlantedFault::OffsetSystemWraps, system, 256.0);
        let last = if self.choices.six_systems { 6 } else { 9 };
        let first = i32::from(self.choices.no_system_zero);
        let system = match integer_in(system, first, last, "P of G10")? {
            0 if kind == 20 && planted(PlantedFault::ZeroIsFirst) => 1,
            0 => active,
            system => u32::try_from(system).unwrap_or(active),
        };
        if system == active {
            self.check_offset_change()?;
        }
        let origin = offsets::origin(numbered, system).converted(self.stored_to_active());
        let rotation = offsets::rotation(numbered, system);
        let (origin, rotation) = if kind == 2 {
            let adds = planted(PlantedFault::IncrementsInactive) && system != active;
            let words = self.offset_words(words);
            let new = if adds && self.is_incremental() {
                origin.moved_by(&words)
            } else {
                origin.replaced(&words)
            };
            (new, words.get(b'R').unwrap_or(rotation))
        } else {
            let (_, applied) = self.applying(origin, rotation);
            (self.new_origin(words, origin, applied), rotation)
        };
        let stored = origin.converted(self.active_to_stored());
        offsets::store(numbered, system, stored, rotation);
        if system == active && !planted(PlantedFault::ActiveWaits) {
            let clears = kind == 2 && planted(PlantedFault::SetClearsLocal);
            let (origin, rotation) = self.applying(origin, rotation);
            self.offset_by(|modes| {
                (modes.g5x_offset, modes.rotation) = (origin, rotation);
                if clears {
                    modes.g92_offset = Coordinates::default();
                }
            });
        }
        Ok(())
    }

    /// The origin of G10 L20: with it the point has the coordinates of the words in that system.
    fn new_origin(&self, words: &Words, origin: Coordinates, rotation: f64) -> Coordinates {
        let machine = self.active.now().machine_of(self.position);
        let in_force = planted(PlantedFault::ForeignRotation);
        let rotation = if in_force { self.active.now().rotation } else { rotation };
        let mut there = Modes { g5x_offset: origin, rotation, ..*self.active.now() };
        if planted(PlantedFault::CalculatedWithoutLocal) {
            there.g92_offset = Coordinates::default();
        }
        let target = there.program_of(machine).replaced(&self.offset_words(words));
        origin
            .taking(there.letters_moved_together(words.present), there.origin_for(machine, target))
    }
}
