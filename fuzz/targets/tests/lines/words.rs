//! Every code with every word: beside it, instead of one that it needs, with every other code, and in whatever state
//! it comes.

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::{Index, select};

/// Blocks that say what they should. In the programs they have words more, words less and words with other values.
const BLOCKS: &[&str] = &[
    "g0 x1",
    "g1 x1 y2",
    "g2 x2 i1",
    "g2 x2 r3",
    "g3 x2 z1 r3 p2",
    "g3 j1",
    "g4 p1",
    "g5 x1 y1 i1 j1 p1 q1",
    "g5.1 x1 y1 i1 j1",
    "g5.2 x1 y1 p1 l3",
    "g5.3",
    "g7",
    "g8",
    "g10 l0",
    "g10 l1 p1 x1 r1",
    "g10 l1 p1 z1 i1 j2 q3",
    "g10 l2 p1 x1 r1",
    "g10 l2 p0 y1",
    "g10 l3 p1 x1",
    "g10 l10 p1 x1 r1 q2",
    "g10 l11 p1 x1 r1 q2",
    "g10 l20 p1 x1",
    "g17",
    "g18",
    "g19",
    "g17.1",
    "g18.1",
    "g19.1",
    "g20",
    "g21",
    "g28",
    "g28 x1",
    "g28.1",
    "g30",
    "g30 z1",
    "g30.1",
    "g33 z1 k1",
    "g33.1 z1 k1 i2",
    "g38.2 x1",
    "g38.3 x1",
    "g38.4 x1",
    "g38.5 x1",
    "g40",
    "g41",
    "g41 d1",
    "g41.1 d1 l2",
    "g42",
    "g42.1 d1",
    "g43",
    "g43 h1",
    "g43.1 x1",
    "g43.2 h1",
    "g43.2 x1",
    "g49",
    "g52 x1",
    "g53 g0 x1",
    "g53 g1 x1",
    "g53",
    "g54",
    "g59.3",
    "g61",
    "g61.1",
    "g64",
    "g64 p1",
    "g64 p1 q1",
    "g70",
    "g73 x1 z-1 r1 q0.5",
    "g74 x1 z-1 r1 p1",
    "g76 p1 z-3 i-1 j0.5 k2",
    "g76 p1 z-3 i-1 j0.5 k2 r1 q1 h1 e1 l1",
    "g80",
    "g81 x1 z-1 r1",
    "g81 x1 z-1 r1 l2",
    "g82 x1 z-1 r1 p1",
    "g83 x1 z-1 r1 q0.5",
    "g84 x1 z-1 r1",
    "g85 x1 z-1 r1",
    "g86 x1 z-1 r1 p1",
    "g87 x1 z-1 r1 i1 j1 k1",
    "g88 x1 z-1 r1 p1",
    "g89 x1 z-1 r1 p1",
    "g90",
    "g91",
    "g90.1",
    "g91.1",
    "g92 x1",
    "g92.1",
    "g92.2",
    "g92.3",
    "g93",
    "g94",
    "g95",
    "g96 s1 d2",
    "g97 s1",
    "g98",
    "g99",
    "g1.5",
    "m0",
    "m1",
    "m2",
    "m3",
    "m3 s100",
    "m4 s100 $0",
    "m5",
    "m5 $1",
    "m6",
    "m6 t1",
    "m7",
    "m8",
    "m9",
    "m19 r90",
    "m19 r90 q1 p1",
    "m30",
    "m48",
    "m49",
    "m50 p1",
    "m51 p0 $0",
    "m52 p1",
    "m53 p1",
    "m60",
    "m61 q1",
    "m62 p1",
    "m63 p1",
    "m64 p1",
    "m65 p1",
    "m66 p1 l0",
    "m66 p1 l1 q1",
    "m66 e1 l0",
    "m67 e1 q1",
    "m68 e1 q1",
    "m70",
    "m71",
    "m72",
    "m73",
    "m98 p1",
    "m98 p1 l2",
    "m99",
    "m100 p1 q1",
    "m42",
    "f1",
    "s1",
    "s1 $0",
    "t1",
    "@1 ^1",
    "x1",
    "g0 @1 ^1",
    "g1 @1",
    "g2 ^90 r5",
];

/// What comes before.
const BEFORE: &[&str] = &[
    "",
    "f9 s9",
    "g1 f9 x1 y1 s9",
    "g91 g0 f9 x1 z1",
    "g2 f9 x2 i1",
    "g18 g3 f9 x1 z1 r2",
    "g81 f9 x1 z-1 r1",
    "g91 g83 f9 x1 z-1 r1 q1",
    "g80 f9",
    "g38.3 f9 x1",
    "g7 f9 g1 x1",
    "g93 g1 f9 x1",
    "g95 s9 m3 f9",
    "f9 t1 m6 g43",
    "f9 m61 q1",
    "f9 g5.2 x1 y1 p1 l3",
    "f9 g19 g90.1",
    "f9 g92 x1 y1",
    "f9 g17.1",
    "g5.1 f9 x1 y1 i1",
    "g33 f9 s9 m3 z1 k1",
    "f9 m70\nf8 g20",
    "g43.1 z1\nm70\ng49 f9",
    "f9 g52 x1",
    "f9 m49",
    "f9 s9 m3\nm73",
];

/// Letters that begin a word.
const LETTERS: &str = "abcdefghijklmpqrstuvwxyz@^$";

/// Values that a word is given.
const VALUES: &[&str] = &["0", "1", "-1", "0.5", "1e"];

/// One word of a block is another one, or there is one more or one less.
#[derive(Clone, Debug)]
enum Change {
    More(String),
    Less(Index),
    Other(Index, &'static str),
}

fn change() -> impl Strategy<Value = Change> {
    let letters: Vec<char> = LETTERS.chars().collect();
    prop_oneof![
        4 => (select(letters), select(VALUES))
            .prop_map(|(letter, value)| Change::More(format!("{letter}{value}"))),
        1 => any::<Index>().prop_map(Change::Less),
        2 => (any::<Index>(), select(VALUES)).prop_map(|(place, value)| Change::Other(place, value)),
    ]
}

/// A block of the table that is changed a little, or two of them in one line or one behind the other, and what comes
/// before.
pub(super) fn program() -> impl Strategy<Value = String> {
    let two = (select(BEFORE), select(BLOCKS), select(&[" ", "\n"][..]), select(BLOCKS));
    let two = two.prop_map(|(before, one, between, two)| {
        format!("{before}\n{one}{between}{two}\ng0 x3\nm2\n")
    });
    prop_oneof![3 => changed(), 1 => two]
}

fn changed() -> impl Strategy<Value = String> {
    (select(BEFORE), select(BLOCKS), vec(change(), 0..3)).prop_map(|(before, block, changes)| {
        let mut words: Vec<String> = block.split(' ').map(str::to_owned).collect();
        for change in changes {
            match change {
                Change::More(word) => words.push(word),
                Change::Less(place) => drop(words.remove(place.index(words.len()))),
                Change::Other(place, value) => {
                    let word = place.get_mut(&mut words);
                    word.truncate(1);
                    word.push_str(value);
                }
            }
            if words.is_empty() {
                break;
            }
        }
        format!("{before}\n{}\ng0 x3\nm2\n", words.join(" "))
    })
}
