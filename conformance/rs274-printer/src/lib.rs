//! `gaugeblock rs274`: the production interpreter behind the command line and the printed text of LinuxCNC's `rs274`.
//!
//! ```text
//! Arguments ─► ini, machine, parameters ─► Interpreter ─► printer ─► block (io, settings, motion) ─► calls ─► output
//!              source (program, subroutine files)            └ text (number and comment of a line)
//! ```
//!
//! The interpreter tells its sink the words of a block, what changed and what was done; the printer puts that into
//! the order in which `rs274` prints a block, and prints what was programmed again though it did not change. What is
//! printed was learned by running the program.
//!
//! **Not imitated:** the menu that is printed without `-g`, and its prompts; plug-in interpreters, Python and remapped
//! codes; programs that are named by a word; O-words from standard input; G87; parameters `#<_ini[…]>` that a program
//! sets. A block of more than a million effects ends the run: its calls are printed when it ends. A file without an end
//! ends the run with `-n 0` too, where `rs274` prints the same for ever. Two codes of one block that change the same
//! offset print its last value twice. Where the last bits of a rotation, or of polar words of an incremental move,
//! decide the sign of a zero, it can differ. Quirks (`conformance/suite/quirks`) that are visible in a line of their
//! own are printed here: rounded F and S of saved state, switches that are not restored, subs that are defined after
//! their call, the way of cycles to the R plane, the passes of G76 (`threads`). The interpreter emulates those that
//! change a position (`Interpreter::emulate_rs274`); its module `quirks` lists them. `tests/corpus` counts programs of
//! others that are printed alike.
//!
//! **Invariants.** Nothing is read but the files that the call names and subroutine files in their folders.
//! User-defined codes run nothing.

mod arguments;
mod block;
mod calls;
mod codes;
mod ini;
mod io_calls;
mod late;
mod machine;
mod modes;
mod motion;
mod output;
mod parameters;
mod plane;
mod printer;
mod programmed;
mod refusals;
mod scale;
mod setting_calls;
mod source;
mod text;
mod threads;
mod tool_table;
mod words;

use std::collections::BTreeMap;
use std::io::{BufRead, Write};
use std::os::unix::fs::MetadataExt as _;
use std::path::Path;

pub use arguments::Arguments;
use block::Fixed;
use gaugeblock_filesystem::open_output;
use gaugeblock_interpreter::{Error, Interpreter, Limits, Progress};
use gaugeblock_vocabulary::{BlockLocation, End, Fault, FaultKind, Program};
use ini::Ini;
pub use machine::read_machine;
use output::Output;
pub use parameters::read_parameter_file;
use printer::{BLOCK_EFFECTS_MAX, Printer};
use refusals::RefusedBlock;
use source::{Files, Texts};
pub use tool_table::read_tool_table;

/// How many blocks are executed between checks of their results.
const BLOCKS: u64 = 1 << 20;

/// Why it does not begin, or does not end as it should; for people.
type ErrorMessage = String;

/// Why the command fails.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Failure {
    /// A file of the call that cannot be read or written, or an option that is refused.
    Refused(String),
    /// A block with more effects than are kept.
    BlockTooLong(String),
}

impl From<ErrorMessage> for Failure {
    fn from(message: ErrorMessage) -> Self {
        Self::Refused(message)
    }
}

/// A run of the command.
#[derive(Debug)]
struct Run {
    interpreter: Interpreter,
    printer: Printer,
    texts: Texts,
    /// Whether it continues after a refused block.
    goes_on: bool,
    /// The block whose effects were too many, if there was one: the run ends there.
    too_long: Option<BlockLocation>,
}

