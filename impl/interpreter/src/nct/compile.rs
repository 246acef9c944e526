//! Programs from a text: lines to blocks, with the numbers by which programs and blocks are found, and the loops.

use alloc::vec::Vec;

use gaugeblock_vocabulary::FaultKind;

use super::choices::Choices;
use super::expressions::Reader;
use super::program::{Block, Code, Kind, Program, Stop, refuse};
use super::statements::Ring;
use super::text::{self, Cursor};
use crate::index_range::IndexRange;

/// A DO that is open: its block, its number, and the loop around it.
#[derive(Clone, Copy, Debug)]
struct Opened {
    block: usize,
    number: u32,
    is_again: bool,
}

/// A text that is being compiled.
struct Compiler {
    code: Code,
    choices: Choices,
    block_delete: bool,
    /// The loops that are open, the innermost last.
    opened: Vec<Opened>,
    /// How many of them have each number.
    open: [u32; 4],
}

/// The beginning of a line.
#[derive(Clone, Copy, Debug, Default)]
struct Numbers {
    program: Option<u32>,
    sequence: Option<u32>,
}

/// Compiles a text. Whatever is wrong with a block is found when it is reached.
pub(super) fn compile(text: &str, block_delete: bool, choices: Choices) -> Code {
    let main = Program { line: 1, blocks: IndexRange::default() };
    let mut compiler =
        Compiler { code: Code::default(), choices, block_delete, opened: Vec::new(), open: [0; 4] };
    let mut bytes = Vec::new();
    for (line, content) in (1..).zip(text::lines(text)) {
        compiler.line(line, content, &mut bytes);
    }
    compiler.close();
    let mut code = compiler.code;
    if code.programs.is_empty() {
        code.programs.push(main);
    }
    code.numbers.sort_unstable();
    code.labels.sort_unstable();
    code
}

impl Compiler {
    fn line(&mut self, line: u32, content: &str, bytes: &mut Vec<u8>) {
        let cleaned = text::clean(content, bytes);
        let skips = self.block_delete && bytes.first() == Some(&b'/');
        if let Err(stop) = cleaned {
            let kind = if skips { Kind::Skipped } else { Kind::Stop(stop) };
            self.push(line, kind, None);
            return;
        }
        if bytes.is_empty() {
            return;
        }
        let mut cursor = Cursor::new(bytes);
        let mut numbers = Numbers::default();
        let begun = begin(&mut cursor, &mut numbers);
        if let Some(number) = numbers.program {
            self.program(line, number);
        }
        let says_more = numbers.sequence.is_some() || !cursor.is_at_end();
        if begun.is_ok() && numbers.program.is_some() && !says_more {
            return;
        }
        if skips {
            self.push(line, Kind::Skipped, numbers.sequence);
            return;
        }
        let choices = self.choices;
        let (operations, words) = (self.code.operations.len(), self.code.words.len());
        let read =
            begun.and_then(|()| Reader { cursor, code: &mut self.code, choices, depth: 0 }.block());
        match read {
            Ok((kind, ring)) => {
                let block = self.push(line, kind, numbers.sequence);
                match ring {
                    Some(Ring::Opens(number)) => self.opens(block, number),
                    Some(Ring::Closes(number)) => self.closes(block, number),
                    None => {}
                }
            }
            Err(stop) => {
                self.code.operations.truncate(operations);
                self.code.words.truncate(words);
                self.push(line, Kind::Stop(stop), numbers.sequence);
            }
        }
    }

    /// A program begins.
    fn program(&mut self, line: u32, number: u32) {
        self.close();
        self.code.numbers.push((number, self.code.programs.len()));
        let begins = self.code.blocks.len();
        self.code.programs.push(Program { line, blocks: IndexRange { from: begins, to: begins } });
    }

    /// A block, and its place.
    fn push(&mut self, line: u32, kind: Kind, sequence: Option<u32>) -> usize {
        let place = self.code.blocks.len();
        if self.code.programs.is_empty() {
            self.code
                .programs
                .push(Program { line, blocks: IndexRange { from: place, to: place } });
        }
        if let Some(number) = sequence {
            let program = self.code.programs.len().saturating_sub(1);
            self.code.labels.push((program, number, place));
        }
        self.code.blocks.push(Block { line, within: None, kind });
        if let Some(program) = self.code.programs.last_mut() {
            program.blocks.to = place.saturating_add(1);
        }
        place
    }

    fn opens(&mut self, block: usize, number: u32) {
        let open = self.open_of(number);
        let is_again = *open > 0;
        *open = open.saturating_add(1);
        self.opened.push(Opened { block, number, is_again });
    }

    fn closes(&mut self, end: usize, number: u32) {
        let Some(opened) = self.opened.pop_if(|opened| opened.number == number) else {
            let why = "END closes another loop, or none";
            self.replace(end, Kind::Stop(Stop::Refused(FaultKind::UnknownLabel, why)));
            return;
        };
        let open = self.open_of(number);
        *open = open.saturating_sub(1);
        let behind = end.saturating_add(1);
        self.replace(end, Kind::End(opened.block));
        self.settle(opened, Some(behind));
        // Blocks of loops within this one know theirs already.
        let place = self.code.loops.len();
        let from = opened.block.saturating_add(1);
        self.code.loops.push(IndexRange { from, to: behind });
        let mut block = end;
        while block >= from {
            let Some(one) = self.code.blocks.get_mut(block) else { break };
            block = match one.within {
                None => {
                    one.within = Some(place);
                    block.saturating_sub(1)
                }
                Some(inner) => match self.code.loops.get(inner) {
                    // The WHILE of the inner loop is in this one.
                    Some(inner) => inner.from.saturating_sub(1),
                    None => break,
                },
            };
        }
    }

    /// The program ends: what is open is never closed.
    fn close(&mut self) {
        while let Some(opened) = self.opened.pop() {
            self.settle(opened, None);
        }
        self.open = [0; 4];
    }

    /// Says what becomes of a WHILE.
    fn settle(&mut self, opened: Opened, end: Option<usize>) {
        let Some(block) = self.code.blocks.get_mut(opened.block) else { return };
        let stop = match end {
            _ if opened.is_again => {
                refuse(FaultKind::DuplicateLabel, "a loop of this number is open")
            }
            Some(end) => Ok(end),
            None => refuse(FaultKind::MissingEnd, "a DO without its END"),
        };
        match (stop, &mut block.kind) {
            (Ok(end), Kind::While { behind, .. }) => *behind = end,
            (Err(stop), kind) => *kind = Kind::Stop(stop),
            (Ok(_), _) => {}
        }
    }

    fn replace(&mut self, place: usize, kind: Kind) {
        if let Some(block) = self.code.blocks.get_mut(place) {
            block.kind = kind;
        }
    }

    fn open_of(&mut self, number: u32) -> &mut u32 {
        let [zero, one, two, three] = &mut self.open;
        match number {
            1 => one,
            2 => two,
            3 => three,
            _ => zero,
        }
    }
}

/// Reads slash, O and N.
fn begin(cursor: &mut Cursor<'_>, numbers: &mut Numbers) -> Result<(), Stop> {
    cursor.takes(b"/");
    if cursor.takes(b"O") {
        numbers.program = Some(cursor.plain()?);
    }
    if cursor.takes(b"N") {
        numbers.sequence = Some(cursor.plain()?);
    }
    Ok(())
}
