//! How many instructions production executes for a block, against `budgets.toml`: the same on a busy machine, and on
//! every x86-64 processor.
//!
//! `cargo bench -p gaugeblock-benches --bench instructions`
//!
//! It runs itself under callgrind, once for each long program, and fails where a program costs more than its budget
//! allows. Without valgrind it says so and measures nothing.
#![expect(clippy::print_stdout, reason = "a measurement is printed")]

use std::env;
use std::hint::black_box;
use std::io::{Error, Result};
use std::process::{Command, ExitCode};

use gaugeblock_benches::{LONG_PROGRAMS, budgets, long_program};
use gaugeblock_interpreter::gpp::{PostProcessor, StatementEnd, TOOLPATH};
use gaugeblock_interpreter::nct::{CustomMacros, MacroStep};
use gaugeblock_interpreter::{BlockEnd, Interpreter, Limits, Memory, Progress, Reply, Sink};
use gaugeblock_vocabulary::{Effect, Machine, Options, Settings};

/// How many steps of a program are counted: less than the whole of it.
const STEPS: u64 = 50_000;
/// How far above its budget a program may be: compilers differ a little.
const TOLERANCE: f64 = 1.02;
/// The copying functions of the C library are chosen by processor; without these features they are the same on each.
const PLAIN_PROCESSOR: &str =
    "glibc.cpu.hwcaps=-AVX2_Usable,-AVX2,-AVX_Fast_Unaligned_Load,-AVX512VL,-ERMS,-FSRM";
/// Below this part of its budget, the budget should be lowered.
const GENEROUS: f64 = 0.95;

/// The name of the calls that are counted, of a macro with ten arguments, each with its return.
const MACRO_CALLS: &str = "macro calls with ten arguments";

/// The name of the blocks of a toolpath that are counted, each with the statement that it leads to.
const POST_BLOCKS: &str = "post-processor blocks, ten items";

fn main() -> Result<ExitCode> {
    let mut arguments = env::args().skip(1);
    if arguments.next().as_deref() == Some("run") {
        let name = arguments.next().unwrap_or_default();
        if name == MACRO_CALLS {
            println!("{}", macro_calls()?);
            return Ok(ExitCode::SUCCESS);
        }
        if name == POST_BLOCKS {
            println!("{}", post_blocks()?);
            return Ok(ExitCode::SUCCESS);
        }
        let program = long_program(&name).ok_or_else(|| Error::other("no such program"))?;
        println!("{}", measured(&program.text)?);
        return Ok(ExitCode::SUCCESS);
    }
    let Some(budgets) = budgets()? else { return Ok(ExitCode::SUCCESS) };
    let mut kept = true;
    for name in LONG_PROGRAMS.iter().chain([&MACRO_CALLS, &POST_BLOCKS]) {
        kept &= judge(name, &budgets)?;
    }
    Ok(if kept { ExitCode::SUCCESS } else { ExitCode::FAILURE })
}

/// Prints what a program costs; whether that is within its budget.
fn judge(name: &str, budgets: &toml::Table) -> Result<bool> {
    let budget = budgets.get(name).and_then(toml::Value::as_integer);
    let budget = budget.and_then(|budget| i32::try_from(budget).ok()).map(f64::from);
    let budget = budget.ok_or_else(|| Error::other(format!("no budget for {name}")))?;
    let instructions = count(name)?;
    let (kept, verdict) = if instructions > budget * TOLERANCE {
        (false, "TOO MANY")
    } else if instructions < budget * GENEROUS {
        (true, "lower the budget")
    } else {
        (true, "")
    };
    println!("{name:32} {instructions:8.1} of {budget:6} instructions a block  {verdict}");
    Ok(kept)
}

/// Instructions a block, by callgrind.
fn count(name: &str) -> Result<f64> {
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null", "--collect-atstart=no"])
        .arg("--toggle-collect=instructions::measured")
        .arg("--toggle-collect=instructions::measured_macros")
        .arg("--toggle-collect=instructions::measured_post")
        .arg(env::current_exe()?)
        .args(["run", name])
        .env("GLIBC_TUNABLES", PLAIN_PROCESSOR)
        .output()?;
    let told = String::from_utf8_lossy(&output.stderr);
    let collected = told.lines().find_map(|line| line.split("Collected : ").nth(1));
    let collected = collected.and_then(|number| number.trim().parse::<f64>().ok());
    let blocks = String::from_utf8_lossy(&output.stdout).trim().parse::<f64>();
    match (collected, blocks) {
        (Some(collected), Ok(blocks)) if collected > 0.0 => Ok(collected / blocks),
        _ => Err(Error::other(format!("callgrind did not count {name}: {told}"))),
    }
}

