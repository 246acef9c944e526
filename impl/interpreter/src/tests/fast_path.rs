//! The short way through a plain line has the outcome of the long way. A source that gives a byte at a time never
//! takes the short way.

extern crate std;

use alloc::string::String;
use alloc::vec::Vec;

use gaugeblock_vocabulary::{FaultKind, Machine, Options};
use proptest::prelude::*;

use super::Recorder;
use crate::{Error, Interpreter, Limits, Progress, Source, SourceError};

/// A source that gives so many bytes at a time.
struct Pieces<'a> {
    text: &'a [u8],
    at: usize,
    piece: usize,
}

impl Source for Pieces<'_> {
    fn text(&mut self) -> Result<&[u8], SourceError> {
        let rest = &self.text[self.at.min(self.text.len())..];
        Ok(&rest[..rest.len().min(self.piece)])
    }
    fn consume(&mut self, bytes: usize) {
        self.at += bytes;
    }
    fn rewind(&mut self, offset: u64) -> Result<bool, SourceError> {
        self.at = usize::try_from(offset).unwrap();
        Ok(true)
    }
    fn open(&mut self, _name: &str) -> Result<bool, SourceError> {
        Ok(false)
    }
    fn close(&mut self) {}
}

/// Everything that a run tells and leaves.
fn outcome(program: &str, piece: usize, options: &Options) -> String {
    let mut interpreter =
        Interpreter::new(Machine::default(), options.clone(), Limits::default()).unwrap();
    let mut recorder = Recorder::default();
    let mut source = Pieces { text: program.as_bytes(), at: 0, piece };
    let mut end = interpreter.run(&mut source, &mut recorder, 60);
    if let Ok(Progress::Stopped) = end {
        end = interpreter.run(&mut source, &mut recorder, 60);
    }
    alloc::format!(
        "{end:?}\n{:?}\n{:?}\n{:?}\n{:?}\n{:?}\n{:?}",
        recorder.effects,
        recorder.named,
        recorder.settings,
        recorder.done,
        interpreter.parameters(),
        interpreter.state(),
    )
}

fn digits() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => "[0-9]{1,3}",
        4 => "[0-9]{1,3}\\.[0-9]{1,4}",
        2 => "[0-9]{0,9}\\.?[0-9]{0,9}",
        1 => "[0-9]{0,2}[ .]{0,2}[0-9]{0,2} {0,2}",
        1 => "[0-9]{12,20}\\.?[0-9]{0,6}",
    ]
}

fn number() -> impl Strategy<Value = String> {
    ("(-|-|\\+|- |)", digits()).prop_map(|(sign, digits)| sign + &digits)
}

/// A parameter, small numbers and names more often.
fn parameter() -> impl Strategy<Value = String> {
    prop_oneof![
        4 => "#[1-4]",
        2 => "#(<a>|<b1>|<_g>|<_h>|<A>|< a>|<_x>|<_line>)",
        1 => "#(0|5420|5400|5602|5603|1\\.|1\\.5|1 2|#1|\\[#1\\]|\\[1\\+1\\]|\\[5420\\])",
    ]
}

fn value() -> impl Strategy<Value = String> {
    let leaf = prop_oneof![3 => number(), 3 => parameter()];
    leaf.prop_recursive(4, 12, 4, |inner| {
        let operator =
            "( ?(\\+|-|\\*|/|\\*\\*) ?| (mod|eq|NE|gt|ge|lt|le|and|or|xor) |mod|\\* \\*)";
        let sum = (inner.clone(), proptest::collection::vec((operator, inner.clone()), 0..4));
        let sum = sum.prop_map(|(first, rest)| {
            let rest: String =
                rest.into_iter().map(|(operator, value)| operator + &value).collect();
            alloc::format!("[{first}{rest}]")
        });
        let function = "-?(abs|acos|asin|cos|exp|FIX|fup|round|ln|sin|sqrt|tan|si n|exists|foo)";
        prop_oneof![
            4 => sum.clone(),
            2 => (function, sum.clone()).prop_map(|(name, sum)| name + &sum),
            1 => (sum.clone(), sum).prop_map(|(y, x)| alloc::format!("atan{y}/{x}")),
            1 => inner.prop_map(|value| String::from("-") + &value),
        ]
    })
}

