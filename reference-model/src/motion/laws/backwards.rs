//! Where the path may be followed backwards.

/// Spans of samples, the first included and the last not, in order.
#[derive(Clone, Debug, Default)]
pub(super) struct Backwards(Vec<(usize, usize)>);

impl Backwards {
    pub(super) fn at(&self, sample: usize) -> bool {
        let later = self.0.partition_point(|span| span.0 <= sample);
        later > 0 && sample < self.0[later - 1].1
    }

    /// Adds a sample after all others.
    pub(super) fn add(&mut self, sample: usize) {
        match self.0.last_mut() {
            Some(span) if span.1 == sample => span.1 += 1,
            _ => self.0.push((sample, sample + 1)),
        }
    }
}
