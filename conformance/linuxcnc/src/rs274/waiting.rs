//! Restores the program order of calls under cutter compensation.
//!
//! A move in the plane waits until the next one is known, and other calls wait after it. A checkpoint's message does not
//! wait, its comment does: what is printed after the message of a checkpoint and before its comment has waited, and
//! belongs before both. A call that does not wait belongs where it is printed, and so does a joining move: it is printed
//! when nothing waits any more.

use super::output::{Call, Line};

/// A part of the output in program order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ordered<'a> {
    /// A line of the output.
    Line(&'a Line),
    /// A move that was printed after the length unit had changed.
    Rescaled,
}

/// The lines after one checkpoint, up to the next and with it.
type Block<'a> = Vec<Ordered<'a>>;

/// Lines in program order. The checkpoints have comments.
pub(super) fn in_program_order(lines: &[Line]) -> Vec<Ordered<'_>> {
    let mut blocks = vec![Block::new()];
    let mut passed = 0;
    for line in lines {
        let now = blocks.len() - 1;
        match line {
            Line::Passed => passed += 1,
            Line::Checkpoint(_) => {
                blocks[now].push(Ordered::Line(line));
                blocks.push(Block::new());
            }
            Line::Call(call) if passed < now && waits(call) => {
                let changed = || blocks[passed + 1..].iter().flatten().any(changes_unit);
                let is_rescaled = is_motion(&call.name) && changed();
                let late = if is_rescaled { Ordered::Rescaled } else { Ordered::Line(line) };
                let at = place(&blocks[passed], call);
                blocks[passed].insert(at, late);
            }
            Line::Call(_) | Line::Text(_) => blocks[now].push(Ordered::Line(line)),
        }
    }
    blocks.concat()
}

/// Where a late call belongs among the calls of its block that were printed at once: before the checkpoint, and
/// before T, G17 to G21, G7 and G8 where the block executes the call's word before these.
fn place(block: &[Ordered<'_>], late: &Call) -> usize {
    let order = order(late);
    let is_later = |line: &Ordered<'_>| match line {
        Ordered::Line(Line::Checkpoint(_)) => true,
        Ordered::Line(Line::Call(call)) => !waits(call) && self::order(call) > order,
        Ordered::Line(Line::Text(_) | Line::Passed) | Ordered::Rescaled => false,
    };
    block.iter().rposition(|line| !is_later(line)).map_or(0, |last| last + 1)
}

/// The order in which a block executes its words, as far as it matters here.
fn order(call: &Call) -> u8 {
    match call.name.as_str() {
        "COMMENT" if !call.text().starts_with("interpreter: ") => 0,
        "MESSAGE" | "LOG" | "LOGOPEN" | "LOGAPPEND" | "LOGCLOSE" => 0,
        "SET_FEED_MODE" | "SET_FEED_RATE" | "SET_SPINDLE_SPEED" | "SET_SPINDLE_MODE" => 1,
        "COMMENT" if call.text().contains("feed mode") => 1,
        "SELECT_TOOL" => 2,
        "SELECT_PLANE" | "USE_LENGTH_UNITS" => 4,
        "COMMENT" if is_lathe(call) => 5,
        name if is_motion(name) || name == "COMMENT" => 6,
        _ => 3,
    }
}

/// Whether a call waits while a move does.
fn waits(call: &Call) -> bool {
    match call.name.as_str() {
        "COMMENT" => !is_lathe(call),
        "SET_FEED_MODE" | "SET_FEED_RATE" | "SET_SPINDLE_SPEED" | "SET_SPINDLE_MODE" => true,
        "START_SPINDLE_CLOCKWISE" | "START_SPINDLE_COUNTERCLOCKWISE" | "STOP_SPINDLE_TURNING" => {
            true
        }
        "MIST_ON" | "MIST_OFF" | "FLOOD_ON" | "FLOOD_OFF" | "DWELL" | "ORIENT_SPINDLE" => true,
        name => is_motion(name) || name.ends_with("WAIT_ORIENT_COMPLETE"),
    }
}

fn is_motion(name: &str) -> bool {
    ["STRAIGHT_TRAVERSE", "STRAIGHT_FEED", "ARC_FEED"].contains(&name)
}

/// Whether a comment reports G7 or G8, which do not wait.
fn is_lathe(call: &Call) -> bool {
    call.text().starts_with("interpreter: Lathe diameter mode")
}

fn changes_unit(line: &Ordered<'_>) -> bool {
    matches!(line, Ordered::Line(Line::Call(call)) if call.name == "USE_LENGTH_UNITS")
}