/// Counts blocks and takes the rest as it comes.
struct Counting(u32);

impl Sink for Counting {
    fn set(&mut self, _line: u32, changed: &Settings) {
        black_box(changed);
    }

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        black_box(effect);
        Reply::Done
    }

    fn end_block(&mut self, _done: &mut BlockEnd<'_>) {
        self.0 += 1;
    }

    fn end_statement(&mut self, done: &StatementEnd<'_>) {
        self.0 += u32::from(done.file() == TOOLPATH);
        black_box(done);
    }

    fn end_macro_step(&mut self, done: &MacroStep<'_>) {
        self.0 += 1;
        black_box(done);
    }
}

/// Interprets a program for as many steps as tell what a block costs; the number of its blocks. Callgrind counts
/// within this function.
#[inline(never)]
fn measured(text: &str) -> Result<u32> {
    let mut interpreter =
        Interpreter::new(Machine::default(), Options::default(), Limits::default())
            .map_err(Error::other)?;
    let mut source = Memory::new(text);
    let mut sink = Counting(0);
    match interpreter.run(&mut source, &mut sink, STEPS).map_err(Error::other)? {
        Progress::More => Ok(sink.0),
        other @ (Progress::Stopped | Progress::Aborted | Progress::Ended(_)) => {
            Err(Error::other(format!("{other:?}")))
        }
    }
}

/// Calls a macro again and again; the number of calls, each of which is the block of the call and that of the return.
fn macro_calls() -> Result<u32> {
    let call = "G65 P2 A1 B2.5 C#100 D-4 E5 F[#100+6] H7 Q#101 X9 Y-10.25\n";
    let text = format!("O1\n#100=3\n{}M30\nO2\nM99\n", call.repeat(25_000));
    let axes = Machine::default().axes;
    let mut run =
        CustomMacros::new(&text, &axes, false, &Options::default()).map_err(Error::other)?;
    let mut sink = Counting(0);
    measured_macros(&mut run, &mut sink);
    Ok(sink.0 / 2)
}

/// Callgrind counts within this function, too.
#[inline(never)]
fn measured_macros(run: &mut CustomMacros, sink: &mut Counting) {
    for _ in 0..40_000 {
        if run.step(sink).is_err() {
            break;
        }
    }
}

/// Outputs ten items at each block of a toolpath: texts, and numbers by their formats; the number of blocks.
fn post_blocks() -> Result<u32> {
    let program = "FORMAT (USER_1) A;\nMODAL X_CURPOS;\nNEW_LINE_IS ! ;\nOUTPUT \\J \"N10 \";\nBEGINNING OF TAPE:\nA = 100;\nLINEAR MOTION:\nOUTPUT ! \"G01\" \" X\" X_CURPOS \" Y\" Y_CURPOS \" Z\" Z_CURPOS \" F\" A;\n";
    let mut toolpath = String::from(
        "system X_CURPOS change COORDINATES\nsystem Y_CURPOS change COORDINATES\nsystem Z_CURPOS change COORDINATES\nblock BEGINNING OF TAPE:\n",
    );
    for place in 0..20_000 {
        let (whole, part) = (place % 400, place % 997);
        toolpath.push_str(&format!(
            "block LINEAR MOTION: X_CURPOS={whole}.{part} Y_CURPOS=-{part}.5 Z_CURPOS=2.{whole}\n"
        ));
    }
    let mut post =
        PostProcessor::new(program, Some(&toolpath), &Options::default()).map_err(Error::other)?;
    let mut sink = Counting(0);
    let ended = measured_post(&mut post, &mut sink);
    if ended { Ok(sink.0) } else { Err(Error::other("it does not run to its end")) }
}

/// Callgrind counts within this function, too.
#[inline(never)]
fn measured_post(post: &mut PostProcessor, sink: &mut Counting) -> bool {
    while post.has_next() {
        if post.step(sink).is_err() {
            return false;
        }
    }
    true
}
