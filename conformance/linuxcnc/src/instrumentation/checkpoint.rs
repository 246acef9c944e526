//! Reads the output of checkpoint lines.

use gaugeblock_adapter::HarnessError;

use super::instrument::{MODES, Plan};

/// A place that the run reached, and the values of modes and parameters that were printed there.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Checkpoint {
    /// File, 0 for the main program.
    pub(crate) file: usize,
    /// The last line that was executed or skipped, 0 before the first.
    pub(crate) line: u32,
    modes: Vec<i64>,
    names: &'static [&'static str],
    numbers: Vec<f64>,
    /// The plan's parameters in its order; `None` for a parameter that does not exist.
    pub(crate) parameters: Vec<Option<f64>>,
}

impl Checkpoint {
    /// A mode by the name of its parameter.
    pub(crate) fn mode(&self, name: &str) -> i64 {
        let names = MODES.iter().copied().flatten();
        names.zip(&self.modes).find(|(known, _)| **known == name).map_or(-1, |(_, value)| *value)
    }

    /// Whether a mode that is either 0 or 1 is on.
    pub(crate) fn is(&self, name: &str) -> bool {
        self.mode(name) == 1
    }

    /// Whether another checkpoint has the same modes and numbers.
    pub(crate) fn has_same_modes(&self, other: &Self) -> bool {
        self.modes == other.modes && self.numbers == other.numbers
    }

    /// A number by the name of its parameter; 0 if it is not printed.
    pub(crate) fn number(&self, name: &str) -> f64 {
        let names = self.names.iter();
        names.zip(&self.numbers).find(|(known, _)| **known == name).map_or(0.0, |(_, value)| *value)
    }
}

/// Assembles checkpoints from their lines.
#[derive(Debug)]
pub(crate) struct Reader<'a> {
    plan: &'a Plan,
    parts: usize,
    values: Vec<Option<f64>>,
    place: Option<(usize, u32)>,
    next: usize,
    /// Whether the run was aborted: the output can begin with the rest of a checkpoint, and a checkpoint can be
    /// incomplete.
    broken_off: bool,
}

impl<'a> Reader<'a> {
    /// A reader for the checkpoints of a plan.
    pub(crate) fn new(plan: &'a Plan) -> Self {
        let parts = MODES.len() + 1 + plan.parameter_groups().len();
        Self { plan, parts, values: Vec::new(), place: None, next: 0, broken_off: false }
    }

    /// A reader for the output after an abort. The rest of an interrupted checkpoint is skipped. The run may begin
    /// another checkpoint before it stops.
    pub(crate) fn is_incomplete(plan: &'a Plan) -> Self {
        Self { broken_off: true, ..Self::new(plan) }
    }

    /// Takes the text of a checkpoint line after the marker; returns the checkpoint when it is complete.
    pub(crate) fn take(&mut self, line: &str) -> Result<Option<Checkpoint>, HarnessError> {
        let wrong =
            |what: &str| HarnessError::Unreadable { what: what.to_owned(), line: line.to_owned() };
        let mut words = line.split_whitespace();
        let mut number = |what| {
            words.next().and_then(|word| word.parse::<u32>().ok()).ok_or_else(|| wrong(what))
        };
        let file = usize::try_from(number("checkpoint's file")?)
            .map_err(|_| wrong("checkpoint's file"))?;
        let place = (file, number("checkpoint's line")?);
        let part = number("checkpoint's part")?;
        if self.broken_off && part == 0 {
            self.next = 0;
            self.values.clear();
        } else if self.broken_off && self.next == 0 {
            return Ok(None);
        }
        if usize::try_from(part) != Ok(self.next) || (self.next > 0 && self.place != Some(place)) {
            return Err(wrong("checkpoint out of order"));
        }
        self.place = Some(place);
        for word in words {
            let absent = word.starts_with("######");
            let value = if absent {
                None
            } else {
                Some(word.parse().map_err(|_| wrong("checkpoint's value"))?)
            };
            self.values.push(value);
        }
        self.next += 1;
        if self.next < self.parts {
            return Ok(None);
        }
        self.next = 0;
        let values = std::mem::take(&mut self.values);
        self.checkpoint(place, &values)
            .map(Some)
            .ok_or_else(|| wrong("checkpoint's number of values"))
    }

    fn checkpoint(&self, (file, line): (usize, u32), values: &[Option<f64>]) -> Option<Checkpoint> {
        let count = MODES.iter().map(|names| names.len()).sum();
        let (modes, rest) = values.split_at_checked(count)?;
        let names = self.plan.numbers();
        let (numbers, parameters) = rest.split_at_checked(names.len())?;
        if parameters.len() != self.plan.parameters.len() {
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            reason = "modes are small whole numbers, printed as such"
        )]
        let modes = modes.iter().map(|mode| mode.map(|mode| mode as i64)).collect::<Option<_>>()?;
        let numbers = numbers.iter().copied().collect::<Option<_>>()?;
        Some(Checkpoint { file, line, modes, names, numbers, parameters: parameters.to_vec() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan() -> Plan {
        Plan {
            marker: "@gb0@".to_owned(),
            parameters: vec!["31".to_owned(), "<x>".to_owned()],
            marks: None,
            parallel_axes: false,
            compensates: false,
        }
    }

    #[test]
    fn a_checkpoint_is_put_together() {
        let plan = plan();
        let mut reader = Reader::new(&plan);
        assert_eq!(reader.take("1 7 0  10 170 1 1 0 1 400 540 1 0 0"), Ok(None));
        assert_eq!(reader.take("1 7 1  0 1 1 1 0 1 0 0 0 5 -1 2"), Ok(None));
        assert_eq!(reader.take("1 7 2  100.000000000 0 1.5 0 0 0 0 -90.0"), Ok(None));
        let checkpoint = reader.take("1 7 3  2.500000000 ######").unwrap().unwrap();
        assert_eq!((checkpoint.file, checkpoint.line), (1, 7));
        assert_eq!((checkpoint.mode("_motion_mode"), checkpoint.mode("_call_level")), (10, 2));
        assert!(checkpoint.is("_flood") && !checkpoint.is("_mist"));
        assert_eq!(
            [checkpoint.number("_x"), checkpoint.number("_c")].map(f64::to_bits),
            [1.5, -90.0].map(f64::to_bits)
        );
        assert_eq!(checkpoint.parameters, vec![Some(2.5), None]);
    }

    #[test]
    fn the_rest_of_a_torn_checkpoint_is_passed_over() {
        let plan = plan();
        let mut reader = Reader::is_incomplete(&plan);
        assert_eq!(reader.take("0 2 3  54.000000000 1"), Ok(None));
        assert_eq!(reader.take("1 7 0  10 170 1 1 0 1 400 540 1 0 0"), Ok(None));
        // The run continued to another checkpoint, and stopped within it.
        assert_eq!(reader.take("0 0 0  10 170 1 1 0 1 400 540 1 0 0"), Ok(None));
        // After its first part a checkpoint must be complete.
        assert!(reader.take("0 0 2  1 0 0 0 0 0 0 0").is_err());
    }

    #[test]
    fn parts_out_of_order_are_refused() {
        let plan = plan();
        assert!(Reader::new(&plan).take("1 7 1 0").is_err());
        let mut reader = Reader::new(&plan);
        reader.take("0 1 0 1 2 3").unwrap();
        assert!(reader.take("0 2 1 1 2 3").is_err());
    }
}