fn item() -> impl Strategy<Value = String> {
    let letter = "[xyzabcuvwfXYZFijkr]";
    prop_oneof![
        8 => (letter, number()).prop_map(|(letter, number)| letter + &number),
        6 => (letter, "( |)", value()).prop_map(|(letter, blank, value)| letter + &blank + &value),
        3 => "(g2|G3|g2i1|g3 i1j1|G02x2r1|g3x2i1|g2 z1 i1 p2|i1|r1|@1|\\^90|g90\\.1|g91\\.1|g18|g19|g17)",
        1 => "(g28|g28\\.1|g30 x1|g30\\.1|g10l2p1|g10 l20 p1 x1|g52x1|g92y1|g92\\.2|g92\\.3|g43\\.1z1)",
        4 => "(G1|g0|G01|g1\\.|G90|G91|g20|G21|G17|g4|p1|G5|G53|G92\\.1|G 1|G-1|g38\\.2|G54|G1\\.0|g100)",
        5 => cycle_item(),
        2 => "(M3|M5|m9|M2|M62|m98|M99|M1000|m 3|M3\\.5|S[0-9]{2}|t1|h1|d1|q2|l1|i1)",
        4 => (parameter(), "( |)=( |)", value()).prop_map(|(to, is, value)| to + &is + &value),
        2 => "(\\([a-z ]{0,6}\\)|;[ a-z(]{0,6}|\\(msg, *[a-z]\\)|\\( *debug,#1\\)|\\(a\\(b\\)|\\()",
        1 => "(o1|n5|N|\\$1|@1|\\^2|%|/|=|\\[|\\x00|\u{e9})",
    ]
}

/// Words of canned cycles, probing, splines and threads, blocks of them that are accepted, and what Grbl's choices
/// decide.
fn cycle_item() -> impl Strategy<Value = String> {
    prop_oneof![
        3 => "(G80|G81|G82|G83|g73|g84|G74|G85|G86|G87|g89|G98|G99|G5\\.[123]|G33|G33\\.1|g38\\.[345]|g76|G18|G93|G42)",
        2 => "(g81 x1 z-1 r1 |g83 y1 z-2 r0 q\\.5 l2 |g84 z-1 r1 p0 |g91 g89 x1 z-1 r1 p0 l3 |m3 g86 z-1 r1 p1 )",
        1 => "(g18 g76 p1 z-9 i-1 j1 k2 |g38\\.3 z-3 |g5 i1 j1 p1 q1 x1 y1 |g5\\.2 x1 y1 l2 |m4 g33 z1 k1 )",
        2 => "(x\\(a\\)[12]|g\\(a\\)[01]|y1\\(a\\)2|g91\\.00[16]|m8\\.00[16]|g59\\.1|g93|x3 f4)",
        3 => "([rR]1|r-1|z-2|Q0?\\.5|p0|l2|L3|k1|i-?1|j1|h2|e1|l1000)",
    ]
}

fn line() -> impl Strategy<Value = String> {
    let blank = "( |  |\t|)";
    let items = proptest::collection::vec((item(), blank), 0..5);
    let head = prop_oneof![12 => "", 2 => "n[0-9]{1,9} ?", 1 => "( |/|n|n1\\.5|n1\\.)"];
    let end = prop_oneof![8 => "\n", 2 => "\r\n", 1 => "\r"];
    (head, items, end).prop_map(|(head, items, end)| {
        let items: String = items.into_iter().map(|(item, blank)| item + &blank).collect();
        head + &items + &end
    })
}

/// Choices that have a say in words and values.
const CHOICES: [(&str, &str); 14] = [
    ("expressions.unary-minus", "refused"),
    ("parameters.absent-global", "zero"),
    ("parameters.read-only-numbered", "written"),
    ("parameters.setting-time", "before-words"),
    ("expressions.negative-zero", "kept"),
    ("text.comment-nested", "plain"),
    ("expressions.order-tolerance", "tolerant"),
    ("active-comments.msg-without-comma", "message"),
    ("feed.after-inverse-time", "zero"),
    ("modal-groups.code-decimals", "hundredths"),
    ("order.feed-unit", "new"),
    ("text.comment-to-line-end", "to-line-end"),
    ("text.comments-removed", "removed"),
    ("text.greatest-line-number", "seven-digits"),
];

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn fast_path_agrees_with_complete_path(
        lines in proptest::collection::vec(line(), 1..5),
        chosen in 0_usize..1 << CHOICES.len(),
    ) {
        let chosen = CHOICES.iter().enumerate().filter(|(place, _)| chosen >> place & 1 == 1);
        let options = Options(chosen.map(|(_, (id, name))| ((*id).into(), (*name).into())).collect());
        let head = "g1 f100\n#1=1 #2=-2.5 #3=0.125 #4=100\n#<a>=2 #<b1>=-3 #<_g>=0.5\n";
        let lines: Vec<String> = lines;
        let program: String = core::iter::once(head.into()).chain(lines).chain(["x1\nm2\n".into()]).collect();
        prop_assert_eq!(
            outcome(&program, usize::MAX, &options),
            outcome(&program, 1, &options),
            "{}", program
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 3000, failure_persistence: None, ..ProptestConfig::default() })]

    /// After an error the state is that after the block before, whichever way the block went.
    #[test]
    fn refused_blocks_change_nothing(lines in proptest::collection::vec(line(), 1..5), short: bool) {
        let head = "g1 f100\n#1=1 #2=-2.5\n#<a>=2 #<_g>=0.5\n";
        let program: String = core::iter::once(head.into()).chain(lines).collect();
        let piece = if short { usize::MAX } else { 1 };
        let mut source = Pieces { text: program.as_bytes(), at: 0, piece };
        let mut interpreter =
            Interpreter::new(Machine::default(), Options::default(), Limits::default()).unwrap();
        let state = |interpreter: &mut Interpreter| {
            let parameters = &interpreter.parameters;
            let named: Vec<_> = parameters.named.existing(&interpreter.compiler.names).collect();
            let named = alloc::format!("{named:?}");
            alloc::format!(
                "{named} {:?} {:?} {:?}",
                interpreter.parameters(),
                interpreter.settings(),
                interpreter.state()
            )
        };
        // A cycle may have more pecks than anyone waits for.
        for _ in 0..60 {
            let before = state(&mut interpreter);
            match interpreter.step(&mut source, &mut Recorder::default()) {
                Ok(Progress::More | Progress::Stopped | Progress::Aborted) => {}
                // An unsuccessful probe has been made.
                Err(Error::Fault(fault)) if fault.kind == Some(FaultKind::Probe) => break,
                Err(_) | Ok(Progress::Ended(gaugeblock_vocabulary::End::Unsupported { .. })) => {
                    prop_assert_eq!(before, state(&mut interpreter), "{}", program);
                    break;
                }
                Ok(Progress::Ended(_)) => break,
            }
        }
    }
}

