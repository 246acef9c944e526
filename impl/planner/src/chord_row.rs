//! Rows of chords: what is queued as many short lines with one feed and tolerance becomes few lines of equal lengths.
//!
//! A post rounds the ends of chords, so that their directions change by far more than those of the curve. Corners of a
//! new line are therefore means of the path about them, not programmed ends. Each line leaves its chords by a share of
//! the tolerance at most; blends have the rest. Lines follow from the chords alone, whenever these are queued.

use crate::chord::{LINE_DEVIATION_RATIO_MAX, Place, distance_sq, feed_of, leading};
use crate::limits::{Limits, squared};
use crate::math;
use crate::parameters::Axes;
use crate::segment::{Feed, Path, PathControl, Segment};
use crate::vector::dot;

/// How many ends of chords are kept.
const ENDS_MAX: usize = 48;
/// The share of that which the last line of a row uses if it can.
const LAST_LINE_RATIO: f64 = 1.0 / 3.0;
/// How long a line is at first: cycles at its feed, and chords.
const FIRST_LINE_CYCLES: f64 = 2.0;
const FIRST_LINE_CHORDS: f64 = 4.0;
/// The half of the range over which a corner is a mean, in lengths of its line.
const MEAN_RANGE_RATIO: f64 = 0.5;
/// How much longer the next line is where the corner before it is slower than the feed, and how much shorter a line is
/// tried that leaves its chords too far.
const NOISE_SQ: f64 = 0.09;
const CALM_SQ: f64 = 0.02;
const BASE_CYCLES: f64 = 2.0;
const DECAY: f64 = 0.85;
const TURN_MAX_RAD: f64 = 0.2;
const GROWTH_RATIO: f64 = 1.25;
const SHRINKING_RATIO: f64 = 0.75;
const TRIALS: u32 = 4;

/// The end of a chord.
#[derive(Clone, Copy, Debug, Default)]
struct ChordEnd {
    place: Place,
    /// The way along the chords to it, from where the row begins.
    walked: f64,
    number: u64,
    index: u64,
}

/// A line that replaces chords.
#[derive(Clone, Copy, Debug)]
pub(crate) struct RowLine {
    pub(crate) segment: Segment,
    pub(crate) index: u64,
    /// How far it is from its chords at most, millimetres.
    pub(crate) deviation: f64,
    pub(crate) is_merged: bool,
    pub(crate) is_separate: bool,
    /// The lengths of the first and the last chord.
    pub(crate) start_length: f64,
    pub(crate) end_length: f64,
}

/// Chords that are queued and not yet replaced.
#[derive(Clone, Debug)]
pub(crate) struct ChordRow {
    /// The last chord.
    last: Option<Segment>,
    /// Where the next line begins, the place of the chords that belongs to it, and how far they are apart.
    start: Place,
    start_on_path: Place,
    start_deviation: f64,
    ends: [ChordEnd; ENDS_MAX],
    count: usize,
    is_separate: bool,
    /// How long the next line is to be, millimetres.
    length: f64,
    base: f64,
    /// How many ends the next line of `try_last_line` passes.
    trial: Option<usize>,
    change: Option<Place>,
    /// The direction and the length of the line before, and its deviation.
    before: Option<(Place, f64, f64)>,
}

impl ChordRow {
    pub(crate) fn new() -> Self {
        Self {
            last: None,
            start: [0.0; 3],
            start_on_path: [0.0; 3],
            start_deviation: 0.0,
            ends: [ChordEnd::default(); ENDS_MAX],
            count: 0,
            is_separate: false,
            length: 0.0,
            base: 0.0,
            trial: None,
            change: None,
            before: None,
        }
    }

    /// Whether nothing waits.
    #[inline]
    pub(crate) fn is_empty(&self) -> bool {
        self.count == 0
    }

    /// Takes the last chord, to be added by itself when the others have been.
    pub(crate) fn take_last(&mut self) -> Option<RowLine> {
        let last = self.count.checked_sub(1)?;
        let before = last.checked_sub(1)?;
        let (end, begun) = (*self.ends.get(last)?, self.ends.get(before)?.walked);
        self.count = last;
        let length = end.walked - begun;
        Some(RowLine {
            segment: Segment { number: end.number, ..self.last? },
            index: end.index,
            deviation: 0.0,
            is_merged: false,
            is_separate: true,
            start_length: length,
            end_length: length,
        })
    }

