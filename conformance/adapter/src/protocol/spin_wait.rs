//! Looking for what is waited for before sleeping until it comes: to be woken takes longer than most runs do.

use std::os::fd::AsFd;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use rustix::event::{PollFd, PollFlags, Timespec, poll};

use crate::clock::now;

/// How long is looked.
const LOOK: Duration = Duration::from_micros(50);

/// How many waits at most begin without a look.
const MOST: u32 = 64;

/// How many of this process wait like this.
static WAITERS: AtomicUsize = AtomicUsize::new(0);

/// Of one who waits again and again. A look keeps a processor from others, who may be those that it waits for: after
/// a look in vain it makes do without for a while, for longer and longer, and it does not look at all where everybody
/// who is awake does not have a processor of its own.
#[derive(Debug)]
pub struct SpinWait {
    looks: Looks,
    processors: usize,
}

impl Default for SpinWait {
    /// Counts one more who waits.
    fn default() -> Self {
        WAITERS.fetch_add(1, Ordering::Relaxed);
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        Self { looks: Looks::default(), processors }
    }
}

impl SpinWait {
    /// Looks for something to read, or for the end of the stream; whether it was found. Where it was not, it is time
    /// to sleep.
    pub fn look(&mut self, stream: impl AsFd) -> bool {
        // There is somebody at the other end of each.
        if 2 * WAITERS.load(Ordering::Relaxed) > self.processors || !self.looks.is_next() {
            return false;
        }
        let none = Timespec { tv_sec: 0, tv_nsec: 0 };
        let is_there = || poll(&mut [PollFd::new(&stream, PollFlags::IN)], Some(&none)) != Ok(0);
        let since = now();
        let mut found = is_there();
        while !found && since.elapsed() < LOOK {
            std::hint::spin_loop();
            found = is_there();
        }
        self.looks.came_of_it(found);
        found
    }
}

impl Drop for SpinWait {
    fn drop(&mut self) {
        WAITERS.fetch_sub(1, Ordering::Relaxed);
    }
}

/// Which waits begin with a look.
#[derive(Debug, Default)]
struct Looks {
    /// Waits before the next look.
    without: u32,
    /// How many there were to be after the last look.
    pause: u32,
}

impl Looks {
    /// Somebody waits: whether that begins with a look.
    fn is_next(&mut self) -> bool {
        let is_next = self.without == 0;
        self.without = self.without.saturating_sub(1);
        is_next
    }

    /// What the look came to.
    fn came_of_it(&mut self, found: bool) {
        self.pause = if found { 0 } else { (2 * self.pause).clamp(2, MOST) };
        self.without = self.pause;
    }
}

#[cfg(test)]
mod tests {
    use super::Looks;

    /// Waits that begin without a look, up to the next look.
    fn without(looks: &mut Looks) -> usize {
        std::iter::repeat_with(|| looks.is_next()).take_while(|is_next| !is_next).count()
    }

    #[test]
    fn looks_in_vain_become_rare_and_one_that_finds_something_brings_them_back() {
        let mut looks = Looks::default();
        assert_eq!(without(&mut looks), 0);
        for pause in [2, 4, 8, 16, 32, 64, 64] {
            looks.came_of_it(false);
            assert_eq!(without(&mut looks), pause);
        }
        for pause in [0, 0] {
            looks.came_of_it(true);
            assert_eq!(without(&mut looks), pause);
        }
        looks.came_of_it(false);
        assert_eq!(without(&mut looks), 2);
    }
}
