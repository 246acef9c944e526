//! Time that goes by: dwells, pauses, held moves, inputs (M66), works outside. What the operator asks meanwhile is
//! answered.

use gaugeblock_vocabulary::{Effect, FaultKind, WaitMode};

use crate::canon::Reply;
use crate::faults::{Fault, planted};

use super::desk::{Break, Desk, Stuck};
use super::machine::{Happening, Input, Machine, Work, WorkState};

/// What M66 reads when nothing came in time.
const TIMED_OUT: f64 = -1.0;

/// The block was broken off while it waited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Broken;

/// Why a wait is over for now.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Woken {
    /// Its time has come.
    InTime,
    /// Something may be otherwise.
    Perhaps,
}

impl<M: Machine> Desk<M> {
    /// Waits once. A wait for nothing that will ever come is broken off as stuck.
    fn wake(&mut self, until: Option<f64>, stuck: Stuck) -> Result<Woken, Broken> {
        let happening = self.machine.wait(until);
        if happening == Happening::Changed {
            self.look_at_spindles();
        }
        match happening {
            Happening::Time => Ok(Woken::InTime),
            Happening::Changed => Ok(Woken::Perhaps),
            Happening::Asked(action) => {
                self.asked(action);
                // What is asked at the same time comes before what ends at that time.
                while stuck == Stuck::Waiting
                    && self.broken.is_none()
                    && let Some(action) = self.machine.asked()
                {
                    self.asked(action);
                }
                if self.broken.is_some() {
                    return Err(Broken);
                }
                self.look_at_spindles();
                Ok(Woken::Perhaps)
            }
            Happening::Never if until.is_some() => Ok(Woken::InTime),
            Happening::Never => {
                self.broken = Some(Break::Stuck(stuck));
                Err(Broken)
            }
        }
    }

    /// Spindles that have come to their angles are held there, whoever waits for them.
    pub(super) fn look_at_spindles(&mut self) {
        for spindle in 0..u32::try_from(super::panel::SPINDLES).unwrap_or(0) {
            if self.followed.is_on_its_way(spindle)
                && self.machine.state_of(Work::Orientation(spindle)) == WorkState::Done
            {
                self.followed.lock(spindle);
                self.renew_pins();
            }
        }
    }

    /// An abort stops spindles as M5 does, also one whose stop was read ahead and is nothing new to the interpreter.
    pub(super) fn release_spindles(&mut self) {
        if !self.choices.abort_leaves_alone {
            self.followed.release();
        }
    }

    /// Before a block: answers what was asked by now, and waits while the program is paused.
    pub(super) fn may_go_on(&mut self) -> Result<(), Broken> {
        self.within = false;
        loop {
            if let Some(action) = self.machine.asked() {
                self.asked(action);
                if self.broken.is_some() {
                    return Err(Broken);
                }
            } else if self.pause.is_some() {
                self.wait_to_go_on()?;
            } else {
                return Ok(());
            }
        }
    }

    /// Waits for something that lets the program or a move go on.
    pub(super) fn wait_to_go_on(&mut self) -> Result<(), Broken> {
        self.wake(None, Stuck::Paused).map(|_| ())
    }

    /// Lets so many seconds of a dwell go by. Whether those of a pause are among them is a choice of the documents.
    pub(super) fn pass(&mut self, seconds: f64) -> Result<(), Broken> {
        let mut until = self.machine.time() + seconds.max(0.0);
        while self.wake(Some(until), Stuck::Waiting)? != Woken::InTime {
            let paused = self.machine.time();
            self.stand_in_dwell()?;
            until += self.machine.time() - paused;
        }
        Ok(())
    }

    /// A dwell of a paused program, where that makes it stand still.
    pub(super) fn stand_in_dwell(&mut self) -> Result<(), Broken> {
        while self.choices.dwell_stands && self.pause.is_some() {
            self.wait_to_go_on()?;
        }
        Ok(())
    }

    /// Waits until a work is over, or for so many seconds at most; then it has not been done in time.
    pub(super) fn wait_for(&mut self, work: Work, seconds: Option<f64>) -> Result<Reply, Broken> {
        let until = seconds.map(|seconds| self.machine.time() + seconds);
        let mut is_late = false;
        loop {
            match self.machine.state_of(work) {
                WorkState::Done => return Ok(Reply::Done),
                WorkState::Failed(kind) => return Ok(Reply::Failed(kind)),
                WorkState::Underway if is_late => return Ok(Reply::Stop),
                WorkState::Underway => {}
            }
            is_late = self.wake(until, Stuck::Waiting)? == Woken::InTime;
        }
    }

    /// M19 waits for the encoder (11.6.8).
    pub(super) fn wait_orient(&mut self, spindle: u32, timeout: f64, effect: &Effect) -> Reply {
        let reply = self.machine.perform(self.line, effect);
        // One that answers at once is held while another one is still waited for.
        self.look_at_spindles();
        match self.wait_for(Work::Orientation(spindle), Some(timeout)) {
            Ok(Reply::Done) => {
                self.followed.lock(spindle);
                self.renew_pins();
                reply
            }
            Ok(Reply::Stop) => Reply::Failed(FaultKind::Orient),
            Ok(other) => other,
            Err(Broken) => self.broken_off(),
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
            return self.read(value);
        }
        let wanted = matches!(mode, WaitMode::High | WaitMode::Rise);
        loop {
            match self.wake(until, Stuck::Waiting) {
                Err(Broken) => return self.broken_waiting(),
                Ok(Woken::InTime) => {
                    let value = if planted(Fault::TimeoutReadsZero) { 0.0 } else { TIMED_OUT };
                    return self.read(value);
                }
                Ok(Woken::Perhaps) => {}
            }
            let now = self.machine.input(input) != 0.0;
            if was != now && now == wanted {
                let value = self.machine.input(input);
                return self.read(value);
            }
            was = now;
        }
    }
}
