//! Reports changed settings to the sink.

use gaugeblock_vocabulary::Settings;

use crate::canon::Sink;

use super::modes::{InForce, difference, since};

impl InForce {
    /// Tells the sink what it does not know yet.
    #[inline]
    pub(crate) fn tell<K: Sink>(&mut self, line: u32, sink: &mut K) {
        if self.changed {
            self.tell_changes(line, sink);
        } else if self.feed_changed {
            self.tell_feed(line, sink);
        }
    }

    fn tell_feed<K: Sink>(&mut self, line: u32, sink: &mut K) {
        self.feed_changed = false;
        if let Some(feed_rate) = since(self.now.feed_rate, self.told.feed_rate, |rate| rate) {
            self.told.feed_rate = feed_rate;
            sink.set(line, &Settings { feed_rate: Some(feed_rate), ..Settings::default() });
        }
    }

    fn tell_changes<K: Sink>(&mut self, line: u32, sink: &mut K) {
        self.changed = false;
        self.feed_changed = false;
        if self.now != self.told {
            sink.set(line, &difference(&self.now, &self.told, self.spindles));
            self.told = self.now;
        }
    }
}
