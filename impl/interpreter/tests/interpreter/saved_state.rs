//! M70 to M73 together with calls: every way back, files, numbered subprograms, loops, ends and refusals.

#![expect(clippy::unwrap_used, reason = "a test")]

use gaugeblock_interpreter::{Error, Interpreter, Limits, Memory, Progress, Reply, Sink};
use gaugeblock_vocabulary::{Effect, FaultKind, Machine, Options, Settings};

/// Keeps messages.
#[derive(Default)]
struct Messages(Vec<String>);

impl Sink for Messages {
    fn set(&mut self, _line: u32, _changed: &Settings) {}

    fn perform(&mut self, _line: u32, effect: &Effect) -> Reply {
        if let Effect::Message { text, .. } = effect {
            self.0.push(text.trim().to_owned());
        }
        Reply::Done
    }
}

/// Runs a program, in which ` / ` parts the lines, and gives its messages, or the refusal with its line.
fn run(program: &str, file: &str) -> Result<String, (FaultKind, u32)> {
    let text = program.replace(" / ", "\n");
    let mut messages = Messages::default();
    let (machine, options) = (Machine::default(), Options::default());
    let mut interpreter = Interpreter::new(machine, options, Limits::default()).unwrap();
    let mut source = Memory::new(&text).with_file("helper.ngc", file);
    match interpreter.run(&mut source, &mut messages, 100_000) {
        Ok(Progress::Ended(_)) => Ok(messages.0.join("; ")),
        Err(Error::Fault(fault)) => Err((fault.kind.unwrap(), fault.block.unwrap().line)),
        other => Ok(format!("{other:?}")),
    }
}

fn check(program: &str, expected: &str) {
    assert_eq!(run(program, "").as_deref(), Ok(expected), "{program}");
}

fn check_refused(program: &str, line: u32) {
    assert_eq!(run(program, ""), Err((FaultKind::NothingSaved, line)), "{program}");
}

#[test]
fn the_example_of_the_manual() {
    let show = "o<showstate> sub / (debug,%d#<_imperial> %d#<_absolute> %d#<_feed> %d#<_rpm>) / o<showstate> endsub";
    let imperial = "o<imperialsub> sub / M73 / g20 / g91 / F5 / S300 / o<showstate> call / o<imperialsub> endsub";
    let main = "g21 / g90 / f200 / S2500 / o<showstate> call / o<imperialsub> call / o<showstate> call / m2";
    check(&format!("{show} / {imperial} / {main}"), "0 1 200 2500; 1 0 5 300; 0 1 200 2500");
    let unaware = imperial.replace("M73 / ", "");
    let around = main.replace("o<imperialsub> call", "M70 / o<imperialsub> call / M72");
    check(&format!("{show} / {unaware} / {around}"), "0 1 200 2500; 1 0 5 300; 0 1 200 2500");
}

#[test]
fn every_way_back_restores() {
    let show = "(debug,%d#<_feed>) / m2";
    for body in [
        "f5 / o1 endsub",
        "f5 / o1 return / o1 endsub",
        "f5 / o1 endsub [1]",
        "f5 / o2 if [1] / o1 return [7] / o2 endif / f6 / o1 endsub",
        "o2 while [1] / f5 / o1 return / o2 endwhile / o1 endsub",
        "f5 / o2 repeat [3] / f6 / o2 endrepeat / o1 endsub",
    ] {
        check(&format!("o1 sub / m73 / {body} / f200 / o1 call / {show}"), "200");
        check(&format!("o1 sub / m70 / {body} / f200 / o1 call / (debug,x) / m2"), "x");
        check(
            &format!("o1 sub / m73 / m71 / {body} / f200 / o1 call / {show}"),
            if body.contains("f6 / o2") { "6" } else { "5" },
        );
    }
    check("f200 / m98 p100 / (debug,%d#<_feed>) / m2 / o100 / m73 / f5 / m99", "200");
    check(
        "f200 / m98 p100 l3 / (debug,%d#<_feed>) / m2 / o100 / m73 / f[#<_feed>+1] / (debug,%d#<_feed>) / m99",
        "201; 201; 201; 200",
    );
    check(
        "o1 sub / m73 / f[#1] / o2 if [#1 gt 0] / o1 call [#1-1] / o2 endif / (debug,%d#<_feed>) / o1 endsub / f9 / o1 call [2] / (debug,%d#<_feed>) / m2",
        "0; 1; 2; 9",
    );
}

#[test]
fn files_are_call_levels() {
    let file = "o<helper> sub\nm73\nf5\ng91\n(debug,%d#<_feed>)\no<helper> endsub\n";
    let found = run("f200 / o<helper> call / (debug,%d#<_feed> %d#<_absolute>) / m2", file);
    assert_eq!(found.as_deref(), Ok("5; 200 1"));
}

#[test]
fn levels_do_not_see_each_other() {
    check_refused("m72 / m2", 1);
    check_refused("o1 sub / m72 / o1 endsub / m70 / o1 call / m2", 2);
    check_refused("o1 sub / m70 / o1 endsub / o1 call / m72 / m2", 5);
    check_refused("m70 / m98 p100 / m2 / o100 / m72 / m99", 5);
    check_refused(
        "o1 sub / m70 / o2 if [#1] / m72 / o2 endif / m71 / m72 / o1 endsub / o1 call [0] / m2",
        7,
    );
    check(
        "f3 / m70 / o1 repeat [2] / f[#<_feed>+1] / o1 endrepeat / m72 / (debug,%d#<_feed>) / m2",
        "3",
    );
}

#[test]
fn parameters_are_no_modes() {
    check("#31=1 / m70 / #31=2 / m72 / (debug,%d#31) / m2", "2");
    check("o1 sub / m73 / #<_g>=5 / o1 endsub / #<_g>=1 / o1 call / (debug,%d#<_g>) / m2", "5");
}
