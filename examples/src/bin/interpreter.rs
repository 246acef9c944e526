//! Embeds the interpreter: program text in, settings and effects out, a block at a time.
//!
//! `cargo run -p gaugeblock-examples --bin interpreter`
#![expect(clippy::print_stdout, reason = "an example prints what it does")]

use gaugeblock_interpreter::{Error, Interpreter, Limits, Memory, Progress, Reply, Sink};
use gaugeblock_vocabulary::{Effect, Machine, Options, Settings};

const PROGRAM: &str = "\
g21 g90 f600
o100 sub
  g1 x#1
  g4 p0.5
o100 endsub
#1=0
o1 while [#1 lt 3]
  #1=[#1+1]
  o100 call [#1*10]
o1 endwhile
m2
";

/// The machine: it prints what it would do. A real one queues motions, and waits where an effect waits for a signal.
struct Printer;

impl Sink for Printer {
    fn set(&mut self, line: u32, changed: &Settings) {
        println!("{line:3}  {}", settings(changed));
    }

    fn perform(&mut self, line: u32, effect: &Effect) -> Reply {
        let arguments: Vec<_> =
            effect.arguments().iter().map(|(name, value)| format!(" {name}={value}")).collect();
        println!("{line:3}  {}{}", effect.name(), arguments.concat());
        // An input has to be answered. This machine has none: the wait ends without a signal.
        if let Effect::WaitInput { .. } = effect { Reply::Input(-1.0) } else { Reply::Done }
    }
}

fn settings(changed: &Settings) -> String {
    let entries = changed.entries();
    let pairs: Vec<_> =
        entries.iter().map(|entry| format!("{}={}", entry.name(), entry.value)).collect();
    pairs.join(" ")
}

fn main() -> Result<(), Error> {
    let mut interpreter =
        Interpreter::new(Machine::default(), Options::default(), Limits::default())?;
    let mut source = Memory::new(PROGRAM);
    // A controller would do other work between these calls, each of which executes ten blocks at most.
    let end = loop {
        match interpreter.run(&mut source, &mut Printer, 10)? {
            Progress::Ended(end) => break end,
            Progress::More | Progress::Stopped | Progress::Aborted => {}
        }
    };
    println!("{}: x={}", end.name(), interpreter.machine_point().x);
    Ok(())
}
