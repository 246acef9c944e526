//! The calls of a block, in the order in which `rs274` prints them: phase by phase, what the words say and what they did.

use gaugeblock_impl::BlockBegun;
use gaugeblock_trace::{Effect, Event, FeedMode, LengthUnit, Plane, Position, SpindleTurn, Switch};

use super::modes::Modes;
use super::output::Output;

/// The words of a block.
#[derive(Clone, Debug, Default)]
pub(super) struct Words {
    pub(super) g: Vec<u16>,
    pub(super) m: Vec<u16>,
    letters: [Option<f64>; 26],
    pub(super) dollar: Option<f64>,
}

impl Words {
    /// Takes over the words of a block that begins.
    pub(super) fn take(&mut self, begun: &BlockBegun<'_>) {
        self.g.clear();
        self.g.extend_from_slice(begun.g());
        self.m.clear();
        self.m.extend_from_slice(begun.m());
        for (letter, value) in (b'A'..=b'Z').zip(&mut self.letters) {
            *value = begun.letter(letter);
        }
        self.dollar = begun.dollar();
    }

    /// The value of a letter, in upper case.
    pub(super) fn get(&self, letter: u8) -> Option<f64> {
        self.letters.get(usize::from(letter.wrapping_sub(b'A'))).copied().flatten()
    }

    /// The first G code of a list that stands among the words.
    pub(super) fn g_of(&self, codes: &[u16]) -> Option<u16> {
        self.g.iter().copied().find(|code| codes.contains(code))
    }

    pub(super) fn has_m(&self, code: u16) -> bool {
        self.m.contains(&code)
    }
}

/// A part of a block. All before the one at which it was refused has been printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Phase {
    /// Nothing: it was refused before anything was executed.
    Comment,
    FeedMode,
    Speed,
    Tool,
    Outputs,
    Change,
    Spindle,
    Saved,
    Coolant,
    Overrides,
    Dwell,
    Plane,
    Compensation,
    Modes,
    Offsets,
    Motion,
    Stop,
    /// It was executed whole.
    End,
}

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
    pub(super) events: &'a [Event],
    /// How many events have been printed.
    pub(super) at: usize,
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
}

impl Fixed {
    /// The place of a tool in the table, from 1; 0 for none.
    pub(super) fn place(&self, tool: i32) -> i64 {
        let place = self.tools.iter().position(|number| *number == tool && tool != 0);
        place.and_then(|place| i64::try_from(place + 1).ok()).unwrap_or(0)
    }
}

