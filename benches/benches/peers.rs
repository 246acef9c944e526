//! Production beside LinuxCNC's `rs274` in one run: nanoseconds of a processor for each executed block.
//!
//! `cargo bench -p gaugeblock-benches --bench peers [-- [NAME] [RUNS]]`
//!
//! `rs274` runs as it is, its output to `/dev/null`, and once more with printing that does nothing (`peers/silent.c`,
//! loaded before the C library), since a controller does not print either. A run of a program of one block is
//! subtracted. The minimum of several runs counts; the three take turns, so that a busy machine is busy for all.
//! Where `rs274` or a C compiler is missing, the table has fewer columns.
#![expect(clippy::print_stdout, reason = "a measurement is printed")]

use std::env;
use std::fs;
use std::hint::black_box;
use std::io::{Error, Result};
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use gaugeblock_benches::{LONG_PROGRAMS, LongProgram, long_program};
use gaugeblock_interpreter::{BlockEnd, Interpreter, Limits, Memory, Progress, Reply, Sink};
use gaugeblock_vocabulary::{Effect, End, Machine, Options, Settings};
use rustix::process::{Pid, WaitId, WaitIdOptions, waitid};
use rustix::time::{ClockId, clock_gettime};

/// How often each is run unless the command line says another number.
const RUNS: u32 = 5;
/// A program that costs nothing but the start.
const EMPTY: &str = "G21\nM2\n";

fn main() -> Result<()> {
    let arguments: Vec<String> =
        env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let runs = arguments.iter().find_map(|argument| argument.parse().ok()).unwrap_or(RUNS);
    let wanted = arguments.iter().find(|argument| argument.parse::<u32>().is_err());
    let peer = Peer::find()?;
    println!(
        "{:26} {:>8} {:>7} {:>9} {:>7} {:>9} {:>7}",
        "nanoseconds a block", "blocks", "ours", "rs274", "ratio", "silent", "ratio"
    );
    let start = match &peer {
        Some(peer) => peer.start(runs)?,
        None => Seconds::default(),
    };
    let wanted = |name: &&&str| wanted.is_none_or(|wanted| name.contains(wanted));
    for program in LONG_PROGRAMS.iter().filter(wanted).filter_map(|name| long_program(name)) {
        measure(&program, peer.as_ref(), start, runs)?;
    }
    Ok(())
}

/// Seconds of a processor that `rs274` takes.
#[derive(Clone, Copy, Default)]
struct Seconds {
    /// As it is.
    printing: f64,
    /// With printing that does nothing.
    silent: f64,
}

/// Runs a program everywhere and prints its row.
fn measure(program: &LongProgram, peer: Option<&Peer>, start: Seconds, runs: u32) -> Result<()> {
    if let Some(peer) = peer {
        peer.check(program)?;
    }
    let blocks = count_blocks(program)?;
    let mut ours = f64::INFINITY;
    let mut theirs = Seconds { printing: f64::INFINITY, silent: f64::INFINITY };
    for _ in 0..runs {
        ours = ours.min(run_ours(program)?);
        if let Some(peer) = peer {
            theirs = peer.run(theirs)?;
        }
    }
    let nanoseconds = |seconds: f64| seconds * 1e9 / f64::from(blocks);
    let ours = nanoseconds(ours);
    print!("{:26} {blocks:8} {ours:7.1}", program.name);
    for (seconds, start) in [(theirs.printing, start.printing), (theirs.silent, start.silent)] {
        if seconds.is_finite() {
            let theirs = nanoseconds(seconds - start);
            print!(" {theirs:9.1} {:7.1}", theirs / ours);
        }
    }
    println!();
    Ok(())
}

/// Takes effects and settings and does nothing with them.
struct Silent;

impl Sink for Silent {
    fn set(&mut self, _line: u32, changed: &Settings) {
        black_box(changed);
    }

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        black_box(effect);
        Reply::Done
    }
}

/// Counts blocks.
struct Counting(u32);

impl Sink for Counting {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, _effect: &Effect) -> Reply {
        Reply::Done
    }

    fn end_block(&mut self, _done: &mut BlockEnd<'_>) {
        self.0 += 1;
    }
}

/// Interprets a program to its end.
fn interpret<K: Sink>(program: &LongProgram, sink: &mut K) -> Result<()> {
    let mut interpreter =
        Interpreter::new(Machine::default(), Options::default(), Limits::default())
            .map_err(Error::other)?;
    let mut source = Memory::new(&program.text);
    loop {
        match interpreter.run(&mut source, sink, 1_000_000).map_err(Error::other)? {
            Progress::More => {}
            Progress::Ended(End::ProgramEnd) => return Ok(()),
            other @ (Progress::Stopped | Progress::Aborted | Progress::Ended(_)) => {
                return Err(Error::other(format!("{}: {other:?}", program.name)));
            }
        }
    }
}

