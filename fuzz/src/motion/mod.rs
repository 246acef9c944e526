//! Motion programs: moves, the machine that makes them, and the operator's actions meanwhile.
//!
//! A [`MotionProgram`] is numbers, so that it can be [drawn at random](draw), [transformed](transformation) and
//! [shrunk](shrink); [`MotionProgram::text`] is the program that a controller gets. The caller plans it and judges the
//! samples.

pub mod draw;
pub mod shrink;
pub mod transformation;

use std::fmt::Write as _;

use gaugeblock_vocabulary::Position;
use gaugeblock_vocabulary::motion::{MotionAction, MotionLimits, MotionScript, PathMode};

/// Values of the nine axes, in their order.
pub type Axes = [f64; 9];

/// A program of moves, with its machine and operator.
#[derive(Clone, Debug, PartialEq)]
pub struct MotionProgram {
    /// The start position, in machine coordinates, which are also program coordinates.
    pub start: Axes,
    /// The plane of all arcs.
    pub plane: Plane,
    /// What the program does.
    pub steps: Vec<Step>,
    /// What the machine can do.
    pub limits: MotionLimits,
    /// What the operator and the inputs do.
    pub script: MotionScript,
    /// Servo cycles between two segments that the planner gets; `None` for as many segments as it accepts.
    pub every: Option<u32>,
}

/// A plane and so the axis about which arcs go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// G17.
    Xy,
    /// G18.
    Zx,
    /// G19.
    Yz,
}

impl Plane {
    /// Its first and second axis, so that a turn from the first to the second is counterclockwise.
    pub fn axes(self) -> [usize; 2] {
        match self {
            Self::Xy => [0, 1],
            Self::Zx => [2, 0],
            Self::Yz => [1, 2],
        }
    }
}

/// How fast feed moves are.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Pace {
    /// G94: millimetres or degrees per minute.
    PerMinute(f64),
    /// G93: so many such moves a minute.
    PerMove(f64),
    /// G95: millimetres or degrees per turn.
    PerTurn(f64),
}

/// A block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// G61, G61.1, G64.
    Mode(PathMode),
    /// G93, G94, G95, F.
    Pace(Pace),
    /// G0 to a point.
    Rapid(Axes),
    /// G1 to a point.
    Line(Axes),
    /// G2, G3 in the plane.
    Arc {
        /// Where it ends.
        end: Axes,
        /// From the start to the centre, along the first and the second axis of the plane.
        centre: [f64; 2],
        /// G2.
        clockwise: bool,
        /// P, 1 and up.
        turns: u32,
    },
    /// G4, seconds.
    Dwell(f64),
    /// M62, M63 or M64, M65.
    Output {
        /// Which.
        number: u32,
        /// Its value.
        on: bool,
        /// Whether it waits for the next move.
        with_motion: bool,
    },
}

impl Step {
    /// Where it ends, if it moves.
    pub fn end(&self) -> Option<&Axes> {
        match self {
            Self::Rapid(end) | Self::Line(end) | Self::Arc { end, .. } => Some(end),
            Self::Mode(_) | Self::Pace(_) | Self::Dwell(_) | Self::Output { .. } => None,
        }
    }

    /// The same, to be changed.
    pub fn end_mut(&mut self) -> Option<&mut Axes> {
        match self {
            Self::Rapid(end) | Self::Line(end) | Self::Arc { end, .. } => Some(end),
            Self::Mode(_) | Self::Pace(_) | Self::Dwell(_) | Self::Output { .. } => None,
        }
    }
}

const LETTERS: [char; 9] = ['x', 'y', 'z', 'a', 'b', 'c', 'u', 'v', 'w'];
const OFFSETS: [char; 3] = ['i', 'j', 'k'];

impl MotionProgram {
    /// The start position.
    pub fn position(&self) -> Position {
        Position::from(self.start)
    }

