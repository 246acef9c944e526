//! Reads what a controller and its driver print: blocks as they are read and executed, commands as they are issued.

use gaugeblock_adapter::HarnessError;
use serde_json::Value;

use super::session::MARK;
use crate::instrumentation::checkpoint::{Checkpoint, Reader};
use crate::instrumentation::instrument::Plan;

/// A command that the task controller issues, as it prints it: `Issuing EMC_TRAJ_DELAY -- ( +219,+104, +0,1.5,)`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Issued {
    /// Its name without `EMC_`.
    pub(super) name: String,
    /// Its arguments, without type, size and serial number; texts still escaped.
    pub(super) arguments: Vec<String>,
}

impl Issued {
    /// A report of the driver at its place among commands.
    pub(super) fn own(name: &str, argument: String) -> Self {
        Self { name: name.to_owned(), arguments: vec![argument] }
    }

    /// An argument as a number: `+3`, `1.500000`, or a byte such as `\001`.
    ///
    /// # Errors
    /// It is none.
    pub(super) fn number(&self, place: usize) -> Result<f64, HarnessError> {
        let text = self.arguments.get(place).map(String::as_str).unwrap_or_default();
        let mut characters = text.chars();
        let number = match (characters.next(), characters.next()) {
            // A byte: its number, or the character that it stands for. Of a negative one the digits are lost.
            (Some('\\'), Some('-')) => Some(-1.0),
            (Some('\\'), _) => text[1..].parse::<u8>().ok().map(f64::from),
            (Some(character), None) if !character.is_ascii_digit() => {
                u8::try_from(character).ok().map(f64::from)
            }
            _ => text.strip_prefix('+').unwrap_or(text).parse().ok(),
        };
        number.ok_or_else(|| self.unreadable())
    }

    /// An argument as a whole number.
    ///
    /// # Errors
    /// It is none.
    pub(super) fn whole(&self, place: usize) -> Result<i32, HarnessError> {
        let number = self.number(place)?;
        if number.fract().abs() > 0.0 || number.abs() > f64::from(i32::MAX) {
            return Err(self.unreadable());
        }
        #[expect(clippy::cast_possible_truncation, reason = "checked above")]
        let whole = number as i32;
        Ok(whole)
    }

    /// An argument as text, escapes undone.
    pub(super) fn text(&self, place: usize) -> String {
        self.arguments.get(place).map(|text| unescaped(text)).unwrap_or_default()
    }

    /// The error for a command that the adapter does not understand.
    pub(super) fn unreadable(&self) -> HarnessError {
        HarnessError::Unreadable {
            what: "issued command".to_owned(),
            line: format!("{}({})", self.name, self.arguments.join(",")),
        }
    }
}

/// The content of a line, or of all lines of a checkpoint.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Item {
    /// A block is about to be executed by the interpreter: its text, and its line in the file that is open.
    Block(String, u32),
    /// That is over.
    Executed,
    /// The current line of the interpreter.
    Line(u32),
    /// A command goes out.
    Issued(Issued),
    /// The interpreter refused a block.
    Refused(String),
    /// A user program exited with this status.
    UserProgramFailed(i32),
    /// A log file is opened: its name, and whether it is continued.
    LogOpen(String, bool),
    /// A text goes to the log file.
    Log(String),
    /// The log file is closed.
    LogClose,
    /// A checkpoint.
    Checkpoint(Box<Checkpoint>),
    /// Text that the program printed.
    Text(String),
    /// Word from the driver.
    Driver(Value),
}

impl Item {
    /// The checkpoint, if it is one.
    pub(super) fn checkpoint(&self) -> Option<&Checkpoint> {
        if let Self::Checkpoint(checkpoint) = self { Some(checkpoint) } else { None }
    }

    /// Whether it is anything except the driver's report that pins differed from those before the first run.
    pub(super) fn begins_as_new(&self) -> bool {
        let Self::Driver(report) = self else { return true };
        report.get("as_new").and_then(Value::as_bool) != Some(false)
    }

    /// Whether it reports an error of the program or of the controller.
    pub(super) fn is_error(&self) -> bool {
        matches!(self, Self::Refused(_))
            || matches!(self, Self::Driver(report) if report.get("error").and_then(Value::as_bool) == Some(true))
    }

    /// Whether it is the driver's word that the run is over.
    pub(super) fn is_end(&self) -> bool {
        matches!(self, Self::Driver(report) if report.get("ends").is_some())
    }
}