/// Numbers of every length are rounded correctly.
#[test]
fn numbers_of_every_length() {
    let digits = "123456789012345678";
    for whole in 0..=digits.len() {
        for decimals in 0..=digits.len() {
            if whole + decimals == 0 {
                continue;
            }
            let text = alloc::format!("{}.{}", &digits[..whole], &digits[..decimals]);
            let mut interpreter =
                Interpreter::new(Machine::default(), Options::default(), Limits::default())
                    .unwrap();
            let program = alloc::format!("#1={text}\n#2=[{text}]\nm2\n        ");
            let mut source = Pieces { text: program.as_bytes(), at: 0, piece: usize::MAX };
            let end = interpreter.run(&mut source, &mut Recorder::default(), 300);
            assert!(matches!(end, Ok(Progress::Ended(_))), "{end:?}");
            let value: f64 = text.parse().unwrap();
            let found = interpreter.parameters();
            assert_eq!(found[0].1.to_bits(), value.to_bits(), "{text}");
            assert_eq!(found[1].1.to_bits(), value.to_bits(), "{text}");
        }
    }
}

/// Lines on which a hasty reader goes wrong.
#[test]
fn tricky_lines_agree() {
    let lines = [
        "#5=[2 * * 3]",
        "#5=[2* *3]",
        "#5=[2 ** 3 * 2]",
        "#5=[2 * 3 ** 2]",
        "#5=[1 - 2 - 3]",
        "#5=[2 + 3 * 4 ** 2 / 8 eq 8 and 1]",
        "x1 .5",
        "x1 2",
        "x1\t2",
        "x1.2.3",
        "n1 0 x1",
        "n1.5 x1",
        "n1. x1",
        "n7",
        "n7 (a)",
        "(a comment)",
        "( a bort, no)",
        "(ABORT, yes)",
        "(m s g, hello)",
        "; msg, hello",
        "x1 (first) (msg,second)",
        "x1 (msg,first) (second)",
        "g1.0 x1",
        "g01 x01",
        "g-1 x1",
        "m-3",
        "x-0 y--1",
        "x- 1 y+2 z-[1+1]",
        "#1=2 x#1",
        "# 1=2",
        "#1 = 2",
        "#1.0=2",
        "#01=2",
        "#[1+1]=7 #<a>=8 #<new>=9",
        "#<longer_than_seven>=1 x#<longer_than_seven>",
        "#<a\u{0}>=1",
        "#<A>=1 #< b 1 >=2",
        "x#<a>y#<_g>z[#<b1>]",
        "xabs[-1]ysin[30]zatan[1]/[1]",
    ];
    for line in lines {
        for end in ["\n", "\r\n", "\r"] {
            let program = alloc::format!(
                "g1 f100{end}#1=1 #2=2{end}#<a>=2 #<b1>=-3 #<_g>=0.5{end}{line}{end}{line}{end}m2{end}"
            );
            let options = Options::default();
            let (short, long) =
                (outcome(&program, usize::MAX, &options), outcome(&program, 1, &options));
            assert_eq!(short, long, "{program}");
        }
    }
}
