//! No bytes make it panic, and it comes to an end or goes on in bounded steps.

extern crate std;

use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{Machine, Options};
use proptest::prelude::*;

use super::Recorder;
use crate::{Interpreter, Limits, Memory, Progress};

/// Parts that programs are made of, the dangerous ones more often.
const PARTS: &[&str] = &[
    "g1",
    "g0",
    "x",
    "y1",
    "f100",
    "g81 x1 z-1 r1 l9",
    "g83 z-9999999 r1 q0.01",
    "g38.3 z-1",
    "m2",
    "m98 p1",
    "m98 p2 l3",
    "m99",
    "o1",
    "o2",
    "o<a>",
    "o[#1]",
    " sub",
    " endsub",
    " call",
    " [#1+1]",
    " [1]",
    " [0]",
    " if",
    " else",
    " elseif",
    " endif",
    " while",
    " endwhile",
    " do",
    " repeat",
    " endrepeat",
    " break",
    " continue",
    " return",
    "#1=",
    "#<a>=",
    "#<_g>=",
    "#<a>",
    "#1",
    "##2",
    "[",
    "]",
    "+",
    "-",
    "/",
    "**",
    " mod ",
    " eq ",
    "atan[1]/[2]",
    "sqrt[-1]",
    "exists[#<a>]",
    "(",
    ")",
    ";",
    "(debug,#1 %d #<a>)",
    "(log,x)",
    "(logopen,f)",
    "%",
    "/",
    "n10",
    "\n",
    "\n",
    "\n",
    "\n",
    "\r\n",
    "\r",
    "\t",
    ".",
    "1e9",
    "99999999999999999999",
    "$1",
    "@1",
    "^2",
    "\u{e9}",
    "\0",
    "o1 sub\n",
    "o1 endsub\n",
    "o1 call\n",
    "o1\n",
    "o2 while [#1 lt 5]\n#1=[#1+1]\n",
    "o2 endwhile\n",
    "o3 if [#1]\n",
    "o3 else\n",
    "o3 endif\n",
];

fn run(program: &[u8], chunk: usize) {
    let limits = Limits { code_bytes: 1 << 20, ..Limits::default() };
    let mut interpreter = Interpreter::new(Machine::default(), Options::default(), limits).unwrap();
    let mut recorder = Recorder::default();
    let mut source = Slow { text: program, at: 0, chunk };
    for _ in 0..3 {
        match interpreter.run(&mut source, &mut recorder, 300) {
            Ok(Progress::Ended(_)) | Err(_) => break,
            Ok(Progress::More | Progress::Stopped | Progress::Aborted) => {}
        }
    }
    interpreter.abort(&mut recorder);
    let mut again = Memory::new("m2\n");
    let _end = interpreter.run(&mut again, &mut recorder, 10);
}

/// A source that gives little at a time.
struct Slow<'a> {
    text: &'a [u8],
    at: usize,
    chunk: usize,
}

impl crate::Source for Slow<'_> {
    fn text(&mut self) -> Result<&[u8], crate::SourceError> {
        let end = (self.at + self.chunk).min(self.text.len());
        Ok(&self.text[self.at.min(end)..end])
    }
    fn consume(&mut self, bytes: usize) {
        self.at += bytes;
    }
    fn rewind(&mut self, offset: u64) -> Result<bool, crate::SourceError> {
        self.at = usize::try_from(offset).unwrap();
        Ok(true)
    }
    fn open(&mut self, _name: &str) -> Result<bool, crate::SourceError> {
        Ok(false)
    }
    fn close(&mut self) {}
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 2000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn any_bytes_never_panic(program in proptest::collection::vec(any::<u8>(), 0..200), chunk in 1_usize..40) {
        run(&program, chunk);
    }

    #[test]
    fn any_parts_never_panic(parts in proptest::collection::vec(0..PARTS.len(), 0..60), chunk in 1_usize..40) {
        let program: String = parts.iter().map(|part| PARTS[*part]).collect();
        run(program.as_bytes(), chunk);
    }

    /// How the text is cut into pieces changes nothing.
    #[test]
    fn pieces_make_no_difference(parts in proptest::collection::vec(0..PARTS.len(), 0..40), chunk in 1_usize..12) {
        let program: String = parts.iter().map(|part| PARTS[*part]).collect();
        let whole = trace(program.as_bytes(), usize::MAX / 2);
        prop_assert_eq!(trace(program.as_bytes(), chunk), whole);
    }
}

/// Everything that a run tells.
fn trace(program: &[u8], chunk: usize) -> (Vec<(u32, String)>, String) {
    let mut interpreter =
        Interpreter::new(Machine::default(), Options::default(), Limits::default()).unwrap();
    let mut recorder = Recorder::default();
    let mut source = Slow { text: program, at: 0, chunk };
    let end = interpreter.run(&mut source, &mut recorder, 300);
    (recorder.effects, alloc::format!("{end:?}"))
}
