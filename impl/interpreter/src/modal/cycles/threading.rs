//! G76: a thread in passes (11.5.42).
//!
//! The drive line is where the X axis is at the start, and goes along Z. A pass goes from the drive line to its
//! depth, along the thread in step with the spindle, and back to the drive line.

use crate::math;

/// A thread under way. Lengths along Z that have a sign point from the start to the end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Threading {
    /// Spindle number.
    pub(super) spindle: u32,
    /// P, length unit per revolution.
    pub(super) pitch: f64,
    /// X of the drive line.
    pub(super) drive: f64,
    /// X of the thread's peak.
    pub(super) peak: f64,
    /// 1 where depth goes towards greater X: an internal thread.
    pub(super) inward: f64,
    /// Z of the start and of the end.
    pub(super) start: f64,
    pub(super) end: f64,
    /// J.
    pub(super) first_depth: f64,
    /// K.
    pub(super) full_depth: f64,
    /// One divided by R.
    pub(super) exponent: f64,
    /// How far along the drive line a pass is moved for each unit of depth; signed.
    pub(super) slide: f64,
    /// E where the entry or the exit is tapered, else zero; signed.
    pub(super) entry: f64,
    pub(super) exit: f64,
    /// This pass, from 1.
    pub(super) pass: u64,
    /// Depth of this pass.
    pub(super) depth: f64,
    /// Spring passes left.
    pub(super) springs: u32,
    pub(super) at: PassStep,
}

/// The parts of a pass.
#[derive(Clone, Copy, Debug)]
pub(super) enum PassStep {
    /// Along the drive line to where the pass begins.
    Back,
    /// To the depth, or with a tapered entry to the start of synchronisation.
    In,
    /// Synchronisation begins.
    Synchronise,
    /// To the beginning of the entry's taper, and along it.
    ToTaper,
    Taper,
    /// Synchronisation along the thread, after a tapered entry.
    Straighten,
    /// Along the thread.
    Cut,
    /// Synchronisation along the exit's taper.
    Slant,
    /// Along the exit's taper.
    TaperOut,
    /// Synchronisation ends.
    Release,
    /// To the drive line.
    Out,
    /// To the end of the drive line, after the last pass.
    Last,
}

impl Threading {
    /// X at a depth below the peak.
    pub(super) fn x(&self, depth: f64) -> f64 {
        self.peak + self.inward * depth
    }

    /// The way per revolution along a taper: P of it along the drive line, as everywhere.
    pub(super) fn slanting(&self, taper: f64) -> f64 {
        self.pitch * math::hypotenuse(self.full_depth, taper) / taper.abs()
    }

    /// Continues after a part; whether the thread is over then.
    pub(super) fn advance(&mut self) -> bool {
        self.at = match self.at {
            PassStep::Back => PassStep::In,
            PassStep::In => PassStep::Synchronise,
            PassStep::Synchronise => PassStep::ToTaper,
            PassStep::ToTaper => PassStep::Taper,
            PassStep::Taper => PassStep::Straighten,
            PassStep::Straighten => PassStep::Cut,
            PassStep::Cut => PassStep::Slant,
            PassStep::Slant => PassStep::TaperOut,
            PassStep::TaperOut => PassStep::Release,
            PassStep::Release => PassStep::Out,
            PassStep::Out if self.is_last() => PassStep::Last,
            PassStep::Out => {
                self.deepen();
                PassStep::Back
            }
            PassStep::Last => return true,
        };
        false
    }

    /// Whether this pass is at full depth, and no spring pass is left.
    fn is_last(&self) -> bool {
        self.depth >= self.full_depth && self.springs == 0
    }

    /// The next pass: J times the root of its number, up to K; then the spring passes.
    pub(super) fn deepen(&mut self) {
        if self.depth >= self.full_depth {
            self.springs = self.springs.saturating_sub(1);
            return;
        }
        self.pass = self.pass.saturating_add(1);
        let depth = self.first_depth * math::power(math::from_u64(self.pass), self.exponent);
        let rounding = self.full_depth * 1e-9;
        self.depth = if depth < self.full_depth - rounding { depth } else { self.full_depth };
    }
}
