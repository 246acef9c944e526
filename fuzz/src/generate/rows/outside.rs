//! Outputs, inputs, user-defined codes, stops.

use super::super::table::{Kind, Row};

pub(in super::super) const ROWS: &[Row] = &[
    Row::when(
        "io.digital-output",
        Kind::Io,
        16,
        |s| s.io > 0,
        |w| {
            let last = w.state.io - 1;
            let (code, number) = (*w.dice.pick(&["m62", "m63", "m64", "m65"]), w.whole(0, last));
            w.block(format!("{code} p{number}"));
        },
    ),
    Row::when(
        "io.analog-output",
        Kind::Io,
        10,
        |s| s.io > 0,
        |w| {
            let last = w.state.io - 1;
            let (code, number) = (*w.dice.pick(&["m67", "m68"]), w.whole(0, last));
            let value = w.coordinate();
            w.block(format!("{code} e{number} q{value}"));
        },
    ),
    Row::when(
        "io.read",
        Kind::Io,
        12,
        |s| s.io > 0,
        |w| {
            let last = w.state.io - 1;
            let (letter, number) = (*w.dice.pick(&["p", "e"]), w.whole(0, last));
            let l = *w.dice.pick(&["", " l0"]);
            w.block(format!("m66 {letter}{number}{l}"));
            if w.dice.chance(60) {
                w.block("#33 = #5399");
            }
        },
    ),
    Row::when(
        "io.wait",
        Kind::Io,
        8,
        |s| s.io > 0,
        |w| {
            let last = w.state.io - 1;
            let (number, mode) = (w.whole(0, last), w.dice.range(1, 4));
            // Without Q it is refused, or waits for as long as it takes.
            let timeout =
                if w.dice.chance(1) { "" } else { *w.dice.pick(&[" q0.5", " q1", " q3"]) };
            w.block(format!("m66 p{number} l{mode}{timeout}"));
        },
    ),
    Row::when(
        "user-code",
        Kind::Outside,
        12,
        |s| !s.user_codes.is_empty(),
        |w| {
            let codes = w.state.user_codes.clone();
            let code = *w.dice.pick(&codes);
            let mut words = String::new();
            for letter in [" p", " q"] {
                if w.dice.chance(60) {
                    words.push_str(&format!("{letter}{}", w.coordinate()));
                }
            }
            w.block(format!("m{code}{words}"));
        },
    ),
    Row::any("stop.optional", Kind::Outside, 6, |w| w.block("m1")),
    Row::when(
        "stop",
        Kind::Outside,
        2,
        |s| !s.nested,
        |w| {
            let code = *w.dice.pick(&["m0", "m60"]);
            w.block(code);
        },
    ),
];
