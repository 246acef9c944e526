//! How fast the interpreter is: nanoseconds a block, text to a sink that counts.
//!
//! `cargo run --release -p gaugeblock-interpreter --example speed [NAME [RUNS]]`
#![expect(clippy::print_stdout, reason = "a measurement is printed")]
#![expect(clippy::cast_precision_loss, reason = "a few million blocks")]

use std::fmt::Write as _;
use std::hint::black_box;

use gaugeblock_interpreter::{Error, Interpreter, Limits, Memory, Progress, Reply, Sink};
use gaugeblock_vocabulary::{Effect, Machine, Options, Settings};

/// Counts effects.
#[derive(Default)]
struct Count(u64);

impl Sink for Count {
    fn set(&mut self, _line: u32, changed: &Settings) {
        black_box(changed);
    }

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        black_box(effect);
        self.0 += 1;
        Reply::Done
    }
}

/// Lines of the programs that run straight through.
const LINES: u64 = 1_000_000;

/// A program, and how many blocks it executes that are measured.
struct Workload {
    name: &'static str,
    text: fn() -> String,
    blocks: u64,
}

fn lines(count: u64, mut line: impl FnMut(&mut String, u64)) -> String {
    let mut text = String::from("g21 g90 g94 f100 g1 x0\n#<_sum>=1 #<b>=2\n");
    for at in 0..count {
        line(&mut text, at);
    }
    text.push_str("m2\n");
    text
}

/// Writing into a text cannot fail.
fn put(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    let _done = text.write_fmt(arguments);
}

fn workloads() -> Vec<Workload> {
    let workload = |name, blocks, text| Workload { name, text, blocks };
    vec![
        workload("G1 X Y Z", LINES, || {
            lines(LINES, |text, at| {
                let (x, decimals, y, z) = (at % 300, at % 1000, at % 200, at % 50);
                put(text, format_args!("G1 X{x}.{decimals:03} Y{y}.5 Z-{z}.25\n"));
            })
        }),
        workload("X Y", LINES, || {
            lines(LINES, |text, at| {
                put(text, format_args!("X{}.{:03} Y{}.5\n", at % 300, at % 1000, at % 200));
            })
        }),
        workload("expressions", LINES, || {
            lines(LINES, |text, at| {
                let (into, less) = (31 + at % 50, at % 100);
                put(text, format_args!("#{into} = [#1 * 2 + [#2 - {less}] / 4 + abs[#3]]\n"));
            })
        }),
        workload("named", LINES, || {
            lines(LINES, |text, _| text.push_str("#<_sum> = [#<_sum> + #<b>]\n"))
        }),
        workload("while, 3 blocks a turn", 3_000_000, || {
            "#1=0\no1 while [#1 lt 1000000]\n#1=[#1+1]\no1 endwhile\nm2\n".into()
        }),
        workload("repeat with G1", 3_000_000, || {
            "f100 g1 x0\no1 repeat [1000000]\nx[#1+1] y#2\n#1=[#1+0.5]\no1 endrepeat\nm2\n".into()
        }),
        workload("calls with 2 arguments", 1_000_000, || {
            let sub = "o1 sub\n#31=[#1+#2]\no1 endsub\n";
            format!("{sub}o2 repeat [1000000]\no1 call [#31] [2]\no2 endrepeat\nm2\n")
        }),
        workload("M98 L", 1_000_000, || "m98 p100 l1000000\nm2\no100\n#1=[#1+1]\nm99\n".into()),
    ]
}

fn run(text: &str) -> Result<u64, Error> {
    let mut interpreter =
        Interpreter::new(Machine::default(), Options::default(), Limits::default())?;
    let mut source = Memory::new(text);
    let mut sink = Count::default();
    while interpreter.run(&mut source, &mut sink, 1_000_000)? == Progress::More {}
    Ok(sink.0)
}

/// Nanoseconds that this process has had of a processor, as Linux reports; a busy machine does not count.
fn processor_time() -> f64 {
    let text = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|first| first.parse().ok()).unwrap_or(0.0)
}

fn main() -> Result<(), Error> {
    let wanted = std::env::args().nth(1);
    let runs = std::env::args().nth(2).and_then(|runs| runs.parse().ok()).unwrap_or(5);
    for workload in workloads() {
        if wanted.as_ref().is_some_and(|wanted| !workload.name.contains(wanted)) {
            continue;
        }
        let text = (workload.text)();
        let mut best = f64::INFINITY;
        let mut effects = 0;
        for _ in 0..runs {
            let start = processor_time();
            effects = run(&text)?;
            best = best.min(processor_time() - start);
        }
        let nanoseconds = best / workload.blocks as f64;
        println!("{:24} {nanoseconds:7.1} ns, {effects} effects", workload.name);
    }
    Ok(())
}
