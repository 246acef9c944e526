//! The sink of the interpreter: gathers what a block says and does, and prints its calls when it is done.

use std::collections::VecDeque;

use gaugeblock_interpreter::{BlockEnd, BlockKind, BlockStart, Reply, Sink, Waiting};
use gaugeblock_vocabulary::{Effect, Event, FaultKind, LengthUnit, Plane, Position, Settings};

use super::block::{Fixed, Places, Printed, Released};
use super::codes::{CYCLES, MOTIONS, TURNINGS};
use super::modes::Modes;
use super::output::Output;
use super::programmed::programmed_end;
use super::refusals::CycleProgress;
use super::source::Texts;
use super::text;
use super::words::{Phase, Words};

/// Most effects of one block. Its calls are printed when it ends, so it is kept until then.
pub(super) const BLOCK_EFFECTS_MAX: usize = 1_000_000;

/// Prints what an interpreter does.
#[derive(Debug)]
pub(super) struct Printer {
    pub(super) out: Output,
    texts: Texts,
    /// Settings before the block.
    modes: Modes,
    /// Where the controlled point was before the block.
    position: Position,
    /// The programmed point before the block and after it.
    programmed: (Position, Position),
    /// The place in the table of the tool that T selected last.
    selected: i64,
    /// The tool that is taken to be in the spindle.
    loaded: i32,
    /// F as it was programmed last.
    feed: f64,
    /// The same where M70 and M73 saved it, by call level.
    saved_feeds: Vec<Option<f64>>,
    /// Where the point was along the normal of the plane when the first of a row of cycles began.
    old_level: Option<f64>,
    /// The motion code in force, in tenths.
    motion: u16,
    fixed: Fixed,
    /// The words of the block, where it has any.
    words: Words,
    begun: bool,
    /// What the block did.
    events: Vec<Event>,
    /// What of it waits, and what has come out.
    places: Places,
    /// Length unit and plane of the effects that wait; the oldest first.
    frames: VecDeque<(LengthUnit, Plane)>,
    /// The number of the last place, and of the one that is released.
    place: u64,
    released: Option<u64>,
}

impl Printer {
    /// Prints the start of an interpreter that has these settings.
    pub(super) fn new(out: Output, texts: Texts, settings: &Settings, fixed: Fixed) -> Self {
        let mut modes = Modes::default();
        modes.apply(settings);
        let mut printer = Self {
            out,
            texts,
            modes,
            position: Position::default(),
            programmed: <(Position, Position)>::default(),
            selected: 0,
            loaded: fixed.tools.first().copied().unwrap_or(0),
            feed: 0.0,
            saved_feeds: vec![None],
            old_level: None,
            motion: 800,
            fixed,
            words: Words::default(),
            begun: false,
            events: Vec::new(),
            places: Places::default(),
            frames: VecDeque::new(),
            place: 0,
            released: None,
        };
        let out = &mut printer.out;
        out.units(modes.units);
        out.g5x_offset(&modes);
        out.g92_offset(&modes);
        out.rotation(&modes);
        out.begin("SET_FEED_REFERENCE(CANON_XYZ)").end();
        printer
    }

    /// The words of the block that was begun last.
    pub(super) fn words(&self) -> &Words {
        &self.words
    }

    /// Whether the block in execution has more effects than are kept.
    pub(super) fn is_full(&self) -> bool {
        self.events.len() > BLOCK_EFFECTS_MAX
    }

    /// The motion code in force, in tenths.
    pub(super) fn motion(&self) -> u16 {
        self.motion
    }

    /// Where the controlled point was before the block, and the plane that is in force for it.
    pub(super) fn place(&self) -> (Position, Plane) {
        let mut modes = self.modes;
        if self.begun {
            modes.assume(&self.words);
        }
        (self.position, modes.plane)
    }