/// Beginnings of lines that say nothing about the program.
const NOISE: &[&str] = &[
    "emcTaskPlan",
    "task: ",
    "Interpreter stack:",
    "emc/task/",
    "mdi_execute_hook:",
    "emcTaskIssueCommand()",
    "emcSystemCmd:",
    "Issuing ",
];

/// What real time prints on a busy machine, at any moment.
const LATE: &str = "Unexpected realtime delay";

/// Reads the whole output of a run.
///
/// # Errors
/// A line that is not understood.
pub(super) fn items(lines: &[String], plan: &Plan) -> Result<Vec<Item>, HarnessError> {
    let mut items = Vec::new();
    let mut reader = Reader::new(plan);
    let mut executing = false;
    let mut refusal: Option<String> = None;
    let report: Vec<Value> = lines
        .iter()
        .filter_map(|line| serde_json::from_str(line.strip_prefix(MARK)?).ok())
        .collect();
    // What goes to the error channel is printed besides.
    let messages: Vec<&str> =
        report.iter().filter_map(|report| report.get("message").and_then(Value::as_str)).collect();
    // Real time prints its errors at any moment, while a block is executed, too.
    let is_error = |report: &&Value| report.get("error").and_then(Value::as_bool) == Some(true);
    let errors: Vec<&str> = report
        .iter()
        .filter(is_error)
        .filter_map(|report| report.get("message").and_then(Value::as_str))
        .map(str::trim_end)
        .collect();
    for line in lines {
        if let Some(report) = line.strip_prefix(MARK) {
            let report: Value =
                serde_json::from_str(report).map_err(|_| unreadable("driver", line))?;
            if report.get("ends").is_some() {
                // A run may end within a checkpoint, and print the rest of it until it stands.
                reader = Reader::is_incomplete(plan);
            }
            items.push(Item::Driver(report));
        } else if let Some(checkpoint) = line.strip_prefix(&plan.marker) {
            items.extend(
                reader.take(checkpoint)?.map(|checkpoint| Item::Checkpoint(Box::new(checkpoint))),
            );
        } else if let Some(item) = controller(line) {
            executing = matches!(item, Item::Block(..)) || executing && item != Item::Executed;
            if let Item::Refused(message) = &item {
                refusal = Some(message.clone());
            }
            items.push(item);
        } else if refusal.as_ref() == Some(line) {
            // What the interpreter refuses is printed twice.
            refusal = None;
        } else if !NOISE.iter().any(|start| line.starts_with(start)) && !line.contains(LATE) {
            if executing && !errors.contains(&line.trim_end()) {
                items.push(Item::Text(line.clone()));
            } else if !executing
                && !line.trim().is_empty()
                && !is_remark(line)
                && !messages.contains(&line.as_str())
            {
                return Err(unreadable("line", line));
            }
        }
    }
    Ok(items)
}

/// Whether a line repeats a message of the error channel.
fn is_remark(line: &str) -> bool {
    [
        "wait for orient complete",
        "ERROR: ",
        "fault ",
        "Note: ",
        "Found file",
        "Machine configuration",
        // An arc without a centre, which it leaves out.
        "std::isnan error in ",
        // What motion rejects, in addition to its message.
        "USRMOT: ERROR: ",
        "Starting ",
        "linuxcnc ",
    ]
    .iter()
    .any(|start| line.starts_with(start))
}

fn controller(line: &str) -> Option<Item> {
    if let Some(rest) = line.strip_prefix("emcTaskPlanCommand(") {
        let (text, number) = rest.rsplit_once(") called. (line_number=")?;
        return Some(Item::Block(text.to_owned(), number.strip_suffix(')')?.parse().ok()?));
    }
    if line.starts_with("emcTaskPlanExecute(") {
        return Some(Item::Executed);
    }
    if let Some(number) = line.strip_prefix("emcTaskPlanLine() returned ") {
        return number.parse().ok().map(Item::Line);
    }
    if let Some(rest) = line.strip_prefix("Issuing EMC_") {
        return issued(rest).map(Item::Issued);
    }
    if let Some((_, message)) =
        line.split_once(": interp_error: ").filter(|(at, _)| at.starts_with("emc/task/"))
    {
        return Some(Item::Refused(message.to_owned()));
    }
    if let Some((_, status)) = line.split_once("exited abnormally with value ") {
        return status.trim().parse().ok().map(Item::UserProgramFailed);
    }
    if let Some(rest) = line.strip_prefix("LOGOPEN(").or_else(|| line.strip_prefix("LOGAPPEND(")) {
        let (name, _) = rest.rsplit_once(") -> ")?;
        return Some(Item::LogOpen(name.to_owned(), line.starts_with("LOGAPPEND")));
    }
    if let Some(text) = line.strip_prefix("LOG(").and_then(|rest| rest.strip_suffix(')')) {
        return Some(Item::Log(text.to_owned()));
    }
    (line == "LOGCLOSE()").then_some(Item::LogClose)
}

