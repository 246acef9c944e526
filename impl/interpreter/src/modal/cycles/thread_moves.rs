//! G76: its block is checked, and its passes are performed.

use gaugeblock_vocabulary::{Axis, Effect, FaultKind, Lathe, Plane};

use crate::canon::Sink;
use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::words::Words;

use super::super::Modal;
use super::super::check::Block;
use super::super::letters::{AXES, Z};
use super::super::modes::FIRST;
use super::super::motion_codes::mode_of;
use super::super::refusal::{Refusal, refuse};
use super::super::values::{integer, integer_in, not_negative};
use super::pending::Job;
use super::series::MotionSeries;
use super::threading::{PassStep, Threading};

impl Modal {
    /// Checks a thread and makes it the unfinished work of its block.
    pub(in super::super) fn thread(&mut self, block: &Block<'_>) -> Result<(), Refusal> {
        let words = block.words;
        if self.active.now().plane != Plane::Zx {
            return refuse(FaultKind::ModalConflict, "G76 outside of the ZX plane");
        }
        // 11.4.12: polar words give X and Y.
        if words.present & AXES != Z || words.is_polar() {
            return refuse(FaultKind::AxisWords, "G76 takes a Z word and no other axis");
        }
        self.check_uncompensated_move()?;
        let spindles = self.selected(block, FIRST)?;
        if self.choices.thread_needs_spindle && !self.spindle_of(spindles).turns() {
            return refuse(FaultKind::ZeroSpeed, "G76 while the spindle is stopped");
        }
        let spindle = spindles.trailing_zeros();
        let threading = self.threading(words, spindle)?;
        // 11.5.61: a row of canned cycles ends with any other motion.
        self.series = MotionSeries::default();
        self.motion = mode_of(760);
        self.begin_job(words.line, Job::Threading(threading));
        Ok(())
    }

    /// The thread that the words say.
    fn threading(&self, words: &Words, spindle: u32) -> Result<Threading, Refusal> {
        let word = |letter| words.get(letter).unwrap_or(0.0);
        // Under diameter programming I, J and K are diameters.
        let diameters =
            self.active.now().lathe == Lathe::Diameter && !planted(PlantedFault::DepthAsRadius);
        let across = if diameters { 0.5 } else { 1.0 };
        let peak_offset = word(b'I') * across;
        let (first_depth, full_depth) = (word(b'J') * across, word(b'K') * across);
        if first_depth <= 0.0 || full_depth <= 0.0 {
            return refuse(FaultKind::WordOutOfRange, "J or K of G76 is not positive");
        }
        let without = if self.choices.thread_constant_area { 2.0 } else { 1.0 };
        let degression = words.get(b'R').unwrap_or(without);
        if degression < 1.0 {
            return refuse(FaultKind::WordOutOfRange, "R of G76 is less than 1");
        }
        let springs = integer(word(b'H'), "H")?;
        let springs = if planted(PlantedFault::NoSpringPasses) { springs.min(0) } else { springs };
        let Ok(springs) = u32::try_from(springs) else {
            return refuse(FaultKind::WordOutOfRange, "H is negative");
        };
        if peak_offset.abs() <= 0.0 {
            let why = "G76 with I0: whether the thread is internal or external (11.5.42)";
            return Err(Refusal::Unspecified(why.into()));
        }
        let (start, end) =
            (self.position.coordinate_of(Axis::Z), self.end_point(words).coordinate_of(Axis::Z));
        let taper = not_negative(word(b'E'), "E")?;
        let half = (end - start).abs() / 2.0;
        let exactly = taper >= half && taper > 0.0 && planted(PlantedFault::HalfTaperRefused);
        if exactly || taper > half {
            return refuse(FaultKind::WordOutOfRange, "E is greater than half the drive line");
        }
        let tapered = integer_in(word(b'L'), 0, 3, "L of G76")?;
        let forward = if end < start { -1.0 } else { 1.0 };
        let drive = self.position.coordinate_of(Axis::X);
        let signed = |applies| if applies { taper * forward } else { 0.0 };
        let mut threading = Threading {
            spindle,
            pitch: not_negative(word(b'P'), "P")?,
            drive,
            peak: drive + peak_offset,
            inward: if peak_offset > 0.0 { 1.0 } else { -1.0 },
            start,
            end,
            first_depth,
            full_depth,
            exponent: 1.0 / degression,
            slide: forward * math::tangent(word(b'Q')),
            entry: signed(matches!(tapered, 1 | 3)),
            exit: signed(tapered == 2 || tapered == 3 && !planted(PlantedFault::BothIsEntry)),
            pass: 0,
            depth: 0.0,
            springs,
            at: PassStep::Back,
        };
        threading.deepen();
        Ok(threading)
    }

    /// Performs the next part of a thread; whether the thread is over then.
    pub(super) fn pass<K: Sink>(
        &mut self,
        thread: &mut Threading,
        line: u32,
        sink: &mut K,
    ) -> Result<bool, Refusal> {
        let Threading { drive, start, end, entry, exit, depth, .. } = *thread;
        let offset = depth * thread.slide;
        let before_end = if self.choices.thread_end_with_depth {
            (thread.full_depth - depth) * thread.slide
        } else {
            0.0
        };
        let (begin, finish) = (start + offset, end - before_end);
        // The tapers are as steep as the last pass needs them to be.
        let shallow = thread.x(depth - thread.full_depth);
        let at = self.position;
        let point = |x, z| at.with_axis(Axis::X, x).with_axis(Axis::Z, z);
        let (enters, exits) = (entry.abs() > 0.0, exit.abs() > 0.0);
        match thread.at {
            PassStep::Back if at == point(drive, begin) => {}
            PassStep::Back => self.traverse_to(line, point(drive, begin), sink)?,
            PassStep::In if enters => {}
            PassStep::In => self.traverse_to(line, point(thread.x(depth), begin), sink)?,
            PassStep::Synchronise => {
                let pitch = if enters { thread.slanting(entry) } else { thread.pitch };
                self.synchronise(line, thread.spindle, pitch, sink)?;
            }
            PassStep::ToTaper if enters => self.feed_to(line, point(shallow, begin), sink)?,
            PassStep::Taper if enters => {
                self.feed_to(line, point(thread.x(depth), begin + entry), sink)?;
            }
            PassStep::Straighten if enters => {
                self.synchronise(line, thread.spindle, thread.pitch, sink)?;
            }
            PassStep::Cut => self.feed_to(line, point(thread.x(depth), finish - exit), sink)?,
            PassStep::Slant if exits => {
                self.synchronise(line, thread.spindle, thread.slanting(exit), sink)?;
            }
            PassStep::TaperOut if exits => self.feed_to(line, point(shallow, finish), sink)?,
            PassStep::ToTaper
            | PassStep::Taper
            | PassStep::Straighten
            | PassStep::Slant
            | PassStep::TaperOut => {}
            PassStep::Release => {
                self.perform(line, &Effect::StopSpindleSynchronisation {}, sink)?;
            }
            PassStep::Out => self.traverse_to(line, point(drive, finish), sink)?,
            PassStep::Last if at == point(drive, end) => {}
            PassStep::Last => self.traverse_to(line, point(drive, end), sink)?,
        }
        Ok(thread.advance())
    }
}
