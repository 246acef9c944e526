//! What is known of each sample, in pages.

use crate::motion::recording::{Bytes, Count, Form, Paged, Storage, write_count};

/// A point of the path: a leg and its parameter.
#[derive(Clone, Copy, Debug, Default, PartialEq, PartialOrd)]
pub(in super::super) struct Place {
    pub(in super::super) leg: usize,
    pub(in super::super) part: f64,
}

/// The points of a piece that match a sample.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Reach {
    pub(super) piece: usize,
    pub(super) low: f64,
    pub(super) high: f64,
}

#[derive(Debug)]
struct ReachForm;

impl Form for ReachForm {
    type Item = Reach;

    fn write(&self, item: &Reach, bytes: &mut Vec<u8>) {
        write_count(item.piece, bytes);
        bytes.extend(item.low.to_le_bytes());
        bytes.extend(item.high.to_le_bytes());
    }

    fn read(&self, bytes: &mut Bytes<'_>) -> Reach {
        Reach { piece: bytes.count(), low: bytes.number(), high: bytes.number() }
    }
}

/// Where the row of a sample is in the sequence of all reaches.
#[derive(Clone, Copy, Debug, Default)]
struct Span {
    from: usize,
    len: usize,
}

#[derive(Debug)]
struct SpanForm;

impl Form for SpanForm {
    type Item = Span;

    fn write(&self, item: &Span, bytes: &mut Vec<u8>) {
        write_count(item.from, bytes);
        write_count(item.len, bytes);
    }

    fn read(&self, bytes: &mut Bytes<'_>) -> Span {
        Span { from: bytes.count(), len: bytes.count() }
    }
}

/// The matching points of each sample, in the order of the path.
#[derive(Debug)]
pub(super) struct Rows {
    spans: Paged<SpanForm>,
    reaches: Paged<ReachForm>,
}

impl Rows {
    pub(super) fn new(storage: &Storage) -> Self {
        Self { spans: Paged::new(SpanForm, storage), reaches: Paged::new(ReachForm, storage) }
    }

    pub(super) fn len(&self) -> usize {
        self.spans.len()
    }

    pub(super) fn push(&mut self, row: &[Reach]) {
        self.spans.push(Span { from: self.reaches.len(), len: row.len() });
        for reach in row {
            self.reaches.push(*reach);
        }
    }

    pub(super) fn get(&self, sample: usize) -> Vec<Reach> {
        let span = self.spans.get(sample);
        (span.from..span.from + span.len).map(|place| self.reaches.get(place)).collect()
    }

    /// Replaces a row by one with at most as many items.
    pub(super) fn shorten(&mut self, sample: usize, row: &[Reach]) {
        let span = self.spans.get(sample);
        for (place, reach) in (span.from..).zip(row) {
            self.reaches.set(place, *reach);
        }
        self.spans.set(sample, Span { len: row.len(), ..span });
    }

    /// A count for each reach, zero at first.
    pub(super) fn counts(&self, storage: &Storage) -> Paged<Count> {
        Paged::filled(Count, storage, self.reaches.len())
    }

    /// The place of a reach of a row in the sequence of all reaches.
    pub(super) fn place(&self, sample: usize, reach: usize) -> usize {
        self.spans.get(sample).from + reach
    }
}

/// What a sample is matched with.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Match {
    /// The best matching point.
    pub(super) place: Place,
    /// First and last leg with a matching point.
    pub(super) legs: (usize, usize),
    /// Whether the end of the last leg matches.
    pub(super) ends: bool,
}

#[derive(Debug)]
pub(super) struct MatchForm;

impl Form for MatchForm {
    type Item = Match;

    fn write(&self, item: &Match, bytes: &mut Vec<u8>) {
        write_count(item.place.leg, bytes);
        bytes.extend(item.place.part.to_le_bytes());
        write_count(item.legs.0, bytes);
        write_count(item.legs.1, bytes);
        write_count(usize::from(item.ends), bytes);
    }

    fn read(&self, bytes: &mut Bytes<'_>) -> Match {
        let place = Place { leg: bytes.count(), part: bytes.number() };
        Match { place, legs: (bytes.count(), bytes.count()), ends: bytes.count() > 0 }
    }
}