    /// How many chords wait.
    pub(crate) fn count(&self) -> usize {
        self.count
    }

    /// Where the path ends, given where it ends without these chords.
    pub(crate) fn end<'a>(&'a self, end: &'a Axes) -> &'a Axes {
        match &self.last {
            Some(Segment { path: Path::Straight { end }, .. }) if self.count > 0 => end,
            _ => end,
        }
    }

    /// Forgets all.
    pub(crate) fn clear(&mut self) {
        self.count = 0;
    }

    /// Whether a segment continues the row.
    pub(crate) fn continues(&self, segment: &Segment) -> bool {
        self.last.is_some_and(|last| {
            last.feed == segment.feed && last.path_control == segment.path_control
        })
    }

    /// Whether no line can replace the last chord together with the next one: the end between them is farther from
    /// the line past it than two such deviations.
    pub(crate) fn turns_sharply(&self, next: &Segment) -> bool {
        let Path::Straight { end } = &next.path else { return true };
        let Some(last) = self.pending().last() else { return false };
        let before = self.count.checked_sub(2).and_then(|before| self.ends.get(before));
        let before = before.map_or(self.start_on_path, |before| before.place);
        let (mut one, mut other) = (last.place, leading(end));
        for (other, place) in other.iter_mut().zip(&last.place) {
            *other -= place;
        }
        for (one, place) in one.iter_mut().zip(&before) {
            *one -= place;
        }
        let (first, second, along) = (dot(&one, &one), dot(&other, &other), dot(&one, &other));
        let far = squared(2.0 * self.allowed_deviation());
        if along <= 0.0 {
            return math::min(first, second) > far;
        }
        first * second - squared(along) > far * (first + second + 2.0 * along)
    }

    /// Adds a chord.
    pub(crate) fn push(
        &mut self,
        segment: &Segment,
        (start, length): (&Axes, f64),
        (index, is_separate): (u64, bool),
        limits: &Limits,
    ) {
        let Path::Straight { end } = &segment.path else { return };
        if self.count == 0 {
            self.start = leading(start);
            (self.start_on_path, self.start_deviation) = (self.start, 0.0);
            self.is_separate = is_separate;
            self.before = None;
            let cycle = feed_of(segment) * limits.cycle;
            self.length = math::max(FIRST_LINE_CYCLES * cycle, FIRST_LINE_CHORDS * length);
            (self.base, self.change) = (BASE_CYCLES * cycle, None);
        }
        let walked = self.walked() + length;
        if let Some(last) = self.ends.get_mut(self.count) {
            *last = ChordEnd { place: leading(end), walked, number: segment.number, index };
            self.count = self.count.saturating_add(1);
        }
        self.last = Some(*segment);
    }

    /// The way along all chords.
    fn walked(&self) -> f64 {
        self.pending().last().map_or(0.0, |last| last.walked)
    }

    fn pending(&self) -> &[ChordEnd] {
        self.ends.get(..self.count).unwrap_or_default()
    }

    /// The next line, if there are chords enough for it.
    #[inline]
    pub(crate) fn next_line(&mut self, limits: &Limits) -> Option<RowLine> {
        let walked = self.walked();
        if walked < self.length * (1.0 + MEAN_RANGE_RATIO) && self.count < ENDS_MAX {
            return None;
        }
        self.line_to_mean(walked, limits).or_else(|| self.last_line(limits))
    }

    /// A line to a mean of the chords.
    #[inline(never)]
    fn line_to_mean(&mut self, walked: f64, limits: &Limits) -> Option<RowLine> {
        let allowed = self.allowed_deviation();
        let mut length = math::min(self.length, walked / (1.0 + MEAN_RANGE_RATIO));
        for _ in 0..TRIALS {
            let reach = MEAN_RANGE_RATIO * length;
            let end = self.mean(length - reach, length + reach);
            let passed = self.pending().iter().take_while(|end| end.walked < length).count();
            if passed == 0 || passed.saturating_add(1) >= self.count {
                return None;
            }
            let on_path = self.place_on_path(length, passed);
            let apart = distance_sq(&on_path, &end);
            let deviation = self.deviation(&end, passed, apart);
            if deviation <= allowed {
                return Some(self.take(
                    passed,
                    (end, on_path, math::sqrt(apart)),
                    (length, deviation),
                    limits,
                ));
            }
            length *= SHRINKING_RATIO;
        }
        None
    }

