//! Tools, outputs, spindles, coolant and overrides of a block.

use gaugeblock_vocabulary::{Effect, SpindleTurn, Switch};

use super::block::Printed;

impl Printed<'_> {
    pub(super) fn tool(&mut self) {
        if let Some(Effect::PrepareTool { tool }) =
            self.next(|effect| matches!(effect, Effect::PrepareTool { .. }))
        {
            self.out.call_of("SELECT_TOOL", tool);
            self.selected = self.machine.place(tool);
        }
    }

    pub(super) fn outputs(&mut self) {
        use gaugeblock_vocabulary::OutputTiming::WithMotion;
        let output = |effect: &Effect| {
            matches!(
                effect,
                Effect::SetDigitalOutput { .. }
                    | Effect::SetAnalogOutput { .. }
                    | Effect::WaitInput { .. }
            )
        };
        loop {
            match self.next(output) {
                Some(Effect::SetDigitalOutput { output, on, timing }) => {
                    let name = match (timing == WithMotion, on) {
                        (true, true) => "SET_MOTION_OUTPUT_BIT",
                        (true, false) => "CLEAR_MOTION_OUTPUT_BIT",
                        (false, true) => "SET_AUX_OUTPUT_BIT",
                        (false, false) => "CLEAR_AUX_OUTPUT_BIT",
                    };
                    self.out.call_of(name, output);
                }
                Some(Effect::SetAnalogOutput { output, to, timing }) => {
                    let name = if timing == WithMotion {
                        "SET_MOTION_OUTPUT_VALUE("
                    } else {
                        "SET_AUX_OUTPUT_VALUE("
                    };
                    let begun = self.out.begin(name).integer(output.into()).text(",");
                    begun.six(to).text(")").end();
                }
                Some(_) => {}
                None => return,
            }
        }
    }

    /// M6 and M61.
    pub(super) fn tool_change(&mut self) {
        if self.words.has_m(6) {
            self.out.call("START_CHANGE");
            while let Some(Effect::StraightTraverse { end }) =
                self.next(|effect| matches!(effect, Effect::StraightTraverse { .. }))
            {
                self.out.call_to("STRAIGHT_TRAVERSE", &end);
            }
        }
        let changed = |effect: &Effect| {
            matches!(effect, Effect::ChangeTool { .. } | Effect::SetToolNumber { .. })
        };
        match self.next(changed) {
            Some(Effect::ChangeTool { tool }) => {
                self.loaded = tool;
                // A change that leaves the spindle on tells no stop.
                let stopped =
                    self.spindle_after(0).turn == SpindleTurn::Stopped || self.words.m.len() > 1;
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
    pub(super) fn spindle(&mut self) {
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
        loop {
            match self.next(oriented) {
                Some(Effect::OrientSpindle { spindle, angle, direction }) => {
                    use gaugeblock_vocabulary::OrientDirection::{
                        Clockwise, Counterclockwise, Shortest,
                    };
                    let mode = match direction {
                        Shortest => 0,
                        Clockwise => 1,
                        Counterclockwise => 2,
                    };
                    let begun = self.out.begin("ORIENT_SPINDLE(").integer(spindle.into());
                    begun.text(", ").number(angle).text(", ").integer(mode).text(")").end();
                }
                Some(Effect::WaitOrient { spindle, timeout }) => {
                    let begun = self.out.begin("SPINDLE.").integer(spindle.into());
                    begun.text(".WAIT_ORIENT_COMPLETE(").number(timeout).text(")").end();
                }
                Some(_) => {}
                None => return,
            }
        }
    }

    pub(super) fn coolant(&mut self) {
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

    pub(super) fn overrides(&mut self) {
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
}
