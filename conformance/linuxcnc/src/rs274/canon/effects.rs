//! Messages, tools, stops, the end, and signals.

use gaugeblock_adapter::HarnessError;
use gaugeblock_vocabulary::{Channel, Effect, OutputTiming};

use super::{Call, Canon, Done, Mark, whole};

impl Canon {
    pub(super) fn other(&mut self, call: &Call) -> Done {
        let numbers = call.numbers();
        let text = || call.text().to_owned();
        match (call.name.as_str(), numbers.as_slice()) {
            ("MESSAGE", _) => {
                self.effect(Effect::Message { channel: Channel::Display, text: text() })
            }
            ("LOG", _) => self.effect(Effect::Message { channel: Channel::Log, text: text() }),
            ("LOGOPEN", _) => self.effect(Effect::LogOpen { file: text(), append: false }),
            ("LOGAPPEND", _) => self.effect(Effect::LogOpen { file: text(), append: true }),
            ("LOGCLOSE", _) => self.effect(Effect::LogClose {}),
            ("SELECT_TOOL", &[tool]) => {
                let tool = whole(call, tool)?;
                self.effect(Effect::PrepareTool { tool })
            }
            ("CHANGE_TOOL", &[place]) => {
                self.tool = self.tool_at(call, place)?;
                self.effect(Effect::ChangeTool { tool: self.tool })
            }
            ("CHANGE_TOOL_NUMBER", &[place]) => {
                self.tool = self.tool_at(call, place)?;
                self.effect(Effect::SetToolNumber { tool: self.tool })
            }
            ("PROGRAM_STOP", _) => self.effect(Effect::Stop { optional: false }),
            ("OPTIONAL_PROGRAM_STOP", _) => self.effect(Effect::Stop { optional: true }),
            ("PALLET_SHUTTLE", _) => self.effect(Effect::PalletShuttle {}),
            ("PROGRAM_END", _) => Ok(Mark::ProgramEnd),
            ("FINISH", _) => Ok(Mark::PercentEnd),
            ("SET_FEED_REFERENCE" | "ON_RESET" | "START_CHANGE" | "RELOAD_TOOLDATA", _) => {
                Ok(Mark::None)
            }
            ("TURN_PROBE_ON" | "TURN_PROBE_OFF", _) => Ok(Mark::None),
            ("START_SPEED_FEED_SYNC", &[pitch, _]) => {
                let spindle = self.spindle_of_block(call)?;
                self.effect(Effect::StartSpindleSynchronisation { spindle, pitch })
            }
            ("STOP_SPEED_FEED_SYNCH", _) => self.effect(Effect::StopSpindleSynchronisation {}),
            _ => self.signal(call, &numbers),
        }
    }

    /// The calls do not show which spindle a move follows; the block does, where it says so in a plain number.
    fn spindle_of_block(&self, call: &Call) -> Result<u32, HarnessError> {
        let Some((_, behind)) = self.block.split_once('$') else { return Ok(0) };
        let digits: String = behind.trim_start().chars().take_while(char::is_ascii_digit).collect();
        digits.parse().map_err(|_| call.unreadable("spindle of a synchronised move"))
    }

    fn signal(&mut self, call: &Call, numbers: &[f64]) -> Done {
        use OutputTiming::{AtOnce, WithMotion};
        let digital = |output: f64, on, timing| {
            Ok::<_, HarnessError>(Effect::SetDigitalOutput {
                output: whole(call, output)?,
                on,
                timing,
            })
        };
        let analog = |output: f64, to, timing| {
            Ok::<_, HarnessError>(Effect::SetAnalogOutput {
                output: whole(call, output)?,
                to,
                timing,
            })
        };
        let effect = match (call.name.as_str(), numbers) {
            ("SET_MOTION_OUTPUT_BIT", &[output]) => digital(output, true, WithMotion)?,
            ("CLEAR_MOTION_OUTPUT_BIT", &[output]) => digital(output, false, WithMotion)?,
            ("SET_AUX_OUTPUT_BIT", &[output]) => digital(output, true, AtOnce)?,
            ("CLEAR_AUX_OUTPUT_BIT", &[output]) => digital(output, false, AtOnce)?,
            ("SET_MOTION_OUTPUT_VALUE", &[output, to]) => analog(output, to, WithMotion)?,
            ("SET_AUX_OUTPUT_VALUE", &[output, to]) => analog(output, to, AtOnce)?,
            (name, &[timeout]) if name.ends_with("WAIT_ORIENT_COMPLETE") => {
                let spindle = name.split('.').nth(1).and_then(|word| word.parse().ok());
                let spindle = spindle.ok_or_else(|| call.unreadable("spindle number"))?;
                Effect::WaitOrient { spindle, timeout }
            }
            (name, _) if name.contains("CUTTER_RADIUS_COMPENSATION") => return Ok(Mark::None),
            _ => return Err(call.unreadable("canonical call")),
        };
        self.effect(effect)
    }

    fn tool_at(&self, call: &Call, place: f64) -> Result<i32, HarnessError> {
        let place = usize::try_from(whole(call, place)?).map_err(|_| call.unreadable("tool"))?;
        match place.checked_sub(1) {
            None => Ok(0),
            Some(index) => self.table.number_at(index).ok_or_else(|| call.unreadable("tool")),
        }
    }
}
