//! Canonical calls as settings and effects of the vocabulary.
//!
//! Moves and the feed are read here, modes and offsets in `settings`, spindles and switches in `spindles`, the rest in
//! `effects`. Each passes on unknown calls; a call that none of them knows is an error.

mod effects;
mod settings;
mod spindles;
mod table;
mod tool_table;

use std::f64::consts::TAU;

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{
    Channel, Effect, Event, FeedMode, Machine, Plane, Position, Settings, SpindleTurn,
};

use super::output::Call;
use crate::instrumentation::checkpoint::Checkpoint;
use crate::instrumentation::lengths::Lengths;
use crate::instrumentation::source::{Form, code, form, plain_word};
use crate::instrumentation::state;

/// What a call means for the run.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Mark {
    /// It goes on.
    None,
    /// M2 or M30 was executed.
    ProgramEnd,
    /// The second percent sign was read.
    PercentEnd,
    /// Something that the output prints only in part.
    Unsupported(String),
}

/// Settings after the calls so far, and the events since they were last taken.
#[derive(Clone, Debug)]
pub(super) struct Canon {
    /// Settings in force.
    pub(super) now: Settings,
    /// Where the controlled point is, program coordinates.
    pub(super) position: Position,
    /// Tool in the spindle.
    pub(super) tool: i32,
    lengths: Lengths,
    table: table::Table,
    events: Vec<Event>,
    /// Speed of the next move under inverse time, which the calls show in place of F.
    speed: Option<f64>,
    /// Code of the block that is executed, for what the calls leave out.
    block: String,
}

/// Whether an effect is one of a comment.
fn is_said(effect: &Effect) -> bool {
    matches!(effect, Effect::Message { .. } | Effect::LogOpen { .. } | Effect::LogClose {})
}

type Done = Result<Mark, HarnessError>;

impl Canon {
    /// Nothing set yet.
    pub(super) fn new(machine: &Machine) -> Self {
        Self {
            now: Settings::default(),
            position: Position::default(),
            tool: 0,
            lengths: Lengths::default(),
            table: table::Table::new(machine),
            events: Vec::new(),
            speed: None,
            block: String::new(),
        }
    }

    /// Names the next block: the calls do not distinguish dynamic compensation from static, nor U, V and W planes from
    /// each other; the block does.
    pub(super) fn block(&mut self, line: &str) {
        self.block = code(line);
    }

    /// Whether the block's code has this word, or a letter of any word. An O-word is none.
    pub(super) fn has_word(&self, word: &str) -> bool {
        !matches!(form(&self.block), Form::Control | Form::Call) && self.block.contains(word)
    }

    /// Whether M19 has oriented a spindle that has not turned since.
    pub(super) fn has_oriented_spindle(&self) -> bool {
        let turns = self.now.spindle.iter().flat_map(|spindles| spindles.0.iter());
        turns.into_iter().any(|(_, turn)| *turn == SpindleTurn::Oriented)
    }

    /// The events since the last time.
    pub(super) fn take_events(&mut self) -> Vec<Event> {
        self.speed = None;
        std::mem::take(&mut self.events)
    }

    /// Where the controlled point is after the block. No call prints the end of a spline.
    pub(super) fn arrived(&mut self, position: Position) {
        for event in &mut self.events {
            if let Event::Do(Effect::NurbsFeed { end, .. }) = event {
                *end = position;
            }
        }
        self.position = position;
    }

    /// Whether a spline is among the events together with something that hides its end: what the caller knows of, or a
    /// tool change, after which the controller's point is what its memory held.
    pub(super) fn hides_spline(&self, is_hidden: bool) -> bool {
        let spline = |event: &Event| matches!(event, Event::Do(Effect::NurbsFeed { .. }));
        let change = |event: &Event| matches!(event, Event::Do(Effect::ChangeTool { .. }));
        self.events.iter().any(spline) && (is_hidden || self.events.iter().any(change))
    }

    /// Takes over a setting; an event only where it changes something.
    pub(super) fn set(&mut self, change: Settings) {
        state::set(&mut self.now, &mut self.events, &change);
    }

