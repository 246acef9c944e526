//! A block of words: their values, the codes reported, effects in order, and the call after them.

use gaugeblock_vocabulary::{Axis, Distance, Effect, FaultKind, Motion};

use super::calls::is_call;
use super::codes::Codes;
use super::program::{Stop, refuse};
use super::run::{Flow, Runner};
use crate::faults::{PlantedFault, planted};
use crate::index_range::IndexRange;
use crate::math;
use crate::modal::Coordinates;

/// Letters that stand for the nine axes, in their order.
const AXES: [u8; 9] = *b"XYZABCUVW";

/// The words of a block by letter.
#[derive(Clone, Copy, Debug)]
pub(super) struct Letters {
    values: [f64; 26],
    /// A bit for each letter of the block.
    present: u32,
}

impl Letters {
    /// The bits of some letters.
    pub(super) fn bits(letters: &[u8]) -> u32 {
        letters.iter().fold(0, |bits, letter| bits | bit(*letter))
    }

    pub(super) fn has(&self, bits: u32) -> bool {
        self.present & bits != 0
    }

    pub(super) fn get(&self, letter: u8) -> Option<f64> {
        let value = self.values.get(usize::from(letter.wrapping_sub(b'A'))).copied();
        value.filter(|_| self.has(bit(letter)))
    }

    fn put(&mut self, letter: u8, value: f64) {
        if let Some(slot) = self.values.get_mut(usize::from(letter.wrapping_sub(b'A'))) {
            *slot = value;
            self.present |= bit(letter);
        }
    }
}

fn bit(letter: u8) -> u32 {
    1_u32.wrapping_shl(u32::from(letter.wrapping_sub(b'A')))
}

impl Runner {
    /// A block of words.
    pub(super) fn words(&mut self, words: IndexRange) -> Result<Flow, Stop> {
        self.evaluate(words)?;
        self.tell_g()?;
        if self.g.iter().any(|code| is_call(*code)) {
            return self.call_block();
        }
        self.tell_m()?;
        let by_block = self.modal_calls.first().is_some_and(|call| call.by_block);
        if by_block
            && !self.words.is_empty()
            && !self.m.contains(&99)
            && let Some(call) = self.reached()?
        {
            if planted(PlantedFault::BlockExecutedToo) {
                self.execute()?;
            }
            self.take_as_arguments(call)?;
            return Ok(Flow::On);
        }
        self.execute()
    }

    /// The words that have a value, from the left.
    fn evaluate(&mut self, words: IndexRange) -> Result<(), Stop> {
        let mut valued = core::mem::take(&mut self.words);
        valued.clear();
        for place in words.from..words.to {
            let Some(word) = self.code.words.get(place).copied() else { break };
            let (evaluator, stack) = self.evaluator();
            match evaluator.value(word.value, stack)? {
                Some(value) => valued.push((word.letter, value + 0.0)),
                None if planted(PlantedFault::VacantWordZero) => valued.push((word.letter, 0.0)),
                None => {}
            }
        }
        self.words = valued;
        Ok(())
    }

    /// G codes to a tenth, from 0 to 99.9.
    fn tell_g(&mut self) -> Result<(), Stop> {
        self.g.clear();
        for (_, value) in self.words.iter().filter(|(letter, _)| *letter == b'G') {
            self.g.push(code(value * 10.0)?);
        }
        Ok(())
    }

    /// M codes, from 0 to 999.
    fn tell_m(&mut self) -> Result<(), Stop> {
        self.m.clear();
        for (_, value) in self.words.iter().filter(|(letter, _)| *letter == b'M') {
            self.m.push(code(if planted(PlantedFault::CodeCut) {
                math::floor(*value)
            } else {
                *value
            })?);
        }
        Ok(())
    }

    /// Executes the block: codes, letters, F, S and T, M6, G4, the motion, and what ends the program or calls another.
    fn execute(&mut self) -> Result<Flow, Stop> {
        let codes = self.codes()?;
        let letters = self.letters(&codes)?;
        self.feed_speed_tool(&letters)?;
        if codes.changes_tool {
            self.effects.push(Effect::ChangeTool { tool: self.tool });
        }
        if codes.dwells {
            self.dwell(&letters)?;
        }
        let follows = if letters.has(self.moving()) {
            self.move_by(&letters)?;
            if self.modal_calls.first().is_some_and(|call| !call.by_block) {
                self.reached()?
            } else {
                None
            }
        } else {
            None
        };
        if follows.is_some() && codes.end.is_some() {
            let why = "M2, M30, M98 or M99 in a block that moves and calls modally";
            return Err(Stop::Open(why));
        }
        self.follows = match follows {
            Some(_) if planted(PlantedFault::OldestFirst) => Some(0),
            follows => follows,
        };
        match codes.end {
            None => Ok(Flow::On),
            Some(98) => {
                self.call_sub(letters.get(b'P'), letters.get(b'L'))?;
                Ok(Flow::On)
            }
            Some(99) => self.end_call(letters.get(b'P')),
            Some(_) => {
                self.effects.push(Effect::ProgramEnd {});
                Ok(Flow::ProgramEnd)
            }
        }
    }

