//! Numbered programs: M98 and M99 (11.7.4.1).

use alloc::format;
use alloc::string::String;

use gaugeblock_vocabulary::{Machine, Options};

use super::{Case, Recorder, check, check_all};
use crate::{Interpreter, Limits, Memory, Progress, Source, SourceError};

#[test]
fn the_manuals_example_gives_five_and_a_quarter() {
    check(
        "o1 ; main\n#1=0\nm98 p100 l5\n#31=#1\nm30\no100\n#1=[#1+1]\nm98 p200 l5\nm99\no200\n#1=[#1+0.01]\nm99\n",
        "accepted; #31 = 5.25; #1 = 5.25",
    );
}

#[test]
fn subprograms_follow_their_calls() {
    check_all(&[
        ("m98 p100\nm2\no100 (title)\n#31=[#31+1]\nm99\n", "#31 = 1"),
        ("n5 m98 p[50*2] l[1+1]\nm2\no100\n#31=[#31+1]\nm99\n", "#31 = 2"),
        ("m98 p100 l0\nm2\n", "refused at 1 unknown_sub"),
        ("o9 repeat [2]\nm98 p100\no9 endrepeat\nm2\no100\n#31=[#31+1]\nm99\n", "#31 = 2"),
        ("m98 p100\nm2\no100\no1 if [1]\nm99\no1 endif\n#31=1\nm99\n", "#31 = 0; accepted"),
        ("m98 p100\nm2\no100\n#31=1\no200\n#32=1\nm99\n", "#31 = 1; #32 = 1"),
        ("%\nm98 p100\nm2\n%\no100\nm99\n", "refused at 2 unknown_sub"),
        ("m98 p100\nm2\n", "refused at 1 unknown_sub"),
        ("m98 p100\nm2\no100\n#31=1\n", "refused missing_end"),
        ("o5 sub\nm98 p100\no5 endsub\no5 call\nm2\no100\n#31=1\nm99\n", "#31 = 1"),
        ("m98 p1\nm2\no1\nm98 p2\nm99\no2\nm98 p1\nm99\n", "refused at 7 unknown_sub"),
    ]);
}

#[test]
fn subprograms_share_what_calls_do_not() {
    check_all(&[
        ("#1=5\nm98 p100\n#31=#1\nm2\no100\n#1=[#1+1]\nm99\n", "#31 = 6"),
        ("#<a>=5\nm98 p100\nm2\no100\n#31=exists[#<a>]\n#<b>=1\nm99\n", "#31 = 0; no #<b>"),
        ("m98 p100 l3\nm2\no100\n#31=[#31+exists[#<b>]]\n#<b>=1\nm99\n", "#31 = 0"),
        ("m98 p100\n#32=#<_call_level>\nm2\no100\n#31=#<_call_level>\nm99\n", "#31 = 1; #32 = 0"),
        ("m98 p100\nm2\no100\no1 repeat [2]\n#31=[#31+1]\no1 endrepeat\nm99\n", "#31 = 2"),
        ("m98 p100 l2\nm2\no100\no1 if [1]\n#31=[#31+1]\no1 endif\nm99\n", "#31 = 2"),
    ]);
}

#[test]
fn m99_in_the_main_program_is_endless() {
    check("#31=1\nm99\n", "ends endless; #31 = 1");
    check("o1\no1 while [1]\nm99\no1 endwhile\nm2\n", "ends endless");
}

