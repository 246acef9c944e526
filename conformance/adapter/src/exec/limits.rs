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
    /// Objects of an answer, and steps and events of batches. Each may need one or two kilobytes of memory.
    pub objects: usize,
    /// Bytes of memory of each of its processes.
    pub memory: u64,
    /// Bytes of each file that it writes.
    pub file: u64,
}

impl Default for Limits {
    fn default() -> Self {
        let (time, start) = (Duration::from_secs(10), Duration::from_secs(10));
        let (bytes, whole) = (64 << 20, 256 << 20);
        Self { time, start, bytes, whole, objects: 2_000_000, memory: 4 << 30, file: 1 << 30 }
    }
}

impl Limits {
    /// Refuses a text of JSON with too many objects, before it is parsed.
    pub(super) fn check_objects(&self, text: &[u8]) -> Result<(), String> {
        // Each object takes two bytes at least.
        if text.len() / 2 > self.objects
            && text.iter().filter(|byte| **byte == b'{').count() > self.objects
        {
            return Err(format!("more than {} objects", self.objects));
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn objects_are_counted_before_they_are_read() {
        let limits = Limits { objects: 2, ..Limits::default() };
        let check = |text: &str| limits.check_objects(text.as_bytes());
        assert_eq!(check("{\"steps\":[{}]}"), Ok(()));
        assert_eq!(check("{\"steps\":[{},{}]}"), Err("more than 2 objects".to_owned()));
    }
}
