//! The calls of a block, in the order in which `rs274` prints them: phase by phase, what the words say and what they
//! did.

use gaugeblock_vocabulary::{Effect, Event, FeedMode, LengthUnit, Plane, Position, Switch};

use super::modes::Modes;
use super::output::Output;
use super::words::{Phase, Words};

/// A block whose calls are to be printed.
#[derive(Debug)]
pub(super) struct Printed<'a> {
    pub(super) out: &'a mut Output,
    pub(super) words: &'a Words,
    /// Settings before the block.
    pub(super) before: Modes,
    /// Settings after it.
    pub(super) after: Modes,
    /// Where the controlled point was before the block.
    pub(super) position: Position,
    /// The programmed point before the block and after it.
    pub(super) programmed: (Position, Position),
    /// The motion code in force, in tenths.
    pub(super) motion: u16,
    pub(super) events: &'a [Event],
    /// What among them waits, and what has come out before them.
    pub(super) places: &'a Places,
    /// How many of the released effects have been printed.
    pub(super) released: usize,
    /// How many events have been printed.
    pub(super) at: usize,
    /// Whether the block is refused at a later phase.
    pub(super) refused: bool,
    pub(super) machine: &'a Fixed,
    /// The place in the table of the tool that T selected last.
    pub(super) selected: i64,
    /// The tool that is taken to be in the spindle: at the beginning the first one of the table.
    pub(super) loaded: i32,
    /// F as it was programmed last: `rs274` does not convert it with the unit.
    pub(super) feed: f64,
    /// F as it was programmed when the state was saved that the block restores.
    pub(super) saved_feed: Option<f64>,
    /// The canned cycle in force, in tenths.
    pub(super) cycle: Option<u16>,
    /// Where the point was along the normal of the plane when the first of a row of cycles began.
    pub(super) old_level: Option<f64>,
    /// The comment that is printed, where the text has one.
    pub(super) comment: Option<Vec<u8>>,
}

/// What does not change within a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Fixed {
    /// Tool numbers in the order of the tool table.
    pub(super) tools: Vec<i32>,
    pub(super) spindles: u8,
    /// Whether the program begins with a percent line and has no second one.
    pub(super) unclosed: bool,
    /// Whether blocks come from standard input: the end of a program resets nothing there.
    pub(super) by_hand: bool,
}

impl Fixed {
    /// The place of a tool in the table, from 1; 0 for none.
    pub(super) fn place(&self, tool: i32) -> i64 {
        let place = self.tools.iter().position(|number| *number == tool && tool != 0);
        place.and_then(|place| i64::try_from(place + 1).ok()).unwrap_or(0)
    }
}

/// What waits and what comes out in a block.
#[derive(Debug, Default)]
pub(super) struct Places {
    /// The events that wait, with their places.
    pub(super) held: Vec<(usize, u64)>,
    /// What comes out.
    pub(super) released: Vec<Released>,
}

impl Places {
    /// The place of an event that waits.
    pub(super) fn of(&self, event: usize) -> Option<u64> {
        self.held.iter().find(|(held, _)| *held == event).map(|(_, place)| *place)
    }
}

/// An effect that comes out after it has waited.
#[derive(Debug)]
pub(super) struct Released {
    /// The number of the block's event before which it comes.
    pub(super) before: usize,
    pub(super) place: u64,
    pub(super) effect: Effect,
    /// The length unit of the block that programmed it.
    pub(super) units: LengthUnit,
    /// Its plane.
    pub(super) plane: Plane,
}

/// Whether the calls of a phase wait after a compensated move. A message in a comment does not.
fn waits(phase: Phase) -> bool {
    matches!(
        phase,
        Phase::Comment
            | Phase::SpindleMode
            | Phase::FeedMode
            | Phase::Speed
            | Phase::Spindle
            | Phase::Coolant
            | Phase::Dwell
            | Phase::Modes
            | Phase::Motion
    )
}

/// A phase and what prints it.
type Step<T> = (Phase, fn(&mut T));

