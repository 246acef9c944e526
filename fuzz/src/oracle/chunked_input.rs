//! Production has the same output whether a program arrives whole or in chunks, and however many blocks run per call.

use std::fmt::Write as _;

use gaugeblock_interpreter::{
    BlockEnd, Interpreter, Limits, Memory, Progress, Reply, Sink, Source, SourceError,
};
use gaugeblock_vocabulary::{Effect, Scenario, Settings};

use crate::generate::Entropy;

/// Runs a program whole, in chunks, and several blocks per call, and compares the calls that the sink receives.
///
/// # Errors
/// The first difference, and the program.
pub fn chunked_input(scenario: &Scenario, entropy: &mut Entropy<'_>) -> Result<(), String> {
    let program = &scenario.program;
    let memory = || {
        let main = Memory::new(&program.main);
        program.files.iter().fold(main, |source, (name, text)| source.with_file(name, text))
    };
    let whole = told(scenario, &mut memory(), 1);
    let most = usize::try_from(entropy.range(1, 40)).unwrap_or(1);
    let sizes: Vec<usize> =
        (0..7).map(|_| 1 + usize::try_from(entropy.below(40)).unwrap_or_default() % most).collect();
    let mut pieces = Pieces { inner: memory(), sizes, turn: 0 };
    for (how, other) in [
        ("in pieces", told(scenario, &mut pieces, 1)),
        ("many blocks at a time", told(scenario, &mut memory(), 7)),
    ] {
        if other != whole {
            let same = whole.lines().zip(other.lines()).take_while(|(a, b)| a == b).count();
            let at = |text: &str| text.lines().nth(same).unwrap_or("nothing more").to_owned();
            return Err(format!(
                "{how}:\n{}\n{}\nagainst\n{}",
                program.main,
                at(&other),
                at(&whole)
            ));
        }
    }
    Ok(())
}

/// All calls that a sink receives in a run, in lines. The end of the run is recorded only if it comes within the
/// budget, so that it does not depend on the number of blocks per call.
fn told(scenario: &Scenario, source: &mut impl Source, at_a_time: u64) -> String {
    let (machine, options) = (scenario.machine.clone(), scenario.options.clone());
    let mut interpreter = match Interpreter::new(machine, options, Limits::default()) {
        Ok(interpreter) => interpreter,
        Err(error) => return error.to_string(),
    };
    interpreter.set_block_delete(scenario.program.block_delete);
    let mut log = Log { text: String::new(), blocks: 0, most: scenario.budget.steps };
    let end = loop {
        match interpreter.run(source, &mut log, at_a_time) {
            Ok(Progress::More) if log.blocks < log.most => {}
            Ok(Progress::More | Progress::Stopped | Progress::Aborted) => return log.text,
            Ok(Progress::Ended(end)) => break format!("{end:?}"),
            Err(error) => break format!("{error:?}"),
        }
    };
    if log.blocks < log.most { log.text + &end } else { log.text }
}

/// Records the calls of the interpreter, up to a number of blocks.
struct Log {
    text: String,
    blocks: u32,
    most: u32,
}

impl Sink for Log {
    fn set(&mut self, line: u32, changed: &Settings) {
        if self.blocks < self.most {
            let _infallible = writeln!(self.text, "{line} {changed:?}");
        }
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        if self.blocks < self.most {
            let _infallible = writeln!(self.text, "{line} {effect:?}");
        }
        if matches!(effect, Effect::WaitInput { .. }) { Reply::Input(1.0) } else { Reply::Done }
    }

    fn end_block(&mut self, done: &mut BlockEnd<'_>) {
        self.blocks = self.blocks.saturating_add(1);
        if self.blocks <= self.most {
            let state = done.state();
            let _infallible = writeln!(self.text, "{}:{} {state:?}", done.file(), done.line());
        }
    }
}

/// A source that has a few bytes ready at a time.
struct Pieces<'a> {
    inner: Memory<'a>,
    sizes: Vec<usize>,
    turn: usize,
}

impl Source for Pieces<'_> {
    fn text(&mut self) -> Result<&[u8], SourceError> {
        let size = self.sizes.get(self.turn % self.sizes.len().max(1)).copied().unwrap_or(1);
        let text = self.inner.text()?;
        Ok(text.get(..size).unwrap_or(text))
    }

    fn consume(&mut self, bytes: usize) {
        self.turn += 1;
        self.inner.consume(bytes);
    }

    fn rewind(&mut self, offset: u64) -> Result<bool, SourceError> {
        self.turn += 1;
        self.inner.rewind(offset)
    }

    fn open(&mut self, name: &str) -> Result<bool, SourceError> {
        self.inner.open(name)
    }

    fn close(&mut self) {
        self.inner.close();
    }
}
