//! Ctrl-C: the first one ends every wait, so that the adapter stops the machine and restores it; the second one ends
//! the process.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

use gaugeblock_adapter::HarnessError;
use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Exit status of a process that a user ended: 128 and the number of the signal.
const STATUS_OF_SIGINT: i32 = 130;

/// Whether a machine is connected that must be stopped before this process ends.
static INSTALLED: AtomicBool = AtomicBool::new(false);

/// Whether this adapter ends the process at SIGINT and SIGTERM itself, after it has stopped its machine.
pub fn handles_signals() -> bool {
    INSTALLED.load(Ordering::Relaxed)
}

/// Whether the user has interrupted.
#[derive(Clone, Debug, Default)]
pub(crate) struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Notes the signals that end a process. Where it cannot, they end it at once.
    pub(crate) fn install() -> Self {
        let interrupt = Self::default();
        INSTALLED.store(true, Ordering::Relaxed);
        for signal in [SIGINT, SIGTERM] {
            // In this order: the first signal finds the flag clear, and sets it.
            let shutdown = Arc::clone(&interrupt.0);
            let _second = flag::register_conditional_shutdown(signal, STATUS_OF_SIGINT, shutdown);
            let _first = flag::register(signal, Arc::clone(&interrupt.0));
        }
        interrupt
    }

    /// Ends a wait after an interrupt.
    ///
    /// # Errors
    /// The user has interrupted.
    pub(crate) fn check(&self) -> Result<(), HarnessError> {
        if self.0.load(Ordering::Relaxed) {
            return Err(HarnessError::NotRun("interrupted".to_owned()));
        }
        Ok(())
    }

    /// Clears the flag and returns it, so that what follows can wait: the machine is stopped and restored then.
    pub(crate) fn suspend(&self) -> bool {
        self.0.swap(false, Ordering::Relaxed)
    }

    /// Sets the flag again.
    pub(crate) fn resume(&self, was: bool) {
        self.0.fetch_or(was, Ordering::Relaxed);
    }
}
