//! A canned cycle as strokes: one move, dwell or switch at a time.

use gaugeblock_vocabulary::{Effect, LengthUnit, SpindleTurn, Switch};

use crate::canon::Sink;
use crate::faults::{Fault, planted};
use crate::math;

use super::super::Modal;
use super::super::refusal::Refusal;
use super::super::spindle::Spindles;
use super::PlaneAxes;

/// A part of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Stroke {
    /// A rapid move to where the hole is, at the level at which the point is.
    Across,
    /// A rapid move to the R plane, where the point is not there already.
    Approach,
    /// A feed move to the bottom.
    Drill,
    /// Feed moves to the bottom, an increment at a time, each but the last followed by a short rapid move up.
    DrillBreaking,
    /// Feed moves to the bottom, an increment at a time, each but the last followed by a rapid move to the R plane
    /// and back.
    DrillPecking,
    /// P seconds.
    Dwell,
    /// A rapid move to the clear level.
    RapidOut,
    /// A feed move to the clear level.
    FeedOut,
    /// A feed move to the R plane.
    FeedToRetract,
    /// The selected spindle is told to do this.
    Turn(SpindleTurn),
    /// The selected spindle does again what it did before the cycle.
    TurnAgain,
    /// Feed and speed overrides are disabled.
    OverridesOff,
    /// Overrides are as they were before the cycle.
    OverridesBack,
}

/// The strokes of one go-around, behind [`Stroke::Across`] and [`Stroke::Approach`] (11.5.43.6).
const fn strokes(code: u16) -> &'static [Stroke] {
    use Stroke::{
        Drill, DrillBreaking, DrillPecking, Dwell, FeedOut, FeedToRetract, OverridesBack,
        OverridesOff, RapidOut, Turn, TurnAgain,
    };
    const CW: SpindleTurn = SpindleTurn::Clockwise;
    const CCW: SpindleTurn = SpindleTurn::Counterclockwise;
    const STOP: SpindleTurn = SpindleTurn::Stopped;
    match code {
        // 11.5.40 names the R position; 11.5.43.4 and 11.5.61 the clear level.
        730 => &[DrillBreaking, RapidOut],
        740 => &[OverridesOff, Drill, Turn(STOP), Turn(CW), Dwell, FeedOut, OverridesBack],
        820 => &[Drill, Dwell, RapidOut],
        830 => &[DrillPecking, RapidOut],
        // 11.5.48 does not turn the spindle back.
        840 => &[OverridesOff, Drill, Turn(STOP), Turn(CCW), Dwell, FeedOut, OverridesBack],
        // 11.5.49 feeds out to R only "if it is lower than the initial Z"; the cycle is called "feed out".
        850 => &[Drill, FeedToRetract, RapidOut],
        860 => &[Drill, Dwell, Turn(STOP), RapidOut, TurnAgain],
        890 => &[Drill, Dwell, FeedOut],
        _ => &[Drill, RapidOut],
    }
}

/// Levels of a cycle: coordinates of the plane's normal axis.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Levels {
    /// R.
    pub(super) retract: f64,
    /// Z.
    pub(super) bottom: f64,
    /// Where the cycle ends (11.5.43.4).
    pub(super) clear: f64,
}

/// A cycle in numbers: where it goes and what it finds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cycle {
    pub(super) axes: PlaneAxes,
    /// The hole along the plane's first and second axis.
    pub(super) hole: [f64; 2],
    /// From a hole to the next.
    pub(super) step: [f64; 2],
    pub(super) levels: Levels,
    /// Seconds.
    pub(super) dwell: f64,
    /// Depth of a peck.
    pub(super) increment: f64,
    /// The selected spindle.
    pub(super) spindle: Spindles,
    /// What it was doing.
    pub(super) turn: SpindleTurn,
    /// The feed override, and the speed override of the selected spindle, as they were.
    pub(super) overrides: (Switch, Switch),
}

/// A cycle under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drilling {
    cycle: Cycle,
    /// Strokes of one go-around.
    strokes: &'static [Stroke],
    /// How many holes are left, with this one.
    repeats: u64,
    /// The next stroke of this one.
    at: At,
    /// Pecks that were made in this hole.
    pecks: u64,
    /// Where in a peck.
    peck: Peck,
}

/// Where in a go-around.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum At {
    /// The rapid move to the R plane that is made once, where the point is below (11.5.43.6).
    Preliminary,
    Across,
    Approach,
    /// A place among the strokes.
    Stroke(usize),
}

/// What comes next in a peck.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Peck {
    /// The feed move.
    Down,
    /// The rapid move out.
    Out,
    /// The rapid move to just above the hole's bottom.
    Back,
}

impl Drilling {
    /// A cycle of a code, before its first stroke.
    pub(super) fn new(code: u16, cycle: Cycle, repeats: u64) -> Self {
        Self {
            cycle,
            strokes: strokes(code),
            repeats,
            at: At::Preliminary,
            pecks: 0,
            peck: Peck::Down,
        }
    }

    /// The stroke that comes next, and none where the cycle is over.
    fn next(&self) -> Option<Stroke> {
        match self.at {
            At::Preliminary | At::Approach => Some(Stroke::Approach),
            At::Across => Some(Stroke::Across),
            At::Stroke(place) => self.strokes.get(place).copied(),
        }
    }