impl Printed<'_> {
    /// Prints all phases before one.
    pub(super) fn print(&mut self, end: Phase) {
        let phases: [(Phase, fn(&mut Self)); 17] = [
            (Phase::Comment, Self::comment),
            (Phase::FeedMode, Self::feed),
            (Phase::Speed, Self::speed),
            (Phase::Tool, Self::tool),
            (Phase::Outputs, Self::outputs),
            (Phase::Change, Self::change),
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
        for (phase, print) in phases {
            if phase >= end {
                break;
            }
            print(self);
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
        if let Some(effect) = self.next(message) {
            match effect {
                Effect::Message { channel, text } => self.out.message(channel, &text),
                Effect::LogOpen { file, append } => {
                    let name = if append { "LOGAPPEND(\"" } else { "LOGOPEN(\"" };
                    self.out.begin(name).text(&file).text("\")").end();
                }
                Effect::LogClose {} => self.out.call("LOGCLOSE"),
                _ => {}
            }
        }
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
            let spindle = if mode == FeedMode::PerRevolution { self.spindles(0..1).start } else { 0 };
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

    fn speed(&mut self) {
        let spindles = self.spindles(0..1);
        for number in spindles.clone() {
            if self.words.g_of(&[960, 970]).is_some() {
                let spindle = self.spindle_after(number);
                self.out.spindle_mode(number, &spindle);
            }
            if let Some(speed) = self.words.get(b'S') {
                self.out.spindle_speed(number, speed);
            }
        }
    }

    /// What is set for a spindle after the block.
    pub(super) fn spindle_after(&self, number: i64) -> super::modes::Spindle {
        let place = usize::try_from(number).unwrap_or(0);
        self.after.spindles.get(place).copied().unwrap_or(self.after.spindles[0])
    }

    fn tool(&mut self) {
        if let Some(Effect::PrepareTool { tool }) =
            self.next(|effect| matches!(effect, Effect::PrepareTool { .. }))
        {
            self.out.call_of("SELECT_TOOL", tool);
            self.selected = self.machine.place(tool);
        }
    }

    fn outputs(&mut self) {
        use gaugeblock_trace::OutputTiming::WithMotion;
        let output = |effect: &Effect| {
            matches!(
                effect,
                Effect::SetDigitalOutput { .. }
                    | Effect::SetAnalogOutput { .. }
                    | Effect::WaitInput { .. }
            )
        };
        while let Some(effect) = self.next(output) {
            match effect {
                Effect::SetDigitalOutput { output, on, timing } => {
                    let name = match (timing == WithMotion, on) {
                        (true, true) => "SET_MOTION_OUTPUT_BIT",
                        (true, false) => "CLEAR_MOTION_OUTPUT_BIT",
                        (false, true) => "SET_AUX_OUTPUT_BIT",
                        (false, false) => "CLEAR_AUX_OUTPUT_BIT",
                    };
                    self.out.call_of(name, output);
                }
                Effect::SetAnalogOutput { output, to, timing } => {
                    let name = if timing == WithMotion {
                        "SET_MOTION_OUTPUT_VALUE("
                    } else {
                        "SET_AUX_OUTPUT_VALUE("
                    };
                    let begun = self.out.begin(name).integer(output.into()).text(",");
                    begun.six(to).text(")").end();
                }
                _ => {}
            }
        }
    }

    /// M6 and M61.
    fn change(&mut self) {
        if self.words.has_m(6) {
            self.out.call("START_CHANGE");
            while let Some(Effect::StraightTraverse { end }) =
                self.next(|effect| matches!(effect, Effect::StraightTraverse { .. }))
            {
                self.out.call_to("STRAIGHT_TRAVERSE", &end);
            }
        }
        let changed =
            |effect: &Effect| matches!(effect, Effect::ChangeTool { .. } | Effect::SetToolNumber { .. });
        match self.next(changed) {
            Some(Effect::ChangeTool { tool }) => {
                self.loaded = tool;
                // A change that leaves the spindle on tells no stop.
                let stopped = self.spindle_after(0).turn == SpindleTurn::Stopped || self.words.m.len() > 1;
                for number in self.all().filter(|_| stopped) {
                    self.out.call_of("STOP_SPINDLE_TURNING", number);
                }
                self.out.call_of("CHANGE_TOOL", self.selected);
            }
            Some(Effect::SetToolNumber { tool }) => {
                self.loaded = tool;
                let place = self.machine.place(tool);
                self.out.call_of("CHANGE_TOOL_NUMBER", place);
            }
            _ => {}
        }
    }

    /// M3, M4, M5, M19.
    fn spindle(&mut self) {
        for code in [3, 4, 5] {
            if self.words.has_m(code) {
                let turn = match code {
                    3 => SpindleTurn::Clockwise,
                    4 => SpindleTurn::Counterclockwise,
                    _ => SpindleTurn::Stopped,
                };
                for number in self.spindles(0..1) {
                    self.out.turn(number, turn);
                }
            }
        }
        self.orient();
    }

    /// An orientation and its wait.
    pub(super) fn orient(&mut self) {
        let oriented = |effect: &Effect| {
            matches!(effect, Effect::OrientSpindle { .. } | Effect::WaitOrient { .. })
        };
        while let Some(effect) = self.next(oriented) {
            match effect {
                Effect::OrientSpindle { spindle, angle, direction } => {
                    use gaugeblock_trace::OrientDirection::{Clockwise, Counterclockwise, Shortest};
                    let mode = match direction {
                        Shortest => 0,
                        Clockwise => 1,
                        Counterclockwise => 2,
                    };
                    let begun = self.out.begin("ORIENT_SPINDLE(").integer(spindle.into());
                    begun.text(", ").number(angle).text(", ").integer(mode).text(")").end();
                }
                Effect::WaitOrient { spindle, timeout } => {
                    let begun = self.out.begin("SPINDLE.").integer(spindle.into());
                    begun.text(".WAIT_ORIENT_COMPLETE(").number(timeout).text(")").end();
                }
                _ => {}
            }
        }
    }

    /// M72; the others print nothing.
    fn saved(&mut self) {
        if self.words.has_m(72) {
            self.restored();
        }
    }

    fn coolant(&mut self) {
        if self.words.has_m(7) {
            self.out.mist(Switch::On);
        }
        if self.words.has_m(8) {
            self.out.flood(Switch::On);
        }
        if self.words.has_m(9) {
            self.out.mist(Switch::Off);
            self.out.flood(Switch::Off);
        }
    }

    fn overrides(&mut self) {
        let given = |zero: bool| if zero { Switch::Off } else { Switch::On };
        let switch = given(self.words.get(b'P').is_some_and(|p| p.abs() <= 0.0));
        for code in self.words.m.clone() {
            match code {
                48 | 49 => {
                    let switch = given(code == 49);
                    self.out.feed_override(switch);
                    for number in self.all() {
                        self.out.speed_override(number, switch);
                    }
                }
                50 => self.out.feed_override(switch),
                51 => {
                    for number in self.spindles(self.all()) {
                        self.out.speed_override(number, switch);
                    }
                }
                52 => self.out.adaptive_feed(switch),
                53 => self.out.feed_stop(switch),
                _ => {}
            }
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
        while let Some(effect) = self.next(|_| true) {
            match effect {
                Effect::Stop { optional } => {
                    self.out.call(if optional { "OPTIONAL_PROGRAM_STOP" } else { "PROGRAM_STOP" });
                }
                Effect::PalletShuttle {} if !self.words.has_m(30) => self.out.call("PALLET_SHUTTLE"),
                Effect::ProgramEnd {} => self.program_end(),
                _ => {}
            }
        }
    }

    /// What the end of a program resets is printed whether it changes or not, but for plane, override and coolant.
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
        self.out.call("ON_RESET");
    }
}