    /// Every letter except G and M occurs once, and something uses it.
    fn letters(&self, codes: &Codes) -> Result<Letters, Stop> {
        let is_arc = self.is_arc();
        let calls = matches!(codes.end, Some(98 | 99));
        let mut letters = Letters { values: [0.0; 26], present: 0 };
        for (letter, value) in &self.words {
            let is_used = match letter {
                b'G' | b'M' => continue,
                b'F' | b'S' | b'T' => true,
                b'P' => codes.dwells || calls,
                b'L' => codes.end == Some(98),
                b'I' | b'J' | b'K' | b'R' => is_arc,
                _ => AXES.contains(letter),
            };
            if letters.get(*letter).is_some() {
                return refuse(FaultKind::RepeatedWord, "a letter occurs twice");
            }
            if !is_used {
                return refuse(FaultKind::UnusedWord, "nothing in the block uses a letter");
            }
            if *letter == b'P' && codes.dwells && calls {
                return Err(Stop::Open("two codes that use P"));
            }
            letters.put(*letter, *value);
        }
        Ok(letters)
    }

    fn feed_speed_tool(&mut self, letters: &Letters) -> Result<(), Stop> {
        let not_negative = |letter| match letters.get(letter) {
            Some(value) if value < 0.0 => refuse(FaultKind::WordOutOfRange, "F or S below zero"),
            value => Ok(value),
        };
        if let Some(feed) = not_negative(b'F')? {
            self.modes.feed = feed;
        }
        if let Some(speed) = not_negative(b'S')? {
            self.modes.speed = speed;
        }
        if let Some(value) = letters.get(b'T') {
            let tool = math::whole(math::round_away(value)).filter(|tool| *tool >= 0);
            let Some(tool) = tool.and_then(|tool| i32::try_from(tool).ok()) else {
                return refuse(FaultKind::WordOutOfRange, "T is not a tool number");
            };
            self.tool = tool;
            self.effects.push(Effect::PrepareTool { tool });
        }
        Ok(())
    }

    fn dwell(&mut self, letters: &Letters) -> Result<(), Stop> {
        let Some(time) = letters.get(b'P') else {
            return refuse(FaultKind::MissingWord, "G4 without P");
        };
        if time < 0.0 {
            return refuse(FaultKind::WordOutOfRange, "a dwell below zero");
        }
        let seconds = if self.choices.milliseconds { time / 1000.0 } else { time };
        self.effects.push(Effect::Dwell { seconds });
        Ok(())
    }

    pub(super) fn is_arc(&self) -> bool {
        matches!(self.motion, Motion::ArcClockwise | Motion::ArcCounterclockwise)
    }

    /// The bits of the letters that make a block move.
    fn moving(&self) -> u32 {
        let axes = Letters::bits(&AXES);
        if self.is_arc() { axes | Letters::bits(b"IJKR") } else { axes }
    }

    /// A motion in the mode that is in force.
    fn move_by(&mut self, letters: &Letters) -> Result<(), Stop> {
        let start = self.position;
        let end = self.target(letters)?;
        if self.motion == Motion::None {
            return Err(Stop::Open("axis words before G0 to G3"));
        }
        if self.motion != Motion::Traverse && self.modes.feed <= 0.0 {
            return Err(Stop::Open("a move by G1 to G3 without a feed"));
        }
        self.position = end;
        let end = end.position();
        let effect = if self.motion == Motion::Traverse {
            Effect::StraightTraverse { end }
        } else if self.is_arc() {
            self.arc(letters, start)?
        } else {
            Effect::StraightFeed { end }
        };
        self.effects.push(effect);
        Ok(())
    }

    /// The end point of the axis words.
    fn target(&self, letters: &Letters) -> Result<Coordinates, Stop> {
        let mut end = self.position;
        for (axis, letter) in Axis::ALL.iter().zip(AXES) {
            let Some(value) = letters.get(letter) else { continue };
            if self.axes.get(axis.place()) != Some(&true) {
                return refuse(FaultKind::NoSuchAxis, "an axis that the machine lacks");
            }
            let coordinate = match self.modes.distance {
                Distance::Absolute => value,
                Distance::Incremental => end.coordinate_of(*axis) + value,
            };
            if !coordinate.is_finite() {
                return refuse(FaultKind::OutOfDomain, "a coordinate that is too large");
            }
            end = end.with_axis(*axis, coordinate + 0.0);
        }
        Ok(end)
    }
}

/// A code, of up to three digits.
fn code(value: f64) -> Result<u16, Stop> {
    let whole = math::whole(math::round_away(value)).and_then(|code| u16::try_from(code).ok());
    match whole.filter(|code| *code <= 999) {
        Some(code) => Ok(code),
        None => refuse(FaultKind::WordOutOfRange, "there is no such code"),
    }
}