    /// Prints what a refused block did before the phase at which it was refused; a cycle may have begun.
    pub(super) fn refused(
        &mut self,
        place: Option<(&str, u32)>,
        (reached, begun): (Phase, Option<CycleProgress>),
        settings: &Settings,
    ) {
        let events = std::mem::take(&mut self.events);
        // A lathe cycle is refused after its first motion.
        let has_moved =
            events.iter().any(|event| matches!(event, Event::Do(Effect::StraightTraverse { .. })));
        let is_turning = self.begun && self.words.g_of(&TURNINGS).is_some();
        let reached = if is_turning && has_moved { Phase::Stop } else { reached };
        if let Some((file, line)) = place.filter(|_| reached > Phase::Comment) {
            self.forget_words();
            let mut after = self.modes;
            after.apply(settings);
            after.assume(&self.words);
            self.print(file, line, &events, after, reached);
            if let Some(begun) = begun {
                self.printed(&[], after, None).begun(begun);
            }
        }
        self.begun = false;
        self.out.late().lose();
        self.frames.clear();
        self.places = Places::default();
        self.modes.apply(settings);
        self.out.label(None);
    }

    /// Prints the end of a program that ends like one with M2, though no block said so.
    pub(super) fn ended(&mut self, settings: &Settings) {
        let mut after = self.modes;
        after.apply(settings);
        self.words = Words::default();
        let events = std::mem::take(&mut self.events);
        // The one M99 of the file is the one that ended the run.
        let line = self.texts.only_line_with(b"m99").unwrap_or_default();
        let comment = text::comment(&line).filter(|comment| !text::acts(comment));
        let mut printed = self.printed(&events, after, comment.map(<[u8]>::to_vec));
        printed.print(Phase::SpindleMode);
        printed.program_end();
    }

    fn printed<'a>(
        &'a mut self,
        events: &'a [Event],
        after: Modes,
        comment: Option<Vec<u8>>,
    ) -> Printed<'a> {
        Printed {
            out: &mut self.out,
            words: &self.words,
            before: self.modes,
            after,
            position: self.position,
            programmed: self.programmed,
            motion: self.motion,
            events,
            places: &self.places,
            released: 0,
            at: 0,
            refused: false,
            machine: &self.fixed,
            selected: self.selected,
            loaded: self.loaded,
            feed: self.feed,
            saved_feed: self.saved_feeds.last().copied().flatten(),
            cycle: Some(self.motion).filter(|code| CYCLES.contains(code)),
            old_level: self.old_level,
            comment,
        }
    }

    /// A block without words has none of the block before.
    fn forget_words(&mut self) {
        if !std::mem::take(&mut self.begun) {
            self.words = Words::default();
        }
    }

    fn print(&mut self, file: &str, line: u32, events: &[Event], after: Modes, end: Phase) {
        let out = &mut self.out;
        let comment = self.texts.line(file, line, |line| {
            out.label(text::number(line));
            text::comment(line).filter(|comment| !text::acts(comment)).map(<[u8]>::to_vec)
        });
        if let Some(code) = self.words.g_of(&MOTIONS) {
            if !CYCLES.contains(&self.motion) {
                self.old_level = None;
            }
            self.motion = code;
        }
        if self.words.g_of(&TURNINGS).is_some() {
            (self.motion, self.old_level) = (10, None);
        }
        let mut printed = self.printed(events, after, comment);
        printed.print(end);
        let Printed { after, position, feed, selected, loaded, old_level, .. } = printed;
        self.modes = after;
        (self.position, self.feed, self.old_level) = (position, feed, old_level);
        (self.selected, self.loaded) = (selected, loaded);
        if (self.words.has_m(70) || self.words.has_m(73))
            && let Some(saved) = self.saved_feeds.last_mut()
        {
            *saved = Some(self.feed);
        }
    }

    /// Prints a block that was executed.
    fn done(&mut self, done: &BlockEnd<'_>) {
        let mut events = std::mem::take(&mut self.events);
        let mut after = self.modes;
        for event in &events {
            if let Event::Set(changed) = event {
                after.apply(changed);
            }
        }
        let reached = done.state().position.unwrap_or(self.programmed.1);
        let start = self.programmed.1;
        self.programmed = (start, programmed_end(start, reached, &after, &self.words));
        self.print(done.file(), done.line(), &events, after, Phase::End);
        let moves_only =
            self.words.m.is_empty() && self.words.g.iter().all(|code| MOTIONS.contains(code));
        if !moves_only && let Some(position) = done.state().position {
            self.position = position;
        }
        if done.kind() == BlockKind::End {
            self.motion = 10;
        }
        events.clear();
        self.events = events;
        self.places = Places::default();
    }

    /// A call or a return has led to a call level.
    fn at_level(&mut self, level: u32) {
        let levels = usize::try_from(level).unwrap_or(0).saturating_add(1);
        self.saved_feeds.resize(levels, None);
    }

    /// Prints what a return from a sub brings back.
    fn returned(&mut self, file: &str, line: u32) {
        let events = std::mem::take(&mut self.events);
        let mut after = self.modes;
        for event in &events {
            if let Event::Set(changed) = event {
                after.apply(changed);
            }
        }
        if after == self.modes {
            return;
        }
        let out = &mut self.out;
        self.texts.line(file, line, |line| out.label(text::number(line)));
        self.words = Words::default();
        let mut printed = self.printed(&events, after, None);
        printed.restored();
        (self.modes, self.feed) = (printed.after, printed.feed);
    }
}