    /// Goes on behind a stroke; whether the cycle is over then.
    fn advance(&mut self) -> bool {
        self.at = match self.at {
            At::Preliminary => At::Across,
            At::Across => At::Approach,
            At::Approach => At::Stroke(0),
            At::Stroke(place) => At::Stroke(place.saturating_add(1)),
        };
        if self.next().is_some() {
            return false;
        }
        let ([first, second], [by_first, by_second]) = (self.cycle.hole, self.cycle.step);
        self.cycle.hole = [first + by_first, second + by_second];
        self.at = At::Across;
        self.pecks = 0;
        self.repeats = self.repeats.saturating_sub(1);
        self.repeats == 0
    }

    /// The bottom of the hole after so many pecks; the hole's own bottom where they reach it, up to a rounding error.
    fn depth_after(&self, pecks: u64) -> f64 {
        let Levels { retract, bottom, .. } = self.cycle.levels;
        let depth = retract - math::from_u64(pecks) * self.cycle.increment;
        let rounding = self.cycle.increment * 1e-9;
        if depth > bottom + rounding && !planted(Fault::NoPecks) { depth } else { bottom }
    }

    /// Where the next stroke of a peck leads and whether it is a feed move; whether the hole is done then.
    fn next_peck(&mut self, breaking: bool, clearance: f64) -> (f64, bool, bool) {
        match self.peck {
            Peck::Down => {
                self.pecks = self.pecks.saturating_add(1);
                let depth = self.depth_after(self.pecks);
                let done = depth <= self.cycle.levels.bottom;
                if !done {
                    self.peck = if breaking { Peck::Back } else { Peck::Out };
                }
                (depth, true, done)
            }
            Peck::Out => {
                self.peck = Peck::Back;
                (self.cycle.levels.retract, false, false)
            }
            Peck::Back => {
                self.peck = Peck::Down;
                (self.depth_after(self.pecks) + clearance, false, false)
            }
        }
    }
}

impl Modal {
    /// Performs the next stroke of a cycle; whether the cycle is over then.
    pub(super) fn stroke<K: Sink>(
        &mut self,
        drilling: &mut Drilling,
        line: u32,
        sink: &mut K,
    ) -> Result<bool, Refusal> {
        let Some(stroke) = drilling.next() else { return Ok(true) };
        let cycle = drilling.cycle;
        let Levels { retract, bottom, clear } = cycle.levels;
        let normal = cycle.axes.normal;
        let level = self.position.of_axis(normal);
        let to = |modal: &Self, level| modal.position.with_axis(normal, level);
        match stroke {
            Stroke::Across => {
                let [first, second] = cycle.hole;
                let across = self.position.with_axis(cycle.axes.first, first);
                self.traverse_to(line, across.with_axis(cycle.axes.second, second), sink)?;
            }
            Stroke::Approach => {
                let once = drilling.at == At::Preliminary;
                if level < retract || !once && level > retract {
                    self.traverse_to(line, to(self, retract), sink)?;
                }
            }
            Stroke::Drill => self.feed_to(line, to(self, bottom), sink)?,
            Stroke::DrillBreaking | Stroke::DrillPecking => {
                let clearance = self.peck_clearance();
                let breaking = stroke == Stroke::DrillBreaking;
                let (level, feeds, done) = drilling.next_peck(breaking, clearance);
                if feeds {
                    self.feed_to(line, to(self, level), sink)?;
                } else {
                    self.traverse_to(line, to(self, level), sink)?;
                }
                if !done {
                    return Ok(false);
                }
            }
            Stroke::Dwell => {
                self.perform(line, &Effect::Dwell { seconds: cycle.dwell }, sink)?;
            }
            Stroke::RapidOut => self.traverse_to(line, to(self, clear), sink)?,
            Stroke::FeedOut => self.feed_to(line, to(self, clear), sink)?,
            Stroke::FeedToRetract => self.feed_to(line, to(self, retract), sink)?,
            Stroke::Turn(turn) => self.turn(cycle.spindle, turn, line, sink),
            Stroke::TurnAgain if planted(Fault::SpindleStays) => {}
            Stroke::TurnAgain => self.turn(cycle.spindle, cycle.turn, line, sink),
            Stroke::OverridesOff => {
                self.set_overrides(cycle.spindle, (Switch::Off, Switch::Off));
            }
            Stroke::OverridesBack => {
                if self.choices.tap_turns_back {
                    self.turn(cycle.spindle, SpindleTurn::Stopped, line, sink);
                    self.turn(cycle.spindle, cycle.turn, line, sink);
                }
                self.restore_overrides(drilling);
            }
        }
        Ok(drilling.advance())
    }

    /// Tells spindles to turn; what the next stroke tells them has not been told yet.
    fn turn<K: Sink>(&mut self, which: Spindles, turn: SpindleTurn, line: u32, sink: &mut K) {
        self.for_spindles(which, |spindle| spindle.turn = turn);
        self.in_force.tell(line, sink);
    }

    /// Overrides as they were before the cycle.
    pub(super) fn restore_overrides(&mut self, drilling: &Drilling) {
        self.set_overrides(drilling.cycle.spindle, drilling.cycle.overrides);
    }

    /// .010 inch or 0.254 mm (11.5.40, 11.5.47), active length unit.
    fn peck_clearance(&self) -> f64 {
        match self.in_force.now().units {
            LengthUnit::Inch => 0.01,
            LengthUnit::Millimetre => 0.254,
        }
    }

    /// The feed override, and the speed override of a spindle.
    fn set_overrides(&mut self, spindle: Spindles, (feed, speed): (Switch, Switch)) {
        self.in_force.put(|modes| &mut modes.feed_override, feed);
        self.set_speed_override(spindle, speed);
    }
}
