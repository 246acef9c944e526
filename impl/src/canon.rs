//! Where settings and effects go: the canonical commands, as a caller receives them.

use gaugeblock_trace::{Effect, Position, Settings};

/// What receives the commands of a program, in order.
///
/// A sink that only queues answers [`Reply::Done`] to most effects. Some effects wait for the outside (a queue
/// buster): a probe, an input, a tool change. To those the reply says what came of it.
pub trait Sink {
    /// Takes over settings that changed: only the fields that stand in `changed`.
    ///
    /// `line` is the line of the block, from 1, in its file.
    fn set(&mut self, line: u32, changed: &Settings);

    /// Performs an effect, or queues it, under the settings in force.
    fn perform(&mut self, line: u32, effect: &Effect) -> Reply;
}

/// What a sink answers to an effect.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reply {
    /// It is done or queued.
    Done,
    /// Where the probe changed, in program coordinates and the active length unit; `None` where it did not.
    Contact(Option<Position>),
    /// What M66 read: a level of 0 or 1, a voltage, or -1 after a time-out.
    Input(f64),
    /// Which tool is in the spindle now; 0 for none.
    Tool(i32),
    /// Stop here; the interpreter stays where it is and can be stepped on or aborted.
    Stop,
}
