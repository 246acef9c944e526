//! Digital and analog outputs: at once (M64, M65, M68), or with the next motion (M62, M63, M67).

use alloc::vec;
use alloc::vec::Vec;

use gaugeblock_vocabulary::OutputTiming;

use crate::faults::{PlantedFault, planted};

/// An output: what it is, and what it is to become with the next motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Output {
    value: f64,
    waiting: Option<f64>,
}

/// The outputs of one kind, by number.
#[derive(Clone, Debug)]
pub(super) struct Outputs {
    outputs: Vec<Output>,
    /// Whether any waits for a motion, which each motion checks.
    some_wait: bool,
}

impl Outputs {
    /// All are zero.
    pub(super) fn new(count: u16) -> Self {
        Self { outputs: vec![Output::default(); usize::from(count)], some_wait: false }
    }

    /// Sets an output. Of several settings that wait the last one counts (11.6.15).
    pub(super) fn set(&mut self, number: i32, value: f64, timing: OutputTiming, replaces: bool) {
        if timing == OutputTiming::WithMotion && planted(PlantedFault::OneOutputWaits) {
            self.forget_waiting();
        }
        let place = usize::try_from(number).ok();
        let Some(output) = place.and_then(|place| self.outputs.get_mut(place)) else { return };
        match timing {
            OutputTiming::WithMotion if planted(PlantedFault::FirstWaitingCounts) => {
                output.waiting = output.waiting.or(Some(value));
                self.some_wait = true;
            }
            OutputTiming::WithMotion => {
                output.waiting = Some(value);
                self.some_wait = true;
            }
            OutputTiming::AtOnce => {
                output.value = value;
                if replaces {
                    output.waiting = None;
                }
            }
        }
    }

    /// A motion begins; whether anything may have changed.
    pub(super) fn begin_motion(&mut self) -> bool {
        let some_wait = core::mem::take(&mut self.some_wait);
        if some_wait {
            for output in &mut self.outputs {
                output.value = output.waiting.take().unwrap_or(output.value);
            }
        }
        some_wait
    }

    /// Drops the values that wait, after the end of their program.
    pub(super) fn forget_waiting(&mut self) {
        self.some_wait = false;
        for output in &mut self.outputs {
            output.waiting = None;
        }
    }

    /// The values by number.
    pub(super) fn values(&self) -> impl Iterator<Item = f64> {
        self.outputs.iter().map(|output| output.value)
    }
}