    /// The longest line that ends where a chord does, preferably one that leaves most of the tolerance to the corner
    /// at its end.
    #[inline(never)]
    pub(crate) fn last_line(&mut self, limits: &Limits) -> Option<RowLine> {
        let allowed = self.allowed_deviation();
        let fewest = self.count >> 2;
        let (passed, deviation) = self
            .longest_line(LAST_LINE_RATIO * allowed)
            .filter(|(passed, _)| *passed >= fewest)
            .or_else(|| self.longest_line(allowed))?;
        let end = *self.ends.get(passed)?;
        let deviation = (end.walked, deviation);
        Some(self.take(passed, (end.place, end.place, 0.0), deviation, limits))
    }

    /// The same with little work: each call tries one line, a shorter one each time.
    pub(crate) fn try_last_line(&mut self, limits: &Limits) -> Option<RowLine> {
        let most = self.count.checked_sub(1)?;
        let passed = self.trial.unwrap_or(most).min(most);
        let end = *self.ends.get(passed)?;
        let deviation = self.deviation(&end.place, passed, 0.0);
        if deviation <= self.allowed_deviation() || passed == 0 {
            let deviation = (end.walked, deviation);
            return Some(self.take(passed, (end.place, end.place, 0.0), deviation, limits));
        }
        self.trial = Some(passed.saturating_sub((passed >> 2).max(1)));
        None
    }

    /// The longest line that ends where a chord does and leaves the chords no farther: how many ends it passes, and how
    /// far it leaves them.
    fn longest_line(&self, allowed: f64) -> Option<(usize, f64)> {
        let mut passed = self.count.checked_sub(1)?;
        loop {
            let end = self.ends.get(passed)?;
            let deviation = self.deviation(&end.place, passed, 0.0);
            if deviation <= allowed || passed == 0 {
                return Some((passed, deviation));
            }
            passed = passed.saturating_sub((passed >> 3).max(1));
        }
    }

    fn allowed_deviation(&self) -> f64 {
        match self.last {
            Some(Segment { path_control: PathControl::Within(tolerance), .. }) => {
                LINE_DEVIATION_RATIO_MAX * tolerance
            }
            _ => 0.0,
        }
    }

    /// The greatest distance of the line to `end` from the chords that it replaces, `passed` ends and a place that is
    /// `apart`, squared, from its own end. Infinite where the chords turn back.
    fn deviation(&self, end: &Place, passed: usize, apart: f64) -> f64 {
        let mut direction = *end;
        for (value, start) in direction.iter_mut().zip(&self.start) {
            *value -= start;
        }
        let length = math::sqrt(dot(&direction, &direction));
        if length <= 0.0 {
            return f64::INFINITY;
        }
        let direction = direction.map(|value| value / length);
        let mut farthest = math::max(squared(self.start_deviation), apart);
        let (mut last, back) = (0.0, self.allowed_deviation());
        for end in self.ends.iter().take(passed) {
            let mut from = end.place;
            for (value, start) in from.iter_mut().zip(&self.start) {
                *value -= start;
            }
            let along = dot(&from, &direction);
            if along < last - back {
                return f64::INFINITY;
            }
            last = math::max(last, along);
            let along = math::min(math::max(along, 0.0), length);
            for (value, rate) in from.iter_mut().zip(&direction) {
                *value -= along * rate;
            }
            farthest = math::max(farthest, dot(&from, &from));
        }
        math::sqrt(farthest)
    }

    /// The mean of the chords between two places.
    fn mean(&self, from: f64, to: f64) -> Place {
        let mut sum = [0.0; 3];
        let (mut before, mut begun) = (self.start_on_path, 0.0);
        for end in self.pending() {
            if end.walked > from {
                let inverse = 1.0 / (end.walked - begun);
                let (first, last) = (math::max(from, begun), math::min(to, end.walked));
                let share = (0.5 * (first + last) - begun) * inverse;
                let weight = last - first;
                for ((sum, before), after) in sum.iter_mut().zip(&before).zip(&end.place) {
                    *sum += weight * (before + share * (after - before));
                }
            }
            if end.walked >= to {
                break;
            }
            (before, begun) = (end.place, end.walked);
        }
        let inverse = 1.0 / (to - from);
        sum.map(|sum| sum * inverse)
    }

