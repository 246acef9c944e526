//! Outputs and inputs (11.6.15 to 11.6.18) and user-defined codes (11.6.24).

use alloc::borrow::ToOwned;
use alloc::format;
use alloc::string::{String, ToString};

use gaugeblock_vocabulary::{Effect, FaultKind, OutputTiming, WaitMode};

use crate::canon::{Reply, Sink};
use crate::faults::{PlantedFault, narrowed, planted};
use crate::parameters::Numbered;

use super::Modal;
use super::check::Block;
use super::refusal::{Refusal, refuse};
use super::values::{integer, integer_in, not_negative};

/// Result of M66.
const INPUT_RESULT: u32 = 5399;

impl Modal {
    /// M62 to M65.
    pub(super) fn digital_output<K: Sink>(
        &mut self,
        block: &Block<'_>,
        code: u16,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.check_output()?;
        let output = number(block.words.get(b'P'), self.digital_io)?;
        let waits = code < 64 || code == 64 && planted(PlantedFault::OnWaits);
        let timing = if waits { OutputTiming::WithMotion } else { OutputTiming::AtOnce };
        let on = matches!(code, 62 | 64);
        let effect = Effect::SetDigitalOutput { output, on, timing };
        self.perform(block.words.line, &effect, sink)
    }

    /// M67, M68.
    pub(super) fn analog_output<K: Sink>(
        &mut self,
        block: &Block<'_>,
        code: u16,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        self.check_output()?;
        let digital = planted(PlantedFault::AnalogByDigitalCount);
        let count = if digital { self.digital_io } else { self.analog_io };
        let output = number(block.words.get(b'E'), count)?;
        let to = block.words.get(b'Q').unwrap_or(0.0);
        let waits = code == 67 || planted(PlantedFault::AnalogWaits);
        let timing = if waits { OutputTiming::WithMotion } else { OutputTiming::AtOnce };
        let effect = Effect::SetAnalogOutput { output, to, timing };
        self.perform(block.words.line, &effect, sink)
    }

    fn check_output(&self) -> Result<(), Refusal> {
        if self.choices.output_uncompensated {
            self.refuse_under_compensation("outputs")?;
        }
        Ok(())
    }

    /// M66: reads an input or waits for it; what it read goes into 5399.
    pub(super) fn wait_input<K: Sink>(
        &mut self,
        block: &Block<'_>,
        numbered: &mut Numbered,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if self.choices.input_uncompensated {
            self.refuse_under_compensation("M66")?;
        }
        self.check_without_path("M66")?;
        let words = block.words;
        let waits = words.get(b'L').is_some_and(|l| l > 0.0);
        let ignored = words.has(b'P') && !waits && planted(PlantedFault::BothImmediate);
        let e = words.get(b'E').filter(|_| !ignored);
        let (digital, analog) = match (words.get(b'P'), e) {
            (Some(_), Some(_)) => {
                return refuse(FaultKind::ModalConflict, "M66 with both P and E");
            }
            (None, None) => return refuse(FaultKind::MissingWord, "M66 without P and without E"),
            (digital @ Some(_), None) => (Some(number(digital, self.digital_io)?), None),
            (None, analog) => (None, Some(number(analog, self.analog_io)?)),
        };
        let mode = match words.get(b'L').map_or(Ok(0), |l| integer_in(l, 0, 4, "L of M66"))? {
            0 => WaitMode::Immediate,
            1 => WaitMode::Rise,
            2 if planted(PlantedFault::FallAsLow) => WaitMode::Low,
            2 => WaitMode::Fall,
            3 => WaitMode::High,
            _ => WaitMode::Low,
        };
        let low = mode == WaitMode::Low && planted(PlantedFault::AnalogLow);
        if analog.is_some() && mode != WaitMode::Immediate && !low {
            return refuse(FaultKind::WordOutOfRange, "M66 waits for no analog input");
        }
        let timeout = self.wait_timeout(mode, words.get(b'Q'))?;
        let effect = Effect::WaitInput { digital, analog, mode, timeout, read: 0.0 };
        let reply = self.perform_with_reply(words.line, &effect, sink)?;
        let read = if let Reply::Input(read) = reply { read } else { 0.0 };
        let is_bit = analog.is_some() && read.abs() > 0.0 && planted(PlantedFault::AnalogAsBit);
        let read = if is_bit { 1.0 } else { read };
        if !planted(PlantedFault::NoInputResult) {
            numbered.set(INPUT_RESULT, read);
        }
        Ok(())
    }

    /// Q of M66, which is ignored where nothing is waited for.
    fn wait_timeout(&self, mode: WaitMode, q: Option<f64>) -> Result<Option<f64>, Refusal> {
        let checked = planted(PlantedFault::TimeoutChecked) && q.is_some_and(|q| q <= 0.0);
        match q {
            _ if mode == WaitMode::Immediate && !checked => Ok(None),
            Some(timeout)
                if not_negative(timeout, "Q")? > 0.0 || planted(PlantedFault::ZeroTimeout) =>
            {
                Ok(Some(timeout))
            }
            Some(_) => refuse(FaultKind::WordOutOfRange, "M66 waits for zero seconds"),
            None if self.choices.endless_wait => Ok(None),
            None => refuse(FaultKind::MissingWord, "M66 waits without Q"),
        }
    }

    /// M100 to M199.
    pub(super) fn user_code<K: Sink>(
        &mut self,
        block: &Block<'_>,
        code: u16,
        sink: &mut K,
    ) -> Result<(), Refusal> {
        if planted(PlantedFault::UserCodeUncompensated) {
            self.refuse_under_compensation("a user-defined code")?;
        }
        self.check_without_path("a user-defined code")?;
        let argument = |value: Option<f64>| match value {
            Some(value) => value.to_string(),
            None if self.choices.empty_argument => String::new(),
            None => "-1".to_owned(),
        };
        let given = |value: &f64| value.abs() > 0.0 || !planted(PlantedFault::ZeroIsMissing);
        let (p, q) = (block.words.get(b'P').filter(given), block.words.get(b'Q').filter(given));
        let closed = p.is_none() && planted(PlantedFault::GapClosed);
        let (p, q) = if closed { (q, None) } else { (p, q) };
        let (p, q) = (argument(p), argument(q));
        let (p, q) = if planted(PlantedFault::SwappedArguments) { (q, p) } else { (p, q) };
        let effect = Effect::UserCode { code: u32::from(code), p, q };
        self.perform(block.words.line, &effect, sink)
    }
}

/// The number of an input or output, of which the machine has `count`.
fn number(value: Option<f64>, count: i32) -> Result<i32, Refusal> {
    let number = narrowed(PlantedFault::OutputWraps, value.unwrap_or(0.0), 256.0);
    let number = integer(number, "the number of an input or output")?;
    let more = i32::from(planted(PlantedFault::OneOutputMore));
    if (0..count.saturating_add(more)).contains(&number) {
        Ok(number)
    } else {
        refuse(FaultKind::NoSuchInputOrOutput, format!("there is no input or output {number}"))
    }
}