impl Printed<'_> {
    /// Prints all phases before one.
    pub(super) fn print(&mut self, end: Phase) {
        let phases: [Step<Self>; 18] = [
            (Phase::Comment, Self::comment),
            (Phase::SpindleMode, Self::spindle_mode),
            (Phase::FeedMode, Self::feed),
            (Phase::Speed, Self::speed),
            (Phase::Tool, Self::tool),
            (Phase::Outputs, Self::outputs),
            (Phase::Change, Self::tool_change),
            (Phase::Spindle, Self::spindle),
            (Phase::Saved, Self::saved),
            (Phase::Coolant, Self::coolant),
            (Phase::Overrides, Self::overrides),
            (Phase::Dwell, Self::dwell),
            (Phase::Plane, Self::plane_and_units),
            (Phase::Compensation, Self::compensation),
            (Phase::Modes, Self::modes),
            (Phase::Offsets, Self::offsets),
            (Phase::Motion, Self::motion),
            (Phase::Stop, Self::stop),
        ];
        self.refused = end < Phase::End;
        for (phase, print) in phases {
            if phase >= end {
                break;
            }
            self.out.late().waits = waits(phase);
            print(self);
        }
        self.out.late().waits = false;
        self.put_out(usize::MAX);
    }

    /// Prints what has come out before an event, in the unit in force: `rs274` prints it in that one.
    pub(super) fn put_out(&mut self, before: usize) {
        while let Some(released) = self.places.released.get(self.released)
            && released.before <= before
        {
            self.released += 1;
            let scale = super::scale::scale(released.units, self.after.units);
            let scaled = |end: Position| super::scale::scaled(end, scale);
            let place = released.place;
            if let Effect::StraightTraverse { end } = released.effect {
                let end = scaled(end);
                self.out.put_out(place, |out| out.call_to("STRAIGHT_TRAVERSE", &end));
            } else if let Effect::StraightFeed { end } = released.effect {
                let end = scaled(end);
                self.out.put_out(place, |out| out.call_to("STRAIGHT_FEED", &end));
            } else if let Effect::ArcFeed { end, first_centre, second_centre, turns } =
                released.effect
            {
                let (plane, end) = (released.plane, scaled(end));
                let centre = [first_centre * scale, second_centre * scale];
                self.out.put_out(place, |out| out.arc(plane, &end, centre, turns));
            }
        }
    }

    /// The next effect, where it is one that is wanted; changed settings before it are passed over.
    pub(super) fn next(&mut self, wanted: fn(&Effect) -> bool) -> Option<Effect> {
        for (place, event) in self.events.iter().enumerate().skip(self.at) {
            if let Event::Do(effect) = event {
                if !wanted(effect) {
                    return None;
                }
                self.at = place + 1;
                return Some(effect.clone());
            }
        }
        None
    }

    /// The spindles on which a code acts: that of `$`, or those of a code without it.
    pub(super) fn spindles(&self, without: std::ops::Range<i64>) -> std::ops::Range<i64> {
        #[expect(clippy::cast_possible_truncation, reason = "it has been checked")]
        match self.words.dollar {
            Some(-1.0) => self.all(),
            Some(number) => {
                let number = number.round() as i64;
                number..number + 1
            }
            None => without,
        }
    }

    /// All spindles.
    pub(super) fn all(&self) -> std::ops::Range<i64> {
        0..i64::from(self.machine.spindles)
    }

    fn comment(&mut self) {
        let message = |effect: &Effect| {
            matches!(
                effect,
                Effect::Message { .. }
                    | Effect::LogOpen { .. }
                    | Effect::LogClose {}
                    | Effect::ProbeLogOpen { .. }
                    | Effect::ProbeLogClose {}
            )
        };
        self.out.late().waits = false;
        match self.next(message) {
            Some(Effect::Message { channel, text }) => self.out.message(channel, &text),
            Some(Effect::LogOpen { file, append }) => {
                let name = if append { "LOGAPPEND(\"" } else { "LOGOPEN(\"" };
                self.out.begin(name).text(&file).text("\")").end();
            }
            Some(Effect::LogClose {}) => self.out.call("LOGCLOSE"),
            Some(_) | None => {}
        }
        self.out.late().waits = true;
        if let Some(comment) = &self.comment {
            self.out.comment(comment);
        }
    }

    /// The feed mode, and F. Under inverse time F is printed with its move, as a speed.
    fn feed(&mut self) {
        let mode = match self.words.g_of(&[930, 940, 950]) {
            Some(930) => Some(FeedMode::InverseTime),
            Some(940) => Some(FeedMode::PerMinute),
            Some(_) => Some(FeedMode::PerRevolution),
            None => None,
        };
        if let Some(mode) = mode {
            let spindle =
                if mode == FeedMode::PerRevolution { self.spindles(0..1).start } else { 0 };
            self.out.feed_mode(mode, spindle);
        }
        if mode.unwrap_or(self.before.feed_mode) != FeedMode::InverseTime
            && let Some(feed) = self.words.get(b'F')
        {
            self.out.call_with("SET_FEED_RATE", feed);
            self.feed = feed;
        } else if mode.is_some() {
            self.feed = 0.0;
        }
    }

    fn spindle_mode(&mut self) {
        if self.words.g_of(&[960, 970]).is_some() {
            for number in self.spindles(0..1) {
                let spindle = self.spindle_after(number);
                self.out.spindle_mode(number, &spindle);
            }
        }
    }

    fn speed(&mut self) {
        if let Some(speed) = self.words.get(b'S') {
            for number in self.spindles(0..1) {
                self.out.spindle_speed(number, speed);
            }
        }
    }

    /// What is set for a spindle after the block.
    pub(super) fn spindle_after(&self, number: i64) -> super::modes::Spindle {
        let place = usize::try_from(number).unwrap_or(0);
        self.after.spindles.get(place).copied().unwrap_or(self.after.spindles[0])
    }

    /// M72; the others print nothing.
    fn saved(&mut self) {
        if self.words.has_m(72) {
            self.restored();
        }
    }

    fn dwell(&mut self) {
        // A user-defined code runs nothing, and prints nothing.
        let _user = self.next(|effect| matches!(effect, Effect::UserCode { .. }));
        if self.words.g_of(&[40]).is_some()
            && let Some(Effect::Dwell { seconds }) =
                self.next(|effect| matches!(effect, Effect::Dwell { .. }))
        {
            self.out.call_with("DWELL", seconds);
        } else if self.refused
            && self.words.g_of(&[40]).is_some()
            && let Some(seconds) = self.words.get(b'P')
        {
            // What a block does is told only where it is executed whole.
            self.out.call_with("DWELL", seconds);
        }
    }

    /// Plane and units.
    fn plane_and_units(&mut self) {
        if self.words.g_of(&[170, 180, 190, 171, 181, 191]).is_some() {
            let plane = self.set().plane;
            self.out.plane(plane);
        }
        match self.words.g_of(&[200, 210]) {
            Some(200) => self.out.units(LengthUnit::Inch),
            Some(_) => self.out.units(LengthUnit::Millimetre),
            None => {}
        }
    }

    /// M0, M1, M60, and the end.
    fn stop(&mut self) {
        self.put_out(usize::MAX);
        loop {
            match self.next(|_| true) {
                Some(Effect::Stop { optional: true }) => self.out.call("OPTIONAL_PROGRAM_STOP"),
                Some(Effect::Stop { optional: false }) => self.out.call("PROGRAM_STOP"),
                Some(Effect::PalletShuttle {}) if !self.words.has_m(30) => {
                    self.out.call("PALLET_SHUTTLE");
                }
                Some(Effect::ProgramEnd {}) => self.program_end(),
                Some(_) => {}
                None => return,
            }
        }
    }

    /// Settings that the end of a program resets are printed whether they change or not, except plane, override and
    /// coolant.
    pub(super) fn program_end(&mut self) {
        let (mut before, after) = (self.before, self.after);
        before.assume(self.words);
        self.out.g5x_offset(&after);
        self.out.rotation(&after);
        if before.plane != Plane::Xy {
            self.out.plane(Plane::Xy);
        }
        self.out.begin("SET_FEED_MODE(0, 0)").end();
        self.out.call_with("SET_FEED_RATE", 0.0);
        if before.feed_override == Switch::Off {
            self.out.feed_override(Switch::On);
        }
        for number in self.all() {
            self.out.call_of("STOP_SPINDLE_TURNING", number);
            let begun = self.out.begin("SET_SPINDLE_MODE(").integer(number);
            begun.text(" 0.0000)").end();
        }
        if before.mist == Switch::On {
            self.out.mist(Switch::Off);
        }
        if before.flood == Switch::On {
            self.out.flood(Switch::Off);
        }
        if self.words.has_m(30) {
            self.out.call("PALLET_SHUTTLE");
        }
        self.out.call("PROGRAM_END");
        self.out.label(None);
        if self.machine.unclosed {
            self.out.note("percent sign missing from end of file");
        }
        if !self.machine.by_hand {
            self.out.call("ON_RESET");
        }
    }
}
