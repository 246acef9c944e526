//! Messages, logs, comments, blocks that do nothing, and blocks that are often refused.

use super::super::kind::StatementKind;
use super::super::malformed;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::any("message.plain", StatementKind::Message, 6, |w| {
        let text = *w.entropy.pick(&[
            "plain",
            "a=1",
            "100 %",
            "x, y",
            "two  blanks",
            " led by a blank",
            "",
        ]);
        let how = *w.entropy.pick(&["msg", "MSG", "print", "debug", " msg "]);
        w.block(format!("({how},{text})"));
    }),
    Statement::any("message.values", StatementKind::Message, 14, |w| {
        let (one, other) = (w.parameter(), w.state_parameter());
        let how = *w.entropy.pick(&["print", "debug"]);
        // Only a number or a name stands there, no expression.
        let one = if one.starts_with("#[") { "#31".to_owned() } else { one };
        w.block(format!("({how},a={one} b={other})"));
    }),
    Statement::any("message.formats", StatementKind::Message, 8, |w| {
        let how = *w.entropy.pick(&["print", "debug"]);
        let format = *w
            .entropy
            .pick(&["%d", "%f", "%.2f", "%.0f", "%.1f", "%.3f", "%d", "%f", "%.4f", "%lf"]);
        let other = *w.entropy.pick(&["", " %d#32", " #32", " %f#32"]);
        w.block(format!("({how},{format}#31{other})"));
    }),
    Statement::any("message.and-words", StatementKind::Message, 3, |w| {
        let axes = w.axes(2);
        w.block(format!("g0{axes} (print,at #<_x>)"));
        w.moves(true);
    }),
    Statement::any("message.log", StatementKind::Message, 4, |w| {
        let open = *w.entropy.pick(&["(logopen,a.txt)", "(logappend,a.txt)", "(logopen, a.txt )"]);
        w.block(open);
        w.block("(log,#31)");
        if w.entropy.chance(70) {
            w.block("(logclose)");
        }
    }),
    Statement::any("text.comment", StatementKind::Text, 5, |w| {
        let text =
            *w.entropy.pick(&["(plain)", "; plain", "()", "(a) (b)", "(a);b", "( msg no comma)"]);
        w.block(text);
    }),
    Statement::any("text.blank", StatementKind::Text, 4, |w| {
        let text = *w.entropy.pick(&["", "   ", "\t", "/", "n10", "/n20"]);
        w.block(text);
    }),
    Statement::any("text.deleted", StatementKind::Text, 5, |w| {
        let axes = w.axes(2);
        w.block(format!("/g0{axes}"));
        w.state.moving = false;
    }),
    Statement::any("text.spaced", StatementKind::Text, 5, |w| {
        let text = *w.entropy.pick(&[
            "g 0 x 1 2",
            "g0x1y2z3",
            "g0 x +1. 5",
            "G0X-.5",
            "g00 x01",
            "g0 x1(a)y2",
        ]);
        w.block(text);
        w.moves(true);
    }),
    Statement::when(
        "text.malformed",
        StatementKind::Text,
        1,
        |s| !s.nested,
        |w| {
            let block = malformed::block(w.entropy);
            w.block(&block);
        },
    ),
];