    /// The place on the chords after this way, on the chord after so many ends.
    fn place_on_path(&self, walked: f64, passed: usize) -> Place {
        let before = passed.checked_sub(1).and_then(|before| self.ends.get(before));
        let (mut place, begun) =
            before.map_or((self.start_on_path, 0.0), |end| (end.place, end.walked));
        if let Some(after) = self.ends.get(passed) {
            let share = (walked - begun) / (after.walked - begun);
            for (place, after) in place.iter_mut().zip(&after.place) {
                *place += share * (after - *place);
            }
        }
        place
    }

    /// Takes the chords of a line.
    fn take(
        &mut self,
        passed: usize,
        (end, on_path, apart): (Place, Place, f64),
        (walked, deviation): (f64, f64),
        limits: &Limits,
    ) -> RowLine {
        let last = self.ends.get(passed).copied().unwrap_or_default();
        let first = self.ends.first().map_or(0.0, |first| first.walked);
        let before_last = passed.checked_sub(1).and_then(|before| self.ends.get(before));
        let end_length = last.walked - before_last.map_or(0.0, |end| end.walked);
        let mut direction = end;
        for (value, start) in direction.iter_mut().zip(&self.start) {
            *value -= start;
        }
        let length = math::sqrt(dot(&direction, &direction));
        let direction = direction.map(|value| value / length);
        self.trial = None;
        let is_separate = core::mem::take(&mut self.is_separate);
        self.length = self.next_length(walked, (direction, length, deviation), limits);
        self.before = Some((direction, length, deviation));
        // A chord that ends here has no rest.
        let gone = if last.walked <= walked { passed.saturating_add(1) } else { passed };
        let gone = gone.min(self.count);
        self.ends.copy_within(gone..self.count, 0);
        self.count = self.count.saturating_sub(gone);
        for end in self.ends.iter_mut().take(self.count) {
            end.walked -= walked;
        }
        (self.start, self.start_on_path, self.start_deviation) = (end, on_path, apart);
        let mut segment = self.last.unwrap_or(EMPTY);
        if let Path::Straight { end: place } = &mut segment.path {
            for (place, end) in place.iter_mut().zip(&end) {
                *place = *end;
            }
        }
        segment.number = last.number;
        RowLine {
            segment,
            index: last.index,
            deviation,
            is_merged: passed > 0 || apart > 0.0,
            is_separate,
            start_length: first,
            end_length,
        }
    }

    /// How long the next line is to be. Where the corner before this one is slower than its feed and rounding turns it,
    /// lines become longer; where the path is smooth, shorter.
    fn next_length(
        &mut self,
        walked: f64,
        (direction, length, deviation): (Place, f64, f64),
        limits: &Limits,
    ) -> f64 {
        let Some((before, other, other_deviation)) = self.before else { return walked };
        let Some(last) = &self.last else { return walked };
        let PathControl::Within(tolerance) = last.path_control else { return walked };
        let mut change = direction;
        for (value, before) in change.iter_mut().zip(&before) {
            *value -= before;
        }
        let old = self.change.replace(change);
        let Some(old) = old else { return walked };
        let turn_sq = dot(&change, &change);
        let apart = distance_sq(&change, &old);
        let turn = math::sqrt(turn_sq);
        let left = tolerance - math::max(deviation, other_deviation);
        let used = math::min(0.5 * math::min(length, other), 4.0 * left / turn);
        let speed = feed_of(last);
        let is_slow = 2.0 * used * limits.softest < squared(speed) * turn;
        if apart > NOISE_SQ * turn_sq {
            return if is_slow { GROWTH_RATIO * walked } else { walked };
        }
        if turn > TURN_MAX_RAD {
            walked * math::max(0.5, TURN_MAX_RAD / turn)
        } else if is_slow && 4.0 * left < 0.5 * length * turn {
            DECAY * walked
        } else if !is_slow {
            walked
        } else if apart < CALM_SQ * turn_sq {
            math::max(DECAY * walked, math::min(walked, self.base))
        } else {
            walked
        }
    }
}

const EMPTY: Segment = Segment {
    number: 0,
    path: Path::Dwell { seconds: 0.0 },
    feed: Feed::Rapid,
    path_control: PathControl::ExactStop,
    probing: false,
};