    /// Takes over settings whose calls wait, before the block changes the length unit.
    pub(super) fn set_waiting(&mut self, change: Settings, feed_mode: FeedMode) {
        if let Some(rate) = change.feed_rate {
            self.lengths.feed(rate, Some(feed_mode));
        }
        self.set(change);
    }

    /// Takes over the modes of a checkpoint.
    ///
    /// # Errors
    /// A mode that is not known.
    pub(super) fn settle(&mut self, checkpoint: &Checkpoint) -> Result<(), HarnessError> {
        let modes = state::modes(checkpoint, &self.now, &self.block)?;
        self.set(modes);
        self.lengths.precise_feed(checkpoint.number("_feed"));
        Ok(())
    }

    fn effect(&mut self, effect: Effect) -> Done {
        self.events.push(Event::Do(effect));
        Ok(Mark::None)
    }

    /// What the program printed.
    pub(super) fn print(&mut self, text: &str) {
        let text = text.to_owned();
        self.events.push(Event::Do(Effect::Message { channel: Channel::Print, text }));
    }

    /// The program's end. What it resets without a call is reset before M30 exchanges pallets, as what it resets by
    /// calls is.
    ///
    /// # Errors
    /// Those of `reset`, which sets what was shown afterwards.
    pub(super) fn end(
        &mut self,
        reset: impl FnOnce(&mut Self) -> Result<(), HarnessError>,
    ) -> Result<(), HarnessError> {
        let is_shuttle = |event: &mut Event| matches!(event, Event::Do(Effect::PalletShuttle {}));
        let shuttle = self.events.pop_if(is_shuttle);
        reset(self)?;
        self.events.extend(shuttle);
        self.events.push(Event::Do(Effect::ProgramEnd {}));
        Ok(())
    }

    /// Takes over a call.
    ///
    /// # Errors
    /// A call that is not known, or arguments that do not belong to it.
    pub(super) fn call(&mut self, call: &Call) -> Done {
        let numbers = call.numbers();
        match (call.name.as_str(), numbers.as_slice()) {
            ("STRAIGHT_TRAVERSE", &[x, y, z, a, b, c]) => {
                let end = self.move_to([x, y, z, a, b, c]);
                self.effect(Effect::StraightTraverse { end })
            }
            ("STRAIGHT_FEED", &[x, y, z, a, b, c]) => {
                self.show_inverse_time([x, y, z, a, b, c]);
                let end = self.move_to([x, y, z, a, b, c]);
                self.effect(Effect::StraightFeed { end })
            }
            ("ARC_FEED", &[..]) => self.arc(call, &numbers),
            ("RIGID_TAP", &[x, y, z]) => {
                let Position { a, b, c, .. } = self.position;
                let end = self.move_to([x, y, z, a, b, c]);
                self.effect(Effect::RigidTap { end })
            }
            ("DWELL", &[seconds]) => self.effect(Effect::Dwell { seconds }),
            ("SET_FEED_RATE", &[rate]) => {
                self.feed_rate(rate);
                Ok(Mark::None)
            }
            ("STRAIGHT_PROBE", &[x, y, z, a, b, c]) => {
                // The probe of the stand-alone program touches at the end of every move.
                let end = self.move_to([x, y, z, a, b, c]);
                self.effect(Effect::StraightProbe { end, contact: Some(end) })
            }
            ("NURBS_FEED", &[points, ..]) => {
                let points = u32::try_from(whole(call, points)?);
                let points = points.map_err(|_| call.unreadable("number of control points"))?;
                self.effect(Effect::NurbsFeed { points, end: self.position })
            }
            ("SET_TOOL_TABLE_ENTRY", _) => self.tool_entry(call, &numbers),
            _ => self.setting(call, &numbers),
        }
    }

    fn feed_rate(&mut self, rate: f64) {
        if self.now.feed_mode == Some(FeedMode::InverseTime) && rate > 0.0 {
            self.speed = Some(rate);
        } else {
            let change = self.lengths.feed(rate, self.now.feed_mode);
            self.set(change);
        }
    }