impl Sink for Printer {
    fn hold(&mut self, _line: u32, waiting: Waiting<'_>) -> u64 {
        let Waiting::Effect(effect) = waiting else {
            if let Waiting::Settings(changed) = waiting {
                self.events.push(Event::Set(changed.clone().into()));
            }
            return 0;
        };
        self.place += 1;
        if matches!(
            effect,
            Effect::StraightTraverse { .. } | Effect::StraightFeed { .. } | Effect::ArcFeed { .. }
        ) {
            self.places.held.push((self.events.len(), self.place));
        }
        let mut modes = self.modes;
        for event in &self.events {
            if let Event::Set(changed) = event {
                modes.apply(changed);
            }
        }
        self.frames.push_back((modes.units, modes.plane));
        self.events.push(Event::Do(effect.clone()));
        self.place
    }

    fn release(&mut self, place: u64) {
        self.released = Some(place);
    }

    fn set(&mut self, _line: u32, changed: &Settings) {
        if self.released.take().is_some() {
            return;
        }
        self.events.push(Event::Set(changed.clone().into()));
    }

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        if let Some(place) = self.released.take() {
            let now = (self.modes.units, self.modes.plane);
            let (units, plane) = self.frames.pop_front().unwrap_or(now);
            let (before, effect) = (self.events.len(), effect.clone());
            self.places.released.push(Released { before, place, effect, units, plane });
            return Reply::Done;
        }
        self.events.push(Event::Do(effect.clone()));
        if self.is_full() {
            return Reply::Stop;
        }
        if let Effect::StraightProbe { end, .. } = effect {
            Reply::Contact(Some(*end))
        } else if let Effect::WaitInput { .. } = effect {
            Reply::Input(0.0)
        } else if let Effect::UserCode { .. } = effect {
            Reply::Failed(FaultKind::UnknownCode)
        } else {
            Reply::Done
        }
    }

    fn start_block(&mut self, begun: &BlockStart<'_>) {
        self.begun = true;
        self.words.take(begun);
    }

    fn end_block(&mut self, done: &mut BlockEnd<'_>) {
        match done.kind() {
            BlockKind::Words | BlockKind::Comment | BlockKind::End => {
                self.forget_words();
                self.done(done);
            }
            BlockKind::Return | BlockKind::NumberedReturn => {
                self.returned(done.file(), done.line());
                self.at_level(done.call_level());
                if let Some(position) = done.state().position {
                    self.position = position;
                }
            }
            BlockKind::Call | BlockKind::NumberedCall => {
                self.events.clear();
                self.at_level(done.call_level());
            }
            BlockKind::OWord => self.events.clear(),
        }
        self.begun = false;
    }
}
