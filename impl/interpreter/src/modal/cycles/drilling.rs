//! A canned cycle as a list: which move, dwell or switch comes next.

use gaugeblock_vocabulary::{PathControlMode, SpindleTurn, Switch};

use crate::faults::{PlantedFault, planted};
use crate::math;

use super::super::choices::Choices;
use super::super::modes::Spindles;
use super::super::polar::Polar;
use super::super::refusal::Refusal;
use super::plane_axes::PlaneAxes;

/// One move, dwell or switch of a cycle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum CycleMove {
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
    /// The selected spindle is set to this.
    Turn(SpindleTurn),
    /// The selected spindle does again what it did before the cycle.
    TurnAgain,
    /// Feed and speed overrides are disabled.
    OverridesOff,
    /// Overrides are as they were before the cycle.
    OverridesBack,
}

/// The moves of one repeat, after [`CycleMove::Across`] and [`CycleMove::Approach`] (11.5.43.6).
const fn moves(code: u16) -> &'static [CycleMove] {
    use CycleMove::{
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

/// The moves of G86 with a planted fault.
static STOPPED_EARLY: [CycleMove; 5] = [
    CycleMove::Drill,
    CycleMove::Turn(SpindleTurn::Stopped),
    CycleMove::Dwell,
    CycleMove::RapidOut,
    CycleMove::TurnAgain,
];

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

/// From a hole to the next.
#[derive(Clone, Copy, Debug)]
pub(super) enum Step {
    /// By so much along the plane's first and second axis.
    By([f64; 2]),
    /// By polar words of an incremental move, each time from the hole before (11.4.12, 11.5.43.3).
    Polar(Polar),
}

impl Step {
    /// The hole after this one.
    fn from(self, [first, second]: [f64; 2]) -> Result<[f64; 2], Refusal> {
        match self {
            Self::By([by_first, by_second]) => Ok([first + by_first, second + by_second]),
            Self::Polar(polar) => polar.after([first, second]),
        }
    }
}

/// A cycle in numbers: its points, and the state that it finds.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cycle {
    pub(super) axes: PlaneAxes,
    /// The hole along the plane's first and second axis.
    pub(super) hole: [f64; 2],
    pub(super) step: Step,
    pub(super) levels: Levels,
    /// Seconds.
    pub(super) dwell: f64,
    /// Whether a dwell of no seconds is one.
    pub(super) dwells: bool,
    /// The path control mode before the cycle.
    pub(super) path: PathControlMode,
    /// Depth of a peck.
    pub(super) increment: f64,
    /// The selected spindle.
    pub(super) spindle: Spindles,
    /// Its state before the cycle.
    pub(super) turn: SpindleTurn,
    /// The feed override, and the speed override of the selected spindle, as they were.
    pub(super) overrides: (Switch, Switch),
}

/// A cycle under way.
#[derive(Clone, Copy, Debug)]
pub(super) struct Drilling {
    pub(super) cycle: Cycle,
    /// Moves of one repeat.
    moves: &'static [CycleMove],
    /// How many holes are left, with this one.
    repeats: u64,
    /// The next move of this hole.
    pub(super) at: At,
    /// Pecks that were made in this hole.
    pecks: u64,
    /// Where in a peck.
    peck: Peck,
    /// The level of the last peck, where rounding errors add up (quirk rs274.peck-rounding).
    level: Option<f64>,
}

/// The place in a repeat.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum At {
    /// The rapid move to the R plane that is made once, where the point is below (11.5.43.6).
    Preliminary,
    Across,
    Approach,
    /// A place in the list of moves.
    CycleMove(usize),
}

/// The next move of a peck.
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
    /// A cycle of a code, before its first move. Whether G85 feeds all the way out is a choice: then it moves as G89
    /// does, without the dwell.
    pub(super) fn new(code: u16, cycle: Cycle, repeats: u64, choices: &Choices) -> Self {
        let early = code == 860 && planted(PlantedFault::StopBeforeDwell);
        let moves: &'static [CycleMove] = match code {
            850 if choices.bore_feeds_out => &[CycleMove::Drill, CycleMove::FeedOut],
            _ if early => &STOPPED_EARLY,
            _ => moves(code),
        };
        Self { cycle, moves, repeats, at: At::Preliminary, pecks: 0, peck: Peck::Down, level: None }
    }

    /// With pecks whose rounding errors add up.
    pub(super) fn emulating_rs274(mut self) -> Self {
        self.level = Some(self.cycle.levels.retract);
        self
    }

    /// The next move; none where the cycle is over.
    pub(super) fn next(&self) -> Option<CycleMove> {
        match self.at {
            At::Preliminary | At::Approach => Some(CycleMove::Approach),
            At::Across => Some(CycleMove::Across),
            At::CycleMove(place) => self.moves.get(place).copied(),
        }
    }

    /// Continues after a move; whether the cycle is over then. The next hole of polar words may not exist.
    pub(super) fn advance(&mut self) -> Result<bool, Refusal> {
        self.at = match self.at {
            At::Preliminary => At::Across,
            At::Across => At::Approach,
            At::Approach => At::CycleMove(0),
            At::CycleMove(place) => At::CycleMove(place.saturating_add(1)),
        };
        if self.next().is_some() {
            return Ok(false);
        }
        self.at = At::Across;
        self.pecks = 0;
        self.level = self.level.map(|_| self.cycle.levels.retract);
        self.repeats = self.repeats.saturating_sub(1);
        if self.repeats == 0 {
            return Ok(true);
        }
        self.cycle.hole = self.cycle.step.from(self.cycle.hole)?;
        Ok(false)
    }

    /// The bottom of the hole after its pecks; the hole's own bottom where they reach it, up to a rounding error.
    fn depth(&self) -> f64 {
        let Levels { retract, bottom, .. } = self.cycle.levels;
        if let Some(level) = self.level {
            return level.max(bottom);
        }
        let depth = retract - math::from_u64(self.pecks) * self.cycle.increment;
        let rounding = self.cycle.increment * 1e-9;
        if depth > bottom + rounding && !planted(PlantedFault::NoPecks) { depth } else { bottom }
    }

    /// The level of a peck's next move and whether it is a feed move; whether the hole is done then.
    ///
    /// Whether it goes out to the clear level is a choice.
    pub(super) fn next_peck(
        &mut self,
        breaking: bool,
        clearance: f64,
        to_clear: bool,
    ) -> (f64, bool, bool) {
        match self.peck {
            Peck::Down => {
                self.pecks = self.pecks.saturating_add(1);
                self.level = self.level.map(|level| level - self.cycle.increment);
                let depth = self.depth();
                let done = depth <= self.cycle.levels.bottom;
                if !done {
                    self.peck = if breaking { Peck::Back } else { Peck::Out };
                }
                (depth, true, done)
            }
            Peck::Out => {
                let again = planted(PlantedFault::PeckFromR);
                self.peck = if again { Peck::Down } else { Peck::Back };
                let Levels { retract, clear, .. } = self.cycle.levels;
                let out =
                    if to_clear || planted(PlantedFault::PeckToClear) { clear } else { retract };
                (out, false, false)
            }
            Peck::Back => {
                self.peck = Peck::Down;
                (self.depth() + clearance, false, false)
            }
        }
    }
}
