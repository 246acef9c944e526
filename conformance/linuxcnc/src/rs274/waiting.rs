//! Restores the program order of calls under cutter compensation.
//!
//! A move in the plane waits until the next one is known, and other calls wait after it. A checkpoint's message does
//! not wait, its comment does: what is printed after the message of a checkpoint and before its comment has waited,
//! and belongs before both. A call that does not wait belongs where it is printed. So does a joining move: it is
//! printed when nothing waits any more.

use super::output::{Call, Line};
use crate::instrumentation::checkpoint::Checkpoint;

/// A part of the output in program order.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Ordered<'a> {
    /// A line of the output.
    Line(&'a Line),
    /// A move that was printed after the length unit had changed.
    Rescaled,
    /// A move that waits while a spline is made, which does not wait.
    Overtaken,
    /// The begin of a block whose checkpoint waits at the end of the output: calls of the block may wait, too.
    Unfinished(&'a Checkpoint),
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
            Line::Call(call) if passed < now && call.name == "NURBS_FEED" => {
                blocks[passed].insert(0, Ordered::Overtaken);
            }
            Line::Call(_) | Line::Text(_) => blocks[now].push(Ordered::Line(line)),
        }
    }
    if blocks.iter().skip(passed + 1).flatten().any(changes_unit) {
        blocks[passed].insert(0, Ordered::Rescaled);
    }
    for block in blocks.iter_mut().skip(passed) {
        if let Some(Ordered::Line(Line::Checkpoint(checkpoint))) = block.last() {
            block.insert(0, Ordered::Unfinished(checkpoint));
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
        Ordered::Line(Line::Text(_) | Line::Passed)
        | Ordered::Rescaled
        | Ordered::Overtaken
        | Ordered::Unfinished(_) => false,
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

#[cfg(test)]
mod tests {
    use std::collections::BTreeSet;

    use gaugeblock_vocabulary::{Program, Scenario};

    use super::super::output;
    use super::*;
    use crate::instrumentation::instrument::Plan;
    use crate::instrumentation::source::Source;

    /// The calls in program order, with a bar for each checkpoint.
    fn ordered(printed: &[&str]) -> String {
        let program: Program = Scenario::of("g41.1 d1\n").program;
        let mut plan = Plan::new(&Source::new(&program), &BTreeSet::new());
        plan.parameters.clear();
        let mut stdout = String::new();
        let mut count = 0;
        for line in printed {
            let call = match *line {
                "|" => {
                    let zeros = " 0".repeat(12);
                    let parts = [&zeros[..22], &zeros[..], &zeros[..16]];
                    for (part, values) in parts.iter().enumerate() {
                        stdout.push_str(&format!("{} 0 0 {part}{values}\n", plan.marker));
                    }
                    continue;
                }
                "+" => format!("COMMENT(\"{}\")", plan.waiting_comment()),
                call => call.to_owned(),
            };
            count += 1;
            stdout.push_str(&format!("{count:5} N..... {call}\n"));
        }
        let lines = output::lines(&stdout, &plan, false).unwrap();
        let shown = in_program_order(&lines).into_iter().map(|line| match line {
            Ordered::Line(Line::Call(call)) => format!("{}({})", call.name, call.arguments),
            Ordered::Line(Line::Checkpoint(_)) => "|".to_owned(),
            Ordered::Line(Line::Text(_) | Line::Passed) => String::new(),
            Ordered::Rescaled => "rescaled".to_owned(),
            Ordered::Overtaken => "overtaken".to_owned(),
            Ordered::Unfinished(_) => "unfinished".to_owned(),
        });
        shown.collect::<Vec<_>>().join(" ")
    }

    #[test]
    fn late_calls_belong_to_their_blocks() {
        // G1 X1; T2 F3; Y-1 with a joining move; M2.
        let printed = [
            "+",
            "|",
            "|",
            "SELECT_TOOL(2)",
            "|",
            "STRAIGHT_FEED(1)",
            "+",
            "SET_FEED_RATE(3)",
            "+",
            "ARC_FEED(2)",
            "|",
            "STRAIGHT_FEED(4)",
            "+",
            "DWELL(1)",
        ];
        assert_eq!(
            ordered(&printed),
            "| STRAIGHT_FEED(1) | SET_FEED_RATE(3) SELECT_TOOL(2) | ARC_FEED(2) STRAIGHT_FEED(4) | DWELL(1)"
        );
    }

    #[test]
    fn block_that_waits_at_the_end_of_the_output_is_marked() {
        // G1 X1; F3; an error.
        assert_eq!(ordered(&["+", "|", "|", "|"]), "| unfinished | unfinished |");
    }

    #[test]
    fn move_that_waits_at_the_end_in_another_unit_is_recognised() {
        let printed = ["+", "|", "|", "USE_LENGTH_UNITS(CANON_UNITS_INCHES)", "|"];
        assert_eq!(
            ordered(&printed),
            "| unfinished rescaled | unfinished USE_LENGTH_UNITS(CANON_UNITS_INCHES) |"
        );
    }

    #[test]
    fn move_that_a_spline_overtakes_is_recognised() {
        let printed = ["+", "|", "|", "NURBS_FEED(3, ...)", "|", "STRAIGHT_FEED(1)", "+", "+"];
        assert_eq!(ordered(&printed), "| overtaken STRAIGHT_FEED(1) | |");
    }

    #[test]
    fn late_move_in_another_unit_is_recognised() {
        let printed = [
            "+",
            "|",
            "|",
            "USE_LENGTH_UNITS(CANON_UNITS_MM)",
            "|",
            "STRAIGHT_FEED(25.4)",
            "+",
            "+",
        ];
        assert_eq!(ordered(&printed), "| rescaled | USE_LENGTH_UNITS(CANON_UNITS_MM) |");
    }
}