/// The name and the arguments; the first three are type, size and serial number.
fn issued(text: &str) -> Option<Issued> {
    let (name, rest) = text.split_once(" --")?;
    let inner = rest.trim().strip_prefix('(')?.strip_suffix(')')?;
    let arguments = inner.trim_end_matches(',').split(',').skip(3);
    let arguments = arguments.map(|argument| argument.trim_start().to_owned()).collect();
    Some(Issued { name: name.to_owned(), arguments })
}

/// Undoes the escapes of a text: `\032` is a blank (in decimal), `\c` a comma.
fn unescaped(text: &str) -> String {
    let mut bytes = Vec::new();
    let mut rest = text.as_bytes();
    while let Some((first, after)) = rest.split_first() {
        rest = after;
        if *first != b'\\' {
            bytes.push(*first);
            continue;
        }
        let digits = rest.get(..3).and_then(|digits| std::str::from_utf8(digits).ok());
        if let Some(byte) = digits.and_then(|digits| digits.parse::<u8>().ok()) {
            bytes.push(byte);
            rest = &rest[3..];
        } else if let Some((escaped, after)) = rest.split_first() {
            bytes.push(if *escaped == b'c' { b',' } else { *escaped });
            rest = after;
        }
    }
    String::from_utf8_lossy(&bytes).into_owned()
}

fn unreadable(what: &str, line: &str) -> HarnessError {
    HarnessError::Unreadable { what: what.to_owned(), line: line.to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn issued_commands_are_read() {
        let Some(Item::Issued(issued)) = controller(
            "Issuing EMC_MOTION_SET_AOUT -- \t (  +304,+48,    +0,\\001,2.500000,2.500000,\\001,)",
        ) else {
            panic!("not read")
        };
        assert_eq!((issued.name.as_str(), issued.arguments.len()), ("MOTION_SET_AOUT", 4));
        assert_eq!(issued.number(1).map(f64::to_bits), Ok(2.5_f64.to_bits()));
        assert_eq!((issued.whole(0), issued.whole(3)), (Ok(1), Ok(1)));
        assert!(issued.whole(1).is_err());
    }

    #[test]
    fn error_that_is_printed_while_a_block_is_executed_is_no_text_of_the_program() {
        let plan = Plan {
            marker: "@mark@".to_owned(),
            parameters: Vec::new(),
            marks: None,
            parallel_axes: false,
            compensates: false,
        };
        let lines = [
            "emcTaskPlanCommand((print,hello)) called. (line_number=1)",
            "hello",
            "RTAPI: ERROR: Unexpected realtime delay on task 0 with period 1000000",
            "ERROR: index out of range, 8 not in [0..8]",
            "emcTaskPlanExecute(0) returned 0",
            r#"@gaugeblock@ {"message": "ERROR: index out of range, 8 not in [0..8]\n", "error": true}"#,
        ];
        let items = items(&lines.map(str::to_owned), &plan).expect("lines that are understood");
        let texts: Vec<_> = items.iter().filter(|item| matches!(item, Item::Text(_))).collect();
        assert_eq!(texts, [&Item::Text("hello".to_owned())]);
    }

    #[test]
    fn texts_are_read() {
        assert_eq!(unescaped("(print\\cafter\\032#5420\\0321)"), "(print,after #5420 1)");
    }

    #[test]
    fn blocks_and_refusals_are_read() {
        assert_eq!(
            controller("emcTaskPlanCommand(o1 while [#1]) called. (line_number=12)"),
            Some(Item::Block("o1 while [#1]".to_owned(), 12))
        );
        assert_eq!(
            controller("emc/task/emctask.cc 69: interp_error: Bad character '?' used"),
            Some(Item::Refused("Bad character '?' used".to_owned()))
        );
    }
}
