//! Settings of parameters.

use super::super::kind::StatementKind;
use super::super::writer::Statement;

pub(in super::super) const STATEMENTS: &[Statement] = &[
    Statement::any("parameter.number", StatementKind::Parameter, 25, |w| {
        let (parameter, value) = (w.settable(), w.number());
        w.block(format!("{parameter} = {value}"));
        w.was_set(&parameter);
    }),
    Statement::any("parameter.expression", StatementKind::Parameter, 35, |w| {
        let parameter = w.settable();
        let expression = w.expression(3);
        w.block(format!("{parameter} = [{expression}]"));
        w.was_set(&parameter);
    }),
    Statement::any("parameter.state", StatementKind::Parameter, 20, |w| {
        let (parameter, value) = (w.settable(), w.state_parameter());
        w.block(format!("{parameter} = {value}"));
        w.was_set(&parameter);
    }),
    Statement::any("parameter.two", StatementKind::Parameter, 10, |w| {
        let (one, other) = (w.settable(), w.settable());
        let (a, b) = (w.value(1), w.value(1));
        w.block(format!("{one}={a} {other}={b}"));
        w.was_set(&one);
        w.was_set(&other);
    }),
    Statement::any("parameter.indirect", StatementKind::Parameter, 6, |w| {
        let value = w.value(1);
        w.block("#34 = 35");
        let target = *w.entropy.pick(&["##34", "#[#34]", "#[30 + 5]"]);
        w.block(format!("{target} = {value}"));
    }),
    Statement::any("parameter.and-move", StatementKind::Parameter, 8, |w| {
        let (parameter, value, axes) = (w.settable(), w.value(1), w.axes(2));
        w.block(format!("{parameter}={value} g0{axes}"));
        w.was_set(&parameter);
        w.moves(true);
    }),
    Statement::any("parameter.exists", StatementKind::Parameter, 5, |w| {
        let name = *w.entropy.pick(&["cut", "_far", "nothing", "_nothing", "_metric"]);
        w.block(format!("#32 = exists[#<{name}>]"));
    }),
    Statement::any("parameter.many", StatementKind::Parameter, 4, |w| {
        let mut words = Vec::new();
        for number in 31..31 + w.entropy.range(3, 6) {
            words.push(format!("#{number}={}", w.value(1)));
        }
        w.block(words.join(" "));
    }),
];
