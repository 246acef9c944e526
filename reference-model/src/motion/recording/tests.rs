//! Pages of a recording come back as they were, and few of them are in memory.

use gaugeblock_vocabulary::motion::{Column, Samples};
use gaugeblock_vocabulary::{Axis, Position};

use super::pages::PAGES_IN_MEMORY;
use super::{PageStore, Recording};

/// A store in memory; it fails after so many calls.
struct Pages {
    bytes: Vec<u8>,
    calls_left: usize,
}

impl Pages {
    fn boxed(calls_left: usize) -> Option<Box<dyn PageStore>> {
        Some(Box::new(Self { bytes: Vec::new(), calls_left }))
    }

    fn call(&mut self, place: u64) -> Result<usize, String> {
        self.calls_left = self.calls_left.checked_sub(1).ok_or("full")?;
        usize::try_from(place).map_err(|error| error.to_string())
    }
}

impl PageStore for Pages {
    fn append(&mut self, bytes: &[u8]) -> Result<u64, String> {
        let place = self.bytes.len() as u64;
        self.call(place)?;
        self.bytes.extend(bytes);
        Ok(place)
    }

    fn replace(&mut self, place: u64, bytes: &[u8]) -> Result<(), String> {
        let place = self.call(place)?;
        self.bytes[place..place + bytes.len()].copy_from_slice(bytes);
        Ok(())
    }

    fn read(&mut self, place: u64, bytes: &mut [u8]) -> Result<(), String> {
        let place = self.call(place)?;
        bytes.copy_from_slice(&self.bytes[place..place + bytes.len()]);
        Ok(())
    }
}

fn header() -> Samples {
    let columns = vec![Column::Queued, Column::Position(Axis::X), Column::Position(Axis::B)];
    Samples::new(0.001, 0.0, columns).expect("columns differ")
}

fn row(sample: u32) -> [f64; 3] {
    [f64::from(sample / 7), f64::from(sample) * 0.1, -f64::from(sample % 11)]
}

#[test]
fn samples_come_back_from_the_store_and_few_pages_are_in_memory() {
    let start = Position { z: 5.0, ..Position::default() };
    let mut recording = Recording::new(&header(), start, Pages::boxed(usize::MAX));
    for sample in 0..50_000 {
        recording.push(&row(sample)).expect("a row");
    }
    assert_eq!(recording.len(), 50_000);
    let mut found = Vec::new();
    for (sample, number) in (0..50_000).enumerate() {
        recording.read_row(sample, &mut found).expect("the store can be read");
        assert_eq!(found, row(number));
    }
    let expected = Position { x: 1234.0 * 0.1, z: 5.0, b: -2.0, ..Position::default() };
    assert_eq!(recording.position(1234), expected);
    assert_eq!(recording.moving(), Some((0, 49_998)));
    // Of the positions and of one column.
    assert_eq!(recording.most_in_memory(), 2 * PAGES_IN_MEMORY * 1024);
}

#[test]
fn without_a_store_all_samples_are_in_memory() {
    let mut recording = Recording::new(&header(), Position::default(), None);
    for sample in 0..50_000 {
        recording.push(&row(sample)).expect("a row");
    }
    assert!(recording.most_in_memory() >= 50_000, "{}", recording.most_in_memory());
}

#[test]
fn error_of_the_store_is_reported_from_then_on() {
    let mut recording = Recording::new(&header(), Position::default(), Pages::boxed(1));
    let pushed = (0..50_000).map(|sample| recording.push(&row(sample)));
    let errors: Vec<_> = pushed.filter_map(Result::err).map(|error| error.to_string()).collect();
    assert!(errors.len() > 10_000 && errors.iter().all(|error| error == "full"), "{errors:?}");
    assert!(recording.read_row(0, &mut Vec::new()).is_err());
}

#[test]
fn row_that_no_table_has_is_refused() {
    let mut recording = Recording::new(&header(), Position::default(), None);
    recording.push(&row(0)).expect("a row");
    let error = recording.push(&[0.5, 0.0, 0.0]).expect_err("half an element");
    assert_eq!(error.to_string(), "row 1: queued is 0.5, not a count");
}