    /// The program, a block a step.
    pub fn text(&self) -> String {
        let plane = match self.plane {
            Plane::Xy => "g17",
            Plane::Zx => "g18",
            Plane::Yz => "g19",
        };
        let mut text = format!("g21 g90 g91.1 {plane}\n");
        if self.script.events.iter().any(|e| matches!(e.action, MotionAction::AdaptiveFeed(_))) {
            text.push_str("m52 p1\n");
        }
        if self.steps.iter().any(|step| matches!(step, Step::Pace(Pace::PerTurn(_)))) {
            let turns = self.turns().unwrap_or(10.0);
            let _infallible = writeln!(text, "s{} m3", number(60.0 * turns));
        }
        let (mut here, mut per_move) = (self.start, None);
        for step in &self.steps {
            self.write(&mut text, step, &here, &mut per_move);
            here = step.end().copied().unwrap_or(here);
        }
        text.push_str("m2\n");
        text
    }

    /// Turns per second of the spindle from the beginning on, where the script says so.
    fn turns(&self) -> Option<f64> {
        self.script.events.iter().find_map(|event| match event.action {
            MotionAction::SpindleSpeed { spindle: 0, turns } => Some(turns),
            MotionAction::SpindleSpeed { .. }
            | MotionAction::FeedOverride(_)
            | MotionAction::RapidOverride(_)
            | MotionAction::AdaptiveFeed(_)
            | MotionAction::FeedStop(_)
            | MotionAction::Hold(_)
            | MotionAction::Abort => None,
        })
    }

    fn write(&self, text: &mut String, step: &Step, here: &Axes, per_move: &mut Option<f64>) {
        let feed = per_move.map_or(String::new(), |feed| format!(" f{}", number(feed)));
        let block = match step {
            Step::Mode(PathMode::ExactStop) => "g61.1".to_owned(),
            Step::Mode(PathMode::ExactPath) => "g61".to_owned(),
            Step::Mode(PathMode::BetweenMidpoints) => "g64".to_owned(),
            Step::Mode(PathMode::Within { tolerance, .. }) => {
                format!("g64 p{}", number(*tolerance))
            }
            Step::Pace(pace) => {
                *per_move = if let Pace::PerMove(feed) = pace { Some(*feed) } else { None };
                match pace {
                    Pace::PerMinute(feed) => format!("g94 f{}", number(*feed)),
                    Pace::PerMove(_) => "g93".to_owned(),
                    Pace::PerTurn(feed) => format!("g95 f{}", number(*feed)),
                }
            }
            Step::Rapid(end) => format!("g0{}", words(here, end)),
            Step::Line(end) => format!("g1{}{feed}", words(here, end)),
            Step::Arc { end, centre, clockwise, turns } => {
                let code = if *clockwise { "g2" } else { "g3" };
                let [first, second] = self.plane.axes();
                let mut block = format!("{code}{}", words(here, end));
                // An arc names its end, also where that is where it begins.
                for axis in [first, second] {
                    if !block.contains(LETTERS[axis]) {
                        let _infallible = write!(block, " {}{}", LETTERS[axis], number(end[axis]));
                    }
                }
                for (axis, offset) in [first, second].into_iter().zip(centre) {
                    let _infallible = write!(block, " {}{}", OFFSETS[axis], number(*offset));
                }
                if *turns > 1 {
                    let _infallible = write!(block, " p{turns}");
                }
                block + &feed
            }
            Step::Dwell(seconds) => format!("g4 p{}", number(*seconds)),
            Step::Output { number, on, with_motion } => {
                let code = match (with_motion, on) {
                    (true, true) => "m62",
                    (true, false) => "m63",
                    (false, true) => "m64",
                    (false, false) => "m65",
                };
                format!("{code} p{number}")
            }
        };
        text.push_str(&block);
        text.push('\n');
    }
}

/// Words for the axes that move; X where none does.
fn words(here: &Axes, end: &Axes) -> String {
    let mut words = String::new();
    for ((letter, from), to) in LETTERS.iter().zip(here).zip(end) {
        if from.to_bits() != to.to_bits() {
            let _infallible = write!(words, " {letter}{}", number(*to));
        }
    }
    if words.is_empty() { format!(" x{}", number(end[0])) } else { words }
}

/// A number as a program has it, so that it is read back as it was.
fn number(value: f64) -> String {
    format!("{value}")
}
