//! A program of 1 GB in at most 64 MiB of memory, and an endless loop that is run in slices.
//!
//! `cargo bench -p gaugeblock-benches --bench stream [-- MEGABYTES [BLOCKS]]`
//!
//! The program is generated while the interpreter reads it, so that no other part of the process holds it. The loop
//! runs in slices of 10,000 blocks. The benchmark fails if the process takes more than 64 MiB.
#![expect(clippy::print_stdout, reason = "a measurement is printed")]
#![expect(clippy::disallowed_methods, reason = "a measurement takes the time")]

use std::env;
use std::fs;
use std::io::{Error, Result};
use std::time::{Duration, Instant};

use gaugeblock_interpreter::{
    Interpreter, Limits, Memory, Progress, Reply, Sink, Source, SourceError,
};
use gaugeblock_vocabulary::{Effect, End, Machine, Options, Settings};

/// Most memory that the process may take, KiB.
const MEMORY_MAX_KIB: u64 = 64 << 10;
/// Blocks of a slice. The caller can stop the run between two slices.
const SLICE_BLOCKS: u64 = 10_000;
/// The blocks that the long program repeats.
const TEXT: &str = "G1 X1.25 Y-2.5 F800\nX2.5\n#1=[#1+0.001]\nG0 Z5 (up)\nG1 Z-#1\n";
/// An endless loop of four blocks.
const LOOP: &str = "G21 F100\no1 while [1]\n#1=[#1+1]\nG1 X[#1 mod 10]\no1 endwhile\nM2\n";

fn main() -> Result<()> {
    let mut numbers = env::args().skip(1).filter_map(|argument| argument.parse::<u64>().ok());
    let (megabytes, blocks) =
        (numbers.next().unwrap_or(1000), numbers.next().unwrap_or(100_000_000));
    long_program(megabytes * 1_000_000)?;
    endless_loop(blocks)?;
    let taken = peak_memory()?;
    println!("{taken} KiB of memory at most, of {MEMORY_MAX_KIB}");
    if taken > MEMORY_MAX_KIB {
        return Err(Error::other("the process takes more memory than allowed"));
    }
    Ok(())
}

fn interpreter() -> Result<Interpreter> {
    Interpreter::new(Machine::default(), Options::default(), Limits::default())
        .map_err(|error| Error::other(error.to_string()))
}

fn long_program(bytes: u64) -> Result<()> {
    let mut source = Generated { left: bytes / TEXT.len() as u64, at: 0 };
    let mut interpreter = interpreter()?;
    let mut count = MoveCounter::default();
    let begin = Instant::now();
    loop {
        match interpreter.run(&mut source, &mut count, SLICE_BLOCKS) {
            Ok(Progress::More | Progress::Stopped | Progress::Aborted) => {}
            Ok(Progress::Ended(End::ProgramEnd)) => break,
            Ok(Progress::Ended(end)) => return Err(Error::other(format!("{end:?}"))),
            Err(error) => return Err(Error::other(error.to_string())),
        }
    }
    let seconds = begin.elapsed().as_secs_f64();
    println!("{bytes} bytes of program, {} moves: {seconds:.1} s", count.0);
    Ok(())
}

fn endless_loop(blocks: u64) -> Result<()> {
    let mut source = Memory::new(LOOP);
    let mut interpreter = interpreter()?;
    let mut count = MoveCounter::default();
    let begin = Instant::now();
    let mut longest = Duration::ZERO;
    for _ in 0..blocks / SLICE_BLOCKS {
        let slice_begin = Instant::now();
        let progress = interpreter
            .run(&mut source, &mut count, SLICE_BLOCKS)
            .map_err(|error| Error::other(error.to_string()))?;
        if progress != Progress::More {
            return Err(Error::other(format!("{progress:?}")));
        }
        longest = longest.max(slice_begin.elapsed());
    }
    let seconds = begin.elapsed().as_secs_f64();
    println!(
        "{blocks} blocks of a loop: {seconds:.1} s; the longest slice, after which it can stop, took {:.1} ms",
        longest.as_secs_f64() * 1e3
    );
    Ok(())
}

/// The most memory that this process had, KiB.
fn peak_memory() -> Result<u64> {
    let status = fs::read_to_string("/proc/self/status")?;
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let peak = peak.and_then(|rest| rest.trim().trim_end_matches(" kB").parse().ok());
    peak.ok_or_else(|| Error::other("/proc/self/status has no VmHWM"))
}

/// A program that is generated while it is read.
struct Generated {
    left: u64,
    at: usize,
}

impl Source for Generated {
    fn text(&mut self) -> std::result::Result<&[u8], SourceError> {
        let text = if self.left == 0 { "M2\n" } else { TEXT };
        Ok(text.as_bytes().get(self.at..).unwrap_or(&[]))
    }

    fn consume(&mut self, bytes: usize) {
        self.at += bytes;
        if self.left > 0 && self.at >= TEXT.len() {
            self.left -= 1;
            self.at = 0;
        }
    }

    fn rewind(&mut self, _offset: u64) -> std::result::Result<bool, SourceError> {
        Ok(false)
    }

    fn open(&mut self, _name: &str) -> std::result::Result<bool, SourceError> {
        Ok(false)
    }

    fn close(&mut self) {}
}

/// A sink that counts moves.
#[derive(Default)]
struct MoveCounter(u64);

impl Sink for MoveCounter {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        let moves = matches!(effect, Effect::StraightFeed { .. } | Effect::StraightTraverse { .. });
        self.0 += u64::from(moves);
        Reply::Done
    }
}