/// Runs the command; the exit status. `editions` is the text of the suite's `editions.toml`.
///
/// # Errors
/// As [`Failure`] lists them; for people.
pub fn rs274(arguments: &Arguments, editions: &str) -> Result<u8, Failure> {
    if arguments.plug.is_some() {
        return Err("-p: no other interpreter can be loaded".to_owned().into());
    }
    complain("executing");
    let ini = match &arguments.ini {
        Some(path) => Ini::read(&read_text(path)?),
        None => Ini::default(),
    };
    // As with `rs274`, a missing tool table is an empty one, and a missing parameter file is written anew.
    let table = arguments.tools.as_ref().and_then(|path| read_text(path).ok()).unwrap_or_default();
    let stored = arguments.parameters.as_ref().and_then(|path| read_text(path).ok());
    let stored = read_parameter_file(stored.as_deref().unwrap_or_default())
        .map_err(|error| format!("parameter file: {error}"))?;
    let program = arguments
        .program
        .as_ref()
        .map(|path| std::fs::read(path).map_err(|error| format!("{}: {error}", path.display())));
    let program = program.transpose()?;

    let mut machine = machine::machine(&ini, tool_table::tools(&table));
    let forgets = machine::forgets_g92(&ini);
    let kept = stored.iter().filter(|(number, _)| !(forgets && machine::is_g92(**number)));
    machine.parameters = kept.map(|(number, value)| (*number, *value)).collect();
    let held = machine.parameters.clone();
    let fixed = Fixed {
        tools: machine.tools.iter().filter_map(|tool| i32::try_from(tool.number).ok()).collect(),
        spindles: machine.spindles,
        unclosed: program.as_deref().is_some_and(source::is_unclosed),
        by_hand: program.is_none(),
    };
    let mut interpreter = Interpreter::new(machine, machine::options(editions), Limits::default())
        .map_err(|error| error.to_string())?;
    interpreter.set_block_delete(arguments.block_delete);
    interpreter.set_preview(true);
    interpreter.set_report_comments(true);
    interpreter.emulate_rs274(held.0);
    let texts = Texts::default();
    let read = [&arguments.program, &arguments.ini, &arguments.tools, &arguments.parameters];
    let written = [(&arguments.output, &read[..]), (&arguments.parameters, &read[..3])];
    for (name, others) in written {
        let mut others = others.iter().copied().flatten();
        if let Some(name) = name
            && others.any(|other| is_same(other, name))
        {
            let name = name.display();
            return Err(format!("{name}: a file that is read would be written over").into());
        }
    }
    let output = Output::new(sink(arguments.output.as_deref())?);
    let printer = Printer::new(output, texts.clone(), &interpreter.settings(), fixed);
    let goes_on = arguments.next == 0;
    let mut run = Run { interpreter, printer, texts, goes_on, too_long: None };
    let folders = machine::folders(&ini, arguments.program.as_deref());
    let status = match program {
        Some(text) => run.program(text, folders, arguments.ini.is_some()),
        None => run.run_mdi(&folders),
    };
    run.printer.out.flush();
    if let Some(error) = run.printer.out.failure() {
        let name = arguments.output.as_ref().map(|path| path.display().to_string());
        return Err(format!("{}: {error}", name.as_deref().unwrap_or("standard output")).into());
    }
    if let Some(block) = &run.too_long {
        return Err(Failure::BlockTooLong(too_long(block, arguments.program.as_deref())));
    }
    if let Some(path) = &arguments.parameters {
        let now: BTreeMap<_, _> = run.interpreter.parameters().into_iter().collect();
        parameters::write(path, &stored, &now)
            .map_err(|error| format!("{}: {error}", path.display()))?;
    }
    Ok(status)
}

impl Run {
    /// Runs a program file.
    fn program(&mut self, text: Vec<u8>, folders: Vec<std::path::PathBuf>, has_ini: bool) -> u8 {
        if let Some(line) = source::overlong_beginning(&text) {
            self.printer.out.flush();
            complain("Command too long");
            complain(&String::from_utf8_lossy(line));
            return 1;
        }
        if text.trim_ascii().is_empty() {
            // It is not even opened. What was read last is shown, its end of line too.
            self.printer.out.flush();
            complain("File ended with no percent sign");
            let last = text.split_inclusive(|byte| *byte == b'\n').next_back().unwrap_or_default();
            complain(&String::from_utf8_lossy(last));
            return 1;
        }
        self.printer.out.call("ON_RESET");
        let mut source = Files::new(text, folders, self.texts.clone());
        let (status, ended) = self.blocks(&mut source);
        self.printer.out.label(None);
        // The end of a program has reset once already; the INI file takes one more away.
        let resets = 2 - u8::from(ended) - u8::from(has_ini);
        for _ in 0..resets {
            self.printer.out.call("ON_RESET");
        }
        status
    }

    /// Runs block after block; the exit status, and whether the program ended by a code.
    fn blocks(&mut self, source: &mut Files) -> (u8, bool) {
        loop {
            let fault = match self.interpreter.run(source, &mut self.printer, BLOCKS) {
                Ok(Progress::Stopped) if self.printer.is_full() => {
                    self.too_long = Some(self.interpreter.block());
                    return (2, false);
                }
                Ok(Progress::More | Progress::Stopped | Progress::Aborted) => continue,
                Ok(Progress::Ended(End::ProgramEnd)) => return (0, true),
                Ok(Progress::Ended(End::PercentEnd)) => {
                    self.printer.out.label(None);
                    self.printer.out.call("FINISH");
                    return (0, false);
                }
                Ok(Progress::Ended(End::Endless)) => {
                    self.printer.ended(&self.interpreter.settings());
                    return (0, true);
                }
                Ok(Progress::Ended(end)) => unsupported(&end),
                Err(Error::Fault(fault)) => *fault,
                Err(error) => {
                    Fault { kind: None, block: None, span: None, message: error.to_string() }
                }
            };
            let last = fault.kind == Some(FaultKind::MissingEnd) || fault.block.is_none();
            self.refused(&fault);
            if last || !self.goes_on {
                return (1, false);
            }
            self.interpreter.skip_faulted_block();
        }
    }

