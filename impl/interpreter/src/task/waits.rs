//! Waits for time to pass: dwells, pauses, held moves, inputs (M66), external operations. Requests of the operator
//! are handled meanwhile.

use gaugeblock_vocabulary::{Effect, FaultKind, WaitMode};

use crate::canon::Reply;
use crate::faults::{PlantedFault, planted};

use super::machine::{ExternalOperation, Input, Machine, OperationState, WaitEvent};
use super::state::{AbortCause, Deadlock, TaskState};

/// The value that M66 reads after a time-out.
const TIMED_OUT: f64 = -1.0;

/// The block was aborted while it waited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Aborted;

/// Why a wait is over for now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum WakeReason {
    /// Its time is over.
    TimeReached,
    /// Something may have changed.
    Changed,
}

impl<M: Machine> TaskState<M> {
    /// Waits once. A wait for something that never happens is aborted as a deadlock.
    fn wait_once(&mut self, until: Option<f64>, deadlock: Deadlock) -> Result<WakeReason, Aborted> {
        let event = self.machine.wait(until);
        if event == WaitEvent::Changed {
            self.lock_oriented_spindles();
        }
        match event {
            WaitEvent::Time => Ok(WakeReason::TimeReached),
            WaitEvent::Changed => Ok(WakeReason::Changed),
            WaitEvent::Requested(action) => {
                self.handle_request(action);
                // A request at the same time comes before the end of the wait.
                while deadlock == Deadlock::Waiting
                    && self.abort_cause.is_none()
                    && let Some(action) = self.machine.poll_request()
                {
                    self.handle_request(action);
                }
                if self.abort_cause.is_some() {
                    return Err(Aborted);
                }
                self.lock_oriented_spindles();
                Ok(WakeReason::Changed)
            }
            WaitEvent::Never if until.is_some() => Ok(WakeReason::TimeReached),
            WaitEvent::Never => {
                self.abort_cause = Some(AbortCause::Deadlock(deadlock));
                Err(Aborted)
            }
        }
    }

    /// Locks the spindles that have reached their angles, whatever waits for them.
    pub(super) fn lock_oriented_spindles(&mut self) {
        for spindle in 0..u32::try_from(super::panel::SPINDLES).unwrap_or(0) {
            if self.tracked.is_orienting(spindle)
                && self.machine.operation_state(ExternalOperation::Orientation(spindle))
                    == OperationState::Done
            {
                self.tracked.lock(spindle);
                self.update_pins();
            }
        }
    }

    /// An abort stops spindles as M5 does, also one whose stop was read ahead and is nothing new to the interpreter.
    pub(super) fn release_spindles(&mut self) {
        if !self.choices.abort_keeps_spindles {
            self.tracked.release();
        }
    }

    /// Before a block: handles the requests so far, and waits while the program is paused.
    pub(super) fn wait_while_paused(&mut self) -> Result<(), Aborted> {
        self.within_block = false;
        loop {
            if let Some(action) = self.machine.poll_request() {
                self.handle_request(action);
                if self.abort_cause.is_some() {
                    return Err(Aborted);
                }
            } else if self.pause.is_some() {
                self.wait_for_resume()?;
            } else {
                return Ok(());
            }
        }
    }

    /// Waits for something that lets the program or a move continue.
    pub(super) fn wait_for_resume(&mut self) -> Result<(), Aborted> {
        self.wait_once(None, Deadlock::Paused).map(|_| ())
    }

    /// Lets so many seconds of a dwell pass. Whether they include a pause is a choice.
    pub(super) fn dwell(&mut self, seconds: f64) -> Result<(), Aborted> {
        let mut until = self.machine.time() + seconds.max(0.0);
        while self.wait_once(Some(until), Deadlock::Waiting)? != WakeReason::TimeReached {
            let paused = self.machine.time();
            self.pause_dwell()?;
            until += self.machine.time() - paused;
        }
        Ok(())
    }

    /// Stops a dwell while the program is paused, where the choice says so.
    pub(super) fn pause_dwell(&mut self) -> Result<(), Aborted> {
        while self.choices.pause_stops_dwell && self.pause.is_some() {
            self.wait_for_resume()?;
        }
        Ok(())
    }

    /// Waits until an external operation is over, or for so many seconds at most; after that the reply is a stop.
    pub(super) fn wait_for(
        &mut self,
        operation: ExternalOperation,
        seconds: Option<f64>,
    ) -> Result<Reply, Aborted> {
        let until = seconds.map(|seconds| self.machine.time() + seconds);
        let mut is_late = false;
        loop {
            match self.machine.operation_state(operation) {
                OperationState::Done => return Ok(Reply::Done),
                OperationState::Failed(kind) => return Ok(Reply::Failed(kind)),
                OperationState::InProgress if is_late => return Ok(Reply::Stop),
                OperationState::InProgress => {}
            }
            is_late = self.wait_once(until, Deadlock::Waiting)? == WakeReason::TimeReached;
        }
    }

    /// M19 waits for the encoder (11.6.8).
    pub(super) fn wait_orient(&mut self, spindle: u32, timeout: f64, effect: &Effect) -> Reply {
        let reply = self.machine.perform(self.line, effect);
        // A spindle that is ready at once is locked while another one is waited for.
        self.lock_oriented_spindles();
        match self.wait_for(ExternalOperation::Orientation(spindle), Some(timeout)) {
            Ok(Reply::Done) => {
                self.tracked.lock(spindle);
                self.update_pins();
                reply
            }
            Ok(Reply::Stop) => Reply::Failed(FaultKind::Orient),
            Ok(other) => other,
            Err(Aborted) => self.abort_reply(),
        }
    }

    /// M66: reads an input, or waits until it does what is awaited (11.6.16).
    pub(super) fn wait_input(
        &mut self,
        numbers: (Option<i32>, Option<i32>),
        mode: WaitMode,
        timeout: Option<f64>,
    ) -> Reply {
        let input = match numbers {
            (Some(number), _) => Input::Digital(u16::try_from(number).unwrap_or(u16::MAX)),
            (None, number) => {
                Input::Analog(u16::try_from(number.unwrap_or_default()).unwrap_or(u16::MAX))
            }
        };
        let until = timeout.map(|seconds| self.machine.time() + seconds);
        let mut was = self.machine.input(input) != 0.0;
        let level = match mode {
            WaitMode::Immediate => true,
            WaitMode::High => was,
            WaitMode::Low => !was,
            WaitMode::Rise | WaitMode::Fall => false,
        };
        if level {
            let value = self.machine.input(input);
            return self.finish_input(value);
        }
        let active_level = matches!(mode, WaitMode::High | WaitMode::Rise);
        loop {
            match self.wait_once(until, Deadlock::Waiting) {
                Err(Aborted) => return self.abort_waiting_reply(),
                Ok(WakeReason::TimeReached) => {
                    let value =
                        if planted(PlantedFault::TimeoutReadsZero) { 0.0 } else { TIMED_OUT };
                    return self.finish_input(value);
                }
                Ok(WakeReason::Changed) => {}
            }
            let now = self.machine.input(input) != 0.0;
            if was != now && now == active_level {
                let value = self.machine.input(input);
                return self.finish_input(value);
            }
            was = now;
        }
    }
}