    /// Under inverse time the calls show the speed, length times F: where the block has no plain number, F is had
    /// back from the move.
    fn show_inverse_time(&mut self, end: [f64; 6]) {
        let Some(speed) = self.speed else { return };
        if let Some(feed) = plain_word(&self.block, 'f') {
            return self.rate_of_block(feed);
        }
        let from = self.position.to_array();
        let squares = |axes: std::ops::Range<usize>| -> f64 {
            axes.map(|axis| (end[axis] - from[axis]) * (end[axis] - from[axis])).sum()
        };
        let linear = squares(0..3).sqrt();
        let length = if linear > 0.0 { linear } else { squares(3..6).sqrt() };
        if length > 0.0 {
            self.rate_of_block(speed / length);
        }
    }

    /// F under inverse time is set with the other words of its block, after what a comment says; the first call that
    /// prints it is that of the move.
    fn rate_of_block(&mut self, rate: f64) {
        let change = self.lengths.feed(rate, Some(FeedMode::InverseTime));
        let mut set = Vec::new();
        state::set(&mut self.now, &mut set, &change);
        let is_said = |event: &&Event| matches!(event, Event::Do(effect) if is_said(effect));
        let behind = self.events.iter().take_while(is_said).count();
        self.events.splice(behind..behind, set);
    }

    /// The same for an arc: its length is that of the helix.
    fn show_inverse_time_of_arc(&mut self, numbers: &[f64]) {
        let (Some(speed), &[first, second, first_centre, second_centre, turns, along, ..]) =
            (self.speed, numbers)
        else {
            return;
        };
        if let Some(feed) = plain_word(&self.block, 'f') {
            return self.rate_of_block(feed);
        }
        let Position { x, y, z, .. } = self.position;
        let (from_first, from_second, from_along) = match self.now.plane {
            Some(Plane::Zx) => (z, x, y),
            Some(Plane::Yz) => (y, z, x),
            Some(Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw) | None => (x, y, z),
        };
        let angle =
            |first: f64, second: f64| libm::atan2(second - second_centre, first - first_centre);
        let swept = (angle(first, second) - angle(from_first, from_second)) * turns.signum();
        let part = swept.rem_euclid(TAU);
        let part = if part < 1e-9 { TAU } else { part };
        let radius = libm::hypot(from_first - first_centre, from_second - second_centre);
        let length = radius * (part + (turns.abs() - 1.0) * TAU);
        self.rate_of_block(speed / libm::hypot(length, along - from_along));
    }

    fn move_to(&mut self, [x, y, z, a, b, c]: [f64; 6]) -> Position {
        self.position = Position { x, y, z, a, b, c, ..self.position };
        self.position
    }

    fn arc(&mut self, call: &Call, numbers: &[f64]) -> Done {
        let &[first, second, first_centre, second_centre, turns, along, a, b, c] = numbers else {
            return Err(call.unreadable("arguments of an arc"));
        };
        self.show_inverse_time_of_arc(numbers);
        let (x, y, z) = match self.now.plane {
            Some(Plane::Zx) => (second, along, first),
            Some(Plane::Yz) => (along, first, second),
            Some(Plane::Xy | Plane::Uv | Plane::Wu | Plane::Vw) | None => (first, second, along),
        };
        let end = self.move_to([x, y, z, a, b, c]);
        let turns = whole(call, turns)?;
        self.effect(Effect::ArcFeed { end, first_centre, second_centre, turns })
    }
}

/// A number that is printed as a whole one.
fn whole(call: &Call, number: f64) -> Result<i32, HarnessError> {
    if number.fract().abs() > 0.0 || number.abs() > f64::from(i32::MAX) {
        return Err(call.unreadable("whole number"));
    }
    #[expect(clippy::cast_possible_truncation, reason = "checked above")]
    let whole = number as i32;
    Ok(whole)
}

#[cfg(test)]
mod tests;