#[test]
fn what_does_not_fit_is_refused() {
    check_all(&[
        ("m98\nm2\n", "refused at 1 missing_word"),
        ("m98 p1.5\nm2\n", "refused at 1 not_an_integer"),
        ("m98 p-1\nm2\n", "refused at 1 word_out_of_range"),
        ("m98 p1 l-1\nm2\n", "refused at 1 word_out_of_range"),
        ("m98 p1 l1.5\nm2\n", "refused at 1 not_an_integer"),
        ("m98 p1 x1\nm2\n", "refused at 1 unused_word"),
        ("g0 m98 p1\nm2\n", "refused at 1"),
        ("m99 p1\nm2\n", "refused at 1 unused_word"),
        ("m98 p1 m99\nm2\n", "refused at 1"),
        ("o1 sub\no1 endsub\nm98 p1\nm2\n", "refused at 3 mixed_styles"),
        ("m98 p1\nm2\no1 sub\no1 endsub\n", "refused at 1 mixed_styles"),
        ("o1 call\nm2\no1\nm99\n", "refused at 1 mixed_styles"),
        ("m98 p1\no1 call\nm2\no1\nm99\n", "refused at 2 mixed_styles"),
        ("o1 sub\nm99\no1 endsub\no1 call\nm2\n", "refused at 2 mixed_styles"),
        ("m98 p1\nm2\no1\no1 return\nm99\n", "refused at 4 mixed_styles"),
        ("m98 p1\nm2\no1\no1 endsub\nm99\n", "refused at 4 mixed_styles"),
        ("m98 p1 l11\nm2\no1\n#31=[#31+1]\nm99\n", "accepted; #31 = 11"),
    ]);
    let machine = Machine { fanuc_subs: false, ..Machine::default() };
    let case = Case { machine: Some(machine), ..Case::default() };
    case.check("m98 p1\nm2\no1\nm99\n", "refused at 1 fanuc_disabled");
    case.check("m99\n", "refused at 1 fanuc_disabled");
    case.check("o1\nm2\n", "refused at 1 fanuc_disabled");
}

#[test]
fn numbers_of_programs_and_turns_are_of_any_size() {
    check_all(&[
        ("m98 p1 l9000000000000001\nm2\no1\n#31=1\nm2\n", "accepted; #31 = 1"),
        ("m98 p100000000000000000\nm2\no100000000000000000\n#31=1\nm99\n", "accepted; #31 = 1"),
        ("m98 p100000000000000000\nm2\n", "refused at 1 unknown_sub"),
        ("m98 p-100000000000000000\nm2\n", "refused at 1 word_out_of_range"),
        ("m98 p1.00005\nm2\no1\n#31=1\nm99\n", "#31 = 1"),
        ("m98 p-0.00005\nm2\no0\n#31=1\nm99\n", "#31 = 1"),
    ]);
}

#[test]
fn levels_count_for_both_styles() {
    let chain = |depth: u32| {
        let mut text = String::from("m98 p1\nm2\n");
        for level in 1..depth {
            text += &format!("o{level}\nm98 p{}\nm99\n", level + 1);
        }
        text + &format!("o{depth}\n#31=1\nm99\n")
    };
    check(&chain(10), "accepted; #31 = 1");
    check(&chain(11), "refused too_many_levels");
}

/// A program in memory that counts how many bytes of it are read, those that are read again too.
struct Counted<'a> {
    memory: Memory<'a>,
    read: usize,
}

impl Source for Counted<'_> {
    fn text(&mut self) -> Result<&[u8], SourceError> {
        self.memory.text()
    }

    fn consume(&mut self, bytes: usize) {
        self.read += bytes;
        self.memory.consume(bytes);
    }

    fn rewind(&mut self, offset: u64) -> Result<bool, SourceError> {
        self.memory.rewind(offset)
    }

    fn open(&mut self, name: &str) -> Result<bool, SourceError> {
        self.memory.open(name)
    }

    fn close(&mut self) {
        self.memory.close();
    }
}

/// How many bytes of a program were read when it had ended.
fn bytes_read(program: &str) -> usize {
    let mut source = Counted { memory: Memory::new(program), read: 0 };
    let options = Options::default();
    let mut interpreter = Interpreter::new(Machine::default(), options, Limits::default()).unwrap();
    let progress = interpreter.run(&mut source, &mut Recorder::default(), u64::MAX);
    assert!(matches!(progress, Ok(Progress::Ended(_))), "{progress:?}");
    source.read
}

#[test]
fn text_after_a_call_is_read_a_bounded_number_of_times() {
    for count in [500, 4_000] {
        let program = |sub: fn(usize) -> String| {
            let subs: String = (1_000..1_000 + count).map(sub).collect();
            format!("m98 p100\nm2\n{subs}o100\nm99\n")
        };
        let without_ends = program(|number| format!("o{number} sub\n#31=1\n"));
        let within_each_other =
            program(|number| format!("o{number} sub\n#31=1\no{number} if [1]\n"));
        let ended = program(|number| format!("o{number} sub\n#31=1\no{number} endsub\n"));
        for program in [without_ends, within_each_other, ended] {
            let (read, length) = (bytes_read(&program), program.len());
            assert!(read < 6 * length, "{read} of {length}: {}", &program[..60]);
        }
    }
}
