//! The interpreter: program text in, settings and effects out, a block at a time.

use gaugeblock_trace::{End, Machine, Options, State};

use crate::canon::Sink;
use crate::error::Error;
use crate::limits::Limits;
use crate::source::Source;

/// An interpreter of LinuxCNC's dialect of RS-274, with the options of a chosen edition.
///
/// One pass over the source: what runs once is read, executed and forgotten, what can run again is packed once and runs
/// packed. In steady state a block allocates nothing.
///
/// ```
/// use gaugeblock_impl::{Error, Interpreter, Limits};
/// use gaugeblock_trace::{Machine, Options};
///
/// let interpreter = Interpreter::new(Machine::default(), Options::default(), Limits::default());
/// assert!(matches!(interpreter, Err(Error::NotYet(_))));
/// ```
#[derive(Debug)]
pub struct Interpreter {
    machine: Machine,
    options: Options,
    limits: Limits,
    state: State,
}

/// What a step came to.
#[derive(Clone, Debug, PartialEq)]
pub enum Progress {
    /// A block was executed; there is more.
    More,
    /// The sink asked to stop, within this block; the next step goes on from there.
    Stopped,
    /// The program is over. A refused block is an [`Error::Fault`] and not an end.
    Ended(End),
}

impl Interpreter {
    /// An interpreter that stands before a program's first block, in the machine's initial state.
    ///
    /// # Errors
    /// [`Error::NotYet`], always, in this version.
    pub fn new(machine: Machine, options: Options, limits: Limits) -> Result<Self, Error> {
        let (_machine, _options, _limits) = (machine, options, limits);
        Err(Error::NotYet("the production interpreter"))
    }

    /// Reads and executes one block. An endless loop is a step that comes back `More`, for ever; a caller can stop it.
    ///
    /// # Errors
    /// A refused block, a bound of [`Limits`], or a source that cannot be read. After an error the state is that after the
    /// block before, and [`Self::abort`] makes it ready for another program.
    pub fn step<S: Source, K: Sink>(
        &mut self,
        source: &mut S,
        sink: &mut K,
    ) -> Result<Progress, Error> {
        let (_source, _sink) = (source, sink);
        Err(Error::NotYet("the production interpreter"))
    }

    /// Ends the program as an operator's abort does: saved states and call levels are gone, settings are reset.
    ///
    /// # Errors
    /// [`Error::NotYet`], always, in this version.
    pub fn abort<K: Sink>(&mut self, sink: &mut K) -> Result<(), Error> {
        let _sink = sink;
        Err(Error::NotYet("the production interpreter"))
    }

    /// The state after the last executed block.
    pub fn state(&self) -> &State {
        &self.state
    }

    /// The machine as the program has changed it: stored parameters, tool table.
    pub fn machine(&self) -> &Machine {
        &self.machine
    }

    /// The readings of the documents that apply.
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// The bounds that apply.
    pub fn limits(&self) -> Limits {
        self.limits
    }
}
