//! Outputs, inputs, user-defined codes, stops.

use super::super::kind::StatementKind;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::when(
        "io.digital-output",
        StatementKind::Io,
        16,
        |s| s.io > 0,
        |w| {
            let last = w.state.io - 1;
            let (code, number) = (*w.entropy.pick(&["m62", "m63", "m64", "m65"]), w.whole(0, last));
            w.block(format!("{code} p{number}"));
        },
    ),
    Statement::when(
        "io.analog-output",
        StatementKind::Io,
        10,
        |s| s.io > 0,
        |w| {
            let last = w.state.io - 1;
            let (code, number) = (*w.entropy.pick(&["m67", "m68"]), w.whole(0, last));
            let value = w.coordinate();
            w.block(format!("{code} e{number} q{value}"));
        },
    ),
    Statement::when(
        "io.read",
        StatementKind::Io,
        12,
        |s| s.io > 0,
        |w| {
            let last = w.state.io - 1;
            let (letter, number) = (*w.entropy.pick(&["p", "e"]), w.whole(0, last));
            let l = *w.entropy.pick(&["", " l0"]);
            w.block(format!("m66 {letter}{number}{l}"));
            if w.entropy.chance(60) {
                w.block("#33 = #5399");
            }
        },
    ),
    Statement::when(
        "io.wait",
        StatementKind::Io,
        8,
        |s| s.io > 0,
        |w| {
            let last = w.state.io - 1;
            let (number, mode) = (w.whole(0, last), w.entropy.range(1, 4));
            // Without Q it is refused, or waits for as long as it takes.
            let timeout =
                if w.entropy.chance(1) { "" } else { *w.entropy.pick(&[" q0.5", " q1", " q3"]) };
            w.block(format!("m66 p{number} l{mode}{timeout}"));
        },
    ),
    Statement::when(
        "user-code",
        StatementKind::Outside,
        12,
        |s| !s.user_codes.is_empty(),
        |w| {
            let codes = w.state.user_codes.clone();
            let code = *w.entropy.pick(&codes);
            let mut words = String::new();
            for letter in [" p", " q"] {
                if w.entropy.chance(60) {
                    words.push_str(&format!("{letter}{}", w.coordinate()));
                }
            }
            w.block(format!("m{code}{words}"));
        },
    ),
    Statement::any("stop.optional", StatementKind::Outside, 6, |w| w.block("m1")),
    Statement::when(
        "stop",
        StatementKind::Outside,
        2,
        |s| !s.nested,
        |w| {
            let code = *w.entropy.pick(&["m0", "m60"]);
            w.block(code);
        },
    ),
];