    /// Prints what a refused block did, and says why it is refused.
    fn refused(&mut self, fault: &Fault) {
        let place = fault.block.as_ref().map(|block| (block.file.as_ref(), block.line));
        let reached = refusals::phase_reached(fault, self.printer.words(), self.printer.motion());
        let words = self.printer.words().clone();
        let (position, plane) = self.printer.place();
        let begun = refusals::cycle_progress(fault, &words);
        self.printer.refused(place, (reached, begun), &self.interpreter.settings());
        let line = match place {
            Some((file, line)) if fault.kind != Some(FaultKind::MissingEnd) => {
                self.texts.line(file, line, <[u8]>::to_vec)
            }
            _ => self.texts.last_line(),
        };
        let line = String::from_utf8_lossy(&line);
        if refusals::file_not_found(fault) && self.texts.has_second_percent() {
            // The search has come by the second percent line.
            self.printer.out.call("FINISH");
        }
        self.printer.out.flush();
        let percent = self.texts.begins_with_percent();
        let refused = RefusedBlock { fault, words: &words, line: &line, position, plane, percent };
        complain(&refused.sentence());
        complain(&refused.message());
    }

    /// Runs blocks from standard input, each on its own, up to `quit`.
    fn run_mdi(&mut self, folders: &[std::path::PathBuf]) -> u8 {
        for line in std::io::stdin().lock().split(b'\n') {
            let Ok(line) = line else { break };
            if line.trim_ascii() == b"quit" || self.too_long.is_some() {
                break;
            }
            if line.trim_ascii() == b"%" {
                self.printer.out.flush();
                complain("Bad character '%' used");
                complain("%");
                continue;
            }
            self.interpreter.begin();
            let mut source = Files::new(line, folders.to_vec(), self.texts.clone());
            loop {
                match self.interpreter.run(&mut source, &mut self.printer, BLOCKS) {
                    Ok(Progress::Stopped) if self.printer.is_full() => {
                        self.too_long = Some(self.interpreter.block());
                        break;
                    }
                    Ok(Progress::More | Progress::Stopped | Progress::Aborted) => {}
                    Ok(Progress::Ended(_)) => break,
                    Err(Error::Fault(fault)) => {
                        if fault.kind != Some(FaultKind::MissingEnd) {
                            self.refused(&fault);
                        }
                        break;
                    }
                    Err(error) => {
                        complain(&error.to_string());
                        break;
                    }
                }
            }
            self.printer.out.label(None);
        }
        self.printer.out.call("ON_RESET");
        0
    }
}

/// That a block has too many effects. The main program has the name of its file.
fn too_long(block: &BlockLocation, program: Option<&Path>) -> String {
    let file = match program {
        Some(program) if &*block.file == Program::MAIN => program.display().to_string(),
        None if &*block.file == Program::MAIN => "standard input".to_owned(),
        Some(_) | None => block.file.to_string(),
    };
    format!("{file}:{}: more than {BLOCK_EFFECTS_MAX} effects in one block", block.line)
}

/// What the interpreter does not do yet, as a fault.
fn unsupported(end: &End) -> Fault {
    let (block, message) = match end {
        End::Unsupported { block, what } => (Some(block.clone()), format!("not supported: {what}")),
        End::Unspecified { block, why } => (Some(block.clone()), format!("not specified: {why}")),
        End::ProgramEnd
        | End::PercentEnd
        | End::StreamEnd
        | End::Endless
        | End::Fault(_)
        | End::Paused
        | End::Aborted
        | End::BudgetExhausted { .. } => (None, "the program does not go on".to_owned()),
    };
    Fault { kind: None, block, span: None, message }
}

fn sink(path: Option<&Path>) -> Result<Box<dyn Write>, ErrorMessage> {
    Ok(match path {
        Some(path) => {
            Box::new(open_output(path).map_err(|error| format!("{}: {error}", path.display()))?)
        }
        None => Box::new(std::io::stdout()),
    })
}

/// Whether two names lead to one file, by whichever links.
fn is_same(one: &Path, other: &Path) -> bool {
    let file = |path: &Path| path.metadata().ok().map(|found| (found.dev(), found.ino()));
    file(one).is_some() && file(one) == file(other)
}

fn read_text(path: &Path) -> Result<String, ErrorMessage> {
    let bytes = std::fs::read(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(String::from_utf8_lossy(&bytes).into_owned())
}

/// Writes a line to standard error; a closed reader is not an error.
fn complain(text: &str) {
    let _closed_pipe = writeln!(std::io::stderr(), "{text}");
}
