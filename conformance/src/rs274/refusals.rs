//! Refused blocks: how far they came, and what is said.
//!
//! The sentences are our own, but for those on which programs depend that read the output of `rs274`: short facts of its interface, as observed.

use gaugeblock_trace::{Fault, FaultKind};

use super::block::{Phase, Words};
use super::settled::{CYCLES, MOTIONS};

/// Up to which phase a refused block is executed.
pub(super) fn reached(fault: &Fault, words: &Words) -> Phase {
    let motion = words.g_of(&MOTIONS);
    let arc_or_cycle = motion.is_some_and(|code| code > 10 && code != 800);
    match fault.kind {
        Some(FaultKind::BadArc | FaultKind::ZeroFeed | FaultKind::Gouging | FaultKind::Probe | FaultKind::ZeroSpeed) => {
            Phase::Motion
        }
        Some(FaultKind::MissingWord | FaultKind::WordOutOfRange | FaultKind::AxisWords) if arc_or_cycle => Phase::Motion,
        Some(FaultKind::ToolNotFound) => Phase::Tool,
        Some(FaultKind::NothingSaved) => Phase::Saved,
        _ => Phase::Comment,
    }
}

/// What is said of a refused block, whose text is given.
pub(super) fn sentence(fault: &Fault, words: &Words, line: &str) -> String {
    observed(fault, words, line).unwrap_or_else(|| fault.message.clone())
}

fn observed(fault: &Fault, words: &Words, line: &str) -> Option<String> {
    let text = match fault.kind? {
        FaultKind::AbortedByProgram => return Some(fault.message.clone()),
        FaultKind::ZeroFeed => match words.g_of(&MOTIONS) {
            Some(20 | 30) => "Cannot make arc with zero feed rate",
            Some(code) if CYCLES.contains(&code) => "Cannot feed with zero feed rate",
            _ => "Cannot do g1 with zero feed rate",
        },
        FaultKind::NothingSaved => {
            "Cannot restore context from invalid stack frame - missing M70/M73?"
        }
        FaultKind::DivideByZero => "Attempt to divide by zero",
        FaultKind::MissingEnd => "File ended with no percent sign or program end",
        FaultKind::NoSuchParameter => return absent(line),
        _ => return None,
    };
    Some(text.to_owned())
}

/// A named parameter that does not exist: the first one of the line behind an equals sign.
fn absent(line: &str) -> Option<String> {
    let value = line.split_once('=').map_or(line, |(_, value)| value);
    let name = value.split_once("#<")?.1.split('>').next()?;
    Some(format!("Named parameter #<{name}> not defined"))
}
