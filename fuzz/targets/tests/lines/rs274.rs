//! Lines of RS-274.

use gaugeblock_vocabulary::Program;
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::select;

const LABELS: &[&str] = &["1", "1", "2", "2", "3", "100", "#2", "[#2]", "abs[1]", "<x>", "<x>"];
const KEYWORDS: &[&str] = &[
    "sub",
    "endsub",
    "return",
    "return [5]",
    "call",
    "call [7]",
    "if [0]",
    "if [#3 lt 2]",
    "elseif [1]",
    "else",
    "endif",
    "do",
    "while [0]",
    "while [#3 lt 2]",
    "endwhile",
    "repeat [2]",
    "endrepeat",
    "break",
    "continue",
    "",
];
const BROKEN: &[&str] = &[" !", " x1", " [", " (", " #", " (a)", " ; a", " [1", " [1/0]"];
const OTHERS: &[&str] = &[
    "#3=[#3+1]",
    "#<n>=[#3+1]",
    "#31=#<n>",
    "#31=#1",
    "#31=#<_value>",
    "m98 p1",
    "m98 p100",
    "m98 p2 l2",
    "m99",
    "o1",
    "o100",
    "%",
    "m8",
    "m2",
    "m70",
    "m72",
    "m73",
    "g20",
    "#2=1",
    "!",
    "(",
    "/m8",
];

/// A line of an o-word, or of something that shows where the program was.
pub(super) fn structure() -> impl Strategy<Value = String> {
    let broken = prop_oneof![6 => Just(""), 1 => select(BROKEN)];
    let word = (select(LABELS), select(KEYWORDS), broken)
        .prop_map(|(label, keyword, rest)| format!("o{label} {keyword}{rest}"));
    prop_oneof![5 => word, 1 => select(OTHERS).prop_map(str::to_owned)]
}

/// A call of what a program or a file defines.
pub(super) fn call() -> impl Strategy<Value = String> {
    select(&["o<x> call", "o<x> call [7]", "o1 call", "o2 call [#31]", "m98 p1", "m98 p100 l2"][..])
        .prop_map(str::to_owned)
}

/// A program, and the sub of a file beside it.
pub(super) fn with_file(main: String, sub: &[String]) -> Program {
    let file = format!("o<x> sub\n{}\no<x> endsub\nm2\n", sub.join("\n"));
    Program { main, files: [("x.ngc".to_owned(), file)].into(), ..Program::default() }
}

/// Words, and what may stand where one does, apart by blanks.
const WORDS: &str = "\
    g0 g1 g2 g3 g4 g5 g5.1 g5.2 g5.3 g7 g8 g10 g17 g18 g19 g17.1 g20 g21 g28 g28.1 g30 g33 g38.2 g40 g43 g43.1 g49 g52 g53 g54 g59.3 g61 g64 g73 \
    g76 g80 g81 g82 g83 g85 g89 g90 g90.1 g91 g91.1 g92 g92.1 g92.2 g92.3 g93 g94 g95 g96 g97 g98 g99 m0 m1 m3 m4 m5 m6 m7 m8 m9 m19 m48 m49 m50 \
    m51 m52 m53 m61 m62 m63 m64 m65 m67 m68 m70 m71 m72 m73 x1 y2 z-1 a5 u1 i1 j1 k1 k0.5 r1 r2 p0 p1 p0.5 q1 q0 l1 l2 l3 l10 l11 l20 e1 d1 \
    d100 f10 f0 s100 t1 h1 $0 $1 @5 ^30 n5 n5 o1 x#1 x[1] x#<n> x[#1+1] x-#1 #1=1 #1=[#1+1] #<n>=2 #<_n>=3 #[1]=2 ##1=3 #5=#1 #5220=2 #5221=1 \
    #0=1 #-1=1 x[1 x1] x[1/0] xabs[-1] xatan[1]/[2] x1.2.3 x. x xx (a) (b ) (print,#1) (debug,#<n>) (log,d) ;e / % ! [ ] = # < 1 - é";
const WITH_BLANKS: &[&str] =
    &["x[0 or 1]", "x[2 ** 3]", "x[1 lt 2]", "(b )", "(msg, c)", " ", "\t", "\r"];

/// Up to five words.
pub(super) fn block() -> impl Strategy<Value = String> {
    vec(word(), 1..6).prop_map(|words| words.join(""))
}

/// A word, or what may stand where one does; a blank behind it or none.
fn word() -> impl Strategy<Value = String> {
    let words: Vec<_> = WORDS.split(' ').chain(WITH_BLANKS.iter().copied()).collect();
    (select(words), select(&["", " ", " "][..])).prop_map(|(word, blank)| format!("{word}{blank}"))
}

/// Pieces of an expression, apart by blanks.
const PIECES: &str = "1 2 0 0.5 -1 1e3 .5 #1 #<n> #<_n> #<absent> #5220 #<_metric> #[1] [1] [ [ ] ] + - * / ** mod and or xor eq ne lt le gt ge \
    ] [ abs[ acos[ asin[ atan[ cos[ exp[ fix[ fup[ ln[ round[ sin[ sqrt[ tan[ exists[#<n>] exists[#<m>] ]/[ (a) # = 1.2.3 ! x";

/// A setting of #31 to an expression.
pub(super) fn expression() -> impl Strategy<Value = String> {
    let pieces: Vec<_> = PIECES.split(' ').collect();
    vec(select(pieces), 1..9).prop_map(|pieces| {
        let text = pieces.concat();
        let closing = text.matches('[').count().saturating_sub(text.matches(']').count());
        format!("#31=[{text}{}]", "]".repeat(closing))
    })
}

/// Tokens, apart by blanks.
const TOKENS: &str = "o o o1 o1 o2 o<x> <x> <y> [ ] [1] [0] [2] #1 #2 # #<n> #<_n> = 1 2 0 -1 0.5 . - + * / ** sub endsub call return if else elseif endif \
    do while endwhile repeat endrepeat break continue tan[ abs[ sin[0] atan[1]/[1] exists[#1] or and xor mod eq gt g m n x y p l f s t q r m98 m99 m2 m30 \
    m70 m72 m73 g0 g1 g20 g91 p1 l2 x1 n5 % / ( ) (a) (debug,#1) (msg ; ! é #1=1 #2=[ #<n>=3 m9 f10";

/// Tokens one behind the other, lines as they come.
pub(super) fn tokens() -> impl Strategy<Value = String> {
    let mut tokens: Vec<_> = TOKENS.split(' ').collect();
    tokens.extend([" "; 6].into_iter().chain(["\n"; 24]).chain(["\r", "\r\n", "\t", "\u{0}"]));
    vec(select(tokens), 1..24).prop_map(|tokens| tokens.concat())
}
