//! Settings of parameters.

use super::super::table::{Kind, Row};

pub(in super::super) const ROWS: &[Row] = &[
    Row::any("parameter.number", Kind::Parameter, 25, |w| {
        let (parameter, value) = (w.settable(), w.number());
        w.block(format!("{parameter} = {value}"));
        w.was_set(&parameter);
    }),
    Row::any("parameter.expression", Kind::Parameter, 35, |w| {
        let parameter = w.settable();
        let expression = w.expression(3);
        w.block(format!("{parameter} = [{expression}]"));
        w.was_set(&parameter);
    }),
    Row::any("parameter.state", Kind::Parameter, 20, |w| {
        let (parameter, value) = (w.settable(), w.state_parameter());
        w.block(format!("{parameter} = {value}"));
        w.was_set(&parameter);
    }),
    Row::any("parameter.two", Kind::Parameter, 10, |w| {
        let (one, other) = (w.settable(), w.settable());
        let (a, b) = (w.value(1), w.value(1));
        w.block(format!("{one}={a} {other}={b}"));
        w.was_set(&one);
        w.was_set(&other);
    }),
    Row::any("parameter.indirect", Kind::Parameter, 6, |w| {
        let value = w.value(1);
        w.block("#34 = 35");
        let target = *w.dice.pick(&["##34", "#[#34]", "#[30 + 5]"]);
        w.block(format!("{target} = {value}"));
    }),
    Row::any("parameter.and-move", Kind::Parameter, 8, |w| {
        let (parameter, value, axes) = (w.settable(), w.value(1), w.axes(2));
        w.block(format!("{parameter}={value} g0{axes}"));
        w.was_set(&parameter);
        w.moves(true);
    }),
    Row::any("parameter.exists", Kind::Parameter, 5, |w| {
        let name = *w.dice.pick(&["cut", "_far", "nothing", "_nothing", "_metric"]);
        w.block(format!("#32 = exists[#<{name}>]"));
    }),
    Row::any("parameter.many", Kind::Parameter, 4, |w| {
        let mut words = Vec::new();
        for number in 31..31 + w.dice.range(3, 6) {
            words.push(format!("#{number}={}", w.value(1)));
        }
        w.block(words.join(" "));
    }),
];
