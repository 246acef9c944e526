//! Curves over time that keep few of many numbers: the lowest and the highest of each stretch.

use std::cmp::Ordering;

/// Most numbers that are kept; a multiple of four.
const NUMBERS_MAX: usize = 100_000;

/// Numbers over time. At most [`NUMBERS_MAX`] are kept, evenly in time.
#[derive(Clone, Debug)]
pub struct Thinned {
    /// How many numbers one of those kept is for.
    step: usize,
    seen: usize,
    kept: Vec<f64>,
    open: Extremes,
}

impl Thinned {
    /// No number yet; the step grows with the numbers.
    pub fn new() -> Self {
        Self { step: 1, seen: 0, kept: Vec::new(), open: Extremes::default() }
    }

    /// As many numbers are one of those kept as where so many samples are thinned.
    pub fn with_samples(samples: usize) -> Self {
        Self { step: Self::step_of(samples), ..Self::new() }
    }

    /// How many samples one of those kept is for: a power of two.
    pub fn step_of(samples: usize) -> usize {
        let mut step = 1;
        while samples > NUMBERS_MAX * step {
            step *= 2;
        }
        step
    }

    /// Adds a number.
    pub fn push(&mut self, number: f64) {
        if self.seen == NUMBERS_MAX * self.step {
            let kept = self.kept.chunks(4).flat_map(|four| {
                let mut extremes = Extremes::default();
                four.iter().for_each(|number| extremes.add(*number));
                extremes.in_order()
            });
            self.kept = kept.collect();
            self.step *= 2;
        }
        self.seen += 1;
        self.open.add(number);
        if self.open.count == 2 * self.step {
            self.kept.extend(std::mem::take(&mut self.open).in_order());
        }
    }

    /// Those that are kept: the lowest and the highest of each two steps, in their order.
    pub fn into_numbers(mut self) -> Vec<f64> {
        self.kept.extend(self.open.in_order());
        self.kept
    }
}

impl Default for Thinned {
    fn default() -> Self {
        Self::new()
    }
}

impl Extend<f64> for Thinned {
    fn extend<I: IntoIterator<Item = f64>>(&mut self, numbers: I) {
        numbers.into_iter().for_each(|number| self.push(number));
    }
}

/// The lowest and the highest of some numbers, each with its place.
#[derive(Clone, Debug, Default)]
struct Extremes {
    count: usize,
    lowest: Option<(usize, f64)>,
    highest: Option<(usize, f64)>,
}

impl Extremes {
    fn add(&mut self, number: f64) {
        let here = Some((self.count, number));
        let order = |other: Option<(usize, f64)>| other.map(|(_, other)| number.total_cmp(&other));
        if order(self.lowest).is_none_or(Ordering::is_lt) {
            self.lowest = here;
        }
        if order(self.highest).is_none_or(Ordering::is_ge) {
            self.highest = here;
        }
        self.count += 1;
    }

    fn in_order(self) -> impl Iterator<Item = f64> {
        let (mut first, mut second) = (self.lowest, self.highest);
        if first.zip(second).is_some_and(|(one, other)| one.0 > other.0) {
            (first, second) = (second, first);
        }
        let second = second.filter(|_| self.count > 1);
        first.into_iter().chain(second).map(|(_, number)| number)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn thinned(numbers: impl Iterator<Item = f64>) -> Thinned {
        let mut thinned = Thinned::new();
        thinned.extend(numbers);
        thinned
    }

    #[test]
    fn few_numbers_are_all_kept() {
        let numbers = [3.0, 1.0, 1.0, 2.0, f64::NAN, 5.0, -0.0];
        let kept = thinned(numbers.into_iter()).into_numbers();
        let bits =
            |numbers: &[f64]| numbers.iter().map(|number| number.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&kept), bits(&numbers));
    }

    #[test]
    fn of_many_numbers_the_extremes_are_kept() {
        let peak = |at: u32| if at == 777_777 { 9.0 } else { f64::from(at % 5) };
        let all = (0..1_000_000).map(peak);
        let grown = thinned(all.clone());
        assert_eq!(grown.step, Thinned::step_of(1_000_000));
        let kept = grown.into_numbers();
        assert!(kept.len() <= NUMBERS_MAX, "{}", kept.len());
        assert_eq!(kept.iter().filter(|number| **number > 8.0).count(), 1);
        let mut known = Thinned::with_samples(1_000_000);
        known.extend(all);
        assert_eq!(known.into_numbers(), kept);
    }
}
