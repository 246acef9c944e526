//! Limits of a controller in another process.

use std::time::Duration;

/// Limits of a controller.
#[derive(Clone, Copy, Debug)]
pub struct Limits {
    /// Wall time of an answer.
    pub time: Duration,
    /// Wall time until the first answer, with the start.
    pub start: Duration,
    /// Bytes of an answer.
    pub bytes: usize,
    /// Bytes of an outcome in batches, or of an answer in a file.
    pub whole: usize,
    /// Bytes of memory of each of its processes.
    pub memory: u64,
    /// Bytes of each file that it writes.
    pub file: u64,
}

impl Default for Limits {
    fn default() -> Self {
        let (time, start) = (Duration::from_secs(10), Duration::from_secs(10));
        let (bytes, whole) = (64 << 20, 256 << 20);
        Self { time, start, bytes, whole, memory: 4 << 30, file: 1 << 30 }
    }
}
