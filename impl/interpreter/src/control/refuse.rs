//! How a refusal gets its place in the program.

use alloc::string::String;

use gaugeblock_vocabulary::{BlockLocation, End, Fault, FaultKind, Program, Span};

use crate::control::Cursor;
use crate::error::Error;
use crate::interpret::{Interpreter, Progress, segment};
use crate::limits::Limit;
use crate::modal::Refusal;
use crate::syntax::bytecode::Block;

impl Interpreter {
    /// A block of words that is refused while it is executed: its settings of parameters are rolled back, unless what
    /// it did stays.
    #[cold]
    pub(crate) fn roll_back(
        &mut self,
        at: Cursor,
        line: u32,
        refusal: Refusal,
    ) -> Result<Progress, Error> {
        if refusal.undoes() {
            self.evaluator.roll_back(&mut self.parameters);
        }
        self.refuse(at, line, refusal)
    }

    /// A block that is refused while it is executed.
    #[cold]
    pub(crate) fn refuse(
        &self,
        at: Cursor,
        line: u32,
        refusal: Refusal,
    ) -> Result<Progress, Error> {
        match refusal {
            Refusal::Fault(kind, message) => Err(self.fault(at.segment, line, kind, message, None)),
            Refusal::Unsupported(what) => Ok(Progress::Ended(End::Unsupported {
                block: self.location(at.segment, line),
                what,
            })),
            Refusal::Unspecified(why) => Ok(Progress::Ended(End::Unspecified {
                block: self.location(at.segment, line),
                why,
            })),
            Refusal::Missed => {
                let message = "the probe did not change".into();
                Err(self.fault(at.segment, line, FaultKind::Probe, message, None))
            }
            Refusal::LimitExceeded(limit) => {
                let block = self.location(at.segment, line);
                Err(Error::LimitExceeded { limit, block })
            }
            Refusal::Aborted => Ok(Progress::Aborted),
        }
    }

    /// A block that could not be compiled.
    #[cold]
    pub(crate) fn refused(&self, at: Cursor, block: &Block) -> Error {
        let refusal = segment(&self.segments, at.segment).and_then(|code| {
            usize::try_from(block.refused).ok().and_then(|place| code.refusals.get(place))
        });
        let Some(refusal) = refusal else { return self.file_ended() };
        let span = Span { start: refusal.start, end: refusal.end };
        self.fault(at.segment, block.line, refusal.kind, refusal.message.into(), Some(span))
    }

    /// The file is over and the program is not (11.4.26).
    #[cold]
    pub(crate) fn file_ended(&self) -> Error {
        Error::Fault(
            Fault {
                kind: Some(FaultKind::MissingEnd),
                block: None,
                span: None,
                message: "the file ends without M2, M30 or a closing %".into(),
            }
            .into(),
        )
    }

    /// A fault at a line.
    #[cold]
    pub(crate) fn fault(
        &self,
        segment: u32,
        line: u32,
        kind: FaultKind,
        message: String,
        span: Option<Span>,
    ) -> Error {
        let block = Some(self.location(segment, line));
        Error::Fault(Fault { kind: Some(kind), block, span, message }.into())
    }

    /// The program needs more than it may use.
    #[cold]
    pub(crate) fn limit_exceeded(&self, segment: u32, limit: Limit) -> Error {
        let line = self.reader.line().saturating_sub(1);
        Error::LimitExceeded { limit, block: self.location(segment, line) }
    }

    /// A line of the file that a segment comes from.
    pub(crate) fn location(&self, at: u32, line: u32) -> BlockLocation {
        let file = segment(&self.segments, at).map_or(0, |code| code.file);
        let name = usize::try_from(file).ok().and_then(|file| self.files.get(file));
        BlockLocation::new(name.map_or(Program::MAIN, |name| name), line)
    }
}
