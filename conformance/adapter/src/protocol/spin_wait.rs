//! A wait that polls for a short time before it sleeps: waking up takes longer than most runs do.

use std::os::fd::AsFd;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};

use crate::clock::now;

/// How long a wait polls.
const POLL_TIME: Duration = Duration::from_micros(50);

/// Longest run of waits that sleep at once.
const SLEEPS_MAX: u32 = 64;

/// Number of waiters in this process.
static WAITERS: AtomicUsize = AtomicUsize::new(0);

/// A wait that is repeated. Polling takes a processor from other threads, possibly from the one that is waited for.
/// After a poll without success, the next waits sleep at once, more of them each time. With more runnable threads than
/// processors, no wait polls.
#[derive(Debug)]
pub struct SpinWait {
    schedule: PollSchedule,
    processors: usize,
}

impl Default for SpinWait {
    /// Registers one more waiter.
    fn default() -> Self {
        WAITERS.fetch_add(1, Ordering::Relaxed);
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        Self { schedule: PollSchedule::default(), processors }
    }
}

impl SpinWait {
    /// Polls for input or the end of the stream. False if there is none: the caller should then sleep.
    pub fn poll_briefly(&mut self, stream: impl AsFd) -> bool {
        // Each waiter has a thread at the other end.
        if 2 * WAITERS.load(Ordering::Relaxed) > self.processors || !self.schedule.begin_wait() {
            return false;
        }
        let none = Timespec { tv_sec: 0, tv_nsec: 0 };
        let is_there = || poll(&mut [PollFd::new(&stream, PollFlags::IN)], Some(&none)) != Ok(0);
        let since = now();
        let mut found = is_there();
        while !found && since.elapsed() < POLL_TIME {
            std::hint::spin_loop();
            found = is_there();
        }
        self.schedule.record_result(found);
        found
    }
}

impl Drop for SpinWait {
    fn drop(&mut self) {
        WAITERS.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Decides which waits poll.
#[derive(Debug, Default)]
struct PollSchedule {
    /// Waits that sleep at once before the next poll.
    sleeps_left: u32,
    /// How many there were after the last poll.
    sleeps: u32,
}

impl PollSchedule {
    /// Begins a wait. True if it polls.
    fn begin_wait(&mut self) -> bool {
        let is_next = self.sleeps_left == 0;
        self.sleeps_left = self.sleeps_left.saturating_sub(1);
        is_next
    }

    /// Records whether the poll had success.
    fn record_result(&mut self, found: bool) {
        self.sleeps = if found { 0 } else { (2 * self.sleeps).clamp(2, SLEEPS_MAX) };
        self.sleeps_left = self.sleeps;
    }
}

#[cfg(test)]
mod tests {
    use super::PollSchedule;

    /// Waits that sleep at once, up to the next poll.
    fn without(looks: &mut PollSchedule) -> usize {
        std::iter::repeat_with(|| looks.begin_wait()).take_while(|is_next| !is_next).count()
    }

    #[test]
    fn failed_polls_become_rare_and_a_success_resets() {
        let mut looks = PollSchedule::default();
        assert_eq!(without(&mut looks), 0);
        for pause in [2, 4, 8, 16, 32, 64, 64] {
            looks.record_result(false);
            assert_eq!(without(&mut looks), pause);
        }
        for pause in [0, 0] {
            looks.record_result(true);
            assert_eq!(without(&mut looks), pause);
        }
        looks.record_result(false);
        assert_eq!(without(&mut looks), 2);
    }
}
