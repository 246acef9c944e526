//! Samples of stretches of constant acceleration, with a defect if the case has one.

use gaugeblock_suite::{MotionCase, Piece, SampleDefect};
use gaugeblock_vocabulary::Axis;
use gaugeblock_vocabulary::motion::{Column, Samples};

/// The samples of a case that has some, with its defect.
///
/// # Errors
/// An unknown column, a defect in a column or sample that does not exist, or values that samples cannot have.
pub fn synthesize(case: &MotionCase) -> Result<Samples, String> {
    let limits = case.limits()?;
    let axes: Vec<Axis> = limits.axes.keys().copied().collect();
    let mut columns: Vec<Column> = axes.iter().copied().map(Column::Position).collect();
    for name in case.columns.keys() {
        let column = Column::from_name(name).ok_or_else(|| format!("no column `{name}`"))?;
        columns.push(column);
    }
    let every = case.every.unwrap_or(1.0);
    let positions = positions(&case.pieces, &axes, (limits.period, every));
    let mut rows = Vec::with_capacity(positions.len());
    for (sample, mut row) in positions.into_iter().enumerate() {
        for changes in case.columns.values() {
            let now = changes.iter().take_while(|(from, _)| *from <= sample).last();
            row.push(now.map_or(0.0, |(_, value)| *value));
        }
        rows.push(row);
    }
    if let Some(fault) = &case.fault {
        apply_defect(fault, &columns, &mut rows)?;
    }
    let wrong = |error: gaugeblock_vocabulary::motion::SamplesError| error.to_string();
    let mut samples =
        Samples::new(limits.period * every, case.resolution, columns).map_err(wrong)?;
    for row in &rows {
        samples.push(row).map_err(wrong)?;
    }
    Ok(samples)
}

/// A stretch, with position and speed of each axis at its begin.
struct Stretch {
    /// Servo cycles from the start.
    from: f64,
    at: Vec<f64>,
    speed: Vec<f64>,
    acceleration: Vec<f64>,
}

/// Positions of axes, sample by sample, from the first one at rest in the origin to the end of the last stretch.
fn positions(pieces: &[Piece], axes: &[Axis], (period, every): (f64, f64)) -> Vec<Vec<f64>> {
    let zeros = || vec![0.0; axes.len()];
    let (mut from, mut at, mut speed) = (0.0, zeros(), zeros());
    let mut stretches: Vec<Stretch> = Vec::new();
    for piece in pieces {
        if let Some(given) = &piece.speed {
            speed = axes.iter().map(|axis| given.get(axis).copied().unwrap_or(0.0)).collect();
        }
        let acceleration: Vec<f64> =
            axes.iter().map(|axis| piece.accelerate.get(axis).copied().unwrap_or(0.0)).collect();
        let stretch = Stretch { from, at, speed, acceleration };
        let seconds = piece.cycles * period;
        at = stretch.position(seconds);
        let later = stretch.speed.iter().zip(&stretch.acceleration);
        speed = later.map(|(speed, acceleration)| speed + acceleration * seconds).collect();
        from += piece.cycles;
        stretches.push(stretch);
    }
    let mut positions = Vec::new();
    let mut cycle = 0.0;
    while cycle <= from + 1e-9 {
        let place = stretches.partition_point(|stretch| stretch.from <= cycle);
        let Some(stretch) = stretches.get(place.saturating_sub(1)) else { break };
        positions.push(stretch.position((cycle - stretch.from) * period));
        cycle += every;
    }
    positions
}

impl Stretch {
    fn position(&self, seconds: f64) -> Vec<f64> {
        let rates = self.speed.iter().zip(&self.acceleration);
        let way = rates.map(|(speed, rate)| speed * seconds + rate * seconds * seconds / 2.0);
        self.at.iter().zip(way).map(|(at, way)| at + way).collect()
    }
}

/// Applies a defect to rows.
fn apply_defect(
    fault: &SampleDefect,
    columns: &[Column],
    rows: &mut Vec<Vec<f64>>,
) -> Result<(), String> {
    let place = |column: Column| {
        let place = columns.iter().position(|known| *known == column);
        place.ok_or_else(|| format!("the samples have no column {column}"))
    };
    let named = |name: &str| {
        Column::from_name(name).ok_or_else(|| format!("no column `{name}`")).and_then(place)
    };
    let count = rows.len();
    let range = |from: usize, samples: usize| {
        let range = from..from.saturating_add(samples);
        let fits = range.end <= count && !range.is_empty();
        fits.then_some(range).ok_or_else(|| format!("there are {count} samples, none at {from}"))
    };
    match fault {
        SampleDefect::Displaced { from, samples, by } => {
            for (axis, way) in by {
                let column = place(Column::Position(*axis))?;
                rows[range(*from, *samples)?].iter_mut().for_each(|row| row[column] += way);
            }
        }
        SampleDefect::Late { column, samples } => {
            let column = named(column)?;
            let values: Vec<f64> = rows.iter().map(|row| row[column]).collect();
            for (sample, row) in rows.iter_mut().enumerate() {
                let from = sample.saturating_add_signed(samples.saturating_neg());
                row[column] = values[from.min(count - 1)];
            }
        }
        SampleDefect::LeftOut { from, samples } => {
            rows.drain(range(*from, *samples)?);
        }
        SampleDefect::Repeated { from, samples } => {
            let row = rows[range(*from, 1)?.start].clone();
            rows.splice(from..from, std::iter::repeat_n(row, *samples));
        }
        SampleDefect::Reversed { from, samples } => rows[range(*from, *samples)?].reverse(),
        SampleDefect::Value { column, from, samples, value } => {
            let column = named(column)?;
            rows[range(*from, *samples)?].iter_mut().for_each(|row| row[column] = *value);
        }
    }
    Ok(())
}
