//! Signals that end the command. Controllers and private folders do not outlive it.

use std::fs::read_to_string;

use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
use signal_hook::iterator::Signals;
use signal_hook::low_level::emulate_default_handler;

/// Starts a thread that acts before a signal ends the process: it kills controllers and removes private folders.
///
/// # Errors
/// No signal can be watched.
pub(crate) fn watch() -> std::io::Result<()> {
    let ignored = ignored();
    let watched =
        [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|signal| ignored >> (signal - 1) & 1 == 0);
    let mut signals = Signals::new(watched)?;
    let ends = move || {
        for signal in signals.forever() {
            // A Grbl board is stopped and restored before the command ends.
            if gaugeblock_grbl::handles_signals() {
                continue;
            }
            gaugeblock_adapter::exec::kill_sessions();
            gaugeblock_filesystem::remove_private_folders();
            let _ends = emulate_default_handler(signal);
        }
    };
    std::thread::Builder::new().name("signals".to_owned()).spawn(ends).map(drop)
}

/// The ignored signals, one bit each. `nohup`, for example, starts a process with SIGHUP ignored.
fn ignored() -> u64 {
    let status = read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    line.and_then(|bits| u64::from_str_radix(bits.trim(), 16).ok()).unwrap_or(0)
}