fn count_blocks(program: &LongProgram) -> Result<u32> {
    let mut sink = Counting(0);
    interpret(program, &mut sink)?;
    Ok(sink.0)
}

fn run_ours(program: &LongProgram) -> Result<f64> {
    let start = own_processor_time()?;
    interpret(program, &mut Silent)?;
    Ok(own_processor_time()? - start)
}

/// Seconds that this process has had of a processor, up to now: what `schedstat` tells of a process that runs is some
/// milliseconds old.
fn own_processor_time() -> Result<f64> {
    let time = Duration::try_from(clock_gettime(ClockId::ProcessCPUTime));
    time.map(|time| time.as_secs_f64()).map_err(Error::other)
}

/// Seconds that a process that has exited and was not waited for has had of a processor, as Linux tells.
fn processor_time(process: u32) -> Result<f64> {
    let text = fs::read_to_string(format!("/proc/{process}/schedstat"))?;
    let nanoseconds = text.split(' ').next().and_then(|first| first.parse::<f64>().ok());
    nanoseconds.map(|nanoseconds| nanoseconds / 1e9).ok_or_else(|| Error::other("no schedstat"))
}

/// `rs274` and a folder for it.
struct Peer {
    folder: PathBuf,
    /// The library of printing that does nothing, where it could be compiled.
    silent: Option<PathBuf>,
}

impl Peer {
    /// Makes the folder and compiles the library; none where there is no `rs274`.
    fn find() -> Result<Option<Self>> {
        let paths = env::var_os("PATH").unwrap_or_default();
        if !env::split_paths(&paths).any(|path| path.join("rs274").is_file()) {
            println!("rs274 is not on PATH: ours alone.");
            return Ok(None);
        }
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers");
        fs::create_dir_all(&folder)?;
        fs::write(folder.join("tool.tbl"), "T1 P1 Z0 D1\n")?;
        let library = folder.join("silent.so");
        let compiled = Command::new("cc")
            .args(["-O2", "-fno-builtin", "-shared", "-fPIC", "-o"])
            .arg(&library)
            .arg(concat!(env!("CARGO_MANIFEST_DIR"), "/peers/silent.c"))
            .status()
            .is_ok_and(|status| status.success());
        if !compiled {
            println!("peers/silent.c cannot be compiled: rs274 with its printing alone.");
        }
        Ok(Some(Self { folder, silent: compiled.then_some(library) }))
    }

    /// `rs274`, about to run the program in the folder.
    fn command(&self) -> Result<Command> {
        fs::write(self.folder.join("parameters.var"), "")?;
        let mut command = Command::new("rs274");
        command
            .args(["-g", "-t", "tool.tbl", "-v", "parameters.var", "main.ngc"])
            .current_dir(&self.folder)
            .env("HOME", &self.folder)
            .env("LC_ALL", "C")
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null());
        Ok(command)
    }

    /// Puts a program into the folder and sees that `rs274` runs it to its end.
    fn check(&self, program: &LongProgram) -> Result<()> {
        fs::write(self.folder.join("main.ngc"), &program.text)?;
        let output = self.command()?.stdout(Stdio::piped()).stderr(Stdio::piped()).output()?;
        let text = String::from_utf8_lossy(&output.stdout);
        if output.status.success() && text.contains("PROGRAM_END") {
            return Ok(());
        }
        let error = String::from_utf8_lossy(&output.stderr);
        Err(Error::other(format!("rs274 does not run {}: {error}", program.name)))
    }

    /// What a run of nothing takes.
    fn start(&self, runs: u32) -> Result<Seconds> {
        fs::write(self.folder.join("main.ngc"), EMPTY)?;
        let never = Seconds { printing: f64::INFINITY, silent: f64::INFINITY };
        (0..runs).try_fold(never, |least, _| self.run(least))
    }

    /// Runs the program in the folder both ways; the least times of these and earlier runs.
    fn run(&self, least: Seconds) -> Result<Seconds> {
        let printing = least.printing.min(time(self.command()?.spawn()?)?);
        let silent = match &self.silent {
            Some(library) => {
                time(self.command()?.env("LD_PRELOAD", library).spawn()?)?.min(least.silent)
            }
            None => least.silent,
        };
        Ok(Seconds { printing, silent })
    }
}

/// Waits for a process; the time that it had of a processor.
fn time(mut child: Child) -> Result<f64> {
    let exited = WaitIdOptions::EXITED | WaitIdOptions::NOWAIT;
    waitid(WaitId::Pid(Pid::from_child(&child)), exited)?;
    let time = processor_time(child.id());
    if !child.wait()?.success() {
        return Err(Error::other("rs274 failed"));
    }
    time
}
