//! Removes matching points from which the later samples cannot be reached.

use super::rows::Reach;
use super::{Matcher, passes};

impl Matcher<'_> {
    /// Removes the points of each sample from which no point of the next sample can be reached. Example: a sample near
    /// two lines is not on the first one if the next sample can only be reached from the second.
    ///
    /// Nothing is removed if the next sample matches no point that can be reached, or if the path may be followed
    /// backwards.
    pub(super) fn lead(&mut self) {
        let Some(last) = self.rows.len().checked_sub(1) else { return };
        if self.measure.finished {
            self.finish(last);
        }
        let mut next = self.rows.get(last);
        for sample in (0..last).rev() {
            let row = self.rows.get(sample);
            let back = self.measure.backwards.at(sample + 1);
            if back || self.lost.contains(&(sample + 1)) {
                next = row;
                continue;
            }
            let leading = self.leading(sample, &row, &next);
            if leading.is_empty() {
                next = row;
                continue;
            }
            self.rows.shorten(sample, &leading);
            next = leading;
        }
    }

    /// Matches the last sample with the end of the path alone, if it matches the end.
    fn finish(&mut self, last: usize) {
        let end = self.pieces.len() - 1;
        let row = self.rows.get(last);
        let at_end = row.last().filter(|reach| reach.piece == end && reach.high >= 1.0 - 1e-9);
        if let Some(reach) = at_end {
            self.rows.shorten(last, &[*reach]);
        }
    }

    /// Those points of a sample from which a point of the next one can be reached.
    fn leading(&self, sample: usize, row: &[Reach], next: &[Reach]) -> Vec<Reach> {
        let (from, to) = self.chord(sample + 1);
        let chord = (&from, &to);
        let mut later = next.iter().rev().peekable();
        let mut here = row.iter().rev().peekable();
        let (mut leading, mut onwards) = (Vec::with_capacity(row.len()), false);
        let highest = next.last().map_or(0, |reach| reach.piece);
        let lowest = row.first().map_or(0, |reach| reach.piece);
        for piece in (lowest..=highest).rev() {
            let mut closest = f64::INFINITY;
            onwards = onwards
                && passes(&self.pieces[piece], &self.curves, &mut closest, chord, &self.measure);
            let goal = later.next_if(|reach| reach.piece == piece);
            if let Some(reach) = here.next_if(|reach| reach.piece == piece) {
                let limit = match goal {
                    _ if onwards => Some(reach.high),
                    Some(goal) if goal.high >= reach.low => Some(goal.high.min(reach.high)),
                    Some(_) | None => None,
                };
                leading.extend(limit.map(|high| Reach { high, ..*reach }));
            }
            onwards |= goal.is_some();
        }
        leading.reverse();
        leading
    }
}
