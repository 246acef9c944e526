//! Messages, logs, comments, blocks that do nothing, and blocks that are often refused.

use super::super::odd;
use super::super::table::{Kind, Row};

pub(in super::super) const ROWS: &[Row] = &[
    Row::any("message.plain", Kind::Message, 6, |w| {
        let text =
            *w.dice.pick(&["plain", "a=1", "100 %", "x, y", "two  blanks", " led by a blank", ""]);
        let how = *w.dice.pick(&["msg", "MSG", "print", "debug", " msg "]);
        w.block(format!("({how},{text})"));
    }),
    Row::any("message.values", Kind::Message, 14, |w| {
        let (one, other) = (w.parameter(), w.state_parameter());
        let how = *w.dice.pick(&["print", "debug"]);
        // Only a number or a name stands there, no expression.
        let one = if one.starts_with("#[") { "#31".to_owned() } else { one };
        w.block(format!("({how},a={one} b={other})"));
    }),
    Row::any("message.formats", Kind::Message, 8, |w| {
        let how = *w.dice.pick(&["print", "debug"]);
        let format =
            *w.dice.pick(&["%d", "%f", "%.2f", "%.0f", "%.1f", "%.3f", "%d", "%f", "%.4f", "%lf"]);
        let other = *w.dice.pick(&["", " %d#32", " #32", " %f#32"]);
        w.block(format!("({how},{format}#31{other})"));
    }),
    Row::any("message.and-words", Kind::Message, 3, |w| {
        let axes = w.axes(2);
        w.block(format!("g0{axes} (print,at #<_x>)"));
        w.moves(true);
    }),
    Row::any("message.log", Kind::Message, 4, |w| {
        let open = *w.dice.pick(&["(logopen,a.txt)", "(logappend,a.txt)", "(logopen, a.txt )"]);
        w.block(open);
        w.block("(log,#31)");
        if w.dice.chance(70) {
            w.block("(logclose)");
        }
    }),
    Row::any("text.comment", Kind::Text, 5, |w| {
        let text =
            *w.dice.pick(&["(plain)", "; plain", "()", "(a) (b)", "(a);b", "( msg no comma)"]);
        w.block(text);
    }),
    Row::any("text.blank", Kind::Text, 4, |w| {
        let text = *w.dice.pick(&["", "   ", "\t", "/", "n10", "/n20"]);
        w.block(text);
    }),
    Row::any("text.deleted", Kind::Text, 5, |w| {
        let axes = w.axes(2);
        w.block(format!("/g0{axes}"));
        w.state.moving = false;
    }),
    Row::any("text.spaced", Kind::Text, 5, |w| {
        let text = *w.dice.pick(&[
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
    Row::when(
        "text.odd",
        Kind::Text,
        1,
        |s| !s.nested,
        |w| {
            let odd = odd::block(w.dice);
            w.block(&odd);
        },
    ),
];
