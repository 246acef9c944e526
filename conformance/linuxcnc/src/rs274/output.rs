//! Reads standard output: canonical calls, checkpoints, and the text of (PRINT,…).

use gaugeblock_adapter::HarnessError;

use crate::instrumentation::checkpoint::{Checkpoint, Reader};
use crate::instrumentation::instrument::Plan;

/// A canonical call as it is printed: `STRAIGHT_FEED(1.0000, …)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Call {
    /// Name.
    pub(super) name: String,
    /// Everything between the parentheses.
    pub(super) arguments: String,
}

impl Call {
    /// The numbers among the arguments, which are separated by commas or blanks.
    pub(super) fn numbers(&self) -> Vec<f64> {
        let parts = self.arguments.split([',', ' ']);
        parts.filter_map(|part| part.trim().parse().ok()).collect()
    }

    /// The text between the quotes.
    pub(super) fn text(&self) -> &str {
        let inner = self.arguments.strip_prefix('"').unwrap_or(&self.arguments);
        inner.strip_suffix('"').unwrap_or(inner)
    }

    /// The error for a call that the adapter does not understand.
    pub(super) fn unreadable(&self, what: &str) -> HarnessError {
        HarnessError::Unreadable {
            what: what.to_owned(),
            line: format!("{}({})", self.name, self.arguments),
        }
    }
}

/// A line of standard output, or all lines of a checkpoint.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Line {
    /// A canonical call.
    Call(Call),
    /// A checkpoint.
    Checkpoint(Box<Checkpoint>),
    /// Text that the program printed.
    Text(String),
    /// The comment of a checkpoint: all that waited before it is out.
    Passed,
}

/// Reads the whole output. If it was cut off, the last line is ignored.
///
/// # Errors
/// A checkpoint line that is not as planned.
pub(super) fn lines(stdout: &str, plan: &Plan, cut_off: bool) -> Result<Vec<Line>, HarnessError> {
    let mut lines = Vec::new();
    let mut reader = Reader::new(plan);
    let mut count = 0;
    let (passed, release) = (plan.waiting_comment(), plan.release_comment());
    let mut released = false;
    let whole =
        if cut_off { stdout.rsplit_once('\n').map_or("", |(whole, _)| whole) } else { stdout };
    // A carriage return belongs to what is printed.
    for line in whole.split_terminator('\n') {
        if let Some(checkpoint) = line.strip_prefix(&plan.marker) {
            lines.extend(
                reader.take(checkpoint)?.map(|checkpoint| Line::Checkpoint(Box::new(checkpoint))),
            );
        } else if let Some(call) = call(line, count + 1) {
            count += 1;
            let comment = Some(call.text()).filter(|_| call.name == "COMMENT");
            if comment == Some(passed.as_str()) {
                lines.push(Line::Passed);
            } else if comment == Some(release.as_str()) {
                released = true;
            } else if call.name != "OPTIONAL_PROGRAM_STOP" || !std::mem::take(&mut released) {
                lines.push(Line::Call(call));
            }
        } else {
            lines.push(Line::Text(line.to_owned()));
        }
    }
    Ok(lines)
}

/// A canonical call with the expected sequence number: `   12 N10    DWELL(1.0000)`.
fn call(line: &str, expected: u64) -> Option<Call> {
    let (number, rest) = line.trim_start().split_once(' ')?;
    if number.parse() != Ok(expected) {
        return None;
    }
    // The N word of the block: dots if there is none. A long N word is followed by the name without a blank.
    let rest = rest.strip_prefix('N')?.trim_start_matches(|c: char| c.is_ascii_digit() || c == '.');
    let (name, arguments) = rest.trim_start().split_once('(')?;
    let arguments = arguments.strip_suffix(')')?;
    Some(Call { name: name.to_owned(), arguments: arguments.to_owned() })
}

/// The calls and texts of a run, without checkpoints: to compare an instrumented run with a plain one.
pub(super) fn calls_and_texts(lines: &[Line]) -> Vec<String> {
    let text = |line: &Line| match line {
        Line::Call(call) if call.name == "ON_RESET" => None,
        Line::Call(call) => Some(format!("{}({})", call.name, call.arguments)),
        Line::Text(text) => Some(text.clone()),
        Line::Checkpoint(_) | Line::Passed => None,
    };
    lines.iter().filter_map(text).collect()
}

/// Copies arguments and texts of a plain run into the same calls of an instrumented one, since `#<_line>` counts
/// checkpoint lines, too.
pub(super) fn adopt(observed: &mut [Line], unobserved: &[Line]) {
    let is_own = |line: &&mut Line| !matches!(line, Line::Checkpoint(_) | Line::Passed);
    let mine = observed.iter_mut().filter(is_own);
    for (mine, other) in mine.zip(unobserved) {
        let same = match (&*mine, other) {
            (Line::Call(mine), Line::Call(other)) => mine.name == other.name,
            (Line::Text(_), Line::Text(_)) => true,
            (Line::Call(_) | Line::Text(_) | Line::Checkpoint(_) | Line::Passed, _) => false,
        };
        if same {
            mine.clone_from(other);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plan() -> Plan {
        Plan {
            marker: "@gb0@".to_owned(),
            parameters: Vec::new(),
            marks: None,
            parallel_axes: false,
            compensates: true,
        }
    }

    #[test]
    fn calls_and_texts_are_distinguished() {
        let stdout = "    1 N..... USE_LENGTH_UNITS(CANON_UNITS_MM)\n    2 N1234567SET_FEED_RATE(3.0000)\n\
            hello\n    9 N..... forged\n    3 N5     MESSAGE(\"a (b\")\n    4 N..... SPINDLE.0.WAIT_ORIENT_COMPLETE(3.0000)\n";
        let lines = lines(stdout, &plan(), false).unwrap();
        let call = |name: &str, arguments: &str| {
            Line::Call(Call { name: name.to_owned(), arguments: arguments.to_owned() })
        };
        assert_eq!(
            lines,
            vec![
                call("USE_LENGTH_UNITS", "CANON_UNITS_MM"),
                call("SET_FEED_RATE", "3.0000"),
                Line::Text("hello".to_owned()),
                Line::Text("    9 N..... forged".to_owned()),
                call("MESSAGE", "\"a (b\""),
                call("SPINDLE.0.WAIT_ORIENT_COMPLETE", "3.0000"),
            ]
        );
    }

    #[test]
    fn a_cut_off_line_is_left_out() {
        let cut = lines("one\ntw", &plan(), true).unwrap();
        assert_eq!(cut, vec![Line::Text("one".to_owned())]);
    }

    #[test]
    fn arguments_are_read() {
        let call = Call {
            name: "USE_TOOL_LENGTH_OFFSET".to_owned(),
            arguments: "1.0000 2.0000 3.0000, 4.0000 5.0000 6.0000, 0.0000 0.0000 0.0000"
                .to_owned(),
        };
        let expected = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 0.0, 0.0, 0.0].map(f64::to_bits);
        assert_eq!(call.numbers().into_iter().map(f64::to_bits).collect::<Vec<_>>(), expected);
        let quoted = Call { name: "MESSAGE".to_owned(), arguments: "\"say \"hi\"\"".to_owned() };
        assert_eq!(quoted.text(), "say \"hi\"");
    }
}
