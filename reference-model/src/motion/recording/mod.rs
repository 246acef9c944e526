//! A recording: the samples of one motion, as the laws read them.
//!
//! A motion of hours has more samples than memory holds. A law looks far back at times: which points of the path a
//! sample can match is known only when later samples are, and a corner without a tolerance is passed for as long as
//! its legs last. So the laws read samples by their number, and a recording keeps those in memory that were read
//! last. The others are in a store that the caller supplies; without one, all are in memory.

mod pages;
#[cfg(test)]
mod tests;

use gaugeblock_vocabulary::motion::{Column, Samples};
use gaugeblock_vocabulary::{Axis, Position};

use super::vector::AxisVector;
pub(super) use pages::{Bytes, Count, Form, Number, Paged, Storage, write_count};
pub use pages::{PageStore, RecordingError};

/// Samples of one motion, evenly in time.
#[derive(Debug)]
pub struct Recording {
    /// Period, resolution and columns; no sample.
    header: Samples,
    storage: Storage,
    points: Paged<Point>,
    /// The columns that are not positions, each with its place in a row.
    others: Vec<(usize, Column, Paged<Number>)>,
    first: AxisVector,
    moved: [bool; 9],
    /// The greatest size of a coordinate, at least 1.
    size: f64,
    /// The first and the last sample after which the position changes.
    moving: Option<(usize, usize)>,
}

/// The form of a position: the axes that are recorded. The others have their coordinate of the start.
#[derive(Clone, Debug)]
pub(super) struct Point {
    elsewhere: AxisVector,
    /// The recorded axes: place in a row, place of the axis.
    axes: Vec<(usize, usize)>,
}

impl Form for Point {
    type Item = AxisVector;

    fn write(&self, item: &AxisVector, bytes: &mut Vec<u8>) {
        for (_, axis) in &self.axes {
            bytes.extend(item[*axis].to_le_bytes());
        }
    }

    fn read(&self, bytes: &mut Bytes<'_>) -> AxisVector {
        let mut point = self.elsewhere;
        for (_, axis) in &self.axes {
            point[*axis] = bytes.number();
        }
        point
    }
}

impl Recording {
    /// An empty recording with the period, resolution and columns of a table of samples. `start` has the coordinates
    /// of axes that are not recorded. Pages that do not fit into memory go to `store`.
    pub fn new(header: &Samples, start: Position, store: Option<Box<dyn PageStore>>) -> Self {
        let storage = Storage::of(store);
        let (mut axes, mut others) = (Vec::new(), Vec::new());
        for (place, column) in header.columns().iter().enumerate() {
            match column {
                Column::Position(axis) => axes.push((place, axis.place())),
                Column::Element
                | Column::Line
                | Column::Queued
                | Column::Output(_)
                | Column::SpindleSpeed(_) => {
                    others.push((place, *column, Paged::new(Number, &storage)));
                }
            }
        }
        let elsewhere = start.to_array();
        Self {
            header: header.without_rows(),
            points: Paged::new(Point { elsewhere, axes }, &storage),
            storage,
            others,
            first: elsewhere,
            moved: [false; 9],
            size: 1.0,
            moving: None,
        }
    }

    /// The recording of a whole table, in memory.
    pub fn of(samples: &Samples, start: Position) -> Self {
        let mut recording = Self::new(samples, start, None);
        for row in samples.rows() {
            recording.append(row);
        }
        recording
    }

    /// The recording of points alone, in memory; its period is a second.
    pub(super) fn of_points(points: &[AxisVector]) -> Self {
        let columns = Axis::ALL.iter().copied().map(Column::Position).collect();
        let header = Samples::new(1.0, 0.0, columns).expect("recording: axes differ");
        let mut recording = Self::new(&header, Position::default(), None);
        for point in points {
            recording.append(point);
        }
        recording
    }

    /// Appends a sample: a value for each column, in their order.
    ///
    /// # Errors
    /// A row that no table of samples has, or the store cannot be written.
    pub fn push(&mut self, row: &[f64]) -> Result<(), RecordingError> {
        self.header.check_row(self.len(), row).map_err(RecordingError::Row)?;
        self.append(row);
        self.storage.check()
    }

    fn append(&mut self, row: &[f64]) {
        let sample = self.len();
        let form = self.points.form();
        let mut point = form.elsewhere;
        for (place, axis) in &form.axes {
            point[*axis] = row[*place];
        }
        if sample == 0 {
            self.first = point;
        } else {
            let before = self.points.get(sample - 1);
            if Position::from(point) != Position::from(before) {
                self.moving = Some((self.moving.map_or(sample - 1, |moving| moving.0), sample - 1));
            }
        }
        for (axis, value) in point.iter().enumerate() {
            self.moved[axis] |= value.to_bits() != self.first[axis].to_bits();
            self.size = self.size.max(value.abs());
        }
        self.points.push(point);
        for (place, _, values) in &mut self.others {
            values.push(row[*place]);
        }
    }

    /// How many samples there are.
    pub fn len(&self) -> usize {
        self.points.len()
    }

    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Seconds between two samples.
    pub fn period(&self) -> f64 {
        self.header.period()
    }

    /// How far a recorded position may be from the commanded one, millimetres and degrees.
    pub fn resolution(&self) -> f64 {
        self.header.resolution()
    }

    /// Period, resolution and columns, as a table without samples.
    pub fn header(&self) -> &Samples {
        &self.header
    }

    /// What is recorded, in order.
    pub fn columns(&self) -> &[Column] {
        self.header.columns()
    }

    /// Whether something is recorded.
    pub fn has(&self, column: Column) -> bool {
        self.header.has(column)
    }

    /// The first and the last sample after which the position changes; `None` if nothing moves.
    pub fn moving(&self) -> Option<(usize, usize)> {
        self.moving
    }

    /// The position at a sample.
    pub fn position(&self, sample: usize) -> Position {
        Position::from(self.points.get(sample))
    }

    /// Reads a sample: a value for each column, in their order.
    ///
    /// # Errors
    /// The store cannot be read.
    pub fn read_row(&self, sample: usize, row: &mut Vec<f64>) -> Result<(), RecordingError> {
        row.clear();
        row.resize(self.columns().len(), 0.0);
        let point = self.points.get(sample);
        for (place, axis) in &self.points.form().axes {
            row[*place] = point[*axis];
        }
        for (place, _, values) in &self.others {
            row[*place] = values.get(sample);
        }
        self.check()
    }

    /// The greatest number of items that were in memory at once: positions, values of columns, and what the laws note
    /// of each sample.
    pub fn most_in_memory(&self) -> usize {
        self.storage.most_in_memory()
    }

    /// The first error of the store.
    pub(super) fn check(&self) -> Result<(), RecordingError> {
        self.storage.check()
    }

    pub(super) fn storage(&self) -> &Storage {
        &self.storage
    }

    pub(super) fn point(&self, sample: usize) -> AxisVector {
        self.points.get(sample)
    }

    pub(super) fn points(&self) -> impl Iterator<Item = AxisVector> + '_ {
        self.points.iter()
    }

    /// The values of a column that is not a position, if it is recorded.
    pub(super) fn column(&self, column: Column) -> Option<&Paged<Number>> {
        let known = self.others.iter().find(|(_, known, _)| *known == column);
        known.map(|(_, _, values)| values)
    }

    /// Which axes move.
    pub(super) fn moved(&self) -> [bool; 9] {
        self.moved
    }

    pub(super) fn size(&self) -> f64 {
        self.size
    }
}
