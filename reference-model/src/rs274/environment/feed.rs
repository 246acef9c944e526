//! The inputs that concern the feed.

use super::EnvironmentState;

/// The adaptive feed input and the feed stop input.
const NAMES: [&str; 2] = ["adaptive_feed", "feed_hold"];

impl EnvironmentState {
    /// The value of the adaptive feed input now; full speed until it is listed.
    pub fn adaptive_feed(&self) -> f64 {
        self.feed_input(NAMES[0]).unwrap_or(1.0)
    }

    /// Whether the feed stop input requests a stop now.
    pub fn feed_stop(&self) -> bool {
        self.feed_input(NAMES[1]).unwrap_or(0.0) != 0.0
    }

    fn feed_input(&self, name: &str) -> Option<f64> {
        self.feed_input_at(name, self.time)
    }

    /// The value that one of them had, if it is listed for that time.
    pub(super) fn feed_input_at(&self, name: &str, time: f64) -> Option<f64> {
        let changes = self.scenario.inputs.iter();
        let past = changes.filter(|change| change.input == name && change.time <= time);
        past.map(|change| change.value).next_back()
    }

    /// When one of them changes next.
    pub fn next_change_of_feed(&self) -> Option<f64> {
        let changes = self.scenario.inputs.iter();
        let later = changes
            .filter(|change| NAMES.contains(&change.input.as_str()) && change.time > self.time);
        later.map(|change| change.time).min_by(f64::total_cmp)
    }
}
