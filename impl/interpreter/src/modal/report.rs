//! Reports changed settings to the sink.

use gaugeblock_vocabulary::Settings;

use crate::canon::Sink;

use super::modes::{ActiveSettings, difference, since};

impl ActiveSettings {
    /// Reports settings that the sink does not know yet.
    #[inline]
    pub(crate) fn report<K: Sink>(&mut self, line: u32, sink: &mut K) {
        if self.changed {
            self.report_changes(line, sink);
        } else if self.feed_changed {
            self.report_feed(line, sink);
        }
    }

    fn report_feed<K: Sink>(&mut self, line: u32, sink: &mut K) {
        self.feed_changed = false;
        if let Some(feed_rate) = since(self.now.feed_rate, self.reported.feed_rate, |rate| rate) {
            self.reported.feed_rate = feed_rate;
            sink.set(line, &Settings { feed_rate: Some(feed_rate), ..Settings::default() });
        }
    }

    fn report_changes<K: Sink>(&mut self, line: u32, sink: &mut K) {
        self.changed = false;
        self.feed_changed = false;
        if self.now != self.reported {
            sink.set(line, &difference(&self.now, &self.reported, self.spindles));
            self.reported = self.now;
        }
    }
}
