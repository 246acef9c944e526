//! Progress of long work: a bar on a terminal; a line a minute where there is none, such as in the log of a CI job.

use std::io::{IsTerminal as _, stderr};
use std::sync::atomic::{AtomicU64, Ordering};
use std::time::Duration;

use indicatif::{ProgressBar, ProgressStyle};

use crate::streams::write_error;

/// The progress of long work.
pub(crate) struct Progress {
    /// Drawn only on a terminal; without one it only counts.
    bar: ProgressBar,
    /// The plural of what is counted, such as `cases`.
    what: &'static str,
    /// The minute of the last line.
    minute: AtomicU64,
}

impl Progress {
    /// Work of a known size.
    pub(crate) fn of(total: usize, what: &'static str) -> Self {
        let bar = ProgressBar::new(u64::try_from(total).unwrap_or(u64::MAX));
        let template = format!("{{bar:32}} {{pos}}/{{len}} {what}, {{elapsed}}");
        Self::with(bar, &template, what)
    }

    /// Work of an unknown size.
    pub(crate) fn endless(what: &'static str) -> Self {
        let template = format!("{{spinner}} {{pos}} {what}{{msg}}, {{elapsed}}");
        Self::with(ProgressBar::new_spinner(), &template, what)
    }

    fn with(bar: ProgressBar, template: &str, what: &'static str) -> Self {
        let bar = match ProgressStyle::with_template(template) {
            Ok(style) => bar.with_style(style),
            Err(_) => bar,
        };
        Self { bar, what, minute: AtomicU64::new(0) }
    }

    /// Adds items that are complete.
    pub(crate) fn add(&self, more: usize) {
        self.bar.inc(u64::try_from(more).unwrap_or_default());
        self.log();
    }

    /// Sets the number of complete items and a remark about them.
    pub(crate) fn set(&self, done: u64, remark: &str) {
        self.bar.set_position(done);
        self.bar.set_message(format!(", {remark}"));
        self.log();
    }

    /// Writes to the terminal without the bar.
    #[cfg(feature = "faulty")]
    pub(crate) fn suspend(&self, write: impl FnOnce()) {
        self.bar.suspend(write);
    }

    /// Removes the bar.
    pub(crate) fn finish(&self) {
        self.bar.finish_and_clear();
    }

    fn log(&self) {
        let elapsed = self.bar.elapsed();
        let minute = elapsed.as_secs() / 60;
        if self.minute.fetch_max(minute, Ordering::Relaxed) < minute && !stderr().is_terminal() {
            write_error(&line(&self.bar, self.what, elapsed));
        }
    }
}

/// The line for a log.
fn line(bar: &ProgressBar, what: &str, elapsed: Duration) -> String {
    let of_all = bar.length().map_or_else(String::new, |all| format!(" of {all}"));
    let minutes = elapsed.as_secs() / 60;
    let unit = if minutes == 1 { "minute" } else { "minutes" };
    format!("{}{of_all} {what}{} after {minutes} {unit}", bar.position(), bar.message())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn line_of_a_log_has_the_count_and_the_minutes() {
        let cases = Progress::of(200, "cases");
        cases.add(3);
        cases.add(4);
        let said = line(&cases.bar, cases.what, Duration::from_secs(119));
        assert_eq!(said, "7 of 200 cases after 1 minute");
        let programs = Progress::endless("programs");
        programs.set(5000, "2 kinds of divergences");
        let said = line(&programs.bar, programs.what, Duration::from_secs(120));
        assert_eq!(said, "5000 programs, 2 kinds of divergences after 2 minutes");
    }
}
