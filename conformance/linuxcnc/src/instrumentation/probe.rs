//! Reads what the probe lines print.

use gaugeblock_adapter::HarnessError;

use super::instrument::{MODES, NUMBERS, Plan};

/// One probe: a place that the run reached, and what it printed there.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct Probe {
    /// File, 0 for the main program.
    pub(crate) file: usize,
    /// Line that was passed last, 0 before the first.
    pub(crate) line: u32,
    modes: Vec<i64>,
    numbers: Vec<f64>,
    /// The plan's parameters in its order; none where it does not exist.
    pub(crate) parameters: Vec<Option<f64>>,
}

impl Probe {
    /// A mode by the name of its parameter.
    pub(crate) fn mode(&self, name: &str) -> i64 {
        let names = MODES.iter().copied().flatten();
        names.zip(&self.modes).find(|(known, _)| **known == name).map_or(-1, |(_, value)| *value)
    }

    /// Whether a mode that is either 0 or 1 is on.
    pub(crate) fn is(&self, name: &str) -> bool {
        self.mode(name) == 1
    }

    /// Whether another probe has the same modes and numbers.
    pub(crate) fn has_same_modes(&self, other: &Self) -> bool {
        self.modes == other.modes && self.numbers == other.numbers
    }

    /// A number by the name of its parameter.
    pub(crate) fn number(&self, name: &str) -> f64 {
        let names = NUMBERS.iter();
        names.zip(&self.numbers).find(|(known, _)| **known == name).map_or(0.0, |(_, value)| *value)
    }
}

/// Puts the lines of a probe together.
#[derive(Debug)]
pub(crate) struct Reader<'a> {
    plan: &'a Plan,
    parts: usize,
    values: Vec<Option<f64>>,
    place: Option<(usize, u32)>,
    next: usize,
    /// Whether the run was broken off: the rest of a probe may come, and one that has begun may never be whole.
    broken_off: bool,
}

impl<'a> Reader<'a> {
    /// A reader for the probes of a plan.
    pub(crate) fn new(plan: &'a Plan) -> Self {
        let parts = MODES.len() + 1 + plan.parameter_groups().len();
        Self { plan, parts, values: Vec::new(), place: None, next: 0, broken_off: false }
    }

    /// A reader after an aborted run, perhaps within a probe: the rest of that probe is skipped. The run may begin
    /// another one before it stops.
    pub(crate) fn is_incomplete(plan: &'a Plan) -> Self {
        Self { broken_off: true, ..Self::new(plan) }
    }

    /// Takes the text of a probe line after the marker; returns the probe when it is complete.
    pub(crate) fn take(&mut self, line: &str) -> Result<Option<Probe>, HarnessError> {
        let wrong =
            |what: &str| HarnessError::Unreadable { what: what.to_owned(), line: line.to_owned() };
        let mut words = line.split_whitespace();
        let mut number = |what| {
            words.next().and_then(|word| word.parse::<u32>().ok()).ok_or_else(|| wrong(what))
        };
        let file = usize::try_from(number("probe's file")?).map_err(|_| wrong("probe's file"))?;
        let place = (file, number("probe's line")?);
        let part = number("probe's part")?;
        if self.broken_off && part == 0 {
            self.next = 0;
            self.values.clear();
        } else if self.broken_off && self.next == 0 {
            return Ok(None);
        }
        if usize::try_from(part) != Ok(self.next) || (self.next > 0 && self.place != Some(place)) {
            return Err(wrong("probe out of order"));
        }
        self.place = Some(place);
        for word in words {
            let absent = word.starts_with("######");
            let value =
                if absent { None } else { Some(word.parse().map_err(|_| wrong("probe's value"))?) };
            self.values.push(value);
        }
        self.next += 1;
        if self.next < self.parts {
            return Ok(None);
        }
        self.next = 0;
        let values = std::mem::take(&mut self.values);
        self.probe(place, &values).map(Some).ok_or_else(|| wrong("probe's number of values"))
    }

    fn probe(&self, (file, line): (usize, u32), values: &[Option<f64>]) -> Option<Probe> {
        let count = MODES.iter().map(|names| names.len()).sum();
        let (modes, rest) = values.split_at_checked(count)?;
        let (numbers, parameters) = rest.split_at_checked(NUMBERS.len())?;
        if parameters.len() != self.plan.parameters.len() {
            return None;
        }
        #[expect(
            clippy::cast_possible_truncation,
            reason = "modes are small whole numbers, printed as such"
        )]
        let modes = modes.iter().map(|mode| mode.map(|mode| mode as i64)).collect::<Option<_>>()?;
        let numbers = numbers.iter().copied().collect::<Option<_>>()?;
        Some(Probe { file, line, modes, numbers, parameters: parameters.to_vec() })
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
        }
    }

    #[test]
    fn a_probe_is_put_together() {
        let plan = plan();
        let mut reader = Reader::new(&plan);
        assert_eq!(reader.take("1 7 0  10 170 1 1 0 1 400 540 1 0 0"), Ok(None));
        assert_eq!(reader.take("1 7 1  0 1 1 1 0 1 0 0 0 5 -1 2"), Ok(None));
        assert_eq!(reader.take("1 7 2  100.000000000 0 1.5 0 0 0 0 -90.0"), Ok(None));
        let probe = reader.take("1 7 3  2.500000000 ######").unwrap().unwrap();
        assert_eq!((probe.file, probe.line), (1, 7));
        assert_eq!((probe.mode("_motion_mode"), probe.mode("_call_level")), (10, 2));
        assert!(probe.is("_flood") && !probe.is("_mist"));
        assert_eq!(
            [probe.number("_x"), probe.number("_c")].map(f64::to_bits),
            [1.5, -90.0].map(f64::to_bits)
        );
        assert_eq!(probe.parameters, vec![Some(2.5), None]);
    }

    #[test]
    fn the_rest_of_a_torn_probe_is_passed_over() {
        let plan = plan();
        let mut reader = Reader::is_incomplete(&plan);
        assert_eq!(reader.take("0 2 3  54.000000000 1"), Ok(None));
        assert_eq!(reader.take("1 7 0  10 170 1 1 0 1 400 540 1 0 0"), Ok(None));
        // The run went on to another one, and stood within that.
        assert_eq!(reader.take("0 0 0  10 170 1 1 0 1 400 540 1 0 0"), Ok(None));
        // From its first part on a probe is whole again.
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
