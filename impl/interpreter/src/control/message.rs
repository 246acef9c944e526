//! Active comments at work (11.4.15 to 11.4.20).

use alloc::string::String;
use core::fmt::Write as _;

use gaugeblock_vocabulary::{Channel, Effect, FaultKind};

use crate::canon::{Reply, Sink};
use crate::faults::{PlantedFault, planted};
use crate::math;
use crate::modal::{Modal, Refusal};
use crate::parameters::Parameters;
use crate::quirks;
use crate::syntax::bytecode::{Act, CodeSegment, Comment, Piece};
use crate::syntax::{AbsentName, LineCompiler};

/// #5599 is zero where DEBUG shall say nothing.
const DEBUG_SWITCH: u32 = 5599;

/// Which log files the program has opened.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Logs {
    /// LOGOPEN, LOGAPPEND.
    log: bool,
    /// PROBEOPEN.
    probe: bool,
}

/// The values that a comment can print.
#[derive(Clone, Copy, Debug)]
pub(crate) struct View<'a> {
    pub(crate) parameters: &'a Parameters,
    /// The modes.
    pub(crate) modal: &'a Modal,
    /// The names and the readings.
    pub(crate) compiler: &'a LineCompiler,
    /// The segment of the comment.
    pub(crate) segment: &'a CodeSegment,
}

impl Logs {
    /// Performs an active comment; whether the sink replied with a stop.
    ///
    /// # Errors
    /// It is ABORT.
    pub(crate) fn perform<K: Sink>(
        &mut self,
        comment: Comment,
        view: View<'_>,
        line: u32,
        sink: &mut K,
    ) -> Result<bool, Refusal> {
        let effect = match comment.act {
            Act::Message => message(Channel::Display, view.text(comment)),
            Act::Debug
                if view.parameters.numbered.get(DEBUG_SWITCH).to_bits() << 1 == 0
                    && !planted(PlantedFault::DebugUnsilenced) =>
            {
                return Ok(false);
            }
            Act::Debug => message(Channel::Display, view.text(comment)),
            Act::Print => message(Channel::Print, view.text(comment)),
            Act::Log if !self.log && !planted(PlantedFault::LogWithoutFile) => return Ok(false),
            Act::Log => message(Channel::Log, view.text(comment)),
            Act::LogOpen | Act::LogAppend => {
                self.log = true;
                let append = comment.act == Act::LogAppend;
                Effect::LogOpen { file: view.text(comment), append }
            }
            Act::LogClose if !self.log => return Ok(false),
            Act::LogClose => {
                self.log = false;
                Effect::LogClose {}
            }
            Act::ProbeOpen => {
                self.probe = true;
                Effect::ProbeLogOpen { file: view.text(comment) }
            }
            Act::ProbeClose if !self.probe => return Ok(false),
            Act::ProbeClose => {
                self.probe = false;
                Effect::ProbeLogClose {}
            }
            Act::Abort => {
                return Err(Refusal::fault(FaultKind::AbortedByProgram, view.text(comment)));
            }
        };
        Ok(sink.perform(line, &effect) == Reply::Stop)
    }
}

fn message(channel: Channel, text: String) -> Effect {
    Effect::Message { channel, text }
}

impl View<'_> {
    /// A comment's text with its parameters expanded.
    fn text(&self, comment: Comment) -> String {
        let mut text = String::new();
        let mut decimals = if self.compiler.choices.default_four { 4 } else { 6 };
        let first = usize::try_from(comment.first).unwrap_or(usize::MAX);
        let end = usize::try_from(comment.end).unwrap_or(usize::MAX);
        for piece in self.segment.pieces.get(first..end).unwrap_or(&[]) {
            let value = match *piece {
                Piece::Text(first, end) => {
                    let first = usize::try_from(first).unwrap_or(usize::MAX);
                    let end = usize::try_from(end).unwrap_or(usize::MAX);
                    let bytes = self.segment.texts.get(first..end).unwrap_or(&[]);
                    text.push_str(&String::from_utf8_lossy(bytes));
                    continue;
                }
                Piece::Decimals(count) => {
                    decimals = count;
                    continue;
                }
                Piece::Numbered(number) => u16::try_from(number)
                    .ok()
                    .map(|number| self.parameters.numbered(number, self.modal)),
                Piece::Local(id) => self.parameters.named.local(id),
                Piece::Global(id) => self.parameters.named.global(id),
                Piece::Mode(name) => Some(self.modal.predefined(name)),
                Piece::Internal(name) => Some(self.parameters.internal(name)),
                Piece::Constant(place) => usize::try_from(place)
                    .ok()
                    .and_then(|place| self.segment.constants.get(place).copied()),
                Piece::Absent => None,
            };
            self.push_value(value, decimals, &mut text);
            if planted(PlantedFault::FormatOnce) {
                decimals = if self.compiler.choices.default_four { 4 } else { 6 };
            }
        }
        text
    }

    /// A value with so many decimals.
    fn push_value(&self, value: Option<f64>, decimals: u8, text: &mut String) {
        let Some(value) = value else {
            text.push_str(match self.compiler.choices.absent_name {
                AbsentName::One => "#",
                AbsentName::Six => "######",
            });
            return;
        };
        let near_zero = self.compiler.choices.emulates_rs274 && value.abs() < quirks::PRINTED_MIN;
        let value = if near_zero { 0.0 } else { value };
        let cut = decimals == 0 && planted(PlantedFault::IntegerCut);
        let value = if cut { math::truncate(value) } else { value };
        // An integer has no negative zero.
        let value = if decimals == 0 && value.abs() <= 0.5 { 0.0 } else { value };
        let value = if self.compiler.choices.zero_signed { value } else { value + 0.0 };
        // Writing into a text cannot fail.
        let _done = write!(text, "{value:.places$}", places = usize::from(decimals));
    }
}
